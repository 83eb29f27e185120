//! Says which earlier results a command replaces, if they are of another command or another field.

use std::path::Path;

use mms_files::read::{self, FileKind};
use mms_spec::foreign::{path, shown};
use serde::Deserialize;

use super::say;
use crate::provenance::Provenance;

/// A document that is replaced: its provenance.
#[derive(Deserialize)]
struct OldDocument {
    provenance: Provenance,
}

/// A line for the document of that name in a folder, which new results of this origin replace.
pub fn tell(folder: &Path, name: &str, new: &Provenance) {
    let file = folder.join(name).with_extension("json");
    if !file.is_file() {
        return;
    }
    // No document of these commands is no earlier result.
    let Ok(text) = read::text(&file, FileKind::Result) else { return };
    let Ok(OldDocument { provenance: old }) = serde_json::from_str(&text) else { return };
    if (&old.kind, &old.input.field) != (&new.kind, &new.input.field) {
        let of = old.input.field.map_or(String::new(), |field| format!(" of {}", shown(&field)));
        say(format_args!(
            "note: `{}` held results of `mms {}`{of}, and is replaced; `--output` names another folder",
            path(&file),
            shown(&old.kind)
        ));
    }
}
