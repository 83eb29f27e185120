//! The shipped fields: the folder `fields/` is the list.

use mms_codegen::compile::Failure;
use mms_codegen::materials::MATERIALS;
use mms_codegen::{Compiled, Options};
use mms_mechanics::Model;
use mms_spec::source::Sources;
use mms_spec::{
    FieldSpec, MaterialSpec, moduli, own_quantities, read_field, read_material, settle_checks,
};
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// A shipped field.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The name: the stem of its file.
    pub name: &'static str,
    /// The path of its file, relative to the manifest.
    pub path: &'static str,
    /// The text of its file.
    pub text: &'static str,
    /// The text of its material's file, where the field brings its own.
    pub material: Option<&'static str>,
}

/// The shipped fields, in the order of their names.
pub const FIELDS: &[Entry] = include!(concat!(env!("OUT_DIR"), "/fields.rs"));

impl Entry {
    /// Compiles the text again, for data that the generated module does not contain.
    pub fn compile(&self) -> Result<Compiled, Failure> {
        self.compile_with(&Options::default())
    }

    /// Compiles a part of the text, the text with some parameters fixed, or within other limits.
    pub fn compile_with(&self, options: &Options) -> Result<Compiled, Failure> {
        let load = |_: &str| self.own_material();
        mms_codegen::compile_with(self.name, self.path, self.text, &load, options)
    }

    /// The text of its material's file; an error if it has none.
    pub fn own_material(&self) -> Result<String, String> {
        self.material.map(str::to_string).ok_or_else(|| "not part of the gallery".into())
    }
}

/// The field of that name.
pub fn find(name: &str) -> Option<&'static Entry> {
    FIELDS.iter().find(|entry| entry.name == name)
}

/// The parsed files of the shipped fields, in the order of their names. Nothing is derived.
pub fn fields() -> Vec<FieldSpec> {
    let mut sources = Sources::default();
    let fields = FIELDS.iter().filter_map(|entry| {
        let source = sources.add(entry.path, entry.text);
        read_field(&sources, source, entry.name, &mut Vec::new())
    });
    fields.collect()
}

/// The start of a motion, in a few words: unless a formula says that u or v is 0 at the first time, it is not. `None` for a
/// field with mistakes.
pub fn start(field: &FieldSpec, material: &MaterialSpec) -> Option<&'static str> {
    let (mut field, mut material) = (field.clone(), material.clone());
    let mistakes = &mut Vec::new();
    field.material.tell_givens(&material);
    moduli::convert(&mut Sources::default(), &field, &mut material, mistakes);
    let own = own_quantities(&field, Some(&material));
    settle_checks(&mut field, &own, mistakes);
    let mut graph = Graph::default();
    let model = Model::resolve(&mut graph, &field, Some(&material), mistakes)?;
    if field.is_static() {
        return Some("static");
    }
    let velocity = differentiate(&mut graph, &model.displacement, Symbol::Time);
    let first = SortedMap::from([(Symbol::Time, model.domain.time[0])]);
    let mut vanishes = |components: &[Expr]| {
        let first = substitute(&mut graph, components, &first);
        first.iter().all(|component| graph.is_zero(*component))
    };
    Some(match [&model.displacement, &velocity].map(|it| vanishes(it)) {
        [true, true] => "undeformed, at rest",
        [true, false] => "undeformed, moving",
        [false, true] => "deformed, at rest",
        [false, false] => "deformed, moving",
    })
}

/// The shipped materials, read, in the order of their names.
pub fn materials() -> Vec<MaterialSpec> {
    let mut sources = Sources::default();
    let materials = MATERIALS.iter().filter_map(|(stem, text)| {
        let source = sources.add(format!("materials/{stem}.toml"), *text);
        read_material(&sources, source, stem, &mut Vec::new())
    });
    materials.collect()
}
