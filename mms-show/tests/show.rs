//! Tests of the displayed derivation: it is right, it can be read, and every notation is well formed. The reference is the
//! program that is compiled from the expanded derivation.

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use mms_analysis::visibility::Visibility;
use mms_codegen::{Compiled, Selection, compile, compile_with};
use mms_mechanics::resolve::Scope;
use mms_mechanics::sample::samples;
use mms_mechanics::{Output, Program};
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_program::schedule::schedule;
use mms_show::language::Language;
use mms_show::{DERIVATION, Document, Line, latex, mathml, text};
use mms_spec::Formula;
use mms_spec::quantity::Quantity;
use mms_spec::source::Sources;
use mms_spec::syntax;
use mms_symbolic::expr::{Expr, Graph, Rational, Symbol};

use crate::sampled::{all_is_tried, sampled};

/// Lines of text are about a hundred characters long, and no longer.
const LINE: usize = 105;

/// A material that is a function of I1, I2, I3 and J, with definitions of its own.
const MOONEY: &str = r#"
[material]
title = "compressible Mooney-Rivlin"
strain_energy = "c1*(I1 - 3) + c2*(I2 - 3) - d*ln(J) + bulk/4*(I3 - 1)^2"

[parameters]
c1   = { unit = "Pa" }
c2   = { unit = "Pa" }
bulk = { unit = "Pa" }

[let]
d = "2*c1 + 4*c2"
"#;

/// An axisymmetric field of two components, at small strain.
const NO_SWIRL: &str = r#"
[field]
title       = "a tube"
dimension   = 2
coordinates = "axisymmetric"

[displacement]
u = ["0.01*R*sin(Z + t)*exp(R)", "0.01*R^2*Z*cos(t)"]

[material]
model   = "linear_elastic"
lambda  = "3 + R*Z"
mu      = "2 + R"
density = "2 + Z"

[domain]
shape = "box"
lower = [0.5, 0]
upper = [1, 1]
time  = [0, 1]

[boundary]
r_min = "traction"
"#;

fn compiled(name: &str, text: &str) -> Compiled {
    let load = |path: &str| match path {
        "./mooney.toml" => Ok(MOONEY.to_string()),
        other => Err(format!("{other}: no such material here")),
    };
    compile(name, &format!("{name}.toml"), text, &load)
        .unwrap_or_else(|failure| panic!("{failure}"))
}

fn pass(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../mms-codegen/tests/data/pass");
    fs::read_to_string(folder.join(name)).expect("a file of tests/data/pass")
}

/// The field with another material in the place of its neo-Hookean one.
fn with_material(text: &str, material: &str) -> String {
    let replaced = |line: &str| !line.starts_with("lambda  =") && !line.starts_with("mu      =");
    let lines: Vec<_> = text.lines().filter(|line| replaced(line)).collect();
    lines.join("\n").replace("model   = \"neo_hookean\"", material)
}

fn with_mooney(text: &str, moduli: [&str; 3]) -> String {
    let [c1, c2, bulk] = moduli;
    let material =
        format!("model = \"./mooney.toml\"\nc1 = \"{c1}\"\nc2 = \"{c2}\"\nbulk = \"{bulk}\"");
    with_material(text, &material)
}

/// Materials that are more than functions of I1, I2 and J.
const OTHERS: [(&str, &str); 2] = [
    (
        "fibres",
        "model = \"transversely_isotropic\"\nyoung = \"young\"\nnu = 0.3\n\
         reinforcement = \"young\"\nfibre = [\"4/5*cos(X/length)\", \"4/5*sin(X/length)\", 0.6]",
    ),
    ("linear", "model = \"linear_elastic\"\nyoung = \"young*(1 + X/length)\"\nnu = 0.3"),
];

/// Fields of every dimension and kind, each with its name.
static FIELDS: LazyLock<Vec<Compiled>> =
    LazyLock::new(|| texts().iter().map(|(name, text)| compiled(name, text)).collect());

/// The document of each field, with the terms that it sees.
static WHOLE: LazyLock<Vec<Document>> = LazyLock::new(|| FIELDS.iter().map(whole).collect());

/// The name and the text of each.
fn texts() -> Vec<(String, String)> {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fields");
    let mut fields = Vec::new();
    let mut paths: Vec<_> = fs::read_dir(gallery)
        .expect("fields/")
        .map(|entry| entry.expect("an entry of fields/").path())
        .collect();
    paths.sort();
    for path in sampled(paths, 8) {
        let name = path.file_stem().expect("a stem").to_string_lossy().into_owned();
        fields.push((name, fs::read_to_string(&path).expect("a field")));
    }
    for name in ["rotating_2d", "sines_3d", "graded_2d", "twin_2d", "twin_3d"] {
        fields.push((name.into(), pass(&format!("{name}.toml"))));
    }
    fields.push(("units_axisymmetric".into(), pass("units_axisymmetric.toml")));
    fields.push(("no_swirl".into(), NO_SWIRL.into()));
    let moduli = ["mu/2", "mu/5 + lambda/9", "lambda*(3 + X/width)"];
    fields.push(("mooney_2d".into(), with_mooney(&pass("rotating_2d.toml"), moduli)));
    let moduli = ["young/8", "young/20", "young*nu*(1 + X*Z/length^2)"];
    fields.push(("mooney_3d".into(), with_mooney(&pass("sines_3d.toml"), moduli)));
    let bar = include_str!("../../fields/bar_1d.toml");
    let moduli = ["young/8", "young/20*(1 + X/length)", "young"];
    let bar = bar.replace("lambda  = \"0\"\nmu      = \"young/2\"\n", "");
    fields.push(("mooney_1d".into(), with_mooney(&bar, moduli)));
    for (name, material) in OTHERS {
        for text in [pass("sines_3d.toml"), bar.clone()] {
            fields.push((name.into(), with_material(&text, material)));
        }
    }
    let odd_names = include_str!("../../tests/programs/odd_names.toml");
    fields.push(("odd_names".into(), odd_names.into()));
    fields
}

fn document(field: &Compiled) -> Document {
    Document::new(field, Quantity::ALL).expect("a derivation of usual size")
}

/// The document with the terms that the field sees.
fn whole(field: &Compiled) -> Document {
    let mut document = document(field);
    document.visibility = Some(Visibility::of(field).expect("terms of usual size"));
    document
}

/// Reads formulas one after the other; each name becomes a further parameter.
struct Reader {
    graph: Graph,
    scope: Scope,
    parameters: usize,
}

impl Reader {
    fn new(field: &Compiled) -> Self {
        let mut reader = Reader { graph: Graph::default(), scope: Scope::default(), parameters: 0 };
        let axes = field.field.space.axes().iter().copied().take(field.field.dimension).enumerate();
        let axes = axes.map(|(axis, name)| (name, Symbol::Coordinate(axis)));
        for (name, symbol) in axes.chain([("t", Symbol::Time)]) {
            let leaf = reader.graph.symbol(symbol);
            reader.scope.define(name, Some(leaf));
        }
        let pi = reader.graph.pi();
        reader.scope.define("pi", Some(pi));
        field.model.parameters.iter().for_each(|parameter| reader.define(&parameter.name));
        reader
    }

    fn define(&mut self, name: &str) {
        let symbol = Symbol::Parameter(self.parameters);
        self.parameters += 1;
        let leaf = self.graph.symbol(symbol);
        self.scope.assume_positive(symbol);
        self.scope.define(name, Some(leaf));
    }

    fn program(&mut self, text: &str) -> Program {
        let mut sources = Sources::default();
        let source = sources.add("shown", text);
        let formula = Formula::plain(text, sources.span(source, 0, text.len()));
        let mut diagnostics = Vec::new();
        let ast = syntax::parse(&formula, &mut diagnostics);
        let value: Option<Expr> =
            ast.and_then(|ast| self.scope.resolve(&mut self.graph, &ast, &mut diagnostics));
        let value = value.unwrap_or_else(|| panic!("{text}: {diagnostics:?}"));
        schedule(&self.graph, &[(Output::Expected(0), vec![value])].into())
    }
}

/// A document's lines, with where the components of quantities begin.
fn lines(document: &Document) -> Vec<(Option<(Quantity, usize)>, &Line)> {
    let mut lines: Vec<_> = document.definitions.iter().map(|line| (None, line)).collect();
    lines.extend(document.material.whereby.iter().map(|line| (None, line)));
    for section in &document.sections {
        lines.extend(section.whereby.iter().map(|line| (None, line)));
        let components = section.components.iter().enumerate();
        lines.extend(components.map(|(k, line)| (Some((section.quantity, k)), line)));
    }
    lines
}

/// A displayed line, read as a user reads it.
struct Reading {
    component: Option<(Quantity, usize)>,
    name: String,
    text: String,
    program: Program,
}

/// The lines of a document; each may use the names before it, and the components of the normal are names as well.
fn readings(field: &Compiled, document: &Document) -> Vec<Reading> {
    let mut reader = Reader::new(field);
    let dimension = field.field.dimension;
    for axis in 1..=dimension {
        reader.define(&if dimension == 1 { "N".into() } else { format!("N_{axis}") });
    }
    let read = |(component, line): (_, &Line)| {
        let text = document.formula(line.value, &Language);
        let program = reader.program(&text);
        let name = line.left[0].identifier();
        reader.define(&name);
        Reading { component, name, text, program }
    };
    lines(document).into_iter().map(read).collect()
}

/// Every displayed line evaluates to the program's value, at `points` points.
fn assert_shown_is_computed(field: &Compiled, document: &Document, points: usize) {
    let readings = readings(field, document);
    let parameters = field.parameters::<Precise>(&Default::default());
    let normal: Vec<Precise> = (0..field.field.dimension).map(fifths).collect();
    let mut program = Interpreter::new(&field.program, &parameters);
    let sections = document.sections.iter();
    let outputs: Vec<_> = sections.map(|section| Output::Quantity(section.quantity)).collect();
    let plan = program.plan(&outputs);
    for sample in samples(&field.program, &parameters, points) {
        program.set_time(&sample.time);
        let coordinates = &sample.coordinates;
        program.set_point(&plan, Point { coordinates, normal: &normal, gradient: &[] });
        let mut values = [&parameters[..], &normal].concat();
        for reading in &readings {
            let mut interpreter = Interpreter::new(&reading.program, &values);
            let plan = interpreter.plan(&[Output::Expected(0)]);
            interpreter.set_time(&sample.time);
            interpreter.set_point(&plan, Point::at(coordinates));
            let value = interpreter.output(Output::Expected(0)).remove(0);
            if let Some((quantity, k)) = reading.component {
                let computed = program.output(Output::Quantity(quantity));
                reading.assert_is(field.field.name.raw(), &value, &computed, k);
            }
            values.push(value);
        }
    }
}

impl Reading {
    /// Asserts that a value equals component `k` of a computed quantity.
    fn assert_is(&self, field: &str, value: &Precise, computed: &[Precise], k: usize) {
        let Reading { name, text, .. } = self;
        assert!(computed.iter().all(Precise::is_defined), "{field}: {name}");
        let one = Precise::new(&Rational::ONE);
        let scale = computed.iter().fold(one, |sum, value| sum + value.clone().magnitude());
        let difference = (value.clone() - computed[k].clone()).magnitude();
        assert!(
            difference.at_most(&(scale * tolerance())),
            "{field}: {name} = {text} is {:e}, not {:e}",
            value.to_f64(),
            computed[k].to_f64()
        );
    }
}

/// 1e-30: both sides are computed with 77 digits.
fn tolerance() -> Precise {
    let tenth = Precise::new(&Rational::from_parts(1.into(), 10_u8.into()));
    (0..30).fold(Precise::new(&Rational::ONE), |power, _| power * tenth.clone())
}

/// A component of a vector that is normal to nothing in particular.
fn fifths(axis: usize) -> Precise {
    let numerator: i32 = [3, 4, 2][axis];
    Precise::new(&Rational::from_parts(numerator.into(), 5_u8.into()))
}

#[test]
fn what_is_shown_is_what_is_computed() {
    for field in FIELDS.iter() {
        assert_shown_is_computed(field, &document(field), 5);
    }
}

#[test]
fn what_is_asked_for_alone_comes_with_all_that_it_uses() {
    for field in sampled(FIELDS.iter(), 3) {
        for quantity in Quantity::ALL {
            let document = Document::new(field, &[*quantity]).expect("a usual size");
            assert_eq!(document.sections.len(), 1);
            assert_shown_is_computed(field, &document, 2);
        }
    }
}

#[test]
fn lines_of_text_are_short() {
    for document in WHOLE.iter() {
        for line in text::page(document).lines() {
            // A line with a name of a hundred letters cannot be short.
            let is_name = |letter: char| letter.is_alphanumeric() || letter == '_';
            let words = line.split(|letter: char| !is_name(letter));
            if words.map(|word| word.chars().count()).max() > Some(80) {
                continue;
            }
            let length = line.chars().count();
            assert!(length <= LINE, "{}: {length} characters: {line}", document.name.shown());
        }
    }
}

/// The quantities that are derived for a heavy field.
const WANTED: [Quantity; 3] = [Quantity::Displacement, Quantity::Velocity, Quantity::BodyForce];

/// A displacement of many terms, deep nesting, and long numbers.
fn heavy(displacement: &str) -> Compiled {
    let text = format!(
        r#"
        [field]
        title = "heavy"
        dimension = 1
        [displacement]
        u = ["{displacement}"]
        [material]
        model = "neo_hookean"
        lambda = "1"
        mu = "1"
        density = "1"
        [domain]
        shape = "box"
        lower = ["0"]
        upper = ["1"]
        time = ["0", "1"]
        "#
    );
    let selection = Selection { quantities: Some(WANTED.into()), ..Selection::default() };
    compile_with("heavy", "heavy.toml", &text, &|path| Err(path.into()), &selection.into())
        .unwrap_or_else(|failure| panic!("{failure}"))
}

/// A parameter of the material may have the name of the field's parameter that it equals.
#[test]
fn no_line_says_that_a_name_is_itself() {
    let mut namesakes = 0;
    for document in WHOLE.iter() {
        let arguments = &document.material.arguments;
        namesakes += arguments.iter().filter(|line| document.is_identity(line)).count();
        for line in text::page(document).lines() {
            let Some((left, right)) = line.split_once(" = ") else { continue };
            assert_ne!(left.trim(), right.trim(), "{}: {line}", document.name.shown());
        }
    }
    assert!(namesakes > 0, "a test without such a name");
}

#[test]
fn operations_of_all_stages_are_told_and_whole_exponents_raised() {
    for document in WHOLE.iter() {
        let page = text::page(document);
        for (stage, count) in document.sections.iter().flat_map(|section| &section.operations) {
            assert!(
                page.contains(&format!("{count} {}", stage.name())),
                "{}: {page}",
                document.name.shown()
            );
        }
        assert!(!page.contains("^(2)"), "{}: {page}", document.name.shown());
    }
}

#[test]
fn a_wall_is_broken_into_lines() {
    let part = if all_is_tried() { 1 } else { 2 };
    let terms: Vec<_> =
        (1..150 / part).map(|k| format!("sin({k}*X + t)/{}", 1000 + k * k)).collect();
    let nested = (0..30 / part).fold("X".to_string(), |inside, _| format!("sin({inside} + t)/2"));
    let product: Vec<_> = (1..40 / part).map(|k| format!("(2 + sin(X/{k} + t))/3")).collect();
    for displacement in [terms.join(" + "), nested, product.join("*")] {
        let field = heavy(&displacement);
        let document = Document::new(&field, &WANTED).expect("within the bound");
        for line in text::page(&document).lines() {
            let length = line.chars().count();
            assert!(length <= LINE, "{length} characters: {line}");
        }
        assert_shown_is_computed(&field, &document, if all_is_tried() { 5 } else { 2 });
    }
}

#[test]
fn equal_input_gives_equal_pages() {
    for (a, (name, text)) in sampled(FIELDS.iter().zip(texts()), 4) {
        let (a, b) = (document(a), document(&compiled(&name, &text)));
        assert_eq!(text::page(&a), text::page(&b));
        assert_eq!(latex::page(&a), latex::page(&b));
        assert_eq!(mathml::page(&a), mathml::page(&b));
    }
}

/// Asserts that braces, environments, displays and stretched parentheses are closed as they were
/// opened, and that no other character has a meaning outside a formula.
fn assert_balanced(page: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = page;
    while let Some(at) = rest.find(['\\', '{', '}', '$', '#', '%', '&', '_', '^', '~']) {
        rest = &rest[at..];
        let in_formula = open.iter().any(|open| ["[", "align*"].contains(open));
        let length = match &rest[..1] {
            "\\" => command(&rest[1..], &mut open),
            "{" => {
                open.push("{");
                1
            }
            "}" => {
                assert_eq!(open.pop(), Some("{"), "{rest:.60}");
                1
            }
            "&" | "_" | "^" if in_formula => 1,
            other => panic!("`{other}` is not escaped: {rest:.60}"),
        };
        rest = &rest[length..];
    }
    assert!(open.is_empty(), "not closed: {open:?}");
}

/// Follows a command, given without its backslash; returns the length of all of it.
fn command<'a>(text: &'a str, open: &mut Vec<&'a str>) -> usize {
    let letters = text.find(|next: char| !next.is_ascii_alphabetic()).expect("an end");
    let name = &text[..letters.max(1)];
    match name {
        "begin" | "end" => {
            let argument = &text[letters + 1..][..text[letters + 1..].find('}').expect("`}`")];
            match name {
                "begin" => open.push(argument),
                _ => assert_eq!(open.pop(), Some(argument)),
            }
            return 1 + name.len() + argument.len() + 2;
        }
        "left" => open.push("left"),
        "right" => assert_eq!(open.pop(), Some("left"), "{text:.60}"),
        "[" => open.push("["),
        "]" => assert_eq!(open.pop(), Some("[")),
        _ => {}
    }
    1 + name.len()
}

/// The first document, under another title.
fn entitled(title: &str) -> Document {
    let mut field = FIELDS[0].clone();
    field.field.title = title.into();
    whole(&field)
}

#[test]
fn latex_is_balanced_and_escaped() {
    let odd = entitled(r"50% of $A_1 & {B}^2 ~ \input{x} #");
    for document in WHOLE.iter().chain([&odd]) {
        assert_balanced(&latex::page(document));
    }
}

/// A fragment goes from u to b, in the symbols that parameters declare, and has no document around it.
#[test]
fn fragments_of_latex_show_the_symbols_of_parameters() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fields/sheared_block_2d.toml");
    let mut text = fs::read_to_string(path).expect("a field of the gallery");
    for (name, symbol) in [("young", "E"), ("rho0", r"\\rho_{\\mathrm{ref}}")] {
        let unit =
            text.find(&format!("\n{name} ")).and_then(|at| Some(at + text[at..].find("unit")?));
        text.insert_str(unit.expect("a unit"), &format!("symbol = \"{symbol}\", "));
    }
    let field = compiled("sheared_block_2d", &text);
    let document = Document::new(&field, &DERIVATION).expect("a derivation of usual size");
    let fragment = latex::fragment(&document);
    assert_balanced(&fragment);
    assert!(fragment.starts_with("\\[\\boldsymbol{u}"), "{fragment}");
    for part in ["documentclass", "section", "young", "rho0"] {
        assert!(!fragment.contains(part), "{part}: {fragment}");
    }
    let steps = [
        "  u_{1} &=",
        "  F_{11} &=",
        "  J &=",
        "strain-energy density",
        "  P_{11} &=",
        "  (\\operatorname{Div} P)_{1} &=",
        "  b_{1} &=",
    ];
    let places = steps.map(|it| fragment.find(it).unwrap_or_else(|| panic!("{it}: {fragment}")));
    assert!(places.is_sorted(), "{places:?}");
    let force = &fragment[places[6]..];
    assert!(force.contains("\\rho_{\\mathrm{ref}}"), "{force}");
    // The whole document has them, too, and the names of other parameters as they are.
    assert!(latex::page(&document).contains("\\mu &= \\frac{E}{2 \\,"));
}

#[test]
fn mathml_is_well_formed() {
    let odd = entitled("a < b && \"c\" > </title> \u{1} <script>");
    for document in WHOLE.iter().chain([&odd]) {
        let page = mathml::page(document);
        let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
        let parsed = roxmltree::Document::parse_with_options(&page, options)
            .unwrap_or_else(|error| panic!("{error}\n{page}"));
        let elements = || parsed.descendants().filter(|node| node.is_element());
        let formulas = elements().filter(|node| node.has_tag_name("math")).count();
        assert!(formulas > 20, "{formulas} formulas");
        for element in elements() {
            let (name, children) =
                (element.tag_name().name(), element.children().filter(|node| node.is_element()));
            let expected = match name {
                "mfrac" | "msup" | "msub" | "mover" | "mroot" => 2,
                "msqrt" => 1,
                "script" => panic!("a title became an element"),
                _ => continue,
            };
            assert_eq!(children.count(), expected, "{name}");
        }
    }
}

/// The parts of a formula are the same in both notations: digits, bars, roots and powers.
#[test]
fn mathml_has_the_structure_of_latex() {
    let digits = |text: &str| {
        let mut digits: Vec<_> = text.chars().filter(char::is_ascii_digit).collect();
        digits.sort_unstable();
        digits.into_iter().collect::<String>()
    };
    let count = |text: &str, part: &str| text.matches(part).count();
    for document in WHOLE.iter() {
        for (_, line) in lines(document) {
            let latex = document.formula(line.value, &latex::Latex::of(document));
            let mathml = document.formula(line.value, &mathml::MathMl);
            let page = format!("<math>{mathml}</math>");
            let parsed = roxmltree::Document::parse(&page).expect("XML");
            let texts = parsed.descendants().filter(|node| node.is_text());
            let texts: String = texts.filter_map(|node| node.text()).collect();
            assert_eq!(digits(&latex), digits(&texts), "{latex}\n{mathml}");
            let roots = count(&mathml, "<msqrt>") + count(&mathml, "<mroot>");
            assert_eq!(count(&latex, "\\sqrt"), roots, "{latex}\n{mathml}");
            assert_eq!(count(&latex, "\\frac"), count(&mathml, "<mfrac>"), "{latex}\n{mathml}");
            assert_eq!(count(&latex, "^"), count(&mathml, "<msup>"), "{latex}\n{mathml}");
        }
    }
}

/// A part of another page has its heading levels; the formulas equal the formulas of the page.
#[test]
fn a_part_of_a_page_has_its_formulas_and_lower_headings() {
    let document = &WHOLE[0];
    let (page, part) = (mathml::page(document), mathml::part(document, 4));
    assert!(page.contains(&part.replace("<h4>", "<h2>").replace("</h4>", "</h2>")));
    assert!(
        part.contains("<h4>displacement</h4>") && !part.contains("<h1>") && !part.contains("<h2>")
    );
}

#[test]
fn names_of_users_are_kept_apart_from_those_of_quantities() {
    let field = compiled("odd_names", include_str!("../../tests/programs/odd_names.toml"));
    let document = document(&field);
    let parameters = field.model.parameters.iter().map(|parameter| parameter.name.clone());
    let shown = lines(&document);
    let names = shown.iter().flat_map(|(_, line)| &line.left).map(|name| name.identifier());
    let mut all: Vec<_> = parameters.chain(names).collect();
    let count = all.len();
    all.sort();
    all.dedup();
    assert_eq!(all.len(), count);
}
