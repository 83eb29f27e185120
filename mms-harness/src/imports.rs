//! The modules that a Python file imports from folders that are known.

use std::path::{Path, PathBuf};

/// The most bytes of a file in which imports are searched.
pub const MOST_BYTES: u64 = 1 << 20;

/// A module in an import: `..a.b` has two dots and the parts a and b.
struct Module<'a> {
    dots: usize,
    parts: Vec<&'a str>,
}

impl<'a> Module<'a> {
    fn of(text: &'a str) -> Self {
        let name = text.trim_start_matches('.');
        let parts = name.split('.').filter(|it| !it.is_empty()).collect();
        Module { dots: text.len() - name.len(), parts }
    }

    /// A module, class or function in this one: only the files tell which.
    fn with(&self, name: &'a str) -> Self {
        Module { dots: self.dots, parts: self.parts.iter().copied().chain([name]).collect() }
    }

    /// The files that may hold this module and the packages around it. Dots lead from the folder of the importing file
    /// upwards; without dots, the module is in that folder or in another one.
    fn files(&self, own: &Path, others: &[PathBuf]) -> Vec<PathBuf> {
        let folders: Vec<&Path> = match self.dots {
            0 => [own].into_iter().chain(others.iter().map(PathBuf::as_path)).collect(),
            dots => own.ancestors().nth(dots - 1).into_iter().collect(),
        };
        let mut found = Vec::new();
        for folder in folders {
            let mut path = folder.to_owned();
            // A package is imported before the modules in it.
            if self.dots > 0 {
                found.push(path.join("__init__.py"));
            }
            for part in &self.parts {
                path.push(part);
                found.extend([path.with_extension("py"), path.join("__init__.py")]);
            }
        }
        found
    }
}

/// The files that a Python file in a folder may import; many of them do not exist. `others` are folders in which Python also
/// searches. Imports that the program computes are not found.
pub fn imported(text: &str, own: &Path, others: &[PathBuf]) -> Vec<PathBuf> {
    text.lines().flat_map(modules).flat_map(|it| it.files(own, others)).collect()
}

/// The modules in a line such as `import a.b as c, d` or `from .a import b`.
fn modules(line: &str) -> Vec<Module<'_>> {
    let line = line.split('#').next().unwrap_or(line).trim();
    if let Some(names) = line.strip_prefix("import ") {
        return names.split(',').filter_map(name).map(Module::of).collect();
    }
    let Some((module, names)) =
        line.strip_prefix("from ").and_then(|rest| rest.split_once(" import"))
    else {
        return Vec::new();
    };
    let module = Module::of(module.trim());
    let inner = names.split([',', '(', ')']).filter_map(name).map(|it| module.with(it));
    let inner: Vec<_> = inner.collect();
    [module].into_iter().chain(inner).collect()
}

/// The name before ` as `.
fn name(text: &str) -> Option<&str> {
    text.split_whitespace().next()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(line: &str) -> Vec<String> {
        let others = [PathBuf::from("code")];
        let all = imported(line, Path::new("code/pkg"), &others);
        all.iter().map(|it| it.display().to_string()).collect()
    }

    #[test]
    fn imports_lead_to_files() {
        assert_eq!(
            found("import a.b as c, d  # import e"),
            [
                "code/pkg/a.py",
                "code/pkg/a/__init__.py",
                "code/pkg/a/b.py",
                "code/pkg/a/b/__init__.py",
                "code/a.py",
                "code/a/__init__.py",
                "code/a/b.py",
                "code/a/b/__init__.py",
                "code/pkg/d.py",
                "code/pkg/d/__init__.py",
                "code/d.py",
                "code/d/__init__.py",
            ]
        );
        assert_eq!(found("    from . import (a)").last().unwrap(), "code/pkg/a/__init__.py");
        let above = found("from ..law import P");
        assert!(above.contains(&"code/law.py".to_owned()), "{above:?}");
        assert!(above.contains(&"code/__init__.py".to_owned()), "{above:?}");
        for line in [
            "",
            "# import a",
            "important = 1",
            "from a",
            "print('import a')",
            "from ....... import a",
        ] {
            assert_eq!(found(line), [""; 0], "{line}");
        }
    }
}
