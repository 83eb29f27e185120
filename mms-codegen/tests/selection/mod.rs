//! Selections: selected quantities, changed defaults, frozen parameters.

mod quick;
mod refusals;

use mms_codegen::rust;
use mms_codegen::selection::{Freeze, Selection};
use mms_codegen::{Compiled, compile, compile_with};
use mms_mechanics::Output;
use mms_mechanics::sample::samples;
use mms_program::interpret::{Interpreter, Point};
use mms_program::{Op, Stage};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Function, Rational, Small};
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// A field of one dimension; `{dimension}` and the like are filled in.
const FIELD: &str = r#"
[field]
title     = "Selected"
dimension = 1

[parameters]
lambda = { value = 6e5 }
mu     = { value = 4e5 }
twice  = { value = "2*mu" }
rho0   = { value = 1000 }
size   = { value = "1/10" }

[displacement]
u = ["size*X*(1 - X)*TIME"]

[material]
model   = "neo_hookean"
lambda  = "lambda"
mu      = "twice/2"
density = "rho0"

[domain]
shape = "box"
lower = [0]
upper = [1]
time  = [0, 1]
"#;

fn moving() -> String {
    FIELD.replace("TIME", "cos(30*t)")
}

fn selection(quantities: &[Quantity], set: &[(&str, &str)], freeze: &[&str]) -> Selection {
    Selection {
        quantities: (!quantities.is_empty()).then(|| quantities.iter().copied().collect()),
        set: set.iter().map(|(name, value)| (name.to_string(), value.to_string())).collect(),
        freeze: match freeze {
            [] => Freeze::Nothing,
            ["*"] => Freeze::Everything,
            names => Freeze::Only(names.iter().map(|name| name.to_string()).collect()),
        },
        ..Selection::default()
    }
}

fn selected(text: &str, selection: &Selection) -> Result<Compiled, String> {
    compile_with("x", "x.toml", text, &|path| Err(path.into()), &selection.clone().into())
        .map_err(|failure| failure.to_string())
}

fn compiled(text: &str, selection: &Selection) -> Compiled {
    selected(text, selection).unwrap_or_else(|failure| panic!("{failure}"))
}

/// The values of a quantity at some points of the domain, for the default parameters with `set` in their place.
fn values(compiled: &Compiled, quantity: Quantity, set: &SortedMap<usize, Rational>) -> Vec<f64> {
    let parameters = compiled.parameters::<f64>(set);
    let output = Output::Quantity(quantity);
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    let plan = interpreter.plan(&[output]);
    let points = samples(&compiled.program, &parameters, 32);
    let normal = vec![1.0; compiled.field.dimension];
    points
        .iter()
        .flat_map(|point| {
            let coordinates = &point.coordinates;
            interpreter.set_time(&point.time);
            interpreter.set_point(&plan, Point { coordinates, normal: &normal, gradient: &[] });
            interpreter.output(output)
        })
        .collect()
}

/// Both values were computed in different ways; each way rounds some tens of operations.
fn assert_same(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let size = expected.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
    for (found, expected) in found.iter().zip(expected) {
        let bound = 256.0 * f64::EPSILON * size;
        assert!((found - expected).abs() <= bound, "{what}: {found:e}, not {expected:e}");
    }
}

/// The functions of emitted Rust, with the number of their statements.
fn functions(text: &str) -> SortedMap<String, usize> {
    let file: syn::File = syn::parse_str(text).expect("Rust");
    let mut functions = SortedMap::new();
    for item in file.items {
        match item {
            syn::Item::Fn(function) => {
                functions.insert(function.sig.ident.to_string(), function.block.stmts.len());
            }
            syn::Item::Impl(block) => {
                for item in block.items {
                    if let syn::ImplItem::Fn(function) = item {
                        let name = function.sig.ident.to_string();
                        functions.insert(name, function.block.stmts.len());
                    }
                }
            }
            _ => {}
        }
    }
    functions
}

fn names(text: &str) -> Vec<String> {
    functions(text).into_iter().map(|(name, _)| name).collect()
}

#[test]
fn everything_is_what_no_selection_gives() {
    let text = moving();
    let plain = compile("x", "x.toml", &text, &|path| Err(path.into())).expect("a right file");
    let selected = compiled(&text, &Selection::default());
    assert_eq!(plain.program.to_string(), selected.program.to_string());
    assert_eq!(plain.provenance(), selected.provenance());
    assert_eq!(rust::text(&plain), rust::text(&selected));
}

#[test]
fn each_quantity_alone_has_its_values_and_no_other_code() {
    let text = moving();
    let all = compiled(&text, &Selection::default());
    for quantity in Quantity::ALL {
        let alone = compiled(&text, &selection(&[*quantity], &[], &[]));
        let none = SortedMap::new();
        let [found, expected] = [&alone, &all].map(|of| values(of, *quantity, &none));
        assert_same(&found, &expected, quantity.name());
        let (name, at) = (quantity.name().to_string(), format!("{}_at", quantity.name()));
        // The functions of a field, of its stages, and of the code for many points.
        let mut expected: Vec<String> = ["default", "from_array", "prepare", "at_time", "at_point"]
            .into_iter()
            .chain(["at_points", "len", "is_empty", "standing", "drive", "at", "time_window"])
            .map(String::from)
            .collect();
        expected.extend([name, at]);
        expected.sort();
        let text = rust::file(&alone).text;
        assert_eq!(names(&text), expected);
        assert_eq!(text.matches("batches! {").count(), 1);
        let outputs = alone.program.outputs.keys().filter(|output| match output {
            Output::Quantity(_) | Output::Response(_) | Output::Face(..) => true,
            Output::Bound(_) | Output::Parameter(_) | Output::Expected(_) => false,
        });
        assert_eq!(outputs.collect::<Vec<_>>(), [&Output::Quantity(*quantity)]);
    }
}

#[test]
fn the_structs_hold_what_the_selected_quantities_read() {
    let velocity = rust::file(&compiled(&moving(), &selection(&[Quantity::Velocity], &[], &[])));
    let all = rust::file(&compiled(&moving(), &Selection::default()));
    let members = |text: &str| {
        let field = text.split("pub struct Field<T: Real> {").nth(1).expect("the struct");
        field.split('}').next().expect("its end").matches(": T").count()
    };
    assert_eq!(members(&velocity.text), 1, "{}", velocity.text);
    assert!(members(&all.text) > 4);
    // The body and the material are for a solver.
    assert!(names(&velocity.text).contains(&"time_window".to_owned()));
    let solver = ["lower", "upper", "density", "material_kirchhoff_stress"];
    for name in solver {
        assert!(names(&all.text).contains(&name.to_string()), "{name}");
        assert!(!names(&velocity.text).contains(&name.to_string()), "{name}");
    }
}

#[test]
fn a_body_force_without_lambda_has_no_logarithm_and_no_stress() {
    let text = moving();
    let b = [Quantity::BodyForce];
    let plain = rust::file(&compiled(&text, &selection(&b, &[], &[])));
    let frozen = compiled(&text, &selection(&b, &[("lambda", "0")], &["lambda"]));
    let emitted = rust::file(&frozen).text;
    assert!(plain.text.contains(".ln_1p()"));
    assert!(!emitted.contains(".ln"), "{emitted}");
    assert!(!emitted.contains("stress") && !emitted.contains("lambda:"), "{emitted}");
    // By another way: the unfrozen program with the parameter 0.
    let all = compiled(&text, &Selection::default());
    let zero = SortedMap::from([(0, Rational::ZERO)]);
    let expected = values(&all, Quantity::BodyForce, &zero);
    assert_same(&values(&frozen, Quantity::BodyForce, &SortedMap::new()), &expected, "b");
    let with_lambda = values(&all, Quantity::BodyForce, &SortedMap::new());
    assert!(expected.iter().zip(&with_lambda).any(|(a, b)| (a - b).abs() > 1e-3 * b.abs()));
}

#[test]
fn a_field_at_rest_has_no_code_for_its_motion() {
    let text = FIELD.replace("TIME", "1");
    let all = compiled(&text, &Selection::default());
    let emitted = rust::file(&all).text;
    let functions = functions(&emitted);
    for name in ["velocity", "velocity_at", "acceleration", "acceleration_at", "at_time"] {
        assert_eq!(functions[name], 1, "{name} computes: {emitted}");
    }
    let b = all.program.operations(&[Output::Quantity(Quantity::BodyForce)]);
    assert_eq!((b[&Stage::Time], b[&Stage::PointTime]), (0, 0));
    // All of it may be stored with the point.
    assert_eq!(functions["body_force_at"], 1, "{emitted}");
    assert!(functions["body_force"] > 1);
}

#[test]
fn a_field_of_one_dimension_has_no_three_by_three_algebra() {
    let emitted = rust::file(&compiled(&moving(), &Selection::default())).text;
    assert!(emitted.contains("[[T; 1]; 1]"));
    for of_more in ["[T; 3]", "; 2]; 2]", "; 3]; 3]"] {
        assert!(!emitted.contains(of_more), "{of_more}: {emitted}");
    }
    // The inverse of F is one division, and its determinant is its entry.
    let jacobian = compiled(&moving(), &selection(&[Quantity::Jacobian], &[], &[]));
    let counts = jacobian.program.operations(&[Output::Quantity(Quantity::Jacobian)]);
    let gradient = compiled(&moving(), &selection(&[Quantity::DeformationGradient], &[], &[]));
    let output = Output::Quantity(Quantity::DeformationGradient);
    assert_eq!(counts, gradient.program.operations(&[output]));
}

#[test]
fn a_set_value_changes_the_default_and_those_that_depend_on_it() {
    let text = moving();
    let set = compiled(&text, &selection(&[], &[("mu", "1e6"), ("rho0", "mu/1000")], &[]));
    assert_eq!(set.parameters::<f64>(&SortedMap::new()), [6e5, 1e6, 2e6, 1e3, 0.1]);
    let selected = set.selected();
    assert_eq!(selected.len(), 1);
    assert!(selected[0].starts_with("Changed defaults: mu = 1000000, rho0 = "), "{selected:?}");
    let plain = compiled(&text, &Selection::default());
    let parameters = SortedMap::from([(1, Rational::from(1_000_000)), (3, Rational::from(1000))]);
    let expected = values(&plain, Quantity::BodyForce, &parameters);
    assert_same(&values(&set, Quantity::BodyForce, &SortedMap::new()), &expected, "b");
    // Other input, other hash.
    assert_ne!(set.provenance(), plain.provenance());
}

#[test]
fn a_frozen_parameter_keeps_the_value_that_the_defaults_give() {
    let text = moving();
    let frozen = compiled(&text, &selection(&[], &[("mu", "1e6")], &["twice", "size"]));
    assert_eq!(
        frozen.selected(),
        ["Changed defaults: mu = 1000000", "Constants: twice = 2000000, size = 1/10"]
    );
    let emitted = rust::text(&frozen);
    assert!(emitted.contains(r#"NAMES: [&str; 3] = ["lambda", "mu", "rho0"]"#), "{emitted}");
    let plain = compiled(&text, &Selection::default());
    let twice = SortedMap::from([(2, Rational::from(2_000_000))]);
    let expected = values(&plain, Quantity::BodyForce, &twice);
    assert_same(&values(&frozen, Quantity::BodyForce, &SortedMap::new()), &expected, "b");
    // The parameter that it depended on has no effect any more.
    let other = SortedMap::from([(1, Rational::from(7))]);
    assert_same(&values(&frozen, Quantity::BodyForce, &other), &expected, "b");
}

#[test]
fn with_all_parameters_frozen_nothing_depends_on_any() {
    let everything = compiled(&moving(), &selection(&[], &[], &["*"]));
    let of_parameters = everything.program.instrs.iter().filter(|instr| {
        use mms_symbolic::expr::Symbol;
        matches!(instr.op, Op::Input(Symbol::Parameter(_)))
    });
    assert_eq!(of_parameters.count(), 0);
    let plain = compiled(&moving(), &Selection::default());
    for quantity in Quantity::ALL {
        let [found, expected] =
            [&everything, &plain].map(|of| values(of, *quantity, &SortedMap::new()));
        assert_same(&found, &expected, quantity.name());
    }
}

#[test]
fn a_constant_need_not_be_rational() {
    let text = moving().replace("value = \"1/10\"", "value = \"sqrt(2)*pi/40\"");
    let [frozen, plain] = [&["size"][..], &[]]
        .map(|freeze| compiled(&text, &selection(&[Quantity::Displacement], &[], freeze)));
    let [found, expected] =
        [&frozen, &plain].map(|of| values(of, Quantity::Displacement, &SortedMap::new()));
    assert_same(&found, &expected, "u");
}

#[test]
fn a_negative_value_is_not_assumed_to_be_positive() {
    // A variable exponent needs a positive base, which the file's default is.
    let text = moving().replace("cos(30*t)", "size^t");
    compiled(&text, &selection(&[], &[], &["size"]));
    for freeze in [&["size"][..], &[]] {
        let failure = selected(&text, &selection(&[], &[("size", "-1/10")], freeze));
        let failure = failure.expect_err("-1/10 to the power t");
        assert!(failure.contains("needs a positive base"), "{failure}");
    }
}

#[test]
fn subsets_are_not_dearer_than_the_whole() {
    let all = compiled(&moving(), &Selection::default());
    let pairs = Quantity::ALL.windows(2);
    for pair in pairs {
        let outputs: Vec<_> = pair.iter().map(|quantity| Output::Quantity(*quantity)).collect();
        let part = compiled(&moving(), &selection(pair, &[], &[]));
        assert_eq!(part.selection.quantities, Some(SortedSet::from_iter(pair.to_vec())));
        let sum =
            |compiled: &Compiled| -> usize { compiled.program.operations(&outputs).values().sum() };
        assert!(sum(&part) <= sum(&all), "{pair:?}");
    }
}

/// The functions of angles that the program calls, and the proved bounds of their angles.
fn functions_of_angles(compiled: &Compiled) -> SortedSet<(Function, Option<Small>)> {
    let called = compiled.program.instrs.iter().filter_map(|instr| match instr.op {
        Op::Unary(function, small, _) if instr.stage >= Stage::Point => Some((function, small)),
        _ => None,
    });
    called.filter(|(function, _)| [Function::Sin, Function::Cos].contains(function)).collect()
}

#[test]
fn nothing_is_taken_off_an_angle_that_is_proved_small() {
    let [any, near_zero, within_one] = [None, Some(Small::NearZero), Some(Small::WithinOne)]
        .map(|small| SortedSet::from([(Function::Sin, small), (Function::Cos, small)]));
    // The angle grows to `size`, which may be any number unless it is frozen or has a range.
    let text = FIELD.replace("size*X*(1 - X)*TIME", "sin(size*X^2*t)/10");
    let free = compiled(&text, &Selection::default());
    assert_eq!(functions_of_angles(&free), any);
    for (size, expected) in
        [("1", &within_one), ("1.04", &near_zero), ("1.49", &near_zero), ("1.51", &any)]
    {
        let frozen = compiled(&text, &selection(&[], &[("size", size)], &["size"]));
        assert_eq!(functions_of_angles(&frozen), *expected, "{size}");
    }
    for (range, expected) in
        [("[0, 1.49]", &near_zero), ("[-1.51, 0.2]", &any), ("[0, \"mu/1e6\"]", &any)]
    {
        let ranged = text.replace("\"1/10\"", &format!("0.1, range = {range}"));
        let ranged = compiled(&ranged, &Selection::default());
        assert_eq!(functions_of_angles(&ranged), *expected, "{range}");
        let [found, of_free] =
            [&ranged, &free].map(|of| values(of, Quantity::BodyForce, &SortedMap::new()));
        assert_same(&found, &of_free, range);
    }
    // A window that ends later lets the angle grow.
    let later = text.replace("time  = [0, 1]", "time  = [0, 40]");
    let later = compiled(&later, &selection(&[], &[], &["size"]));
    assert_eq!(functions_of_angles(&later), any);
}

#[test]
fn what_divides_and_calls_no_function_shares_a_loop() {
    let of_angles = include_str!("../../../fields/generalized_vortex.toml");
    let of_waves = include_str!("../../../fields/axis_aligned_3d.toml");
    for (text, together) in [(of_angles, true), (of_waves, false)] {
        let emitted =
            rust::file(&compiled(text, &selection(&[Quantity::BodyForce], &[], &[]))).text;
        let has = |loops: &str| emitted.contains(&format!("], {loops}; "));
        assert_eq!((has("Together"), has("Apart")), (together, !together), "{emitted}");
    }
}
