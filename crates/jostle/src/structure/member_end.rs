//! Rotation of a member end in double curvature: sum of hinge rotation and member bending.

use crate::hysteresis::{Hysteresis, Side};
use crate::structure::StickModel;
use crate::structure::element::places;

/// Stiffness 6 EI/L of the member behind every hinge that yields, in the order of the hinges, antisymmetric bending
/// between its two ends, less with shear deformation; `None` where no member is found \[N·m/rad\].
#[must_use]
pub(crate) fn end_stiffnesses(stick_model: &StickModel) -> Vec<Option<f64>> {
    let mut at_node: Vec<Vec<usize>> = vec![Vec::new(); stick_model.nodes.len()];
    for (index, member) in stick_model.members.iter().enumerate() {
        member.ends.iter().for_each(|end| at_node[*end].push(index));
    }
    let mut hinged = vec![false; stick_model.nodes.len()];
    for hinge in &stick_model.hinges {
        hinge.ends.iter().for_each(|end| hinged[*end] = true);
    }
    let yielding = stick_model.hinges.iter().filter(|h| h.hysteresis.is_some());
    // A hinge where a column is struck lies between two segments that follow each other, and does not end the column.
    let run = |member: usize| {
        let [a, b] = stick_model.members[member]
            .ends
            .map(|end| stick_model.nodes[end]);
        [b.x - a.x, b.y - a.y]
    };
    let beyond = |node: usize, from: usize| {
        let mut hinges = stick_model.hinges.iter();
        let hinge = hinges.find(|hinge| hinge.ends.contains(&node))?;
        let other = hinge.ends[usize::from(hinge.ends[0] == node)];
        let [next] = at_node[other][..] else {
            return None;
        };
        let ([x, y], [next_x, next_y]) = (run(from), run(next));
        let continues = next.abs_diff(from) == 1 && x * next_y == y * next_x;
        continues.then_some(other)
    };
    // In a space frame k₁₁ + k₁₂ is that stiffness.
    let mut in_space = vec![None; stick_model.nodes.len()];
    for element in &stick_model.space_elements {
        let entries = 0..element.deformations().len();
        let bent: f64 = entries.map(|end| element.entry(0, end)).sum();
        for ((node, _), _) in element.deformations().iter().flat_map(places) {
            if stick_model.space_ends.contains(&node) {
                // A column in parts bends as a whole.
                let whole = stick_model.double_curvature.get(&node);
                in_space[node] = Some(whole.copied().unwrap_or(bent));
            }
        }
    }
    yielding
        .map(|hinge| {
            if let Some(space) = hinge.ends.iter().find_map(|end| in_space[*end]) {
                return Some(space);
            }
            // The end that is not a joint has one member only; follow its segments from there.
            let ends = hinge.ends.iter();
            let start = *ends.max().filter(|end| at_node[**end].len() == 1)?;
            let (mut node, mut from, mut length) = (start, at_node[start][0], 0.0);
            let section = stick_model.members[from];
            loop {
                let member = &stick_model.members[from];
                let other = member.ends[usize::from(member.ends[0] == node)];
                let [a, b] = [node, other].map(|n| stick_model.nodes[n]);
                length += libm::hypot(b.x - a.x, b.y - a.y);
                node = match at_node[other].len() {
                    1 => beyond(other, from).unwrap_or(other),
                    _ => other,
                };
                let next = at_node[node].iter().find(|member| **member != from);
                match next {
                    Some(next) if node != other => from = *next,
                    Some(next) if at_node[node].len() == 2 && !hinged[node] => from = *next,
                    _ => break,
                }
            }
            let bending = 6.0 * section.flexural_rigidity / length;
            let shear = section.shear_rigidity.map_or(0.0, |rigidity| {
                12.0 * section.flexural_rigidity / (rigidity * length * length)
            });
            Some(bending / (1.0 + shear))
        })
        .collect()
}

/// Greatest deformation of a side over that of yield, elastic member end included, so that rigid hinges have a
/// ductility as well \[–\].
pub(crate) fn ductility(
    hysteresis: &Hysteresis,
    greatest: f64,
    side: Side,
    end_stiffness: Option<f64>,
) -> f64 {
    let curve = hysteresis.backbone().side(side);
    let bent = |force: f64| end_stiffness.map_or(0.0, |stiffness| force / stiffness);
    let yielding = curve.yielding;
    (greatest + bent(curve.force_at(greatest))) / (yielding.deformation + bent(yielding.force))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hysteresis::{Backbone, Corners, HysteresisRule};
    use crate::model::{Building, Damping, Frame, FrameHinges, Hinges, Joint, Section, Structure};
    use crate::structure::Discretization;

    fn spring(initial: f64) -> Hysteresis {
        let corners = Corners::bilinear(300e3, 1e-5);
        let backbone = Backbone::from_forces(initial, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound")
    }

    #[test]
    fn every_hinge_finds_its_member_whatever_its_segments() {
        let section = |flexural_rigidity| Section {
            flexural_rigidity,
            axial_rigidity: None,
            shear_rigidity: None,
            line_mass: 500.0,
        };
        let mut frame = Frame {
            storey_heights: vec![4.0, 3.0],
            spans: vec![2.5, 6.0],
            columns: vec![section(150e6), section(120e6)],
            beams: vec![section(90e6); 2],
            beam_mass: vec![3000.0; 2],
            floor_mass: vec![0.0; 2],
            column_segments: 4,
            beam_segments: vec![3, 5],
            joint: Joint {
                rotational_stiffness: Some(1e8),
                ..Joint::default()
            },
            ..Frame::default()
        };
        let hinge = spring(1e9);
        let mut expected = Vec::new();
        for (storey, column) in [6.0 * 150e6 / 4.0, 6.0 * 120e6 / 3.0]
            .into_iter()
            .enumerate()
        {
            expected.extend([column; 6]);
            let rigidity = frame.beams[storey].flexural_rigidity;
            expected.extend([6.0 * rigidity / 2.5; 2]);
            expected.extend([6.0 * rigidity / 6.0; 2]);
        }
        for shear in [None, Some(5e8)] {
            frame
                .beams
                .iter_mut()
                .for_each(|beam| beam.shear_rigidity = shear);
            let building = Building {
                name: "A".into(),
                structure: Structure::Frame(frame.clone()),
                damping: Damping::Rayleigh {
                    alpha: 0.0,
                    beta: 0.0,
                },
                hinges: Some(Hinges::Frame(FrameHinges {
                    columns: vec![vec![hinge; 3]; 2],
                    beams: vec![vec![hinge; 2]; 2],
                    ..FrameHinges::default()
                })),
                ..Building::default()
            };
            let found = end_stiffnesses(&Discretization::new(&building).stick_model);
            assert_eq!(found.len(), expected.len());
            for (index, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let mut expected = *expected;
                if let (Some(shear), 6..=9 | 16..=19) = (shear, index) {
                    let length = [2.5, 6.0][usize::from((index - 6) % 10 > 1)];
                    expected /= 1.0 + 12.0 * 90e6 / (shear * length * length);
                }
                let found = found.expect("a member");
                assert!(
                    (found / expected - 1.0).abs() < 1e-12,
                    "{index}: {found}, not {expected}"
                );
            }
        }
    }

    #[test]
    fn a_rigid_hinge_counts_with_the_bending_of_its_member() {
        let hinge = spring(1e14);
        // 300 kN·m bend the end by 3 mrad; the hinge rotates by 6 mrad.
        let ductility = ductility(&hinge, 6e-3, Side::Positive, Some(1e8));
        assert!(
            (ductility - (6e-3 + (300e3 + 1e9 * 6e-3) / 1e8) / 3e-3).abs() < 1e-3,
            "{ductility}"
        );
    }

    #[test]
    fn without_a_member_it_is_that_of_the_spring() {
        let storey = spring(1e8);
        assert!((ductility(&storey, 9e-3, Side::Negative, None) - 3.0).abs() < 1e-12);
    }
}
