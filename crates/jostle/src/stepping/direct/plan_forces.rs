//! Forces in plan, and sections that yield on a surface, in a step: three rows of the list of springs that answer together (theory,
//! Eqs. B1p and Y5).

use super::springs::{FIT, SpringTrial};
use crate::hysteresis::{HysteresisMemory, PlanAnswer, Rates, Surface};
use crate::structure::YieldingSpring;

/// Takes the force of a solution from the row between to those along x and across, and answers; whether the force lies on the lines.
pub(super) fn follow(
    springs: &[YieldingSpring],
    rows: &mut [SpringTrial],
    memories: &[HysteresisMemory],
) -> bool {
    let [x, y, between] = rows else { return true };
    x.on_line += between.on_line;
    y.on_line -= between.on_line;
    between.on_line = 0.0;
    let limit = springs[0].hysteresis.backbone().yield_force();
    answer(springs, rows, memories);
    let apart = |row: &SpringTrial| row.answer - row.on_line;
    let apart = libm::hypot(apart(&rows[0]), apart(&rows[1]));
    apart <= FIT * limit || apart <= FIT * libm::hypot(rows[0].answer, rows[1].answer)
}

/// Force and tangents at displacements of the first two rows; `None` for springs that answer by themselves.
fn answer_at(
    springs: &[YieldingSpring],
    rows: &[SpringTrial],
    memories: &[HysteresisMemory],
    to: [f64; 2],
) -> Option<PlanAnswer> {
    let [x, y, between] = springs else {
        return None;
    };
    let from = [&memories[0], &memories[1]];
    if let Some(law) = x.hysteresis.circular() {
        return Some(law.answer(from, to, &rates(rows, memories, to)));
    }
    let law = Surface::of([x, y, between].map(|row| &row.hysteresis))?;
    Some(law.answer(from, to))
}

/// Force and tangents at the displacement reached.
pub(super) fn answer(
    springs: &[YieldingSpring],
    rows: &mut [SpringTrial],
    memories: &[HysteresisMemory],
) {
    let to = [rows[0].reached, rows[1].reached];
    let Some(answer) = answer_at(springs, rows, memories, to) else {
        return;
    };
    let forces = answer.force.into_iter().chain([0.0]);
    for (row, (force, tangent)) in rows.iter_mut().zip(forces.zip(answer.tangents)) {
        (row.answer, row.next_tangent) = (force, tangent);
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

/// Slope of the potential of the step at a share of the way to the displacement reached, as far as this force goes \[J\].
pub(super) fn slope(
    springs: &[YieldingSpring],
    rows: &[SpringTrial],
    memories: &[HysteresisMemory],
    share: f64,
) -> f64 {
    let way = [0, 1].map(|row| rows[row].reached - rows[row].deformation);
    let at = [0, 1].map(|row| rows[row].deformation + share * way[row]);
    let Some(PlanAnswer { force, .. }) = answer_at(springs, rows, memories, at) else {
        return 0.0;
    };
    let row_slope = |row: usize| {
        let SpringTrial {
            balance, on_line, ..
        } = rows[row];
        way[row] * (force[row] - balance - share * (on_line - balance))
    };
    row_slope(0) + row_slope(1)
}

/// Motion along x and across over a step that ends at a displacement.
fn rates(rows: &[SpringTrial], memories: &[HysteresisMemory], to: [f64; 2]) -> [Rates; 2] {
    [0, 1].map(|row| rows[row].rates_to(&memories[row], to[row]))
}
