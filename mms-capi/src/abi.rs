//! The functions of `mms_capi.h`, which is generated from this file: `memory` checks the pointers of each, and it calls safe
//! Rust. All arguments are read before anything is written, except for the points of a batch, and the message is written last.
#![allow(unsafe_code)]

use std::ffi::{c_char, c_int};
use std::ptr::{null, null_mut};
use std::sync::LazyLock;

use mms_spec::MAX_FILE;
use mms_spec::quantity::Quantity;

use crate::border::{attempt, guarded, guarded_or};
use crate::error::{Error, MmsCode};
use crate::field::Field;
use crate::gallery;
use crate::memory::{MemoryRange, Message, Writable, array, handle, reference, text};
use crate::stop::Stop;

/// The largest number of bytes of a name. Longer names are not read further.
const MAX_NAME: usize = 4096;

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
    gallery::FIELDS.get(index).map_or(null(), |(name, ..)| name.as_ptr())
}

/// How many quantities every field has.
#[unsafe(no_mangle)]
pub extern "C" fn mms_quantity_count() -> usize {
    Quantity::ALL.len()
}

/// The name of a quantity, such as "body_force"; NULL from `mms_quantity_count()` on. Names are never
/// freed.
#[unsafe(no_mangle)]
pub extern "C" fn mms_quantity_name(index: usize) -> *const c_char {
    guarded_or(null(), || QUANTITIES.get(index).map_or(null(), |name| name.as_ptr().cast()))
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
    unsafe { make(field, Message::new(message, capacity), || gallery::field(word("name", name)?)) }
}

/// Makes `*field` the field of a text, the content of a field file. Messages call it `name`. `material` is the content of the
/// material file that the field names, as in `model = "./mine.toml"`, or NULL if it names a material that ships.
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
    unsafe { mms_field_from_text_stoppable(name, toml, material, null(), field, message, capacity) }
}

/// Makes `*field` as `mms_field_from_text` does, until `mms_stop_request`. `stop` may be NULL.
///
/// Codes: MMS_CODE_INVALID_FIELD, MMS_CODE_STOPPED. On failure `*field` is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_from_text_stoppable(
    name: *const c_char,
    toml: *const c_char,
    material: *const c_char,
    stop: *const Stop,
    field: *mut *mut Field,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        make(field, Message::new(message, capacity), || {
            let name = text("name", name, MAX_NAME, MmsCode::InvalidArgument)?;
            let toml = content("toml", toml)?;
            let material =
                if material.is_null() { None } else { Some(content("material", material)?) };
            let stop = if stop.is_null() { &Stop::default() } else { handle("stop", stop)? };
            Field::compile(name, toml, material, stop)
        })
    }
}

/// Makes the object by which a program stops calls. Never returns NULL.
#[unsafe(no_mangle)]
pub extern "C" fn mms_stop_new() -> *mut Stop {
    Box::into_raw(Box::new(Stop::default()))
}

/// Requests that calls to which `stop` was passed, now or later, end soon: within milliseconds, or some hundred of them if a
/// formula is large. A request cannot be withdrawn; further work needs a new `stop`. Any thread may call this at any time, and
/// so may a signal handler. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_stop_request(stop: *const Stop) {
    // SAFETY: the caller passes what `mms_stop_new` made, or NULL.
    if let Some(stop) = unsafe { reference(stop) } {
        stop.ask();
    }
}

/// Whether a stop was requested: 1 or 0; 0 for NULL. A signal handler may call this, too.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_stop_is_requested(stop: *const Stop) -> c_int {
    // SAFETY: the caller passes what `mms_stop_new` made, or NULL.
    unsafe { reference(stop) }.is_some_and(Stop::is_asked).into()
}

/// Frees `stop`, when all calls to which it was passed have ended. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_stop_free(stop: *mut Stop) {
    // SAFETY: the caller passes what `mms_stop_new` made, once, or NULL.
    if unsafe { reference(stop) }.is_some() {
        // SAFETY: the same.
        drop(unsafe { Box::from_raw(stop) });
    }
}

/// Frees a field, and all texts that its functions returned. NULL is allowed. No other call may be using the field.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_free(field: *mut Field) {
    // SAFETY: the caller passes what `make` made, once, or NULL.
    if unsafe { reference(field) }.is_some() {
        // SAFETY: the same.
        guarded_or((), || drop(unsafe { Box::from_raw(field) }));
    }
}

/// The name of a field; NULL for NULL. All texts of a field are valid until the field is freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_name(field: *const Field) -> *const c_char {
    // SAFETY: the caller passes a field or NULL.
    unsafe { reference(field) }.map_or(null(), |field| field.name.as_ptr())
}

/// The title of a field, a sentence; NULL for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_title(field: *const Field) -> *const c_char {
    // SAFETY: the caller passes a field or NULL.
    unsafe { reference(field) }.map_or(null(), |field| field.title.as_ptr())
}

/// D, the number of coordinates of a point: 1, 2 or 3; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_dimension(field: *const Field) -> usize {
    // SAFETY: the caller passes a field or NULL.
    unsafe { reference(field) }.map_or(0, Field::dimension)
}

/// The number of parameters of a field; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_parameter_count(field: *const Field) -> usize {
    // SAFETY: the caller passes a field or NULL.
    unsafe { reference(field) }.map_or(0, |field| field.parameters.len())
}

/// The name of a parameter, in the order of the file; NULL beyond the last.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_parameter_name(
    field: *const Field,
    index: usize,
) -> *const c_char {
    // SAFETY: the caller passes a field or NULL.
    let name = unsafe { reference(field) }.and_then(|field| field.parameters.get(index));
    name.map_or(null(), |name| name.as_ptr())
}

/// The number of faces of a field's body; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_face_count(field: *const Field) -> usize {
    // SAFETY: the caller passes a field or NULL.
    unsafe { reference(field) }.map_or(0, |field| field.faces.len())
}

/// The name of a face, such as "x_max" or "inner"; NULL beyond the last.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_face_name(field: *const Field, index: usize) -> *const c_char {
    // SAFETY: the caller passes a field or NULL.
    let name = unsafe { reference(field) }.and_then(|field| field.faces.get(index));
    name.map_or(null(), |name| name.as_ptr())
}

/// The number of quantities that only the file of a field defines: given fields and balances; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_own_quantity_count(field: *const Field) -> usize {
    // SAFETY: the caller passes a field or NULL.
    unsafe { reference(field) }.map_or(0, |field| field.own.len())
}

/// The name of a quantity that the file of a field defines, such as "p_gradient"; NULL beyond the last.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_own_quantity_name(
    field: *const Field,
    index: usize,
) -> *const c_char {
    // SAFETY: the caller passes a field or NULL.
    let name = unsafe { reference(field) }.and_then(|field| field.own.get(index));
    name.map_or(null(), |name| name.as_ptr())
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
        guarded(Message::new(message, capacity), |message| {
            let found = this(field)?.parameter(word("name", name)?)?;
            Writable::new("value", value, 1, &[message.extent()])?.put(&[found]);
            Ok(())
        })
    }
}

/// Sets a parameter. Parameters whose defaults depend on it change, unless they were set.
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
        guarded(Message::new(message, capacity), |_| {
            this(field)?.set([Ok((word("name", name)?, value))])
        })
    }
}

/// Sets `count` parameters at once. This is needed if one change alone would not be allowed, such as a lower end above the old
/// upper end of a body. An evaluation on another thread uses all new values or none.
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
        guarded(Message::new(message, capacity), |_| {
            let names = array("names", names, count)?.iter().enumerate();
            let values = array("values", values, count)?;
            this(field)?.set(names.zip(values).map(|((index, place), value)| {
                Ok((word(&format!("names[{index}]"), *place)?, *value))
            }))
        })
    }
}

/// Writes the number of components of a quantity to `*components`: 1, D for a vector, D x D for a tensor. A vector of an
/// axisymmetric field has 2, or 3 with a swirl, and its tensors have 9.
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
        guarded(Message::new(message, capacity), |message| {
            let count = this(field)?.components(word("quantity", quantity)?)?;
            Writable::new("components", components, 1, &[message.extent()])?.put(&[count]);
            Ok(())
        })
    }
}

/// Evaluates a quantity at `count` points of the reference body, at one time.
///
/// `quantity` is a name, or one of the symbols u x v a H F J C B E rho P sigma b W. `points` are count x D coordinates, with
/// the D coordinates of a point adjacent. `values` get count x C numbers, with the C numbers of a point adjacent and C from
/// `mms_field_components`; a tensor is stored by rows. `normals` are count x D components of reference unit normals for
/// "traction" (see `mms_field_normals`), and NULL for all other quantities. `values` may not overlap with the others.
///
/// Every value is a finite number, or the call fails: the message then names the first point, and `values` are unspecified.
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
        mms_field_evaluate_stoppable(
            field,
            quantity,
            time,
            count,
            points,
            normals,
            null(),
            values,
            message,
            capacity,
        )
    }
}

/// Evaluates as `mms_field_evaluate` does, until `mms_stop_request`. `stop` may be NULL.
///
/// Codes: as `mms_field_evaluate`, and MMS_CODE_STOPPED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_evaluate_stoppable(
    field: *const Field,
    quantity: *const c_char,
    time: f64,
    count: usize,
    points: *const f64,
    normals: *const f64,
    stop: *const Stop,
    values: *mut f64,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        guarded(Message::new(message, capacity), |message| {
            let field = this(field)?;
            let name = word("quantity", quantity)?;
            let [size, room] = [field.dimension(), field.components(name)?]
                .map(|numbers| count.saturating_mul(numbers));
            let points = array("points", points, size)?;
            let normals =
                if normals.is_null() { None } else { Some(array("normals", normals, size)?) };
            let others = [
                MemoryRange::of("quantity", name.as_bytes()),
                MemoryRange::of("points", points),
                MemoryRange::of("normals", normals.unwrap_or(&[])),
                message.extent(),
            ];
            let mut values = Writable::new("values", values, room, &others)?;
            let stop = if stop.is_null() { None } else { Some(handle("stop", stop)?) };
            field.evaluate(name, time, points, normals, stop, |result| values.put(result))
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
        guarded(Message::new(message, capacity), |message| {
            let field = this(field)?;
            let name = word("face", face)?;
            let size = count.saturating_mul(field.dimension());
            let points = array("points", points, size)?;
            let others = [
                MemoryRange::of("face", name.as_bytes()),
                MemoryRange::of("points", points),
                message.extent(),
            ];
            let mut normals = Writable::new("normals", normals, size, &others)?;
            field.normals(name, points, |normal| normals.put(normal))
        })
    }
}

/// Writes the number of components of a bound to `*components`: D, 1 or 2, see `mms_field_get_bound`.
///
/// Codes: MMS_CODE_UNKNOWN_NAME, also if the body has no such bound.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_bound_components(
    field: *const Field,
    name: *const c_char,
    components: *mut usize,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        guarded(Message::new(message, capacity), |message| {
            let count = this(field)?.bound(word("name", name)?)?.len();
            Writable::new("components", components, 1, &[message.extent()])?.put(&[count]);
            Ok(())
        })
    }
}

/// Writes a bound of the body or the time window: "lower", "upper" (D coordinates each, of a box), "inner", "outer" (a radius
/// each, of a round body), "theta" (first and last angle), "z" (the ends of a cylinder), "phi" (first and last angle from +Z of
/// a sphere), "vertices" (of a polygon, X and Y of one after another), "time" (first and last). Bounds depend on the
/// parameters. `values` has room for `room` numbers; if that is too small, nothing is written to it.
///
/// Codes: MMS_CODE_UNKNOWN_NAME, also if the body has no such bound; MMS_CODE_INVALID_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_get_bound(
    field: *const Field,
    name: *const c_char,
    room: usize,
    values: *mut f64,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe {
        guarded(Message::new(message, capacity), |message| {
            let (field, name) = (this(field)?, word("name", name)?);
            let bound = field.bound(name)?;
            if room < bound.len() {
                let needed = bound.len();
                let message = format!("`room` is {room}: `{name}` has {needed} components");
                return Err(Error::new(MmsCode::InvalidArgument, message));
            }
            Writable::new("values", values, bound.len(), &[message.extent()])?.put(&bound);
            Ok(())
        })
    }
}

/// Writes a bound as `mms_field_get_bound` does, into `values` with room for all components; 3 are always enough. Kept for
/// programs that call it. New ones pass the size.
///
/// Codes: MMS_CODE_UNKNOWN_NAME, also if the body has no such bound.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mms_field_bound(
    field: *const Field,
    name: *const c_char,
    values: *mut f64,
    message: *mut c_char,
    capacity: usize,
) -> MmsCode {
    // SAFETY: the caller vouches for every pointer, as the header says.
    unsafe { mms_field_get_bound(field, name, usize::MAX, values, message, capacity) }
}

/// Writes a new field to `place`, and NULL if there is none.
unsafe fn make(
    place: *mut *mut Field,
    message: Message,
    new: impl FnOnce() -> Result<Field, Error>,
) -> MmsCode {
    guarded(message, |message| {
        // SAFETY: the caller vouches for the pointer.
        let mut place = unsafe { Writable::new("field", place, 1, &[message.extent()]) }?;
        let made = attempt(|| Ok(Box::into_raw(Box::new(new()?))));
        place.put(&[made.as_ref().map_or(null_mut(), |field| *field)]);
        made.map(drop)
    })
}

unsafe fn this<'a>(field: *const Field) -> Result<&'a Field, Error> {
    // SAFETY: passed on.
    unsafe { handle("field", field) }
}

/// A name of at most `MAX_NAME` bytes.
unsafe fn word<'a>(what: &str, name: *const c_char) -> Result<&'a str, Error> {
    // SAFETY: passed on.
    unsafe { text(what, name, MAX_NAME, MmsCode::UnknownName) }
}

/// The content of a file, of at most `MAX_FILE` bytes, as the compiler requires.
unsafe fn content<'a>(what: &str, content: *const c_char) -> Result<&'a str, Error> {
    // SAFETY: passed on.
    unsafe { text(what, content, MAX_FILE, MmsCode::InvalidField) }
}

#[cfg(test)]
#[path = "abi_tests.rs"]
mod tests;
