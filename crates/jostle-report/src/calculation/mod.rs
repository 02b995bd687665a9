//! What makes a report a calculation document: the model drawn to scale, mode shapes, the motion and its spectrum, and what
//! the calculation was made from.

mod elevation;

use jostle::system::Direction;
use jostle::{Building, GroundMotion, Structure, Wave};
use jostle_motion::{Accelerogram, Reading, TargetSpectrum, response_spectrum, spaced_periods};
use maud::{Markup, html};

use crate::static_plot::{Line, Plot};
use crate::{Page, format, message};

/// What a calculation document shows beyond the numbers of a run.
#[derive(Clone, Debug)]
pub struct Calculation<'a> {
    /// First lateral modes of every building.
    pub shapes: Vec<Vec<ShownMode>>,
    /// Design spectrum that the motion is scaled to, and its damping ratio.
    pub target: Option<(&'a TargetSpectrum, f64)>,
    /// Names and values of the title block: project, client, author, date, as far as the file has them.
    pub title_block: Vec<(TitleBlockPart, &'a str)>,
    /// The model file as it was read.
    pub input_text: &'a str,
    /// SHA-256 of the model file, in hexadecimal digits.
    pub input_hash: String,
    /// SHA-256 of the model and the motion as they were run, options of the command line included.
    pub run_hash: String,
}

/// A mode of a building as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownMode {
    /// Period \[s\].
    pub period: f64,
    /// Direction that carries most of its mass.
    pub direction: Direction,
    /// Displacement in this direction, or rotation, at the base and at the floors, over the greatest \[–\].
    pub shape: Vec<f64>,
}

/// What an entry of the title block is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TitleBlockPart {
    /// Name of the project.
    Project,
    /// Whom the report is made for.
    Client,
    /// Who made it.
    Author,
    /// Its date.
    Date,
}

/// The title block below the title; nothing where the file has none.
pub(crate) fn title_block(page: &Page) -> Markup {
    let entries = page
        .calculation
        .map_or(&[][..], |calculation| &calculation.title_block);
    let name = |part| match part {
        TitleBlockPart::Project => message::project(),
        TitleBlockPart::Client => message::client(),
        TitleBlockPart::Author => message::author(),
        TitleBlockPart::Date => message::date(),
    };
    html! {
        @if !entries.is_empty() {
            dl.title-block {
                @for (part, text) in entries {
                    div { dt { (name(*part)) } dd { (text) } }
                }
            }
        }
    }
}

/// Damping ratio of the spectrum unless a target has its own \[–\].
const DAMPING: f64 = 0.05;
/// Periods of the spectrum \[s\].
const PERIODS: (f64, f64, usize) = (0.02, 4.0, 160);
/// Longest model file that is printed \[characters\].
const LONGEST_INPUT: usize = 16_000;

/// The ground motion over time, and its response spectrum.
pub(crate) fn motion_section(page: &Page) -> Markup {
    let Some(calculation) = page.calculation else {
        return html! {};
    };
    let Some(motion) = accelerogram(page.motion) else {
        return html! {};
    };
    let across = page.motion.across();
    let across = across.and_then(|across| Some((&across.name, accelerogram(across)?)));
    let motions: Vec<(&String, &Accelerogram)> =
        std::iter::once((&page.summary.motion.name, &motion))
            .chain(across.iter().map(|(name, across)| (*name, across)))
            .collect();
    // Of two components both have a name in the legend.
    let several = motions.len() > 1;
    let lines = motions
        .iter()
        .enumerate()
        .map(|(index, (name, motion))| Line {
            name: if several {
                (*name).clone()
            } else {
                String::new()
            },
            points: motion
                .acceleration()
                .iter()
                .enumerate()
                .map(|(i, a)| [motion.step() * i as f64, format::ACCELERATION.of(*a)])
                .collect(),
            colour: OF_GROUND[index],
            dashed: false,
        });
    let names: Vec<&str> = motions.iter().map(|(name, _)| &name[..]).collect();
    let record = Plot {
        title: format!("{}: {}", message::ground_acceleration(), names.join(", ")),
        x_label: format!("{} [s]", message::time()),
        y_label: format!(
            "{} {}",
            message::ground_acceleration(),
            format::ACCELERATION.bracketed()
        ),
        logarithmic: false,
        aspect: 0.42,
        lines: lines.collect(),
    };
    html! {
        section #ground-motion {
            h2 { (message::ground_motion()) }
            div.static-plots {
                (record.figure())
                @if let Some(spectrum) = spectrum(calculation, &motions) { (spectrum.figure()) }
            }
        }
    }
}

/// Colours of lines of the ground: along, across.
const OF_GROUND: [usize; 2] = [6, 3];

fn spectrum(calculation: &Calculation<'_>, motions: &[(&String, &Accelerogram)]) -> Option<Plot> {
    let damping = calculation.target.map_or(DAMPING, |(_, damping)| damping);
    let periods = spaced_periods(PERIODS.0, PERIODS.1, PERIODS.2);
    let mut lines = Vec::new();
    for (index, (name, motion)) in motions.iter().enumerate() {
        let found = response_spectrum(motion, &periods, &[damping], Reading::Between).ok()?;
        let values = found.curves.first()?.pseudo_acceleration.iter();
        lines.push(Line {
            name: (*name).clone(),
            points: periods
                .iter()
                .zip(values)
                .map(|(t, a)| [*t, format::ACCELERATION.of(*a)])
                .collect(),
            colour: OF_GROUND[index],
            dashed: false,
        });
    }
    if let Some((target, damping)) = calculation.target {
        let points = periods.iter().filter_map(|period| {
            let [first, last] = target.range();
            let inside = (first..=last).contains(period);
            let value = target.acceleration(*period, damping).ok()?;
            inside.then_some([*period, format::ACCELERATION.of(value)])
        });
        lines.push(Line {
            name: message::code().into(),
            points: points.collect(),
            colour: 1,
            dashed: true,
        });
    }
    Some(Plot {
        title: message::response_spectrum_at(format::plain(100.0 * damping, 3)),
        x_label: format!("{} [s]", message::period()),
        y_label: format!(
            "{} {}",
            message::pseudo_acceleration(),
            format::ACCELERATION.bracketed()
        ),
        logarithmic: true,
        aspect: 0.42,
        lines,
    })
}

/// Values of a motion as it was used; waves given by a formula take 200 in a period.
fn accelerogram(motion: &GroundMotion) -> Option<Accelerogram> {
    let step = match &motion.wave {
        Wave::Sampled { step, .. } => *step,
        _ => motion.period()? / 200.0,
    };
    let points = (motion.duration / step * (1.0 + 1e-12)).floor() as usize + 1;
    let values = (0..points.min(1 << 20)).map(|i| motion.acceleration(step * i as f64));
    Accelerogram::new(step, values.collect()).ok()
}

/// The model drawn to scale, and mode shapes.
pub(crate) fn model_figures(page: &Page) -> Markup {
    let Some(calculation) = page.calculation else {
        return html! {};
    };
    html! {
        (elevation::figure(page))
        div.static-plots.shapes {
            @for (index, building) in page.model.buildings.iter().enumerate() {
                @if let Some(shapes) = calculation.shapes.get(index).filter(|shapes| !shapes.is_empty()) {
                    (shape_plot(building, shapes).figure())
                }
            }
        }
    }
}

fn shape_plot(building: &Building, shapes: &[ShownMode]) -> Plot {
    let levels: Vec<f64> = std::iter::once(building.base.elevation)
        .chain(building.floor_levels())
        .collect();
    // Shapes that all lean to one side keep their zero.
    let zero = Line {
        name: String::new(),
        points: vec![[0.0, format::HEIGHT.of(levels[0])]],
        colour: 0,
        dashed: false,
    };
    let in_plan = matches!(building.structure, Structure::Tiers(_));
    let lines = shapes.iter().enumerate().map(|(index, mode)| {
        let points = mode.shape.iter().zip(&levels);
        let period = format!("T{} = {} s", index + 1, format::fixed(mode.period, 3));
        let direction = match mode.direction {
            Direction::Along => message::along_x(),
            Direction::Across => message::along_y(),
            Direction::Turning => message::torsion(),
            Direction::Up => message::vertical(),
        };
        Line {
            name: if in_plan {
                format!("{period}, {}", direction.to_lowercase())
            } else {
                period
            },
            points: points.map(|(x, y)| [*x, format::HEIGHT.of(*y)]).collect(),
            colour: index,
            dashed: index == 2,
        }
    });
    Plot {
        title: format!("{}, {}", message::lateral_mode_shapes(), building.name),
        x_label: match shapes
            .iter()
            .any(|mode| mode.direction == Direction::Turning)
        {
            true => message::displacement_or_rotation_greatest_1().into(),
            false => message::horizontal_displacement_greatest_1().into(),
        },
        y_label: format!("{} {}", message::height(), format::HEIGHT.bracketed()),
        logarithmic: false,
        aspect: 0.56,
        lines: lines.chain([zero]).collect(),
    }
}

/// Version, hashes and the model file.
pub(crate) fn source_section(page: &Page) -> Markup {
    let Some(calculation) = page.calculation else {
        return html! {};
    };
    let text = calculation.input_text.trim_end();
    html! {
        section #source {
            h2 { (message::what_it_was_computed()) }
            dl.source {
                div { dt { (message::program()) } dd { "jostle " (page.summary.jostle) ", " (page.summary.work.solver) } }
                div { dt { (message::model_file_sha_256()) } dd { code { (calculation.input_hash) } } }
                div { dt { (message::model_and_motion_as_run()) } dd { code { (calculation.run_hash) } } }
            }
            @if text.is_empty() || text.chars().count() > LONGEST_INPUT {
                p.quiet { (message::the_model_file_is_too()) }
            } @else {
                details {
                    summary { (message::the_model_file()) }
                    pre.input { (text) }
                }
            }
        }
    }
}
