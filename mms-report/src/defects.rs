//! Defects and the rows that caught them, as a table, as a JSON document, and as a page.

use mms_documents::provenance::Provenance;
use mms_documents::verify::{ShownDefect, ShownRow, VerifyDefects};
use mms_lab::plausibility::{Check, Objections};
use mms_verify::defects::{Defect, RowResult as RowUnder};
use mms_verify::matrix::MatrixRow;

use crate::shown::Shown;
use crate::table::TextTable;

/// The largest number of rows that catch a rare defect; each row has to catch a rare one, or be a witness.
const FEW: usize = 6;

/// A defect, and the rows that it was shown to.
pub struct Showing<'a> {
    /// The defect.
    pub defect: Defect,
    /// The rows, with it.
    pub rows: Vec<RowUnder<'a>>,
    /// The objections of plausibility checks to these runs, of checks that do not object to right runs as well.
    pub objections: Objections,
}

impl<'a> Showing<'a> {
    /// The rows whose verdict is not the expected one.
    pub fn caught(&self) -> impl Iterator<Item = &RowUnder<'a>> {
        self.rows.iter().filter(|shown| !shown.judgement.as_expected())
    }

    fn document(&self) -> ShownDefect {
        let row = |shown: &RowUnder<'_>| ShownRow {
            name: shown.row.name.clone(),
            caught: !shown.judgement.as_expected(),
            verdict: shown.judgement.verdict.to_string(),
            reason: shown.judgement.reason.clone(),
        };
        let checks = Check::ALL.into_iter().map(Check::name);
        ShownDefect {
            name: self.defect.name().to_owned(),
            place: self.defect.place().to_owned(),
            what: self.defect.what().to_owned(),
            rows: self.rows.iter().map(row).collect(),
            pseudo: checks.zip(self.objections.0).collect(),
        }
    }

    /// Rows that claim to catch it, and do not.
    fn missed(&self) -> impl Iterator<Item = &RowUnder<'a>> {
        let claims = |row: &MatrixRow| row.catches.iter().any(|name| name == self.defect.name());
        self.rows.iter().filter(move |shown| claims(shown.row) && shown.judgement.as_expected())
    }
}

/// Defects with their results.
pub struct Report<'a> {
    /// The rows that were shown defects.
    pub rows: Vec<&'a MatrixRow>,
    /// The defects.
    pub showings: Vec<Showing<'a>>,
    /// Whether every defect was shown to every row.
    pub whole: bool,
    /// The provenance.
    pub provenance: Provenance,
}

impl<'a> Report<'a> {
    fn uncaught(&self) -> impl Iterator<Item = &Showing<'a>> {
        self.showings.iter().filter(|showing| showing.caught().next().is_none())
    }

    /// Pairs of a row and a defect that it claims to catch, and does not.
    fn missed(&self) -> impl Iterator<Item = (&'a MatrixRow, Defect)> {
        self.showings
            .iter()
            .flat_map(|showing| showing.missed().map(|shown| (shown.row, showing.defect)))
    }

    /// Rows that catch no defect that few others catch, and are not the witness of a property; only for the whole table.
    fn idle(&self) -> Vec<&'a MatrixRow> {
        let catches = |row: &MatrixRow, showing: &&Showing| {
            showing.caught().any(|it| it.row.name == row.name)
        };
        let rare: Vec<_> = self.showings.iter().filter(|it| it.caught().count() <= FEW).collect();
        let idle = |row: &&&MatrixRow| {
            row.witness.is_none() && !rare.iter().any(|showing| catches(row, showing))
        };
        if self.whole { self.rows.iter().filter(idle).copied().collect() } else { Vec::new() }
    }

    /// Whether there are defects, and each was caught by the rows that list it; and whether every row is needed.
    pub fn as_expected(&self) -> bool {
        !self.showings.is_empty()
            && self.uncaught().next().is_none()
            && self.missed().next().is_none()
            && self.idle().is_empty()
    }

    fn table(&self) -> TextTable {
        let checks = Check::ALL.map(Check::name);
        let header = ["defect", "caught by"].into_iter().chain(checks);
        let mut table = TextTable::new("deliberate mistakes and what catches them", header);
        for showing in &self.showings {
            let by = self.caught_by(showing);
            let cells =
                [showing.defect.name().to_owned(), by].into_iter().chain(words(showing.objections));
            table.add_row(cells);
        }
        table
    }

    /// The numbers of defects that the rows and each check caught.
    fn summary(&self) -> String {
        let all = self.showings.len();
        let caught = all - self.uncaught().count();
        let objects = |at: usize| {
            let said = |showing: &&Showing| showing.objections.0[at] == Some(true);
            self.showings.iter().filter(said).count()
        };
        let by_check = Check::ALL.iter().enumerate();
        let by_check: Vec<_> =
            by_check.map(|(at, check)| format!("{} {}", check.name(), objects(at))).collect();
        let blind =
            |showing: &&Showing| showing.objections.0[1..].iter().all(|look| *look != Some(true));
        let blind = self.showings.iter().filter(blind).count();
        format!(
            "the matrix catches {caught} of {all} defects; plausibility checks of the same runs catch: {}; {blind} pass \
             all checks except the picture of the exact solution",
            by_check.join(", ")
        )
    }

    fn caught_by(&self, showing: &Showing<'_>) -> String {
        let caught: Vec<_> = showing.caught().map(|shown| shown.row.name.as_str()).collect();
        match caught.len() {
            0 => "NOTHING".to_owned(),
            n if n > FEW => format!("{} and {} more", caught[..2].join(", "), n - 2),
            _ => caught.join(", "),
        }
    }

    /// The page: all content that does not depend on a machine.
    pub fn page(&self) -> String {
        let mut page = INTRODUCTION.to_owned();
        for place in ["compiler", "solver"] {
            page += &format!(
                "\n## In the {place}\n\n| defect | what is wrong | caught by | picture | bounded | symmetric | energy | settles |\n|---|---|---|---|---|---|---|---|\n"
            );
            for showing in self.showings.iter().filter(|showing| showing.defect.place() == place) {
                let (name, what) = (showing.defect.name(), showing.defect.what());
                let looks = words(showing.objections).join(" | ");
                page += &format!("| `{name}` | {what} | {} | {looks} |\n", self.caught_by(showing));
            }
        }
        let witnesses = self.rows.iter().filter_map(|row| Some((row, row.witness.as_ref()?)));
        page += "\n## Rows with another purpose\n\n| row | only this row tests |\n|---|---|\n";
        for (row, witness) in witnesses {
            page += &format!("| {} | {witness} |\n", row.name);
        }
        format!("{page}\n{}.\n", capitalised(&self.summary()))
    }
}

impl Shown for Report<'_> {
    type Document = VerifyDefects;

    fn text(&self) -> String {
        let mut text = format!("{}\n", self.table());
        for showing in self.uncaught() {
            text +=
                &format!("\n{} is not caught: {}", showing.defect.name(), showing.defect.what());
        }
        for (row, defect) in self.missed() {
            text +=
                &format!("\n{} does not catch {}, although it claims to", row.name, defect.name());
        }
        for row in self.idle() {
            text += &format!(
                "\n{} catches no defect that few other rows catch, and has no `witness`",
                row.name
            );
        }
        text + "\n" + &self.summary()
    }

    fn tables(&self) -> Vec<TextTable> {
        vec![self.table()]
    }

    fn document(&self) -> VerifyDefects {
        let names = |rows: &[&MatrixRow]| rows.iter().map(|row| row.name.clone()).collect();
        let missed =
            |(row, defect): (&MatrixRow, Defect)| [row.name.clone(), defect.name().to_owned()];
        VerifyDefects {
            rows: names(&self.rows),
            every_row: self.whole,
            defects: self.showings.iter().map(Showing::document).collect(),
            uncaught: self.uncaught().map(|it| it.defect.name().to_owned()).collect(),
            missed: self.missed().map(missed).collect(),
            idle: names(&self.idle()),
            provenance: self.provenance.clone(),
        }
    }
}

fn capitalised(text: &str) -> String {
    let (first, rest) = text.split_at(1);
    first.to_uppercase() + rest
}

/// The words for the answers of checks: an objection, no objection, or unknown.
fn words(objections: Objections) -> [String; Check::ALL.len()] {
    objections.0.map(|objects| match objects {
        Some(true) => "objects".to_owned(),
        Some(false) => "content".to_owned(),
        None => "-".to_owned(),
    })
}

/// The text before the tables of the page.
const INTRODUCTION: &str = "\
# Deliberate mistakes

A verification suite must fail if the program has a defect. Each of these mistakes was made in the solver or in the
derivation of b, and rows of the quick [verification matrix](verification.md) were run with it. The
columns on the right are the answers of \"pseudo verification\" to the same runs: `objects` if it finds a fault,
`content` if it finds none, `-` if it cannot tell, or also objects to the correct program.

| check | objects if |
|---|---|
| picture | u differs from the exact solution by more than 10 % on the finest grid |
| bounded | a run stops, or a displacement exceeds the length of the body |
| symmetric | a motion that is its own mirror image loses the symmetry by more than 1e-6 |
| energy | kinetic and strain energy differ from the work of b by more than 5 % |
| settles | half the cell size changes the size of the motion by more than 5 % |

The command is `cargo run --release --features defects -- verify --defects --page > docs/defects.md`.
";
