//! Step sizes: fixed, or chosen from the tolerance (theory, Eqs. G1 and G2).

use super::expected_work::too_long;
use super::{modal, series};
use crate::eigen::Mode;
use crate::interface::Contact;
use crate::model::Integrator;
use crate::model::{Analysis, ModelFault, Solver};
use crate::motion::{GroundMotion, Wave};
use crate::simd;
use crate::system::{BuildingSystem, Direction, System};
use crate::transfer::{ProductEquations, ProductRefusal};

/// Step sizes and solver of a run.
///
/// ```
/// use jostle::{Plan, Solver};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # let model = towers::pair(0.02);
/// # let wave = (0..=300).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect();
/// # let motion = jostle::GroundMotion::sampled("sine", 0.01, wave);
/// # let system = jostle::System::assemble(&model).map_err(|faults| faults[0].clone())?;
///
/// let plan = Plan::choose(&system, &motion, &model.analysis).map_err(|faults| faults[0].clone())?;
/// assert_eq!(plan.solver, Solver::Modal); // elastic buildings, automatic steps
/// # Ok::<(), jostle::ModelFault>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Free-vibration step \[s\].
    pub step: f64,
    /// Steps while a contact is closed.
    pub contact_steps: ContactSteps,
    /// Time integration rule.
    pub integrator: Integrator,
    /// Solver.
    pub solver: Solver,
    /// Whether the ground shakes vertically as well.
    pub vertical: bool,
    /// Whether steps were given: then they are those of the run, and the tolerance does not refine them.
    pub is_given: bool,
    /// Storey drift beyond which a building that yields has collapsed \[–\].
    pub collapse_drift: f64,
}

/// Number of parts of a free-vibration step while a contact is closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactSteps {
    /// Constant.
    Fixed(u32),
    /// Powers of two. An impact as strong as any before starts with at least this number of steps per elastic
    /// collision at the actual impact speed; afterwards the estimated error of the force is kept below the
    /// tolerance.
    PerImpact {
        /// Steps of the impact with the peak force \[–\].
        steps: f64,
        /// Estimated error, relative to the greatest force of the gap \[–\].
        tolerance: f64,
    },
}

/// Steps per period of vertical modes with at least this share of the mass that moves vertically, at a tolerance of 1e-3.
const STEPS_PER_VERTICAL: f64 = 60.0;
const MODAL_STEPS_PER_VERTICAL: f64 = 12.0;
const VERTICAL_SHARE: f64 = 0.05;
/// Free-vibration steps per first lateral period, at a tolerance of 1e-3.
const STEPS_PER_FIRST_PERIOD: f64 = 400.0;
/// Free-vibration steps per third lateral period, at a tolerance of 1e-3.
const STEPS_PER_THIRD_PERIOD: f64 = 120.0;
/// Fraction of the tolerance for the response of a mode at resonance due to frequency errors of the steps.
const RESONANCE_SHARE: f64 = 0.5;
/// Lower limit of the step of any mode, as a fraction of a radian, at a tolerance of 1e-3.
const SHORTEST_OF_MODE: f64 = 0.01;
/// Free-vibration steps per period of an analytic ground motion, at a tolerance of 1e-3.
const STEPS_PER_MOTION_PERIOD: f64 = 100.0;
/// Steps per elastic impact, at a tolerance of 1e-3.
const STEPS_PER_IMPACT: f64 = 60.0;
/// Nominal tolerance of fixed steps \[–\].
pub(super) const USUAL_TOLERANCE: f64 = 1e-3;
/// Fraction of the tolerance for the force of a single impact, because later impacts multiply its error.
const CONTACT_SHARE: f64 = 0.1;
const MODAL_CONTACT_SHARE: f64 = 0.05;
/// Least steps per half cycle of a weak contact, relative to those of an impact, and in absolute number.
const FEWEST_ADAPTED: f64 = 1.0 / 6.0;
const FEWEST_OF_ALL: f64 = 4.0;
/// Factor on them where the stiffness grows steeply within a step.
const STIFFENING: f64 = 3.0;
/// Refinement at the start of steep forces.
const STEEP_START: f64 = 32.0;
/// Free-vibration step without other limits \[s\].
const LONGEST_STEP: f64 = 0.02;
/// Smallest number of fixed steps per first period and per impact.
const FEWEST_PER_PERIOD: f64 = 20.0;
const FEWEST_PER_IMPACT: f64 = 8.0;
/// Impact speed for checking fixed contact steps \[m/s\].
const TYPICAL_SPEED: f64 = 0.5;
/// Free-vibration steps of modal stepping, at a tolerance of 1e-3: per first and third lateral period, and per
/// period of an analytic motion.
const MODAL_STEPS_PER_FIRST: f64 = 20.0;
const MODAL_STEPS_PER_THIRD: f64 = 7.5;
const MODAL_STEPS_PER_MOTION_PERIOD: f64 = 300.0;
/// Free-vibration steps of series stepping per third lateral period: peaks do not rest on cubics.
const SERIES_STEPS_PER_THIRD: f64 = 5.0;
/// The same per period of an analytic motion: springs that yield and floors that push each other for long pass on what the
/// motion between the ends of steps lacks many times larger.
const SERIES_STEPS_PER_MOTION_PERIOD: f64 = 600.0;
/// Free-vibration step of modal stepping without other limits \[s\].
const LONGEST_MODAL_STEP: f64 = 0.05;
/// Steps per elastic impact of modal stepping, at a tolerance of 1e-3.
const MODAL_STEPS_PER_IMPACT: f64 = 36.0;
/// Least steps per half cycle of a weak contact, relative to these.
const MODAL_FEWEST_ADAPTED: f64 = 0.7;
/// Shortest regular step with which modal stepping is faster than direct steps \[s\].
const SHORTEST_FOR_LINKS: f64 = 2e-4;
/// Finest division of a free-vibration step.
const FINEST: u32 = 1 << 20;

impl Plan {
    /// Chooses the steps for a system and a motion, and the solver if none is named.
    ///
    /// # Errors
    /// A solver that does not support the system; a fixed step that cannot resolve the first period, the record or
    /// an impact; more work than [`Analysis::most_work`].
    pub fn choose(
        system: &System,
        motion: &GroundMotion,
        analysis: &Analysis,
    ) -> Result<Self, Vec<ModelFault>> {
        let mut faults = Vec::new();
        let solver = solver_for(system, motion, analysis);
        check_solver(solver, system, analysis, &mut faults);
        if motion.has_own_grounds() {
            faults.extend(refused_grounds(solver, system));
        }
        if motion.is_vertical() {
            faults.extend(refused_vertical(system, analysis));
        }
        if motion.bearing.is_some() && !system.is_in_space() {
            faults.push(ModelFault {
                path: "motion.angle".into(),
                problem: "and across need buildings with a plan; give every building one, or leave both out".into(),
            });
        }
        faults.extend(steps_of_components(motion));
        let refinement = (analysis.tolerance / 1e-3).sqrt();
        let step = match analysis.step {
            Some(step) => {
                check_step(step, system, motion, &mut faults);
                step
            }
            None if solver == Solver::Modal => {
                let per_period = [
                    MODAL_STEPS_PER_FIRST,
                    MODAL_STEPS_PER_THIRD,
                    MODAL_STEPS_PER_MOTION_PERIOD,
                ];
                exact_step(system, motion, refinement, per_period, LONGEST_MODAL_STEP)
            }
            None if solver == Solver::Series => {
                let per_period = [
                    MODAL_STEPS_PER_FIRST,
                    SERIES_STEPS_PER_THIRD,
                    SERIES_STEPS_PER_MOTION_PERIOD,
                ];
                let longest = LONGEST_MODAL_STEP.min(series::longest_step(system));
                exact_step(system, motion, refinement, per_period, longest)
            }
            None => automatic_step(system, motion, refinement),
        };
        let contact_steps = match analysis.contact_step {
            Some(contact_step) => {
                check_contact_step(contact_step, system, &mut faults);
                ContactSteps::Fixed(
                    (step / contact_step - 1e-9)
                        .ceil()
                        .clamp(1.0, f64::from(FINEST)) as u32,
                )
            }
            None => ContactSteps::PerImpact {
                steps: if follows_parabolas(solver) {
                    MODAL_STEPS_PER_IMPACT / libm::pow(analysis.tolerance / 1e-3, 0.25)
                } else {
                    STEPS_PER_IMPACT / refinement
                },
                tolerance: analysis.tolerance
                    * if follows_parabolas(solver) {
                        MODAL_CONTACT_SHARE
                    } else {
                        CONTACT_SHARE
                    },
            },
        };
        let plan = Self {
            step,
            contact_steps,
            integrator: analysis.integrator,
            solver,
            vertical: motion.is_vertical(),
            is_given: analysis.step.is_some() || analysis.contact_step.is_some(),
            collapse_drift: analysis.collapse_drift,
        };
        if faults.is_empty() {
            faults.extend(too_long(&plan, system, motion, analysis));
        }
        if faults.is_empty() {
            Ok(plan)
        } else {
            Err(faults)
        }
    }

    /// Tolerance of reported peaks, relative to the greatest of their kind; 1e-3 with fixed contact steps \[–\].
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        match self.contact_steps {
            ContactSteps::PerImpact { tolerance, .. } if follows_parabolas(self.solver) => {
                tolerance / MODAL_CONTACT_SHARE
            }
            ContactSteps::PerImpact { tolerance, .. } => tolerance / CONTACT_SHARE,
            ContactSteps::Fixed(_) => USUAL_TOLERANCE,
        }
    }

    /// Whether the free-vibration step follows from the tolerance.
    pub(super) fn is_automatic(&self, system: &System, motion: &GroundMotion) -> bool {
        let refinement = (self.tolerance() / 1e-3).sqrt();
        !self.is_given && self.chooses_contact_steps() && {
            let automatic = automatic_step(system, motion, refinement);
            (self.step - automatic).abs() <= 1e-9 * automatic
        }
    }

    /// The same plan with free-vibration and contact steps shorter by about this factor, or longer for factors
    /// below 1. Steps still end on the points of a record.
    pub(super) fn refined(&self, factor: f64, motion: &GroundMotion) -> Self {
        let step = self.step / factor;
        let step = match motion.corner_step() {
            Some(record_step) => record_step / (record_step / step - 1e-9).ceil().max(1.0),
            None => step,
        };
        self.with_step(Some(step))
    }

    /// The same plan with twice the steps in contact.
    pub(super) fn with_finer_contacts(&self) -> Self {
        let contact_steps = match self.contact_steps {
            ContactSteps::PerImpact { steps, tolerance } => ContactSteps::PerImpact {
                steps: 2.0 * steps,
                tolerance,
            },
            given @ ContactSteps::Fixed(_) => given,
        };
        Self {
            contact_steps,
            ..*self
        }
    }

    /// The same plan with another free-vibration step and matching contact steps, whose error falls with its
    /// square.
    pub(super) fn with_step(&self, step: Option<f64>) -> Self {
        let step = step.unwrap_or(self.step);
        let factor = self.step / step;
        let contact_steps = match self.contact_steps {
            ContactSteps::PerImpact { steps, tolerance } if !follows_parabolas(self.solver) => {
                ContactSteps::PerImpact {
                    steps: steps * factor,
                    tolerance: tolerance / (factor * factor),
                }
            }
            given => given,
        };
        Self {
            step: if follows_parabolas(self.solver) {
                self.step
            } else {
                step
            },
            contact_steps,
            ..*self
        }
    }

    /// Estimated error of peaks due to the period elongation of average acceleration; `None` for yielding
    /// buildings, whose modes change, or for another integrator \[–\].
    #[must_use]
    pub(crate) fn frequency_error(&self, system: &System, motion: &GroundMotion) -> Option<f64> {
        let yields = |building: &BuildingSystem| !building.equations.springs.is_empty();
        let known = self.integrator == Integrator::default();
        let known = known && !system.buildings.iter().any(yields);
        known.then(|| {
            let buildings = system.buildings.iter();
            let all = buildings.flat_map(|building| frequency_errors(building, motion));
            let worst = all.map(|(coefficient, _)| coefficient).fold(0.0, f64::max);
            worst * self.step * self.step
        })
    }

    /// The shortest expected step: after a typical impact, back to the grid \[s\].
    #[must_use]
    pub fn shortest_step(&self, system: &System) -> f64 {
        let finest = system
            .contacts
            .iter()
            .map(|contact| self.division(contact, TYPICAL_SPEED))
            .max();
        finest.map_or(self.step, |division| 0.25 * self.step / f64::from(division))
    }

    /// Whether the chosen solver keeps enough digits for every expected step (theory, Eq. R0). Only the product of
    /// transfer matrices can fail.
    ///
    /// # Errors
    /// [`ProductRefusal`], with the building and the remedy.
    pub fn check_digits(&self, system: &System) -> Result<(), ProductRefusal> {
        if self.solver != Solver::Product {
            return Ok(());
        }
        let step = self.shortest_step(system);
        system
            .buildings
            .iter()
            .try_for_each(|building| ProductEquations::check_step(building, self.integrator, step))
    }

    /// The first division of a contact that closes at `impact_speed` \[m/s\], if the expected force is this
    /// fraction of the greatest of its gap: errors count relative to the latter, and fall with the square of the
    /// step, or with its fourth power in modal stepping.
    #[must_use]
    pub fn first_division(&self, contact: &Contact, impact_speed: f64, share: f64) -> u32 {
        match self.contact_steps {
            ContactSteps::Fixed(division) => division,
            ContactSteps::PerImpact { steps, tolerance } => Self {
                contact_steps: ContactSteps::PerImpact {
                    steps: STEEP_START.powi(i32::from(contact.law.starts_steeply()))
                        * (steps * self.root_of_share(share)).max(self.fewest_in_contact(steps)),
                    tolerance,
                },
                ..*self
            }
            .division(contact, impact_speed),
        }
    }

    fn root_of_share(&self, share: f64) -> f64 {
        let root = share.sqrt();
        if follows_parabolas(self.solver) {
            root.sqrt()
        } else {
            root
        }
    }

    /// Least steps per half cycle of a weak contact.
    fn fewest_in_contact(&self, steps: f64) -> f64 {
        if follows_parabolas(self.solver) {
            MODAL_FEWEST_ADAPTED * steps
        } else {
            (FEWEST_ADAPTED * steps).max(FEWEST_OF_ALL)
        }
    }

    /// Whether contact steps are automatic.
    #[must_use]
    pub(crate) fn chooses_contact_steps(&self) -> bool {
        matches!(self.contact_steps, ContactSteps::PerImpact { .. })
    }

    /// The next finer division.
    #[must_use]
    pub(crate) fn finer(&self, division: u32) -> u32 {
        (2 * division).min(FINEST)
    }

    /// Whether steps of this division are too coarse to resolve a contact stiffness F′ \[N/m\], and a finer
    /// division exists.
    #[must_use]
    pub(crate) fn is_too_coarse(&self, division: u32, contact: &Contact, slope: f64) -> bool {
        slope > 0.0 && division < self.coarsest(contact, slope)
    }

    /// The coarsest division that resolves a contact stiffness F′ \[N/m\].
    fn coarsest(&self, contact: &Contact, slope: f64) -> u32 {
        let ContactSteps::PerImpact { steps, .. } = self.contact_steps else {
            return 1;
        };
        let half_cycle = std::f64::consts::PI * (contact.effective_mass() / slope).sqrt();
        (self.step * more_steps(contact) * self.fewest_in_contact(steps) / half_cycle)
            .ceil()
            .clamp(1.0, f64::from(FINEST)) as u32
    }

    /// Division of a free-vibration step for a contact that closes at `impact_speed` \[m/s\].
    #[must_use]
    pub fn division(&self, contact: &Contact, impact_speed: f64) -> u32 {
        match self.contact_steps {
            ContactSteps::Fixed(division) => division,
            ContactSteps::PerImpact { steps, .. } => {
                let duration = contact
                    .law
                    .elastic_duration(contact.effective_mass(), impact_speed.max(1e-3));
                let wanted = (self.step * more_steps(contact) * steps / duration).ceil();
                if wanted >= f64::from(FINEST) {
                    FINEST
                } else {
                    (wanted.max(1.0) as u32).next_power_of_two()
                }
            }
        }
    }
}

/// Factor on the steps of an impact.
fn more_steps(contact: &Contact) -> f64 {
    if contact.law.stiffens_steeply() {
        STIFFENING
    } else {
        1.0
    }
}

/// Whether contact forces are parabolas over a step, whose error is of fourth order.
fn follows_parabolas(solver: Solver) -> bool {
    match solver {
        Solver::Modal | Solver::Series => true,
        Solver::Riccati | Solver::Stiffness | Solver::Product => false,
    }
}

/// The named solver, or the fastest one that meets the tolerance. Fixed steps imply the Riccati solver; damping in
/// all modes requires modal stepping.
fn solver_for(system: &System, motion: &GroundMotion, analysis: &Analysis) -> Solver {
    let usual = || {
        let automatic = analysis.step.is_none() && analysis.contact_step.is_none();
        let mut buildings = system.buildings.iter();
        let can_go_by_modes = || modal::refusals(system, analysis.integrator).is_empty();
        if system.is_in_space() {
            // Those that yield have no modes.
            if can_go_by_modes() || buildings.any(|building| building.modal_damping.is_some()) {
                Solver::Modal
            } else {
                Solver::Riccati
            }
        } else if buildings.any(|building| building.modal_damping.is_some())
            || automatic && can_go_by_modes() && resolves_links(system, analysis.tolerance)
        {
            Solver::Modal
        } else if automatic
            && !motion.has_own_grounds()
            && series::refusals(system, analysis.integrator).is_empty()
        {
            Solver::Series
        } else {
            Solver::Riccati
        }
    };
    analysis.solver.unwrap_or_else(usual)
}

/// What cannot stand on ground that differs.
fn refused_grounds(solver: Solver, system: &System) -> Option<ModelFault> {
    if system.model_links().len() < system.links.len() {
        return Some(ModelFault {
            path: "soil.coupling".into(),
            problem: "foundations that share the soil stand on one ground; leave coupling out, or arrival, position and [building.motion]".into(),
        });
    }
    (solver == Solver::Series).then(|| ModelFault {
        path: "analysis.solver".into(),
        problem: "series cannot be used: the ground differs under the buildings, or shakes vertically; leave it out, or take solver = \"riccati\"".into(),
    })
}

/// What cannot be shaken vertically.
fn refused_vertical(system: &System, analysis: &Analysis) -> Option<ModelFault> {
    // Columns that cannot shorten move nothing upwards in any case.
    let floats = |system: &&BuildingSystem| {
        let could = system.moves_vertically() || system.discretization.space_frame.is_some();
        could && system.has_columns_in_plan() && system.rest.displacement.is_empty()
    };
    if let Some(building) = system.buildings.iter().find(floats) {
        return Some(ModelFault {
            path: "motion.vertical".into(),
            problem: format!(
                "columns of \"{}\" carry the masses of its floors only under self weight; add gravity = true to the building, or leave vertical out",
                building.name
            ),
        });
    }
    let mut buildings = system.buildings.iter();
    if !buildings.any(BuildingSystem::moves_vertically) {
        return Some(ModelFault {
            path: "motion.vertical".into(),
            problem: "no mass moves vertically: neither shear buildings nor frames with rigid columns have such masses; use frames with axial = { columns = \"flexible\" } or beam_segments, or leave vertical out".into(),
        });
    }
    let asked = analysis.members.envelopes;
    let lacks_inertia = |building: &&BuildingSystem| {
        let followed = &building.members;
        followed.forms.iter().any(|form| form.carries)
            || asked && !building.moves_vertically() && !followed.is_empty()
    };
    let building = system.buildings.iter().find(lacks_inertia)?;
    let [path, leave_out] = match asked {
        true => ["output.members", "members"],
        false => ["motion.vertical", "walls"],
    };
    Some(ModelFault {
        path: path.into(),
        problem: format!(
            "columns and walls of \"{}\" keep their length, and their forces then do not include vertical inertia forces; let them shorten, axial = {{ columns = \"flexible\" }}, or leave out {leave_out}, or vertical under [motion]",
            building.name
        ),
    })
}

/// Two records whose steps do not fit: no step could end at the points of both.
fn steps_of_components(motion: &GroundMotion) -> Option<ModelFault> {
    let step = |motion: &GroundMotion| match motion.wave {
        Wave::Sampled { step, .. } => Some(step),
        _ => None,
    };
    let (along, across) = (step(motion)?, step(motion.across()?)?);
    let ratio = along.max(across) / along.min(across);
    ((ratio - ratio.round()).abs() > 1e-9 * ratio).then(|| ModelFault {
        path: "motion.across".into(),
        problem: format!(
            "has points every {across} s, the record every {along} s; one must be a multiple of the other, so resample one of them"
        ),
    })
}

/// Whether modal stepping can afford the steps that links need: stiff ones are for direct steps, which need not resolve them.
fn resolves_links(system: &System, tolerance: f64) -> bool {
    modal::longest_step_of_links(system) * libm::pow(tolerance / 1e-3, 0.25) > SHORTEST_FOR_LINKS
}

/// The unsupported feature of the solver.
fn check_solver(
    solver: Solver,
    system: &System,
    analysis: &Analysis,
    faults: &mut Vec<ModelFault>,
) {
    let in_all_modes = |building: &BuildingSystem| building.modal_damping.is_some();
    let damped = system.buildings.iter().position(in_all_modes);
    if solver != Solver::Modal {
        if system.is_in_space() && solver == Solver::Product {
            faults.push(ModelFault {
                path: "analysis.solver".into(),
                problem: "product cannot be used: transfer matrices do not apply to buildings with a plan; leave it out, or take solver = \"riccati\"".into(),
            });
        }
        faults.extend(damped.map(|index| ModelFault {
            path: format!("building[{index}].damping.modes"),
            problem: "\"all\" needs solver = \"modal\" under [analysis], or none named there; other solvers know Rayleigh damping of one or two modes".into(),
        }));
        if solver == Solver::Series && damped.is_none() {
            let reasons = series::refusals(system, analysis.integrator);
            faults.extend(reasons.into_iter().map(|reason| ModelFault {
                path: "analysis.solver".into(),
                problem: format!(
                    "series cannot be used: {reason}; leave it out, or take solver = \"riccati\""
                ),
            }));
        }
        return;
    }
    for reason in modal::refusals(system, analysis.integrator) {
        faults.push(match (analysis.solver, damped) {
            (None, Some(index)) => ModelFault {
                path: format!("building[{index}].damping.modes"),
                problem: format!("\"all\" needs modal stepping, which cannot be used: {reason}; or name one or two modes"),
            },
            _ => ModelFault {
                path: "analysis.solver".into(),
                problem: format!("modal cannot be used: {reason}; or take solver = \"riccati\""),
            },
        });
    }
}

/// The free-vibration step where motion is exact over a step. Only the search for contacts and peaks needs it: cubics must
/// follow the third mode.
fn exact_step(
    system: &System,
    motion: &GroundMotion,
    refinement: f64,
    [per_first, per_third, per_motion_period]: [f64; 3],
    longest: f64,
) -> f64 {
    // Cubics are of fourth order.
    let refinement = refinement.sqrt().min(2.0);
    let mut step = longest;
    for building in &system.buildings {
        for (number, steps) in [(1, per_first), (3, per_third)] {
            step = lateral_period(building, number)
                .map_or(step, |period| step.min(refinement * period / steps));
        }
    }
    if motion.is_vertical() {
        for period in shortest_vertical_periods(system) {
            step = step.min(refinement * period / MODAL_STEPS_PER_VERTICAL);
        }
    }
    if let Some(period) = motion.period() {
        // Loads are linear over a step, which is of second order.
        step = step.min(refinement * refinement * period / per_motion_period);
    }
    match motion.corner_step() {
        Some(record_step) => record_step / (record_step / step - 1e-9).ceil().max(1.0),
        None => step,
    }
}

/// Of every building, the shortest period of modes with a fair share of its vertical mass \[s\].
fn shortest_vertical_periods(system: &System) -> impl Iterator<Item = f64> {
    system.buildings.iter().filter_map(|building| {
        let modes = building.vertical_modes();
        let all: f64 = modes.iter().map(|mode| mode.effective_mass_ratio_y).sum();
        let strong = modes
            .iter()
            .filter(|mode| mode.effective_mass_ratio_y >= VERTICAL_SHARE * all);
        strong.map(Mode::period).min_by(f64::total_cmp)
    })
}

fn lateral_period(building: &BuildingSystem, number: usize) -> Option<f64> {
    let periods: Vec<f64> = building.lateral_modes().map(Mode::period).collect();
    periods.get(number - 1).or(periods.last()).copied()
}

fn automatic_step(system: &System, motion: &GroundMotion, refinement: f64) -> f64 {
    let mut step = LONGEST_STEP;
    // Walls follow the ground, damped by the soil: errors of their frequencies decide.
    for building in system.structures() {
        // In space a mode of one plane is one of three.
        let third = if building.is_in_space() { 9 } else { 3 };
        for (number, steps) in [(1, STEPS_PER_FIRST_PERIOD), (third, STEPS_PER_THIRD_PERIOD)] {
            step = lateral_period(building, number)
                .map_or(step, |period| step.min(refinement * period / steps));
        }
    }
    if motion.is_vertical() {
        for period in shortest_vertical_periods(system) {
            step = step.min(refinement * period / STEPS_PER_VERTICAL);
        }
    }
    if let Some(period) = motion.period() {
        step = step.min(refinement * period / STEPS_PER_MOTION_PERIOD);
    }
    // Average acceleration changes every frequency by (ωh)²/12.
    for building in &system.buildings {
        if !building.equations.springs.is_empty() {
            continue;
        }
        for (coefficient, omega) in frequency_errors(building, motion) {
            let most = RESONANCE_SHARE * 1e-3 / coefficient;
            step = step.min(refinement * most.sqrt().max(SHORTEST_OF_MODE / omega));
        }
    }
    // Steps must end on the points of a record, where its slope changes.
    match motion.corner_step() {
        Some(record_step) => record_step / (record_step / step - 1e-9).ceil().max(1.0),
        None => step,
    }
}

/// Of every lateral mode: error of its share of the response per squared step, and its circular frequency. Average
/// acceleration changes a frequency by (ωh)²/12; at resonance this counts 1/(2ζ) times, if the motion has enough
/// cycles.
fn frequency_errors<'a>(
    building: &'a BuildingSystem,
    motion: &GroundMotion,
) -> impl Iterator<Item = (f64, f64)> + use<'a> {
    let equations = &building.equations;
    let duration = motion.duration;
    building.lateral_modes().map(move |mode| {
        let omega = mode.circular_frequency;
        let mut damping = 0.5 * (equations.alpha / omega + equations.beta * omega);
        if let Some(support) = &building.support {
            // Rayleigh damping acts on motion relative to the support, and the dashpot of the support beside it.
            let moved = match &building.mat_in_plan {
                Some(mat) => mat.mean_square(&mode.shape),
                None => mode.shape[support.dof - building.offset].powi(2),
            };
            damping *= (1.0 - support.stiffness * moved / (omega * omega)).max(0.0);
            damping += 0.5 * support.damping * moved / omega;
        }
        let cycles = 0.5 / damping.max(1.0 / (omega * duration));
        let floors = mode.floors.iter();
        let largest = floors.fold(0.0, |most: f64, floor| most.max(floor.abs()));
        let share = match building.is_in_space() {
            true => share_in_space(building, mode).min(1.0),
            false => (mode.participation * largest).min(1.0),
        };
        (omega * omega / 12.0 * cycles * share, omega)
    })
}

/// Participation of a mode along x or across, whichever is greater, times its greatest displacement of a floor \[–\].
fn share_in_space(building: &BuildingSystem, mode: &Mode) -> f64 {
    let across = simd::dot(&building.equations.driven_across, &mode.shape);
    let radius = building.radius_of_gyration();
    let moved = building.tracks.iter().map(|track| {
        let value = mode.shape[track.dof - building.offset].abs();
        match track.direction {
            Direction::Turning => radius * value,
            Direction::Along | Direction::Across | Direction::Up => value,
        }
    });
    mode.participation.abs().max(across.abs()) * moved.fold(0.0, f64::max)
}

fn check_step(step: f64, system: &System, motion: &GroundMotion, faults: &mut Vec<ModelFault>) {
    let mut fault = |problem: String| {
        faults.push(ModelFault {
            path: "analysis.step".into(),
            problem,
        });
    };
    for building in &system.buildings {
        if let Some(period) =
            lateral_period(building, 1).filter(|period| step > period / FEWEST_PER_PERIOD)
        {
            fault(format!(
                "{step} s is too large for \"{}\", whose first period is {period:.4} s; use at most {:.4} s, or \"auto\"",
                building.name,
                period / FEWEST_PER_PERIOD
            ));
        }
    }
    if let Some(record_step) = motion
        .step()
        .filter(|record_step| step > record_step * (1.0 + 1e-9))
    {
        fault(format!(
            "{step} s would skip points of the record, whose step is {record_step} s; use at most that, or \"auto\""
        ));
    }
}

fn check_contact_step(contact_step: f64, system: &System, faults: &mut Vec<ModelFault>) {
    let shortest = system
        .contacts
        .iter()
        .filter(|contact| contact.law.stiffness() > 0.0)
        .map(|contact| {
            contact
                .law
                .elastic_duration(contact.effective_mass(), TYPICAL_SPEED)
        });
    let shortest = shortest.fold(f64::INFINITY, f64::min);
    if contact_step > shortest / FEWEST_PER_IMPACT {
        faults.push(ModelFault {
            path: "analysis.contact_step".into(),
            problem: format!(
                "{contact_step} s is too large for impacts that last about {shortest:.4} s; use at most {:.5} s, or \"auto\"",
                shortest / FEWEST_PER_IMPACT
            ),
        });
    }
}
