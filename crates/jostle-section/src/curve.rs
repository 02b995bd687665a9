//! Moment and curvature of a section under constant axial force, with the events along the curve.

use jostle::hysteresis::Corner;

use crate::fibre::{Fibres, Resultants};
use crate::section::Section;

/// Choices of an analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Fibres over the depth, ≥ 1; 40 are exact to six digits \[–\].
    pub fibres: usize,
    /// The curve ends when the moment has fallen to this share of its peak, 0…1 \[–\].
    pub residual: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            fibres: 40,
            residual: 0.8,
        }
    }
}

/// Something that happens to a section as it bends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// The outermost concrete in tension reaches its tensile strength.
    Cracking,
    /// The outermost bar in tension yields.
    TensionYield,
    /// The outermost concrete in compression reaches its strength.
    PeakStress,
    /// The outermost concrete, or that of a confined core, is crushed.
    Crushing,
    /// The outermost bar breaks.
    Rupture,
    /// The moment has fallen to the chosen share of its peak.
    Softened,
}

impl EventKind {
    /// In words.
    #[must_use]
    pub fn describe(self) -> &'static str {
        match self {
            Self::Cracking => "first crack",
            Self::TensionYield => "tension bars yield",
            Self::PeakStress => "concrete at its strength",
            Self::Crushing => "concrete crushed",
            Self::Rupture => "bar breaks",
            Self::Softened => "moment has fallen",
        }
    }
}

/// A state on the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// The event.
    pub kind: EventKind,
    /// Curvature \[1/m\].
    pub curvature: f64,
    /// Moment \[N·m\].
    pub moment: f64,
    /// Depth of the neutral axis below the compressed face \[m\].
    pub neutral_axis: f64,
}

/// Why a section has no usable curve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// More compression than the section can carry.
    #[error(
        "the axial load of {load:.0} kN exceeds the {capacity:.0} kN that the section carries without bending; enlarge it or lower the load"
    )]
    Overloaded {
        /// Axial compression \[kN\].
        load: f64,
        /// Greatest axial compression \[kN\].
        capacity: f64,
    },
    /// Tension cracks the whole section.
    #[error(
        "the axial tension of {load:.0} kN cracks the whole section (it can take {capacity:.0} kN)"
    )]
    Torn {
        /// Axial tension \[kN\].
        load: f64,
        /// Tension at which the section cracks \[kN\].
        capacity: f64,
    },
    /// Breaks where it cracks.
    #[error(
        "the section yields at {yielding:.1} kN.m, below its cracking moment of {cracking:.1} kN.m: it has too little reinforcement"
    )]
    Brittle {
        /// Cracking moment \[kN·m\].
        cracking: f64,
        /// Moment at first yield \[kN·m\].
        yielding: f64,
    },
}

/// Moment–curvature curve of a section under positive moment.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentCurvature {
    /// Axial compression, held constant \[N\].
    pub axial: f64,
    /// Points from zero on, events among them: curvature \[1/m\] and moment \[N·m\].
    pub points: Vec<Corner>,
    /// Events, in the order in which they happen.
    pub events: Vec<Event>,
}

/// A plane of strains in equilibrium.
#[derive(Clone, Copy)]
struct State {
    curvature: f64,
    strain: f64,
    moment: f64,
}

/// Steps towards the curvature at which the deepest bar yields in a section with its neutral axis at 0.3 h.
const STEPS_TO_YIELD: f64 = 40.0;
/// Steps grow by this factor.
const GROWTH: f64 = 1.03;
/// More points than any curve needs.
const MOST_POINTS: usize = 2000;

impl MomentCurvature {
    /// Bends a section under an axial compression \[N\] (tension negative) until it is crushed, breaks or
    /// softens.
    ///
    /// # Errors
    /// [`AnalysisError`] when the axial force alone is too much.
    pub fn new(section: &Section, axial: f64, options: Options) -> Result<Self, AnalysisError> {
        let bender = Bender {
            fibres: Fibres::new(section, options.fibres),
            axial,
            deepest: section.bars.iter().fold(0.0, |d, bar| bar.depth.max(d)),
        };
        bender.bend(options.residual)
    }

    /// The first event of a kind.
    #[must_use]
    pub fn event(&self, kind: EventKind) -> Option<&Event> {
        self.events.iter().find(|event| event.kind == kind)
    }

    /// The greatest moment \[N·m\].
    #[must_use]
    pub fn peak_moment(&self) -> f64 {
        self.points
            .iter()
            .fold(0.0, |peak, point| point.force.max(peak))
    }
}

/// A section being bent.
struct Bender {
    fibres: Fibres,
    axial: f64,
    deepest: f64,
}

impl Bender {
    fn bend(&self, residual: f64) -> Result<MomentCurvature, AnalysisError> {
        let section = self.fibres.section();
        let at_rest = self.unbent()?;
        let mut curve = MomentCurvature {
            axial: self.axial,
            points: vec![Corner {
                deformation: 0.0,
                force: at_rest.moment,
            }],
            events: Vec::new(),
        };
        let mut step = section.steel.yield_strain() / (0.7 * section.depth) / STEPS_TO_YIELD;
        let (mut here, mut peak) = (at_rest, 0.0_f64);
        let watched = [
            EventKind::Cracking,
            EventKind::TensionYield,
            EventKind::PeakStress,
            EventKind::Crushing,
            EventKind::Rupture,
        ];
        let mut open: Vec<_> = watched
            .into_iter()
            .filter(|kind| self.margin(*kind, &here) < 0.0)
            .collect();
        while curve.points.len() < MOST_POINTS {
            let Some(mut next) = self.solve(here.curvature + step, here.strain) else {
                break;
            };
            // The first event in the step becomes a separate point.
            let passed = open
                .iter()
                .copied()
                .filter(|kind| self.margin(*kind, &next) >= 0.0);
            let first = passed
                .map(|kind| (kind, self.locate(kind, here, next)))
                .min_by(|a, b| a.1.curvature.total_cmp(&b.1.curvature));
            if let Some((kind, state)) = first {
                next = state;
                open.retain(|other| *other != kind);
                curve.events.push(self.event(kind, &next));
            }
            if next.curvature > here.curvature {
                curve.points.push(Corner {
                    deformation: next.curvature,
                    force: next.moment,
                });
            }
            peak = peak.max(next.moment);
            here = next;
            if matches!(first, Some((EventKind::Crushing | EventKind::Rupture, _))) {
                break;
            }
            let cracked = curve
                .events
                .iter()
                .any(|event| event.kind != EventKind::Cracking);
            if cracked && next.moment < residual * peak {
                curve.events.push(self.event(EventKind::Softened, &next));
                break;
            }
            step *= GROWTH;
        }
        Ok(curve)
    }

    /// Uniform strain under the axial force.
    fn unbent(&self) -> Result<State, AnalysisError> {
        let section = self.fibres.section();
        let stiffness = section.concrete.modulus * section.transformed().area;
        let crack = section.concrete.tensile_strength * section.transformed().area;
        if self.axial < -crack {
            return Err(AnalysisError::Torn {
                load: -1e-3 * self.axial,
                capacity: 1e-3 * crack,
            });
        }
        if self.axial <= 0.0 {
            return Ok(self.state(0.0, self.axial / stiffness));
        }
        // Up to its peak the force rises with the strain.
        let force = |strain: f64| self.fibres.resultants(strain, 0.0).axial;
        let limit = self.fibres.plain().peak_strain;
        let capacity = force(limit);
        if self.axial > capacity {
            return Err(AnalysisError::Overloaded {
                load: 1e-3 * self.axial,
                capacity: 1e-3 * capacity,
            });
        }
        let strain = root(|strain| force(strain) - self.axial, 0.0, limit);
        Ok(self.state(0.0, strain))
    }

    fn state(&self, curvature: f64, strain: f64) -> State {
        let Resultants { moment, .. } = self.fibres.resultants(strain, curvature);
        State {
            curvature,
            strain,
            moment,
        }
    }

    /// Equilibrium at a curvature, nearest to a strain; `None` if there is none.
    fn solve(&self, curvature: f64, near: f64) -> Option<State> {
        let miss = |strain: f64| self.fibres.resultants(strain, curvature).axial - self.axial;
        let reach = 2.0 * curvature * self.fibres.section().depth + 1e-2;
        let mut step = 1e-6_f64.max(1e-3 * curvature * self.fibres.section().depth);
        let mut inner = near;
        let at = miss(near);
        if at == 0.0 {
            return Some(self.state(curvature, near));
        }
        let direction = -at.signum();
        loop {
            let outer = inner + direction * step;
            if (outer - near).abs() > reach {
                return None;
            }
            if miss(outer) * at <= 0.0 {
                let strain = root(miss, inner.min(outer), inner.max(outer));
                return Some(self.state(curvature, strain));
            }
            inner = outer;
            step *= 1.7;
        }
    }

    /// How far an event is passed: negative before, zero at it.
    fn margin(&self, kind: EventKind, state: &State) -> f64 {
        let section = self.fibres.section();
        let at = |depth: f64| self.fibres.strain_at(state.strain, state.curvature, depth);
        let plain = self.fibres.plain();
        match kind {
            EventKind::Cracking => -at(section.depth) - plain.cracking_strain(),
            EventKind::TensionYield => -at(self.deepest) - section.steel.yield_strain(),
            EventKind::PeakStress => at(0.0) - plain.peak_strain,
            EventKind::Crushing => match self.fibres.core() {
                Some(core) => at(crate::law::core_inset(section)) - core.crushing_strain,
                None => at(0.0) - plain.crushing_strain,
            },
            EventKind::Rupture => -at(self.deepest) - section.steel.rupture_strain,
            EventKind::Softened => -1.0,
        }
    }

    /// The state at which an event happens, between two that bracket it.
    fn locate(&self, kind: EventKind, before: State, after: State) -> State {
        let (mut low, mut high) = (before, after);
        for _ in 0..60 {
            let middle = 0.5 * (low.curvature + high.curvature);
            if middle <= low.curvature || middle >= high.curvature {
                break;
            }
            let Some(state) = self.solve(middle, low.strain) else {
                break;
            };
            if self.margin(kind, &state) >= 0.0 {
                high = state;
            } else {
                low = state;
            }
        }
        high
    }

    fn event(&self, kind: EventKind, state: &State) -> Event {
        let depth = 0.5 * self.fibres.section().depth + state.strain / state.curvature;
        Event {
            kind,
            curvature: state.curvature,
            moment: state.moment,
            neutral_axis: depth,
        }
    }
}

/// Root of a function that changes sign between two points, to the last bits: regula falsi after Illinois, with
/// bisection where that is slow.
fn root(function: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let (mut a, mut b) = (low, high);
    let (mut fa, mut fb) = (function(a), function(b));
    for round in 0..200 {
        let secant = (a * fb - b * fa) / (fb - fa);
        let inside = secant > a && secant < b;
        let x = if inside && round % 4 != 3 {
            secant
        } else {
            0.5 * (a + b)
        };
        if x <= a || x >= b {
            break;
        }
        let fx = function(x);
        if fx == 0.0 {
            return x;
        }
        if (fx > 0.0) == (fb > 0.0) {
            (b, fb) = (x, fx);
            fa *= 0.5;
        } else {
            (a, fa) = (x, fx);
            fb *= 0.5;
        }
        if b - a <= 2.0 * f64::EPSILON * a.abs().max(b.abs()) {
            break;
        }
    }
    0.5 * (a + b)
}
