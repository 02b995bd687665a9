//! Difference of the reported peaks of two runs of one system.

use std::collections::BTreeMap;

use super::outcome::Outcome;
use super::sensitivity::closing_scale;
use crate::history::{Column, Impact, Kind, Owner, Peak};
use crate::model::DiagonalKind;
use crate::structure::{CouplingForce, MemberSection, SpringPlace, WallForce};
use crate::system::{BuildingSystem, Direction, System};

/// Weight of differences between parts of runs, which are usually larger than those of the peaks.
const IN_PARTS: f64 = 0.25;

/// Least scale of rotations, in those of displacements over the radius of gyration \[–\].
pub(super) const LEAST_ROTATION: f64 = 1e-3;

/// Part of the greatest motions and forces of all floors below which a number is rounding: what symmetry keeps at rest, or a damper
/// between floors that move alike, has no other \[–\].
const ROUNDING: f64 = 1e-9;

/// Axial force, shear, moment.
const MEMBER_FORCES: usize = 3;

/// Greatest motions and forces of all floors of a run. A metre turns lengths into rotations and forces into moments.
#[derive(Clone, Copy, Default)]
struct Greatest {
    displacement: f64,
    velocity: f64,
    acceleration: f64,
    force: f64,
}

/// What numbers are compared with.
type Scale = fn(&Greatest) -> f64;

impl Greatest {
    fn of(outcome: &Outcome) -> Self {
        let mut all = Self::default();
        for (column, peak) in outcome.peaks.iter() {
            let is_lateral = matches!(column.direction, Direction::Along | Direction::Across);
            if matches!(column.owner, Owner::Floor { .. })
                && is_lateral
                && let Some(greatest) = all.of_kind(column.kind)
            {
                *greatest = greatest.max(peak.size());
            }
        }
        all
    }

    /// What numbers of a kind are compared with; `None` for times and energies.
    fn of_kind(&mut self, kind: Kind) -> Option<&mut f64> {
        match kind {
            Kind::Displacement
            | Kind::CornerDisplacement
            | Kind::Drift
            | Kind::CornerDrift
            | Kind::Rocking
            | Kind::Closing
            | Kind::Stroke => Some(&mut self.displacement),
            Kind::Velocity | Kind::Speed => Some(&mut self.velocity),
            Kind::Acceleration | Kind::FilteredAcceleration => Some(&mut self.acceleration),
            Kind::Shear | Kind::Moment | Kind::Force | Kind::RingForce => Some(&mut self.force),
            Kind::Time
            | Kind::Work
            | Kind::Lifted
            | Kind::Passed(_)
            | Kind::Beyond(_)
            | Kind::Turned
            | Kind::Energy(_) => None,
        }
    }
}

/// Greatest difference of peaks, relative to the greatest of its kind in the building or gap \[–\].
pub(super) fn change_of_peaks(system: &System, [a, b]: [&Outcome; 2]) -> f64 {
    let alike = alike(system, [a, b]);
    let mut greatest = Greatest::of(b);
    let mut worst = 0.0_f64;
    for (pool, change) in &alike {
        let rounding = greatest.of_kind(pool.column.kind);
        let rounding = rounding.map_or(0.0, |greatest| ROUNDING * *greatest);
        let least = least_scale(system, *pool, &alike, b).max(rounding);
        worst = worst.max(change.relative_to(least));
    }
    let rounding = ROUNDING * greatest.force;
    let mut floors_before = 0;
    for (index, building) in system.buildings.iter().enumerate() {
        let tracks = building.tracks.iter();
        let lateral = tracks.filter(|track| track.direction != Direction::Turning);
        let count = lateral.count();
        let accelerations = Pool::greatest(floors_of(index, Kind::Acceleration));
        let greatest = alike
            .get(&accelerations)
            .map_or(0.0, |change| change.greatest);
        if greatest > 0.0 {
            let parts = [&a.acceleration_parts, &b.acceleration_parts];
            let change = parts[0].change(parts[1], floors_before, count);
            worst = worst.max(IN_PARTS * change / greatest);
        }
        floors_before += building.tracks.len();
        for force in 0..3 {
            let sections = building.members.sections.iter();
            let forms = sections.filter_map(|section| section.get(force).copied());
            worst = worst.max(change_of_forms(index, forms, [a, b]).relative_to(rounding));
        }
        for kind in 0..MEMBER_FORCES {
            let members = building.members.members.iter();
            let forms = members.flat_map(|m| m.sections.iter().flat_map(MemberSection::by_kind));
            let forms = forms
                .filter(|(candidate, _)| *candidate == kind)
                .map(|(_, form)| form);
            worst = worst.max(change_of_forms(index, forms, [a, b]).relative_to(rounding));
        }
    }
    let gaps = system.contacts.last().map_or(0, |contact| contact.gap + 1);
    for gap in 0..gaps {
        let contacts = 0..system.contacts.len();
        let contacts = contacts.filter(|contact| system.contacts[*contact].gap == gap);
        let gap_contacts: Vec<usize> = contacts.collect();
        for of in [peak_force, impulse] {
            let pairs = gap_contacts
                .iter()
                .map(|contact| [of(a, *contact), of(b, *contact)]);
            worst = worst.max(Change::of(pairs).relative_to(rounding));
        }
    }
    worst
}

/// The same of braces, struts, walls and coupling beams.
pub(super) fn change_of_parts(system: &System, runs: [&Outcome; 2]) -> f64 {
    let greatest = Greatest::of(runs[1]);
    let mut worst = 0.0_f64;
    for (index, building) in system.buildings.iter().enumerate() {
        for (forms, unit) in forms_of_parts(building) {
            let change = change_of_forms(index, forms.into_iter(), runs);
            worst = worst.max(change.relative_to(ROUNDING * unit(&greatest)));
        }
    }
    worst
}

/// Forces and deformations of braces, of struts, of walls and of coupling beams, each kind with those that are measured alike and
/// with what it is compared with.
fn forms_of_parts(building: &BuildingSystem) -> [(Vec<usize>, Scale); 7] {
    let members = &building.members;
    let diagonals = &building.discretization.diagonals;
    let of_diagonals = |kind| {
        let all = members.diagonals.iter();
        let diagonals = all.filter(|force| diagonals[force.diagonal].place.kind == kind);
        diagonals.map(|force| force.form).collect()
    };
    let of_walls = |form: fn(&WallForce) -> usize| members.walls.iter().map(form).collect();
    let of_beams =
        |form: fn(&CouplingForce) -> usize| members.coupling_beams.iter().map(form).collect();
    let (force, length): (Scale, Scale) = (|all| all.force, |all| all.displacement);
    [
        (of_diagonals(DiagonalKind::Brace), force),
        (of_diagonals(DiagonalKind::Infill), force),
        (of_walls(|wall| wall.axial), force),
        (of_walls(|wall| wall.moment), force),
        (of_walls(|wall| wall.elongation), length),
        (of_beams(|beam| beam.shear), force),
        (of_beams(|beam| beam.chord), length),
    ]
}

/// Change of forces of a building that are measured by the greatest of them.
fn change_of_forms(
    building: usize,
    forms: impl Iterator<Item = usize>,
    [a, b]: [&Outcome; 2],
) -> Change {
    Change::of(forms.flat_map(|form| {
        let [a, b] = [a, b].map(|run| run.members[building][form]);
        [0, 1].map(|side| [a[side], b[side]])
    }))
}

/// Peaks that are measured by the greatest of them: those of the floors of a building, of the links of a model.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Pool {
    /// For all of them. Along the row stands for across as well.
    column: Column,
    /// Whether these are the least values.
    least: bool,
}

impl Pool {
    fn greatest(column: Column) -> Self {
        let least = false;
        Self { column, least }
    }
}

/// Greatest magnitude of peaks of two runs, and their greatest difference.
#[derive(Clone, Copy, Default)]
struct Change {
    greatest: f64,
    change: f64,
}

impl Change {
    fn of(pairs: impl Iterator<Item = [f64; 2]>) -> Self {
        pairs.fold(Self::default(), Self::and)
    }

    fn and(self, [a, b]: [f64; 2]) -> Self {
        Self {
            greatest: self.greatest.max(a.abs()).max(b.abs()),
            change: self.change.max((a - b).abs()),
        }
    }

    /// The difference over the magnitude, which counts as at least `least`.
    fn relative_to(self, least: f64) -> f64 {
        let scale = self.greatest.max(least);
        if scale > 0.0 {
            self.change / scale
        } else {
            0.0
        }
    }
}

/// Changes of all peaks that are compared, each with those that are measured alike.
fn alike(system: &System, [a, b]: [&Outcome; 2]) -> BTreeMap<Pool, Change> {
    let mut all: BTreeMap<Pool, Change> = BTreeMap::new();
    let linear = system.links.iter().all(|link| link.is_linear());
    for (column, one) in a.peaks.iter() {
        let other = b.peaks.of(column);
        let Some(of_all) = measured_with(system, column, linear) else {
            continue;
        };
        let mut add = |pool, of: fn(&Peak) -> f64| {
            let change = all.entry(pool).or_default();
            *change = change.and([of(&one), of(&other)]);
        };
        let pool = Pool::greatest(of_all);
        match (column.kind, column.owner) {
            (Kind::Displacement, Owner::Foundation(_) | Owner::Section { .. }) => {
                add(pool, |peak| peak.greatest.value);
                add(pool, |peak| peak.least.value);
            }
            (Kind::Displacement, _) => {
                add(pool, |peak| peak.greatest.value);
                let pool = Pool {
                    least: true,
                    ..pool
                };
                add(pool, |peak| peak.least.value);
            }
            _ => add(pool, Peak::size),
        }
    }
    all
}

/// The column that stands for all peaks with which one is measured; `None` if it is not compared. Energies are not, nor are rotations
/// and corners of mats, strokes of single bearings and forces in plan.
fn measured_with(system: &System, column: Column, linear: bool) -> Option<Column> {
    let Column {
        owner,
        kind,
        direction,
    } = column;
    let along = direction == Direction::Along;
    match owner {
        Owner::Floor { building, floor } => match (kind, direction) {
            (Kind::FilteredAcceleration, _) => None,
            (_, Direction::Along | Direction::Across)
                if floor > 0 || kind != Kind::CornerDisplacement =>
            {
                Some(floors_of(building, kind))
            }
            (_, Direction::Turning) if floor > 0 => Some(floors_of(building, kind).turning()),
            (_, Direction::Up) => Some(floors_of(building, kind).up()),
            _ => None,
        },
        Owner::Link(link) if !linear && kind != Kind::Work => {
            Some(Column::along(Owner::Link(system.links[link].link), kind))
        }
        Owner::Foundation(_) | Owner::Contact(_) | Owner::Gap(_) if kind != Kind::Work => {
            Some(column)
        }
        Owner::Section { building, .. } => {
            let section = 0;
            Some(Column::new(
                Owner::Section { building, section },
                kind,
                direction,
            ))
        }
        Owner::Spring(spring) if kind == Kind::Force => {
            let footing = footing_of(system, spring)?;
            Some(Column::along(Owner::Spring(footing), kind))
        }
        Owner::Building(_) if along => Some(column),
        Owner::Support(_) if along && kind == Kind::Force => Some(column),
        _ => None,
    }
}

/// The first spring of the ground under the foundation, or the column, to which a spring belongs; `None` for other springs.
fn footing_of(system: &System, spring: usize) -> Option<usize> {
    let mut buildings = system.buildings.iter();
    let building = buildings.find(|building| building.spring_range().contains(&spring))?;
    let places = &building.discretization.spring_places;
    let line = |place: &SpringPlace| match *place {
        SpringPlace::Footing { line, .. } => Some(line),
        _ => None,
    };
    let footing_line = line(places.get(spring - building.spring_offset)?)?;
    let first = places
        .iter()
        .position(|place| line(place) == Some(footing_line))?;
    Some(building.spring_offset + first)
}

/// The column that stands for all floors of a building along and across.
fn floors_of(building: usize, kind: Kind) -> Column {
    Column::along(Owner::Floor { building, floor: 0 }, kind)
}

/// What differences of peaks are at least relative to: for rotations, lengths over the radius of gyration and forces times it; for
/// closings, what their floors move.
fn least_scale(
    system: &System,
    pool: Pool,
    alike: &BTreeMap<Pool, Change>,
    outcome: &Outcome,
) -> f64 {
    let column = pool.column;
    match (column.owner, column.direction) {
        (Owner::Floor { building, .. }, Direction::Turning) => {
            let radius = system.buildings[building].radius_of_gyration();
            let unit = match column.kind {
                Kind::Shear | Kind::Moment => radius,
                _ => 1.0 / radius,
            };
            let lateral = Pool {
                column: floors_of(building, column.kind),
                ..pool
            };
            let lateral = alike.get(&lateral).map_or(0.0, |change| change.greatest);
            LEAST_ROTATION * unit * lateral
        }
        (Owner::Contact(contact), _) => {
            closing_scale(&system.contacts[contact], 0.0, |building, floor| {
                outcome.peaks.sway(building, floor)
            })
        }
        _ => 0.0,
    }
}

pub(super) fn impacts(outcome: &Outcome, contact: usize) -> impl Iterator<Item = &Impact> {
    let at_contact = move |impact: &&Impact| impact.contact == contact;
    outcome.impacts.iter().filter(at_contact)
}

fn peak_force(outcome: &Outcome, contact: usize) -> f64 {
    impacts(outcome, contact).fold(0.0, |most, impact| most.max(impact.peak_force))
}

fn impulse(outcome: &Outcome, contact: usize) -> f64 {
    impacts(outcome, contact).fold(0.0, |sum, impact| sum + impact.impulse)
}
