//! Space frames: joints, columns and beams as nodes and elements in space.

use std::collections::BTreeMap;
use std::fmt::Write;

use jostle::system::BuildingSystem;
use jostle::{Building, SpaceFrame, SpacePlace, Structure};

use super::script::{Script, rounded};

/// Most joints of the space frame of a building, its feet included.
pub(super) fn joints_of(building: &Building) -> usize {
    let Structure::Tiers(tiers) = &building.structure else {
        return 0;
    };
    let frame = tiers.space_frame.as_ref();
    let crossings = frame.map_or(0, |own| own.lines_x.len() * own.lines_y.len());
    crossings * (tiers.floors.len() + 1)
}

impl Script<'_> {
    pub(super) fn add_space_frame(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        frame: &SpaceFrame,
        storey_heights: &[f64],
    ) {
        let mut heights = vec![0.0];
        for storey in storey_heights {
            heights.push(heights[heights.len() - 1] + storey);
        }
        let floors = &building.discretization.floors;
        // Level 0 is the ground.
        let mut tags: BTreeMap<(usize, [usize; 2]), usize> = BTreeMap::new();
        let (c, s) = (frame.direction[0], frame.direction[1]);
        for member in &frame.members {
            let level = member.place.storey() + 1;
            let (levels, towards) = match member.place {
                SpacePlace::Column { .. } => ([level - 1, level], [c, s, 0.0]),
                SpacePlace::BeamX { .. } | SpacePlace::BeamY { .. } => {
                    ([level; 2], [0.0, 0.0, 1.0])
                }
            };
            let crossings = member.place.crossings();
            let mut ends = [0; 2];
            for side in 0..2 {
                let place = (levels[side], crossings[side]);
                ends[side] = match tags.get(&place) {
                    Some(tag) => *tag,
                    None => {
                        let tag = self.tag(index, self.next_point[index]);
                        self.next_point[index] += 1;
                        tags.insert(place, tag);
                        let [x, y] = frame.point(place.1).map(rounded);
                        let floor = match place.0.checked_sub(1) {
                            Some(floor) => self.tag(index, floors[floor]).to_string(),
                            None => "None".to_owned(),
                        };
                        let z = rounded(heights[place.0]);
                        let _ = writeln!(
                            self.space_joints,
                            "    ({tag}, {x:?}, {y:?}, {z:?}, {floor}),"
                        );
                        tag
                    }
                };
            }
            let section = &member.section;
            let axial = section
                .axial_rigidity
                .map_or_else(|| "None".to_owned(), |value| format!("{value:?}"));
            if section.axial_rigidity.is_none() {
                self.remark("Columns that keep their length are given EA = 1e4 * 12 EI / l^2.");
            }
            let shear = match section.shear_rigidity {
                Some([first, second]) => format!("({first:?}, {second:?})"),
                None => "None".to_owned(),
            };
            let element = self.element();
            let [bending, sideways] = section.flexural_rigidity;
            let _ = writeln!(
                self.space_members,
                "    ({element}, {}, {}, {bending:?}, {sideways:?}, {:?}, {axial}, {shear}, ({:?}, {:?}, {:?})),",
                ends[0], ends[1], section.torsional_rigidity, towards[0], towards[1], towards[2],
            );
        }
    }
}
