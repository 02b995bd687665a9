//! Gaps and links of a model, converted to contacts and elements between points.

use crate::contact_points::{PointPair, SAME, mean, point_pairs};
use crate::faces::{Face, Faces};
use crate::model::{Building, FloorPairs, Model, ModelFault};
use crate::system::{Contact, LinkElement, System};

/// Points of all gaps and links of a checked model.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    gaps: Vec<Joined>,
    links: Vec<Joined>,
}

/// The pairs of points of one gap or link.
#[derive(Clone, Debug)]
struct Joined {
    between: [Option<usize>; 2],
    pairs: Vec<PointPair>,
}

impl Row {
    pub(crate) fn of(model: &Model) -> Self {
        let joined = |between: [Option<usize>; 2], floors: &FloorPairs, tolerance: f64| Joined {
            between,
            pairs: point_pairs(floors, neighbours(model, between), tolerance).unwrap_or_default(),
        };
        let (gaps, links) = (model.gaps.iter(), model.links.iter());
        Self {
            gaps: gaps
                .map(|gap| joined(gap.between, &gap.floors, gap.level_tolerance))
                .collect(),
            links: links
                .map(|link| joined(link.between, &link.floors, link.level_tolerance))
                .collect(),
        }
    }

    /// Heights of the points on the left and on the right side of a building that are not floors \[m\].
    pub(crate) fn points_between_floors(&self, building: usize) -> [Vec<f64>; 2] {
        let mut points = [Vec::new(), Vec::new()];
        for joined in self.gaps.iter().chain(&self.links) {
            for side in 0..2 {
                if joined.between[side] == Some(building) {
                    // Contact points of the right neighbour are on its left side.
                    let face: &mut Vec<f64> = &mut points[1 - side];
                    face.extend(joined.pairs.iter().filter_map(|pair| pair[side]));
                }
            }
        }
        for face in &mut points {
            face.sort_by(f64::total_cmp);
            face.dedup_by(|a, b| (*a - *b).abs() <= SAME);
        }
        points
    }

    /// Adds contacts and links to a system of the buildings of the model.
    ///
    /// # Errors
    /// Points without a horizontal degree of freedom.
    pub(crate) fn put_into(
        &self,
        system: &mut System,
        model: &Model,
    ) -> Result<(), Vec<ModelFault>> {
        let mut faults = Vec::new();
        for (index, (gap, joined)) in model.gaps.iter().zip(&self.gaps).enumerate() {
            let mut contacts = Vec::new();
            for (entry, pair) in joined.pairs.iter().enumerate() {
                match faces(system, joined.between, pair) {
                    Ok(faces) => {
                        let [left, right] = faces.masses();
                        contacts.push(Contact {
                            gap: index,
                            width: gap.width_of(entry),
                            law: gap.law.between(left, right),
                            ..Contact::without_law(faces)
                        });
                    }
                    Err(problem) => faults.push(ModelFault {
                        path: format!("gap[{index}].floors"),
                        problem,
                    }),
                }
            }
            contacts.sort_by(|a, b| a.height.total_cmp(&b.height));
            system.contacts.extend(contacts);
        }
        for (index, (link, joined)) in model.links.iter().zip(&self.links).enumerate() {
            let mut pairs = joined.pairs.clone();
            pairs.sort_by(|a, b| mean(a).total_cmp(&mean(b)));
            for pair in &pairs {
                match faces(system, joined.between, pair) {
                    Ok(faces) => {
                        let element = LinkElement {
                            link: index,
                            faces,
                            height: faces.height(),
                            stiffness: link.stiffness,
                            damping: link.damping,
                            closing_at_rest: closing_at_rest(system, &faces),
                        };
                        system.links.push(element);
                    }
                    Err(problem) => faults.push(ModelFault {
                        path: format!("link[{index}].floors"),
                        problem,
                    }),
                }
            }
        }
        if faults.is_empty() {
            Ok(())
        } else {
            Err(faults)
        }
    }
}

/// The buildings on both sides; `None` is a wall.
pub(crate) fn neighbours(model: &Model, between: [Option<usize>; 2]) -> [Option<&Building>; 2] {
    between.map(|side| side.and_then(|building| model.buildings.get(building)))
}

fn faces(system: &System, between: [Option<usize>; 2], pair: &PointPair) -> Result<Faces, String> {
    let mut faces: [Option<Face>; 2] = [None; 2];
    for side in 0..2 {
        let (Some(building), Some(height)) = (between[side], pair[side]) else {
            continue;
        };
        let idealisation = &system.buildings[building].idealisation;
        let face = if side == 0 {
            &idealisation.right_face
        } else {
            &idealisation.left_face
        };
        let nodes = &idealisation.skeleton.nodes;
        let node = face
            .iter()
            .copied()
            .find(|&node| (nodes[node].y - height).abs() <= 2.0 * SAME)
            .ok_or_else(|| format!("no point to hit at {height:.3} m"))?;
        faces[side] = Some(system.face(building, node)?);
    }
    Ok(Faces(faces))
}

/// Closing due to gravity \[m\].
fn closing_at_rest(system: &System, faces: &Faces) -> f64 {
    let displacement = |face: Face| {
        let building = &system.buildings[face.building];
        let own = building.rest.get(face.dof - building.offset);
        own.copied().unwrap_or(0.0)
    };
    faces
        .sides()
        .map(|(face, sign)| -sign * displacement(face))
        .sum()
}
