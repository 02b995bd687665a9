//! Where the plans of two floors can touch: faces, which are pairs of facing edges, corners before edges, and corners that
//! pass each other.

use std::f64::consts::PI;

use serde::Serialize;

use crate::model::{ColumnLine, PlanContact, PlanPoint};

/// Greatest angle between edges that face each other \[rad\].
const FACING: f64 = 0.1;
/// Least overlap of two edges that form a face \[m\].
const LEAST_OVERLAP: f64 = 1e-3;
/// Most points of a face.
pub(crate) const MOST_POINTS: usize = 9;

/// How two plans touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PlanContactKind {
    /// Two edges that face each other.
    Face,
    /// A corner before an edge or before another corner.
    Corner,
    /// An edge before a column between its floors.
    Column,
}

impl PlanContactKind {
    /// As results spell it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Face => "face",
            Self::Corner => "corner",
            Self::Column => "column",
        }
    }
}

/// The part of a plan that touches another plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanPart {
    /// The edge from the corner of this index, from 0, to the next one.
    Edge(usize),
    /// The corner of this index, from 0.
    Corner(usize),
    /// The column at this line.
    Column(ColumnLine),
}

/// Two edges that face each other, or a corner with one of the normals along which it can be touched.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlanFace {
    pub(crate) kind: PlanContactKind,
    /// What touches, of the first plan and of the second.
    pub(crate) parts: [PlanPart; 2],
    /// Unit normal from the first plan to the second.
    pub(crate) normal: PlanPoint,
    /// Length of the face, width of a column; zero for a corner \[m\].
    pub(crate) overlap: f64,
    /// Middle of the face, or the corner, midway across the gap \[m\].
    pub(crate) middle: PlanPoint,
    pub(crate) points: Vec<FacePoint>,
    /// Ends of the edge beyond which a corner finds nothing to touch.
    pub(crate) ends: Vec<FaceEnd>,
}

/// How far a corner is inside of an end of the edge before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FaceEnd {
    /// The distance grows as the first plan moves in this direction against the second.
    pub(crate) direction: PlanPoint,
    /// Distance at rest, negative for a corner that is beyond the end \[m\].
    pub(crate) inside: f64,
    /// Whether it is the indentation of another contact, so that it shrinks as the gap is made wider.
    pub(crate) is_indentation: bool,
}

/// A point of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FacePoint {
    /// Midway across the gap \[m\].
    pub(crate) at: PlanPoint,
    /// Distance of the two edges there \[m\].
    pub(crate) gap: f64,
    /// Share of the stiffness of the face \[–\].
    pub(crate) share: f64,
}

fn minus(a: PlanPoint, b: PlanPoint) -> PlanPoint {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn dot(a: PlanPoint, b: PlanPoint) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn cross(a: PlanPoint, b: PlanPoint) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn unit(a: PlanPoint) -> PlanPoint {
    let length = libm::hypot(a[0], a[1]);
    a.map(|value| value / length)
}

fn midway(a: PlanPoint, b: PlanPoint) -> PlanPoint {
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}

/// Edges of a polygon with counter-clockwise corners: both ends, and the unit normal outwards.
fn edges(plan: &[PlanPoint]) -> impl Iterator<Item = ([PlanPoint; 2], PlanPoint)> + '_ {
    let next = plan.iter().cycle().skip(1);
    plan.iter().zip(next).map(|(&a, &b)| {
        let along = unit(minus(b, a));
        ([a, b], [along[1], -along[0]])
    })
}

/// All faces and corners between two plans, in the order of the edges of the first, then of the second.
pub(crate) fn plan_faces(
    first: &[PlanPoint],
    second: &[PlanPoint],
    contact: &PlanContact,
) -> Vec<PlanFace> {
    let mut found = Vec::new();
    for (i, (edge, outward)) in edges(first).enumerate() {
        for (j, (other, inward)) in edges(second).enumerate() {
            let parts = [PlanPart::Edge(i), PlanPart::Edge(j)];
            found.extend(face(parts, [edge, other], [outward, inward], contact));
        }
    }
    found.extend(corners(first, second, contact, 1.0));
    found.extend(corners(second, first, contact, -1.0));
    found.extend(passing_corners(first, second, contact));
    found
}

/// The face of two edges with their outward normals, if they form one.
fn face(
    parts: [PlanPart; 2],
    [one, other]: [[PlanPoint; 2]; 2],
    [outward, inward]: [PlanPoint; 2],
    contact: &PlanContact,
) -> Option<PlanFace> {
    if -dot(outward, inward) <= libm::cos(FACING) {
        return None;
    }
    let normal = unit(minus(outward, inward));
    let along = [-normal[1], normal[0]];
    // The edge of the first plan runs in the direction of `along`, that of the second against it.
    let ends = [one.map(|p| dot(p, along)), other.map(|p| dot(p, along))];
    let from = ends[0][0].max(ends[1][1]);
    let to = ends[0][1].min(ends[1][0]);
    let overlap = to - from;
    if overlap <= LEAST_OVERLAP {
        return None;
    }
    let at = |[a, b]: [PlanPoint; 2], s: f64| {
        let [start, end] = [dot(a, along), dot(b, along)];
        let share = (s - start) / (end - start);
        [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]
    };
    let point = |s: f64, share: f64| {
        let [near, far] = [at(one, s), at(other, s)];
        FacePoint {
            at: midway(near, far),
            gap: dot(minus(far, near), normal),
            share,
        }
    };
    let least = point(from, 0.0).gap.min(point(to, 0.0).gap);
    // Edges on the far sides of two buildings have passed each other.
    if !(-LEAST_OVERLAP..=contact.reach).contains(&least) {
        return None;
    }
    let middle = point(0.5 * (from + to), 1.0).at;
    let rule = lobatto(contact.points.clamp(2, MOST_POINTS));
    let points = rule
        .into_iter()
        .map(|(place, share)| point(from + 0.5 * (1.0 + place) * overlap, share));
    Some(PlanFace {
        kind: PlanContactKind::Face,
        parts,
        normal,
        overlap,
        middle,
        points: points.collect(),
        ends: Vec::new(),
    })
}

/// Corners of a plan before edges of another that they do not share a face with; `sign` is −1 if the plan is the second of
/// the two.
fn corners(
    plan: &[PlanPoint],
    other: &[PlanPoint],
    contact: &PlanContact,
    sign: f64,
) -> Vec<PlanFace> {
    let sides: Vec<([PlanPoint; 2], PlanPoint)> = edges(plan).collect();
    let mut found = Vec::new();
    for (index, (ends, after)) in sides.iter().enumerate() {
        let corner = ends[0];
        let before = sides[(index + sides.len() - 1) % sides.len()].1;
        for (edge, ([a, b], outward)) in edges(other).enumerate() {
            let towards = outward.map(|value| -value);
            // The corner points at the edge: its direction lies between the normals of both edges of the corner.
            let inside = libm::sin(FACING);
            if cross(before, towards) <= inside
                || cross(towards, *after) <= inside
                || dot(towards, before) + dot(towards, *after) <= 0.0
            {
                continue;
            }
            let length = libm::hypot(minus(b, a)[0], minus(b, a)[1]);
            let along = unit(minus(b, a));
            let place = dot(minus(corner, a), along);
            let gap = dot(minus(corner, a), outward);
            let is_near = (0.0..=contact.reach).contains(&gap);
            if !is_near || !(0.0..=length).contains(&place) {
                continue;
            }
            let foot = [a[0] + place * along[0], a[1] + place * along[1]];
            let at = midway(corner, foot);
            let end = |inside: f64, sign: f64| FaceEnd {
                direction: along.map(|value| sign * value),
                inside,
                is_indentation: false,
            };
            let ends = [end(place, sign), end(length - place, -sign)];
            let parts = [PlanPart::Corner(index), PlanPart::Edge(edge)];
            let [one, two] = parts;
            found.push(PlanFace {
                kind: PlanContactKind::Corner,
                parts: if sign > 0.0 { parts } else { [two, one] },
                normal: towards.map(|value| sign * value),
                overlap: 0.0,
                middle: at,
                points: vec![FacePoint {
                    at,
                    gap,
                    share: 1.0,
                }],
                ends: ends
                    .into_iter()
                    .filter(|end| end.inside <= contact.reach)
                    .collect(),
            });
        }
    }
    found
}

/// Corners of two plans that are nearest to each other and can pass: one contact with two possible normals (theory, section
/// 16), listed as two. Each holds only while the indentation along the normal of the other is positive.
///
/// Seen from one corner, the other moves into the angle in which the edges of both lie; the normals are those of the two edges
/// that bound it. Edges that face each other count as one, with their mean normal.
fn passing_corners(
    first: &[PlanPoint],
    second: &[PlanPoint],
    contact: &PlanContact,
) -> Vec<PlanFace> {
    let mut found = Vec::new();
    for corner in Corner::all(first) {
        for other in Corner::all(second) {
            let apart = minus(other.at, corner.at);
            let distance = libm::hypot(apart[0], apart[1]);
            if !(0.0..=contact.reach).contains(&distance) || distance == 0.0 {
                continue;
            }
            let inward = other.outward.map(|normal| normal.map(|value| -value));
            let Some(lower) = nearer(corner.outward[0], inward[0], apart, 1.0) else {
                continue;
            };
            let Some(upper) = nearer(corner.outward[1], inward[1], apart, -1.0) else {
                continue;
            };
            if cross(lower, upper) <= libm::sin(FACING) {
                continue;
            }
            let normals = [lower, upper];
            let gaps = normals.map(|normal| dot(normal, apart));
            for (normal, beyond) in [(0, 1), (1, 0)] {
                let at = midway(corner.at, other.at);
                found.push(PlanFace {
                    kind: PlanContactKind::Corner,
                    parts: [
                        PlanPart::Corner(corner.index),
                        PlanPart::Corner(other.index),
                    ],
                    normal: normals[normal],
                    overlap: 0.0,
                    middle: at,
                    points: vec![FacePoint {
                        at,
                        gap: gaps[normal],
                        share: 1.0,
                    }],
                    ends: vec![FaceEnd {
                        direction: normals[beyond],
                        inside: -gaps[beyond],
                        is_indentation: true,
                    }],
                });
            }
        }
    }
    found
}

/// A convex corner of a plan, with the outward normals of the edges before and after it.
struct Corner {
    /// Among the corners of the plan, from 0.
    index: usize,
    at: PlanPoint,
    outward: [PlanPoint; 2],
}

impl Corner {
    fn all(plan: &[PlanPoint]) -> impl Iterator<Item = Self> {
        let sides: Vec<([PlanPoint; 2], PlanPoint)> = edges(plan).collect();
        let before = sides.clone().into_iter().cycle().skip(sides.len() - 1);
        let corners = sides.into_iter().zip(before).enumerate();
        let corners = corners.map(|(index, (after, before))| Self {
            index,
            at: after.0[0],
            outward: [before.1, after.1],
        });
        corners.filter(|corner| cross(corner.outward[0], corner.outward[1]) > 0.0)
    }
}

/// Of two normals on the same side of the direction from corner to corner, the one nearer to it; their mean where they face
/// each other. `None` where the direction lies beyond one of them, so that another pair of corners, or a corner and an edge,
/// are nearer. `sign` is 1 for normals clockwise of the direction, −1 for the others.
fn nearer(a: PlanPoint, b: PlanPoint, apart: PlanPoint, sign: f64) -> Option<PlanPoint> {
    let facing = dot(a, b) > libm::cos(FACING);
    // Edges that overlap by less than the least of a face still leave the corners to each other.
    let beyond = if facing { LEAST_OVERLAP } else { 0.0 };
    let [side_a, side_b] = [a, b].map(|normal| sign * cross(normal, apart));
    let is_beyond = |side: f64| if facing { side < -beyond } else { side <= 0.0 };
    if is_beyond(side_a) || is_beyond(side_b) {
        return None;
    }
    if facing {
        return Some(unit([a[0] + b[0], a[1] + b[1]]));
    }
    Some(if sign * cross(a, b) > 0.0 { b } else { a })
}

/// Places in −1…1 and weights of the Gauss–Lobatto rule of n points: ±1 and the roots of P′ₙ₋₁; the weights
/// 1/(n (n − 1) P²ₙ₋₁) have the sum 1 (M. Abramowitz, I. A. Stegun, 1964, Eq. 25.4.32, halved).
pub(crate) fn lobatto(points: usize) -> Vec<(f64, f64)> {
    let n = points - 1;
    // P of order n and of order n − 1.
    let legendre = |x: f64| {
        let (mut before, mut now) = (1.0, x);
        for k in 1..n {
            let k = k as f64;
            let next = ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0);
            (before, now) = (now, next);
        }
        (now, before)
    };
    let order = n as f64;
    let mut rule: Vec<(f64, f64)> = (0..points)
        .map(|index| {
            // Chebyshev's points are close to the roots.
            let mut x = -libm::cos(PI * index as f64 / order);
            if index > 0 && index < n {
                for _ in 0..50 {
                    let (now, before) = legendre(x);
                    // (1 − x²) P′ = n (P₋₁ − x P), and its derivative −n (n + 1) P.
                    let change = (before - x * now) / ((order + 1.0) * now);
                    x += change;
                    if change.abs() < 1e-16 {
                        break;
                    }
                }
            }
            let (value, _) = legendre(x);
            (x, 1.0 / (order * (order + 1.0) * value * value))
        })
        .collect();
    if points % 2 == 1 {
        rule[n / 2].0 = 0.0;
    }
    rule
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Weights of sum 1 with Σw s² = 1/12 of the squared length from three points on; rules of the handbook.
    #[test]
    fn shares_keep_force_and_moment() {
        for points in 2..=MOST_POINTS {
            let rule = lobatto(points);
            let sum: f64 = rule.iter().map(|(_, share)| share).sum();
            assert!((sum - 1.0).abs() < 1e-14, "{points}: {sum}");
            let second: f64 = rule.iter().map(|(s, share)| 0.25 * s * s * share).sum();
            let expected = if points == 2 { 0.25 } else { 1.0 / 12.0 };
            assert!((second - expected).abs() < 1e-14, "{points}: {second}");
        }
        let three = lobatto(3);
        assert!((three[0].1 - 1.0 / 6.0).abs() < 1e-15 && (three[1].1 - 2.0 / 3.0).abs() < 1e-15);
        let five = lobatto(5);
        assert!((five[1].0 + (3.0_f64 / 7.0).sqrt()).abs() < 1e-14);
        assert!((five[1].1 - 49.0 / 180.0).abs() < 1e-14);
    }

    fn rectangle(x: f64, y: f64, a: f64, b: f64) -> Vec<PlanPoint> {
        vec![[x, y], [x + a, y], [x + a, y + b], [x, y + b]]
    }

    #[test]
    fn two_rectangles_share_the_overlap_of_their_edges() {
        let (a, b) = (
            rectangle(0.0, 0.0, 10.0, 8.0),
            rectangle(10.02, 2.0, 12.0, 9.0),
        );
        let found = plan_faces(&a, &b, &PlanContact::default());
        assert_eq!(found.len(), 1, "{found:?}");
        let face = &found[0];
        assert_eq!(
            (face.kind, face.normal),
            (PlanContactKind::Face, [1.0, 0.0])
        );
        assert!((face.overlap - 6.0).abs() < 1e-12);
        assert!((face.points[0].at[1] - 2.0).abs() < 1e-12);
        assert!((face.points[4].at[1] - 8.0).abs() < 1e-12);
        assert!(face.points.iter().all(|p| (p.gap - 0.02).abs() < 1e-12));
        // From the other side the normal turns round.
        let back = plan_faces(&b, &a, &PlanContact::default());
        assert_eq!(back[0].normal, [-1.0, 0.0]);
        // However far edges may be apart, those on the far sides do not face each other.
        let far = PlanContact {
            reach: 30.0,
            ..PlanContact::default()
        };
        assert_eq!(plan_faces(&a, &b, &far).len(), 1);
        assert!(
            plan_faces(
                &a,
                &rectangle(11.0, 2.0, 12.0, 9.0),
                &PlanContact::default()
            )
            .is_empty()
        );
    }

    #[test]
    fn a_turned_square_meets_an_edge_with_its_corner() {
        let wall = rectangle(5.0, -10.0, 1.0, 20.0);
        let square = vec![[0.0, -4.0], [4.0, 0.0], [0.0, 4.0], [-4.0, 0.0]];
        let contact = PlanContact {
            reach: 1.5,
            ..PlanContact::default()
        };
        for (first, second, sign) in [(&square, &wall, 1.0), (&wall, &square, -1.0)] {
            let found = plan_faces(first, second, &contact);
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!(found[0].kind, PlanContactKind::Corner);
            assert!((found[0].normal[0] - sign).abs() < 1e-15);
            assert!((found[0].points[0].gap - 1.0).abs() < 1e-12);
            assert!((found[0].middle[0] - 4.5).abs() < 1e-12);
        }
    }

    /// Two edges with an angle of 0.05 rad: the gap grows along the face.
    #[test]
    fn every_point_of_a_wedge_has_its_own_gap() {
        let a = rectangle(0.0, 0.0, 10.0, 8.0);
        let b = vec![[10.02, 0.0], [20.0, 0.0], [20.0, 8.0], [10.42, 8.0]];
        let found = plan_faces(&a, &b, &PlanContact::default());
        assert_eq!(found.len(), 1);
        let gaps: Vec<f64> = found[0].points.iter().map(|p| p.gap).collect();
        assert!(gaps.windows(2).all(|pair| pair[1] > pair[0]), "{gaps:?}");
        assert!((gaps[0] - 0.02).abs() < 1e-3 && (gaps[4] - 0.42).abs() < 0.02);
    }

    /// Rectangles that stand corner to corner have both normals; each holds only behind the other. Corners that are flush, or
    /// turned away from each other, have none.
    #[test]
    fn corners_pass_each_other() {
        let a = rectangle(0.0, 0.0, 10.0, 8.0);
        let contact = PlanContact::default();
        let found = plan_faces(&a, &rectangle(10.02, 8.004, 9.0, 9.0), &contact);
        assert_eq!(found.len(), 2, "{found:?}");
        for (face, (normal, gap, beyond, inside)) in found.iter().zip([
            ([1.0, 0.0], 0.02, [0.0, 1.0], -0.004),
            ([0.0, 1.0], 0.004, [1.0, 0.0], -0.02),
        ]) {
            assert_eq!((face.normal, face.ends[0].direction), (normal, beyond));
            assert!((face.points[0].gap - gap).abs() < 1e-12);
            assert!((face.ends[0].inside - inside).abs() < 1e-12);
            assert!(face.ends[0].is_indentation);
            assert!(
                (face.middle[0] - 10.01).abs() < 1e-12 && (face.middle[1] - 8.002).abs() < 1e-12
            );
        }
        // Flush: one face, nothing else.
        let flush = plan_faces(&a, &rectangle(10.02, 0.0, 9.0, 8.0), &contact);
        assert_eq!(flush.len(), 1, "{flush:?}");
        // Too far along the diagonal.
        assert!(plan_faces(&a, &rectangle(10.4, 8.4, 9.0, 9.0), &contact).is_empty());
        // A square turned by 30° with its lowest corner before the corner of a rectangle: the normals are that of the
        // rectangle's right edge or of the square's own edge, whichever is nearer to the direction from corner to corner.
        let (sine, cosine) = 0.5_f64.sin_cos();
        let turned: Vec<PlanPoint> = rectangle(0.0, 0.0, 5.0, 5.0)
            .into_iter()
            .map(|[x, y]| [10.01 + x * cosine - y * sine, 8.03 + x * sine + y * cosine])
            .collect();
        let found = plan_faces(&a, &turned, &contact);
        assert_eq!(found.len(), 2, "{found:?}");
        for normal in found.iter().map(|face| face.normal) {
            let of_rectangle = normal == [0.0, 1.0];
            let of_square = (normal[0] - cosine).abs() < 1e-12 && (normal[1] - sine).abs() < 1e-12;
            assert!(of_rectangle || of_square, "{normal:?}");
        }
    }

    /// A corner near the end of an edge can slide off there, not at the far end.
    #[test]
    fn edges_end_where_a_corner_slides_off() {
        let wall = rectangle(5.0, -0.1, 1.0, 20.0);
        let square = vec![[0.95, -4.0], [4.95, 0.0], [0.95, 4.0], [-3.05, 0.0]];
        let contact = PlanContact::default();
        for (first, second, sign) in [(&square, &wall, 1.0), (&wall, &square, -1.0)] {
            let found = plan_faces(first, second, &contact);
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!(found[0].ends.len(), 1);
            let end = found[0].ends[0];
            // It comes further inside as the square moves up, or the wall down.
            assert!((end.inside - 0.1).abs() < 1e-12 && (end.direction[1] - sign).abs() < 1e-12);
        }
    }
}
