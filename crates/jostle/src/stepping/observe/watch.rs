//! What direct runs follow: a number over displacements, and what of it is reported.

use crate::history::{Column, Kind, Owner};
use crate::hysteresis::{HysteresisRule, Side};
use crate::linear::Row;
use crate::model::PlanFoundationSprings;
use crate::stepping::floor_peaks::floor_of;
use crate::structure::Discretization;
use crate::system::{BuildingSystem, PlasticRotation, System, Track};

/// A number over displacements of the system, whose peak is reported under a column. Watches of the same column follow each other and
/// share its peak.
#[derive(Clone, Debug)]
pub(crate) struct Watch {
    /// Owner, kind and direction.
    pub(crate) column: Column,
    /// The number, and what of it is reported.
    pub(super) statistic: Statistic,
}

/// Rows over the vectors of a [`State`](crate::State), and what of them is reported.
#[derive(Clone, Debug)]
pub(crate) enum Statistic {
    /// Greatest and least value.
    Extremes(Row),
    /// Greatest magnitude.
    Size(Row),
    /// Greatest length in plan, of two rows at right angles. Squares are followed: the length may be greatest where neither row is.
    Length([Row; 2]),
    /// Greatest magnitude at ends of steps.
    Drift(Drift),
    /// Greatest value of the closing of a contact, under which grounds may move apart.
    Closing(usize),
    /// Energy that dashpots take, from their coefficients uu, uθ, θθ over two rows.
    Dashpots([f64; 3], [Row; 2]),
    /// Time for which a spring has no force at ends of steps.
    Lifted(usize),
    /// 1 from the first end of a step at which any of some springs is deformed so far.
    Passed(DeformationLimit),
    /// Greatest and least plastic rotation of an end on a surface at ends of steps; with a limit 1 from the first one at which it is so far.
    Turned(PlasticRotation, Option<f64>),
}

/// A deformation of springs of a system, ≥ 0 to a side \[rad or m\].
#[derive(Clone, Debug)]
pub(crate) struct DeformationLimit {
    pub(super) springs: Vec<usize>,
    pub(super) side: Side,
    pub(super) deformation: f64,
}

/// The drift ratio of a vertical line: the difference of two displacements over a height \[m\], and a rotation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drift {
    pub(super) above: usize,
    pub(super) below: Option<usize>,
    pub(super) turned: Option<usize>,
    pub(super) height: f64,
}

impl Watch {
    pub(crate) fn new(column: Column, statistic: Statistic) -> Self {
        Self { column, statistic }
    }
}

/// All that direct runs of a system follow by displacements; `rises`: of masses that move vertically as well.
pub(super) fn watches(system: &System, rises: bool) -> Vec<Watch> {
    let mut all = Vec::new();
    for (index, building) in system.buildings.iter().enumerate() {
        of_floors(index, building, &mut all);
        of_support(index, building, &mut all);
        of_foundation(index, building, &mut all);
        of_foundation_in_plan(index, building, &mut all);
        of_sections(index, building, &mut all);
        of_panels(building, &mut all);
        of_footings(building, &mut all);
        of_limited_ends(building, &mut all);
        if rises {
            all.extend(building.vertical_points().map(|(floor, dof)| {
                let column = Column::displacement(index, floor + 1).up();
                Watch::new(column, Statistic::Size(Row::single(dof)))
            }));
        }
    }
    all.extend(
        (0..system.contacts.len())
            .map(|contact| Watch::new(Column::closing(contact), Statistic::Closing(contact))),
    );
    all
}

/// Displacements of floors in all directions, drifts of vertical lines, and corners.
fn of_floors(index: usize, building: &BuildingSystem, all: &mut Vec<Watch>) {
    let turned = building
        .foundation
        .as_ref()
        .map(|foundation| foundation.turning);
    let mut below: Option<&Track> = None;
    for (place, track) in building.tracks.iter().enumerate() {
        let owner = floor_of(index, building, place);
        let direction = track.direction;
        let column = |kind| Column::new(owner, kind, direction);
        all.push(moved(column(Kind::Displacement), track.dof));
        if track.is_in_line {
            let lowest = building.dof_below_lowest(direction);
            let below = below.filter(|_| !track.is_lowest).map(|below| below.dof);
            let drift = Drift {
                above: track.dof,
                below: below.or(lowest.filter(|_| track.is_lowest)),
                height: track.storey_height,
                turned,
            };
            let statistic = Statistic::Drift(drift);
            all.push(Watch::new(column(Kind::Drift), statistic));
        }
        below = Some(track);
    }
    for corner in &building.corners {
        let owner = floor_of(index, building, corner.floor);
        let column = Column::along(owner, Kind::CornerDisplacement);
        all.push(length(column, &corner.rows, building));
    }
}

/// Bearings of an isolated building, or the spring of a wall.
fn of_support(index: usize, building: &BuildingSystem, all: &mut Vec<Watch>) {
    let Some(support) = building.support else {
        return;
    };
    let mat = Column::displacement(index, 0);
    all.push(moved(mat, support.dof));
    let work = Column::along(Owner::Support(index), Kind::Work);
    let dashpot = |damping, row| {
        let rows = [row, Row::default()];
        Watch::new(work, Statistic::Dashpots([damping, 0.0, 0.0], rows))
    };
    let Some(building_mat) = &building.mat_in_plan else {
        all.push(dashpot(support.damping, Row::single(support.dof)));
        return;
    };
    all.push(moved(mat.across(), building_mat.dofs[1]));
    all.push(moved(mat.turning(), building_mat.dofs[2]));
    for (bearing, rows) in building_mat.rows.iter().enumerate() {
        let owner = Owner::Bearing {
            building: index,
            bearing,
        };
        all.push(length(Column::along(owner, Kind::Stroke), rows, building));
    }
    for row in building_mat.rows.iter().flatten() {
        all.push(dashpot(building_mat.damping, row.moved_up(building.offset)));
    }
    let corner = Column::along(mat.owner, Kind::CornerDisplacement);
    let corners = building_mat.corners.iter();
    all.extend(corners.map(|rows| length(corner, rows, building)));
}

/// A rigid foundation on soil.
fn of_foundation(index: usize, building: &BuildingSystem, all: &mut Vec<Watch>) {
    let Some(foundation) = building.foundation else {
        return;
    };
    let of = |kind| Column::along(Owner::Foundation(index), kind);
    let displacement = of(Kind::Displacement);
    all.extend(foundation.sway.map(|dof| moved(displacement, dof)));
    all.push(moved(displacement.turning(), foundation.turning));
    let sway = foundation.sway.map(Row::single).unwrap_or_default();
    let dashpots = Statistic::Dashpots(
        foundation.own_damping,
        [sway, Row::single(foundation.turning)],
    );
    all.push(Watch::new(of(Kind::Work), dashpots));
    let Some(rise) = foundation.rise else { return };
    all.push(moved(displacement.up(), rise));
    let middle = [(rise, 1.0), (foundation.turning, foundation.middle)];
    let damping = [foundation.springs.vertical_damping, 0.0, 0.0];
    let rows = [middle.into_iter().collect(), Row::default()];
    let dashpots = Statistic::Dashpots(damping, rows);
    all.push(Watch::new(of(Kind::Work), dashpots));
}

/// A rigid foundation on soil in plan, whose dashpots do not act on each other.
fn of_foundation_in_plan(index: usize, building: &BuildingSystem, all: &mut Vec<Watch>) {
    let motions = building.foundation_in_plan.zip(building.base_motions());
    let Some((foundation, motions)) = motions else {
        return;
    };
    let motions = motions.map(|row| row.moved_up(building.offset));
    let of = |kind| Column::along(Owner::Foundation(index), kind);
    let (moved, rocked) = (of(Kind::Displacement), of(Kind::Rocking));
    let columns = [
        moved,
        moved.across(),
        moved.turning(),
        rocked,
        rocked.across(),
    ];
    let watches = columns.into_iter().zip(&motions);
    all.extend(watches.map(|(column, row)| Watch::new(column, Statistic::Extremes(row.clone()))));
    let [sway, sway_across, turned, rocked, rocked_across] = motions;
    if let Some(rise) = building.base_rise() {
        let rise = rise.moved_up(building.offset);
        all.push(Watch::new(moved.up(), Statistic::Extremes(rise.clone())));
        let damping = [foundation.springs.along.vertical_damping, 0.0, 0.0];
        let dashpots = Statistic::Dashpots(damping, [rise, Row::default()]);
        all.push(Watch::new(of(Kind::Work), dashpots));
    }
    let PlanFoundationSprings {
        along,
        across,
        torsion,
    } = foundation.springs;
    for (damping, rows) in [
        (
            [along.sway_damping, 0.0, along.rocking_damping],
            [sway, rocked],
        ),
        (
            [across.sway_damping, 0.0, across.rocking_damping],
            [sway_across, rocked_across],
        ),
        ([torsion[1], 0.0, 0.0], [turned, Row::default()]),
    ] {
        all.push(Watch::new(
            of(Kind::Work),
            Statistic::Dashpots(damping, rows),
        ));
    }
}

/// Ground under foundations and feet of columns that can lift off.
fn of_footings(building: &BuildingSystem, all: &mut Vec<Watch>) {
    let springs = building.equations.springs.iter().enumerate();
    let ground =
        springs.filter(|(_, candidate)| candidate.hysteresis.rule() == HysteresisRule::Ground);
    all.extend(ground.map(|(index, _)| {
        let spring = building.spring_offset + index;
        let column = Column::along(Owner::Spring(spring), Kind::Lifted);
        Watch::new(column, Statistic::Lifted(spring))
    }));
}

/// Hinges whose rotations have limits.
fn of_limited_ends(building: &BuildingSystem, all: &mut Vec<Watch>) {
    for limited_end in &building.limited_ends {
        let law = &building.equations.springs[limited_end.spring].hysteresis;
        let spring = building.spring_offset + limited_end.spring;
        let of = |kind| Column::along(Owner::Spring(spring), kind);
        if let Some(rotation) = &limited_end.on_surface {
            let turned = |limit| {
                let rotation = rotation.moved_up(building.spring_offset);
                Statistic::Turned(rotation, limit)
            };
            all.push(Watch::new(of(Kind::Turned), turned(None)));
            let levels = limited_end.limits.iter();
            all.extend(
                levels.map(|(level, limit)| {
                    Watch::new(of(Kind::Beyond(*level)), turned(Some(*limit)))
                }),
            );
            continue;
        }
        for (level, limit) in &limited_end.limits {
            let column = of(Kind::Beyond(*level));
            all.extend(Side::BOTH.map(|side| {
                let limit = DeformationLimit {
                    springs: vec![spring],
                    side,
                    deformation: limited_end.deformation_at(law, side, *limit),
                };
                Watch::new(column, Statistic::Passed(limit))
            }));
        }
    }
}

/// Bays of infill panels whose damage is judged: how much their diagonals change their length.
fn of_panels(building: &BuildingSystem, all: &mut Vec<Watch>) {
    let discretization = &building.discretization;
    for diagonal in discretization
        .diagonals
        .iter()
        .filter(|diagonal| diagonal.damage.is_some())
    {
        let Some(spring) = discretization.spring_of_diagonal(diagonal) else {
            continue;
        };
        let row = discretization
            .stick_model
            .carried_row(&diagonal.between_joints);
        let row = building.equations.row(&row).moved_up(building.offset);
        let owner = Owner::Spring(building.spring_offset + spring);
        let column = Column::along(owner, Kind::Stroke);
        all.push(Watch::new(column, Statistic::Extremes(row)));
    }
}

/// Ends of columns that are made of fibres.
fn of_sections(index: usize, building: &BuildingSystem, all: &mut Vec<Watch>) {
    let Discretization {
        stick_model,
        sections,
        ..
    } = &building.discretization;
    for (section, fibre_section) in sections.iter().enumerate() {
        let owner = Owner::Section {
            building: index,
            section,
        };
        let moved = Column::along(owner, Kind::Displacement);
        let turned = [moved.turning(), moved.across()];
        let turned = turned.into_iter().zip(&fibre_section.rotations);
        for (column, row) in [(moved.up(), &fibre_section.elongation)]
            .into_iter()
            .chain(turned)
        {
            let row = building.equations.row(&stick_model.carried_row(row));
            let row = row.moved_up(building.offset);
            all.push(Watch::new(column, Statistic::Extremes(row)));
        }
        let springs = building.discretization.springs_of_section(fibre_section);
        for (limit, strain) in &fibre_section.limits {
            let fibres = springs.clone().zip(fibre_section.fibres.iter());
            let judged = fibres.filter(|(_, fibre)| fibre.material == limit.material());
            let limit_of_springs = DeformationLimit {
                springs: judged
                    .map(|(spring, _)| building.spring_offset + spring)
                    .collect(),
                side: limit.side(),
                deformation: strain * fibre_section.length,
            };
            let column = Column::along(owner, Kind::Passed(*limit));
            all.push(Watch::new(column, Statistic::Passed(limit_of_springs)));
        }
    }
}

/// The greatest and the least value of a displacement.
fn moved(column: Column, dof: usize) -> Watch {
    Watch::new(column, Statistic::Extremes(Row::single(dof)))
}

/// The distance that a point has moved; `rows` are over the displacements of its building.
fn length(column: Column, rows: &[Row; 2], building: &BuildingSystem) -> Watch {
    let rows = rows.each_ref().map(|row| row.moved_up(building.offset));
    Watch::new(column, Statistic::Length(rows))
}
