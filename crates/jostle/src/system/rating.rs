//! A column, beam or joint whose demand is compared with its capacity.

use super::BuildingSystem;
use crate::hysteresis::{HysteresisMemory, Side};
use crate::model::MemberCapacity;
use crate::structure::{
    AssembledBuilding, MemberEnd, MemberPlace, MemberSection, SectionAt, SpringPlace, ductility,
    end_stiffnesses,
};

/// A column, beam or joint whose demand is compared with its capacity.
#[derive(Clone, Debug, PartialEq)]
pub struct MemberRating {
    /// Its building.
    pub building: usize,
    /// The member or joint among the [`MemberForces`](crate::structure::MemberForces) of the building.
    pub part: RatedPart,
    /// Its sections.
    pub sections: Vec<MemberSection>,
    /// Its capacity.
    pub capacity: MemberCapacity,
    /// Its hinges.
    hinges: Vec<MemberHinge>,
}

/// What is rated, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RatedPart {
    /// A column or beam.
    Member(usize),
    /// The core of a joint.
    Joint(usize),
}

/// A hinge of a member, at an end or where it is struck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MemberHinge {
    at: SectionAt,
    /// Its index among the springs of the building.
    spring: usize,
    /// Stiffness of the member behind it \[N·m/rad\].
    behind: Option<f64>,
}

impl MemberHinge {
    /// The hinges of a member, at its ends in every plane in which it bends, and at struck points. `frame`: its own, where several stand in a plan.
    pub(super) fn of_member(
        building: &AssembledBuilding,
        frame: Option<usize>,
        place: MemberPlace,
    ) -> Vec<Self> {
        let behind = end_stiffnesses(&building.discretization.stick_model);
        let ends = [
            (MemberEnd::First, SectionAt::First),
            (MemberEnd::Last, SectionAt::Last),
        ];
        let places = ends.into_iter().flat_map(|(end, at)| {
            let places = SpringPlace::of_hinges(place, end).into_iter();
            places.map(move |place| (place, at))
        });
        let hinge_places = places.filter_map(|(hinge, at)| {
            let hinge = match frame {
                Some(frame) => hinge.in_frame(frame + 1)?,
                None => hinge,
            };
            Some((hinge, at))
        });
        let hinge_places: Vec<(SpringPlace, SectionAt)> = hinge_places.collect();
        let at = |spring: &SpringPlace| match *spring {
            SpringPlace::Struck {
                frame: of, member, ..
            } => {
                let is_here = (of, member) == (frame.map(|frame| frame + 1), place);
                is_here.then_some(SectionAt::Below)
            }
            _ => {
                let mut known = hinge_places.iter();
                known.find(|(end, _)| end == spring).map(|(_, at)| *at)
            }
        };
        let springs = building.discretization.spring_places.iter().enumerate();
        let hinges = springs.filter_map(|(spring, place)| {
            Some(Self {
                at: at(place)?,
                spring,
                behind: behind.get(spring).copied().flatten(),
            })
        });
        hinges.collect()
    }

    /// Its index among the springs of the building.
    pub(super) fn spring(&self) -> usize {
        self.spring
    }

    /// Its greatest ductility so far, either side \[–\]. `memories`: those of the springs of the building.
    pub(super) fn ductility(
        &self,
        building: &AssembledBuilding,
        memories: &[HysteresisMemory],
    ) -> f64 {
        let rule = &building.equations.springs[self.spring].hysteresis;
        let memory = &memories[self.spring];
        let sides =
            Side::BOTH.map(|side| ductility(rule, memory.greatest(side), side, self.behind));
        sides[0].max(sides[1])
    }
}

impl MemberRating {
    pub(super) fn new(
        building: &BuildingSystem,
        index: usize,
        member: usize,
        capacity: &MemberCapacity,
    ) -> Self {
        let member_sections = &building.members.members[member];
        Self {
            building: index,
            part: RatedPart::Member(member),
            sections: member_sections.sections.clone(),
            capacity: capacity.clone(),
            hinges: MemberHinge::of_member(building, member_sections.frame, member_sections.place),
        }
    }

    pub(super) fn of_joint(
        building: &BuildingSystem,
        index: usize,
        joint: usize,
        capacity: &MemberCapacity,
    ) -> Self {
        Self {
            building: index,
            part: RatedPart::Joint(joint),
            sections: vec![building.members.joints[joint].section],
            capacity: capacity.clone(),
            hinges: Vec::new(),
        }
    }

    /// Greatest ductility so far of its hinges, at least 1 \[–\]. `springs`: those of the building.
    pub(crate) fn ductility(&self, building: &BuildingSystem, springs: &[HysteresisMemory]) -> f64 {
        let of = |hinge: &MemberHinge| hinge.ductility(building, springs);
        self.hinges.iter().map(of).fold(1.0, f64::max)
    }

    /// Greatest rotations so far of every hinge: where it is, plastic rotation and chord rotation \[rad\]. `springs`: those
    /// of the building.
    pub(crate) fn rotations<'a>(
        &'a self,
        building: &'a BuildingSystem,
        springs: &'a [HysteresisMemory],
    ) -> impl Iterator<Item = (SectionAt, [f64; 2])> + 'a {
        self.hinges.iter().map(|hinge| {
            let rule = &building.equations.springs[hinge.spring].hysteresis;
            let memory = &springs[hinge.spring];
            let mut greatest = [0.0_f64; 2];
            for side in Side::BOTH {
                let (turned, curve) = (memory.greatest(side), rule.backbone().side(side));
                let bent = hinge
                    .behind
                    .map_or(0.0, |stiffness| curve.force_at(turned) / stiffness);
                greatest[0] = greatest[0].max(turned - curve.yielding.deformation);
                greatest[1] = greatest[1].max(turned + bent);
            }
            (hinge.at, greatest)
        })
    }

    /// Whether ductility changes the result of any rule.
    pub(crate) fn degrades(&self) -> bool {
        let mut rules = self.capacity.rules.iter();
        !self.hinges.is_empty()
            && rules.any(|rule| rule.shear.as_ref().is_some_and(|shear| shear.degrades()))
    }

    /// Compression for an axial force of the run, positive in tension \[N\].
    pub(crate) fn compression(&self, axial: f64) -> f64 {
        let by_run = if self.capacity.follows_axial {
            axial
        } else {
            0.0
        };
        self.capacity.compression_at_rest - by_run
    }
}
