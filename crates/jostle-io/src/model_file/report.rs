//! Reads `[report]`: the title block of reports, and checks that they do not show.

use jostle::judgement::{named, names};

use crate::keys::Section;
use crate::nearest::nearest;
use crate::reader::{Field, Reader, View};

/// What stands in the title block of a report beside the title; all of it may be absent.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TitleBlock {
    /// Name of the project.
    pub project: Option<String>,
    /// Whom it is made for.
    pub client: Option<String>,
    /// Who made it.
    pub author: Option<String>,
    /// Its date, as the file writes it.
    pub date: Option<String>,
}

/// Reads `[report]`.
pub(super) fn read(reader: &mut Reader<'_>, field: &Field<'_>) -> (TitleBlock, Vec<&'static str>) {
    let Some(view) = reader.open(field, &[Section::Report]) else {
        return Default::default();
    };
    let mut text = |key| {
        let field = reader.get(&view, key)?;
        reader.text(&field)
    };
    let title_block = TitleBlock {
        project: text("project"),
        client: text("client"),
        author: text("author"),
        date: text("date"),
    };
    (title_block, silenced(reader, &view))
}

/// Checks that `[report]` silences.
fn silenced(reader: &mut Reader<'_>, view: &View<'_>) -> Vec<&'static str> {
    let Some(field) = reader.get(view, "silence") else {
        return Vec::new();
    };
    let entries = field.entries().unwrap_or_else(|| vec![field.clone()]);
    let mut silenced = Vec::new();
    for entry in &entries {
        let Some(name) = reader.text(entry) else {
            continue;
        };
        match named(&name) {
            Some(found) => silenced.extend(found),
            None => {
                let meant = nearest(&name, names().into_iter());
                *reader.bad(entry, format!("\"{name}\" is no check")) = Some(match meant {
                    Some(meant) => format!("did you mean \"{meant}\"?"),
                    None => "docs/checks.md lists all checks; write an identifier such as \"A12\", or a name such as \"records\"".to_owned(),
                });
            }
        }
    }
    silenced.sort_unstable();
    silenced.dedup();
    silenced
}
