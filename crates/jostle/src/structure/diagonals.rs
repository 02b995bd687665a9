//! Braces and struts between joints of a frame: axial force alone, at any angle.

use std::collections::BTreeMap;

use super::discretization::Discretization;
use super::element::{Element, Part, X, Y, over_nodes};
use super::spring_place::SpringPlace;
use super::stick_model::{StickModel, YieldingElement};
use crate::hysteresis::Hysteresis;
use crate::linear::Row;
use crate::model::{
    Diagonal, DiagonalPlace, FramePlace, PanelAcross, PanelDamage, PlanAxis, ProportionalDamping,
    Reach, SpaceFrame,
};

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
    /// How much longer the line between the joints of its bay becomes, over displacements of nodes.
    pub between_joints: Row,
    /// How its panel is damaged, if that is judged.
    pub damage: Option<PanelDamage>,
}

impl FrameDiagonal {
    /// Of a building that is one frame.
    pub(super) fn new(diagonal: &Diagonal, ends: [usize; 2], elongation: Row) -> Self {
        Self {
            frame: None,
            place: diagonal.place,
            ends,
            direction: [1.0, 0.0],
            stiffness: diagonal.stiffness,
            spring: diagonal.hysteresis,
            across: diagonal.across,
            between_joints: elongation.clone(),
            damage: diagonal.damage,
            elongation,
        }
    }

    /// In a space frame: in a plane of its lines, or across them.
    pub(super) fn in_space(self, frame: &SpaceFrame) -> Self {
        let [c, s] = frame.direction;
        let [x, y] = match (self.place.line.map(|line| line.along), self.place.reach) {
            (_, Reach { across, .. }) if across != 0 => {
                let [x, y] = frame.run(self.place).unwrap_or([1.0, 0.0]);
                let length = libm::hypot(x, y);
                [x / length, y / length]
            }
            (Some(PlanAxis::Y), _) => [0.0, 1.0],
            _ => [1.0, 0.0],
        };
        let direction = [c * x - s * y, s * x + c * y];
        Self { direction, ..self }
    }
}

impl Discretization {
    /// Adds the diagonals of a frame whose `joints` are nodes already, where there are any: feet first, then floor by floor, each by
    /// column line. `columns`: nodes between the ends of columns, by storey and line.
    pub(super) fn add_diagonals(
        &mut self,
        diagonals: &[Diagonal],
        joints: &[Vec<Option<usize>>],
        columns: &BTreeMap<FramePlace, Vec<usize>>,
    ) {
        for diagonal in diagonals {
            let [lower, upper] = diagonal.place.lines();
            let (storey, [low, high]) = (diagonal.place.storey, diagonal.place.floors());
            // Diagonals without a joint are faults of the model.
            let (Some(from), Some(to)) = (joints[low][lower], joints[high][upper]) else {
                continue;
            };
            let sticks = &self.stick_model;
            let on_column = |joint: usize, line: usize, above: f64| {
                let height = sticks.nodes[joint].y + above;
                let nodes = columns.get(&[storey - 1, line]).into_iter().flatten();
                let off = |node: &&usize| (sticks.nodes[**node].y - height).abs();
                nodes.min_by(|a, b| off(a).total_cmp(&off(b))).copied()
            };
            let ends = [
                (from, lower, diagonal.offsets[0]),
                (to, upper, -diagonal.offsets[1]),
            ];
            let ends = ends.map(|(joint, line, above)| match above == 0.0 {
                true => joint,
                false => on_column(joint, line, above).unwrap_or(joint),
            });
            let between_joints = elongation(sticks, [from, to]);
            let elongation = elongation(sticks, ends);
            self.add_diagonal(FrameDiagonal {
                between_joints,
                ..FrameDiagonal::new(diagonal, ends, elongation)
            });
        }
    }

    /// The spring of a diagonal among those of the building; `None` if it has none.
    pub(crate) fn spring_of_diagonal(&self, diagonal: &FrameDiagonal) -> Option<usize> {
        let place = SpringPlace::of_diagonal(diagonal);
        self.spring_places.iter().position(|known| *known == place)
    }

    /// Adds a diagonal and its spring.
    pub(super) fn add_diagonal(&mut self, diagonal: FrameDiagonal) {
        match diagonal.spring {
            None => self.stick_model.elements.push(Element::Spring {
                part: Part::Elastic,
                stiffness: diagonal.stiffness,
                row: diagonal.elongation.clone(),
            }),
            Some(hysteresis) => {
                self.stick_model.yielding.push(YieldingElement {
                    row: diagonal.elongation.clone(),
                    hysteresis,
                    proportional_damping: ProportionalDamping::None,
                });
                self.spring_places.push(SpringPlace::of_diagonal(&diagonal));
            }
        }
        self.diagonals.push(diagonal);
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
