//! Forces in plan, and sections that yield on a surface, in a step: rows of the list of springs that answer together (theory, Eqs. B1p
//! and Y5). Two points and their difference, or three points and three differences.

use std::ops::Range;

use super::springs::{FIT, SpringTrial};
use crate::hysteresis::{HysteresisMemory, Rates, Surface};
use crate::structure::YieldingSpring;

/// The points whose displacements a row behind them is the difference of.
const PAIRS: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// Forces of points, and stiffnesses of all rows.
struct Answer {
    force: [f64; 3],
    tangents: [f64; 6],
}

/// Rows that answer together.
pub(super) fn together(springs: &[YieldingSpring]) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut next = 0;
    std::iter::from_fn(move || {
        let first = next;
        let spring = springs.get(first)?;
        next += if spring.surface.is_some() { 6 } else { 3 };
        Some(first..next)
    })
}

/// Number of points of rows that answer together.
fn points_of(rows: &[SpringTrial]) -> usize {
    rows.len().div_ceil(2)
}

/// Takes the forces of a solution from the differences to the points, and answers; whether the force lies on the lines.
pub(super) fn follow(
    springs: &[YieldingSpring],
    rows: &mut [SpringTrial],
    memories: &[HysteresisMemory],
) -> bool {
    let points = points_of(rows);
    for (row, [from, to]) in (points..rows.len()).zip(PAIRS) {
        let force = std::mem::take(&mut rows[row].on_line);
        rows[from].on_line += force;
        rows[to].on_line -= force;
    }
    let limit = springs[0].hysteresis.backbone().yield_force();
    answer(springs, rows, memories);
    let length = |of: fn(&SpringTrial) -> f64| {
        let third = rows.get(2).filter(|_| points > 2).map_or(0.0, of);
        libm::hypot(libm::hypot(of(&rows[0]), of(&rows[1])), third)
    };
    let apart = length(|row| row.answer - row.on_line);
    apart <= FIT * limit || apart <= FIT * length(|row| row.answer)
}

/// Forces and tangents at displacements of the points; `None` for springs that answer by themselves.
fn answer_at(
    springs: &[YieldingSpring],
    rows: &[SpringTrial],
    memories: &[HysteresisMemory],
    to: [f64; 3],
) -> Option<Answer> {
    if let Some(law) = &springs[0].surface {
        let answer = law.answer([&memories[0], &memories[1], &memories[2]], to);
        return Some(Answer {
            force: answer.force,
            tangents: answer.tangents,
        });
    }
    let [x, y, between] = springs else {
        return None;
    };
    let (from, to) = ([&memories[0], &memories[1]], [to[0], to[1]]);
    let answer = match x.hysteresis.circular() {
        Some(law) => law.answer(from, to, &rates(rows, memories, to)),
        None => Surface::of([x, y, between].map(|row| &row.hysteresis))?.answer(from, to),
    };
    let ([x, y], [a, b, c]) = (answer.force, answer.tangents);
    Some(Answer {
        force: [x, y, 0.0],
        tangents: [a, b, c, 0.0, 0.0, 0.0],
    })
}

/// Force and tangents at the displacement reached.
pub(super) fn answer(
    springs: &[YieldingSpring],
    rows: &mut [SpringTrial],
    memories: &[HysteresisMemory],
) {
    let points = points_of(rows);
    let to = [0, 1, 2].map(|row| rows[row].reached);
    let Some(answer) = answer_at(springs, rows, memories, to) else {
        return;
    };
    for (number, (row, tangent)) in rows.iter_mut().zip(answer.tangents).enumerate() {
        row.answer = if number < points {
            answer.force[number]
        } else {
            0.0
        };
        row.next_tangent = tangent;
    }
}

/// Moves the stages of pendulums of several surfaces on, before the forces of an accepted step are taken over.
pub(super) fn slide_stages(
    spring: &YieldingSpring,
    rows: &[SpringTrial],
    memories: &mut [HysteresisMemory],
) {
    if let (Some(law), [x, y, ..], Some(memories)) =
        (spring.hysteresis.circular(), rows, memories.get_mut(..3))
    {
        law.slide_stages(memories, [x.answer, y.answer]);
    }
}

/// Slope of the potential of the step at a share of the way to the displacement reached, as far as these forces go \[J\].
pub(super) fn slope(
    springs: &[YieldingSpring],
    rows: &[SpringTrial],
    memories: &[HysteresisMemory],
    share: f64,
) -> f64 {
    let way = [0, 1, 2].map(|row| rows[row].reached - rows[row].deformation);
    let at = [0, 1, 2].map(|row| rows[row].deformation + share * way[row]);
    let Some(Answer { force, .. }) = answer_at(springs, rows, memories, at) else {
        return 0.0;
    };
    let row_slope = |row: usize| {
        let SpringTrial {
            balance, on_line, ..
        } = rows[row];
        way[row] * (force[row] - balance - share * (on_line - balance))
    };
    (0..points_of(rows)).map(row_slope).sum()
}

/// Motion along x and across over a step that ends at a displacement.
fn rates(rows: &[SpringTrial], memories: &[HysteresisMemory], to: [f64; 2]) -> [Rates; 2] {
    [0, 1].map(|row| rows[row].rates_to(&memories[row], to[row]))
}
