//! A table, and its views: columns for a terminal, CSV, Markdown and LaTeX.

use std::fmt;

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table as Columns};

/// The head of a column of orders, each from the mesh in the row above.
pub const PAIR: &str = "order to prev";

/// The head of a column of orders that are fitted to all meshes.
pub const FITTED: &str = "fitted order";

/// A table of texts.
#[derive(Clone)]
pub struct TextTable {
    /// The caption, which all views except the terminal show.
    caption: String,
    header: Vec<String>,
    rows: Vec<Vec<String>>,
    /// The columns that are aligned to the right.
    right: Vec<usize>,
    /// Whether the first cell of each row is a row of its own in LaTeX, whose columns are narrow.
    is_first_apart: bool,
}

impl TextTable {
    /// A table without rows.
    pub fn new<S: Into<String>>(
        caption: impl Into<String>,
        header: impl IntoIterator<Item = S>,
    ) -> Self {
        let header = header.into_iter().map(Into::into).collect();
        let caption = caption.into();
        TextTable { caption, header, rows: Vec::new(), right: Vec::new(), is_first_apart: false }
    }

    /// Adds a row with a cell for each column.
    pub fn add_row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// The table with some columns aligned to the right.
    pub fn right(mut self, columns: impl IntoIterator<Item = usize>) -> Self {
        self.right = columns.into_iter().collect();
        self
    }

    /// The table with all columns from one on aligned to the right.
    pub fn right_from(self, first: usize) -> Self {
        let count = self.header.len();
        self.right(first..count)
    }

    /// The table with the first cell of each row in a row of its own in LaTeX, so that it fits a column of a paper.
    pub fn first_apart(mut self) -> Self {
        self.is_first_apart = true;
        self
    }

    /// The table with another caption in front of its own, as the name of one of several parts.
    pub fn of(mut self, part: &str) -> Self {
        self.caption = format!("{part}: {}", self.caption);
        self
    }

    /// The table as CSV, below a line with its caption that begins with `#`.
    ///
    /// # Errors
    /// A row that cannot be written.
    pub fn csv(&self) -> anyhow::Result<String> {
        let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
        // A column of marks has no head on a terminal.
        let name = |head: &String| if head.is_empty() { "remark".into() } else { head.clone() };
        writer.write_record(self.header.iter().map(name))?;
        for row in &self.rows {
            writer.write_record(row)?;
        }
        let caption = self.caption.replace(['\n', '\r'], " ");
        Ok(format!("# {caption}\n{}", String::from_utf8(writer.into_inner()?)?))
    }

    /// The table as GitHub and GitLab show it, below its caption in bold.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<_> = cells.iter().map(|cell| markdown(cell)).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = |at: usize| if self.right.contains(&at) { "---:" } else { "---" };
        let rules: Vec<&str> = (0..self.header.len()).map(rule).collect();
        let mut text = format!("**{}**\n\n{}", markdown(&self.caption), line(&self.header));
        text += &format!("| {} |\n", rules.join(" | "));
        self.rows.iter().for_each(|row| text += &line(row));
        text
    }

    /// The table as LaTeX sets it with the package booktabs.
    pub fn latex(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<_> = cells.iter().map(|cell| latex(cell)).collect();
            format!("    {} \\\\\n", cells.join(" & "))
        };
        let align = |at: usize| if self.right.contains(&at) { 'r' } else { 'l' };
        let first = usize::from(self.is_first_apart);
        let count = self.header.len() - first;
        let aligned: String = (first..self.header.len()).map(align).collect();
        let row = |cells: &Vec<String>| {
            let head = cells
                .first()
                .filter(|_| self.is_first_apart)
                .map(|name| format!("    \\multicolumn{{{count}}}{{l}}{{{}}} \\\\\n", latex(name)));
            head.unwrap_or_default() + &line(&cells[first..])
        };
        let rows: Vec<String> = self.rows.iter().map(row).collect();
        let rows = rows.join(if self.is_first_apart { "    \\addlinespace\n" } else { "" });
        let small = match self.is_first_apart {
            true => "  \\footnotesize\n  \\setlength{\\tabcolsep}{3pt}\n",
            false => "",
        };
        format!(
            "\\begin{{table}}\n  \\centering\n  \\caption{{{}}}\n{small}  \\begin{{tabular}}{{{aligned}}}\n    \\toprule\n{}    \
             \\midrule\n{rows}    \\bottomrule\n  \\end{{tabular}}\n\\end{{table}}\n",
            latex(&self.caption),
            line(&self.header[first..])
        )
    }
}

impl fmt::Display for TextTable {
    /// Columns for a terminal.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut columns = Columns::new();
        columns.load_style(NOTHING).set_header(&self.header);
        for row in &self.rows {
            columns.add_row(row);
        }
        for &at in &self.right {
            if let Some(column) = columns.column_mut(at) {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        columns.fmt(f)
    }
}

/// A text in a cell of Markdown.
fn markdown(text: &str) -> String {
    let mut cell = String::new();
    for c in text.chars() {
        match c {
            '\n' | '\r' => cell.push(' '),
            '|' | '*' | '_' | '`' | '<' | '[' | '\\' => cell.extend(['\\', c]),
            _ => cell.push(c),
        }
    }
    cell
}

/// A text in a cell of LaTeX. Numbers in scientific notation become powers of ten.
fn latex(text: &str) -> String {
    if let Some((digits, exponent)) = scientific(text) {
        return format!("${digits}\\times10^{{{exponent}}}$");
    }
    let mut cell = String::new();
    for c in text.chars() {
        match c {
            '\n' | '\r' => cell.push(' '),
            '#' | '$' | '%' | '&' | '_' | '{' | '}' => cell.extend(['\\', c]),
            '\\' => cell += "\\textbackslash{}",
            '~' => cell += "\\textasciitilde{}",
            '^' => cell += "\\textasciicircum{}",
            '<' => cell += "\\textless{}",
            '>' => cell += "\\textgreater{}",
            _ => cell.push(c),
        }
    }
    cell
}

/// The digits and the exponent of a number in scientific notation.
fn scientific(text: &str) -> Option<(&str, i32)> {
    let (digits, exponent) = text.split_once('e')?;
    digits.parse::<f64>().ok()?;
    Some((digits, exponent.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> TextTable {
        let mut table = TextTable::new("errors of bar_1d", ["quantity", "l2", ""]).right([1]);
        table.add_row(["u_x", "1.25e-3", "a | b, 5 %"]);
        table.add_row(["~F", "-", ""]);
        table
    }

    #[test]
    fn each_view_keeps_what_its_language_would_read_otherwise() {
        let table = table();
        let csv = "# errors of bar_1d\nquantity,l2,remark\nu_x,1.25e-3,\"a | b, 5 %\"\n~F,-,\n";
        assert_eq!(table.csv().unwrap(), csv);
        assert_eq!(
            table.markdown(),
            "**errors of bar\\_1d**\n\n| quantity | l2 |  |\n| --- | ---: | --- |\n| u\\_x | 1.25e-3 | a \\| b, 5 % |\n\
             | ~F | - |  |\n"
        );
        let latex = table.latex();
        assert!(
            latex.contains("\\caption{errors of bar\\_1d}\n  \\begin{tabular}{lrl}"),
            "{latex}"
        );
        let row =
            "u\\_x & $1.25\\times10^{-3}$ & a | b, 5 \\% \\\\\n    \\textasciitilde{}F & - &  \\\\";
        assert!(latex.contains(row), "{latex}");
        assert_eq!(table.to_string().lines().count(), 3);
    }

    #[test]
    fn a_long_first_cell_is_a_row_of_its_own() {
        let latex = table().first_apart().latex();
        assert!(latex.contains("\\begin{tabular}{rl}\n    \\toprule\n    l2 &  \\\\"), "{latex}");
        assert!(latex.contains("    \\multicolumn{2}{l}{u\\_x} \\\\\n    $1.25"), "{latex}");
    }

    #[test]
    fn words_with_an_e_are_no_numbers() {
        for text in ["exact", "1e", "e5", "2e3x", "infe3x"] {
            assert_eq!(latex(text), text);
        }
        assert_eq!(latex("-2e-16"), "$-2\\times10^{-16}$");
    }
}
