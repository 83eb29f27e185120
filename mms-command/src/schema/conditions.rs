//! Conditions between values of a field file: the number of components, the faces, the parameters of a material.

use mms_exact::gallery;
use mms_spec::format;
use mms_spec::format::MATERIAL;
use mms_spec::moduli;
use mms_spec::moduli::Pair;
use mms_spec::quantity::Quantity;
use mms_spec::{BODIES, BODY_KEYS, BodyShape, Face, MaterialSpec, Space};
use serde_json::{Map, Value, json};

use super::value_types::{count, extend};

/// All conditions.
pub fn of_field() -> Value {
    let dimensions = (1..=3).flat_map(|dimension| {
        [in_dimension(dimension), in_cartesian(dimension), box_faces(dimension)]
    });
    let dimensions = dimensions.chain(axisymmetric()).chain([without_swirl()]);
    let bodies = BODIES.iter().map(keys_of).chain(round_faces()).chain([edges(), nothing()]);
    let conditions = dimensions.chain(bodies).chain([rigid(), motions(), balances()]);
    conditions.chain(materials()).collect()
}

/// A condition, and what follows from it.
fn if_then(condition: Value, consequence: Value) -> Value {
    json!({ "if": condition, "then": consequence })
}

/// A schema of files that have all these keys (each with a path such as `field.dimension`), with values of these schemas. It
/// requires the keys, because a schema without them holds for any file.
fn has(values: &[(&str, Value)]) -> Value {
    let mut all: Vec<Value> = Vec::new();
    for (path, schema) in values {
        let mut nested = schema.clone();
        for key in path.rsplit('.') {
            nested = json!({ "properties": { key: nested }, "required": [key] });
        }
        all.push(nested);
    }
    match all.as_slice() {
        [one] => one.clone(),
        _ => json!({ "allOf": all }),
    }
}

/// A schema of the value at a path, if it is there.
fn at(path: &str, schema: Value) -> Value {
    path.rsplit('.').fold(schema, |nested, key| json!({ "properties": { key: nested } }))
}

/// A schema that requires all of the schemas.
fn all(schemas: impl IntoIterator<Item = Value>) -> Value {
    json!({ "allOf": schemas.into_iter().collect::<Vec<_>>() })
}

fn dimension_is(dimension: usize) -> (&'static str, Value) {
    ("field.dimension", json!({ "const": dimension }))
}

fn coordinates() -> (&'static str, Value) {
    ("field.coordinates", json!({ "const": Space::WORDS[1] }))
}

fn shape_is(shape: &str) -> (&'static str, Value) {
    ("domain.shape", json!({ "const": shape }))
}

fn in_dimension(dimension: usize) -> Value {
    let vectors = ["displacement.u", "domain.lower", "domain.upper", "rigid.translation"];
    let mut asked: Vec<_> = vectors.iter().map(|path| at(path, count(dimension))).collect();
    let fits = |shape: &&BodyShape| shape.dimension.is_none_or(|needed| needed == dimension);
    let shapes: Vec<_> = BODIES.iter().filter(fits).map(|shape| shape.name).collect();
    asked.push(at("domain.shape", json!({ "enum": shapes })));
    if_then(has(&[dimension_is(dimension)]), all(asked))
}

/// The conditions on vectors and tensors.
fn in_space(space: Space) -> [Value; 2] {
    [
        at("balance", json!({ "items": at("flux", count(space.vector())) })),
        at("check", json!({ "items": all(components(space)) })),
    ]
}

/// The conditions on a file that is not axisymmetric.
fn and_cartesian(mut condition: Value) -> Value {
    extend(&mut condition, json!({ "not": has(&[coordinates()]) }));
    condition
}

fn in_cartesian(dimension: usize) -> Value {
    let mut asked = in_space(Space::Cartesian(dimension)).to_vec();
    asked.push(at("rigid.rotation", rotation(dimension)));
    if_then(and_cartesian(has(&[dimension_is(dimension)])), all(asked))
}

/// An axisymmetric field, without and with a swirl.
fn axisymmetric() -> [Value; 3] {
    let swirl = ("displacement.swirl", json!(true));
    let named = json!({ "propertyNames": { "not": { "enum": ["R"] } } });
    let mut asked = vec![
        at("field.dimension", json!({ "const": 2 })),
        at("domain.shape", json!({ "enum": ["box", "none"] })),
        at("rigid.rotation", json!(false)),
        at("check", json!({ "items": at("let", named.clone()) })),
    ];
    asked.extend(["parameters", "let", "given"].map(|table| at(table, named.clone())));
    let is_box = has(&[coordinates(), shape_is("box")]);
    let of_box = faces(&Face::of_box(Space::Axisymmetric { swirl: false }));
    asked.push(if_then(is_box, of_box));
    let [mut plain, twisted] = [has(&[coordinates()]), has(&[coordinates(), swirl.clone()])];
    extend(&mut plain, json!({ "not": has(&[swirl]) }));
    let of = |swirl: bool| all(in_space(Space::Axisymmetric { swirl }));
    let axisymmetric = if_then(has(&[coordinates()]), all(asked));
    let without_studies = at("study", json!({ "maxItems": 0 }));
    let twisted = if_then(twisted, all([of(true), without_studies]));
    [axisymmetric, if_then(plain, of(false)), twisted]
}

/// Only axisymmetric fields may have a swirl or an axis.
fn without_swirl() -> Value {
    let inner = format::claims(Face::Outer);
    let asked =
        [at("displacement.swirl", json!(false)), at("boundary.r_min", json!({ "enum": inner }))];
    if_then(and_cartesian(json!({})), all(asked))
}

fn rotation(dimension: usize) -> Value {
    match dimension {
        1 => json!(false),
        2 => json!({ "type": ["string", "number"] }),
        _ => json!({ "type": "object" }),
    }
}

/// A field that moves has a density.
fn motions() -> Value {
    if_then(has(&[("domain.time", json!({}))]), at("material", json!({ "required": ["density"] })))
}

/// How many components each quantity has.
fn components(space: Space) -> Vec<Value> {
    let mut words: Vec<(usize, Vec<&str>)> = Vec::new();
    for word in format::quantities() {
        let Some(quantity) = Quantity::from_name(word) else { continue };
        let components = space.components(quantity.shape());
        match words.iter_mut().find(|(found, _)| *found == components) {
            Some((_, words)) => words.push(word),
            None => words.push((components, vec![word])),
        }
    }
    let of_quantity = |(components, words): (usize, Vec<&str>)| {
        if_then(has(&[("quantity", json!({ "enum": words }))]), at("equals", count(components)))
    };
    words.into_iter().map(of_quantity).collect()
}

fn box_faces(dimension: usize) -> Value {
    let condition = and_cartesian(has(&[dimension_is(dimension), shape_is("box")]));
    if_then(condition, faces(&Face::of_box(Space::Cartesian(dimension))))
}

fn faces(faces: &[Face]) -> Value {
    let names: Vec<_> = faces.iter().map(|face| face.name()).collect();
    at("boundary", json!({ "propertyNames": { "enum": names } }))
}

/// The keys of a body of that shape.
fn keys_of(shape: &BodyShape) -> Value {
    let is_other = |key: &&&str| !shape.required.contains(*key) && !shape.optional.contains(*key);
    let others: Vec<&str> = BODY_KEYS.iter().filter(is_other).copied().collect();
    if_then(has(&[shape_is(shape.name)]), domain(shape.required, &others))
}

/// A `[domain]` with some keys, and without others.
fn domain(required: &[&str], refused: &[&str]) -> Value {
    let refused: Map<_, _> = refused.iter().map(|key| (key.to_string(), json!(false))).collect();
    at("domain", json!({ "required": required, "properties": refused }))
}

/// Faces of what is round, each with the key that it needs.
fn round_faces() -> Vec<Value> {
    let round = BODIES.iter().filter(|shape| shape.required.contains(&"outer"));
    let mut conditions = Vec::new();
    for shape in round {
        let has_key = |key: &str| shape.required.contains(&key) || shape.optional.contains(&key);
        let of = |key: &str, faces: &[Face]| if has_key(key) { faces.to_vec() } else { Vec::new() };
        let own = [
            of("inner", &[Face::Inner]),
            vec![Face::Outer],
            of("theta", &[Face::ThetaMin, Face::ThetaMax]),
            of("z", &[Face::Min(2), Face::Max(2)]),
            of("phi", &[Face::PhiMin, Face::PhiMax]),
        ];
        conditions.push(if_then(has(&[shape_is(shape.name)]), faces(&own.concat())));
    }
    let without = |asked: Value, own: &[Face]| {
        let refused: Map<_, _> =
            own.iter().map(|face| (face.name().to_string(), json!(false))).collect();
        if_then(asked, at("boundary", json!({ "properties": refused })))
    };
    let absent = |key: &str| {
        let round = json!({ "enum": BODIES.iter().filter(|shape| shape.optional.contains(&key))
            .map(|shape| shape.name).collect::<Vec<_>>() });
        let mut asked = has(&[("domain.shape", round)]);
        extend(&mut asked, json!({ "not": has(&[(&format!("domain.{key}"), json!(true))]) }));
        asked
    };
    conditions.push(without(absent("theta"), &[Face::ThetaMin, Face::ThetaMax]));
    conditions.push(without(absent("phi"), &[Face::PhiMin, Face::PhiMax]));
    conditions
}

/// The edges of a polygon without names of their own.
fn edges() -> Value {
    let mut polygon = has(&[shape_is("polygon")]);
    extend(&mut polygon, json!({ "not": has(&[("domain.names", json!(true))]) }));
    if_then(
        polygon,
        at("boundary", json!({ "propertyNames": { "pattern": "^edge_[1-9][0-9]*$" } })),
    )
}

/// A field without a body has no faces and no studies.
fn nothing() -> Value {
    let refused = json!({ "properties": { "boundary": false, "study": { "maxItems": 0 } } });
    if_then(has(&[shape_is("none")]), refused)
}

/// A balance has a storage, a flux or both; a constraint has a residual alone.
fn balances() -> Value {
    let one_of = json!([{ "required": ["storage"] }, { "required": ["flux"] }]);
    let flow = json!({ "anyOf": one_of, "properties": { "residual": false } });
    let constraint =
        json!({ "required": ["residual"], "properties": { "storage": false, "flux": false } });
    at("balance", json!({ "items": { "anyOf": [flow, constraint] } }))
}

/// A rigid motion has a rotation, a translation or both.
fn rigid() -> Value {
    at("rigid", json!({ "minProperties": 1 }))
}

/// The parameters of each shipped material, with one of the pairs of moduli that it takes, and the
/// fibres of those that have them.
fn materials() -> Vec<Value> {
    let condition = |stem: &str| has(&[("material.model", json!({ "const": stem }))]);
    let shipped = gallery::materials();
    shipped
        .iter()
        .map(|spec| if_then(condition(spec.name.raw()), at("material", keys(spec))))
        .collect()
}

/// The keys of `[material]` for a material.
fn keys(spec: &MaterialSpec) -> Value {
    let pairs: Vec<Pair> = match moduli::pairs(spec) {
        Some((own, others)) => [own].into_iter().chain(others).collect(),
        None => Vec::new(),
    };
    let moduli: Vec<&str> = pairs.iter().flatten().copied().collect();
    let parameters = spec.parameters.iter().map(|parameter| parameter.name.value.as_str());
    let parameters: Vec<&str> = parameters.filter(|name| !moduli.contains(name)).collect();
    let mut known = format::names(MATERIAL);
    known.retain(|key| *key != "fibre" || spec.has_fibres());
    known.extend(parameters.iter().chain(&moduli).copied());
    let givens = spec.givens.iter().map(|given| given.name.value.as_str());
    known.extend(givens.clone());
    let mut required = parameters;
    required.extend(givens);
    required.extend(spec.has_fibres().then_some("fibre"));
    let mut asked = json!({ "required": required, "propertyNames": { "enum": known } });
    if !pairs.is_empty() {
        let one = pairs.iter().map(|pair| {
            let others = moduli.iter().filter(|name| !pair.contains(name));
            let refused: Map<_, _> = others.map(|name| (name.to_string(), json!(false))).collect();
            json!({ "required": pair, "properties": refused })
        });
        extend(&mut asked, json!({ "anyOf": one.collect::<Vec<_>>() }));
    }
    asked
}
