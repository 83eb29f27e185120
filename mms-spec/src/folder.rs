//! The field files of a folder, for build scripts that embed or compile them.

use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::material::own_material;

/// A field file, and the path of its own material file.
#[derive(Clone, Debug)]
pub struct FieldFile {
    /// The stem of the file, which is the name of the field.
    pub name: String,
    /// The path of the file.
    pub path: PathBuf,
    /// The text of the file.
    pub text: String,
    /// The path of its own material's file, if it has one.
    pub material: Option<PathBuf>,
}

impl FieldFile {
    /// All files that the field is made of.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        [Some(&self.path), self.material.as_ref()].into_iter().flatten().map(PathBuf::as_path)
    }

    /// The texts of the field and of its material, if it has one, as Rust expressions for a build script to write.
    pub fn included(&self) -> [String; 2] {
        let material = self.material.as_ref().map(|path| format!("Some(include_str!({path:?}))"));
        [format!("include_str!({:?})", self.path), material.unwrap_or("None".into())]
    }

    /// The text of the material's file, for the `Loader` of the compiler.
    pub fn load_material(&self) -> Result<String, String> {
        let path = self.material.as_ref().ok_or("the field has no material of its own")?;
        fs::read_to_string(path).map_err(|error| error.to_string())
    }
}

/// The files `*.toml` of a folder, in the order of their names.
///
/// # Errors
///
/// If the folder or a file in it cannot be read.
pub fn field_files(folder: &Path) -> io::Result<Vec<FieldFile>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let text = fs::read_to_string(&path)?;
            let material = own_material(&text).map(|material| path.with_file_name(material));
            files.push(FieldFile { name, path, text, material });
        }
    }
    files.sort_by(|one, other| one.name.cmp(&other.name));
    Ok(files)
}
