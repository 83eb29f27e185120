//! The tables, as a page of Markdown.

use mms_lab::workbench::Workbench;

use super::cost::{Subject, subjects, times};
use super::table::{TABLES, Table, Variant};

/// The text above the tables.
const HEAD: &str = "\
# Model only what a scene requires

The cost of a field for a scene that uses all of it, and for a scene that uses a part. A command writes
this page; a test fails if the operations are out of date, or if a part of a field takes more operations
or more code than the whole:

```console
$ cargo run --release --example scene > docs/scene.md
```

* Operations are additions, subtractions, multiplications, divisions and calls of functions, from
  parameters, time and position to the result. Each quantity is a separate call. If two quantities share
  operations, the shared operations with X run in both calls, the others once.
  [operation-counts.md](operation-counts.md) has the stages.
* Bytes count the instructions in an object file (COMPILER, ARCHITECTURE) with `prepare`,
  `at_time`, a function for each quantity, and the functions that these need: for one point, or for many,
  with loops for AVX-512, for AVX2 and for everything else. Constants and functions compiled with
  `mms-math` are not counted.
* Times are nanoseconds per point, one by one and 4096 at once. They are medians of rounds in which all
  rows of a table take turns. Compare them only within a table.

Numbers in parentheses are ratios to the number above.
";

/// The heading of every table.
pub const COLUMNS: &str = "\
| field | | operations | that depend on X | bytes, one point | bytes, many points | ns, one by one | ns, many at once |
|---|---|---:|---:|---:|---:|---:|---:|
";

/// The whole page; calls `progress` with the title of each table before measuring it.
pub fn page(progress: impl Fn(&str)) -> anyhow::Result<String> {
    let bench = Workbench::open()?;
    let mut page =
        HEAD.replace("COMPILER", bench.compiler()).replace("ARCHITECTURE", std::env::consts::ARCH);
    for table in TABLES {
        progress(table.title);
        page += &section(&bench, table)?;
    }
    Ok(page)
}

fn section(bench: &Workbench, table: &Table) -> anyhow::Result<String> {
    let pairs = subjects(table)?;
    let times = times(bench, &pairs)?;
    let mut rows = String::new();
    for ((variants, subjects), times) in table.pairs.iter().zip(&pairs).zip(times) {
        let bytes = [subjects[0].bytes(bench)?, subjects[1].bytes(bench)?];
        for index in 0..2 {
            let sizes = [0, 1].map(|way| part(bytes[index][way], bytes[0][way], index));
            let nanoseconds = [0, 1].map(|way| {
                let [time, whole] = [times[index][way], times[0][way]];
                format!("{time:.2}{}", share(time, whole, index))
            });
            rows += &counted(variants, subjects, index);
            rows += &format!(" {} | {} |\n", sizes.join(" | "), nanoseconds.join(" | "));
        }
    }
    let Table { title, about, conclusion, .. } = table;
    Ok(format!("\n## {title}\n\n{about}\n\n{COLUMNS}{rows}\n{conclusion}\n"))
}

/// The cells of a row that do not depend on the machine.
pub fn counted(variants: &[Variant; 2], subjects: &[Subject; 2], index: usize) -> String {
    let [whole, own] = [subjects[0].operations(), subjects[index].operations()];
    let all = part(own.all, whole.all, index);
    let of_position = part(own.of_position, whole.of_position, index);
    let Variant { name, .. } = variants[index];
    format!("| {} | {name} | {all} | {of_position} |", variants[index].field())
}

/// A number, with its ratio to the number in the row above.
fn part(number: usize, whole: usize, row: usize) -> String {
    format!("{number}{}", share(number as f64, whole as f64, row))
}

fn share(number: f64, whole: f64, row: usize) -> String {
    if row == 0 { String::new() } else { format!(" ({:.2})", number / whole) }
}
