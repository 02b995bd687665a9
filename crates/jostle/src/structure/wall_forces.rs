//! Forces at the feet of walls and in coupling beams, as linear forms of the motion.

use super::element::{THETA, Y, over_nodes};
use super::member_forces::{Cuts, LinearForm, MemberForces, Motion};
use super::{AssembledBuilding, FibreSection, MemberEnd, MemberPlace, SpringPlace};
use crate::hysteresis::HysteresisMemory;
use crate::linear::Row;

/// Where a building stands before it moves; empty lists where self weight is left out.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct AtRest<'a> {
    /// Of its weight; 0 without it \[m/s²\].
    pub(crate) gravity: f64,
    /// Displacements \[m, rad\].
    pub(crate) displacement: &'a [f64],
    /// Springs that yield.
    pub(crate) springs: &'a [HysteresisMemory],
}

/// Forces at the foot of a wall, positive as those of columns: indices into [`MemberForces::forms`].
#[derive(Clone, Debug, PartialEq)]
pub struct WallForce {
    /// Its frame, where several stand in a plan.
    pub frame: Option<usize>,
    /// Its number in its frame, from 1.
    pub number: usize,
    /// Where it turns at its foot, if it yields there.
    pub hinge: SpringPlace,
    /// Where it turns above.
    pub upper_hinges: Vec<SpringPlace>,
    /// Whether it stands across the lines along x of a space frame.
    pub across: bool,
    /// Its foot, if that is made of fibres: index among [`crate::structure::Discretization::sections`].
    pub foot_section: Option<usize>,
    /// All its ends that are made of fibres, likewise.
    pub sections: Vec<usize>,
    /// Where it slides, if it yields there.
    pub sliding: Option<SpringPlace>,
    /// Axial force, positive in tension.
    pub axial: usize,
    /// Moment in its plane, positive where it stretches the right face, or that further along its line.
    pub moment: usize,
    /// Elongation of its axis between foot and top.
    pub elongation: usize,
}

/// Shear of a coupling beam: indices into [`MemberForces::forms`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplingForce {
    /// Index among [`crate::structure::Discretization::coupling_beams`].
    pub beam: usize,
    /// Shear, positive as that of beams.
    pub shear: usize,
    /// How far its left end rises against its right one beyond the mean rotation of both, which gives that shear.
    pub chord: usize,
    /// Length between the faces of its walls \[m\].
    pub length: f64,
}

/// Moment at the base of a frame with coupled walls: indices into [`MemberForces::forms`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// What axial forces of walls contribute, about the middle of their axes.
    pub couple: usize,
    /// That of all columns and walls, with their moments.
    pub total: usize,
}

impl MemberForces {
    /// Forces of walls and coupling beams, which are always followed.
    pub(super) fn add_walls(&mut self, building: &AssembledBuilding, rest: AtRest<'_>) {
        let discretization = &building.discretization;
        if discretization.walls.is_empty() {
            return;
        }
        let cuts = Cuts::new(building, rest.gravity);
        for (wall, frame_wall) in discretization.walls.iter().enumerate() {
            let place = MemberPlace::Column {
                line: frame_wall.part.line,
                storey: frame_wall.part.storeys[0],
            };
            let Some(foot) = discretization.member_at(frame_wall.frame, place) else {
                continue;
            };
            let [axial, _, moment] = cuts.at_foot(foot).map(|form| self.index_of(form));
            let top = MemberPlace::Column {
                line: frame_wall.part.line,
                storey: frame_wall.part.storeys[1],
            };
            let top = discretization
                .member_at(frame_wall.frame, top)
                .unwrap_or(foot);
            let ends = [cuts.first_node(foot), cuts.last_node(top)];
            let (line, storey) = (frame_wall.part.line, frame_wall.part.storeys[0]);
            let [first, last] = frame_wall.part.storeys;
            let sections: Vec<usize> = (0..discretization.sections.len())
                .filter(|section| {
                    let FibreSection { frame, member, .. } = discretization.sections[*section];
                    let of_wall = |storey| member == MemberPlace::Column { line, storey };
                    frame == frame_wall.frame && (first..=last).any(of_wall)
                })
                .collect();
            let mut stretched = over_nodes([((ends[1], Y), 1.0), ((ends[0], Y), -1.0)]);
            // Fibres at its foot and its head lie beyond these nodes.
            for section in &sections {
                let own = &discretization.sections[*section];
                let storey = match own.end {
                    MemberEnd::First => first,
                    MemberEnd::Last => last,
                };
                if own.member == (MemberPlace::Column { line, storey }) && own.point.is_none() {
                    stretched.add_times(1.0, &own.elongation);
                }
            }
            let stretched = discretization.stick_model.carried_row(&stretched);
            let elongation = self.index_of(LinearForm {
                displacement: building.equations.row(&stretched),
                ..LinearForm::default()
            });
            let before = discretization.walls[..wall].iter();
            let hinge = |storey, end| SpringPlace::Column { storey, line, end };
            let upper = frame_wall
                .part
                .hinges
                .iter()
                .map(|end_hinge| match end_hinge.at_head {
                    true => hinge(end_hinge.storey, MemberEnd::Last),
                    false => hinge(end_hinge.storey, MemberEnd::First),
                });
            let foot_hinge = hinge(storey, MemberEnd::First);
            let at_foot = |section: &&usize| {
                let section = &discretization.sections[**section];
                (section.member, section.end, section.point) == (place, MemberEnd::First, None)
            };
            self.walls.push(WallForce {
                across: false,
                upper_hinges: upper.filter(|upper| *upper != foot_hinge).collect(),
                frame: frame_wall.frame,
                number: 1 + before
                    .filter(|other| other.frame == frame_wall.frame)
                    .count(),
                hinge: foot_hinge,
                foot_section: sections.iter().find(at_foot).copied(),
                sections,
                sliding: Some(SpringPlace::sliding(place)),
                axial,
                moment,
                elongation,
            });
        }
        for (beam, coupling_beam) in discretization.coupling_beams.iter().enumerate() {
            let place = MemberPlace::Beam {
                floor: coupling_beam.part.floor,
                span: coupling_beam.part.bay,
            };
            let Some(member) = discretization.member_at(coupling_beam.frame, place) else {
                continue;
            };
            let sliding = SpringPlace::sliding(place);
            let shear = match discretization.spring_at(coupling_beam.frame, sliding) {
                Some(spring) => LinearForm {
                    springs: Row::single(spring),
                    ..LinearForm::default()
                },
                None => {
                    let [_, shear, _] = cuts.at_foot(member);
                    shear
                }
            };
            let shear = self.index_of(shear);
            let (row, length) = chord(building, member.elements.clone());
            let chord = self.index_of(LinearForm {
                displacement: row,
                ..LinearForm::default()
            });
            self.coupling_beams.push(CouplingForce {
                beam,
                shear,
                chord,
                length,
            });
        }
        self.add_coupling(&cuts, building, rest);
    }

    /// Moments at the base of a building that is one frame with coupled walls, without those of self weight.
    fn add_coupling(&mut self, cuts: &Cuts<'_>, building: &AssembledBuilding, rest: AtRest<'_>) {
        let discretization = &building.discretization;
        let at_base = |line: usize| {
            let mut walls = discretization.walls.iter();
            walls.any(|wall| wall.part.line == line && wall.part.storeys[0] == 1)
        };
        let columns = discretization.members.iter().filter_map(|member| {
            let at_base_of_frame = member.frame.is_none();
            match member.place {
                MemberPlace::Column { line, storey: 1 } if at_base_of_frame => Some((line, member)),
                _ => None,
            }
        });
        let columns: Vec<_> = columns.collect();
        let nodes = &discretization.stick_model.nodes;
        let x = |member: &super::FrameMember| nodes[cuts.first_node(member)].x;
        let walls = columns.iter().filter(|(line, _)| at_base(*line));
        let axes: Vec<f64> = walls.map(|(_, column)| x(column)).collect();
        if axes.len() < 2 || self.coupling_beams.is_empty() {
            return;
        }
        let middle = axes.iter().sum::<f64>() / axes.len() as f64;
        let [mut couple, mut total] = [LinearForm::default(), LinearForm::default()];
        for (line, column) in &columns {
            let [axial, _, moment] = cuts.at_foot(column);
            let lever = x(column) - middle;
            if at_base(*line) {
                couple.add(lever, &axial);
            }
            total.add(lever, &axial);
            total.add(1.0, &moment);
        }
        let [couple, total] = [couple, total].map(|form| {
            self.forms.push(form.tidy().beyond(rest));
            self.forms.len() - 1
        });
        self.coupling = Some(Coupling { couple, total });
    }
}

/// The row of [`CouplingForce::chord`] over degrees of freedom, and the length between both faces \[m\].
fn chord(building: &AssembledBuilding, elements: std::ops::Range<usize>) -> (Row, f64) {
    let stick_model = &building.discretization.stick_model;
    let members = &stick_model.members[elements];
    // From what stands beyond hinges to the faces, which are the first nodes there.
    let at_face = |node: usize| {
        let stick_model_node = stick_model.nodes[node];
        let frame = stick_model.turn(node).elevation;
        let tied = |other: &usize| {
            let is_in_frame = stick_model.turn(*other).elevation == frame;
            let other = stick_model.nodes[*other];
            is_in_frame
                && (other.x - stick_model_node.x).abs() + (other.y - stick_model_node.y).abs()
                    < 1e-9
        };
        (0..stick_model.nodes.len()).find(tied).unwrap_or(node)
    };
    let ends =
        [members.first(), members.last()].map(|member| member.map_or([0; 2], |node| node.ends));
    let [left, right] = [at_face(ends[0][0]), at_face(ends[1][1])];
    let length = stick_model.nodes[right].x - stick_model.nodes[left].x;
    let row = over_nodes([
        ((left, Y), 1.0),
        ((right, Y), -1.0),
        ((left, THETA), 0.5 * length),
        ((right, THETA), 0.5 * length),
    ]);
    (
        building.equations.row(&stick_model.carried_row(&row)),
        length,
    )
}

impl LinearForm {
    /// The same without its value at rest.
    fn beyond(mut self, rest: AtRest<'_>) -> Self {
        let still = vec![0.0; rest.displacement.len()];
        self.constant = if still.is_empty() {
            0.0
        } else {
            let motion = Motion {
                displacement: rest.displacement,
                velocity: &still,
                acceleration: &still,
                ground: 0.0,
            };
            let spring = |index: usize| rest.springs[index].force();
            self.constant - self.value(motion, spring, |_| 0.0, |_| 0.0)
        };
        self
    }
}
