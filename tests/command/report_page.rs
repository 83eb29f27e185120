//! `mms report`: the parts of its page for any results, and results that make no page.

use roxmltree::Node;

use super::mms::{Folder, Run};
use super::report::{PAGE, document, named, parse, text};

#[test]
fn the_summary_has_every_result_and_its_verdict() {
    let page = parse(&PAGE);
    let table = named(page.root(), "table").next().expect("a table");
    let rows: Vec<Vec<String>> = named(table, "tr")
        .skip(1)
        .map(|row| row.children().filter(Node::is_element).map(text).collect())
        .collect();
    assert_eq!(rows.len(), 12, "{rows:?}");
    assert!(rows.iter().any(|row| row[0].starts_with("bar_1d") && row[2].ends_with("pass")));
    assert!(rows.iter().any(|row| row[1] == "Verification matrix" && row[2].contains("1 of 1")));
    let head = named(page.root(), "header").next().expect("a header");
    assert!(text(head).contains("verdicts are as expected"), "{}", text(head));
}

#[test]
fn nothing_on_the_page_is_from_elsewhere() {
    let page = parse(&PAGE);
    for node in page.descendants().filter(Node::is_element) {
        let tag = node.tag_name().name();
        assert!(
            !matches!(tag, "script" | "link" | "img" | "iframe" | "object" | "base"),
            "<{tag}>"
        );
        for attribute in node.attributes() {
            let name = attribute.name();
            assert!(!name.starts_with("on") && name != "src", "{tag} {name}");
            if name == "href" {
                assert!(attribute.value().starts_with('#'), "{}", attribute.value());
            }
        }
    }
    let style = text(named(page.root(), "style").next().expect("a style"));
    assert!(!style.contains("url(") && !style.contains("@import"));
}

#[test]
fn links_lead_to_places_and_every_place_is_one() {
    let page = parse(&PAGE);
    let ids: Vec<_> = page.descendants().filter_map(|node| node.attribute("id")).collect();
    let mut once = ids.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), ids.len(), "{ids:?}");
    let links = page.descendants().filter_map(|node| node.attribute("href"));
    let labels = page.descendants().filter_map(|node| node.attribute("aria-labelledby"));
    let targets: Vec<_> =
        links.map(|link| &link[1..]).chain(labels.flat_map(str::split_whitespace)).collect();
    assert!(targets.len() > 10);
    for target in targets {
        assert!(ids.contains(&target), "`{target}` is nowhere");
    }
}

#[test]
fn a_screen_reader_finds_its_way() {
    let page = parse(&PAGE);
    let level = |node: &Node| node.tag_name().name().strip_prefix('h')?.parse::<usize>().ok();
    let levels: Vec<usize> = page.descendants().filter_map(|node| level(&node)).collect();
    assert_eq!(levels.iter().filter(|level| **level == 1).count(), 1);
    assert_eq!(levels[0], 1);
    assert!(levels.windows(2).all(|pair| pair[1] <= pair[0] + 1), "{levels:?}");
    for table in named(page.root(), "table") {
        assert!(named(table, "caption").next().is_some());
        assert!(named(table, "th").all(|th| matches!(th.attribute("scope"), Some("col" | "row"))));
    }
    for svg in named(page.root(), "svg") {
        let is_image =
            svg.attribute("role") == Some("img") && svg.attribute("aria-labelledby").is_some();
        assert!(is_image || svg.attribute("aria-hidden") == Some("true"));
    }
    assert!(named(page.root(), "math").count() > 20);
    assert_eq!(page.root_element().attribute("lang"), Some("en"));
}

#[test]
fn states_show_every_particle() {
    let page = parse(&PAGE);
    let section = named(page.root(), "section").find(|section| {
        section.children().any(|it| text(it).starts_with("axis_aligned_2d: 4 states"))
    });
    let section = section.expect("the states");
    let particles = document("run/run")["particles"].as_u64().expect("a number") as usize;
    let pictures: Vec<_> =
        named(section, "svg").filter(|svg| svg.attribute("role").is_some()).collect();
    assert_eq!(pictures.len(), 4);
    for picture in pictures {
        let paths = named(picture, "path").filter_map(|path| path.attribute("d"));
        assert_eq!(paths.map(|path| path.matches('z').count()).sum::<usize>(), particles);
    }
}

#[test]
fn a_page_says_where_each_result_is_from() {
    for command in
        ["mms study bar_1d --cells 4,8,16 --excluded --output all/bar", "mms verify --row time/usl"]
    {
        assert!(PAGE.contains(command), "{command}");
    }
    let hash =
        document("bar/convergence")["provenance"]["input"]["hash"].as_str().map(str::to_owned);
    assert!(PAGE.contains(&hash.expect("a hash")));
}

#[test]
fn a_verdict_that_is_not_as_expected_comes_first_and_exits_1() {
    let folder = Folder::new();
    folder.mms("study bar_1d --cells 4,8 --integrator usl --output bad").exits(1);
    folder.mms("report bad").exits(1).prints("the verdict is not as expected");
    let page = folder.read("bad/report.html");
    let page = parse(&page);
    let main = named(page.root(), "header").next().expect("a header");
    assert!(text(main).contains("the verdict is not as expected"));
}

#[test]
fn what_is_no_result_is_named_and_left_where_it_is() {
    let folder = Folder::new();
    folder.mms("study bar_1d --cells 4,8 --output all/study");
    folder.mms("verify --row time/usl --quick --store all/store").exits(0);
    folder.write("all/a.json", "{");
    folder.write("all/b.json", "[1, 2]");
    folder.write("all/c.json", r#"{"provenance": 3}"#);
    let study = folder.read("all/study/convergence.json");
    folder.write("all/d.json", &study.replace("\"levels\"", "\"steps\""));
    folder.write("all/e.json", &study.replace("\"study\"", "\"dance\""));
    folder.write("all/f.pvd", "<VTKFile/>");
    let timeless = "<VTKFile><DataSet timestep=\"NaN\" file=\"x.vtu\"/></VTKFile>";
    folder.write("all/h.pvd", timeless);
    // Before methods had a form, a result did not name one.
    folder.write("all/g.json", &study.replace("\"form\": \"stable\",", ""));
    let version = "\"document_version\": 2,";
    assert!(study.contains(version));
    folder.write("all/i.json", &study.replace(version, "\"document_version\": 3,"));
    folder.write("all/first.json", &study.replace(version, ""));
    let run: Run = folder.mms("report all --output page.html");
    let page = folder.read("page.html");
    assert!(page.contains("first.json") && !run.stderr.contains("first.json"), "{run}");
    for (file, reason) in [
        ("a.json", "not JSON"),
        ("b.json", "it has no provenance"),
        ("c.json", "its provenance cannot be read"),
        ("d.json", "not what `mms study` writes: missing field `levels`"),
        ("e.json", "unknown kind of document `dance`"),
        ("f.pvd", "no states in it"),
        ("h.pvd", "a state without a time or a file"),
        ("i.json", "its form is of version 3, and this `mms` reads versions up to 2"),
        ("g.json", "not what `mms study` writes: its method does not say its `form`"),
    ] {
        run.complains(&format!("{file}: {reason}"));
        assert!(page.contains(&format!("{file}: {reason}")), "{file}");
    }
    run.complains("results of single runs, kept by `mms verify --store`");
    assert_eq!(folder.read("all/a.json"), "{");
}

#[test]
fn a_page_replaces_none_of_what_it_is_made_of() {
    let folder = Folder::with_bar("mine.toml");
    folder.mms("run mine.toml --cells 8 --output all --vtk all --frames 1").exits(0);
    let files =
        ["all/run.json", "all/../all/run.json", "all/mine.pvd", "all/mine_0000.vtu", "mine.toml"];
    let before = files.map(|file| folder.read(file));
    for file in files {
        let run = folder.mms(&format!("report all --output {file}")).exits(2);
        run.complains(&format!("`--output {file}`: that file is read")).prints_nothing();
    }
    assert_eq!(files.map(|file| folder.read(file)), before);
    // The previous page is not part of the results.
    for _ in 0..2 {
        folder.mms("report all").exits(0);
    }
}

#[test]
fn a_folder_without_results_exits_2() {
    let folder = Folder::new();
    folder.mms("report nowhere").exits(2).complains("`nowhere`: not a folder");
    folder.write("empty/notes.txt", "");
    folder.mms("report empty").exits(2).complains("`empty`: no results in it");
    assert!(!folder.path("empty/report.html").exists());
    folder.mms("study bar_1d --cells 4,8 --output one");
    folder
        .mms("report one --output no/where.html")
        .exits(2)
        .complains("cannot write `no/where.html`");
}

#[test]
fn formulas_of_a_file_that_changed_are_not_shown() {
    let folder = Folder::with_bar("mine.toml");
    folder.mms("study mine.toml --cells 4,8 --output one");
    folder.mms("report one");
    assert!(folder.read("one/report.html").contains("<math"));
    let text = folder.read("mine.toml");
    folder.write("mine.toml", &text.replace("value = 0.2", "value = 0.1"));
    folder.mms("report one");
    let page = folder.read("one/report.html");
    assert!(!page.contains("<math") && page.contains("its text has changed since"), "{page}");
}
