//! Computes the numbers of `summary.json` from the outcome of a run.

use super::in_plan::{
    ImpactSliding, PlanContactSummary, SlidingSummary, building_in_plan, centre_of, floor_in_plan,
    impacts_of, place_of_face, points_of,
};
use crate::contact::{ForceLaw, LawKind};
use crate::history::{Extreme, Impact, Kind, Owner};
use crate::hysteresis::{Side, Stage};
use crate::interface::{Contact, LinkElement, PlanPart};
use crate::linear::sort_by;
use crate::model::{Gap, LinkLaw, Model, Solver};
use crate::motion::GroundMotion;
use crate::results::capacity;
use crate::results::contact_constants::crushed_notes;
use crate::results::foundation::{foundation_summary, foundation_warnings, soil_energy};
use crate::results::friction::friction_warnings;
use crate::results::ground::{closing_of_grounds, ground_summary};
use crate::results::isolation::{isolation_summary, mat_summary, wall_summaries};
use crate::results::members::members_of;
use crate::results::parts::{degree_of_coupling, panel_warnings, parts_of};
use crate::results::response::{
    Amplification, BuildingResponse, FloorResponse, building_response, floor_responses,
};
use crate::results::rotation_levels::rotation_levels;
use crate::results::sections::sections_of;
use crate::results::shear_failure::shear_failures;
use crate::results::summary::{
    BuildingSummary, ContactSummary, EnergySummary, FloorSummary, Floors, GapSummary, HingeSummary,
    ImpactSummary, LinkFloorSummary, LinkSummary, MotionSummary, PanelsSummary, PromiseSummary,
    SpringSummary, StrainsSummary, Summary, WorkSummary,
};
use crate::results::walls_beyond_plan::wall_warnings;
use crate::results::{CountedImpact, counted, find_simultaneous};
use crate::stepping::{Accuracy, Outcome, Plan, RunEnd};
use crate::structure::{Discretization, SpringPlace};
use crate::structure::{ductility, end_stiffnesses};
use crate::system::{BuildingSystem, System};

/// Input of a summary.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use jostle::{GroundMotion, Outcome, Plan, Pounding, Run, RunEnd, Settings, StepError, Summary, System, simulate};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # use towers::pair;
///
/// let model = pair(0.02);
/// let wave = (0..=300).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect();
/// let motion = GroundMotion::sampled("sine", 0.01, wave);
/// let system = System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// let plan = Plan::choose(&system, &motion, &model.analysis).map_err(|faults| faults[0].clone())?;
/// let run = |pounding| -> Outcome {
///     let settings = Settings { pounding, ..Settings::default() };
///     simulate(&system, &motion, &plan, settings, |_| ControlFlow::Continue(()))
/// };
/// let (with, without) = (run(Pounding::Included), run(Pounding::Excluded));
/// if let RunEnd::Failed(StepError::Unsuited { reason }) = &with.end {
///     panic!("{reason}");
/// }
/// let summary = Summary::new(&Run {
///     model: &model,
///     system: &system,
///     motion: &motion,
///     plan: &plan,
///     outcome: &with,
///     without_contact: Some(&without),
///     wall: 0.0,
/// });
/// assert!(summary.gaps[0].impact_count > 0);
/// assert!(summary.gaps[0].closing_without_contact_m > Some(0.02)); // the gap needed
/// # Ok::<(), jostle::ModelFault>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Run<'a> {
    /// The model.
    pub model: &'a Model,
    /// The assembled system.
    pub system: &'a System,
    /// Ground motion.
    pub motion: &'a GroundMotion,
    /// Steps.
    pub plan: &'a Plan,
    /// The outcome.
    pub outcome: &'a Outcome,
    /// The same buildings without contact, if that run exists.
    pub without_contact: Option<&'a Outcome>,
    /// Wall time of the stepping \[s\].
    pub wall: f64,
}

impl Summary {
    /// Summarises a run.
    #[must_use]
    pub fn new(run: &Run) -> Self {
        let Run {
            model,
            system,
            motion,
            outcome,
            ..
        } = *run;
        let buildings: Vec<BuildingSummary> = (0..system.structures().len())
            .map(|index| building_summary(index, run))
            .collect();
        let mut warnings = warnings(run);
        warnings.extend(panel_warnings(&buildings));
        let gaps: Vec<GapSummary> = model
            .gaps
            .iter()
            .enumerate()
            .map(|(index, gap)| gap_summary(index, gap, run))
            .collect();
        let across = motion.across();
        Self {
            title: model.title.clone(),
            jostle: env!("CARGO_PKG_VERSION").to_owned(),
            build: None,
            motion: MotionSummary {
                name: motion.name.clone(),
                points: motion.points(),
                step_s: motion.step().unwrap_or(0.0),
                pga_m_s2: motion.peak(),
                across: across.map(|across| across.name.clone()),
                pga_across_m_s2: across.map(GroundMotion::peak),
                scale: motion.scale,
                duration_s: motion.duration,
            },
            buildings,
            walls: wall_summaries(run, &gaps),
            gaps,
            links: (0..model.links.len())
                .map(|index| link_summary(index, run))
                .collect(),
            energy: energy_summary(run),
            promise: promise_summary(run),
            work: work_summary(run),
            contact_sensitivity: None,
            gradients: Vec::new(),
            isolation_bounds: None,
            floor_spectra: None,
            checks: Vec::new(),
            silenced_checks: Vec::new(),
            ended_early: match &outcome.end {
                RunEnd::Completed => None,
                RunEnd::Stopped => Some(format!(
                    "stopped at t = {:.3} s of {:.3} s",
                    outcome.state.time, motion.duration
                )),
                RunEnd::Failed(error) => Some(error.to_string()),
            },
            warnings,
            notes: notes(run),
        }
    }
}

fn building_summary(index: usize, run: &Run) -> BuildingSummary {
    let building = &run.system.buildings[index];
    let hinges = hinge_summary(building, run.outcome);
    let responses = floor_responses(index, building, run.outcome);
    let response = building_response(index, building, run.outcome, &responses, &hinges);
    let without = run.without_contact.map(|outcome| {
        let floors = floor_responses(index, building, outcome);
        let hinges = hinge_summary(building, outcome);
        let response = building_response(index, building, outcome, &floors, &hinges);
        (floors, response)
    });
    let without_contact = without.as_ref().map(|(_, response)| *response);
    let floors = building.floors.iter().zip(responses).enumerate();
    let floors = floors.map(|(k, (floor, response))| {
        let without_contact = without.as_ref().map(|(floors, _)| floors[k]);
        FloorSummary {
            floor: k + 1,
            height_m: floor.height,
            response,
            in_plan: floor_in_plan(index, k + 1, run.outcome),
            without_contact_in_plan: run
                .without_contact
                .and_then(|outcome| floor_in_plan(index, k + 1, outcome)),
            without_contact,
            amplification: without_contact
                .map(|without| Amplification::new(FloorResponse::QUANTITIES, &response, &without)),
        }
    });
    let floors: Vec<FloorSummary> = floors.collect();
    let members = members_of(index, run);
    let joints = capacity::joints_of(index, run);
    let sections = sections_of(index, building, run.outcome);
    let parts = parts_of(index, building, &sections, run);
    BuildingSummary {
        capacity: capacity::of_building(index, &members, &joints, run),
        joints,
        members,
        panels: PanelsSummary::of(&parts),
        parts,
        strains: StrainsSummary::of(&sections),
        sections,
        degree_of_coupling: degree_of_coupling(index, building, run.outcome),
        shear_failures: shear_failures(index, run),
        rotation_levels: rotation_levels(index, run),
        name: building.name.clone(),
        mass_kg: building.equations.total_mass(),
        periods_s: building
            .lateral_modes()
            .map(crate::eigen::Mode::period)
            .collect(),
        fundamental_periods_s: building.fundamental_periods(),
        rayleigh_alpha_per_s: building.equations.alpha,
        rayleigh_beta_s: building.equations.beta,
        isolation: isolation_summary(index, building, run.outcome),
        foundation: foundation_summary(index, building, run.outcome),
        ground: ground_summary(index, run),
        floors: Floors {
            mat: mat_summary(index, &floors, run),
            above: floors,
        },
        response,
        in_plan: building_in_plan(index, run.outcome),
        without_contact_in_plan: run
            .without_contact
            .and_then(|outcome| building_in_plan(index, outcome)),
        without_contact,
        amplification: without_contact
            .map(|without| Amplification::new(BuildingResponse::QUANTITIES, &response, &without)),
        hinges,
    }
}

fn hinge_summary(building: &BuildingSystem, outcome: &Outcome) -> HingeSummary {
    let places = &building.discretization.spring_places;
    let all: Vec<SpringSummary> = springs_of(building, outcome)
        .into_iter()
        .filter(|spring| {
            let place = places.get(spring.index);
            place.is_none_or(SpringPlace::is_hinge)
        })
        .collect();
    let mut summary = HingeSummary {
        total: all.len(),
        cracked: all.iter().filter(|s| s.cracked_s.is_some()).count(),
        without_cracking: !all.iter().any(|s| {
            let spring = &building.equations.springs[s.index];
            spring.hysteresis.cracks()
        }),
        yielded: all.iter().filter(|s| s.yielded_s.is_some()).count(),
        first_yield_s: None,
        // Braces shorten and lengthen many times as far as they do when they buckle or yield.
        ductility: all
            .iter()
            .filter(|s| !s.is_brace())
            .map(|s| s.ductility)
            .fold(0.0, f64::max),
        dissipated_j: all.iter().fold(0.0, |sum, s| sum + s.dissipated_j),
        list: all.into_iter().filter(|s| s.cracked_s.is_some()).collect(),
    };
    let never = f64::INFINITY;
    sort_by(&mut summary.list, |a, b| {
        let key = |s: &SpringSummary| [s.yielded_s.unwrap_or(never), s.cracked_s.unwrap_or(never)];
        let (a, b) = (key(a), key(b));
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
    });
    summary.first_yield_s = summary.list.first().and_then(|first| first.yielded_s);
    summary
}

/// Peaks of every spring of a building that can yield and of every row of a force in plan, in the order of
/// [`Discretization::spring_places`](crate::structure::Discretization::spring_places).
#[must_use]
pub fn springs_of(building: &BuildingSystem, outcome: &Outcome) -> Vec<SpringSummary> {
    let springs = building.equations.springs.iter().enumerate();
    let discretization = &building.discretization;
    let behind = end_stiffnesses(&discretization.stick_model);
    let when = |spring: usize, reached: Stage, stage: Stage| {
        let mut events = outcome.spring_events.iter();
        // A spring may yield in the step in which it cracks, and crack under weight alone.
        let event = events.find(|event| event.spring == spring && event.stage >= stage);
        (reached >= stage).then(|| event.map_or(0.0, |event| event.time))
    };
    let summary = |(index, spring): (usize, &crate::structure::YieldingSpring)| {
        let global = building.spring_offset + index;
        let (memory, rule) = (&outcome.state.springs[global], &spring.hysteresis);
        let force = outcome
            .peaks
            .owned_by(Owner::Spring(global))
            .of(Kind::Force);
        let place = building.discretization.spring_places.get(index);
        SpringSummary {
            place: place.map_or_else(
                || format!("spring {index}"),
                |place| {
                    let Discretization {
                        element_names,
                        frames,
                        ..
                    } = &building.discretization;
                    place.named(element_names, frames)
                },
            ),
            at: place.copied(),
            index,
            cracked_s: when(global, rule.stage(memory), Stage::Cracked),
            yielded_s: when(global, rule.stage(memory), Stage::Yielded),
            deformation_max: memory.greatest(Side::Positive),
            deformation_min: memory.greatest(Side::Negative),
            ductility: Side::BOTH
                .map(|side| {
                    // A base has no member end in series.
                    let member = behind.get(index).copied().flatten();
                    let member = member.or_else(|| discretization.bending_behind(*place?));
                    let member =
                        member.filter(|_| !matches!(place, Some(SpringPlace::Base { .. })));
                    ductility(rule, memory.greatest(side), side, member)
                })
                .into_iter()
                .fold(0.0, f64::max),
            peak_force: force.size(),
            dissipated_j: outcome.peaks.work(Owner::Spring(global))
                - rule.recoverable_energy(memory),
        }
    };
    // The row between two directions has no force.
    let is_force = |place: Option<&SpringPlace>| !place.is_some_and(SpringPlace::has_no_force);
    let places = &building.discretization.spring_places;
    let springs = springs.filter(|(index, _)| is_force(places.get(*index)));
    springs.map(summary).collect()
}

fn gap_summary(index: usize, gap: &Gap, run: &Run) -> GapSummary {
    let Run {
        system, outcome, ..
    } = *run;
    let points: Vec<usize> = (0..system.contacts.len())
        .filter(|&contact| system.contacts[contact].gap == index)
        .collect();
    // Faces where buildings are in space, otherwise contacts.
    let mut faces: Vec<usize> = points
        .iter()
        .map(|&point| {
            system.contacts[point]
                .plan
                .map_or(point, |place| place.face)
        })
        .collect();
    faces.dedup();
    let mut counted: Vec<Vec<CountedImpact>> = faces
        .iter()
        .map(|&contact| counted_impacts(contact, gap, run))
        .collect();
    let poundings = find_simultaneous(&mut counted);
    let contacts: Vec<ContactSummary> = faces
        .iter()
        .zip(&counted)
        .map(|(&contact, impacts)| contact_summary(contact, impacts, run))
        .collect();
    let impacts = contacts.iter().flat_map(|contact| &contact.impacts);
    let total = outcome.peaks.gap_force(index);
    // Contact that is no impact has a force as well.
    let struck = total.value > 0.0
        && counted
            .iter()
            .any(|counted_impact| !counted_impact.is_empty());
    let total = struck.then_some(total);
    GapSummary {
        between: names(gap.between, system),
        width_m: gap.width(),
        clearance_m: points
            .iter()
            .map(|&point| system.contacts[point].width - outcome.peaks.closing(point).value)
            .fold(f64::INFINITY, f64::min),
        law: gap.law.kind.full_name(),
        free_restitution: points
            .iter()
            .filter_map(|&point| system.contacts[point].free_restitution(&gap.law))
            .reduce(f64::min),
        impact_count: contacts.iter().map(|contact| contact.impact_count).sum(),
        minimum_separation_s: gap.minimum_separation,
        pounding_count: poundings.count,
        multiple_pounding_count: poundings.multiple,
        most_at_once: poundings.most_at_once,
        peak_force_n: contacts
            .iter()
            .map(|contact| contact.peak_force_n)
            .fold(0.0, f64::max),
        total_force_peak_n: total.map_or(0.0, |total| total.value),
        total_force_peak_at_s: total.map(|total| total.at),
        first_impact_s: impacts.map(|impact| impact.start_s).min_by(f64::total_cmp),
        closing_without_contact_m: run.without_contact.map(|outcome| {
            let needed = |&contact: &usize| {
                let wider = system.contacts[contact].width - gap.width();
                outcome.peaks.closing(contact).value - wider
            };
            points.iter().map(needed).fold(0.0, f64::max)
        }),
        contacts,
    }
}

/// Names of both sides.
pub(super) fn names(between: [Option<usize>; 2], system: &System) -> [String; 2] {
    between.map(|side| system.side_name(side).to_owned())
}

/// Floors of a link; 0 is the base of its own building.
fn floors_of(element: &LinkElement) -> [Option<usize>; 2] {
    let floors = element.ports.floors();
    if element.inside {
        floors.map(|floor| floor.or(Some(0)))
    } else {
        floors
    }
}

fn link_summary(index: usize, run: &Run) -> LinkSummary {
    let (system, outcome, link) = (run.system, run.outcome, &run.model.links[index]);
    let links = system.links.iter().enumerate();
    let floors: Vec<LinkFloorSummary> = links
        .zip(outcome.state.link_memories())
        .filter(|((_, element), _)| element.link == index)
        .map(|((place, element), memory)| {
            let peaks = outcome.peaks.owned_by(Owner::Link(place));
            let force = peaks.of(Kind::Force).furthest();
            let work = outcome.peaks.work(Owner::Link(place));
            let joint = system.contacts.len() + place;
            let moved = closing_of_grounds(joint, outcome.state.time, run).unwrap_or(0.0);
            let shortening = element.shortening(&outcome.state.displacement) + moved;
            LinkFloorSummary {
                floors: floors_of(element),
                height_m: element.height,
                peak_force_n: force.value,
                peak_force_at_s: force.at,
                peak_stroke_m: peaks.of(Kind::Stroke).size(),
                peak_speed_m_s: peaks.of(Kind::Speed).size(),
                dissipated_j: work - element.recoverable(shortening, &memory),
            }
        })
        .collect();
    let greatest = |of: fn(&LinkFloorSummary) -> f64| floors.iter().map(of).fold(0.0, f64::max);
    let peak_force_n = greatest(|floor| floor.peak_force_n.abs());
    LinkSummary {
        between: names(link.between, system),
        law: link.law.name().to_owned(),
        stiffness_n_m: match &link.law {
            LinkLaw::Friction {
                stick_stiffness, ..
            } => *stick_stiffness,
            LinkLaw::Yielding(hysteresis) => hysteresis.backbone().initial(),
            LinkLaw::Linear
            | LinkLaw::Viscous { .. }
            | LinkLaw::Maxwell
            | LinkLaw::Cable { .. }
            | LinkLaw::Stopper { .. } => link.stiffness,
        },
        damping_n_s_m: link.damping,
        exponent: match link.law {
            LinkLaw::Viscous { exponent } => exponent,
            LinkLaw::Linear
            | LinkLaw::Maxwell
            | LinkLaw::Friction { .. }
            | LinkLaw::Yielding(_)
            | LinkLaw::Cable { .. }
            | LinkLaw::Stopper { .. } => 1.0,
        },
        peak_force_n,
        force_peak_n: peak_force_n,
        stroke_peak_m: greatest(|floor| floor.peak_stroke_m),
        speed_peak_m_s: greatest(|floor| floor.peak_speed_m_s),
        dissipated_j: floors
            .iter()
            .fold(0.0, |sum, floor| sum + floor.dissipated_j),
        floors,
    }
}

/// Impacts of a reported contact: a face with all its points, or one contact in one plane.
pub(super) fn counted_impacts(reported: usize, gap: &Gap, run: &Run) -> Vec<CountedImpact> {
    let gap_impacts = impacts_of(run.system, run.outcome, reported);
    let mut impacts: Vec<&Impact> = gap_impacts.iter().collect();
    sort_by(&mut impacts, |a, b| a.start.total_cmp(&b.start));
    counted(impacts, gap.minimum_separation)
}

/// Name of the line of the column that a contact strikes, if it does.
fn struck_column(contact: &Contact, system: &System) -> Option<String> {
    let parts = contact.plan?.parts;
    let mut sides = contact.ports.0.iter().zip(parts);
    sides.find_map(|(port, part)| {
        let building = system.buildings.get(port.as_ref()?.building)?;
        let frames = &building.discretization.frames;
        match part {
            PlanPart::Column(line) => Some(line.name(frames)),
            PlanPart::Edge(_) | PlanPart::Corner(_) => None,
        }
    })
}

fn contact_summary(index: usize, impacts: &[CountedImpact], run: &Run) -> ContactSummary {
    let (system, outcome) = (run.system, run.outcome);
    let all = || impacts.iter().map(|counted| &counted.impact);
    let strongest = all()
        .filter(|impact| impact.peak_force > 0.0)
        .max_by(|a, b| a.peak_force.total_cmp(&b.peak_force));
    let points = points_of(system, index);
    let first = points.first().copied().unwrap_or(index);
    let contact = &system.contacts[first];
    let widths = points.iter().map(|&point| system.contacts[point].width);
    let width = widths.fold(f64::INFINITY, f64::min);
    // Faces that are not parallel close from their nearest points on: those further apart close by more and do not touch.
    let closing = points.iter().map(|&point| {
        let further = system.contacts[point].width - width;
        let closing = outcome.peaks.closing(point);
        Extreme {
            value: closing.value - further,
            ..closing
        }
    });
    let closing = closing.max_by(|a, b| a.value.total_cmp(&b.value));
    let closing = closing.unwrap_or_default();
    ContactSummary {
        floors: system.floors_of(&contact.ports),
        height_m: contact.height,
        in_plan: contact
            .plan
            .and_then(|place| place_of_face(system, outcome, place.face))
            .map(|place| PlanContactSummary {
                sliding: contact
                    .friction
                    .as_ref()
                    .map(|_| SlidingSummary::new(all())),
                ..place
            }),
        struck_column: struck_column(contact, system),
        width_m: width,
        crushed_depth_m: matches!(contact.law, ForceLaw::Crushing(_)).then(|| {
            let depths = points.iter();
            let depths = depths.map(|&point| outcome.state.crushed_depth(point));
            depths.fold(0.0, f64::max)
        }),
        equivalent_restitution: contact.equivalent_restitution(&run.model.gaps[contact.gap].law),
        closing_peak_m: closing.value,
        closing_peak_at_s: closing.at,
        closing_peak_ground_m: closing_of_grounds(first, closing.at, run),
        impact_count: impacts.len(),
        peak_force_n: strongest.map_or(0.0, |impact| impact.peak_force),
        peak_force_at_s: strongest.map(|impact| impact.peak_force_at),
        // An empty sum would be −0.
        impulse_n_s: all().fold(0.0, |sum, impact| sum + impact.impulse),
        impacts: impacts
            .iter()
            .map(|counted| ImpactSummary {
                centre_m: centre_of(&counted.impact, outcome),
                ended: contact.plan.map(|_| match counted.impact.sliding.slid_off {
                    true => "off",
                    false => "open",
                }),
                sliding: contact.friction.as_ref().map(|_| ImpactSliding {
                    slip_speed_m_s: counted.impact.sliding.slip_speed,
                    tangential_impulse_n_s: counted.impact.sliding.impulse,
                }),
                ..ImpactSummary::from(counted)
            })
            .collect(),
    }
}

impl From<&CountedImpact> for ImpactSummary {
    fn from(counted: &CountedImpact) -> Self {
        let impact = &counted.impact;
        Self {
            start_s: impact.start,
            end_s: impact.end,
            peak_force_n: impact.peak_force,
            peak_force_at_s: impact.peak_force_at,
            peak_indentation_m: impact.peak_indentation,
            impact_speed_m_s: impact.impact_speed,
            separation_speed_m_s: impact.separation_speed,
            realised_restitution: impact.realised_restitution(),
            impulse_n_s: impact.impulse,
            dissipated_j: impact.dissipated,
            finished: impact.finished,
            touches: counted.touches,
            simultaneous: counted.simultaneous,
            centre_m: None,
            ended: None,
            sliding: None,
        }
    }
}

fn energy_summary(run: &Run) -> EnergySummary {
    let (system, energy) = (run.system, &run.outcome.energy);
    let soil = soil_energy(system, run.outcome);
    EnergySummary {
        input_j: energy.input,
        ground_j: run.motion.grounds.is_some().then_some(energy.ground),
        kinetic_j: energy.kinetic,
        strain_j: energy.strain,
        damped_j: energy.damped,
        links_j: match soil {
            Some(_) if system.model_links().is_empty() => 0.0,
            Some([_, between]) => energy.links - between,
            None => energy.links,
        },
        soil_j: soil.map(|[all, _]| all),
        hysteretic_j: energy.hysteretic,
        contact_j: energy.contact,
        friction_j: system.has_friction().then_some(energy.friction),
        imbalance: energy.imbalance(),
        worst_imbalance: energy.worst_imbalance,
    }
}

fn promise_summary(run: &Run) -> PromiseSummary {
    let accuracy = run.outcome.accuracy;
    let met = accuracy.map(|accuracy| accuracy.residual <= accuracy.tolerance);
    let sensitive_from = accuracy.and_then(|accuracy| accuracy.sensitive_from);
    PromiseSummary {
        tolerance: run.plan.tolerance(),
        met,
        met_until_s: sensitive_from.filter(|_| met == Some(true)),
        residual: accuracy.map(|accuracy| accuracy.residual),
        sensitive_from_s: sensitive_from,
    }
}

fn work_summary(run: &Run) -> WorkSummary {
    let work = &run.outcome.work;
    WorkSummary {
        solver: run.plan.solver.name(),
        steps: work.steps,
        contact_steps: work.contact_steps,
        repeated_steps: work.repeated_steps,
        factorizations: work.factorizations,
        solves: work.solves,
        iterations: work.iterations,
        outer_iterations: work.outer_iterations,
        halved_steps: work.halved_steps,
        coupling_operations: work.coupling_operations,
        shapes: work.shapes,
        repeated_runs: work.repeated_runs,
        step_s: run.outcome.free_step.unwrap_or(run.plan.step),
        contact_step_s: run.outcome.contact_step,
        wall_s: run.wall,
    }
}

/// Warnings about the results.
fn warnings(run: &Run) -> Vec<String> {
    let tolerance = run.model.analysis.energy_tolerance;
    let energy = &run.outcome.energy;
    let worst = energy.worst_imbalance;
    let mut warnings = Vec::new();
    // A dissipative integrator removes energy: see the notes.
    if worst > tolerance && !run.plan.integrator.dissipates() {
        warnings.push(format!(
            "the energies do not balance: {worst:.1e} of the energy is unaccounted for (tolerance {tolerance:.1e}); do not trust this run"
        ));
    }
    let slides = |building: &crate::model::Building| {
        let isolation = building.base.isolation.as_ref();
        isolation.is_some_and(|isolation| isolation.isolator.slides())
    };
    for building in run
        .model
        .buildings
        .iter()
        .filter(|building| slides(building))
    {
        if run.motion.is_vertical() {
            warnings.push(format!(
                "the normal force of the sliding bearings of \"{}\" is constant (the weight): vertical shaking does not change their friction",
                building.name
            ));
        }
    }
    // The trapezoidal rule may gain energy in impacts of few steps; the balance does not reveal it.
    let given = -energy.contact / energy.input.abs().max(f64::MIN_POSITIVE);
    if given > MOST_GIVEN {
        warnings.push(format!(
            "contacts added {:.1} % of the input energy, but should only dissipate energy: the contact step is too coarse; use contact_step = \"auto\", or a smaller tolerance if it is auto already",
            given * 100.0
        ));
    }
    let remedy = if run.model.analysis.step.is_some() {
        "use step = \"auto\", or a shorter step"
    } else {
        "compare with a run at another tolerance"
    };
    warnings.extend(foundation_warnings(run.system));
    warnings.extend(wall_warnings(run.model));
    warnings.extend(friction_warnings(run.model, run.system));
    let accuracy = run.outcome.accuracy.iter();
    warnings.extend(accuracy.flat_map(|accuracy| accuracy_warnings(accuracy, remedy)));
    warnings
}

/// Estimated accuracy of a run.
fn accuracy_warnings(accuracy: &Accuracy, remedy: &str) -> impl Iterator<Item = String> + use<> {
    let Accuracy {
        tolerance,
        residual,
        sensitive_from,
        ..
    } = *accuracy;
    let missed = (residual > tolerance).then(|| {
        format!(
            "the tolerance of {tolerance:e} is not met: the estimated error of the peaks is {residual:.1e}, and they are sensitive to the time step; {remedy}"
        )
    });
    let earlier = if residual > tolerance {
        "earlier impacts agree between two step sizes"
    } else {
        "earlier results meet the tolerance"
    };
    let sensitive = sensitive_from.map(|from| {
        format!(
            "results are sensitive from t = {from:.3} s: an error below the tolerance can make or miss a contact then, and later impacts and peaks depend on it; {earlier}"
        )
    });
    missed.into_iter().chain(sensitive)
}

/// Energy that contacts may release by step errors, relative to the input.
const MOST_GIVEN: f64 = 0.01;

/// Notes on the results.
fn notes(run: &Run) -> Vec<String> {
    let mut notes = Vec::new();
    if run.plan.integrator.dissipates() {
        let taken = run.outcome.energy.imbalance();
        notes.push(format!(
            "numerical damping of the integrator dissipates {:.2} % of the input energy",
            100.0 * taken
        ));
        if !run.system.contacts.is_empty() {
            notes.push(
                "numerical damping reduces the rebound of every impact: restitution and impact counts are underestimated; use average acceleration for pounding".to_owned(),
            );
        }
    }
    if run
        .model
        .gaps
        .iter()
        .any(|gap| gap.law.kind == LawKind::Restitution)
    {
        notes.push(
            "the restitution law changes velocities instantly: its impacts have an impulse, but no force or duration; forces are those of sustained contact".to_owned(),
        );
    }
    let struck = !run.outcome.impacts.is_empty();
    if struck && run.plan.solver != Solver::Modal && run.system.frictions().next().is_some() {
        notes.push(
            "direct steps have no error estimate for single impacts: times and speeds of light impacts may have errors above the tolerance".to_owned(),
        );
    }
    notes.extend(crushed_notes(run.model, run.system, &run.outcome.state));
    notes.dedup();
    notes
}
