//! A figure for print: panels of curves with their legends, in the width of a column or of a page.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use super::drawing::{Anchor, Item, SMALL, TEXT, Text, Words};
use super::{Area, Entry, Plot, pdf, svg};

/// Pixels in a millimetre, as CSS defines them.
pub const PER_MM: f64 = 96.0 / 25.4;

/// The height of a line of a legend.
const LEGEND_LINE: f64 = 16.0;
/// The height of a line of a legend in a column.
const SMALL_LINE: f64 = 13.5;

/// The room between a legend and the curves, and around a panel.
const GAP: f64 = 14.0;

/// The least width of curves beside a legend.
const LEAST: f64 = 280.0;

/// The ratio of the height of the curves to their width.
const SHAPE: f64 = 0.66;

/// The width of a figure in print.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Width {
    /// One column, 85 mm, with the legend below the curves.
    Column,
    /// The page, 170 mm: one panel with its legend beside the curves, or two columns of panels.
    #[default]
    Page,
}

impl Width {
    fn millimetres(self) -> f64 {
        match self {
            Width::Column => 85.0,
            Width::Page => 170.0,
        }
    }
}

impl FromStr for Width {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "85" => Ok(Width::Column),
            "170" => Ok(Width::Page),
            _ => Err("expected 85, a column, or 170, a page, in millimetres"),
        }
    }
}

impl fmt::Display for Width {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.millimetres())
    }
}

/// The format of the file of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// SVG.
    Svg,
    /// PDF.
    Pdf,
}

impl FileFormat {
    /// The format that the ending of a file name determines.
    ///
    /// # Errors
    /// Another ending.
    pub fn of(path: &Path) -> Result<Self, &'static str> {
        let ending = path.extension().map(|it| it.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("svg") => Ok(FileFormat::Svg),
            Some("pdf") => Ok(FileFormat::Pdf),
            _ => Err("expected the name of a file that ends in .svg or .pdf"),
        }
    }
}

/// Panels of curves.
pub struct Figure {
    /// The title, which readers of the file see where the picture is not shown.
    title: String,
    /// The panels.
    panels: Vec<Plot>,
}

/// A picture of a size in pixels, with its title and its numbers in words.
pub struct Drawing {
    /// The width and the height.
    pub size: [f64; 2],
    /// The title.
    pub title: String,
    /// The numbers in words.
    pub description: String,
    /// The lines, marks and texts; later ones are drawn over earlier ones.
    pub items: Vec<Item>,
}

impl Figure {
    /// A figure of these panels, without those that have nothing to draw if others have.
    pub fn new(title: String, mut panels: Vec<Plot>) -> Self {
        if panels.iter().any(|it| !it.is_empty()) {
            panels.retain(|it| !it.is_empty());
        }
        Figure { title, panels }
    }

    /// Whether no point has a place on its axes.
    pub fn is_empty(&self) -> bool {
        self.panels.iter().all(Plot::is_empty)
    }

    /// The bytes of its file.
    pub fn file(&self, format: FileFormat, width: Width) -> Vec<u8> {
        let drawing = self.drawn(width);
        match format {
            FileFormat::Svg => svg::file(&drawing).into_bytes(),
            FileFormat::Pdf => pdf::file(&drawing),
        }
    }

    /// The text of its SVG file, as wide as a page.
    pub fn svg(&self) -> String {
        svg::file(&self.drawn(Width::Page))
    }

    fn drawn(&self, width: Width) -> Drawing {
        let whole = width.millimetres() * PER_MM;
        let are_several = self.panels.len() > 1;
        let columns = if are_several && width == Width::Page { 2 } else { 1 };
        let wide = whole / columns as f64;
        // The curves of all panels are of one size, and below each other.
        let left = 26.0 + self.panels.iter().map(Plot::widest_number).fold(0.0, f64::max);
        let mut items = Vec::new();
        let mut top = 0.0;
        for (row, panels) in self.panels.chunks(columns).enumerate() {
            let mut height = 0.0_f64;
            for (column, plot) in panels.iter().enumerate() {
                let letter = are_several.then(|| letter(row * columns + column));
                let head = letter.unwrap_or_default() + &plot.head;
                let is_beside = !are_several && width == Width::Page;
                let size = if width == Width::Column { SMALL } else { TEXT };
                let (own, high) = panel(plot, &head, [left, wide], is_beside, size);
                let at = [column as f64 * wide, top];
                items.extend(own.into_iter().map(|it| it.moved(at)));
                height = height.max(high);
            }
            top += height;
        }
        let described = self.panels.iter().map(|it| it.description.as_str());
        Drawing {
            size: [whole, top.ceil()],
            title: self.title.clone(),
            description: described.collect::<Vec<_>>().join(" "),
            items,
        }
    }
}

/// The letter of a panel among several.
fn letter(number: usize) -> String {
    match u8::try_from(number) {
        Ok(it @ 0..=25) => format!("({}) ", char::from(b'a' + it)),
        _ => format!("({}) ", number + 1),
    }
}

/// A panel between its left axis and its width, with its legend beside the curves if there is room; and its height.
fn panel(
    plot: &Plot,
    head: &str,
    [left, width]: [f64; 2],
    is_beside: bool,
    size: f64,
) -> (Vec<Item>, f64) {
    let legend = plot.legend(true);
    // Bold letters, and the letters of a substitute for Helvetica, are wider.
    let row = |it: &Entry| 1.08 * (it.words.width_of(size) + 34.0);
    let of_rows = legend.iter().map(row).fold(0.0, f64::max);
    let of_head = 1.08 * Words::plain(head).width();
    let beside = width - GAP - of_rows - GAP - left;
    let is_beside = is_beside && beside >= LEAST;
    let right = if is_beside { left + beside } else { width - GAP };
    let bold = |at: [f64; 2]| {
        let words = Words::plain(head);
        let (anchor, is_turned, is_bold) = (Anchor::Start, false, true);
        Item::Text(Text { at, anchor, is_turned, is_bold, size: TEXT, words })
    };
    // A head longer than the legend would make the curves smaller.
    let head_above = !head.is_empty() && (!is_beside || of_head > of_rows);
    let top = if head_above { 26.0 } else { 12.0 };
    let area = Area { left, right, top, bottom: top + SHAPE * (right - left).min(420.0) };
    let mut items = plot.drawn(&plot.frame(area));
    let below = area.bottom + 42.0;
    let [x, mut y] = if is_beside { [right + GAP, top + 4.0] } else { [left, below + 4.0] };
    if head_above {
        items.push(bold([left, 15.0]));
    } else if !head.is_empty() {
        items.push(bold([x, y + 8.0]));
        y += LEGEND_LINE + 4.0;
    }
    let line = if size == TEXT { LEGEND_LINE } else { SMALL_LINE };
    // Below the curves of a narrow figure, entries share a line if they fit.
    let room = width - GAP - x;
    let columns = match is_beside || size == TEXT {
        true => 1,
        false => ((room / of_rows) as usize).clamp(1, legend.len().max(1)),
    };
    for entries in legend.chunks(columns) {
        for (column, entry) in entries.iter().enumerate() {
            let x = x + column as f64 * room / columns as f64;
            items.extend(entry.sign.iter().map(|it| it.clone().moved([x, y])));
            let (at, anchor) = ([x + 34.0, y + 8.0 + 4.0 * size / TEXT], Anchor::Start);
            let words = entry.words.clone();
            items.push(Item::Text(Text {
                at,
                anchor,
                is_turned: false,
                is_bold: false,
                size,
                words,
            }));
        }
        y += line;
    }
    let height = if is_beside { below.max(y + 8.0) } else { y + GAP };
    (items, height)
}
