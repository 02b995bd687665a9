//! Walls that stand out of the plan of their floors.

use crate::model::{Building, Model, PlanAxis, PlanPoint, Structure, Tiers};

/// Length by which a wall may stand out of the plan before a warning names it \[m\].
const SLIGHT: f64 = 0.05;

/// Walls whose ends lie outside of the plan of their floors, one line for every building: contact and pictures take the plan as the face.
#[must_use]
pub fn wall_warnings(model: &Model) -> Vec<String> {
    model.buildings.iter().filter_map(of_building).collect()
}

fn of_building(building: &Building) -> Option<String> {
    let Structure::Tiers(tiers) = &building.structure else {
        return None;
    };
    let beyond = ends_of_walls(tiers).into_iter().map(|(wall, floor, end)| {
        let plan = tiers.floors.get(floor).map_or(&[][..], |floor| &floor.plan);
        (wall, distance_beyond(plan, end))
    });
    let (wall, worst) = beyond
        .filter(|beyond| beyond.1 > SLIGHT)
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(format!(
        "\"{}\": {wall} stands {worst:.2} m out of the plan of its floors, whose edge is the face in contact; give a plan that reaches to its end, or measure gaps from the edge of the plan",
        building.name
    ))
}

/// Names of walls, their lowest floors, from 0, and both of their ends on the site.
fn ends_of_walls(tiers: &Tiers) -> Vec<(String, usize, PlanPoint)> {
    let mut found = Vec::new();
    let mut add = |name: String, floor: usize, [x, y]: PlanPoint, [a, b]: [f64; 2]| {
        found.push((name.clone(), floor, [x + a, y + b]));
        found.push((name, floor, [x - a, y - b]));
    };
    if let Some(frame) = &tiers.space_frame {
        for (index, wall) in frame.walls.iter().enumerate() {
            let [c, s] = frame.direction.map(|part| 0.5 * wall.length * part);
            let half = match wall.along {
                PlanAxis::X => [c, s],
                PlanAxis::Y => [-s, c],
            };
            let name = format!("wall {}", index + 1);
            add(name, wall.storeys[0], frame.point(wall.line), half);
        }
    }
    for frame in &tiers.frames {
        let lines = frame.frame.line_positions();
        for (index, wall) in frame.frame.walls.iter().enumerate() {
            let along = lines.get(wall.line - 1).copied().unwrap_or(0.0);
            let at = [0, 1].map(|axis| frame.at[axis] + along * frame.direction[axis]);
            let half = frame.direction.map(|part| 0.5 * wall.length * part);
            let name = format!("wall {} of frame {}", index + 1, frame.name);
            add(name, wall.storeys[0] - 1, at, half);
        }
    }
    found
}

/// How far a point lies outside of a polygon; zero inside \[m\].
fn distance_beyond(plan: &[PlanPoint], [x, y]: PlanPoint) -> f64 {
    let (mut nearest, mut inside) = (f64::INFINITY, false);
    for (a, b) in plan.iter().zip(plan.iter().cycle().skip(1)) {
        let ([ax, ay], [bx, by]) = (*a, *b);
        if (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax) {
            inside = !inside;
        }
        let (dx, dy) = (bx - ax, by - ay);
        let squared = dx * dx + dy * dy;
        let share = if squared > 0.0 {
            (((x - ax) * dx + (y - ay) * dy) / squared).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let apart = libm::hypot(x - ax - share * dx, y - ay - share * dy);
        nearest = nearest.min(apart);
    }
    if inside || nearest.is_infinite() {
        0.0
    } else {
        nearest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_from_the_edge() {
        let plan = [[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [0.0, 4.0]];
        for (point, due) in [
            ([3.0, 2.0], 0.0),
            ([6.0, 2.0], 0.0),
            ([7.5, 2.0], 1.5),
            ([9.0, 8.0], 5.0),
            ([-2.0, 0.0], 2.0),
        ] {
            let found = distance_beyond(&plan, point);
            assert!((found - due).abs() < 1e-12, "{point:?}: {found}");
        }
    }
}
