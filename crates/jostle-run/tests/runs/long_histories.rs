//! Histories beyond what stays in memory: the same numbers and files as in memory, and faults of the disk.

use std::ops::ControlFlow;
use std::path::Path;

use jostle::history::{BlockStore, Storage};
use jostle::{Column, History, RunEnd, Settings, Solver, StepError};
use jostle_run::{Content, Opened, Ran, STORAGE};
use jostle_testkit::files::sound;

/// Elastic, with histories of members.
fn by_modes() -> String {
    let text = include_str!("../../../../examples/row_of_three.toml");
    let text = text.replace("duration = \"15 s\"", "duration = \"6 s\"");
    let members = "[output]\nmembers = [\"C.column.1.2\", \"C.beam.2.1\"]\ninterval = \"5 ms\"\n";
    text.replace("No. 3\"", "C\"")
        .replace("[report]", &format!("{members}[report]"))
}

/// Two yielding storeys beside a frame.
fn by_steps() -> String {
    let yields = "stiffness = \"120 MN/m\"\nhinges = { rule = \"bilinear\", yield = \"4 mm\", post_yield = 0.1 }";
    by_modes().replace("stiffness = \"120 MN/m\"", yields)
}

/// Shear buildings that yield.
fn by_series() -> String {
    let building = |name: &str, stiffness: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"shear\"\nstoreys = 3\nstorey_height = \"3 m\"\nmass = \"90 t\"\nstiffness = \"{stiffness}\"\nhinges = {{ rule = \"bilinear\", yield = \"4 mm\", post_yield = 0.1 }}\n"
        )
    };
    let gap = "[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"5 mm\"\nlaw = \"linear\"\nstiffness = \"200 MN/m\"\n";
    let motion = "[motion]\nrecord = \"el-centro-1940-ns\"\npga = \"0.3 g\"\nduration = \"6 s\"\n";
    let [a, b] = [building("A", "90 MN/m"), building("B", "60 MN/m")];
    format!("{motion}{a}{b}{gap}")
}

fn run(text: &str, storage: Storage) -> Ran {
    let opened = Opened::new(sound(text), "model").unwrap_or_else(|error| panic!("{error}"));
    let prepared = opened.prepare().unwrap_or_else(|error| panic!("{error}"));
    let settings = Settings {
        storage,
        ..prepared.settings(true)
    };
    let mut observer = |_, _| ControlFlow::Continue(());
    let mut ran = prepared.run(settings, &mut observer);
    ran.run_without_contact(settings, &mut observer);
    ran.wall = 0.0;
    ran
}

/// The usual storage with blocks of a few rows.
const SHORT_BLOCKS: Storage = Storage {
    block: 4000,
    ..STORAGE
};

fn history(ran: &Ran) -> &History {
    ran.outcome.history.as_ref().expect("it was recorded")
}

fn columns(history: &History) -> Vec<Vec<u64>> {
    let columns = history.columns().iter();
    let values = columns.map(|column| history.column(*column).expect("it has it"));
    let bits = values.map(|values| values.into_iter().map(f64::to_bits).collect());
    bits.collect()
}

fn files(ran: &Ran) -> Vec<(String, Vec<u8>)> {
    let folder = tempfile::tempdir().expect("a folder");
    let summary = ran.summary();
    let written = ran.results(&summary).write(folder.path(), Content::ALL);
    written.unwrap_or_else(|error| panic!("{error}"));
    let list = std::fs::read_dir(folder.path()).expect("a folder");
    let mut files: Vec<_> = list
        .map(|entry| {
            let entry = entry.expect("a file");
            let name = entry.file_name().to_string_lossy().into_owned();
            (name, std::fs::read(entry.path()).expect("a file"))
        })
        .collect();
    files.sort();
    files
}

#[test]
fn long_histories_are_those_in_memory() {
    let cases = [
        (by_modes(), Solver::Modal),
        (by_steps(), Solver::Riccati),
        (by_series(), Solver::Series),
    ];
    for (text, solver) in cases {
        let [short, long] = [Storage::MEMORY, SHORT_BLOCKS].map(|storage| run(&text, storage));
        assert_eq!(long.prepared.plan.solver, solver);
        assert_eq!(long.outcome.end, RunEnd::Completed);
        let kept = history(&long);
        // Far beyond the four blocks in memory.
        assert!(8 * kept.len() * kept.columns().len() > 50 * SHORT_BLOCKS.block);
        assert_eq!(columns(history(&short)), columns(kept), "{solver:?}");
        for row in [0, kept.len() / 2, kept.len() - 1] {
            assert_eq!(history(&short).row(row), kept.row(row));
        }
        let [known, found] = [&short, &long].map(|ran| &ran.outcome);
        assert_eq!(known.spring_history, found.spring_history);
        assert_eq!(known.member_history, found.member_history);
        assert_eq!(found.member_history.is_some(), solver != Solver::Series);
        assert_eq!(found.spring_history.is_some(), solver != Solver::Modal);
        let [known, found] = [files(&short), files(&long)];
        let names = |list: &[(String, Vec<u8>)]| -> Vec<String> {
            list.iter().map(|(name, _)| name.clone()).collect()
        };
        assert_eq!(names(&known), names(&found));
        assert!(names(&found).iter().any(|name| name == "history.parquet"));
        for ((name, known), (_, found)) in known.iter().zip(&found) {
            assert!(known == found, "{name} of {solver:?} differs");
        }
    }
}

/// A store with room for three blocks.
#[derive(Debug, Default)]
struct Small(Vec<Vec<f64>>);

impl BlockStore for Small {
    fn add(&mut self, block: Vec<f64>) -> Result<(), String> {
        if self.0.len() == 3 {
            return Err("no space is left; free some".to_owned());
        }
        self.0.push(block);
        Ok(())
    }

    fn read(&self, block: usize, first: usize, numbers: &mut [f64]) -> Result<(), String> {
        numbers.copy_from_slice(&self.0[block][first..first + numbers.len()]);
        Ok(())
    }
}

#[test]
fn a_full_disk_ends_the_run_and_is_told() {
    let storage = Storage {
        block: 4000,
        store: || Box::new(Small::default()),
    };
    for text in [by_modes(), by_steps(), by_series()] {
        let [whole, ended] = [Storage::MEMORY, storage].map(|storage| run(&text, storage));
        let RunEnd::Failed(error @ StepError::HistoryNotKept { time, .. }) = &ended.outcome.end
        else {
            panic!("{:?}", ended.outcome.end)
        };
        let told = error.to_string();
        assert!(told.ends_with("no space is left; free some"), "{told}");
        assert!(*time < whole.outcome.state.time);
        // All until then is there, and is written.
        let [whole, ended_at] = [&whole, &ended].map(|ran| columns(history(ran)));
        assert!(ended_at[0].len() > 3);
        if ended.prepared.plan.solver != Solver::Riccati {
            for (whole, ended) in whole.iter().zip(&ended_at) {
                assert_eq!(whole[..ended.len()], ended[..]);
            }
        }
        assert!(
            files(&ended)
                .iter()
                .any(|(name, _)| name == "history.parquet")
        );
    }
}

/// A store that forgets.
#[derive(Debug, Default)]
struct Unreadable;

impl BlockStore for Unreadable {
    fn add(&mut self, _: Vec<f64>) -> Result<(), String> {
        Ok(())
    }

    fn read(&self, _: usize, _: usize, _: &mut [f64]) -> Result<(), String> {
        Err("it cannot be read".to_owned())
    }
}

#[test]
fn what_cannot_be_read_back_is_written_nowhere() {
    let storage = Storage {
        block: 4000,
        store: || Box::new(Unreadable),
    };
    let ran = run(&by_modes(), storage);
    let RunEnd::Failed(error) = &ran.outcome.end else {
        panic!("{:?}", ran.outcome.end)
    };
    assert!(error.to_string().ends_with("it cannot be read"), "{error}");
    let folder = tempfile::tempdir().expect("a folder");
    let summary = ran.summary();
    let written = ran.results(&summary).write(folder.path(), Content::ALL);
    let told = written.expect_err("zeros in files").to_string();
    assert!(told.contains("it cannot be read"), "{told}");
    let left = std::fs::read_dir(Path::new(folder.path())).expect("a folder");
    assert_eq!(left.count(), 0);
    // Readers get zeros, and can ask.
    assert_eq!(history(&ran).column(Column::TIME).map(|t| t[0]), Some(0.0));
    assert_eq!(history(&ran).fault(), Some("it cannot be read"));
}
