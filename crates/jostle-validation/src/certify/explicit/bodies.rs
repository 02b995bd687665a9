//! Masses, springs, dashpots, links and contacts of a system as sparse rows over its displacements.

use jostle::hysteresis::{Hysteresis, HysteresisMemory, HysteresisRule};
use jostle::linear::SparseSymmetric;
use jostle::model::LinkLaw;
use jostle::statics::STANDARD_GRAVITY;
use jostle::{GroundMotion, System};

use super::super::laws::Law;
use super::massless::Massless;
use super::slider::Slider;

/// Coefficients of displacements.
pub(super) type Row = Vec<(usize, f64)>;

pub(super) fn along(row: &Row, values: &[f64]) -> f64 {
    row.iter().map(|(dof, share)| share * values[*dof]).sum()
}

pub(super) fn push(row: &Row, force: f64, load: &mut [f64]) {
    for (dof, share) in row {
        load[*dof] += share * force;
    }
}

/// Entries of a matrix, both halves.
#[derive(Default)]
pub(super) struct Matrix(Vec<(usize, usize, f64)>);

impl Matrix {
    fn take(&mut self, matrix: &SparseSymmetric, offset: usize, factor: f64) {
        let mut add = |row: usize, column: usize, value: f64| {
            if value != 0.0 {
                self.0.push((offset + row, offset + column, factor * value));
            }
        };
        for column in 0..matrix.diagonal.len() {
            add(column, column, matrix.diagonal[column]);
            for place in matrix.starts[column]..matrix.starts[column + 1] {
                let (row, value) = (matrix.rows[place] as usize, matrix.values[place]);
                add(row, column, value);
                add(column, row, value);
            }
        }
    }

    /// Its entries: row, column, value.
    pub(super) fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        self.0.iter().copied()
    }

    /// Adds the product with a vector.
    pub(super) fn multiply_add(&self, x: &[f64], out: &mut [f64]) {
        for (row, column, value) in &self.0 {
            out[*row] += value * x[*column];
        }
    }
}

/// How a spring answers.
pub(super) enum SpringLaw {
    /// A rule with memory.
    Rule(Hysteresis),
    /// Friction behind a spring.
    Slider(Slider),
}

/// A spring that yields or slides.
pub(super) struct Spring {
    pub(super) row: Row,
    pub(super) law: SpringLaw,
    /// Dashpot per tangent \[s\].
    pub(super) delay: f64,
}

/// How a link answers.
pub(super) enum Answer {
    Linear {
        k: f64,
        c: f64,
    },
    /// c |v|^α.
    Viscous {
        c: f64,
        exponent: f64,
    },
    /// The same with a spring in series, whose force is the unknown of that number.
    Series {
        k: f64,
        c: f64,
        exponent: f64,
        unknown: usize,
    },
    Slider(Slider),
    Rule(Hysteresis),
    Cable {
        k: f64,
        slack: f64,
    },
    Stopper {
        law: Law,
        gap: f64,
    },
}

/// A link.
pub(super) struct Link {
    /// Its shortening.
    pub(super) row: Row,
    pub(super) rest: f64,
    pub(super) inside: bool,
    pub(super) answer: Answer,
}

/// A contact.
pub(super) struct Contact {
    /// Its closing.
    pub(super) row: Row,
    pub(super) width: f64,
    pub(super) law: Law,
    /// How far a corner is inside of its edge.
    pub(super) ends: Vec<(Row, f64)>,
}

/// Everything that moves.
pub(super) struct Bodies {
    pub(super) mass: Vec<f64>,
    /// Masses on which the ground acts, along x and across.
    pub(super) driven: [Vec<f64>; 2],
    /// K + K′.
    pub(super) stiffness: Matrix,
    /// βK + C′.
    pub(super) damping: Matrix,
    /// α of every displacement.
    pub(super) alpha: Vec<f64>,
    pub(super) springs: Vec<Spring>,
    pub(super) links: Vec<Link>,
    pub(super) contacts: Vec<Contact>,
    /// Number of forces of springs in series with dashpots.
    pub(super) unknowns: usize,
    /// Kind of every displacement: of which building, and whether it turns.
    pub(super) groups: Vec<usize>,
    /// Self weight, as a load against every displacement.
    pub(super) weight: Vec<f64>,
    /// Displacements under it, from which runs start, and what springs remember there.
    pub(super) rest: (Vec<f64>, Vec<HysteresisMemory>),
    /// Displacements without mass.
    pub(super) massless: Massless,
}

impl Bodies {
    /// All of a system; gaps are wider by a share `widen`.
    pub(super) fn new(system: &System, widen: f64) -> Result<Self, String> {
        let n = system.len();
        let mut bodies = Self {
            mass: vec![0.0; n],
            driven: [vec![0.0; n], vec![0.0; n]],
            stiffness: Matrix::default(),
            damping: Matrix::default(),
            alpha: vec![0.0; n],
            springs: Vec::new(),
            links: Vec::new(),
            contacts: Vec::new(),
            unknowns: 0,
            groups: vec![0; n],
            weight: vec![0.0; n],
            rest: (vec![0.0; n], Vec::new()),
            massless: Massless::default(),
        };
        for (index, building) in system.buildings.iter().enumerate() {
            let (equations, offset) = (&building.equations, building.offset);
            if building.modal_damping.is_some() {
                return Err("damping in all modes is not part of this".into());
            }
            let range = building.range();
            if building.rest.displacement.iter().any(|u| *u != 0.0) {
                bodies.rest.0[range.clone()].copy_from_slice(&building.rest.displacement);
                let weight = bodies.weight[range.clone()].iter_mut();
                for (weight, mass) in weight.zip(&equations.weighing_mass) {
                    *weight = STANDARD_GRAVITY * mass;
                }
            }
            let known = building.rest.springs.iter().copied();
            let unloaded = std::iter::repeat(HysteresisMemory::default());
            let memories = known.chain(unloaded).take(equations.springs.len());
            bodies.rest.1.extend(memories);
            bodies.mass[range.clone()].copy_from_slice(&equations.mass);
            bodies.alpha[range.clone()].fill(equations.alpha);
            bodies.driven[0][range.clone()].copy_from_slice(&equations.driven_mass);
            if building.is_in_space() {
                bodies.driven[1][range.clone()].copy_from_slice(&equations.driven_across);
            }
            bodies.groups[range].fill(2 * index);
            for dof in turning(building) {
                bodies.groups[dof] = 2 * index + 1;
            }
            bodies.stiffness.take(&equations.stiffness, offset, 1.0);
            bodies.stiffness.take(&equations.undamped, offset, 1.0);
            bodies
                .damping
                .take(&equations.stiffness, offset, equations.beta);
            bodies.damping.take(&equations.dashpots, offset, 1.0);
            for spring in &equations.springs {
                let row: Row = spring.row.moved_up(offset).entries().to_vec();
                let law = match spring.hysteresis.rule() {
                    HysteresisRule::Sliding { slow, rate } => SpringLaw::Slider(Slider {
                        stiffness: spring.hysteresis.backbone().initial(),
                        slow,
                        fast: spring.hysteresis.backbone().yield_force(),
                        rate,
                    }),
                    HysteresisRule::InPlan { .. } | HysteresisRule::Failing(_) => {
                        return Err(
                            "bearings in plan and failing springs are not part of this".into()
                        );
                    }
                    _ => SpringLaw::Rule(spring.hysteresis),
                };
                bodies.springs.push(Spring {
                    row,
                    law,
                    delay: if spring.damped_by_tangent {
                        equations.beta
                    } else {
                        0.0
                    },
                });
            }
        }
        for link in &system.links {
            bodies.add_link(link);
        }
        for (index, contact) in system.contacts.iter().enumerate() {
            if contact.friction.is_some() {
                return Err("friction along faces is not part of this".into());
            }
            let (law, restitution) = Law::new(&contact.law)?;
            if restitution.is_some() {
                return Err("the momentum law is not part of this".into());
            }
            let ends = system.edge_ends.iter().filter(|end| end.contact == index);
            bodies.contacts.push(Contact {
                row: closing(&contact.ports),
                width: contact.width * (1.0 + widen) + 1e-4 * widen + contact.closing_at_rest,
                law,
                ends: ends.map(|end| (closing(&end.ports), end.inside)).collect(),
            });
        }
        bodies.massless = Massless::of(&bodies)?;
        Ok(bodies)
    }

    fn add_link(&mut self, link: &jostle::interface::LinkElement) {
        let (k, c) = (link.stiffness, link.damping);
        let answer = match link.law {
            LinkLaw::Linear => Answer::Linear { k, c },
            LinkLaw::Viscous { exponent } if k == 0.0 => Answer::Viscous { c, exponent },
            LinkLaw::Viscous { .. } | LinkLaw::Maxwell => {
                let exponent = match link.law {
                    LinkLaw::Viscous { exponent } => exponent,
                    _ => 1.0,
                };
                self.unknowns += 1;
                Answer::Series {
                    k,
                    c,
                    exponent,
                    unknown: self.unknowns - 1,
                }
            }
            LinkLaw::Friction {
                slip_force,
                stick_stiffness,
            } => Answer::Slider(Slider {
                stiffness: stick_stiffness,
                slow: slip_force,
                fast: slip_force,
                rate: 0.0,
            }),
            LinkLaw::Yielding(hysteresis) => Answer::Rule(hysteresis),
            LinkLaw::Cable { slack } => Answer::Cable { k, slack },
            LinkLaw::Stopper { gap } => Answer::Stopper {
                law: Law::Kelvin {
                    k,
                    c,
                    tension: false,
                },
                gap,
            },
        };
        self.links.push(Link {
            row: closing(&link.ports),
            rest: link.closing_at_rest,
            inside: link.inside,
            answer,
        });
    }

    pub(super) fn len(&self) -> usize {
        self.mass.len()
    }
}

/// Displacements that are rotations.
fn turning(building: &jostle::system::BuildingSystem) -> Vec<usize> {
    let tracks = building.tracks.iter();
    let mut dofs: Vec<usize> = tracks
        .filter(|track| track.direction == jostle::system::Direction::Turning)
        .map(|track| track.dof)
        .collect();
    dofs.extend(building.foundation.map(|foundation| foundation.turning));
    dofs
}

/// The closing of two ends as a row.
pub(super) fn closing(ports: &jostle::interface::PortPair) -> Row {
    let mut row = Row::new();
    for (port, sign) in ports.sides() {
        let entries = port.row.entries().iter();
        row.extend(entries.map(|(dof, share)| (*dof, -sign * share)));
    }
    row
}

/// The steps of the records of a motion \[s\].
pub(super) fn record_steps(motion: &GroundMotion) -> Vec<f64> {
    let across = motion
        .bearing
        .as_ref()
        .and_then(|bearing| bearing.across.as_ref());
    let waves = [Some(motion), across].into_iter().flatten();
    waves
        .filter_map(|wave| match wave.wave {
            jostle::Wave::Sampled { step, .. } => Some(step),
            _ => None,
        })
        .collect()
}
