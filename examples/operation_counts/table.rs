//! The table of operation counts, as a page of Markdown.

use mms_codegen::rust;
use mms_codegen::selection::{Freeze, Selection};
use mms_codegen::{Compiled, compile_with};
use mms_mechanics::Output;
use mms_program::Stage;
use mms_spec::quantity::Quantity;

/// The text above the table.
const HEAD: &str = "\
# Operation counts

The operations of the emitted code of a field, for all quantities and for some. A command writes this
page; a test fails if it is out of date:

```console
$ cargo run --example operation_counts > docs/operation-counts.md
```

One operation is an addition, a subtraction, a multiplication, a division, or a call of a function;
constants, loads and changes of sign are free. The columns are the stages: `parameter` runs once,
`time` once per step, `point` once per particle if its `Point` is kept, `point_time` at every
evaluation. `ln` counts the logarithms among the operations, `lines` is the length of the emitted file,
and `cache` the bytes of a `Point` in double precision. With all quantities, the file also holds the
domain and the material, which the operations do not count.

";

/// The text below the table.
const FOOT: &str = "
* `bar_1d` is in `fields/`, the other files are in `examples/fields/`.
* With the constant `lambda = 0`, b needs no logarithm: W has mu ln J and lambda/2 (ln J)^2, and only the
  second leaves a logarithm in the divergence of P.
* At rest, v and a are the constant 0, and b = -Div P/rho0: no code is emitted for time.
* A field of one dimension computes with scalars: F has one entry, which is J, and its inverse is one
  division.
";

/// A row: a field, and the requested quantities.
struct Row {
    /// The path of the field file.
    path: &'static str,
    /// The quantities; all of them if empty.
    quantities: &'static [Quantity],
    /// The options of the command line that make parameters constants.
    constants: &'static str,
}

const fn row(path: &'static str, quantities: &'static [Quantity], constants: &'static str) -> Row {
    Row { path, quantities, constants }
}

const BAR: &str = "fields/bar_1d.toml";
const WAVE_1D: &str = "examples/fields/standing_wave_1d.toml";
const WAVE_3D: &str = "examples/fields/standing_wave_3d.toml";
const STATIC_3D: &str = "examples/fields/static_3d.toml";
const B: &[Quantity] = &[Quantity::BodyForce];
const MOTION: &[Quantity] = &[Quantity::Velocity, Quantity::Acceleration];
const STRESS: &[Quantity] = &[Quantity::FirstPiolaKirchhoff];

/// The rows, in their order.
const ROWS: &[Row] = &[
    row(BAR, &[], ""),
    row(BAR, B, ""),
    row(BAR, B, "--freeze"),
    row(WAVE_1D, &[], ""),
    row(WAVE_1D, STRESS, ""),
    row(WAVE_1D, B, ""),
    row(WAVE_1D, B, "--set lambda=0 --freeze=lambda"),
    row(WAVE_3D, &[], ""),
    row(WAVE_3D, STRESS, ""),
    row(WAVE_3D, B, ""),
    row(WAVE_3D, B, "--set lambda=0 --freeze=lambda"),
    row(STATIC_3D, &[], ""),
    row(STATIC_3D, MOTION, ""),
    row(STATIC_3D, B, ""),
];

/// The whole page.
pub fn page() -> String {
    let heading = ["field", "quantities", "constants"];
    let counts = ["parameter", "time", "point", "point_time", "all", "ln", "lines", "cache"];
    let rule = heading.map(|_| "---").into_iter().chain(counts.map(|_| "---:")).map(String::from);
    let names = heading.into_iter().chain(counts).map(String::from);
    let lines: Vec<String> = [line(names), line(rule)]
        .into_iter()
        .chain(ROWS.iter().map(|row| line(row.cells().into_iter())))
        .collect();
    format!("{HEAD}{}\n{FOOT}", lines.join("\n"))
}

fn line(cells: impl Iterator<Item = String>) -> String {
    format!("| {} |", cells.collect::<Vec<_>>().join(" | "))
}

impl Row {
    fn name(&self) -> &'static str {
        self.path.rsplit('/').next().unwrap_or(self.path).trim_end_matches(".toml")
    }

    fn selection(&self) -> Selection {
        let wanted =
            (!self.quantities.is_empty()).then(|| self.quantities.iter().copied().collect());
        let mut selection = Selection { quantities: wanted, ..Selection::default() };
        match self.constants {
            "" => {}
            "--freeze" => selection.freeze = Freeze::Everything,
            _ => {
                selection.set = vec![("lambda".into(), "0".into())];
                selection.freeze = Freeze::Only(vec!["lambda".into()]);
            }
        }
        selection
    }

    fn compile(&self) -> Compiled {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(root.join(self.path))
            .unwrap_or_else(|error| panic!("{}: {error}", self.path));
        let load = |file: &str| Err(format!("{file}: these fields use shipped materials"));
        compile_with(self.name(), self.path, &text, &load, &self.selection().into())
            .unwrap_or_else(|failure| panic!("{failure}"))
    }

    fn cells(&self) -> Vec<String> {
        let compiled = self.compile();
        let file = rust::file(&compiled).text;
        let outputs: Vec<Output> = Quantity::ALL
            .iter()
            .filter(|quantity| compiled.selection.wants(**quantity))
            .map(|quantity| Output::Quantity(*quantity))
            .collect();
        let counts = compiled.program.operations(&outputs);
        let stages = Stage::ALL.map(|stage| counts[&stage]);
        let numbers = stages.into_iter().chain([
            stages.iter().sum(),
            logarithms(&compiled, &outputs),
            file.lines().count(),
            rust::point_values(&compiled) * size_of::<f64>(),
        ]);
        let asked: Vec<_> = self.quantities.iter().map(|quantity| quantity.name()).collect();
        let asked = if asked.is_empty() { "all".into() } else { asked.join(", ") };
        let constants =
            if self.constants.is_empty() { "none".into() } else { format!("`{}`", self.constants) };
        [self.name().to_string(), asked, constants]
            .into_iter()
            .chain(numbers.map(|number| number.to_string()))
            .collect()
    }
}

fn logarithms(compiled: &Compiled, outputs: &[Output]) -> usize {
    use mms_program::Op;
    use mms_symbolic::expr::Function;
    let program = &compiled.program;
    let needed = program.needed(outputs);
    let instrs = program.instrs.iter().zip(needed).filter(|(_, needed)| *needed);
    instrs
        .filter(|(instr, _)| matches!(instr.op, Op::Unary(Function::Ln | Function::Ln1p, ..)))
        .count()
}
