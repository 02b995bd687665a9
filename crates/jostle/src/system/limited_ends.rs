//! Ends of members whose rotations are compared with limits that the user states.

use std::collections::BTreeMap;

use crate::hysteresis::{Hysteresis, HysteresisMemory, Side};
use crate::model::{Building, LimitedMembers, RotationLevel, RotationMeasure, SpacePlace};
use crate::structure::{
    AssembledBuilding, FibreSection, MemberPlace, SpringPlace, end_stiffnesses,
};

/// A hinge of a member with limits of its rotation.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitedEnd {
    /// Its index among the springs of the building.
    pub spring: usize,
    /// Name of the member within the building, such as `column.2.3`.
    pub member: String,
    /// The end in words: `foot`, `head`, `struck`, `left`, `right`, `first` or `last`.
    pub at: &'static str,
    /// Which rotation is limited.
    pub measure: RotationMeasure,
    /// Greatest rotation of each level \[rad\].
    pub limits: BTreeMap<RotationLevel, f64>,
    /// Stiffness of the member behind it \[N·m/rad\].
    behind: Option<f64>,
    /// Its plastic rotation, where it yields on a surface: the spring is then a row of this, another one for each plane of bending.
    pub(crate) on_surface: Option<PlasticRotation>,
}

/// Plastic rotation of an end that yields on a surface: what its points moved without the elastic part of their forces, over their
/// distances from the axis. While the end flows one way it is the rotation beyond that at which it yielded.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlasticRotation {
    /// Springs of the points, and the shares of their displacements \[rad/m\] and forces \[rad/N\].
    points: Vec<(usize, [f64; 2])>,
}

impl PlasticRotation {
    /// In a plane of bending, 0 or 1. `first`: the first spring of the section.
    fn of(section: &FibreSection, first: usize, plane: usize) -> Self {
        let points = section.fibres.iter().enumerate();
        let points = points.filter(|(_, point)| point.at[plane] != 0.0);
        let squares: f64 = section.fibres.iter().map(|row| row.at[plane].powi(2)).sum();
        let points = points.map(|(row, point)| {
            let curve = point.spring.backbone();
            let (stiffness, kept) = (curve.initial(), curve.side(Side::Positive).post_yield);
            let share = point.at[plane] / squares / (stiffness - kept);
            (first + row, [share * stiffness, share])
        });
        Self {
            points: points.collect(),
        }
    }

    /// The same of springs that are counted on from others.
    pub(crate) fn moved_up(&self, offset: usize) -> Self {
        let points = self.points.iter();
        let points = points.map(|(spring, shares)| (offset + spring, *shares));
        Self {
            points: points.collect(),
        }
    }

    /// \[rad\]
    pub(crate) fn value(&self, springs: &[HysteresisMemory]) -> f64 {
        let points = self.points.iter().map(|(spring, [moved, elastic])| {
            let memory = &springs[*spring];
            moved * memory.deformation() - elastic * memory.force()
        });
        points.sum()
    }
}

/// Kind of the member of a hinge, its line or bay and its storey or floor, from 1, its name and its end; `None` for other springs.
type Place = (LimitedMembers, [usize; 2], String, &'static str);

fn place_of(place: &SpringPlace, frames: &[String]) -> Option<Place> {
    let of_frame = |frame: usize| frames.get(frame - 1).map_or("", String::as_str);
    let (columns, beams) = (LimitedMembers::Columns, LimitedMembers::Beams);
    Some(match *place {
        SpringPlace::Column { storey, line, end } => {
            let name = format!("column.{line}.{storey}");
            (columns, [line, storey], name, end.of_column())
        }
        SpringPlace::Struck { frame, member, .. } => {
            let at = match member {
                MemberPlace::Column { line, storey } => [line, storey],
                MemberPlace::Beam { floor, span } => [span, floor],
                MemberPlace::InSpace(place) => [0, place.storey() + 1],
            };
            let name = match frame {
                Some(frame) => format!("{}.{member}", of_frame(frame)),
                None => member.to_string(),
            };
            (columns, at, name, "struck")
        }
        SpringPlace::Beam { floor, bay, end } => {
            let name = format!("beam.{floor}.{bay}");
            (beams, [bay, floor], name, end.of_beam())
        }
        SpringPlace::ColumnInPlan {
            frame,
            storey,
            line,
            end,
        } => {
            let name = format!("{}.column.{line}.{storey}", of_frame(frame));
            (columns, [line, storey], name, end.of_column())
        }
        SpringPlace::BeamInPlan {
            frame,
            floor,
            bay,
            end,
        } => {
            let name = format!("{}.beam.{floor}.{bay}", of_frame(frame));
            (beams, [bay, floor], name, end.of_beam())
        }
        // One row for each plane of bending.
        SpringPlace::Surface {
            frame,
            member,
            end,
            point,
            row,
        } => {
            let (at, planes) = match member {
                MemberPlace::Column { line, storey } => ([line, storey], 1),
                MemberPlace::Beam { .. } => return None,
                MemberPlace::InSpace(place) => ([0, place.storey() + 1], 2),
            };
            if row > planes {
                return None;
            }
            let name = match frame {
                Some(frame) => format!("{}.{member}", of_frame(frame)),
                None => member.to_string(),
            };
            let end = point.map_or(end.of_column(), |_| "struck");
            (columns, at, name, end)
        }
        SpringPlace::InSpace { place, end, .. } => {
            let kind = match place {
                SpacePlace::Column { .. } => columns,
                SpacePlace::BeamX { .. } | SpacePlace::BeamY { .. } => beams,
            };
            let at = [0, place.storey() + 1];
            (kind, at, place.to_string(), end.in_space(place))
        }
        _ => return None,
    })
}

impl LimitedEnd {
    /// What is wrong with the limits of a building, and what to do.
    pub(super) fn fault(
        model: &Building,
        building: &AssembledBuilding,
        ends: &[Self],
    ) -> Option<&'static str> {
        let is_chord = |end: &Self| end.measure == RotationMeasure::Chord;
        if ends
            .iter()
            .any(|end| is_chord(end) && end.on_surface.is_some())
        {
            return Some(
                "limits chord rotations of columns that yield on a surface, whose plastic rotations alone are followed; write measure = \"plastic\"",
            );
        }
        let none = ends.is_empty() && !model.rotation_limits.is_empty();
        none.then(|| Self::none_named(building))
    }

    /// Why limits of a building name nothing, and what to do.
    fn none_named(building: &AssembledBuilding) -> &'static str {
        let discretization = &building.discretization;
        let places = &discretization.spring_places;
        let of_members = |place: &SpringPlace| place_of(place, &discretization.frames).is_some();
        match (places.is_empty(), places.iter().any(of_members)) {
            (true, _) => {
                "names no hinge of a member: the building is elastic; add hinges, or leave it out"
            }
            (_, true) => {
                "names no hinge of a member: its members have other lines and storeys, or yield elsewhere; name theirs, or leave it out"
            }
            (_, false) => {
                "limits rotations of columns, walls and beams with hinges of their own, and this building has none: here storeys, fibres or other parts yield; use limits of drift, strain limits or damage states; leave it out, or describe the building as a frame with hinges"
            }
        }
    }

    /// Every hinge of a building that a limit of the model names.
    pub(super) fn all(model: &Building, building: &AssembledBuilding) -> Vec<Self> {
        if model.rotation_limits.is_empty() {
            return Vec::new();
        }
        let discretization = &building.discretization;
        let behind = end_stiffnesses(&discretization.stick_model);
        let springs = discretization.spring_places.iter().enumerate();
        let ends = springs.filter_map(|(spring, place)| {
            let (kind, [line, storey], member, at) = place_of(place, &discretization.frames)?;
            let mut limits = model.rotation_limits.iter().rev();
            let limit = limits.find(|limit| limit.holds_for(kind, line, storey))?;
            let on_surface = match *place {
                SpringPlace::Surface { row, .. } => {
                    let mut sections = discretization.sections.iter();
                    let (section, rows) = sections.find_map(|section| {
                        let rows = discretization.springs_of_section(section);
                        rows.contains(&spring).then_some((section, rows))
                    })?;
                    Some(PlasticRotation::of(section, rows.start, row - 1))
                }
                _ => None,
            };
            Some(Self {
                on_surface,
                spring,
                member,
                at,
                measure: limit.measure,
                limits: limit.limits.clone(),
                behind: behind.get(spring).copied().flatten(),
            })
        });
        ends.collect()
    }

    /// Deformation of the hinge on its curve of first loading at which its rotation has this size, to a side \[rad\].
    pub(crate) fn deformation_at(&self, law: &Hysteresis, side: Side, rotation: f64) -> f64 {
        let curve = law.backbone().side(side);
        let behind = match self.measure {
            RotationMeasure::Plastic => return curve.yielding.deformation + rotation,
            RotationMeasure::Chord => self.behind,
        };
        let Some(stiffness) = behind else {
            return rotation;
        };
        // Rotation of hinge and member, along straight lines between corners.
        let mut last = [0.0; 2];
        for corner in [curve.cracking, curve.yielding] {
            let chord = corner.deformation + corner.force / stiffness;
            if rotation <= chord {
                let share = (rotation - last[1]) / (chord - last[1]);
                return last[0] + share * (corner.deformation - last[0]);
            }
            last = [corner.deformation, chord];
        }
        last[0] + (rotation - last[1]) / (1.0 + curve.post_yield / stiffness)
    }

    /// Its greatest rotation so far, either side, ≥ 0 \[rad\]; `memory`: that of its spring.
    pub(crate) fn rotation(&self, law: &Hysteresis, memory: &HysteresisMemory) -> f64 {
        let of = |side: Side| {
            let (turned, curve) = (memory.greatest(side), law.backbone().side(side));
            match (self.measure, self.behind) {
                (RotationMeasure::Plastic, _) => turned - curve.yielding.deformation,
                (RotationMeasure::Chord, Some(stiffness)) => {
                    turned + curve.force_at(turned) / stiffness
                }
                (RotationMeasure::Chord, None) => turned,
            }
        };
        of(Side::Positive).max(of(Side::Negative)).max(0.0)
    }
}
