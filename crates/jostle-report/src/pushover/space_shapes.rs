//! Deformed shapes of space frames: their joints move with the rigid floors.

use std::collections::BTreeMap;

use jostle::model::Tiers;
use jostle::pushover::PushPoint;
use jostle::structure::{MemberEnd, MemberPlace, SpringPlace};
use jostle::system::{BuildingSystem, Direction};
use jostle::{DiagonalPlace, SpaceFrame, SpacePlace};
use serde_json::{Value, json};

/// A crossing of lines and the floors below it; 0 is the base.
type Joint = ([usize; 2], usize);

/// A space frame seen across the row.
pub(super) struct SpaceShape<'a> {
    frame: &'a SpaceFrame,
    system: &'a BuildingSystem,
    /// Joints at the ends of members.
    joints: Vec<Joint>,
    /// Their numbers; the floors stand before them.
    numbers: BTreeMap<Joint, usize>,
    /// Across the row from the centre of mass of the floor of each \[m\].
    across: Vec<f64>,
    /// Least x of all joints on the site \[m\].
    from: f64,
}

impl<'a> SpaceShape<'a> {
    pub(super) fn new(tiers: &'a Tiers, system: &'a BuildingSystem) -> Option<Self> {
        let frame = tiers.space_frame.as_ref()?;
        let members = frame.members.iter().map(|member| member.place);
        let mut joints: Vec<Joint> = members.flat_map(ends).collect();
        joints.sort_unstable();
        joints.dedup();
        let floors = tiers.lumped_floors();
        let numbers = joints.iter().enumerate();
        let numbers = numbers.map(|(index, joint)| (*joint, system.floors.len() + index));
        let across = |(crossing, level): &Joint| {
            let floor = level.checked_sub(1).and_then(|floor| floors.get(floor));
            floor.map_or(0.0, |floor| {
                frame.point(*crossing)[1] - floor.tier.centre[1]
            })
        };
        let xs = joints.iter().map(|(crossing, _)| frame.point(*crossing)[0]);
        Some(Self {
            frame,
            system,
            across: joints.iter().map(across).collect(),
            from: xs.fold(f64::INFINITY, f64::min),
            numbers: numbers.collect(),
            joints,
        })
    }

    /// Places at rest \[m\].
    pub(super) fn nodes(&self) -> [Vec<f64>; 2] {
        let floors = self.system.floors.iter();
        let height = |level: usize| {
            level
                .checked_sub(1)
                .map_or(0.0, |floor| self.system.floors[floor].height)
        };
        let mut x = vec![0.0; self.system.floors.len()];
        let mut y: Vec<f64> = floors.map(|floor| floor.height).collect();
        for (crossing, level) in &self.joints {
            x.push(self.frame.point(*crossing)[0] - self.from);
            y.push(height(*level));
        }
        [x, y]
    }

    /// Nodes that columns, beams, braces and struts join.
    pub(super) fn lines(&self) -> Vec<[usize; 2]> {
        let members = self.frame.members.iter().map(|member| ends(member.place));
        let diagonals = self.frame.diagonals.iter();
        let diagonals = diagonals.filter_map(|diagonal| diagonal_ends(diagonal.place));
        let joined = members.chain(diagonals);
        joined.filter_map(|ends| self.numbered(ends)).collect()
    }

    /// Where springs that yield are drawn, as [`super::shapes`] has them; `null` of those that have no place in the picture.
    pub(super) fn hinges(&self) -> Vec<Value> {
        let places = &self.system.discretization.spring_places;
        let count = self.system.equations.springs.len();
        let shown = |index: usize| self.hinge(*places.get(index)?);
        (0..count)
            .map(|index| shown(index).unwrap_or(Value::Null))
            .collect()
    }

    fn hinge(&self, place: SpringPlace) -> Option<Value> {
        match place {
            SpringPlace::InSpace { place, end, .. }
            | SpringPlace::Fibre {
                member: MemberPlace::InSpace(place),
                end,
                ..
            }
            | SpringPlace::Surface {
                member: MemberPlace::InSpace(place),
                end,
                ..
            } => {
                let numbers = self.numbered(ends(place))?;
                let (number, sign) = match end {
                    MemberEnd::First => (numbers[0], 1),
                    MemberEnd::Last => (numbers[1], -1),
                };
                let [dx, dy] = match place {
                    SpacePlace::Column { .. } => [0, sign],
                    SpacePlace::BeamX { .. } => [sign, 0],
                    SpacePlace::BeamY { .. } => [0, 0],
                };
                Some(json!([number, number, dx, dy]))
            }
            SpringPlace::Sliding {
                member: MemberPlace::InSpace(place),
                ..
            } => {
                let [a, b] = self.numbered(ends(place))?;
                Some(json!([a, b, 0, 0]))
            }
            SpringPlace::Diagonal { place, .. } => {
                let [a, b] = self.numbered(diagonal_ends(place)?)?;
                Some(json!([a, b, 0, 0]))
            }
            _ => None,
        }
    }

    fn numbered(&self, ends: [Joint; 2]) -> Option<[usize; 2]> {
        let [first, last] = ends.map(|joint| self.numbers.get(&joint).copied());
        Some([first?, last?])
    }

    /// Displacements to the right and upwards of all nodes \[m\].
    pub(super) fn displacements(&self, point: &PushPoint) -> Vec<f64> {
        let tracks = |direction: Direction| -> Vec<f64> {
            let tracks = self.system.tracks.iter();
            let own = tracks.filter(|track| track.direction == direction);
            own.map(|track| point.displacement[track.dof - self.system.offset])
                .collect()
        };
        let [along, turning] = [Direction::Along, Direction::Turning].map(tracks);
        let foot = self.system.foot;
        let foot = foot.map_or(0.0, |dof| point.displacement[dof - self.system.offset]);
        let joints = self.joints.iter().zip(&self.across);
        let joints = joints.map(|((_, level), across)| match level.checked_sub(1) {
            Some(floor) => along[floor] - turning.get(floor).map_or(0.0, |turn| turn * across),
            None => foot,
        });
        let all = along.iter().copied().chain(joints);
        all.flat_map(|moved| [moved, 0.0]).collect()
    }

    /// Number of nodes.
    pub(super) fn count(&self) -> usize {
        self.system.floors.len() + self.joints.len()
    }
}

/// Joints at both ends of a member.
fn ends(place: SpacePlace) -> [Joint; 2] {
    let levels = match place {
        SpacePlace::Column { storey, .. } => [storey, storey + 1],
        SpacePlace::BeamX { floor, .. } | SpacePlace::BeamY { floor, .. } => [floor + 1; 2],
    };
    let [first, last] = place.crossings();
    [(first, levels[0]), (last, levels[1])]
}

/// Those of a brace or a strut.
fn diagonal_ends(place: DiagonalPlace) -> Option<[Joint; 2]> {
    let ([low, high], [from, to]) = (place.crossings()?, place.floors());
    Some([(low, from), (high, to)])
}
