//! The compiler, its proofs and the judging of results, for a page in a browser.
//!
//! A request is a JSON header and the bytes of attached files; the reply is JSON. [`answer`] computes the reply. It starts no
//! thread, reads no clock and opens no file. `page/` is the page that calls it, from a worker.
//!
//! | file | does |
//! |---|---|
//! | `request` | requests, as the page writes them |
//! | `mistake` | errors, with their places in the text |
//! | `field` | the text of a field: compiled, checked, derived, emitted |
//! | `values` | numbers at a point, and the motion of a mesh |
//! | `verdict` | the verdict on attached results |
//! | `exports` | the functions of the module |

#[cfg(target_arch = "wasm32")]
mod exports;
mod field;
mod mistake;
mod request;
mod values;
mod verdict;

use serde::Serialize;
use serde_json::value::RawValue;

pub use mistake::Mistake;
use request::{Request, split};

/// A reply: the result or the mistake.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Reply {
    Ok(Box<RawValue>),
    Error(Mistake),
}

/// Answers a request: the length of the header in four bytes, the lowest first; the header; the bytes of attached files.
pub fn answer(request: &[u8]) -> String {
    let reply = match answered(request) {
        Ok(result) => Reply::Ok(result),
        Err(mistake) => Reply::Error(mistake),
    };
    serde_json::to_string(&reply).expect("a reply has no keys but strings")
}

fn answered(request: &[u8]) -> Result<Box<RawValue>, Mistake> {
    let (request, attached) = split(request)?;
    match request {
        Request::Gallery => result(&field::gallery()),
        Request::Schema => Ok(RawValue::from_string(field::SCHEMA.to_owned())?),
        Request::Template { dimension, material, shape } => {
            result(&field::template(dimension, &material, &shape)?)
        }
        Request::Check(text) => result(&field::check(&text)?),
        Request::Derivation { field, quantities } => result(&field::derive(&field, &quantities)?),
        Request::Values { field, at, time, set } => {
            result(&values::values(&field, &at, time, &set)?)
        }
        Request::Motion { field, color, frames, cells } => {
            result(&values::motion(&field, &color, frames, cells)?)
        }
        Request::Targets => result(&field::targets()),
        Request::Emit { field, target, quantities } => {
            result(&field::emit(&field, &target, &quantities)?)
        }
        Request::Judge { field, files, options } => {
            result(&verdict::judge(&field, &files, attached, &options)?)
        }
    }
}

fn result(value: &impl Serialize) -> Result<Box<RawValue>, Mistake> {
    Ok(serde_json::value::to_raw_value(value)?)
}
