//! Results of many models on record, number by number. A change of structure must not change them.
//!
//! Every model is run as the command line runs it, by every solver that is listed for it. All numbers and texts of its summary are
//! recorded but the wall time and the version; long lists and histories as digests, part by part, with their extremes or last
//! values. A comparison names the model, the number that moved first and the one that moved most.

mod answers;
mod compared;
mod digest;
mod drawing;
mod examples;
mod families;
mod histories;
mod in_plane;
mod in_space;
mod isolated;
mod linked;
mod numbers;
mod on_grounds;
mod on_soil;
mod parts;
mod pinned;
mod recorded;
mod run_results;
mod yielding;

use std::path::Path;

use jostle_io::write_atomically;
use rayon::prelude::*;

pub use compared::{Change, Moved};
use families::{Case, FAMILIES, Family};
use numbers::Entries;
use recorded::{Recorded, pack, unpack};

/// Names of the families of models.
pub fn names() -> impl Iterator<Item = &'static str> {
    FAMILIES.iter().map(|family| family.name)
}

/// Results of this program beside those on record.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Models, each under one solver.
    pub results: usize,
    /// Numbers, texts and digests on record.
    pub values: usize,
    /// Those that moved.
    pub moved: Vec<Moved>,
}

/// Compares the results of families with the files in a folder; of all families if none is named.
///
/// # Errors
/// A family that does not exist, or a file that cannot be read, in words.
pub fn compare(folder: &Path, only: &[String]) -> Result<Comparison, String> {
    let chosen = chosen(only)?;
    let mut recorded = Vec::new();
    for family in &chosen {
        let file = folder.join(family.file());
        let bytes = std::fs::read(&file).map_err(|e| format!("{}: {e}", file.display()))?;
        let all = unpack(&bytes);
        recorded.push(all.ok_or_else(|| format!("{}: not a file of results", file.display()))?);
    }
    let mut moved = Vec::new();
    let (mut results, mut values) = (0, 0);
    for (old, new) in recorded.iter().zip(compute(&chosen)) {
        results += new.len();
        values += old.iter().map(|old| old.entries.len()).sum::<usize>();
        let nothing = Entries::new();
        for result in &new {
            let on_record = old.iter().find(|other| other.name == result.name);
            let on_record = on_record.map_or(&nothing, |other| &other.entries);
            moved.extend(Moved::find(&result.name, on_record, &result.entries));
        }
        let gone = old
            .iter()
            .filter(|old| new.iter().all(|other| other.name != old.name));
        moved.extend(gone.filter_map(|gone| Moved::find(&gone.name, &gone.entries, &nothing)));
    }
    Ok(Comparison {
        results,
        values,
        moved,
    })
}

/// Records the results of families in a folder; of all families if none is named. Returns the number of bytes written.
///
/// # Errors
/// A family that does not exist, or a file that cannot be written.
pub fn record(folder: &Path, only: &[String]) -> Result<usize, String> {
    let chosen = chosen(only)?;
    let write = |file: &str, bytes: &[u8]| {
        write_atomically(&folder.join(file), bytes).map_err(|error| error.to_string())
    };
    let mut written = 0;
    for (family, results) in chosen.iter().zip(compute(&chosen)) {
        let bytes = pack(&results).map_err(|error| error.to_string())?;
        write(&family.file(), &bytes)?;
        written += bytes.len();
    }
    Ok(written)
}

/// Families of these names; all if there are none.
fn chosen(only: &[String]) -> Result<Vec<&'static Family>, String> {
    if let Some(unknown) = only
        .iter()
        .find(|name| !names().any(|known| known == **name))
    {
        let known: Vec<&str> = names().collect();
        return Err(format!(
            "there is no family {unknown}; there are {}",
            known.join(", ")
        ));
    }
    let wanted = |family: &&Family| only.is_empty() || only.iter().any(|name| name == family.name);
    Ok(FAMILIES.iter().filter(wanted).collect())
}

/// Results of families, on all processors, in the order of their cases.
fn compute(families: &[&Family]) -> Vec<Vec<Recorded>> {
    let cases: Vec<(usize, Case)> = families
        .iter()
        .enumerate()
        .flat_map(|(index, family)| family.cases().into_iter().map(move |case| (index, case)))
        .collect();
    let computed: Vec<(usize, Recorded)> = cases
        .into_par_iter()
        .with_max_len(1)
        .map(|(index, case)| (index, case.recorded()))
        .collect();
    let mut sorted: Vec<Vec<Recorded>> = families.iter().map(|_| Vec::new()).collect();
    for (index, recorded) in computed {
        sorted[index].push(recorded);
    }
    sorted
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;
    use std::path::Path;

    use super::families::FAMILIES;
    use super::unpack;

    #[test]
    fn models_have_names_of_their_own() {
        let names: Vec<String> = FAMILIES
            .iter()
            .flat_map(|family| family.cases())
            .map(|case| case.name)
            .collect();
        let different: HashSet<&String> = names.iter().collect();
        assert_eq!(different.len(), names.len());
    }

    #[test]
    fn every_model_is_run_by_some_solver() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/pins");
        for family in FAMILIES.iter().filter(|family| family.name != "answers") {
            let bytes = std::fs::read(folder.join(family.file())).expect("part of the repository");
            let recorded = unpack(&bytes).expect("a file of results");
            for model in (family.models)() {
                let unpack = recorded.iter().filter(|unpack| {
                    let name = unpack.name.strip_prefix(&model.name);
                    name.is_some_and(|solver| solver.starts_with(' '))
                });
                let refused = |path: &str| path == ".refused" || path == ".unread";
                let mut run =
                    unpack.filter(|unpack| unpack.entries.iter().all(|(path, _)| !refused(path)));
                let problem = model.input.as_ref().err();
                assert!(run.next().is_some(), "{}: {problem:?}", model.name);
            }
        }
    }
}
