//! The place of the largest error, in words.

use mms_exact::Exact;
use mms_spec::number::short;
use mms_spec::quantity::Quantity;

use super::MeasuredMesh;

/// A point at this distance from a face, in lengths of a cell, is no longer near the face.
const NEAR: f64 = 1.01;

/// The place of the largest error of each quantity on the finest mesh: the point, and the faces that meet there, or how far they are.
pub fn places(
    quantities: &[Quantity],
    (levels, sizes): (&[MeasuredMesh], &[f64]),
    exact: &Exact,
) -> Vec<String> {
    let finest = levels.iter().zip(sizes).min_by(|a, b| a.1.total_cmp(b.1));
    let Some((finest, &h)) = finest else { return Vec::new() };
    let place = |quantity: &Quantity| {
        let errors = finest.errors.iter().find(|it| it.quantity == *quantity)?;
        let (point, rounding) = &errors.largest_at;
        Some(words(point, *rounding, h, exact))
    };
    quantities.iter().map(|it| place(it).unwrap_or_default()).collect()
}

fn words(point: &[f64], rounding: f64, h: f64, exact: &Exact) -> String {
    let mut faces = exact.distances_to_faces(point);
    faces.sort_by(|a, b| a.1.total_cmp(&b.1));
    let names = |most: f64| -> Vec<String> {
        let near = faces.iter().filter(|(_, distance)| *distance <= most);
        near.map(|(face, _)| face.name().to_string()).collect()
    };
    let (on, near) = (names(exact.rounding_of_faces(point, rounding)), names(NEAR * h));
    let place = match (on.as_slice(), near.as_slice(), faces.first()) {
        ([_, _, ..], ..) => format!("where the faces {} meet", on.join(" and ")),
        ([face], ..) => format!("on the face {face}"),
        ([], [_, _, ..], _) => format!("less than h from the faces {}", near.join(" and ")),
        ([], _, Some((face, distance))) => {
            format!("inside, {} h from the face {}", beside(distance / h, 1.0), face.name())
        }
        ([], _, None) => "inside".into(),
    };
    let size = point.iter().fold(h, |most: f64, it| most.max(it.abs()));
    let numbers: Vec<_> = point.iter().map(|it| beside(*it, size)).collect();
    match numbers.as_slice() {
        [only] => format!("at X = {only}, {place}"),
        _ => format!("at X = ({}), {place}", numbers.join(", ")),
    }
}

/// A number in four digits; 0 if it is small beside this size.
fn beside(number: f64, size: f64) -> String {
    short(if number.abs() < 1e-9 * size { 0.0 } else { number })
}
