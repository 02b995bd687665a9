//! Bending capacity about both axes at once as a function of the axial force.

use std::f64::consts::PI;

use jostle::model::{CapacityLine, MomentSurface};

use super::Interaction;
use super::interaction::{FIBRES, limit_states};
use crate::law::{ConcreteLaw, SteelLaw};
use crate::section::Section;

/// Greatest moments of a section in every direction under every axial force that it can carry.
///
/// The laws, the limits of strain and the states are those of [`Interaction`], with the neutral axis turned all round. Under an
/// axial force the greatest moments for all neutral axes are the corners of a polygon; the capacity in a direction is the
/// way to its edge, which lies inside the true one. Bending in one plane bears what [`Interaction`] gives.
#[derive(Clone, Debug, PartialEq)]
pub struct ObliqueInteraction {
    /// Compressions, rising \[N\].
    loads: Vec<f64>,
    /// Greatest moments by direction, at equal angles from the plane of the depth, and by compression, those across times
    /// `stretch` \[N·m\].
    moments: Vec<Vec<f64>>,
    /// Depth over width \[–\].
    stretch: f64,
}

/// Directions of the moment.
const DIRECTIONS: usize = 64;
/// Directions of the neutral axis, all round.
const NEUTRAL_AXES: usize = 64;
/// Strains of the outermost concrete, and positions of the neutral axis for each.
const STATES: [usize; 2] = [12, 60];

impl ObliqueInteraction {
    /// Of a section of which the capacities in the plane of its depth, and those of the [turned](Section::turned) section, are
    /// known: `planes`, of both signs each.
    #[must_use]
    pub fn new(section: &Section, planes: &[[Interaction; 2]; 2]) -> Self {
        let stretch = section.depth / section.width;
        let loads = all_loads(planes);
        let corners = corners(section, stretch, &loads);
        let mut moments: Vec<Vec<f64>> = (0..DIRECTIONS)
            .map(|index| {
                let angle = 2.0 * PI * index as f64 / DIRECTIONS as f64;
                let ray = [libm::cos(angle), libm::sin(angle)];
                let under = |load: usize| way_to_edge(&corners, load, ray);
                (0..loads.len()).map(under).collect()
            })
            .collect();
        // Moments in one plane, where the section bears none across for reasons of symmetry; finer there.
        let quarter = DIRECTIONS / 4;
        let [along, across] = planes;
        let even = [section.turned().is_symmetric(), section.is_symmetric()];
        let sides = [
            (0, &along[0], even[0]),
            (2, &along[1], even[0]),
            (1, &across[0], even[1]),
            (3, &across[1], even[1]),
        ];
        for (side, plane, _) in sides.into_iter().filter(|(.., even)| *even) {
            let factor = if side % 2 == 0 { 1.0 } else { stretch };
            let capacities = loads.iter().map(|load| factor * plane.moment(*load));
            moments[side * quarter] = capacities.collect();
        }
        Self {
            loads,
            moments,
            stretch,
        }
    }

    /// As a surface, with a factor on the moments under every compression \[–\].
    #[must_use]
    pub fn surface(&self, factor: impl Fn(f64) -> f64) -> MomentSurface {
        let lines = self.moments.iter().map(|moments| {
            let points = self.loads.iter().zip(moments);
            let points = points.map(|(load, moment)| [*load, moment * factor(*load)]);
            CapacityLine::new(points.collect())
        });
        MomentSurface::new(lines.collect(), self.stretch)
    }

    /// Compressions under which moments are known, rising \[N\].
    #[must_use]
    pub fn loads(&self) -> &[f64] {
        &self.loads
    }
}

/// Compressions under which moments in any plane are known, rising: straight lines between them are those of every plane.
fn all_loads(planes: &[[Interaction; 2]; 2]) -> Vec<f64> {
    let points = planes.iter().flatten().flat_map(|plane| &plane.points);
    let mut loads: Vec<f64> = points.map(|[load, _]| *load).collect();
    loads.sort_by(f64::total_cmp);
    let range = loads.last().copied().unwrap_or(0.0) - loads.first().copied().unwrap_or(0.0);
    loads.dedup_by(|next, before| *next - *before < 1e-12 * range);
    loads
}

/// Moments, that across times `stretch`, that are greatest for every neutral axis and under every compression; those of an axis
/// that no state reaches are zero.
fn corners(section: &Section, stretch: f64, loads: &[f64]) -> Vec<Vec<[f64; 2]>> {
    let mut plain = section.clone();
    plain.concrete.tensile_strength = 0.0;
    let even = [section.is_symmetric(), section.turned().is_symmetric()];
    let mut all: Vec<Vec<[f64; 2]>> = Vec::with_capacity(NEUTRAL_AXES);
    let half = NEUTRAL_AXES / 2;
    for index in 0..NEUTRAL_AXES {
        // The same axis seen in a mirror along or across.
        let mirrored = match index {
            _ if even[1] && index > half => Some((NEUTRAL_AXES - index, [1.0, -1.0])),
            _ if even[0] && index > half / 2 && index <= half => Some((half - index, [-1.0, 1.0])),
            _ => None,
        };
        if let Some((other, [x, y])) = mirrored {
            let other: &[[f64; 2]] = &all[other];
            all.push(other.iter().map(|[a, b]| [x * a, y * b]).collect());
            continue;
        }
        let angle = 2.0 * PI * index as f64 / NEUTRAL_AXES as f64;
        let direction = [libm::cos(angle), libm::sin(angle)];
        all.push(greatest(&plain, direction, stretch, loads));
    }
    all
}

/// The corners of one neutral axis. `direction`: towards greater compression, as parts of depth and width.
fn greatest(section: &Section, direction: [f64; 2], stretch: f64, loads: &[f64]) -> Vec<[f64; 2]> {
    let cut = Cut::new(section, direction);
    let crushing = ConcreteLaw::unconfined(&section.concrete).crushing_strain;
    let states = limit_states(crushing, STATES, |top, bar| {
        let [axial, along, across] = cut.resultants(top, bar);
        [axial, along, stretch * across]
    });
    let towards = |[x, y]: [f64; 2]| direction[0] * x + direction[1] * y;
    let mut most = vec![[0.0; 2]; loads.len()];
    for curve in &states {
        for pair in curve.windows(2) {
            let [low, high] = match pair[0][0] <= pair[1][0] {
                true => [pair[0], pair[1]],
                false => [pair[1], pair[0]],
            };
            let span = high[0] - low[0];
            let first = loads.partition_point(|load| *load < low[0]);
            let within = loads[first..].iter().zip(&mut most[first..]);
            for (load, most) in within.take_while(|(load, _)| **load <= high[0]) {
                let share = if span > 0.0 {
                    (load - low[0]) / span
                } else {
                    0.0
                };
                let at = [1, 2].map(|axis| low[axis] + share * (high[axis] - low[axis]));
                if towards(at) > towards(*most) {
                    *most = at;
                }
            }
        }
    }
    most
}

/// How far a ray from the origin goes to the edge of the polygon under a compression; zero where it misses it.
fn way_to_edge(corners: &[Vec<[f64; 2]>], load: usize, ray: [f64; 2]) -> f64 {
    let cross = |[a, b]: [f64; 2], [c, d]: [f64; 2]| a * d - b * c;
    let next = corners.iter().cycle().skip(1);
    let met = corners.iter().zip(next).filter_map(|(a, b)| {
        let (a, b) = (a[load], b[load]);
        let edge = [b[0] - a[0], b[1] - a[1]];
        let across = cross(ray, edge);
        let way = cross(a, edge) / across;
        let share = cross(a, ray) / across;
        (way > 0.0 && (-1e-9..=1.0 + 1e-9).contains(&share)).then_some(way)
    });
    met.fold(0.0, f64::max)
}

/// A section in slices beside an oblique neutral axis.
struct Cut<'a> {
    section: &'a Section,
    concrete: ConcreteLaw,
    steel: SteelLaw,
    direction: [f64; 2],
    /// Distance of the outermost bar from the corner with the greatest compression, as [`Self::distance`].
    deepest: f64,
}

impl<'a> Cut<'a> {
    fn new(section: &'a Section, direction: [f64; 2]) -> Self {
        let mut cut = Self {
            concrete: ConcreteLaw::unconfined(&section.concrete),
            steel: SteelLaw(section.steel),
            section,
            direction,
            deepest: 0.0,
        };
        let bars = section.bars.iter();
        let distances = bars.map(|bar| cut.distance(cut.measured_from_corner([bar.depth, bar.x])));
        cut.deepest = distances.fold(0.0, f64::max);
        cut
    }

    /// Distances from the corner with the greatest compression over depth and width, of a point below the top and from the
    /// left \[–\].
    fn measured_from_corner(&self, [depth, x]: [f64; 2]) -> [f64; 2] {
        let shares = [depth / self.section.depth, x / self.section.width];
        let seen = |axis: usize| match self.direction[axis] >= 0.0 {
            true => shares[axis],
            false => 1.0 - shares[axis],
        };
        [seen(0), seen(1)]
    }

    /// Distance from that corner against the direction.
    fn distance(&self, measured_from_corner: [f64; 2]) -> f64 {
        self.direction[0].abs() * measured_from_corner[0]
            + self.direction[1].abs() * measured_from_corner[1]
    }

    /// Compression, and moments about both axes that stretch the bottom and the right side, for the strain of the corner with the
    /// greatest compression and that of the outermost bar \[N, N·m\].
    fn resultants(&self, top: f64, bar: f64) -> [f64; 3] {
        let section = self.section;
        let curvature = (top - bar) / self.deepest;
        let strain = |distance: f64| top - curvature * distance;
        let mut sum = [0.0; 3];
        let mut add = |force: f64, measured_from_corner: [f64; 2]| {
            let arm = |axis: usize, size: f64| {
                let distance = (0.5 - measured_from_corner[axis]) * size;
                if self.direction[axis] >= 0.0 {
                    distance
                } else {
                    -distance
                }
            };
            sum[0] += force;
            sum[1] += force * arm(0, section.depth);
            sum[2] += force * arm(1, section.width);
        };
        let sides = self.direction.map(f64::abs);
        // Slices run along the axis with the smaller share.
        let short = usize::from(sides[1] < sides[0]);
        let (small, large) = (sides[short], sides[1 - short]);
        let whole = small + large;
        let mut cuts = vec![0.0, small, large, whole];
        if curvature != 0.0 {
            let corners = [0.0, self.concrete.peak_strain];
            cuts.extend(corners.map(|corner| (top - corner) / curvature));
        }
        cuts.retain(|cut| (0.0..=whole).contains(cut));
        cuts.sort_by(f64::total_cmp);
        // Two points of Gauss and Legendre.
        let offset = 0.5 / 3.0_f64.sqrt();
        for ends in cuts.windows(2) {
            let (from, height) = (ends[0], ends[1] - ends[0]);
            if height <= 0.0 || strain(from).max(strain(ends[1])) <= 0.0 {
                continue;
            }
            let slices = (FIBRES as f64 * height / whole).ceil();
            let part = height / slices;
            for slice in 0..slices as usize {
                let centre = from + part * (slice as f64 + 0.5);
                for distance in [centre - offset * part, centre + offset * part] {
                    let ends = match small > 0.0 {
                        true => [
                            ((distance - large) / small).max(0.0),
                            (distance / small).min(1.0),
                        ],
                        false => [0.0, 1.0],
                    };
                    let mut middle = [0.0; 2];
                    middle[short] = 0.5 * (ends[0] + ends[1]);
                    middle[1 - short] = (distance - small * middle[short]) / large;
                    let area = section.area() * 0.5 * part * (ends[1] - ends[0]) / large;
                    add(area * self.concrete.stress(strain(distance)), middle);
                }
            }
        }
        for bar in &section.bars {
            let place = self.measured_from_corner([bar.depth, bar.x]);
            let strain = strain(self.distance(place));
            // Bars displace concrete.
            let displaced = if strain > 0.0 {
                self.concrete.stress(strain)
            } else {
                0.0
            };
            add(bar.area() * (self.steel.stress(strain) - displaced), place);
        }
        sum
    }
}
