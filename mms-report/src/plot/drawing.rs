//! A drawing: lines, marks and texts in pixels of 1/96 inch, which an SVG file, a PDF file and a page show alike.

use super::STYLES;
use super::helvetica::width;

/// The size of texts.
pub const TEXT: f64 = 11.0;

/// The size of the legend of a figure in a column: 7.5 points.
pub const SMALL: f64 = 10.0;

/// The share of its size that a raised text keeps.
pub const RAISED: f64 = 0.75;

/// The share of the size by which a text is raised.
pub const RISE: f64 = 0.42;

/// A part of a drawing, which determines its look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A line from a number of an axis through the curves.
    Mesh,
    /// An axis, and the strokes at its numbers.
    Axes,
    /// The line of a curve of this style.
    Line(usize),
    /// A mark of a curve of this style.
    Mark {
        /// The style.
        style: usize,
        /// Whether the mark is a ring.
        is_hollow: bool,
    },
    /// A line that is no curve: a goal, a bound, a floor.
    Dashed,
    /// The triangle of a slope.
    Slope,
    /// The cross of a run that stopped.
    Cross,
}

/// The look of a part in print.
pub struct Ink {
    /// The colour of its line.
    pub stroke: [u8; 3],
    /// The width of its line.
    pub width: f64,
    /// The lengths of dashes and of the gaps between them.
    pub dashes: &'static [f64],
    /// The colour inside.
    pub fill: Option<[u8; 3]>,
}

/// The colours of Okabe and Ito, "Color Universal Design" (2008).
const COLOURS: [[u8; 3]; STYLES] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [166, 124, 0], [86, 180, 233]];

const DASHES: [&[f64]; STYLES] =
    [&[], &[7.0, 3.0], &[2.0, 2.5], &[7.0, 2.5, 1.5, 2.5], &[4.0, 2.0], &[10.0, 4.0]];

const WHITE: [u8; 3] = [255; 3];

impl Role {
    /// The look in print.
    pub fn ink(self) -> Ink {
        let line = |grey: u8, width, dashes| Ink { stroke: [grey; 3], width, dashes, fill: None };
        match self {
            Role::Mesh => line(221, 0.6, &[]),
            Role::Axes => line(0, 1.0, &[]),
            Role::Dashed => line(85, 1.2, &[5.0, 3.0]),
            Role::Slope => line(0, 1.0, &[]),
            Role::Cross => line(0, 1.5, &[]),
            Role::Line(style) => Ink { stroke: COLOURS[style], ..line(0, 1.5, DASHES[style]) },
            Role::Mark { style, is_hollow } => {
                let stroke = COLOURS[style];
                Ink {
                    stroke,
                    width: 1.2,
                    dashes: &[],
                    fill: Some(if is_hollow { WHITE } else { stroke }),
                }
            }
        }
    }

    /// The classes on a page, whose style sheet has the colours.
    pub fn class(self) -> String {
        match self {
            Role::Mesh => "mesh".into(),
            Role::Axes => "axes".into(),
            Role::Dashed => "dashed".into(),
            Role::Slope => "slope".into(),
            Role::Cross => "cross".into(),
            Role::Line(style) => format!("line s{style}"),
            Role::Mark { style, is_hollow } => {
                format!("mark s{style}{}", if is_hollow { " hollow" } else { "" })
            }
        }
    }
}

/// A text in parts, of which some are raised, as in a power of ten.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Words(pub Vec<Part>);

/// A part of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The characters.
    pub text: String,
    /// Whether they are small, above the line.
    pub is_raised: bool,
}

impl Words {
    /// A text without raised parts.
    pub fn plain(text: impl Into<String>) -> Self {
        Words(vec![Part { text: text.into(), is_raised: false }])
    }

    /// The text followed by another part.
    pub fn and(mut self, text: impl Into<String>, is_raised: bool) -> Self {
        self.0.push(Part { text: text.into(), is_raised });
        self
    }

    /// The width of the text in the size [`TEXT`].
    pub fn width(&self) -> f64 {
        self.width_of(TEXT)
    }

    /// The width of the text in a size.
    pub fn width_of(&self, size: f64) -> f64 {
        let of = |part: &Part| width(&part.text) * if part.is_raised { RAISED } else { 1.0 };
        size * self.0.iter().map(of).sum::<f64>()
    }
}

/// The end of a text that is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The first letter.
    Start,
    /// The middle.
    Middle,
    /// The last letter.
    End,
}

/// A text with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The place of the anchor on the line of the text.
    pub at: [f64; 2],
    /// The end that is at the place.
    pub anchor: Anchor,
    /// Whether the text runs upwards.
    pub is_turned: bool,
    /// Whether the text is bold.
    pub is_bold: bool,
    /// The size of the letters, [`TEXT`] or [`SMALL`].
    pub size: f64,
    /// The text.
    pub words: Words,
}

/// A line, a mark or a text of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// Straight lines from point to point.
    Path {
        /// The part of the drawing, which determines its look.
        role: Role,
        /// The points.
        points: Vec<[f64; 2]>,
        /// Whether the last point leads to the first.
        is_closed: bool,
    },
    /// A disc.
    Disc {
        /// The part of the drawing, which determines its look.
        role: Role,
        /// The middle.
        centre: [f64; 2],
        /// The radius.
        radius: f64,
    },
    /// A text.
    Text(Text),
}

impl Item {
    /// An open line.
    pub fn line(role: Role, points: impl Into<Vec<[f64; 2]>>) -> Self {
        Item::Path { role, points: points.into(), is_closed: false }
    }

    /// A closed line.
    pub fn shape(role: Role, points: impl Into<Vec<[f64; 2]>>) -> Self {
        Item::Path { role, points: points.into(), is_closed: true }
    }

    /// A text in a row.
    pub fn text(at: [f64; 2], anchor: Anchor, words: Words) -> Self {
        Item::Text(Text { at, anchor, is_turned: false, is_bold: false, size: TEXT, words })
    }

    /// The item at another place.
    pub fn moved(mut self, [right, down]: [f64; 2]) -> Self {
        let shift = |[x, y]: &mut [f64; 2]| (*x, *y) = (*x + right, *y + down);
        match &mut self {
            Item::Path { points, .. } => points.iter_mut().for_each(shift),
            Item::Disc { centre, .. } => shift(centre),
            Item::Text(text) => shift(&mut text.at),
        }
        self
    }
}

/// The mark of a style: a disc, a square, a triangle, a diamond, a triangle on its tip, a bar.
pub fn mark(style: usize, is_hollow: bool, centre: [f64; 2]) -> Item {
    let role = Role::Mark { style, is_hollow };
    let corners: &[[f64; 2]] = match style {
        0 => return Item::Disc { role, centre, radius: 3.8 },
        1 => &[[-3.4, -3.4], [3.4, -3.4], [3.4, 3.4], [-3.4, 3.4]],
        2 => &[[0.0, -5.0], [4.6, 3.2], [-4.6, 3.2]],
        3 => &[[0.0, -5.2], [4.4, 0.0], [0.0, 5.2], [-4.4, 0.0]],
        4 => &[[0.0, 5.0], [4.6, -3.2], [-4.6, -3.2]],
        _ => &[[-4.8, -2.2], [4.8, -2.2], [4.8, 2.2], [-4.8, 2.2]],
    };
    Item::shape(role, corners).moved(centre)
}

/// The cross of a run that stopped.
pub fn cross(centre: [f64; 2]) -> [Item; 2] {
    [[-4.0, 4.0], [4.0, -4.0]]
        .map(|[from, to]| Item::line(Role::Cross, [[-4.0, from], [4.0, to]]).moved(centre))
}
