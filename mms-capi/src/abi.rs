//! The functions of `mms_capi.h`, which is made of this file: each checks its pointers and calls
//! safe Rust. Everything that C passes in is read here, and nowhere else.
#![allow(unsafe_code)]

use std::ffi::{CStr, c_char};
use std::slice;
use std::sync::LazyLock;

use mms_codegen::quantity::Quantity;

use crate::border::{guarded, guarded_or};
use crate::error::{Error, MmsCode};
use crate::field::Field;
use crate::gallery;

/// The names of all quantities, one after the other, each with a NUL at its end.
static QUANTITIES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let names = Quantity::ALL.iter().map(|quantity| quantity.name());
    names.map(|name| [name.as_bytes(), b"\0"].concat()).collect()
});

/// The version of the library, such as "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn mms_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// How many fields the gallery has.
#[unsafe(no_mangle)]
pub extern "C" fn mms_gallery_size() -> usize {
    gallery::FIELDS.len()
}

/// The name of a field of the gallery; NULL from `mms_gallery_size()` on. Names are in alphabetical
/// order, and are never freed.
#[unsafe(no_mangle)]
pub extern "C" fn mms_gallery_name(index: usize) -> *const c_char {
    gallery::FIELDS.get(index).map_or(std::ptr::null(), |(name, ..)| name.as_ptr())
}

/// How many quantities there are. Every field has all of them.
#[unsafe(no_mangle)]
pub extern "C" fn mms_quantity_count() -> usize {
    Quantity::ALL.len()
}

/// The name of a quantity, such as "body_force"; NULL from `mms_quantity_count()` on. Names are never
/// freed.
#[unsafe(no_mangle)]
pub extern "C" fn mms_quantity_name(index: usize) -> *const c_char {
    guarded_or(std::ptr::null(), || {
        QUANTITIES.get(index).map_or(std::ptr::null(), |name| name.as_ptr().cast())
    })
}

/// Makes `*field` the field of that name of the gallery.
///
/// Codes: MMS_CODE_UNKNOWN_NAME. On failure `*field` is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_from_gallery(
    name: *const c_char,
    field: *mut *mut Field,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe { make(field, message, capacity, || gallery::field(text("name", name)?)) }
}

/// Makes `*field` the field of a text, the content of a field file. `name` is what
/// messages call it. `material` is the content of the material file that the field names, as in
/// `model = "./mine.toml"`, or NULL where it names a material that ships.
///
/// Codes: MMS_CODE_INVALID_FIELD, with every mistake at its line and column. On failure `*field` is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_from_text(
    name: *const c_char,
    toml: *const c_char,
    material: *const c_char,
    field: *mut *mut Field,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        make(field, message, capacity, || {
            let material =
                if material.is_null() { None } else { Some(text("material", material)?) };
            Field::compile(text("name", name)?, text("toml", toml)?, material)
        })
    }
}

/// Frees a field, and what its functions returned. NULL is allowed. No other call may be at work on
/// the field.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_free(field: *mut Field) {
    if !field.is_null() {
        // SAFETY: the caller passes what `make` made, once.
        guarded_or((), || drop(unsafe { Box::from_raw(field) }));
    }
}

/// The name of a field; NULL for NULL. It lives as long as the field, as do all texts of a field.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_name(field: *const Field) -> *const c_char {
    // SAFETY: the caller passes a field or NULL.
    unsafe { field.as_ref() }.map_or(std::ptr::null(), |field| field.name.as_ptr())
}

/// The title of a field, a sentence; NULL for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_title(field: *const Field) -> *const c_char {
    // SAFETY: the caller passes a field or NULL.
    unsafe { field.as_ref() }.map_or(std::ptr::null(), |field| field.title.as_ptr())
}

/// D, the number of coordinates of a point: 1, 2 or 3; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_dimension(field: *const Field) -> usize {
    // SAFETY: the caller passes a field or NULL.
    unsafe { field.as_ref() }.map_or(0, Field::dimension)
}

/// How many parameters a field has; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_parameter_count(field: *const Field) -> usize {
    // SAFETY: the caller passes a field or NULL.
    unsafe { field.as_ref() }.map_or(0, |field| field.parameters.len())
}

/// The name of a parameter, in the order of the file; NULL beyond the last.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_parameter_name(
    field: *const Field,
    index: usize,
) -> *const c_char {
    // SAFETY: the caller passes a field or NULL.
    let name = unsafe { field.as_ref() }.and_then(|field| field.parameters.get(index));
    name.map_or(std::ptr::null(), |name| name.as_ptr())
}

/// How many faces the body of a field has; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_face_count(field: *const Field) -> usize {
    // SAFETY: the caller passes a field or NULL.
    unsafe { field.as_ref() }.map_or(0, |field| field.faces.len())
}

/// The name of a face, such as "x_max" or "inner"; NULL beyond the last.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_face_name(field: *const Field, index: usize) -> *const c_char {
    // SAFETY: the caller passes a field or NULL.
    let name = unsafe { field.as_ref() }.and_then(|field| field.faces.get(index));
    name.map_or(std::ptr::null(), |name| name.as_ptr())
}

/// Writes the value of a parameter to `*value`.
///
/// Codes: MMS_CODE_UNKNOWN_NAME.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_get_parameter(
    field: *const Field,
    name: *const c_char,
    value: *mut f64,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        guarded(buffer(message, capacity), || {
            let found = this(field)?.parameter(text("name", name)?)?;
            numbers_mut("value", value, 1)?[0] = found;
            Ok(())
        })
    }
}

/// Sets a parameter. Parameters whose defaults depend on it follow, unless they were set.
///
/// Codes: MMS_CODE_UNKNOWN_NAME, MMS_CODE_INVALID_PARAMETER. On failure nothing changes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_set_parameter(
    field: *mut Field,
    name: *const c_char,
    value: f64,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        guarded(buffer(message, capacity), || this(field)?.set([(text("name", name)?, value)]))
    }
}

/// Sets `count` parameters at once, where one alone would not be allowed, as in a body that moves
/// away. An evaluation on another thread sees all of them or none.
///
/// Codes: MMS_CODE_UNKNOWN_NAME, MMS_CODE_INVALID_PARAMETER. On failure nothing changes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_set_parameters(
    field: *mut Field,
    count: usize,
    names: *const *const c_char,
    values: *const f64,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        guarded(buffer(message, capacity), || {
            let names = elements("names", names, count)?;
            let names = names.iter().map(|name| text("a name", *name));
            let names = names.collect::<Result<Vec<_>, _>>()?;
            let values = numbers("values", values, count)?;
            this(field)?.set(names.into_iter().zip(values.iter().copied()))
        })
    }
}

/// Writes the number of components of a quantity to `*components`: 1, D or D x D.
///
/// Codes: MMS_CODE_UNKNOWN_NAME.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_components(
    field: *const Field,
    quantity: *const c_char,
    components: *mut usize,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        guarded(buffer(message, capacity), || {
            let count = this(field)?.components(text("quantity", quantity)?)?;
            elements_mut("components", components, 1)?[0] = count;
            Ok(())
        })
    }
}

/// Evaluates a quantity at `count` points of the reference body, at one time.
///
/// `quantity` is a name, or one of the symbols u x v a H F J C B E P sigma b W. `points` are count x
/// D coordinates, those of a point side by side. `values` get count x C numbers, those of a point
/// side by side, with C from `mms_field_components`; a tensor is stored by rows. `normals` are count
/// x D components of reference unit normals for "traction" (see `mms_field_normals`), and NULL for
/// all else. `values` may not overlap with the others.
///
/// Every value is a finite number, or the call fails: the message then names the first point, and
/// `values` are unspecified.
///
/// Codes: MMS_CODE_UNKNOWN_NAME, MMS_CODE_INVALID_ARGUMENT, MMS_CODE_NOT_FINITE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_evaluate(
    field: *const Field,
    quantity: *const c_char,
    time: f64,
    count: usize,
    points: *const f64,
    normals: *const f64,
    values: *mut f64,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        guarded(buffer(message, capacity), || {
            let field = this(field)?;
            let quantity = text("quantity", quantity)?;
            let components = field.components(quantity)?;
            let points = numbers("points", points, size(count, field.dimension())?)?;
            let normals = match normals.is_null() {
                true => None,
                false => Some(numbers("normals", normals, points.len())?),
            };
            let values = numbers_mut("values", values, size(count, components)?)?;
            field.evaluate(quantity, time, points, normals, values)
        })
    }
}

/// Writes the outward reference unit normals of a face at `count` points of it: count x D numbers for
/// count x D coordinates.
///
/// Codes: MMS_CODE_UNKNOWN_NAME, MMS_CODE_INVALID_ARGUMENT, MMS_CODE_NOT_FINITE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_normals(
    field: *const Field,
    face: *const c_char,
    count: usize,
    points: *const f64,
    normals: *mut f64,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        guarded(buffer(message, capacity), || {
            let field = this(field)?;
            let size = size(count, field.dimension())?;
            let points = numbers("points", points, size)?;
            field.normals(text("face", face)?, points, numbers_mut("normals", normals, size)?)
        })
    }
}

/// Writes where the body or the time window ends: "lower", "upper" (D coordinates each, of a box),
/// "inner", "outer" (a radius each, of an annulus), "theta" (first and last angle), "time" (first
/// and last). It follows the parameters.
///
/// Codes: MMS_CODE_UNKNOWN_NAME, also where the body has no such bound.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_bound(
    field: *const Field,
    name: *const c_char,
    values: *mut f64,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        guarded(buffer(message, capacity), || {
            let bound = this(field)?.bound(text("name", name)?)?;
            numbers_mut("values", values, bound.len())?.copy_from_slice(&bound);
            Ok(())
        })
    }
}

/// Puts a new field where the caller wants it.
unsafe fn make(
    place: *mut *mut Field,
    message: *mut c_char,
    capacity: usize,
    new: impl FnOnce() -> Result<Field, Error>,
) -> MmsCode {
    // SAFETY: the caller vouches for both pointers.
    unsafe {
        guarded(buffer(message, capacity), || {
            let place = &mut elements_mut("field", place, 1)?[0];
            *place = std::ptr::null_mut();
            *place = Box::into_raw(Box::new(new()?));
            Ok(())
        })
    }
}

/// The buffer for a message, if there is one.
unsafe fn buffer<'a>(message: *mut c_char, capacity: usize) -> Option<&'a mut [u8]> {
    let capacity = capacity.min(isize::MAX as usize);
    // SAFETY: the caller has `capacity` bytes there.
    (!message.is_null())
        .then(|| unsafe { slice::from_raw_parts_mut(message.cast::<u8>(), capacity) })
}

unsafe fn this<'a>(field: *const Field) -> Result<&'a Field, Error> {
    // SAFETY: the caller passes a field or NULL.
    unsafe { field.as_ref() }.ok_or_else(|| null("field"))
}

unsafe fn text<'a>(what: &str, text: *const c_char) -> Result<&'a str, Error> {
    if text.is_null() {
        return Err(null(what));
    }
    // SAFETY: the caller passes a text that ends with a NUL.
    unsafe { CStr::from_ptr(text) }.to_str().map_err(|error| {
        Error::new(MmsCode::InvalidArgument, format!("`{what}` is not UTF-8: {error}"))
    })
}

unsafe fn numbers<'a>(what: &str, first: *const f64, count: usize) -> Result<&'a [f64], Error> {
    // SAFETY: passed on.
    unsafe { elements(what, first, count) }
}

unsafe fn numbers_mut<'a>(
    what: &str,
    first: *mut f64,
    count: usize,
) -> Result<&'a mut [f64], Error> {
    // SAFETY: passed on.
    unsafe { elements_mut(what, first, count) }
}

unsafe fn elements<'a, T>(what: &str, first: *const T, count: usize) -> Result<&'a [T], Error> {
    match (first.is_null(), count) {
        (_, 0) => Ok(&[]),
        (true, _) => Err(null(what)),
        // SAFETY: the caller has `count` of them there.
        (false, count) => Ok(unsafe { slice::from_raw_parts(first, count) }),
    }
}

unsafe fn elements_mut<'a, T>(
    what: &str,
    first: *mut T,
    count: usize,
) -> Result<&'a mut [T], Error> {
    match (first.is_null(), count) {
        (_, 0) => Ok(&mut []),
        (true, _) => Err(null(what)),
        // SAFETY: the caller has `count` of them there, which nothing else refers to meanwhile.
        (false, count) => Ok(unsafe { slice::from_raw_parts_mut(first, count) }),
    }
}

/// How many numbers `count` points have.
fn size(count: usize, components: usize) -> Result<usize, Error> {
    let most = isize::MAX as usize / size_of::<f64>();
    count.checked_mul(components).filter(|size| *size <= most).ok_or_else(|| {
        Error::new(MmsCode::InvalidArgument, format!("`count` is {count}: no array is that long"))
    })
}

fn null(what: &str) -> Error {
    Error::new(MmsCode::InvalidArgument, format!("`{what}` is NULL"))
}

#[cfg(test)]
#[path = "abi_tests.rs"]
mod tests;
