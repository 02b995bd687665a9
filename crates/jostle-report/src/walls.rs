//! Walls of the scene: where they stand, how high, and which column of the history moves them.

use jostle::model::Model;
use serde::Serialize;

use crate::Page;
use crate::devices::side_column;

/// A wall as the scene draws it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct SceneWall {
    /// Its name; empty for a rigid wall at an end of the row.
    name: String,
    /// Building of the history whose floor 0 it is; `None` moves with the ground.
    column: Option<usize>,
    /// Buildings on its left and on its right.
    pub(crate) beside: [Option<usize>; 2],
    /// Distances to them at rest; `None` where only a link joins it \[m\].
    widths: [Option<f64>; 2],
    /// Height of its highest contact or link \[m\].
    pub(crate) top: f64,
    /// Whether it is a line of the site, which has no place in a row of buildings.
    pub(crate) on_site: bool,
    /// Index among the sides of gaps and links of the model; see [`SceneWall::index_of`].
    side: Option<usize>,
}

/// All walls: one for every building that a wall stands beside, one for two neighbours on both of its sides.
pub(crate) fn walls(page: &Page) -> Vec<SceneWall> {
    let mut walls: Vec<SceneWall> = Vec::new();
    let gaps = page.gaps().map(|(summary, gap)| {
        let heights = summary.contacts.iter().map(|contact| contact.height_m);
        let top = heights.fold(0.0, f64::max);
        (gap.between, Some(gap.width()), top)
    });
    let links = page.links().map(|(summary, link)| {
        let heights = summary.floors.iter().map(|floor| floor.height_m);
        (link.between, None, heights.fold(0.0, f64::max))
    });
    for (between, width, top) in gaps.chain(links) {
        let Some((side, wall)) = wall_side(page.model, between) else {
            continue;
        };
        // The building stands on the other side of the joint, and the wall on the other side of the building.
        let opposite = 1 - side;
        let building = between[opposite];
        let known = walls.iter_mut().find(|known| {
            let same = known.beside[opposite] == building;
            let free = known.beside[opposite].is_none();
            known.side == wall && (same || free && adjacent(building, known.beside[side], opposite))
        });
        match known {
            Some(known) => {
                known.beside[opposite] = building;
                known.widths[opposite] = match (known.widths[opposite], width) {
                    (Some(a), Some(b)) => Some(a.min(b)),
                    (a, b) => a.or(b),
                };
                known.top = known.top.max(top);
            }
            None => {
                let mut new = SceneWall {
                    name: wall.map_or_else(String::new, |wall| named(page.model, wall)),
                    column: match side_column(page.model, wall, Some(0)) {
                        Some(Some(column)) => column.owner.building(),
                        _ => None,
                    },
                    beside: [None; 2],
                    widths: [None; 2],
                    top,
                    on_site: wall.is_some_and(|wall| stands_on_site(page.model, wall)),
                    side: wall,
                };
                new.beside[opposite] = building;
                new.widths[opposite] = width;
                walls.push(new);
            }
        }
    }
    walls
}

impl SceneWall {
    /// Index of the wall of a gap or link among those of the scene, for its left and its right side.
    pub(crate) fn index_of(
        walls: &[Self],
        model: &Model,
        between: [Option<usize>; 2],
    ) -> [Option<usize>; 2] {
        let mut found = [None; 2];
        if let Some((side, wall)) = wall_side(model, between) {
            let opposite = 1 - side;
            found[side] = walls.iter().position(|known| {
                known.side == wall && known.beside[opposite] == between[opposite]
            });
        }
        found
    }
}

/// The side that is a wall, and its index behind the buildings; `None` there is the rigid wall without a name.
fn wall_side(model: &Model, between: [Option<usize>; 2]) -> Option<(usize, Option<usize>)> {
    let is_wall = |side: &Option<usize>| side.is_none_or(|index| index >= model.buildings.len());
    let side = between.iter().position(is_wall)?;
    Some((side, between[side]))
}

/// Whether a side of a gap is a wall along a line of the site.
pub(crate) fn stands_on_site(model: &Model, side: usize) -> bool {
    let wall = model.walls.get(side.wrapping_sub(model.buildings.len()));
    wall.is_some_and(|wall| wall.line.is_some())
}

/// Whether a building is the neighbour of another on a side.
fn adjacent(building: Option<usize>, other: Option<usize>, side: usize) -> bool {
    let (Some(one), Some(other)) = (building, other) else {
        return false;
    };
    if side == 0 {
        one + 1 == other
    } else {
        other + 1 == one
    }
}

fn named(model: &Model, index: usize) -> String {
    let wall = model.walls.get(index.wrapping_sub(model.buildings.len()));
    wall.map_or_else(String::new, |wall| wall.name.clone())
}
