//! The reference run: modes advanced exactly, contact forces as polynomials over adaptive steps, every touch, release and
//! corner of a force an event.

mod advance;
mod contact_state;
mod events;
mod forces;
mod level;
mod peaks;
mod polynomial;
mod storeys;
mod take;
mod watch;

use crate::certify::C64;
use jostle::motion::Wave;
use jostle::{GroundMotion, System};

use super::laws::Closed;
use super::linear::{Component, components};
use super::phi::DEGREE;
use contact_state::ContactState;
use level::Level;
pub(super) use peaks::BuildingPeaks;
pub use peaks::Peaks;
use polynomial::{NODES, Poly, ZERO, inverse};
use watch::Watch;

/// How fine.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy {
    /// Error of a force polynomial over the greatest force of its gap.
    pub force: f64,
    /// Relative change of every gap.
    pub widen: f64,
    /// Most steps.
    pub steps: u64,
}

impl Accuracy {
    /// That of the reference.
    pub const FINE: Self = Self {
        force: 1e-10,
        widen: 0.0,
        steps: 6_000_000,
    };
    /// For its conditioning.
    pub const OTHER: Self = Self {
        force: 1e-9,
        widen: 1e-6,
        steps: 6_000_000,
    };
}

struct Run<'a> {
    motion: &'a GroundMotion,
    components: Vec<Component>,
    watch: Vec<Watch>,
    contact_states: Vec<ContactState>,
    nodes: Poly,
    to_monomials: [[f64; NODES]; NODES],
    to_chebyshev: [[f64; NODES]; NODES],
    levels: Vec<Level>,
    ground_degree: usize,
    /// Length of the pieces of the ground motion.
    piece: f64,
    q: Vec<Vec<C64>>,
    signals: Vec<Vec<(f64, f64)>>,
    closed: Vec<Option<Closed>>,
    /// Closing less width of every contact, and its rate, now.
    closings: Vec<(f64, f64)>,
    peaks: Peaks,
    gap_force: Vec<f64>,
    accuracy: Accuracy,
}

/// Runs a system.
///
/// # Errors
/// Why there is no reference.
pub fn run(system: &System, motion: &GroundMotion, accuracy: Accuracy) -> Result<Peaks, String> {
    let mut run = Run::new(system, motion, accuracy)?;
    run.go()?;
    Ok(run.peaks)
}

/// A step in contact under way: forces as polynomials of the share of the step.
struct Pushes {
    step: f64,
    ground: Poly,
    forces: Vec<(usize, Poly)>,
}

impl<'a> Run<'a> {
    fn new(system: &System, motion: &'a GroundMotion, accuracy: Accuracy) -> Result<Self, String> {
        let components = components(system)?;
        let watch: Vec<Watch> = components
            .iter()
            .map(|component| Watch::new(system, component))
            .collect();
        let contact_states = ContactState::all(system, &components, &watch, accuracy.widen)?;
        let nodes: Poly = std::array::from_fn(|i| {
            0.5 * (1.0 - (std::f64::consts::PI * i as f64 / DEGREE as f64).cos())
        });
        let powers = std::array::from_fn(|i| std::array::from_fn(|k| nodes[i].powi(k as i32)));
        let cosines = std::array::from_fn(|i| {
            std::array::from_fn(|k| (std::f64::consts::PI * (i * k) as f64 / DEGREE as f64).cos())
        });
        let wanted = (0.5 / fastest(&components, &watch)).clamp(5e-5, 6e-4);
        let (piece, ground_degree) = match motion.wave {
            Wave::Sampled { step, .. } => (step, 1),
            Wave::Sine { period, .. } => (period / 24.0, DEGREE),
            Wave::Ricker { period, .. } => (period / 40.0, DEGREE),
        };
        let free_step = piece / (piece / wanted).ceil();
        let gaps = system.contacts.iter().map(|c| c.gap + 1).max().unwrap_or(0);
        let q = components
            .iter()
            .map(|c| vec![ZERO; c.lambda.len()])
            .collect();
        let mut run = Self {
            motion,
            signals: watch.iter().map(|w| vec![(0.0, 0.0); w.len()]).collect(),
            watch,
            nodes,
            to_monomials: inverse(&powers),
            to_chebyshev: inverse(&cosines),
            levels: Vec::new(),
            ground_degree,
            piece,
            q,
            closed: vec![None; contact_states.len()],
            peaks: Peaks::new(system),
            closings: vec![(0.0, 0.0); contact_states.len()],
            gap_force: vec![0.0; gaps],
            contact_states,
            components,
            accuracy,
        };
        run.level_of(0, free_step);
        for index in 0..run.components.len() {
            run.read_signals(index);
        }
        run.read_closings();
        Ok(run)
    }

    fn go(&mut self) -> Result<(), String> {
        let duration = self.motion.duration;
        let (mut index, mut inside) = (0_u64, 0.0_f64);
        let mut level = 0_usize;
        let mut still = 0;
        let free_step = self.levels[0].step;
        let finest = (free_step / 2e-11).log2().ceil() as usize;
        loop {
            let start = index as f64 * self.piece;
            let whole = self.piece.min(duration - start);
            if whole <= 1e-12 {
                break;
            }
            let left = whole - inside;
            if left <= 1e-14 {
                index += 1;
                inside = 0.0;
                continue;
            }
            self.peaks.steps += 1;
            if self.peaks.steps > self.accuracy.steps {
                return Err(format!(
                    "more than {} steps by {:.3} s",
                    self.accuracy.steps,
                    start + inside
                ));
            }
            let in_contact = self.closed.iter().any(Option::is_some);
            if !in_contact {
                level = 0;
            }
            self.level_of(level, free_step);
            let step = self.levels[level].step;
            let ground = self.ground(index, inside, step);
            let most = if left < step * (1.0 - 1e-9) {
                left / step
            } else {
                1.0
            };
            let mut pushes = Pushes {
                step,
                ground,
                forces: Vec::new(),
            };
            let mut easy = false;
            let mut courses = Vec::new();
            if in_contact {
                match self.forces(level, &mut pushes, &mut courses) {
                    Some(error) if error <= 1.0 => easy = error < 2e-3,
                    _ if level < finest => {
                        level += 1;
                        continue;
                    }
                    Some(_) => {}
                    None => return Err(format!("forces not found at {:.6} s", start + inside)),
                }
            }
            let (mut reach, events) = self.corners(&courses, most);
            let mut after = self.advanced(level, reach, &pushes);
            if let Some((s, contact)) = self.touch_within(reach, &after, &pushes) {
                if s < reach {
                    after = self.advanced(level, s, &pushes);
                    reach = s;
                }
                self.accept(reach, after, &pushes);
                self.apply_closings(contact, &mut level);
                inside += reach * step;
                still = if reach * step < 1e-13 { still + 1 } else { 0 };
            } else {
                self.accept(reach, after, &pushes);
                inside += reach * step;
                still = if reach * step < 1e-13 { still + 1 } else { 0 };
                for (contact, next) in events {
                    self.apply_event(contact, next);
                }
            }
            if reach >= most && most < 1.0 || (whole - inside).abs() < 1e-14 {
                index += 1;
                inside = 0.0;
            }
            if still > 400 {
                return Err(format!("endless events at {:.6} s", start + inside));
            }
            if easy && reach >= most && level > 0 {
                level -= 1;
            }
        }
        for contact in 0..self.closed.len() {
            if let Some(closed) = self.closed[contact].take() {
                self.peaks.impulse[contact] += closed.impulse;
            }
        }
        Ok(())
    }
}

/// The fastest rate that matters to the accelerations of floors under a jerk of the ground \[rad/s\].
fn fastest(components: &[Component], watch: &[Watch]) -> f64 {
    let mut fastest: f64 = 2.0;
    for (component, watch) in components.iter().zip(watch) {
        for floor in 0..watch.floors {
            let row = watch.displacement(floor);
            let mut parts: Vec<(f64, f64)> = (0..row.len())
                .map(|j| {
                    let l = component.lambda[j];
                    (l.norm(), (row[j] * l * component.ground[j]).norm())
                })
                .collect();
            parts.sort_by(|a, b| b.0.total_cmp(&a.0));
            let mut beyond = 0.0;
            for (omega, share) in parts {
                beyond += share;
                if beyond > 0.03 {
                    fastest = fastest.max(omega);
                    break;
                }
            }
        }
    }
    fastest
}
