//! The cost of a variant: operations, machine code and time.

use std::path::Path;

use anyhow::{Context as _, anyhow};
use mms_codegen::selection::{Freeze, Selection};
use mms_codegen::{Compiled, compile_with};
use mms_lab::workbench::{self, Module, ModuleForm, Time, Workbench};
use mms_mechanics::Output;
use mms_program::Stage;
use mms_spec::quantity::Quantity;
use object::{Object as _, ObjectSection as _, SectionKind};

use super::table::{Table, Variant};

/// The number of operations to compute every quantity of a variant at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Operations {
    /// All operations.
    pub all: usize,
    /// The operations that depend on X.
    pub of_position: usize,
}

/// A variant that is ready to be measured.
pub struct Subject {
    variant: Variant,
    compiled: Compiled,
}

impl Subject {
    /// Compiles the field of a variant.
    pub fn new(variant: Variant) -> anyhow::Result<Self> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(root.join(variant.path)).context(variant.path)?;
        let selection = Selection {
            quantities: variant.quantities().map(|wanted| wanted.iter().copied().collect()),
            freeze: if variant.is_frozen { Freeze::Everything } else { Freeze::Nothing },
            ..Selection::default()
        };
        let load = |file: &str| Err(format!("{file}: these fields use shipped materials"));
        let compiled = compile_with(variant.field(), variant.path, &text, &load, &selection.into())
            .map_err(|failure| anyhow!("{failure}"))?;
        Ok(Subject { variant, compiled })
    }

    /// The operations of every evaluation. Each quantity is a call: both of two quantities compute the operations that
    /// they share, except those without X.
    pub fn operations(&self) -> Operations {
        let program = &self.compiled.program;
        let outputs: Vec<Output> = Quantity::ALL
            .iter()
            .filter(|quantity| self.compiled.selection.wants(**quantity))
            .map(|quantity| Output::Quantity(*quantity))
            .collect();
        let shared = program.operations(&outputs);
        let of_position = outputs.iter().map(|output| {
            let counts = program.operations(&[*output]);
            let at_point = if self.variant.is_kept { 0 } else { counts[&Stage::Point] };
            at_point + counts[&Stage::PointTime]
        });
        let of_position = of_position.sum();
        Operations {
            all: shared[&Stage::Parameter] + shared[&Stage::Time] + of_position,
            of_position,
        }
    }

    /// The functions to call for one point, and for many.
    fn ways(&self) -> [ModuleForm; 2] {
        match self.variant.is_kept {
            false => [ModuleForm::Single, ModuleForm::Batch],
            true => [ModuleForm::SingleKept, ModuleForm::BatchKept],
        }
    }

    /// The bytes of machine code for one point, and for many.
    pub fn bytes(&self, bench: &Workbench) -> anyhow::Result<[usize; 2]> {
        let module = Module { name: "subject", compiled: &self.compiled };
        let [one, many] = self.ways().map(|way| {
            machine_code(&workbench::object(bench, &module, self.variant.precision, way)?)
        });
        Ok([one?, many?])
    }

    /// The nanoseconds per point, one by one and for many, summed over all quantities.
    fn time(&self, times: &[Time], name: &str) -> [f64; 2] {
        self.ways().map(|way| {
            let own = times.iter().filter(|time| {
                time.module == name && time.precision == self.variant.precision && time.way == way
            });
            own.map(|time| time.ns_per_point).sum()
        })
    }
}

/// The bytes of all instructions in an object file.
fn machine_code(file: &[u8]) -> anyhow::Result<usize> {
    let file = object::File::parse(file)?;
    let code = file.sections().filter(|section| section.kind() == SectionKind::Text);
    Ok(code.map(|section| section.size() as usize).sum())
}

/// The variants of a table, pair by pair.
pub fn subjects(table: &Table) -> anyhow::Result<Vec<[Subject; 2]>> {
    let pairs = table
        .pairs
        .iter()
        .map(|[more, less]| anyhow::Ok([Subject::new(*more)?, Subject::new(*less)?]));
    pairs.collect()
}

/// Measures the nanoseconds per point of these variants, which take turns.
pub fn times(bench: &Workbench, pairs: &[[Subject; 2]]) -> anyhow::Result<Vec<[[f64; 2]; 2]>> {
    let subjects: Vec<&Subject> = pairs.iter().flatten().collect();
    let names: Vec<String> = (0..subjects.len()).map(|index| format!("subject_{index}")).collect();
    let modules: Vec<Module<'_>> = names
        .iter()
        .zip(&subjects)
        .map(|(name, subject)| Module { name, compiled: &subject.compiled })
        .collect();
    let mut ways = Vec::new();
    for subject in &subjects {
        let own = subject.ways().map(|way| (subject.variant.precision, way));
        ways.extend(own.into_iter().filter(|way| !ways.contains(way)).collect::<Vec<_>>());
    }
    let times = workbench::time(bench, &modules, &ways)?;
    let of_each: Vec<[f64; 2]> =
        names.iter().zip(subjects).map(|(name, subject)| subject.time(&times, name)).collect();
    Ok(of_each.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect())
}
