//! A drawing as SVG: on a page, whose style sheet colours it, or as a file for print.

use maud::{Markup, html};
use mms_spec::foreign;

use super::drawing::{Anchor, Item, RAISED, RISE, Role, TEXT, Text};
use super::figure::{Drawing, PER_MM};

/// The look of an item: by its class on a page, by its attributes in a file.
#[derive(Default)]
struct Look {
    class: Option<String>,
    stroke: Option<String>,
    width: Option<f64>,
    dashes: Option<String>,
    fill: Option<String>,
}

fn look(role: Role, is_page: bool) -> Look {
    let ink = role.ink();
    let dashes = (!ink.dashes.is_empty())
        .then(|| ink.dashes.iter().map(f64::to_string).collect::<Vec<_>>().join(" "));
    let colour = |[r, g, b]: [u8; 3]| format!("#{r:02x}{g:02x}{b:02x}");
    match is_page {
        true => Look { class: Some(role.class()), dashes, ..Look::default() },
        false => Look {
            class: None,
            stroke: Some(colour(ink.stroke)),
            width: Some(ink.width),
            dashes,
            fill: Some(ink.fill.map_or("none".into(), colour)),
        },
    }
}

/// A coordinate with two digits: a hundredth of a pixel is 3 micrometres.
fn round(value: f64) -> f64 {
    // Adding 0 makes -0 a 0.
    (value * 100.0).round() / 100.0 + 0.0
}

/// Items in their order, for a page or for a file.
pub fn items(items: &[Item], is_page: bool) -> Markup {
    html! { @for it in items { (item(it, is_page)) } }
}

fn item(item: &Item, is_page: bool) -> Markup {
    match item {
        Item::Path { role, points, is_closed } => {
            let look = look(*role, is_page);
            let places = points.iter().map(|[x, y]| format!("{},{}", round(*x), round(*y)));
            let places = places.collect::<Vec<_>>().join("L");
            let end = if *is_closed { "z" } else { "" };
            html! { path class=[look.class] stroke=[look.stroke] stroke-width=[look.width] stroke-dasharray=[look.dashes] fill=[look.fill] d=(format!("M{places}{end}")) {} }
        }
        Item::Disc { role, centre: [x, y], radius } => {
            let look = look(*role, is_page);
            html! { circle class=[look.class] stroke=[look.stroke] stroke-width=[look.width] fill=[look.fill] cx=(round(*x)) cy=(round(*y)) r=(radius) {} }
        }
        Item::Text(it) => text(it),
    }
}

fn text(text: &Text) -> Markup {
    let [x, y] = text.at.map(round);
    let anchor = match text.anchor {
        Anchor::Start => None,
        Anchor::Middle => Some("middle"),
        Anchor::End => Some("end"),
    };
    let turned = text.is_turned.then(|| format!("rotate(-90 {x} {y})"));
    let weight = text.is_bold.then_some("bold");
    let size = (text.size != TEXT).then_some(text.size);
    // A raised part is measured by its own, smaller size.
    let rise = round(RISE / RAISED);
    html! {
        text x=(x) y=(y) text-anchor=[anchor] font-weight=[weight] font-size=[size] transform=[turned] {
            @for (at, part) in text.words.0.iter().enumerate() {
                @let falls = at > 0 && text.words.0[at - 1].is_raised;
                @if part.is_raised {
                    tspan font-size=(format!("{RAISED}em")) dy=(format!("-{rise}em")) { (part.text) }
                } @else if falls {
                    tspan dy=(format!("{RISE}em")) { (part.text) }
                } @else {
                    (part.text)
                }
            }
        }
    }
}

/// A drawing as a file.
pub fn file(drawing: &Drawing) -> String {
    let [width, height] = drawing.size.map(round);
    let [wide, high] = drawing.size.map(|it| format!("{:.2}mm", it / PER_MM));
    let svg = html! {
        svg width=(wide) height=(high) viewBox=(format!("0 0 {width} {height}")) role="img" aria-label=(drawing.title) font-family="Helvetica, Arial, Liberation Sans, sans-serif" font-size=(TEXT) xmlns="http://www.w3.org/2000/svg" {
            title { (drawing.title) }
            desc { (drawing.description) }
            rect width=(width) height=(height) fill="#fff" {}
            (items(&drawing.items, false))
        }
    };
    foreign::markup(&svg.into_string()) + "\n"
}
