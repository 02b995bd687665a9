//! Requests answered one after the other, without a server.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use jostle::stepping::Progress;

use crate::answer::{self, Answer};
use crate::curve::Cases;
use crate::engine::{Engine, Solved, Trouble};
use crate::message::{Reply, Request, Run};

/// An open model and the curve that is being computed.
pub struct Local {
    engine: Engine,
    /// Text of the model of the latest run that was asked for.
    text: String,
    /// Cases of the curve, and how many are done.
    curve: Option<(Cases, usize)>,
    /// The latest run, whose sensitive instants were not looked for yet, and its number.
    solved: Option<(u64, Solved)>,
}

impl Local {
    /// Requests about a model.
    #[must_use]
    pub fn new(engine: Engine) -> Self {
        Self {
            text: engine.text().to_owned(),
            engine,
            curve: None,
            solved: None,
        }
    }

    /// Text of the model file, with the changes of the latest run that had no fault.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Sets one value as typed; an empty one removes the key.
    ///
    /// # Errors
    /// The first fault of the model with that value; the model then stays as it was.
    pub fn set(&mut self, path: &str, typed: &str) -> Result<(), String> {
        let run = Run {
            id: 0,
            text: self.text.clone(),
            edits: vec![(path.to_owned(), typed.to_owned())],
            record: 0,
        };
        let tree = self.engine.tree(&run).and_then(|tree| {
            self.engine.prepare(&tree, 0)?;
            Ok(tree)
        });
        match tree {
            Ok(tree) => {
                tree.text().clone_into(&mut self.text);
                Ok(())
            }
            Err(Trouble::Stopped) => Err("stopped".into()),
            Err(Trouble::Faults(faults)) => {
                Err(faults.into_iter().next().map_or_else(String::new, |fault| {
                    let text = format!("{}: {}", fault.path, fault.problem);
                    match fault.remedy {
                        Some(remedy) => format!("{text}; {remedy}"),
                        None => text,
                    }
                }))
            }
        }
    }

    /// Keys of the model, each with its value as in the file; `None` for one that is not stated.
    pub fn values(&self) -> Vec<(String, Option<String>)> {
        let run = Run {
            id: 0,
            text: self.text.clone(),
            edits: Vec::new(),
            record: 0,
        };
        let tree = self.engine.tree(&run);
        let knobs = tree.map(|tree| tree.knobs()).unwrap_or_default();
        knobs
            .into_iter()
            .map(|knob| (knob.path, knob.value))
            .collect()
    }

    /// The first message of a page.
    #[must_use]
    pub fn hello(&self) -> Answer {
        answer::hello(&self.engine)
    }

    /// Answers a request, if it has an answer; a curve is only begun, and [`Local::more`] computes it.
    ///
    /// `watch` is called with the share of a run that is done, from 0 to 1, and can stop it.
    ///
    /// # Errors
    /// What is wrong with a request that no page of this version sends.
    pub fn answer(
        &mut self,
        request: &str,
        watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
    ) -> Result<Option<Answer>, String> {
        let request = serde_json::from_str(request)
            .map_err(|error| format!("the request is not one of this version: {error}"))?;
        let watch = |Progress { time, duration }: Progress| {
            watch(if duration > 0.0 { time / duration } else { 0.0 })
        };
        Ok(match request {
            Request::Run(run) => {
                if let Ok(tree) = self.engine.tree(&run)
                    && self.engine.prepare(&tree, run.record).is_ok()
                {
                    tree.text().clone_into(&mut self.text);
                }
                let (answer, solved) = answer::frame(&self.engine, &run, &watch);
                self.solved = solved.map(|solved| (run.id, solved));
                Some(answer)
            }
            Request::Report(run) => Some(answer::report(&self.engine, &run, &watch)),
            Request::Study(curve) => Some(answer::study(&self.engine, &curve)),
            Request::Curve(curve) => match self.engine.tree(&curve.run) {
                Ok(tree) => {
                    let id = curve.run.id;
                    match Cases::new(tree, curve) {
                        Ok(cases) => {
                            self.curve = Some((cases, 0));
                            None
                        }
                        Err(problem) => Some(answer::say(&Reply::NoCurve { id, problem })),
                    }
                }
                Err(trouble) => answer::no_curve(curve.run.id, trouble),
            },
            Request::StopCurve => {
                self.curve = None;
                None
            }
            Request::Stop => None,
        })
    }

    /// Accuracy of the latest run, once it is known whether its results are sensitive. This takes another run, so it is
    /// asked for when nothing else is to be computed. `None` if there is nothing to look for, or if `watch` stopped it.
    pub fn accuracy(&mut self, watch: &(dyn Fn() -> ControlFlow<()> + Sync)) -> Option<Answer> {
        let (id, solved) = self.solved.take()?;
        let stopped = AtomicBool::new(false);
        let watch = |_| {
            let going_on = watch();
            stopped.fetch_or(going_on.is_break(), Ordering::Relaxed);
            going_on
        };
        answer::accuracy(id, solved, &watch).filter(|_| !stopped.load(Ordering::Relaxed))
    }

    /// The next point of the curve, or what follows the last one; `None` when there is nothing more to compute.
    pub fn more(&mut self) -> Option<Answer> {
        let (cases, done) = self.curve.as_mut()?;
        if *done < cases.count() {
            let point = cases.point(&self.engine, *done, &|| false);
            *done += 1;
            return Some(answer::say(&Reply::Points {
                id: cases.curve().run.id,
                points: vec![point],
                of: cases.count(),
            }));
        }
        let (cases, _) = self.curve.take()?;
        answer::marks(&self.engine, &cases, &|| false)
    }
}
