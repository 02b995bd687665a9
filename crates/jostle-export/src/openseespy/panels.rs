//! Infill panels that fall out: the script watches the accelerations of the floors beside them, and removes their struts.

use std::fmt::Write;
use std::ops::Range;

use jostle::structure::FrameDiagonal;
use jostle::system::BuildingSystem;

use super::script::Script;

/// Panels of a building that fall, with their struts.
#[derive(Default)]
pub(super) struct Panels<'a>(Vec<Panel<'a>>);

struct Panel<'a> {
    /// One of its struts.
    strut: &'a FrameDiagonal,
    /// Acceleration at which it falls \[m/s²\].
    limit: f64,
    elements: Vec<usize>,
}

impl<'a> Panels<'a> {
    /// Adds the elements of a strut to its panel, if it falls.
    pub(super) fn add(&mut self, strut: &'a FrameDiagonal, elements: Range<usize>) {
        let Some(across) = strut.across.filter(|across| across.falls) else {
            return;
        };
        let bay = |strut: &FrameDiagonal| {
            let place = strut.place;
            (strut.frame, place.line, place.storey, place.bay)
        };
        match self
            .0
            .iter_mut()
            .find(|known| bay(known.strut) == bay(strut))
        {
            Some(known) => {
                known.limit = known.limit.min(across.limit());
                known.elements.extend(elements);
            }
            None => self.0.push(Panel {
                strut,
                limit: across.limit(),
                elements: elements.collect(),
            }),
        }
    }
}

impl Script<'_> {
    /// Panels of a building, with the floors whose accelerations let them fall.
    pub(super) fn add_panels(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        panels: Panels<'_>,
    ) {
        let discretization = &building.discretization;
        let in_plan = building.is_in_space();
        for panel in panels.0 {
            let [along, across] = panel.strut.direction;
            // In one plane the motion along the row is taken for that across it.
            let [x, y] = if in_plan {
                [-across, along]
            } else {
                [1.0, 0.0]
            };
            let storey = panel.strut.place.storey;
            let floor = |floor: usize| self.tag(index, discretization.floors[floor]).to_string();
            let below = match storey - 1 {
                // In plan panels of the lowest storey are compared with their floor alone.
                0 if in_plan => None,
                0 => Some(discretization.mat.map_or_else(
                    || "None".to_owned(),
                    |mat| self.tag(index, mat.node).to_string(),
                )),
                below => Some(floor(below - 1)),
            };
            let sides = below.into_iter().chain([floor(storey - 1)]);
            let sides: String = sides.map(|side| format!("{side}, ")).collect();
            let elements: String = (panel.elements.iter())
                .map(|element| format!("{element}, "))
                .collect();
            let _ = writeln!(
                self.falling,
                "    ({:?}, {index}, ({}), ({x:?}, {y:?}), ({})),",
                panel.limit,
                sides.trim_end(),
                elements.trim_end(),
            );
            self.remark("Panels that fall lose their struts at the end of the step in which they do; in jostle the step ends there.");
        }
    }
}
