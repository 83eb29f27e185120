//! Doorways from Rust code into the field compiler.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro::TokenStream;
use quote::quote;
use syn::LitStr;

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
#[proc_macro]
pub fn field(input: TokenStream) -> TokenStream {
    let path = syn::parse_macro_input!(input as LitStr);
    match expand(&path.value()) {
        Ok(module) => module.into(),
        Err(message) => syn::Error::new(path.span(), message).into_compile_error().into(),
    }
}

fn expand(path: &str) -> Result<proc_macro2::TokenStream, String> {
    let root = env::var_os("CARGO_MANIFEST_DIR")
        .map(PathBuf::from)
        .ok_or("the macro needs Cargo's CARGO_MANIFEST_DIR to find the file")?;
    let file = root.join(path);
    let text =
        read(&file).map_err(|reason| format!("cannot read the field file `{path}`: {reason}"))?;
    let name = file.file_stem().unwrap_or_default().to_string_lossy();
    let folder = file.parent().unwrap_or(&root);
    let compiled =
        mms_codegen::compile(&name, path, &text, &|material| read(&folder.join(material)))
            .map_err(|failure| message(&failure.to_string()))?;
    let module = mms_codegen::emit::rust::module(&compiled);
    // Cargo compiles the using crate again when a file that it includes changes.
    let mut sources = vec![file.clone()];
    sources.extend(compiled.own_material().map(|(material, _)| folder.join(material)));
    let sources = sources.iter().map(|source| source.to_string_lossy().into_owned());
    Ok(quote! {
        #module
        #(const _: &[u8] = include_bytes!(#sources);)*
    })
}

/// The rendered mistakes as one compile error; the compiler writes the first `error: ` itself.
fn message(rendered: &str) -> String {
    rendered.strip_prefix("error: ").unwrap_or(rendered).trim_end().into()
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| error.to_string())
}
