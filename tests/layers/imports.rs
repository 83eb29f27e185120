//! The imports of a crate, read from its tokens: `use` trees and paths that begin with `crate`, `self` or `super`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::str::FromStr;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A module, as the names on its path from the root of its crate, which has none.
pub type Module = Vec<String>;

/// The imports of a crate's modules from each other, file by file.
#[derive(Default)]
pub struct Imports {
    files: BTreeMap<Module, BTreeSet<Module>>,
    /// The names under which a module exports others: `pub use body::Fill`.
    exports: BTreeMap<(Module, String), Module>,
}

impl Imports {
    /// The imports of all files below `src` of a crate, without its tests.
    pub fn of(src: &Path) -> Self {
        let mut imports = Imports::default();
        imports.read(src, &[]);
        let resolved = imports.files.iter().map(|(module, paths)| {
            let found = paths.iter().filter_map(|path| imports.file(path));
            (module.clone(), found.filter(|other| other != module).collect())
        });
        Imports { files: resolved.collect(), exports: BTreeMap::new() }
    }

    fn read(&mut self, folder: &Path, module: &[String]) {
        for entry in fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("an entry").path();
            let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
            let mut inner = module.to_vec();
            if !["lib", "main", "mod"].contains(&stem.as_str()) {
                inner.push(stem.clone());
            }
            if path.is_dir() {
                self.read(&path, &inner);
            } else if path.extension().is_some_and(|extension| extension == "rs")
                && !stem.ends_with("tests")
            {
                let text = fs::read_to_string(&path).expect("a source file");
                let tokens = TokenStream::from_str(&text).expect("tokens");
                self.files.entry(inner.clone()).or_default();
                self.scan(&inner, tokens);
            }
        }
    }

    /// Records the paths in some tokens of a module.
    fn scan(&mut self, module: &Module, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut at = 0;
        let mut is_public = false;
        while at < tokens.len() {
            if is_test(&tokens[at..]) {
                at = tokens[at..]
                    .iter()
                    .position(ends_item)
                    .map_or(tokens.len(), |end| at + end + 1);
                continue;
            }
            match &tokens[at] {
                TokenTree::Ident(word) if word == "pub" => is_public = true,
                TokenTree::Ident(word) if word == "use" => {
                    let end = tokens[at..].iter().position(|it| is_punct(it, ';'));
                    let end = end.map_or(tokens.len(), |end| at + end);
                    for path in leaves(&tokens[at + 1..end]) {
                        self.note(module, &path, is_public);
                    }
                    at = end;
                    is_public = false;
                }
                TokenTree::Ident(word) if word == "crate" || word == "super" || word == "self" => {
                    let path = leaves(&tokens[at..path_end(&tokens, at)]).swap_remove(0);
                    self.note(module, &path, false);
                }
                TokenTree::Group(group) => {
                    self.scan(module, group.stream());
                    is_public &= group.delimiter() == Delimiter::Parenthesis;
                }
                TokenTree::Ident(_) => is_public = false,
                _ => {}
            }
            at += 1;
        }
    }

    fn note(&mut self, module: &Module, path: &[String], is_public: bool) {
        let Some(full) = absolute(module, path) else { return };
        if let (true, Some(name)) = (is_public, path.last()) {
            self.exports.insert((module.clone(), name.clone()), full.clone());
        }
        self.files.entry(module.clone()).or_default().insert(full);
    }

    /// The file that a path leads to, through what modules export.
    fn file(&self, path: &[String]) -> Option<Module> {
        let known =
            (0..=path.len()).rev().find(|length| self.files.contains_key(&path[..*length]))?;
        let Some(name) = path.get(known) else { return Some(path.to_vec()) };
        match self.exports.get(&(path[..known].to_vec(), name.clone())) {
            Some(export) if export[..] != path[..=known] => {
                self.file(&[&export[..], &path[known + 1..]].concat())
            }
            _ => Some(path[..known].to_vec()),
        }
    }

    /// The pairs of root modules of which the first imports the second.
    pub fn between_modules(&self) -> BTreeSet<(String, String)> {
        let pairs = self.files.iter().flat_map(|(from, to)| to.iter().map(move |to| (from, to)));
        let outer =
            pairs.filter_map(|(from, to)| Some((from.first()?.clone(), to.first()?.clone())));
        outer.filter(|(from, to)| from != to).collect()
    }

    /// The modules of the root.
    pub fn modules(&self) -> BTreeSet<String> {
        self.files.keys().filter_map(|module| module.first().cloned()).collect()
    }

    /// Files that import each other, directly or through others: sets of files that reach each other.
    pub fn circles(&self) -> BTreeSet<BTreeSet<Module>> {
        let reached: BTreeMap<_, _> =
            self.files.keys().map(|module| (module, self.reached(module))).collect();
        let circle = |module: &Module| -> BTreeSet<Module> {
            let mutual = |other: &&Module| reached[other].contains(module);
            reached[module].iter().filter(mutual).cloned().collect()
        };
        self.files.keys().map(circle).filter(|circle| circle.len() > 1).collect()
    }

    fn reached(&self, from: &Module) -> BTreeSet<Module> {
        let (mut reached, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(module) = open.pop() {
            open.extend(self.files[module].iter().filter(|next| reached.insert((*next).clone())));
        }
        reached
    }
}

/// Whether the tokens begin an item that exists only in tests.
fn is_test(tokens: &[TokenTree]) -> bool {
    let [first, TokenTree::Group(attribute), ..] = tokens else { return false };
    is_punct(first, '#') && attribute.stream().to_string().replace(' ', "") == "cfg(test)"
}

fn ends_item(token: &TokenTree) -> bool {
    let is_body = matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace);
    is_body || is_punct(token, ';')
}

fn is_punct(token: &TokenTree, char: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == char)
}

/// The end of a path that begins at `start`.
fn path_end(tokens: &[TokenTree], start: usize) -> usize {
    let is_part = |token: &TokenTree| is_punct(token, ':') || matches!(token, TokenTree::Ident(_));
    // A word after a word belongs to something else.
    let ends = |pair: &[TokenTree]| pair.iter().all(|token| matches!(token, TokenTree::Ident(_)));
    (start + 1..tokens.len())
        .find(|at| !is_part(&tokens[*at]) || ends(&tokens[at - 1..=*at]))
        .unwrap_or(tokens.len())
}

/// The paths of a `use` tree.
fn leaves(tree: &[TokenTree]) -> Vec<Vec<String>> {
    let mut path = Vec::new();
    for token in tree {
        match token {
            TokenTree::Ident(word) if word == "as" => break,
            TokenTree::Ident(word) => path.push(word.to_string()),
            TokenTree::Group(group) => {
                let items: Vec<TokenTree> = group.stream().into_iter().collect();
                let items =
                    items.split(|token| is_punct(token, ',')).filter(|item| !item.is_empty());
                return items.flat_map(leaves).map(|leaf| [&path[..], &leaf].concat()).collect();
            }
            _ => {}
        }
    }
    vec![path]
}

/// A path from the root of the crate, if it does not begin in another one. `pub(crate)` and `self` lead nowhere.
fn absolute(module: &[String], path: &[String]) -> Option<Module> {
    if path.len() < 2 && ["crate", "self", "super"].contains(&path.first()?.as_str()) {
        return None;
    }
    let supers = path.iter().take_while(|word| *word == "super").count();
    let (base, rest) = match path.first()?.as_str() {
        "crate" => (&[][..], &path[1..]),
        "self" => (module, &path[1..]),
        "super" => (&module[..module.len().checked_sub(supers)?], &path[supers..]),
        // A module inside this one, or another crate, which no file is found for.
        _ => (module, path),
    };
    Some([base, rest].concat())
}
