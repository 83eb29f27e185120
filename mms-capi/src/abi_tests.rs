//! Tests of the functions as C calls them.

use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use mms_codegen::materials::MATERIALS;

use super::*;
use crate::evaluator::BLOCK;

/// The capacity for any message except for the mistakes of field files.
const CAPACITY: usize = 1024;

/// The code and the message of a call.
fn said(call: impl FnOnce(*mut c_char, usize) -> MmsCode) -> (MmsCode, String) {
    let mut message = [b'?'; CAPACITY];
    let code = call(message.as_mut_ptr().cast(), CAPACITY);
    let message = CStr::from_bytes_until_nul(&message).expect("a NUL");
    (code, message.to_str().expect("UTF-8").into())
}

/// Makes a call that has to succeed.
fn done(call: impl FnOnce(*mut c_char, usize) -> MmsCode) {
    assert_eq!(said(call), (MmsCode::Ok, String::new()));
}

/// A field that is freed on drop.
struct Handle(*mut Field);

// SAFETY: the interface promises it, and `Field` is `Sync`.
unsafe impl Sync for Handle {}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: made below, and not used afterwards.
        unsafe { mms_field_free(self.0) }
    }
}

impl Handle {
    fn new(name: &CStr) -> Self {
        let mut field = null_mut();
        // SAFETY: every pointer is good.
        done(|m, n| unsafe { mms_field_from_gallery(name.as_ptr(), &mut field, m, n) });
        Handle(field)
    }

    fn set(&self, name: &CStr, value: f64) -> (MmsCode, String) {
        // SAFETY: every pointer is good.
        said(|m, n| unsafe { mms_field_set_parameter(self.0, name.as_ptr(), value, m, n) })
    }

    fn get(&self, name: &CStr) -> f64 {
        let mut value = f64::NAN;
        // SAFETY: every pointer is good.
        done(|m, n| unsafe { mms_field_get_parameter(self.0, name.as_ptr(), &mut value, m, n) });
        value
    }

    /// Evaluates a quantity at points, with room for `components` numbers at each.
    fn evaluate(
        &self,
        quantity: &CStr,
        time: f64,
        points: &[f64],
        normals: Option<&[f64]>,
        components: usize,
    ) -> Result<Vec<f64>, (MmsCode, String)> {
        let quantity = quantity.as_ptr();
        // SAFETY: every pointer is good.
        unsafe {
            let count = points.len() / mms_field_dimension(self.0);
            let mut values = vec![f64::NAN; count * components];
            let normals = normals.map_or(null(), <[f64]>::as_ptr);
            let (points, place) = (points.as_ptr(), values.as_mut_ptr());
            match said(|m, n| {
                mms_field_evaluate(self.0, quantity, time, count, points, normals, place, m, n)
            }) {
                (MmsCode::Ok, _) => Ok(values),
                failure => Err(failure),
            }
        }
    }
}

/// A text of the library.
fn owned(text: *const c_char) -> Option<String> {
    // SAFETY: NULL, or a text with a NUL.
    (!text.is_null()).then(|| unsafe { CStr::from_ptr(text) }.to_str().expect("UTF-8").into())
}

#[test]
fn every_name_that_is_listed_is_a_name() {
    for index in 0..mms_gallery_size() {
        let name = owned(mms_gallery_name(index)).expect("a name");
        let field = Handle::new(&CString::new(name.clone()).expect("a name"));
        // SAFETY: a field.
        unsafe {
            assert_eq!(owned(mms_field_name(field.0)), Some(name));
            assert!(owned(mms_field_title(field.0)).is_some_and(|title| !title.is_empty()));
            for index in 0..mms_field_parameter_count(field.0) {
                let name = owned(mms_field_parameter_name(field.0, index)).expect("a name");
                assert!(field.get(&CString::new(name).expect("a name")).is_finite());
            }
            assert!(
                mms_field_parameter_name(field.0, mms_field_parameter_count(field.0)).is_null()
            );
            assert!(mms_field_face_count(field.0) >= 2);
            assert!(mms_field_face_name(field.0, mms_field_face_count(field.0)).is_null());
        }
    }
    assert!(mms_gallery_name(mms_gallery_size()).is_null());
    assert!(mms_quantity_name(mms_quantity_count()).is_null());
    assert_eq!(owned(mms_version()).as_deref(), Some(env!("CARGO_PKG_VERSION")));
}

#[test]
fn the_bar_is_the_bar() {
    let bar = Handle::new(c"bar_1d");
    let points = [0.0, 0.37, 1.0];
    let time = 0.013;
    let amplitude = 0.2 * (1000.0_f64.sqrt() * std::f64::consts::PI * time).cos();
    let u = bar.evaluate(c"u", time, &points, None, 1).expect("values");
    let f = bar.evaluate(c"deformation_gradient", time, &points, None, 1).expect("values");
    for ((x, u), f) in points.iter().zip(u).zip(f) {
        assert!((u - x * (2.0 - x) * amplitude).abs() < 1e-15, "{x}");
        assert!((f - (1.0 + 2.0 * (1.0 - x) * amplitude)).abs() < 1e-15, "{x}");
    }
}

#[test]
fn a_field_names_the_quantities_of_its_own() {
    let square = Handle::new(c"given_pressure_2d");
    // SAFETY: the field is good.
    let names: Vec<_> = unsafe {
        (0..mms_field_own_quantity_count(square.0))
            .map(|index| owned(mms_field_own_quantity_name(square.0, index)).expect("a name"))
            .collect()
    };
    assert_eq!(names, ["p", "p_gradient", "p_rate", "volume_residual"]);
    // SAFETY: as above.
    assert!(unsafe { mms_field_own_quantity_name(square.0, names.len()) }.is_null());
    // p0 k cos(k X) cos(k Y) sin(w t) and its slopes at X = 0 and Y = 1/3.
    let (time, point) = (0.01, [0.0, 1.0 / 3.0]);
    let wave = (400.0_f64.sqrt() * std::f64::consts::PI * time).sin();
    let p = square.evaluate(c"p", time, &point, None, 1).expect("values");
    assert!((p[0] - 0.5e5 * wave).abs() < 1e-10, "{p:?}");
    let slope = square.evaluate(c"p_gradient", time, &point, None, 2).expect("values");
    let expected = -1e5 * std::f64::consts::PI * 0.75_f64.sqrt() * wave;
    assert!(slope[0].abs() < 1e-9 && (slope[1] - expected).abs() < 1e-9, "{slope:?}");
}

#[test]
fn a_quantity_has_its_components_side_by_side() {
    let cube = Handle::new(c"cyclic_shear_3d");
    let points = [0.1, 0.2, 0.3, 0.7, 0.6, 0.5];
    for index in 0..mms_quantity_count() {
        let name = CString::new(owned(mms_quantity_name(index)).expect("a name")).expect("a name");
        let mut components = 0;
        done(|m, n| {
            // SAFETY: every pointer is good.
            unsafe { mms_field_components(cube.0, name.as_ptr(), &mut components, m, n) }
        });
        let normals = [1.0, 0.0, 0.0, 0.0, 0.6, 0.8];
        let both = cube.evaluate(&name, 0.1, &points, Some(&normals), components).expect("values");
        let second = &points[3..];
        let one = cube.evaluate(&name, 0.1, second, Some(&normals[3..]), components);
        assert_eq!(both[components..], one.expect("values"), "{name:?}");
    }
    let gradient = cube.evaluate(c"H", 0.1, &points, None, 9).expect("values");
    let transposed: Vec<_> = (0..9).map(|entry| gradient[entry % 3 * 3 + entry / 3]).collect();
    assert_ne!(gradient[..9], transposed, "rows and columns differ");
    let step = 1e-6;
    let u = |y: f64| cube.evaluate(c"u", 0.1, &[0.1, y, 0.3], None, 3).expect("values");
    let slope = (u(0.2 + step)[0] - u(0.2 - step)[0]) / (2.0 * step);
    assert!((slope - gradient[1]).abs() < 1e-8, "dudY is the second: {slope} {gradient:?}");
}

#[test]
fn parameters_are_set_together_or_not_at_all() {
    let bar = Handle::new(c"bar_1d");
    assert_eq!(bar.set(c"amplitude", 0.1), (MmsCode::Ok, String::new()));
    assert_eq!(bar.get(c"amplitude"), 0.1);
    let (code, message) = bar.set(c"amplitud", 0.3);
    assert_eq!(code, MmsCode::UnknownName);
    assert_eq!(message, "no parameter `amplitud`; did you mean `amplitude`?");
    let (code, message) = bar.set(c"rho0", -1.0);
    assert_eq!(code, MmsCode::InvalidParameter);
    assert!(message.contains("density"), "{message}");
    assert_eq!(bar.set(c"rho0", f64::NAN).0, MmsCode::InvalidParameter);
    let (names, values) = ([c"amplitude".as_ptr(), c"length".as_ptr()], [0.05, -2.0]);
    // SAFETY: every pointer is good.
    let (code, _) = said(|m, n| unsafe {
        mms_field_set_parameters(bar.0, 2, names.as_ptr(), values.as_ptr(), m, n)
    });
    assert_eq!(code, MmsCode::InvalidParameter);
    assert_eq!([bar.get(c"amplitude"), bar.get(c"length"), bar.get(c"rho0")], [0.1, 1.0, 1000.0]);
    let twice = [c"rho0".as_ptr(), c"rho0".as_ptr()];
    // SAFETY: every pointer is good.
    let (code, message) = said(|m, n| unsafe {
        mms_field_set_parameters(bar.0, 2, twice.as_ptr(), values.as_ptr(), m, n)
    });
    assert_eq!((code, message.as_str()), (MmsCode::InvalidParameter, "`rho0` is set twice"));
    let values = [0.05, 2.0];
    // SAFETY: every pointer is good.
    done(|m, n| unsafe {
        mms_field_set_parameters(bar.0, 2, names.as_ptr(), values.as_ptr(), m, n)
    });
    let mut upper = [0.0];
    // SAFETY: every pointer is good.
    done(|m, n| unsafe { mms_field_bound(bar.0, c"upper".as_ptr(), upper.as_mut_ptr(), m, n) });
    assert_eq!(upper, [2.0]);
    let end = bar.evaluate(c"u", 0.0, &[2.0], None, 1).expect("values");
    assert_eq!(end, [0.05]);
}

#[test]
fn a_text_is_a_field_or_its_mistakes() {
    let good = include_str!("../fields/bar_1d.toml");
    let make = |name: &CStr, text: &str, material: Option<&CStr>| {
        let text = CString::new(text).expect("no NUL");
        let material = material.map_or(null(), CStr::as_ptr);
        let mut field = null_mut();
        // SAFETY: every pointer is good.
        let outcome = said(|m, n| unsafe {
            mms_field_from_text(name.as_ptr(), text.as_ptr(), material, &mut field, m, n)
        });
        assert_eq!(outcome.0 == MmsCode::Ok, !field.is_null());
        (outcome, Handle(field))
    };
    let (outcome, field) = make(c"mine", good, None);
    assert_eq!(outcome, (MmsCode::Ok, String::new()));
    let same = |field: &Handle| field.evaluate(c"b", 0.01, &[0.3], None, 1).expect("values");
    assert_eq!(same(&field), same(&Handle::new(c"bar_1d")));
    let ((code, message), _) = make(c"mine", &good.replace("cos(", "cso("), None);
    assert_eq!(code, MmsCode::InvalidField);
    assert!(message.contains("mine.toml:") && message.contains("did you mean `cos`?"), "{message}");
    let own = good.replace("\"neo_hookean\"", "\"./own.toml\"");
    let ((code, message), _) = make(c"mine", &own, None);
    assert_eq!(code, MmsCode::InvalidField);
    assert!(message.contains("the text of the material was not given"), "{message}");
    let shipped = MATERIALS.iter().find(|(stem, _)| *stem == "neo_hookean").expect("a material");
    let material = CString::new(shipped.1).expect("no NUL");
    let (outcome, field) = make(c"mine", &own, Some(&material));
    assert_eq!(outcome, (MmsCode::Ok, String::new()));
    assert_eq!(same(&field), same(&Handle::new(c"bar_1d")));
}

#[test]
fn what_is_not_a_number_is_refused() {
    let bar = Handle::new(c"bar_1d");
    let failure = |quantity, time, points: &[f64], normals: Option<&[f64]>| {
        bar.evaluate(quantity, time, points, normals, 1).expect_err("a failure")
    };
    let (code, message) = failure(c"body_forc", 0.0, &[0.0], None);
    assert_eq!(code, MmsCode::UnknownName);
    assert!(message.ends_with("did you mean `body_force`?"), "{message}");
    assert_eq!(failure(c"b", f64::INFINITY, &[0.0], None).0, MmsCode::InvalidArgument);
    let (code, message) = failure(c"b", 0.0, &[0.5, f64::NAN], None);
    assert_eq!(
        (code, message.as_str()),
        (MmsCode::InvalidArgument, "point 1 has NaN: expected finite numbers")
    );
    assert_eq!(failure(c"traction", 0.0, &[1.0], None).0, MmsCode::InvalidArgument);
    let (code, message) = failure(c"traction", 0.0, &[1.0], Some(&[2.0]));
    assert_eq!(code, MmsCode::InvalidArgument);
    assert!(message.contains("has the length 2"), "{message}");
    // F = 1 + 2 (1 - X) A vanishes at X = 1 + 1/(2 A) = 3.5.
    let (code, message) = failure(c"b", 0.0, &[0.5, 3.5], None);
    assert_eq!(code, MmsCode::NotFinite);
    assert!(message.contains("point 1, X = [3.5]"), "{message}");
    assert_eq!(bar.evaluate(c"b", 0.0, &[], None, 1), Ok(Vec::new()), "no points at all");
}

#[test]
fn normals_point_outward_and_carry_the_traction() {
    let ring = Handle::new(c"expanding_ring");
    let mut outer = [0.0];
    // SAFETY: every pointer is good.
    unsafe {
        done(|m, n| mms_field_bound(ring.0, c"outer".as_ptr(), outer.as_mut_ptr(), m, n));
        let (code, message) =
            said(|m, n| mms_field_bound(ring.0, c"upper".as_ptr(), outer.as_mut_ptr(), m, n));
        assert_eq!(code, MmsCode::UnknownName);
        assert_eq!(message, "no bound `upper`: this body has inner, outer, theta, time");
        let points = [0.6 * outer[0], 0.8 * outer[0]];
        let mut normal = [0.0; 2];
        let (at, place) = (points.as_ptr(), normal.as_mut_ptr());
        done(|m, n| mms_field_normals(ring.0, c"outer".as_ptr(), 1, at, place, m, n));
        assert!((normal[0] - 0.6).abs() < 1e-15 && (normal[1] - 0.8).abs() < 1e-15);
        let traction = ring.evaluate(c"traction", 0.1, &points, Some(&normal), 2).expect("values");
        let stress = ring.evaluate(c"P", 0.1, &points, None, 4).expect("values");
        let scale = stress.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
        assert!(traction.iter().all(|entry| entry.abs() < 1e-12 * scale), "it is free");
        let (code, message) =
            said(|m, n| mms_field_normals(ring.0, c"x_max".as_ptr(), 1, at, place, m, n));
        assert_eq!(code, MmsCode::UnknownName);
        assert!(message.contains("this body has inner, outer"), "{message}");
    }
}

#[test]
fn points_of_later_blocks_have_their_normals_and_numbers() {
    const COUNT: usize = 3 * BLOCK + 2;
    let ring = Handle::new(c"expanding_ring");
    let directions = (0..COUNT).flat_map(|k| <[f64; 2]>::from((0.1 * k as f64).sin_cos()));
    let normals: Vec<f64> = directions.collect();
    let mut points: Vec<f64> = normals.iter().rev().map(|x| 0.8 * x).collect();
    let traction =
        |points: &[f64], normals: &[f64]| ring.evaluate(c"traction", 0.1, points, Some(normals), 2);
    let all = traction(&points, &normals).expect("values");
    for k in 0..COUNT {
        let own = 2 * k..2 * k + 2;
        let alone = traction(&points[own.clone()], &normals[own.clone()]).expect("values");
        assert_eq!(all[own], alone, "point {k}");
    }
    points[2 * COUNT - 1] = f64::NAN;
    let (_, message) = traction(&points, &normals).expect_err("a failure");
    assert_eq!(message, format!("point {} has NaN: expected finite numbers", COUNT - 1));
}

#[test]
fn null_is_refused_where_a_pointer_is_needed() {
    let bar = Handle::new(c"bar_1d");
    let mut place = null_mut();
    let b = c"b".as_ptr();
    let at = [0.5].as_ptr();
    // SAFETY: NULL is allowed everywhere, which the following calls test.
    unsafe {
        for (what, (code, message)) in [
            ("name", said(|m, n| mms_field_from_gallery(null(), &mut place, m, n))),
            ("field", said(|m, n| mms_field_from_gallery(c"bar_1d".as_ptr(), null_mut(), m, n))),
            ("toml", said(|m, n| mms_field_from_text(b, null(), null(), &mut place, m, n))),
            ("field", said(|m, n| mms_field_set_parameter(null_mut(), b, 1.0, m, n))),
            ("names", said(|m, n| mms_field_set_parameters(bar.0, 1, null(), at, m, n))),
            (
                "value",
                said(|m, n| mms_field_get_parameter(bar.0, c"rho0".as_ptr(), null_mut(), m, n)),
            ),
            (
                "points",
                said(|m, n| mms_field_evaluate(bar.0, b, 0.0, 1, null(), null(), null_mut(), m, n)),
            ),
            (
                "values",
                said(|m, n| mms_field_evaluate(bar.0, b, 0.0, 1, at, null(), null_mut(), m, n)),
            ),
            ("components", said(|m, n| mms_field_components(bar.0, b, null_mut(), m, n))),
            ("values", said(|m, n| mms_field_bound(bar.0, c"time".as_ptr(), null_mut(), m, n))),
        ] {
            assert_eq!(code, MmsCode::InvalidArgument, "{what}");
            assert_eq!(message, format!("`{what}` is NULL"));
        }
        let (code, message) = said(|m, n| {
            mms_field_evaluate(bar.0, b, 0.0, usize::MAX, at, null(), null_mut(), m, n)
        });
        assert_eq!(code, MmsCode::InvalidArgument, "{message}");
        let (code, _) = said(|m, n| mms_field_from_gallery(c"\xff".as_ptr(), &mut place, m, n));
        assert_eq!(code, MmsCode::InvalidArgument, "not UTF-8");
        assert_eq!(mms_field_from_gallery(b, &mut place, null_mut(), 0), MmsCode::UnknownName);
        assert_eq!(mms_field_dimension(null()), 0);
        assert!(mms_field_name(null()).is_null() && mms_field_parameter_name(null(), 0).is_null());
        mms_field_free(null_mut());
    }
}

#[test]
fn threads_see_the_parameters_of_one_moment() {
    let bar = Handle::new(c"bar_1d");
    let points: Vec<_> = (0..50).map(|index| f64::from(index) / 50.0).collect();
    let values = || bar.evaluate(c"body_force", 0.01, &points, None, 1).expect("values");
    let first = values();
    assert_eq!(bar.set(c"amplitude", 0.1).0, MmsCode::Ok);
    let second = values();
    assert_ne!(first, second);
    let done = AtomicBool::new(false);
    thread::scope(|scope| {
        for _ in 0..3 {
            scope.spawn(|| {
                while !done.load(Ordering::Relaxed) {
                    let now = values();
                    assert!(now == first || now == second, "parameters of two moments");
                }
            });
        }
        for round in 0..50 {
            assert_eq!(bar.set(c"amplitude", [0.2, 0.1][round % 2]).0, MmsCode::Ok);
        }
        done.store(true, Ordering::Relaxed);
    });
}
