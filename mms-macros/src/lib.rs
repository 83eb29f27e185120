//! Rust macros around the field compiler: `field!` reads the file, calls the compiler and returns its code.
//!
//! The module that `field!` makes includes the bytes of its file, so that Cargo detects a change in any crate that uses it.
//! Procedural macros run unoptimised by default, even in a release build; the workspace's profiles optimise them, since
//! `field!` runs the derivation.

mod request;

use std::env;
use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use mms_codegen::compile::{Failure, own_quantities};
use mms_codegen::rust::{module, module_named};
use mms_codegen::{Options, compile_with};
use mms_spec::MAX_FILE;
use mms_spec::source;
use proc_macro::TokenStream;
use quote::quote;
use syn::{Error, Result};

use request::Request;

/// A manufactured solution as a module named after its file.
///
/// ```ignore
/// mms_macros::field!("fields/bar_1d.toml");
///
/// let field = bar_1d::prepare(&bar_1d::Parameters::<f64>::default());
/// let b = field.at_time(0.013).body_force([0.37]);
/// ```
///
/// The path is relative to the manifest of the crate that uses the macro. The module is compiled
/// again whenever the file changes. Every mistake in the file is a compile error that shows its
/// line and column. The using crate depends on `mms-runtime`.
///
/// # Only what is needed
///
/// ```ignore
/// mms_macros::field!(
///     "fields/bar_1d.toml",
///     quantities = [body_force, velocity],
///     set = { length = 2, amplitude = "length/10" },
///     freeze = [length],
///     name = forcing,
/// );
/// ```
///
/// | option | effect |
/// |---|---|
/// | `quantities = [..]` | compiles only these. The module has no other contents, neither the domain nor the traits of a solver (`boxed`), and the using crate depends on `mms-math` instead of `mms-runtime` |
/// | `set = { name = value, .. }` | changes defaults. A value is a number or, in quotes, a formula in the parameters above that one. Parameters that depend on it change, too |
/// | `freeze` | makes all parameters constants, at their defaults. They are removed from `Parameters`, and terms that become 0 are removed from the code |
/// | `freeze = [..]` | makes these parameters constants |
/// | `rigid = ".."` | superposes a rigid motion, with the keys of `[rigid]`; without a value a large and accelerated one |
/// | `form = "fast"` | uses the fewest operations, at the cost of accuracy if strains are small; `"stable"`, the default, computes every quantity to 64 eps of its largest magnitude |
/// | `name = other` | names the module, so that two modules of one file can exist |
///
/// A frozen parameter that depends on parameters that are not frozen keeps the value that follows from their defaults.
///
/// # Precision
///
/// A module computes in any scalar: `f32`, `f64`, or `mms_math::Double`, which has twice the digits of `f64`. Terms that do not
/// depend on the position are computed in a scalar with more digits, `Scalar::Wide`, if there is one. Loops over many points and the traits of a solver
/// (`boxed`) support `f32` and `f64`.
///
/// ```ignore
/// use mms_math::{Double, Scalar as _};
///
/// let wide = bar_1d::prepare(&bar_1d::Parameters::<Double>::default());
/// let [b] = wide.at_time(Double::from(0.013)).body_force([Double::from(0.37)]);
/// ```
///
/// # Once per point
///
/// Each quantity can be computed from a position, or from values that depend on the position alone, which a solver stores:
/// `Point::<f64>::BYTES` for each point. Both give the same bits.
///
/// ```ignore
/// let point = field.at_point([0.37]);              // once per particle
/// let b = field.at_time(0.013).body_force_at(&point); // at every step
/// ```
#[proc_macro]
pub fn field(input: TokenStream) -> TokenStream {
    let request = syn::parse_macro_input!(input as Request);
    expand(&request).unwrap_or_else(Error::into_compile_error).into()
}

fn expand(request: &Request) -> Result<proc_macro2::TokenStream> {
    let path = request.path.value();
    let refusal = |message: String| Error::new(request.path.span(), message);
    let root = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).ok_or_else(|| {
        refusal("the macro needs Cargo's CARGO_MANIFEST_DIR to find the file".into())
    })?;
    let file = root.join(&path);
    let text = read(&file)
        .map_err(|reason| refusal(format!("cannot read the field file `{path}`: {reason}")))?;
    let name = file.file_stem().unwrap_or_default().to_string_lossy();
    let folder = file.parent().unwrap_or(&root);
    let load = |material: &str| read(&folder.join(material));
    let selection = request.selection(&own_quantities(&name, &path, &text, &load))?;
    let options = Options { form: request.form, ..Options::from(selection) };
    let compiled = compile_with(&name, &path, &text, &load, &options)
        .map_err(|failure| refused(request, failure))?;
    let module = match &request.name {
        Some(name) => module_named(&compiled, name),
        None => module(&compiled),
    };
    // Cargo compiles the using crate again if a file that it includes changes.
    let mut sources = vec![file.clone()];
    sources.extend(compiled.own_material().map(|(material, _)| folder.join(material)));
    let sources = sources.iter().map(|source| source.to_string_lossy().into_owned());
    Ok(quote! {
        #module
        #(const _: &[u8] = include_bytes!(#sources);)*
    })
}

/// The compile errors of a refused field: all mistakes of the file are reported at its path in the call, and each mistake of the
/// selection at its option.
fn refused(request: &Request, failure: Failure) -> Error {
    let Failure { sources, diagnostics } = failure;
    let (of_the_call, of_the_file): (Vec<_>, Vec<_>) =
        diagnostics.into_iter().partition(|diagnostic| request.entry(diagnostic.span).is_some());
    let mut errors = Vec::new();
    if !of_the_file.is_empty() {
        let text = Failure { sources: sources.clone(), diagnostics: of_the_file }.to_string();
        errors.push(Error::new(request.path.span(), message(&text)));
    }
    for diagnostic in of_the_call {
        let entry = request.entry(diagnostic.span);
        let span = entry.map_or(request.path.span(), |entry| request.span(entry));
        let text = Failure { sources: sources.clone(), diagnostics: vec![diagnostic] }.to_string();
        errors.push(Error::new(span, message(&text)));
    }
    let errors = errors.into_iter().reduce(|mut all, next| {
        all.combine(next);
        all
    });
    errors.unwrap_or_else(|| Error::new(request.path.span(), "the field does not compile"))
}

/// Rendered mistakes as one compile error; the compiler writes the first `error: ` itself.
fn message(rendered: &str) -> String {
    rendered.strip_prefix("error: ").unwrap_or(rendered).trim_end().into()
}

/// The text of a plain file, unless it is longer than the limit: other kinds of files might never end.
fn read(path: &Path) -> std::result::Result<String, String> {
    let read = || {
        if !fs::metadata(path)?.is_file() {
            return Err(io::Error::other("it is no plain file"));
        }
        let mut bytes = Vec::new();
        File::open(path)?.take(MAX_FILE as u64 + 1).read_to_end(&mut bytes)?;
        if bytes.len() > MAX_FILE {
            let message = format!("it has more than {MAX_FILE} bytes, the most that are read");
            return Err(io::Error::other(message));
        }
        source::text(bytes)
    };
    read().map_err(|error| error.to_string())
}
