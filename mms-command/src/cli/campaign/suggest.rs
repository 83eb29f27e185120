//! `mms campaign FILE --suggest`: studies to paste.

use mms_campaign::Capabilities;
use mms_documents::campaign::{AffineMotion, CampaignSuggest, ProposedField, UnseenTerm};
use mms_harness::suggest::{Affine, Proposed, Suggestion, Unseen, suggest};
use mms_options::field::open;

use super::super::CommandOutcome;
use super::super::format::Printing;

/// Prints what is proposed.
pub fn propose(can: &Capabilities, printing: Printing) -> anyhow::Result<CommandOutcome> {
    let found = suggest(can, &open)?;
    printing.print_without_table(&text(&found), &document(&found))?;
    Ok(CommandOutcome::AsExpected)
}

/// Lines of TOML, of which those that are no keys are comments.
fn text(found: &Suggestion) -> String {
    let mut parts: Vec<String> = found.fields.iter().map(block).collect();
    if found.fields.is_empty() {
        parts.push(NONE.into());
    }
    let none = "# time alone: the gallery has no affine motion that this solver can run";
    parts.push(found.affine.as_ref().map_or(none.into(), in_time));
    if !found.unseen.is_empty() {
        let lines = found.unseen.iter().map(unseen);
        parts.push(format!("# not seen:\n{}", lines.collect::<Vec<_>>().join("\n")));
    }
    parts.join("\n\n")
}

/// The message if the gallery has no field for a solver, which mostly starts at rest and undeformed.
const NONE: &str = "# this solver can run no field of the gallery; write your own (`mms new NAME`):\n\
    # u times 1 - cos(w*t) starts at rest and undeformed, with an acceleration";

/// Keeps a line to the width of a page.
const WIDTH: usize = 100;

/// Words after each other in lines of comment.
fn comment(words: &[String]) -> String {
    let mut lines = vec!["#".to_owned()];
    for (at, word) in words.iter().enumerate() {
        let word = if at + 1 < words.len() { format!(" {word},") } else { format!(" {word}") };
        match lines.last_mut() {
            Some(line) if line.len() + word.len() <= WIDTH => line.push_str(&word),
            _ => lines.push(format!("#{word}")),
        }
    }
    lines.join("\n")
}

fn block(proposed: &Proposed) -> String {
    let cells: Vec<_> = proposed.cells.iter().map(usize::to_string).collect();
    let shows = comment(&proposed.shows);
    format!(
        "{shows}\n[[study]]\nfield = \"{}\"\ncells = [{}]\norder = 2",
        proposed.name,
        cells.join(", ")
    )
}

fn in_time(affine: &Affine) -> String {
    let steps: Vec<_> = affine.time_steps.iter().map(|step| format!("{step:?}")).collect();
    let note = match affine.is_quadratic {
        true => {
            "; it is quadratic in t, which an integrator of constant acceleration represents exactly as well"
        }
        false => "",
    };
    format!(
        "# time alone: linear shape functions represent this motion exactly{note}\n[[study]]\nname = \"{name} in time\"\n\
         field = \"{name}\"\ncells = [4]\ntime_steps = [{}]\norder = 2",
        steps.join(", "),
        name = affine.name
    )
}

fn unseen(unseen: &Unseen) -> String {
    let by = unseen.shown_by.as_ref().map_or(String::new(), |by| {
        let keys: Vec<_> = by.keys.iter().map(|key| format!("`{key}`")).collect();
        format!(" ({} shows it, and needs {})", by.field, keys.join(", "))
    });
    format!("#   {}: {}{by}", unseen.term, unseen.means)
}

fn document(found: &Suggestion) -> CampaignSuggest {
    let fields = found.fields.iter().map(|it| ProposedField {
        field: it.name.clone(),
        cells: it.cells.to_vec(),
        shows: it.shows.clone(),
    });
    let affine = found.affine.as_ref().map(|it| AffineMotion {
        field: it.name.clone(),
        time_steps: it.time_steps.clone(),
        exact_in_time: it.is_quadratic,
    });
    let unseen = found.unseen.iter().map(|it| UnseenTerm {
        term: it.term.clone(),
        means: it.means.to_owned(),
        shown_by: it.shown_by.as_ref().map(|by| by.field.clone()),
        needs: it.shown_by.as_ref().map(|by| by.keys.iter().map(|key| (*key).to_owned()).collect()),
    });
    CampaignSuggest { fields: fields.collect(), affine, unseen: unseen.collect() }
}
