//! Requests and replies, as the page in a browser writes and reads them.

use serde_json::{Value, json};

/// A field that is proved, and whose closed form agrees.
const BAR: &str = include_str!("../../fields/bar_1d.toml");

fn answer(header: &Value, files: &[u8]) -> Value {
    let header = header.to_string();
    let length = u32::try_from(header.len()).unwrap().to_le_bytes();
    let reply = mms_web::answer(&[&length, header.as_bytes(), files].concat());
    serde_json::from_str(&reply).unwrap()
}

fn of_bar(what: &str, more: Value) -> Value {
    let mut request = json!({ "do": what, "name": "bar", "text": BAR });
    request.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    answer(&request, &[])
}

/// The beginning of its u.
const RIGHT: &str = "X*(2*length";

#[test]
fn a_mistake_has_its_place() {
    let reply = answer(&json!({ "do": "check", "text": BAR.replace(RIGHT, "Q*(2*length") }), &[]);
    let first = &reply["error"]["diagnostics"][0];
    let (at, text) = BAR.lines().enumerate().find(|(_, text)| text.contains(RIGHT)).unwrap();
    let (line, column) = (at + 1, text.find(RIGHT).unwrap() + 1);
    assert_eq!([&first["line"], &first["column"]], [line, column], "{reply}");
    assert_eq!([&first["end_line"], &first["end_column"]], [line, column + 1], "{reply}");
}

#[test]
fn a_check_has_the_lines_of_the_command() {
    let reply = &of_bar("check", json!({}))["ok"];
    assert_eq!(reply["passes"], true);
    assert!(reply["text"].as_str().unwrap().contains("  proof  J > 0: "), "{reply}");
    assert!(reply["document"]["certificate"]["finite"].as_bool().unwrap(), "{reply}");
}

#[test]
fn code_is_for_the_quantities_that_are_chosen() {
    let names = json!({ "target": "c", "quantities": ["b"] });
    let reply = &of_bar("emit", names)["ok"];
    let text = reply["files"][0]["text"].as_str().unwrap();
    assert!(text.contains("body_force") && !text.contains("cauchy_stress"), "{text}");
    let reply = of_bar("emit", json!({ "target": "basic" }));
    assert_eq!(reply["error"]["message"], "no target `basic`");
}

#[test]
fn a_new_field_passes_its_check() {
    let new = |shape| json!({ "do": "template", "dimension": 2, "material": "neo_hookean", "shape": shape });
    let reply = answer(&new("annulus"), &[]);
    let checked = answer(&json!({ "do": "check", "text": reply["ok"]["text"] }), &[]);
    assert_eq!(checked["ok"]["passes"], true, "{checked}");
    let reply = answer(&new("ring"), &[]);
    assert_eq!(reply["error"]["message"], "no shape `ring`: expected box or annulus");
}

/// u of the bar at the nodes of a mesh, with an error of h^2.
fn results(cells: usize) -> String {
    let mut text = String::from("X,u,t\n");
    for node in 0..=cells {
        let x = node as f64 / cells as f64;
        let values = of_bar("values", json!({ "at": [x], "time": 0.01 }));
        let u = values["ok"]["values"][0]["components"][0].as_f64().unwrap();
        let error = 0.01 * (3.0 * x).sin() / (cells * cells) as f64;
        text += &format!("{x:?},{:?},0.01\n", u + error);
    }
    text
}

#[test]
fn attached_results_are_judged() {
    let texts = [8, 16, 32].map(results);
    let file =
        |(at, text): (usize, &String)| json!({ "name": format!("{at}.csv"), "size": text.len() });
    let files: Vec<_> = texts.iter().enumerate().map(file).collect();
    let request = json!({ "do": "judge", "name": "bar", "text": BAR, "files": files });
    let reply = answer(&request, texts.concat().as_bytes());
    assert_eq!(reply["ok"]["document"]["verdict"], "pass", "{reply}");
    assert_eq!(reply["ok"]["next"], Value::Null);
    let wrong = json!({ "expected_order": 3, "quantities": ["u"] });
    let request =
        json!({ "do": "judge", "name": "bar", "text": BAR, "files": files, "options": wrong });
    let reply = answer(&request, texts.concat().as_bytes());
    let next = "mms diagnose bar.toml 0.csv 1.csv 2.csv --quantity=displacement";
    let words: Vec<_> = next.split(' ').collect();
    assert_eq!(reply["ok"]["next"], json!(words), "{reply}");
    let cut = answer(&request, &texts.concat().as_bytes()[..99]);
    assert_eq!(cut["error"]["message"], "`0.csv` is not attached as a whole");
}

#[test]
fn a_table_of_errors_is_judged() {
    let text = "h,l2\n0.5,0.04\n0.25,0.01\n0.125,0.0025\n";
    let files = json!([{ "name": "errors.csv", "size": text.len() }]);
    let options = json!({ "errors": true, "expected_order": 1 });
    let request =
        |options| json!({ "do": "judge", "text": BAR, "files": files, "options": options });
    let judged = answer(&request(json!({ "errors": true })), text.as_bytes());
    assert_eq!(judged["ok"]["passes"], true, "{judged}");
    let judged = answer(&request(options), text.as_bytes());
    assert_eq!(judged["ok"]["document"]["expected_order"], 1.0, "{judged}");
}

#[test]
fn a_motion_has_a_colour_at_each_point() {
    let more = json!({ "color": "jacobian", "frames": 3, "cells": 4 });
    let reply = &of_bar("motion", more)["ok"];
    assert_eq!(reply["points"].as_array().unwrap().len(), 3);
    assert_eq!(reply["values"][2].as_array().unwrap().len(), 5);
    assert_eq!(reply["cells"][3], json!([3, 4]));
}

#[test]
fn an_odd_request_is_a_mistake() {
    for odd in [&b""[..], b"\xff\xff\xff\xff{}", b"\x02\0\0\0{}", b"\x05\0\0\0{\"do\""] {
        let reply: Value = serde_json::from_str(&mms_web::answer(odd)).unwrap();
        assert!(reply["error"]["message"].is_string(), "{reply}");
    }
    let reply = of_bar("values", json!({ "at": [0.1, 0.2], "time": 0 }));
    assert_eq!(reply["error"]["message"], "X has 2 coordinates; expected 1");
}
