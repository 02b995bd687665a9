//! Upright panels of walls as wide columns between their corners.
//!
//! A panel bends and shears in its plane as a beam at its middle whose ends follow the corners: they move with their mean, and turn
//! as the line between them does. Panels with a common edge are connected at the levels of their corners, so that cores warp.

use jostle_io::InputError;

use crate::beam::Beam;
use crate::element::{Element, Shares, combined};
use crate::facts::fault;
use crate::joints::Joints;
use crate::member::{TextModel, Wall};

/// Corners are at one height, or above each other, within this \[m\].
const LEVEL: f64 = 0.002;
/// Width of the strip of a wall that bends with a joint at its edge across the wall, in thicknesses of the wall.
const STRIP: f64 = 1.5;
/// Most panels after cuts.
const MOST_PANELS: usize = 50_000;

/// A panel between joints: left and right, at its foot and at its head.
pub(crate) struct Panel {
    wall: usize,
    foot: [usize; 2],
    head: [usize; 2],
}

/// Panels, cut where joints lie on their edges; adds their corners to the joints.
///
/// # Errors
/// A panel that is no upright rectangle.
pub(crate) fn panels(model: &TextModel, joints: &mut Joints) -> Result<Vec<Panel>, InputError> {
    let mut whole = Vec::new();
    for (wall, model_wall) in model.walls.iter().enumerate() {
        let Some([foot, head]) = edges(model_wall) else {
            return Err(fault(
                &model.file,
                model_wall.shown.clone(),
                "is no upright rectangle",
                "divide it into rectangles in the source, or take the stiffness from results: unit loads on every diaphragm",
            ));
        };
        whole.push(Panel {
            wall,
            foot: foot.map(|at| joints.add(at)),
            head: head.map(|at| joints.add(at)),
        });
    }
    let mut done = Vec::new();
    let mut known = usize::MAX;
    // A cut may put a joint on the edge of another panel.
    while known != joints.at.len() {
        known = joints.at.len();
        whole.append(&mut done);
        while let Some(panel) = whole.pop() {
            if done.len() + whole.len() > MOST_PANELS {
                return Err(fault(
                    &model.file,
                    model.walls[panel.wall].shown.clone(),
                    "and others are cut into too many panels",
                    "take the stiffness from results instead: unit loads on every diaphragm",
                ));
            }
            match panel.cut(joints) {
                Some(parts) => whole.extend(parts),
                None => done.push(panel),
            }
        }
    }
    done.sort_by_key(|panel| (panel.wall, panel.foot, panel.head));
    Ok(done)
}

/// Foot and head of an upright rectangle, each from left to right.
pub(crate) fn edges(wall: &Wall) -> Option<[[[f64; 3]; 2]; 2]> {
    let mut corners = wall.corners.clone();
    if corners.len() != 4 {
        return None;
    }
    corners.sort_by(|a, b| a[2].total_cmp(&b[2]));
    let [a, b, mut c, mut d] = [corners[0], corners[1], corners[2], corners[3]];
    let apart = |a: [f64; 3], b: [f64; 3]| (a[0] - b[0]).hypot(a[1] - b[1]);
    if apart(a, c) > apart(a, d) {
        std::mem::swap(&mut c, &mut d);
    }
    let fits = (a[2] - b[2]).abs() < LEVEL
        && (c[2] - d[2]).abs() < LEVEL
        && apart(a, c) < LEVEL
        && apart(b, d) < LEVEL
        && apart(a, b) > 10.0 * LEVEL
        && c[2] - a[2] > 10.0 * LEVEL;
    fits.then_some([[a, b], [c, d]])
}

impl Panel {
    /// Cuts the panel at a joint on one of its edges.
    fn cut(&self, joints: &mut Joints) -> Option<[Self; 2]> {
        let part = |foot: [usize; 2], head: [usize; 2]| Self {
            wall: self.wall,
            foot,
            head,
        };
        let [[a, b], [c, d]] = [self.foot, self.head];
        for edge in [[a, b], [c, d]] {
            if let Some(share) = joints.inside(edge) {
                let middle = [[a, b], [c, d]].map(|edge| joints.between(edge, share));
                let [foot, head] = middle;
                return Some([part([a, foot], [c, head]), part([foot, b], [head, d])]);
            }
        }
        for edge in [[a, c], [b, d]] {
            if let Some(share) = joints.inside(edge) {
                let [left, right] = [[a, c], [b, d]].map(|edge| joints.between(edge, share));
                return Some([part([a, b], [left, right]), part([left, right], [c, d])]);
            }
        }
        None
    }

    /// The elements of the panel.
    ///
    /// # Errors
    /// A wall without thickness or modulus.
    pub(crate) fn elements(
        &self,
        model: &TextModel,
        joints: &Joints,
        shares: &[[Shares; 6]],
        elements: &mut Vec<Element>,
    ) -> Result<(), InputError> {
        let wall = &model.walls[self.wall];
        let lacks = |problem: String| {
            Err(fault(
                &model.file,
                wall.shown.clone(),
                problem,
                "export the whole model again, with the properties of its walls",
            ))
        };
        let facts = model.wall_properties.get(&wall.property);
        let Some((facts, thickness)) = facts.and_then(|fact| {
            let thickness = wall.thickness.or(fact.thickness);
            Some((fact, thickness.filter(|t| *t > 0.0)?))
        }) else {
            return lacks(format!(
                "has the property \"{}\", of which the file has no thickness",
                wall.property
            ));
        };
        let name = wall.material.as_ref().unwrap_or(&facts.material);
        let material = model.materials.get(name);
        let Some([modulus, poisson]) = material.copied().filter(|material| material[0] > 0.0)
        else {
            return lacks(format!(
                "has the material \"{name}\", which has no modulus of elasticity"
            ));
        };
        let [along_height, in_shear, across, twist] =
            std::array::from_fn(|index| facts.factors[index] * wall.factors[index]);
        let [left, right] = self.foot.map(|joint| joints.at[joint]);
        let height = joints.at[self.head[0]][2] - left[2];
        let span = [right[0] - left[0], right[1] - left[1]];
        let length = span[0].hypot(span[1]);
        // Along the wall, and the axis about which it turns in its plane: along × up.
        let along = [span[0] / length, span[1] / length];
        let normal = [along[1], -along[0]];
        let angle = along[1].atan2(along[0]).to_degrees();
        let area = length * thickness;
        let bend = along_height * modulus * thickness * length.powi(3) / 12.0;
        let shear_modulus = modulus / (2.0 * (1.0 + poisson));
        let shear = in_shear * 5.0 / 6.0 * shear_modulus * area;
        let torsion = twist * shear_modulus * length * thickness.powi(3) / 3.0;
        let beam = |foot: [f64; 3], rigidity: [f64; 6]| Beam {
            ends: [foot, [foot[0], foot[1], foot[2] + height]],
            angle,
            rigidity,
            releases: [[false; 6]; 2],
            stiff_ends: [0.0; 2],
        };
        // The line between two corners rises on the right as it turns.
        let turn = |edge: [usize; 2]| {
            combined(&[
                (&shares[edge[1]][2], 1.0 / length),
                (&shares[edge[0]][2], -1.0 / length),
            ])
        };
        let mut rows: [Shares; 12] = Default::default();
        for (end, edge) in [self.foot, self.head].into_iter().enumerate() {
            for way in [0, 1, 2, 5] {
                rows[6 * end + way] = combined(&edge.map(|joint| (&shares[joint][way], 0.5)));
            }
            let turn = turn(edge);
            for way in 0..2 {
                rows[6 * end + 3 + way] = combined(&[(&turn, normal[way])]);
            }
        }
        let axial = along_height * modulus * area;
        let in_plane = [axial, shear, 0.0, torsion, 0.0, bend];
        elements.extend(
            beam(left, in_plane)
                .stiffness()
                .map(|stiffness| Element::new(rows, &stiffness)),
        );
        // Across the wall, strips at its edges bend, as wide as a member that meets them engages.
        let strip = (0.5 * length).min(STRIP * thickness);
        let weak = across * modulus * strip * thickness.powi(3) / 12.0;
        for side in 0..2 {
            let pair = [self.foot[side], self.head[side]];
            let rows = std::array::from_fn(|row| shares[pair[row / 6]][row % 6].clone());
            let half = beam(joints.at[pair[0]], [0.0, 0.0, 0.0, 0.0, weak, 0.0]);
            elements.extend(
                half.stiffness()
                    .map(|stiffness| Element::new(rows, &stiffness)),
            );
        }
        // A beam that meets a corner is clamped, by a spring as stiff as the panel.
        let clamp = 4.0 * bend / height;
        for edge in [self.foot, self.head] {
            for joint in edge {
                let [x, y] = [&shares[joint][3], &shares[joint][4]];
                let slip = combined(&[(x, normal[0]), (y, normal[1]), (&turn(edge), -1.0)]);
                elements.push(Element::spring(slip, clamp));
            }
        }
        Ok(())
    }
}
