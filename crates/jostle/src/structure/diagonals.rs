//! Braces and struts between joints of a frame: axial force alone, at any angle.

use super::discretization::Discretization;
use super::element::{Element, Part, X, Y, over_nodes};
use super::spring_place::SpringPlace;
use super::stick_model::{StickModel, YieldingElement};
use crate::hysteresis::Hysteresis;
use crate::linear::Row;
use crate::model::{Diagonal, DiagonalPlace, PanelAcross, PlanAxis, ProportionalDamping};

/// A brace or a strut of a frame, as it stands in the stick model.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameDiagonal {
    /// Index of its frame in [`Discretization::frames`]; `None` where the building is one frame.
    pub frame: Option<usize>,
    /// What it is, and where in its frame.
    pub place: DiagonalPlace,
    /// Nodes of its lower and of its upper end; those of the ground, the mat or the floors there in a space frame.
    pub ends: [usize; 2],
    /// Unit vector of its plane along x and across; [1, 0] where the building is one plane frame \[–\].
    pub direction: [f64; 2],
    /// Elongation over displacements of nodes, 3 × node + (0 horizontal, 1 vertical or across, 2 rotation).
    pub elongation: Row,
    /// Axial force per elongation \[N/m\].
    pub stiffness: f64,
    /// Its force, if it is that of a spring that remembers.
    pub spring: Option<Hysteresis>,
    /// What its panel bears across its plane, if that is compared.
    pub across: Option<PanelAcross>,
}

impl FrameDiagonal {
    /// Of a building that is one frame.
    pub(super) fn new(own: &Diagonal, ends: [usize; 2], elongation: Row) -> Self {
        Self {
            frame: None,
            place: own.place,
            ends,
            direction: [1.0, 0.0],
            elongation,
            stiffness: own.stiffness,
            spring: own.hysteresis,
            across: own.across,
        }
    }

    /// In a plane of a space frame whose lines along x have this direction.
    pub(super) fn in_space(self, [c, s]: [f64; 2]) -> Self {
        let direction = match self.place.line.map(|line| line.along) {
            Some(PlanAxis::Y) => [-s, c],
            _ => [c, s],
        };
        Self { direction, ..self }
    }
}

impl Discretization {
    /// Adds the diagonals of a frame whose `joints` are nodes already, where there are any: feet first, then floor by floor, each by
    /// column line.
    pub(super) fn add_diagonals(&mut self, diagonals: &[Diagonal], joints: &[Vec<Option<usize>>]) {
        for own in diagonals {
            let [lower, upper] = own.place.lines();
            let storey = own.place.storey;
            // Diagonals without a joint are faults of the model.
            let (Some(from), Some(to)) = (joints[storey - 1][lower], joints[storey][upper]) else {
                continue;
            };
            let ends = [from, to];
            let elongation = elongation(&self.stick_model, ends);
            self.add_diagonal(FrameDiagonal::new(own, ends, elongation));
        }
    }

    /// Adds a diagonal and its spring.
    pub(super) fn add_diagonal(&mut self, own: FrameDiagonal) {
        match own.spring {
            None => self.stick_model.elements.push(Element::Spring {
                part: Part::Elastic,
                stiffness: own.stiffness,
                row: own.elongation.clone(),
            }),
            Some(hysteresis) => {
                self.stick_model.yielding.push(YieldingElement {
                    row: own.elongation.clone(),
                    hysteresis,
                    proportional_damping: ProportionalDamping::None,
                });
                self.spring_places.push(SpringPlace::of_diagonal(&own));
            }
        }
        self.diagonals.push(own);
    }
}

/// How much longer displacements of two nodes make the straight line between them.
fn elongation(sticks: &StickModel, [first, last]: [usize; 2]) -> Row {
    let [a, b] = [first, last].map(|node| sticks.nodes[node]);
    let length = libm::hypot(b.x - a.x, b.y - a.y);
    let [c, s] = [(b.x - a.x) / length, (b.y - a.y) / length];
    over_nodes([
        ((last, X), c),
        ((last, Y), s),
        ((first, X), -c),
        ((first, Y), -s),
    ])
}
