//! The files that a run depends on: the program that its command starts, the interpreters of that program, all files named in
//! words of the command, and the modules beside them that Python files import.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use mms_files::read;

use super::digests::{Content, Digests};
use super::imports::{MOST_BYTES, imported};

/// The placeholder in a word for a path that is not known before the run.
pub const UNKNOWN: char = '\0';

/// A file that a run depends on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dependency {
    /// The path from the folder of the campaign file, if the file is in it; otherwise the whole path.
    pub name: String,
    /// The path of the file.
    pub path: PathBuf,
    /// The content of the file.
    pub content: Content,
}

impl Dependency {
    /// The dependency on a plain file; `None` if there is no such file.
    pub fn new(path: &Path, here: &Path, digests: &Digests) -> Option<Self> {
        // The path without `.` in the middle.
        let path: PathBuf = path.components().collect();
        let content = digests.of(&path)?;
        let name = path.strip_prefix(here).unwrap_or(&path).to_string_lossy().into_owned();
        Some(Dependency { name, path, content })
    }

    /// Whether the file has changed.
    pub fn has_changed(&self, digests: &Digests) -> bool {
        digests.of(&self.path).as_ref() != Some(&self.content)
    }
}

/// The files that a command depends on.
pub struct Dependencies {
    /// The files, by their names.
    pub files: BTreeMap<String, Dependency>,
    /// Whether every program and module that the command starts was found and has a digest, and the command names at least one
    /// file by its path. Otherwise the command may start something that no word names, such as a module of an interpreter.
    pub is_complete: bool,
}

/// The folders in which files of a command are searched.
pub struct SearchFolders<'a> {
    /// The folder of the campaign file.
    pub here: &'a Path,
    /// The working directory; `None` if it is a folder of the run.
    pub directory: Option<&'a Path>,
    /// The known digests.
    pub digests: &'a Digests,
}

impl SearchFolders<'_> {
    /// The files that the words of a command name. A word that names no file is split as a shell or an option would split it:
    /// `sh -c "./solve > log"` starts `./solve`, and `--input=a.txt` names `a.txt`.
    pub fn dependencies(&self, words: &[String]) -> Dependencies {
        let start = self.directory.unwrap_or(self.here);
        let is_file = |word: &str| start.join(word).is_file();
        let parts: Vec<&str> = words
            .iter()
            .flat_map(|word| if is_file(word) { vec![word.as_str()] } else { pieces(word) })
            .collect();
        let mut search = Search {
            place: self,
            folders: self.folders(&parts),
            path: std::env::var("PATH").unwrap_or_default(),
            found: Dependencies { files: BTreeMap::new(), is_complete: true },
            has_own: false,
        };
        for (at, part) in parts.iter().enumerate() {
            if let Some(path) = part.strip_prefix("PATH=") {
                search.path = path.to_owned();
            }
            let is_module = at > 0 && parts[at - 1] == "-m";
            let is_found = if is_module { search.module(part) } else { search.part(part, at == 0) };
            search.found.is_complete &= is_found || !(is_module || at == 0);
        }
        search.found.is_complete &= search.has_own;
        search.found
    }

    /// The folders from which relative paths may start: the working directory, and folders that the command names, as in `cd
    /// build && ./solve`.
    fn folders(&self, parts: &[&str]) -> Vec<PathBuf> {
        let Some(directory) = self.directory else { return Vec::new() };
        let named = parts.iter().map(|part| directory.join(part)).filter(|path| path.is_dir());
        let mut folders = vec![directory.to_owned()];
        folders.extend(named.take(MOST_FOLDERS));
        folders
    }
}

/// The most folders that are searched.
const MOST_FOLDERS: usize = 16;

/// The most files of a command.
const MOST_FILES: usize = 1000;

/// The search for the files of a command.
struct Search<'a> {
    place: &'a SearchFolders<'a>,
    folders: Vec<PathBuf>,
    /// The variable PATH.
    path: String,
    found: Dependencies,
    /// Whether a file that the command names by its path was found.
    has_own: bool,
}

impl Search<'_> {
    /// Adds the files, and a program on the PATH, that a part of the command names. Returns whether there is one.
    fn part(&mut self, part: &str, is_program: bool) -> bool {
        if part.contains(UNKNOWN) {
            return false;
        }
        let part = &expanded(part);
        let is_name = !part.contains('/');
        let mut is_found = false;
        // A program without a slash is searched only on the PATH.
        if !(is_program && is_name) {
            let paths: Vec<PathBuf> = match Path::new(part).is_absolute() {
                true => vec![PathBuf::from(part)],
                false => self.folders.iter().map(|folder| folder.join(part)).collect(),
            };
            for path in paths {
                is_found |= self.file(&path);
            }
            self.has_own |= is_found;
        }
        if is_name && let Some(path) = self.on_path(part) {
            is_found |= self.file(&path);
        }
        is_found
    }

    /// Adds the files of a module that follows `-m`.
    fn module(&mut self, name: &str) -> bool {
        let base = name.replace('.', "/");
        let of = |end: &str| format!("{base}{end}");
        let ends = [".py", "/__main__.py", "/__init__.py"].map(of);
        ends.map(|it| self.part(&it, false)).contains(&true)
    }

    /// Adds a file, the interpreters that its first line names, and the modules that it imports.
    fn file(&mut self, path: &Path) -> bool {
        // Python searches the folder of the script, and other folders that the environment names.
        let mut folders = self.folders.clone();
        folders.extend(path.parent().map(Path::to_owned));
        let mut paths = vec![path.to_owned()];
        let mut is_found = false;
        while let Some(path) = paths.pop() {
            let Some(found) = Dependency::new(&path, self.place.here, self.place.digests) else {
                continue;
            };
            is_found = true;
            let has_room = self.found.files.len() < MOST_FILES;
            self.found.is_complete &= has_room && matches!(found.content, Content::Digest(_));
            if has_room && self.found.files.insert(found.name.clone(), found).is_none() {
                paths.extend(self.interpreters(&path));
                paths.extend(modules(&path, &folders));
            }
        }
        is_found
    }

    /// The programs in a first line such as `#!/usr/bin/env python3`.
    fn interpreters(&self, path: &Path) -> Vec<PathBuf> {
        let first = read::first(path, 256).unwrap_or_default();
        let Some(rest) = first.strip_prefix(b"#!") else { return Vec::new() };
        let line =
            String::from_utf8_lossy(rest.split(|byte| *byte == b'\n').next().unwrap_or(rest));
        let program = |word: &str| match word.contains('/') {
            true => Some(PathBuf::from(word)),
            false => self.on_path(word),
        };
        line.split_whitespace().filter_map(program).collect()
    }

    /// The program of a name on the PATH.
    fn on_path(&self, name: &str) -> Option<PathBuf> {
        let start = self.place.directory.unwrap_or(self.place.here);
        let mut paths = std::env::split_paths(&self.path).map(|it| start.join(it).join(name));
        paths.find(|it| is_program(it))
    }
}

/// The files that a Python file may import from its own folder and from others.
fn modules(path: &Path, others: &[PathBuf]) -> Vec<PathBuf> {
    let Some(folder) = path.parent().filter(|_| path.extension().is_some_and(|it| it == "py"))
    else {
        return Vec::new();
    };
    let text = read::first(path, MOST_BYTES).unwrap_or_default();
    imported(&String::from_utf8_lossy(&text), folder, others)
}

/// Whether a path leads to a file that can be started.
fn is_program(path: &Path) -> bool {
    #[cfg(unix)]
    let can_start = |found: &std::fs::Metadata| {
        use std::os::unix::fs::PermissionsExt as _;
        found.permissions().mode() & 0o111 != 0
    };
    #[cfg(not(unix))]
    let can_start = |_: &std::fs::Metadata| true;
    path.metadata().is_ok_and(|found| found.is_file() && can_start(&found))
}

/// The parts of a word between separators of a shell, an option or a list, without files that a shell or `tee` would write.
fn pieces(word: &str) -> Vec<&str> {
    let is_between = |c: char| c.is_whitespace() || "=:;,|&<>()\"'`".contains(c);
    // An assignment of PATH is needed as a whole.
    if word.starts_with("PATH=") {
        return vec![word];
    }
    let (mut found, mut rest) = (Vec::new(), word);
    let (mut is_written, mut is_tee) = (false, false);
    loop {
        let (piece, behind) = rest.split_at(rest.find(is_between).unwrap_or(rest.len()));
        if !piece.is_empty() {
            if !is_written && !is_tee {
                found.push(piece);
            }
            is_written = false;
            is_tee |= piece == "tee";
        }
        let Some(between) = behind.chars().next() else { return found };
        is_written = between == '>' || (is_written && between.is_whitespace());
        is_tee &= !"|;&".contains(between);
        rest = &behind[between.len_utf8()..];
    }
}

/// Expands a path whose first part is `~`, `$NAME` or `${NAME}`, as a shell does.
fn expanded(path: &str) -> String {
    let (first, rest) = path.split_at(path.find('/').unwrap_or(path.len()));
    let name = match first {
        "~" => Some("HOME"),
        _ => first.strip_prefix('$').map(|name| name.trim_matches(['{', '}'])),
    };
    match name.and_then(|name| std::env::var(name).ok()) {
        Some(value) => value + rest,
        None => path.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn words_are_taken_apart_and_what_is_written_is_left_out() {
        for (word, parts) in [
            ("--input=a.txt", vec!["--input", "a.txt"]),
            (
                "cd b && ./solve < in > log.txt 2>err; python3 c.py",
                vec!["cd", "b", "./solve", "in", "2", "python3", "c.py"],
            ),
            ("./solve | tee -a log.txt; cat in", vec!["./solve", "tee", "cat", "in"]),
            ("f(\"x.m\")", vec!["f", "x.m"]),
            ("a.jar:b.jar", vec!["a.jar", "b.jar"]),
            ("", vec![]),
        ] {
            assert_eq!(pieces(word), parts, "{word}");
        }
    }

    #[test]
    fn the_first_part_of_a_path_may_be_a_variable() {
        let value = std::env::var("PATH").unwrap();
        for text in ["$PATH/x/y", "${PATH}/x/y"] {
            assert_eq!(expanded(text), format!("{value}/x/y"));
        }
        assert_eq!(expanded("$PATH"), value);
        for text in ["x/$PATH", "$NO_SUCH_VARIABLE/x", "$1", "~else/x", ""] {
            assert_eq!(expanded(text), text);
        }
    }

    fn names(all: &Dependencies) -> Vec<&str> {
        all.files.keys().map(String::as_str).filter(|it| !it.starts_with('/')).collect()
    }

    #[test]
    fn whatever_a_command_starts_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        fs::create_dir_all(here.join("build/pkg/sub")).unwrap();
        let files =
            ["solve", "build/solve", "build/run.py", "build/pkg/sub/__main__.py", "build/c.txt"];
        for file in files {
            mms_files::write::write_whole(&here.join(file), file).unwrap();
        }
        let build = here.join("build");
        let digests = Digests::default();
        let of = |directory: Option<&Path>, words: &[&str]| {
            let words: Vec<String> = words.iter().map(|it| (*it).to_owned()).collect();
            SearchFolders { here, directory, digests: &digests }.dependencies(&words)
        };
        for (directory, words, found, is_complete) in [
            (here, vec!["./solve", "8"], vec!["solve"], true),
            (&build, vec!["./solve", "8"], vec!["build/solve"], true),
            (
                here,
                vec!["sh", "-c", "cd build && ./solve > out"],
                vec!["build/solve", "solve"],
                true,
            ),
            (
                &build,
                vec!["sh", "run.py", "--with=c.txt"],
                vec!["build/c.txt", "build/run.py"],
                true,
            ),
            (&build, vec!["sh", "-m", "pkg.sub"], vec!["build/pkg/sub/__main__.py"], true),
            // The started programs are not completely known.
            (&build, vec!["sh", "-m", "elsewhere", "c.txt"], vec!["build/c.txt"], false),
            (here, vec!["sh", "-c", "true"], vec![], false),
            (here, vec!["solve"], vec![], false),
            (here, vec!["./none", "solve"], vec!["solve"], false),
            (here, vec!["\0/solve", "solve"], vec!["solve"], false),
        ] {
            let all = of(Some(directory), &words);
            assert_eq!((names(&all), all.is_complete), (found, is_complete), "{words:?}");
        }
        assert!(!of(None, &["./solve"]).is_complete);
        let absolute = here.join("solve").to_string_lossy().into_owned();
        assert_eq!(names(&of(None, &[&absolute])), ["solve"]);
        let shell = of(Some(here), &["sh"]);
        assert!(shell.files.keys().any(|it| it.ends_with("/sh")), "on the PATH");
    }

    #[test]
    fn a_script_depends_on_the_modules_that_it_imports() {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        fs::create_dir_all(here.join("code/pkg")).unwrap();
        for (file, text) in [
            ("code/solve.py", "import numpy, mesh\nfrom pkg.law import stress\n"),
            ("code/mesh.py", "def f():\n    from solve import x\n"),
            ("code/pkg/__init__.py", ""),
            ("code/pkg/law.py", "from . import moduli\n"),
            ("code/pkg/moduli.py", "import pkg.other\n"),
            ("code/pkg/other.py", ""),
            ("code/unused.py", ""),
        ] {
            mms_files::write::write_whole(&here.join(file), text).unwrap();
        }
        let digests = Digests::default();
        let of = |directory: &Path, words: [&str; 2]| {
            let words = words.map(str::to_owned);
            SearchFolders { here, directory: Some(directory), digests: &digests }
                .dependencies(&words)
        };
        let all = ["mesh", "pkg/__init__", "pkg/law", "pkg/moduli", "pkg/other", "solve"];
        let all = all.map(|it| format!("code/{it}.py"));
        for (directory, script) in
            [(here.join("code"), "solve.py"), (here.to_owned(), "code/solve.py")]
        {
            let found = of(&directory, ["sh", script]);
            assert_eq!(names(&found), all);
            assert!(found.is_complete);
        }
    }

    #[test]
    #[cfg(unix)]
    fn a_script_depends_on_its_interpreter_and_a_change_is_seen() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        let at = |name: &str| here.join(name);
        let text = format!("#!/usr/bin/env {}\n", at("own").display());
        mms_files::write::write_whole(&at("first"), &text).unwrap();
        mms_files::write::write_whole(&at("own"), "1").unwrap();
        symlink("first", at("solve")).unwrap();
        let digests = Digests::default();
        let place = SearchFolders { here, directory: Some(here), digests: &digests };
        let all = place.dependencies(&["./solve".to_owned()]);
        assert_eq!(names(&all), ["own", "solve"]);
        assert!(all.files.keys().any(|it| it.ends_with("/env")));
        let changed = || -> Vec<&str> {
            let all = all.files.values().filter(|it| it.has_changed(&digests));
            all.map(|it| it.name.as_str()).collect()
        };
        assert_eq!(changed(), [""; 0]);
        mms_files::write::write_whole(&at("own"), "2").unwrap();
        assert_eq!(changed(), ["own"]);
        mms_files::write::write_whole(&at("first"), "2").unwrap();
        assert_eq!(changed(), ["own", "solve"], "behind the link");
        fs::remove_file(at("own")).unwrap();
        assert_eq!(changed(), ["own", "solve"]);
    }
}
