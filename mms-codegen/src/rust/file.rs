//! A field as a Rust file of its own, for crates that do not use the macro.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Attribute, Item};

use super::{Emitter, docs, identifier};
use crate::compile::Compiled;

/// A file that a target made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// The name of the file, without a folder.
    pub name: String,
    /// The text of the file.
    pub text: String,
}

/// The selected quantities as one file, which needs `mms-math` alone. It is a module: say
/// `mod bar_1d;` beside it, or `include!` it in a module.
pub fn file(compiled: &Compiled) -> File {
    let name = identifier(compiled.field.name.raw()).to_string();
    let name = format!("{}.rs", name.trim_start_matches("r#"));
    let mut file: syn::File =
        syn::parse2(Emitter::new(compiled, false).kernels()).expect("emitted tokens are items");
    // Attributes of the whole file would forbid `include!`.
    let lints = attribute(quote!(#[allow(non_snake_case, unused_variables, clippy::all)]));
    for item in &mut file.items {
        match item {
            Item::Fn(item) => item.attrs.push(lints.clone()),
            Item::Impl(item) => item.attrs.push(lints.clone()),
            Item::Struct(item) => item.attrs.push(lints.clone()),
            _ => {}
        }
    }
    let header: String = docs(compiled).iter().map(|line| format!("//{line}\n")).collect();
    File { name, text: format!("{header}\n{}", prettyplease::unparse(&file)) }
}

fn attribute(tokens: TokenStream) -> Attribute {
    let item: syn::ItemStruct = syn::parse_quote!(#tokens struct S;);
    item.attrs.into_iter().next().expect("one attribute was written")
}
