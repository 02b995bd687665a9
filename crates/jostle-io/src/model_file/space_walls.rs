//! `[[building.wall]]` of a space frame: wide columns at crossings of its grid, to whose faces beams span.

use std::collections::BTreeMap;

use jostle::{
    ColumnFibres, Fibre, PlanAxis, PlanPoint, SpaceFrame, SpacePlace, SpaceSection, SpaceWall,
};

use super::brace::tables;
use super::frame_walls::read_factors;
use super::places::range;
use super::reinforced;
use super::section::{read_modulus, read_modulus_beside_bars};
use super::space_frame::{Grid, Material, Member, Sort, lies_in, read_hinge};
use super::space_hinges::SpaceHinges;
use super::wall_fibres::{self, OfWall};
use crate::keys::{AXES_OF_PLAN, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// A wall in one storey.
pub(super) struct WallStorey {
    place: SpacePlace,
    along: PlanAxis,
    length: f64,
    /// Its ends that are made of fibres.
    fibres: Option<ColumnFibres>,
    /// On EI and on GA.
    stiffness_factors: [f64; 2],
}

/// The building in which walls stand.
#[derive(Clone, Copy)]
pub(super) struct Around<'a, 'n> {
    pub(super) grid: &'a Grid,
    /// Of its floors.
    pub(super) plans: &'a [Vec<PlanPoint>],
    pub(super) heights: &'a [f64],
    pub(super) material: Material,
    pub(super) hinges: Option<&'a SpaceHinges<'n>>,
}

/// Puts walls in the places of `columns`, within the plan of their floor; returns them.
pub(super) fn read_all<'n>(
    reader: &mut Reader<'_>,
    view: &View<'n>,
    around: Around<'_, 'n>,
    columns: &mut BTreeMap<SpacePlace, Member<'n>>,
) -> Vec<WallStorey> {
    let (grid, plans) = (around.grid, around.plans);
    let mut walls: Vec<WallStorey> = Vec::new();
    for entry in tables(reader, view, "wall") {
        let Some(wall) = read(reader, view, &entry, around) else {
            continue;
        };
        let [x, y, storeys] = wall.ranges;
        let mut found = Vec::new();
        for storey in storeys[0]..=storeys[1] {
            for y in y[0]..=y[1] {
                let places = x[0]..=x[1];
                let places = places.map(|x| Sort::Column.place([x - 1, y - 1], storey - 1));
                found.extend(places.filter(|place| lies_in(*place, grid, &plans[storey - 1])));
            }
        }
        if found.is_empty() {
            *reader.bad(&entry, "names no place within the plan") =
                Some("check x, y and storeys, or plan".into());
            continue;
        }
        if let Some(place) = found
            .iter()
            .find(|candidate| walls.iter().any(|w| w.place == **candidate))
        {
            *reader.bad(
                &entry,
                format!("stands where another wall stands: at {place}"),
            ) = Some("leave it out there, or name other lines and storeys".into());
            continue;
        }
        for place in found {
            columns.insert(place, wall.member.clone());
            walls.push(WallStorey {
                place,
                along: wall.along,
                length: wall.length,
                fibres: wall.fibres.get(&(place.storey() + 1)).cloned(),
                stiffness_factors: wall.stiffness_factors,
            });
        }
    }
    walls
}

/// Lets beams along a wall begin at its faces, joins its storeys, and adds its fibres. Walls have no rigid ends of their own.
pub(super) fn add_to(walls: Vec<WallStorey>, frame: &mut SpaceFrame) {
    for wall in walls {
        let own = wall.fibres.map(|fibres| (wall.place, fibres));
        frame.fibres.extend(own);
        let [[x, y], _] = wall.place.crossings();
        let storey = wall.place.storey();
        for floor in storey.checked_sub(1).into_iter().chain([storey]) {
            let zone = frame.rigid_zones.entry([floor, x, y]).or_default();
            let arm = &mut zone[wall.along.index()];
            *arm = arm.max(0.5 * wall.length);
            zone[2] = 0.0;
        }
        let [line, _] = wall.place.crossings();
        let goes_on = frame.walls.iter_mut().find(|below| {
            let same = (below.line, below.along, below.length) == (line, wall.along, wall.length);
            same && below.storeys[1] + 1 == storey
        });
        match goes_on {
            Some(below) => below.storeys[1] = storey,
            None => frame.walls.push(SpaceWall {
                line,
                storeys: [storey; 2],
                along: wall.along,
                length: wall.length,
                stiffness_factors: wall.stiffness_factors,
            }),
        }
    }
}

/// What a table says of a wall.
struct Read<'n> {
    along: PlanAxis,
    length: f64,
    member: Member<'n>,
    /// By storey, from 1.
    fibres: BTreeMap<usize, ColumnFibres>,
    /// On EI and on GA.
    stiffness_factors: [f64; 2],
    /// Where it stands: lines of `lines_x` and of `lines_y`, and storeys, from 1.
    ranges: [[usize; 2]; 3],
}

fn read<'n>(
    reader: &mut Reader<'_>,
    building: &View<'n>,
    entry: &Field<'n>,
    around: Around<'_, 'n>,
) -> Option<Read<'n>> {
    let Around { grid, material, .. } = around;
    let view = reader.open(entry, &[Section::SpaceWall])?;
    let along = match reader.get(&view, "along") {
        Some(field) => reader.choice(&field, AXES_OF_PLAN, &[]),
        None => {
            let remedy = "add along = \"x\" or along = \"y\", the direction of its length";
            reader.missing(&view, "along", remedy);
            None
        }
    };
    let along = along.map(|word| match word {
        "x" => PlanAxis::X,
        _ => PlanAxis::Y,
    });
    let [length, thickness] =
        [("length", "\"4 m\""), ("thickness", "\"250 mm\"")].map(|(key, example)| {
            match reader.get(&view, key) {
                Some(field) => reader.positive(&field, Dimension::Length),
                None => {
                    reader.missing(&view, key, format!("add {key} = {example}"));
                    None
                }
            }
        });
    let (stated_modulus, own_is_bad) = match view.has("bars") {
        true => read_modulus_beside_bars(reader, &view),
        false => read_modulus(reader, &view),
    };
    let modulus = stated_modulus.or(material.modulus);
    if modulus.is_none() && !material.modulus_is_bad && !own_is_bad {
        let place = view.span.clone();
        *reader.fault(&place, view.path.clone(), "needs a modulus of elasticity") =
            Some("add elastic_modulus = \"30 GPa\" or concrete = \"C30\" to the building".into());
    }
    let [nx, ny] = grid.lines.each_ref().map(Vec::len);
    let ranges = [("x", nx), ("y", ny), ("storeys", around.plans.len())];
    let ranges = ranges.map(|(key, most)| range(reader, &view, key, most));
    let [Some(x), Some(y), Some(storeys)] = ranges else {
        return None;
    };
    let hinge = reader.get(&view, "hinge");
    // Without a hinge of its own a wall stays elastic, whatever columns do.
    let of_fibres = match &hinge {
        Some(field) => wall_fibres::asked_in_space(reader, field)?,
        None => false,
    };
    let (moments, fibres) = match hinge {
        Some(field) if of_fibres => {
            let of_wall = OfWall {
                size: [thickness, length],
                storeys: (storeys[0], &around.heights[storeys[0] - 1..storeys[1]]),
                concrete: reinforced::of_building(reader, building),
                in_space: true,
            };
            let fibres = wall_fibres::read(reader, &view, &field, of_wall);
            (Some([None, None]), fibres)
        }
        hinge => {
            wall_fibres::refuse(reader, &view, true);
            let moments = match hinge {
                Some(_) => read_hinge(reader, building, &view, Sort::Column, around.hinges),
                None => Some([None, None]),
            };
            (moments, Some(BTreeMap::new()))
        }
    };
    let [usual, torsion] = material.factors;
    let factors = read_factors(reader, &view, [usual, material.poisson_ratio], None);
    let mut stated = |key, dimension| {
        let field = reader.get(&view, key)?;
        reader.positive(&field, dimension)
    };
    let in_plane = [
        stated("EI", Dimension::FlexuralRigidity),
        stated("EA", Dimension::Force),
        stated("GA", Dimension::Force),
    ];
    let (along, length, thickness) = (along?, length?, thickness?);
    let (moments, mut fibres) = (moments?, fibres?);
    let mut size = [thickness; 2];
    size[along.index()] = length;
    let mut section = SpaceSection::rectangle(size, modulus?, material.poisson_ratio, true)?;
    let [bending, shear] = factors?;
    let [ei, ea, ga] = in_plane;
    if let Some(ei) = ei {
        section.flexural_rigidity[along.index()] = ei;
    }
    section.axial_rigidity = ea.or(section.axial_rigidity);
    if let (Some(ga), Some(rigidity)) = (ga, &mut section.shear_rigidity) {
        rigidity[along.index()] = ga;
    }
    section.flexural_rigidity = section
        .flexural_rigidity
        .map(|flexural_rigidity| bending * flexural_rigidity);
    section.shear_rigidity = section
        .shear_rigidity
        .map(|both| both.map(|share| shear * share));
    section.torsional_rigidity *= torsion;
    section.line_mass = material.density * length * thickness;
    let member = Member {
        section,
        slab: None,
        known: None,
        moments: Some(moments),
    };
    if along == PlanAxis::Y {
        fibres.values_mut().for_each(lay_across);
    }
    Some(Read {
        along,
        length,
        member,
        fibres,
        stiffness_factors: [bending, shear],
        ranges: [x, y, storeys],
    })
}

/// Lets fibres that lie along x lie across.
fn lay_across(own: &mut ColumnFibres) {
    let fibres = own.fibres.iter();
    let turned = fibres.map(|fibre| Fibre {
        at: [fibre.at[1], fibre.at[0]],
        ..*fibre
    });
    own.fibres = turned.collect();
}
