//! Contacts of buildings in space as sums over displacements of rigid floors: closings of all points at once, and the few
//! closings on which all points of a face depend.

use std::collections::BTreeMap;
use std::ops::Range;

use pulp::{Arch, NullaryFnOnce};

use super::links::own_dashpots;
use super::mode_kernels::LANES;
use super::reduced::Reduced;
use crate::interface::PortPair;
use crate::linear::{Row, sort_by_key};
use crate::system::{Direction, System};

/// Displacements of a floor that move a point of it, on either side of a contact.
const TERMS: usize = 6;
/// Difference of coefficients that is rounding, relative to the greatest.
const ROUNDING: f64 = 1e-12;

/// A closing as a weighted sum of six monitored displacements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlanRow {
    /// Of both sides along x, across, and turning.
    pub(super) places: [usize; TERMS],
    pub(super) weights: [f64; TERMS],
}

/// Many rows in an order in which they are quickly computed.
#[derive(Clone, Debug, Default)]
pub(super) struct RowTable {
    /// Index of the row at every place of the order.
    pub(super) order: Vec<usize>,
    strips: Vec<RowStrip>,
}

/// Rows of several points of every floor of two buildings, such as those of a face, floor after floor: point by point from
/// `first` on. All points of a floor move alike but for its rotation.
#[derive(Clone, Debug, PartialEq)]
struct RowStrip {
    first: usize,
    floors: usize,
    points: usize,
    /// Places of the displacements of the first floor; they grow by one from floor to floor.
    from: [usize; TERMS],
    /// Weights of displacements along x and across on both sides, floor by floor; those of rotations, point by point.
    moved: [Vec<f64>; 4],
    turned: [Vec<f64>; 2],
}

/// Modal loads of a unit force that pushes two faces apart, on the building of one side.
#[derive(Clone, Debug)]
pub(super) struct SideLoads {
    pub(super) building: usize,
    pub(super) modes: Range<usize>,
    /// Padded with zeros to whole lanes \[kg^−½\].
    pub(super) loads: Vec<f64>,
}

/// Closings of all contacts, and slips along them, of buildings in space.
#[derive(Clone, Debug)]
pub(super) struct PlanRows {
    /// Where lists of monitored quantities hold the first closing, and where the last one ends.
    pub(super) first: usize,
    pub(super) end: usize,
    /// Place of every port among the closings, then of every end of an edge.
    places: Vec<usize>,
    rows: RowTable,
    /// The closing of every port over those of the ends of its face, by their ports.
    pub(super) shares: Vec<Row>,
    /// Of ports at ends of faces; empty for others.
    pub(super) sides: Vec<Vec<SideLoads>>,
    /// The loads of both sides one after the other.
    pub(super) joined: Vec<Vec<f64>>,
}

impl PlanRow {
    /// `None` if a point moves with anything but the displacements of a floor.
    fn new(
        system: &System,
        ports: &PortPair,
        first_places: impl Fn(usize) -> usize,
    ) -> Option<Self> {
        let mut row = Self {
            places: [0; TERMS],
            weights: [0.0; TERMS],
        };
        let mut known = [false; TERMS];
        for ((side, port), sign) in ports.0.iter().enumerate().zip([1.0, -1.0]) {
            let Some(port) = port else { continue };
            let building = &system.buildings[port.building];
            for &(dof, weight) in port.row.entries() {
                let mut tracks = building.tracks.iter();
                let track = tracks.position(|track| track.dof == dof)?;
                let slot = 3 * side + slot_of(building.tracks[track].direction);
                if known[slot] {
                    return None;
                }
                known[slot] = true;
                row.places[slot] = first_places(port.building) + track;
                row.weights[slot] = sign * weight;
            }
        }
        // A wall does not move, nor does a plane point across its plane.
        let any = known.iter().position(|known| *known)?;
        for slot in 0..TERMS {
            if !known[slot] {
                row.places[slot] = row.places[any];
            }
        }
        Some(row)
    }

    /// Shares of two rows of which this one is a sum; `None` if it is none.
    fn between(&self, first: &Self, last: &Self) -> Option<[f64; 2]> {
        if self.places != first.places || self.places != last.places {
            return None;
        }
        let greatest = |row: &Self| row.weights.iter().fold(0.0, |m: f64, w| m.max(w.abs()));
        let most = greatest(first).max(greatest(last));
        let apart = |slot: &usize| (last.weights[*slot] - first.weights[*slot]).abs();
        let slot = (0..TERMS).max_by(|a, b| apart(a).total_cmp(&apart(b)))?;
        let share = if apart(&slot) <= ROUNDING * most {
            0.0
        } else {
            let way = last.weights[slot] - first.weights[slot];
            (self.weights[slot] - first.weights[slot]) / way
        };
        let shares = [1.0 - share, share];
        let close = (0..TERMS).all(|slot| {
            let sum = shares[0] * first.weights[slot] + shares[1] * last.weights[slot];
            (sum - self.weights[slot]).abs() <= ROUNDING * most
        });
        close.then_some(shares)
    }

    /// Modal loads of a unit force that closes nothing but this row.
    fn sides(&self, reduced: &Reduced) -> Vec<SideLoads> {
        let mut sides: Vec<SideLoads> = Vec::new();
        for (building, reduced_building) in reduced.buildings.iter().enumerate() {
            let terms = self.places.iter().zip(&self.weights);
            let own_terms: Vec<(usize, f64)> = terms
                .filter(|(place, weight)| {
                    reduced_building.watched.contains(place) && **weight != 0.0
                })
                .map(|(place, weight)| (*place, *weight))
                .collect();
            if own_terms.is_empty() {
                continue;
            }
            let load = |mode: usize| {
                let shapes = own_terms.iter();
                let sum = shapes.map(|(place, weight)| {
                    weight
                        * reduced_building.of_blocks(
                            &reduced_building.blocks,
                            place - reduced_building.watched.start,
                            mode,
                        )
                });
                -sum.sum::<f64>()
            };
            sides.push(SideLoads {
                building,
                modes: reduced_building.modes.clone(),
                loads: {
                    let mut loads: Vec<f64> = (0..reduced_building.modes.len()).map(load).collect();
                    loads.resize(loads.len().next_multiple_of(LANES), 0.0);
                    loads
                },
            });
        }
        sides
    }
}

pub(super) fn slot_of(direction: Direction) -> usize {
    match direction {
        Direction::Along => 0,
        // In one plane, upwards takes the place of across.
        Direction::Across | Direction::Up => 1,
        Direction::Turning => 2,
    }
}

/// Whether closings of all contacts of a system are sums over displacements of its floors.
pub(super) fn are_rows_of_floors(system: &System) -> bool {
    system.is_in_space()
        && system.links.is_empty()
        && system
            .buildings
            .iter()
            .all(|building| own_dashpots(building).is_empty())
        && all_ports(system).all(|ports| PlanRow::new(system, ports, |_| 0).is_some())
}

fn all_ports(system: &System) -> impl Iterator<Item = &PortPair> {
    let ends = system.edge_ends.iter().map(|end| &end.ports);
    system.contact_ports().chain(ends)
}

impl PlanRows {
    /// `None` unless [`are_rows_of_floors`].
    pub(super) fn new(system: &System, reduced: &Reduced) -> Option<Self> {
        if !are_rows_of_floors(system) {
            return None;
        }
        let first_place = |building: usize| reduced.buildings[building].watched.start;
        let rows: Option<Vec<PlanRow>> = all_ports(system)
            .map(|ports| PlanRow::new(system, ports, first_place))
            .collect();
        let rows = rows?;
        let ports = reduced.contact_of.len();
        let shares = face_shares(system, reduced, &rows[..ports]);
        let mut sides = vec![Vec::new(); ports];
        for share in &shares {
            for end in share.dofs() {
                if sides[end].is_empty() {
                    sides[end] = rows[end].sides(reduced);
                }
            }
        }
        let joined = sides.iter().map(|sides| {
            let loads = sides.iter().map(|side| &side.loads[..]);
            loads.collect::<Vec<&[f64]>>().concat()
        });
        let joined = joined.collect();
        let rows = RowTable::new(&rows);
        let mut places = vec![0; rows.order.len()];
        for (place, &row) in rows.order.iter().enumerate() {
            places[row] = place;
        }
        let first = reduced.watched();
        Some(Self {
            first,
            end: first + places.len(),
            places,
            rows,
            shares,
            joined,
            sides,
        })
    }

    /// The buildings on both sides of a port, with shares of the loads of ends of its face.
    pub(super) fn sides_of(&self, port: usize) -> impl Iterator<Item = (f64, &SideLoads)> {
        let ends = self.shares[port].entries().iter();
        ends.flat_map(|(end, share)| self.sides[*end].iter().map(move |side| (*share, side)))
    }

    /// Place of the closing of a port among all.
    #[inline]
    pub(super) fn place(&self, port: usize) -> usize {
        self.places[port]
    }

    /// Closing of a port in a list that [`PlanRows::fill`] has completed.
    #[inline]
    pub(super) fn closing(&self, port: usize, values: &[f64]) -> f64 {
        values[self.first + self.places[port]]
    }

    /// By how much a corner has moved along an edge from its end, in such a list.
    #[inline]
    pub(super) fn end_of_edge(&self, end: usize, values: &[f64]) -> f64 {
        self.closing(self.shares.len() + end, values)
    }

    /// Adds to the closing of a port, or of an end of an edge behind all ports, in such a list.
    #[inline]
    pub(super) fn add(&self, row: usize, value: f64, values: &mut [f64]) {
        values[self.first + self.places[row]] += value;
    }

    /// Computes all closings from the displacements of floors at the start of a list.
    pub(super) fn fill(&self, arch: Arch, values: &mut [f64]) {
        let (moved, closings) = values.split_at_mut(self.first);
        self.rows
            .fill(arch, moved, &mut closings[..self.places.len()]);
    }
}

impl RowTable {
    pub(super) fn new(rows: &[PlanRow]) -> Self {
        let mut table = Self::default();
        let mut groups = floor_groups(rows).into_iter().peekable();
        while let Some(first) = groups.next() {
            let mut floors = vec![first.rows];
            while let Some(next) = groups.peek() {
                let mut places = first.places.iter().zip(&next.places);
                let alike = next.rows.len() == floors[0].len();
                if !alike || !places.all(|(from, next)| from + floors.len() == *next) {
                    break;
                }
                floors.extend(groups.next().map(|group| group.rows));
            }
            table.add_strip(rows, first.places, &floors);
        }
        table
    }

    /// Adds rows of points of consecutive floors.
    fn add_strip(&mut self, rows: &[PlanRow], from: [usize; TERMS], floors: &[Vec<usize>]) {
        let points = floors[0].len();
        let weight = |row: usize, term: usize| rows[row].weights[term];
        let by_point =
            || (0..points).flat_map(|point| floors.iter().map(move |floor| floor[point]));
        self.strips.push(RowStrip {
            first: self.order.len(),
            floors: floors.len(),
            points,
            from,
            moved: [0, 1, 3, 4]
                .map(|term| floors.iter().map(|floor| weight(floor[0], term)).collect()),
            turned: [2, 5].map(|term| by_point().map(|row| weight(row, term)).collect()),
        });
        self.order.extend(by_point());
    }

    /// Values of all rows, in their order, from monitored displacements.
    pub(super) fn fill(&self, arch: Arch, moved: &[f64], values: &mut [f64]) {
        arch.dispatch(FillRows {
            rows: self,
            moved,
            values,
        });
    }
}

/// Rows of points of one floor of both sides that move alike but for rotations.
struct FloorGroup {
    places: [usize; TERMS],
    rows: Vec<usize>,
}

/// All groups, so that those of consecutive floors follow each other.
fn floor_groups(rows: &[PlanRow]) -> Vec<FloorGroup> {
    let mut of_floors = BTreeMap::<[usize; TERMS], Vec<FloorGroup>>::new();
    for (index, row) in rows.iter().enumerate() {
        let groups = of_floors.entry(row.places).or_default();
        let alike = |group: &&mut FloorGroup| {
            let first = &rows[group.rows[0]].weights;
            [0, 1, 3, 4]
                .iter()
                .all(|&term| first[term] == row.weights[term])
        };
        match groups.iter_mut().find(alike) {
            Some(group) => group.rows.push(index),
            None => groups.push(FloorGroup {
                places: row.places,
                rows: vec![index],
            }),
        }
    }
    let numbered = of_floors
        .into_values()
        .flat_map(|groups| groups.into_iter().enumerate());
    let mut all: Vec<(usize, FloorGroup)> = numbered.collect();
    sort_by_key(&mut all, |(number, group)| {
        let apart = group
            .places
            .map(|place| place.wrapping_sub(group.places[0]));
        (apart, *number, group.rows.len(), group.places[0])
    });
    all.into_iter().map(|(_, group)| group).collect()
}

/// Of every port, its shares in the ends of its face.
fn face_shares(system: &System, reduced: &Reduced, rows: &[PlanRow]) -> Vec<Row> {
    let contacts = system.contacts.len();
    let face_of = |port: usize| {
        let contact = reduced.contact_of[port];
        let face = system.contacts[contact].plan.map(|place| place.face);
        face.map(|face| (port < contacts, face))
    };
    let mut shares = Vec::with_capacity(rows.len());
    while shares.len() < rows.len() {
        let first = shares.len();
        let face = face_of(first);
        let mut last = first;
        while face.is_some() && last + 1 < rows.len() && face_of(last + 1) == face {
            last += 1;
        }
        let of_point = |port: usize| {
            let [near, far] = rows[port].between(&rows[first], &rows[last])?;
            // One end is enough where both move alike, and at the ends themselves.
            let alike = rows[first].between(&rows[last], &rows[last]).is_some();
            Some(match [near, far] {
                [1.0, 0.0] => Row::single(first),
                [0.0, 1.0] => Row::single(last),
                _ if alike => Row::single(first),
                [near, far] => Row::new(&[(first, near), (last, far)]),
            })
        };
        for port in first..=last {
            shares.push(of_point(port).unwrap_or_else(|| Row::single(port)));
        }
    }
    shares
}

/// Values of all rows, strip by strip.
struct FillRows<'a> {
    rows: &'a RowTable,
    moved: &'a [f64],
    values: &'a mut [f64],
}

impl NullaryFnOnce for FillRows<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for strip in &self.rows.strips {
            let n = strip.floors;
            let values = &mut self.values[strip.first..][..n * strip.points];
            if n < LANES {
                for floor in 0..n {
                    strip.fill::<1>(floor, self.moved, values);
                }
                continue;
            }
            // The last floors overlap with those before.
            let mut floor = 0;
            while floor + LANES < n {
                strip.fill::<LANES>(floor, self.moved, values);
                floor += LANES;
            }
            strip.fill::<LANES>(n - LANES, self.moved, values);
        }
    }
}

impl RowStrip {
    /// Values of all points of some floors.
    #[inline(always)]
    fn fill<const N: usize>(&self, floor: usize, moved: &[f64], values: &mut [f64]) {
        let of = |list: &[f64], from: usize| -> [f64; N] {
            let mut lanes = [0.0; N];
            lanes.copy_from_slice(&list[from..from + N]);
            lanes
        };
        let mut common = [0.0; N];
        for (weights, term) in self.moved.iter().zip([0, 1, 3, 4]) {
            let (weight, value) = (of(weights, floor), of(moved, self.from[term] + floor));
            for lane in 0..N {
                common[lane] += weight[lane] * value[lane];
            }
        }
        let turned = [2, 5].map(|term| of(moved, self.from[term] + floor));
        for point in 0..self.points {
            let at = point * self.floors + floor;
            let (near, far) = (of(&self.turned[0], at), of(&self.turned[1], at));
            let out = &mut values[at..at + N];
            for lane in 0..N {
                out[lane] =
                    common[lane] + (near[lane] * turned[0][lane] + far[lane] * turned[1][lane]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of faces of two buildings with `floors` floors, five points each, then of three corners of the lower floors.
    fn rows(floors: usize) -> Vec<PlanRow> {
        let value = |seed: usize| (1.7 * seed as f64).sin();
        let place = |floor: usize| {
            let places = [0, 1, 2].map(|block| block * floors + floor);
            let next = places.map(|place| place + 3 * floors);
            [places[0], places[1], places[2], next[0], next[1], next[2]]
        };
        let row = |floor: usize, point: usize, number: usize| {
            let mut weights = std::array::from_fn(|term| value(7 * floor + term + 50 * number));
            weights[2] = value(floor + 10 * point);
            weights[5] = value(3 * floor + 20 * point);
            PlanRow {
                places: place(floor),
                weights,
            }
        };
        let faces = (0..floors).flat_map(|floor| (0..5).map(move |point| row(floor, point, 0)));
        let corners =
            (0..floors / 2).flat_map(|floor| (0..3).map(move |point| row(floor, point, 1)));
        faces.chain(corners).collect()
    }

    #[test]
    fn a_table_has_the_values_of_its_rows() {
        for floors in [1, 3, 8, 10, 19] {
            let rows = rows(floors);
            let table = RowTable::new(&rows);
            let mut seen = table.order.clone();
            seen.sort_unstable();
            assert!(seen.into_iter().eq(0..rows.len()), "every row once");
            assert!(table.strips.len() <= 2, "{} strips", table.strips.len());
            let moved: Vec<f64> = (0..6 * floors).map(|i| (0.3 * i as f64).cos()).collect();
            let mut values = vec![f64::NAN; rows.len()];
            table.fill(Arch::new(), &moved, &mut values);
            for (value, row) in values.iter().zip(&table.order) {
                let PlanRow { places, weights } = rows[*row];
                let terms = places
                    .iter()
                    .zip(weights)
                    .map(|(place, w)| w * moved[*place]);
                let sum: f64 = terms.sum();
                assert!(
                    (value - sum).abs() < 1e-14,
                    "{floors} floors: {value}, {sum}"
                );
            }
        }
    }

    #[test]
    fn points_of_a_line_are_shares_of_its_ends() {
        let places = [0, 1, 2, 3, 4, 5];
        let at = |s: f64| PlanRow {
            places,
            weights: [0.6, 0.8, 2.0 - s, -0.6, -0.8, 1.0 + 0.5 * s],
        };
        let (first, last) = (at(-3.0), at(5.0));
        let shares = at(1.0).between(&first, &last).expect("it is on the line");
        assert!((shares[0] - 0.5).abs() < 1e-15 && (shares[1] - 0.5).abs() < 1e-15);
        assert_eq!(first.between(&first, &last), Some([1.0, 0.0]));
        assert_eq!(last.between(&first, &last), Some([0.0, 1.0]));
        let mut off = at(1.0);
        off.weights[1] += 1e-9;
        assert_eq!(off.between(&first, &last), None);
        // Slips along a face do not depend on the point.
        assert_eq!(first.between(&first, &first), Some([1.0, 0.0]));
    }
}
