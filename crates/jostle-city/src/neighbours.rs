//! Which buildings stand side by side, and how.

use geo::{
    Area, BooleanOps, BoundingRect, Coord, Distance, Euclidean, Intersects, Line, LinesIter,
    Polygon, Rect,
};
use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::building::{Building, STOREY};

/// Walls face each other where their outward normals differ from opposite ones by less than 45°: minus its cosine.
const FACING: f64 = -0.707;
/// Maps let neighbours overlap; walls as deep inside each other still face \[m\].
const DEPTH: f64 = 1.0;
/// Outlines that share more of the smaller one than this are no neighbours, but one thing drawn twice \[–\].
const MOST_SHARED: f64 = 0.2;
/// Walls that face each other over less than this meet at a corner \[m\].
const CORNER: f64 = 1.0;

/// Where a pair stands among its neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// One of them has no neighbour on its other side.
    End,
    /// Both have.
    Inside,
    /// They meet at a corner only.
    Corner,
}

impl Position {
    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::End => "end",
            Self::Inside => "inside",
            Self::Corner => "corner",
        }
    }
}

/// Two buildings within reach of each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Indices of the buildings, the lower one first.
    pub buildings: [usize; 2],
    /// Distance on the map \[m\]; it says who, not how far.
    pub distance: f64,
    /// Length over which walls face each other \[m\].
    pub face: f64,
    /// Direction from the first to the second, anticlockwise from east \[rad\].
    pub normal: f64,
    /// Level of the lower roof less that of the nearest floor of the taller building \[m\].
    pub floor_offset: f64,
    /// Height of the lower over that of the taller \[–\].
    pub height_ratio: f64,
    /// Where it stands.
    pub position: Position,
}

/// Pairs, and outlines that overlap too much to be neighbours.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Neighbours {
    /// In the order of their buildings.
    pub pairs: Vec<Pair>,
    /// Buildings whose outlines share more than a fifth of the smaller one.
    pub overlaps: Vec<[usize; 2]>,
}

impl Neighbours {
    /// All pairs of outlines no farther apart than `reach` \[m\].
    #[must_use]
    pub fn within(buildings: &[Building], reach: f64) -> Self {
        let boxes: Vec<Option<Rect>> = buildings
            .iter()
            .map(|building| building.outline.bounding_rect())
            .collect();
        let entries = boxes.iter().enumerate().filter_map(|(at, bounds)| {
            let bounds = (*bounds)?;
            let corners = [
                [bounds.min().x, bounds.min().y],
                [bounds.max().x, bounds.max().y],
            ];
            Some(GeomWithData::new(
                Rectangle::from_corners(corners[0], corners[1]),
                at,
            ))
        });
        let tree = RTree::bulk_load(entries.collect());
        let of_one = |left: usize| {
            let mut neighbours = Self::default();
            let Some(bounds) = boxes[left] else {
                return neighbours;
            };
            let envelope = AABB::from_corners(
                [bounds.min().x - reach, bounds.min().y - reach],
                [bounds.max().x + reach, bounds.max().y + reach],
            );
            let mut near: Vec<usize> = tree
                .locate_in_envelope_intersecting(&envelope)
                .map(|entry| entry.data)
                .filter(|right| *right > left)
                .collect();
            near.sort_unstable();
            for right in near {
                match compare(&buildings[left], &buildings[right], reach) {
                    Met::Apart => {}
                    Met::Overlap => neighbours.overlaps.push([left, right]),
                    Met::Near {
                        distance,
                        face,
                        normal,
                    } => neighbours.pairs.push(Pair {
                        buildings: [left, right],
                        distance,
                        face,
                        normal,
                        floor_offset: floor_offset(&buildings[left], &buildings[right]),
                        height_ratio: height_ratio(&buildings[left], &buildings[right]),
                        position: Position::Corner,
                    }),
                }
            }
            neighbours
        };
        let all: Vec<Self> = (0..buildings.len()).into_par_iter().map(of_one).collect();
        let mut found = Self::default();
        for neighbour in all {
            found.pairs.extend(neighbour.pairs);
            found.overlaps.extend(neighbour.overlaps);
        }
        place(&mut found.pairs, buildings.len());
        found
    }
}

enum Met {
    Apart,
    Overlap,
    Near {
        distance: f64,
        face: f64,
        normal: f64,
    },
}

fn compare(left: &Building, right: &Building, reach: f64) -> Met {
    let [a, b] = [&left.outline, &right.outline];
    let touching = a.intersects(b);
    let distance = if touching {
        0.0
    } else {
        Euclidean.distance(a, b)
    };
    if distance > reach {
        return Met::Apart;
    }
    if touching {
        let shared = a.intersection(b).unsigned_area();
        if shared > MOST_SHARED * left.area.min(right.area) {
            return Met::Overlap;
        }
    }
    let (face, normal) = facing(a, b, reach.max(distance) + 0.05);
    // Without walls that face each other, the direction is that between the middles of the boxes.
    let normal = normal.unwrap_or_else(|| {
        let middle = |polygon: &Polygon| {
            polygon
                .bounding_rect()
                .map_or(Coord { x: 0.0, y: 0.0 }, |bounding_rect| {
                    bounding_rect.center()
                })
        };
        let [from, to] = [middle(a), middle(b)];
        libm::atan2(to.y - from.y, to.x - from.x)
    });
    Met::Near {
        distance,
        face,
        normal,
    }
}

/// Length over which walls face each other no farther apart than `reach`, and the outward direction of the first ones.
fn facing(a: &Polygon, b: &Polygon, reach: f64) -> (f64, Option<f64>) {
    let (Some(box_a), Some(box_b)) = (a.bounding_rect(), b.bounding_rect()) else {
        return (0.0, None);
    };
    let near = |line: &Line, other: &Rect| {
        let within =
            |low: f64, high: f64, from: f64, to: f64| low <= to + reach && high + reach >= from;
        let rect = line.bounding_rect();
        within(rect.min().x, rect.max().x, other.min().x, other.max().x)
            && within(rect.min().y, rect.max().y, other.min().y, other.max().y)
    };
    // Walls of courts face what stands in them.
    let edges_b: Vec<Line> = b.lines_iter().filter(|line| near(line, &box_a)).collect();
    let (mut face, mut sum) = (0.0, [0.0, 0.0]);
    for edge in a.lines_iter().filter(|line| near(line, &box_b)) {
        let length = libm::hypot(edge.dx(), edge.dy());
        if length < 1e-6 {
            continue;
        }
        let along = [edge.dx() / length, edge.dy() / length];
        // Outlines run anticlockwise and their courts clockwise, so outward is to the right.
        let outward = [along[1], -along[0]];
        for other in &edges_b {
            let other_length = libm::hypot(other.dx(), other.dy());
            if other_length < 1e-6 {
                continue;
            }
            let other_outward = [other.dy() / other_length, -other.dx() / other_length];
            if outward[0] * other_outward[0] + outward[1] * other_outward[1] > FACING {
                continue;
            }
            let seen = |at: Coord| {
                let [x, y] = [at.x - edge.start.x, at.y - edge.start.y];
                [x * along[0] + y * along[1], x * outward[0] + y * outward[1]]
            };
            let [mut from, mut to] = [seen(other.start), seen(other.end)];
            if from[0] > to[0] {
                std::mem::swap(&mut from, &mut to);
            }
            let span = [from[0].max(0.0), to[0].min(length)];
            let shared = span[1] - span[0];
            if shared <= 0.0 {
                continue;
            }
            let middle = 0.5 * (span[0] + span[1]);
            let slope = (to[1] - from[1]) / (to[0] - from[0]).max(1e-9);
            let gap = from[1] + slope * (middle - from[0]);
            if (-DEPTH..=reach).contains(&gap) {
                face += shared;
                sum = [sum[0] + shared * outward[0], sum[1] + shared * outward[1]];
            }
        }
    }
    (face, (face > 0.0).then(|| libm::atan2(sum[1], sum[0])))
}

/// Level of the lower roof less that of the nearest floor of the taller building \[m\].
fn floor_offset(a: &Building, b: &Building) -> f64 {
    let (lower, taller) = if a.likely_height() <= b.likely_height() {
        (a, b)
    } else {
        (b, a)
    };
    let storey = taller.likely_height() / taller.likely_storeys() as f64;
    let storey = if storey.is_finite() && storey > 0.0 {
        storey
    } else {
        STOREY
    };
    let roof = lower.likely_height();
    let floor = (roof / storey)
        .round()
        .clamp(1.0, taller.likely_storeys() as f64)
        * storey;
    roof - floor
}

fn height_ratio(a: &Building, b: &Building) -> f64 {
    let [a, b] = [a.likely_height(), b.likely_height()];
    a.min(b) / a.max(b)
}

/// Says of every pair where it stands: a building is inside when it has neighbours on opposite sides.
fn place(pairs: &mut [Pair], buildings: usize) {
    let mut sides: Vec<Vec<f64>> = vec![Vec::new(); buildings];
    for pair in pairs.iter().filter(|pair| pair.face >= CORNER) {
        sides[pair.buildings[0]].push(pair.normal);
        sides[pair.buildings[1]].push(pair.normal + std::f64::consts::PI);
    }
    let inside = |building: usize| {
        let side = &sides[building];
        side.iter().any(|a| side.iter().any(|b| opposite(*a, *b)))
    };
    for pair in pairs {
        pair.position = if pair.face < CORNER {
            Position::Corner
        } else if pair.buildings.into_iter().all(inside) {
            Position::Inside
        } else {
            Position::End
        };
    }
}

/// Whether directions differ by 135° or more.
pub(crate) fn opposite(a: f64, b: f64) -> bool {
    libm::cos(a - b) < FACING
}
