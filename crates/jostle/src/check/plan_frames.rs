//! Faults of plane frames at lines of a plan.

use super::{Faults, check_base, check_frame_hinges, check_members_of};
use crate::model::{Building, PlanFrame, SharedColumn, TierStorey, Tiers};

/// Storey heights of a frame and of its building may differ by rounding only \[m\].
const SAME_HEIGHT: f64 = 1e-9;

/// Sine of the angle below which two frames are parallel \[–\].
const PARALLEL: f64 = 1e-6;

/// Least eigenvalue, relative to the greatest, of directions in which a floor is held \[–\].
const HELD: f64 = 1e-9;

pub(super) fn check_plan_frames(
    faults: &mut Faults,
    path: &str,
    tiers: &Tiers,
    building: &Building,
) {
    if tiers.frames.is_empty() {
        return;
    }
    let before = faults.0.len();
    let reached = tiers.frames.iter();
    let reached = reached
        .map(|plan_frame| plan_frame.frame.storey_heights.len())
        .max();
    let reached = reached.unwrap_or(0);
    faults.require(
        !building.gravity.preload || reached >= tiers.floors.len(),
        format!("{path}.gravity"),
        || {
            format!(
                "floor {} has no columns of frames that carry its weight; let frames reach it, or leave gravity out",
                reached + 1
            )
        },
    );
    for (index, frame) in tiers.frames.iter().enumerate() {
        let at = format!("{path}.frame[{index}]");
        check_one(faults, &at, frame, tiers);
        let namesake = tiers.frames[..index]
            .iter()
            .any(|candidate| candidate.name == frame.name);
        faults.require(!namesake, format!("{at}.name"), || {
            format!(
                "another frame is called \"{}\" too; give every frame its own name",
                frame.name
            )
        });
    }
    if faults.0.len() > before {
        return;
    }
    check_columns(faults, path, tiers);
    check_held(faults, path, tiers);
}

fn check_one(faults: &mut Faults, at: &str, plan_frame: &PlanFrame, tiers: &Tiers) {
    let name = plan_frame.name.trim();
    faults.require(
        !name.is_empty() && name == plan_frame.name,
        format!("{at}.name"),
        || "must not be empty, nor begin or end with a blank".into(),
    );
    let frame = &plan_frame.frame;
    check_members_of(faults, at, frame);
    check_base(
        faults,
        &format!("{at}.base"),
        &plan_frame.base,
        [true, false],
    );
    check_frame_hinges(faults, &format!("{at}.hinges"), &plan_frame.hinges, frame);
    let yields =
        plan_frame.base.rotational_hinge.is_some() || plan_frame.base.horizontal_hinge.is_some();
    faults.require(!yields, format!("{at}.base"), || {
        "cannot yield under a frame in a plan yet; leave its hinges out".into()
    });
    faults.require(!plan_frame.base.uplift, format!("{at}.base.uplift"), || {
        "is not possible under a frame in a plan yet; leave it out".into()
    });
    let rests = plan_frame.base.isolation.is_some() || plan_frame.base.foundation.is_some();
    faults.require(!rests, format!("{at}.base"), || {
        "takes springs and dashpots only under a frame in a plan".into()
    });
    let heights = frame.storey_heights.iter().zip(&tiers.storey_heights);
    let same = heights
        .clone()
        .all(|(candidate, other)| (candidate - other).abs() <= SAME_HEIGHT);
    let storeys = frame.storey_heights.len();
    let most = tiers.floors.len();
    faults.require(
        (1..=most).contains(&storeys) && same,
        format!("{at}.storeys"),
        || format!("must lie between 1 and {most}, and its storeys are the lowest ones of the building; found {storeys}"),
    );
    let finite = plan_frame
        .at
        .iter()
        .chain(&plan_frame.direction)
        .all(|v| v.is_finite());
    let length = libm::hypot(plan_frame.direction[0], plan_frame.direction[1]);
    faults.require(
        finite && (length - 1.0).abs() < 1e-9,
        format!("{at}.direction"),
        || "must be \"x\", \"y\", or an angle from x, counter-clockwise, such as \"30 deg\"".into(),
    );
    let lines = plan_frame.column_lines();
    faults.require(
        plan_frame.lines.is_empty() || plan_frame.lines.len() == lines,
        format!("{at}.lines"),
        || {
            format!(
                "has {} names for {lines} column lines; give one per line, \"\" for a column without a name",
                plan_frame.lines.len()
            )
        },
    );
    let of_joint = frame.joint.horizontal_stiffness;
    faults.require(
        of_joint.is_none(),
        format!("{at}.joint.horizontal_stiffness"),
        || "has nothing to do here: rigid floors hold the ends of beams; leave it out".into(),
    );
    faults.require(
        plan_frame.is_along_an_axis() || !plan_frame.has_masses_between_floors(),
        format!("{at}.column_segments"),
        || "must be 1 for columns with mass in a frame that stands neither along x nor across, and struts must meet them at joints: masses between floors would couple both directions; or set density = 0 and count the columns in mass".into(),
    );
}

/// Columns of the same name in two frames are one column.
fn check_columns(faults: &mut Faults, path: &str, tiers: &Tiers) {
    let shared = tiers.shared_columns();
    for (index, column) in shared.iter().enumerate() {
        let SharedColumn { name, lines } = column;
        let [[first, _], [second, line]] = *lines;
        let at = format!("{path}.frame[{second}].lines[{line}]");
        if first == second {
            faults.add(
                at,
                format!("names two columns of one frame \"{name}\"; give each its own name"),
            );
            continue;
        }
        let again = shared[..index]
            .iter()
            .any(|shared_column| shared_column.name == *name);
        faults.require(!again, at.clone(), || {
            format!("is the third column \"{name}\"; two frames can share a column")
        });
        let [a, b] = [first, second].map(|frame| &tiers.frames[frame]);
        faults.require(tiers.stands_at_one_point(column), at.clone(), || {
            let [p, q] = lines.map(|[frame, line]| tiers.frames[frame].line_at(line));
            format!(
                "puts column \"{name}\" at ({:.3} m, {:.3} m) on the site, but frame \"{}\" puts it at ({:.3} m, {:.3} m); correct at, direction or spans, or give it another name",
                q[0], q[1], a.name, p[0], p[1]
            )
        });
        let follows = lines.iter().any(|[frame, line]| {
            let fibres = tiers.frames[*frame].hinges.fibres.keys();
            fibres.into_iter().any(|[_, own]| own == line)
        });
        faults.require(!follows, at.clone(), || {
            format!(
                "shares column \"{name}\" with frame \"{}\": its axial force would count in one of them only, and hinges follow it; describe the building as a space frame, or take a rule with moments",
                a.name
            )
        });
        let storeys = a
            .frame
            .storey_heights
            .len()
            .min(b.frame.storey_heights.len());
        let [of_a, of_b] = lines.map(|[_, line]| line);
        let lacking = (0..storeys).find(|storey| {
            a.frame.column(*storey, of_a).is_some() != b.frame.column(*storey, of_b).is_some()
        });
        if let Some(storey) = lacking {
            faults.add(
                at.clone(),
                format!(
                    "shares column \"{name}\" with frame \"{}\", but only one of them has it in storey {}; omit it in both or in none",
                    a.name,
                    storey + 1
                ),
            );
        }
        let sine = a.direction[0] * b.direction[1] - a.direction[1] * b.direction[0];
        faults.require(sine.abs() > PARALLEL, at, || {
            format!(
                "shares column \"{name}\" with frame \"{}\", which stands in the same direction; make them one frame",
                a.name
            )
        });
    }
}

/// Whether frames and springs hold every floor along x, across and in torsion.
fn check_held(faults: &mut Faults, path: &str, tiers: &Tiers) {
    for (storey, floor) in tiers.floors.iter().enumerate() {
        let length = floor.plan_radius();
        let mut sum = tiers.held(storey, floor.centre, length);
        if let Some(springs) = &tiers.initial_storey(storey) {
            add_springs(&mut sum, springs, floor.centre, length);
        }
        if is_positive(sum) {
            continue;
        }
        faults.add(
            format!("{path}.frame"),
            format!(
                "do not hold floor {} in every direction: frames need two directions and must not all pass through one point; add a frame, or stiffness or elements for the storey",
                storey + 1
            ),
        );
        return;
    }
}

/// Adds the directions in which springs hold a floor.
fn add_springs(sum: &mut [[f64; 3]; 3], springs: &TierStorey, centre: [f64; 2], length: f64) {
    let arm = [0, 1].map(|axis| (springs.centre[axis] - centre[axis]) / length);
    let rows = [[1.0, 0.0, -arm[1]], [0.0, 1.0, arm[0]], [0.0, 0.0, 1.0]];
    for (row, stiffness) in rows.iter().zip(springs.stiffness) {
        if stiffness <= 0.0 {
            continue;
        }
        for (i, a) in row.iter().enumerate() {
            for (j, b) in row.iter().enumerate() {
                sum[i][j] += a * b;
            }
        }
    }
}

/// Whether a symmetric matrix is positive definite by more than rounding.
fn is_positive(mut m: [[f64; 3]; 3]) -> bool {
    let most = (0..3).map(|k| m[k][k]).fold(0.0, f64::max);
    for k in 0..3 {
        if m[k][k].is_nan() || m[k][k] <= HELD * most {
            return false;
        }
        for i in k + 1..3 {
            let factor = m[i][k] / m[k][k];
            for j in k..3 {
                m[i][j] -= factor * m[k][j];
            }
        }
    }
    true
}
