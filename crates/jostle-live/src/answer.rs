//! Answers to the requests of a page, however they reach it.

use std::ops::ControlFlow;

use jostle::stepping::Progress;
use jostle_io::ModelTree;

use crate::curve::{self, Cases};
use crate::engine::{Engine, Solved, Trouble};
use crate::message::{Axis, Curve, Reply, Run};

/// A message to the page.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// JSON.
    Text(String),
    /// JSON and numbers; see `binary` in `message`.
    Binary(Vec<u8>),
}

/// A reply as JSON.
pub(crate) fn say(reply: &Reply<'_>) -> Answer {
    Answer::Text(serde_json::to_string(reply).unwrap_or_default())
}

/// The first message of a page.
pub(crate) fn hello(engine: &Engine) -> Answer {
    say(&Reply::Hello {
        name: engine.name(),
        text: engine.text(),
        records: engine.records(),
        knobs: engine.knobs(),
        version: env!("CARGO_PKG_VERSION"),
    })
}

/// The frame of a run with the run itself, or why there is none.
pub(crate) fn frame(
    engine: &Engine,
    run: &Run,
    watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
) -> (Answer, Option<Solved>) {
    let mut found = None;
    let answer = with_tree(engine, run, |tree| {
        let (bytes, solved) = engine.frame(run.id, tree, run.record, watch)?;
        found = Some(solved);
        Ok(Answer::Binary(bytes))
    });
    (answer, found)
}

/// What takes longer than the frame and is not seen at first: whether results are sensitive.
pub(crate) fn accuracy(
    id: u64,
    solved: Solved,
    watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
) -> Option<Answer> {
    let (text, notes) = solved.sensitive(watch)?;
    Some(say(&Reply::Accuracy { id, text, notes }))
}

/// The report of a run as a file, or why there is none.
pub(crate) fn report(
    engine: &Engine,
    run: &Run,
    watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
) -> Answer {
    with_tree(engine, run, |tree| {
        let text = engine.report(tree, run.record, watch)?;
        Ok(say(&Reply::File {
            id: run.id,
            name: "report.html".into(),
            kind: "text/html",
            text,
        }))
    })
}

fn with_tree(
    engine: &Engine,
    run: &Run,
    make: impl FnOnce(&ModelTree) -> Result<Answer, Trouble>,
) -> Answer {
    match engine.tree(run) {
        Err(trouble) => no_frame(run.id, trouble, None),
        Ok(tree) => make(&tree).unwrap_or_else(|trouble| no_frame(run.id, trouble, Some(&tree))),
    }
}

pub(crate) fn no_frame(id: u64, trouble: Trouble, tree: Option<&ModelTree>) -> Answer {
    say(&match trouble {
        Trouble::Stopped => Reply::Stopped { id },
        Trouble::Faults(faults) => Reply::Faults {
            id,
            text: tree.map(|tree| tree.text().to_owned()),
            knobs: tree.map(ModelTree::knobs),
            faults,
        },
    })
}

/// Why a curve has no points, in the words of the first fault.
pub(crate) fn no_curve(id: u64, trouble: Trouble) -> Option<Answer> {
    let Trouble::Faults(faults) = trouble else {
        return None;
    };
    let first = faults.into_iter().next();
    let problem = first.map_or_else(String::new, |fault| fault.problem);
    Some(say(&Reply::NoCurve { id, problem }))
}

/// The smallest gap without pounding and the gaps of rules, for a curve over widths of gaps.
pub(crate) fn marks(
    engine: &Engine,
    cases: &Cases,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Answer> {
    let curve = cases.curve();
    if !curve.axis.is_width() || curve.across.is_some() {
        return None;
    }
    let id = curve.run.id;
    Some(say(&match curve::marks(engine, cases, stop) {
        Ok(marks) => Reply::Marks { id, marks },
        Err(problem) => Reply::NoCurve { id, problem },
    }))
}

/// The study that computes a curve in full, for the model file that is saved beside it.
pub(crate) fn study(engine: &Engine, curve: &Curve) -> Answer {
    let name = std::path::Path::new(engine.name());
    let stem = name
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let quoted = |text: &str| serde_json::to_string(text).unwrap_or_default();
    let value = |axis: &Axis, x: f64| match axis.put(x) {
        jostle_io::TreeValue::Text(text) => quoted(&text),
        jostle_io::TreeValue::Number(number) => format!("{number:?}"),
        other => other.to_string(),
    };
    let axes = std::iter::once(&curve.axis).chain(&curve.across);
    let paths: Vec<&str> = axes.clone().map(|axis| &axis.path[..]).collect();
    let paths = paths.join(" and ");
    let mut text = format!(
        "# Results over {paths}, as jostle live shows them.\n# jostle study study.toml, with the model file beside it\ntitle = {title}\nbase = {base}\n",
        title = quoted(&format!("{stem}: {paths}")),
        base = quoted(&format!("{stem}.toml")),
    );
    for axis in axes {
        text += &format!(
            "\n[[vary]]\npath = {path}\nrange = {{ from = {from}, to = {to}, count = {points} }}\n",
            path = quoted(&axis.path),
            from = value(axis, axis.from),
            to = value(axis, axis.to),
            points = axis.points,
        );
    }
    if !curve.records.is_empty() {
        let records: Vec<String> = curve.records.iter().map(|name| quoted(name)).collect();
        text += &format!(
            "\n[[vary]]\npath = \"motion.record\"\nvalues = [{}]\n",
            records.join(", ")
        );
    }
    say(&Reply::File {
        id: curve.run.id,
        name: "study.toml".into(),
        kind: "text/plain",
        text,
    })
}
