//! A drawing as a PDF file of one page, with real lines and letters.

use pdf_writer::types::LineCapStyle;
use pdf_writer::{Content, Finish as _, Name, Pdf, Rect, Ref, Str, TextStr};

use super::drawing::{Anchor, Item, RAISED, RISE, Role, Text};
use super::figure::Drawing;
use super::helvetica::{Font, code};

/// Points in a pixel.
const POINTS: f64 = 0.75;

/// The distance of the ends of the handles of a quarter of a circle of radius 1.
const HANDLE: f64 = 0.552_284_75;

/// The fonts: Helvetica, its bold, and Symbol.
const FONTS: [(Name<'_>, Name<'_>); 3] = [
    (Name(b"H"), Name(b"Helvetica")),
    (Name(b"B"), Name(b"Helvetica-Bold")),
    (Name(b"S"), Name(b"Symbol")),
];

/// A drawing as the bytes of a file.
pub fn file(drawing: &Drawing) -> Vec<u8> {
    let [catalog, pages, page, content, info] = [1, 2, 3, 4, 5].map(Ref::new);
    let fonts = [6, 7, 8].map(Ref::new);
    let [width, height] = drawing.size.map(|it| (it * POINTS) as f32);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let mut entry = pdf.page(page);
    entry.parent(pages).media_box(Rect::new(0.0, 0.0, width, height)).contents(content);
    let mut resources = entry.resources();
    let mut named = resources.fonts();
    for ((name, _), font) in FONTS.iter().zip(fonts) {
        named.pair(*name, font);
    }
    named.finish();
    resources.finish();
    entry.finish();
    for ((_, base), id) in FONTS.iter().zip(fonts) {
        let mut font = pdf.type1_font(id);
        font.base_font(*base);
        if *base != FONTS[2].1 {
            font.encoding_predefined(Name(b"WinAnsiEncoding"));
        }
    }
    pdf.document_info(info)
        .title(TextStr(&drawing.title))
        .subject(TextStr(&drawing.description))
        .creator(TextStr(concat!("mms ", env!("CARGO_PKG_VERSION"))));
    pdf.stream(content, &operators(drawing));
    pdf.finish()
}

/// The drawing operators: in pixels from the lower left corner upwards; the first operator converts them to points.
fn operators(drawing: &Drawing) -> pdf_writer::Buf {
    let mut page = Page { content: Content::new(), height: drawing.size[1] };
    let scale = POINTS as f32;
    page.content.transform([scale, 0.0, 0.0, scale, 0.0, 0.0]);
    page.content.set_line_cap(LineCapStyle::ButtCap);
    for item in &drawing.items {
        match item {
            Item::Path { role, points, is_closed } => page.path(*role, points, *is_closed),
            Item::Disc { role, centre, radius } => page.disc(*role, *centre, *radius),
            Item::Text(text) => page.text(text),
        }
    }
    page.content.finish()
}

struct Page {
    content: Content,
    height: f64,
}

impl Page {
    /// A place with two digits; upwards is positive.
    fn place(&self, [x, y]: [f64; 2]) -> [f32; 2] {
        [x, self.height - y].map(|it| ((it * 100.0).round() / 100.0) as f32)
    }

    fn ink(&mut self, role: Role) {
        let ink = role.ink();
        let parts = |colour: [u8; 3]| colour.map(|it| f32::from(it) / 255.0);
        let [r, g, b] = parts(ink.stroke);
        self.content.set_stroke_rgb(r, g, b).set_line_width(ink.width as f32);
        self.content.set_dash_pattern(ink.dashes.iter().map(|it| *it as f32), 0.0);
        if let Some([r, g, b]) = ink.fill.map(parts) {
            self.content.set_fill_rgb(r, g, b);
        }
    }

    fn paint(&mut self, role: Role, is_closed: bool) {
        match (role.ink().fill.is_some(), is_closed) {
            (true, _) => self.content.close_fill_nonzero_and_stroke(),
            (false, true) => self.content.close_and_stroke(),
            (false, false) => self.content.stroke(),
        };
    }

    fn path(&mut self, role: Role, points: &[[f64; 2]], is_closed: bool) {
        let Some((first, others)) = points.split_first() else { return };
        self.ink(role);
        let [x, y] = self.place(*first);
        self.content.move_to(x, y);
        for point in others {
            let [x, y] = self.place(*point);
            self.content.line_to(x, y);
        }
        self.paint(role, is_closed);
    }

    fn disc(&mut self, role: Role, [x, y]: [f64; 2], radius: f64) {
        self.ink(role);
        let at = |right: f64, down: f64| [x + right * radius, y + down * radius];
        let quarters = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let [x1, y1] = self.place(at(1.0, 0.0));
        self.content.move_to(x1, y1);
        for (from, to) in quarters.iter().zip(quarters.iter().cycle().skip(1)) {
            let handle =
                |a: &[f64; 2], b: &[f64; 2]| at(a[0] + HANDLE * b[0], a[1] + HANDLE * b[1]);
            let ends = [handle(from, to), handle(to, from), at(to[0], to[1])];
            let [[x1, y1], [x2, y2], [x3, y3]] = ends.map(|it| self.place(it));
            self.content.cubic_to(x1, y1, x2, y2, x3, y3);
        }
        self.paint(role, true);
    }

    fn text(&mut self, text: &Text) {
        let width = text.words.width_of(text.size);
        let before = match text.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => width / 2.0,
            Anchor::End => width,
        };
        let [x, y] = text.at;
        let start = if text.is_turned { [x, y + before] } else { [x - before, y] };
        let [x, y] = self.place(start);
        self.content.set_fill_gray(0.0).begin_text();
        self.content.set_text_matrix(match text.is_turned {
            true => [0.0, 1.0, -1.0, 0.0, x, y],
            false => [1.0, 0.0, 0.0, 1.0, x, y],
        });
        for part in &text.words.0 {
            let size = if part.is_raised { RAISED * text.size } else { text.size };
            self.content.set_rise(if part.is_raised { (RISE * text.size) as f32 } else { 0.0 });
            let codes: Vec<(Font, u8)> = part.text.chars().map(code).collect();
            for run in codes.chunk_by(|a, b| a.0 == b.0) {
                let (name, _) = match run[0].0 {
                    Font::Symbols => FONTS[2],
                    Font::Letters => FONTS[usize::from(text.is_bold)],
                };
                let bytes: Vec<u8> = run.iter().map(|(_, code)| *code).collect();
                self.content.set_font(name, size as f32).show(Str(&bytes));
            }
        }
        self.content.end_text();
    }
}
