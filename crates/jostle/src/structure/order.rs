//! The order in which nodes are eliminated along the transfer path.

use super::StickModel;
use crate::linear::sort_by;

/// What is eliminated side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Insides of beams, from their left ends on.
    Beams,
    /// Insides of columns between floors, upwards.
    Columns,
    /// Joints and floors, one by one.
    Joints,
}

/// When a node is eliminated among others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Its stage; `None` follows from the elements that meet at it.
    pub stage: Option<Stage>,
    /// Those of a stage come from the ground up: height above the base \[m\].
    pub height: f64,
    /// The frame in which it stands, where several stand in a plan.
    pub elevation: usize,
    /// Place within it, from left to right.
    pub position: f64,
}

impl Turn {
    /// The elevation of floors, which come after all frames that they tie.
    pub const FLOORS: usize = usize::MAX;

    /// Of a floor, or a mat, that ties all that stands on it: after what is at its height, and not before the height of the `lowest`
    /// floor.
    pub(super) fn of_floor(height: f64, lowest: f64) -> Self {
        Self {
            stage: None,
            height: height.max(lowest),
            elevation: Self::FLOORS,
            position: 0.0,
        }
    }
}

impl StickModel {
    /// When a node is eliminated: as its builder says, or from where it stands.
    #[must_use]
    pub fn turn(&self, node: usize) -> Turn {
        let model_node = &self.nodes[node];
        self.turns.get(&node).copied().unwrap_or(Turn {
            stage: None,
            height: model_node.y,
            elevation: 0,
            position: model_node.x,
        })
    }
}

/// What a node is eliminated with: every link of all chains at once, every joint by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Rank {
    stage: Stage,
    link: usize,
}

/// Nodes in the order of the transfer path: all beams at once, step by step from their left ends; all columns
/// between floors at once, step by step upwards; then the floors. The beams do not meet, and taking them
/// side by side keeps a processor busy that would otherwise wait for every link of a single chain.
///
/// Every node comes with its rank: nodes side by side share one, every joint has its own.
pub(super) fn node_order(stick_model: &StickModel) -> Vec<(Rank, usize)> {
    let nodes = &stick_model.nodes;
    let mut neighbours = vec![Vec::new(); nodes.len()];
    let (mut horizontal, mut vertical) = (vec![0; nodes.len()], vec![0; nodes.len()]);
    let members = stick_model
        .members
        .iter()
        .map(|member| (member.ends, member.is_vertical(nodes)));
    // A hinge belongs to the member at whose end it is: the one with no other element there.
    let mut at_end = vec![[0; 2]; nodes.len()];
    for member in &stick_model.members {
        for end in member.ends {
            at_end[end][usize::from(member.is_vertical(nodes))] += 1;
        }
    }
    let hinges = stick_model.hinges.iter().map(|hinge| {
        let [mut beam, mut column] = [false; 2];
        for end in hinge.ends {
            beam |= at_end[end] == [1, 0];
            column |= at_end[end] == [0, 1];
        }
        (hinge.ends, column && !beam)
    });
    for ([a, b], is_vertical) in members.chain(hinges) {
        neighbours[a].push(b);
        neighbours[b].push(a);
        let count = if is_vertical {
            &mut vertical
        } else {
            &mut horizontal
        };
        count[a] += 1;
        count[b] += 1;
    }
    let turns: Vec<Turn> = (0..nodes.len())
        .map(|node| stick_model.turn(node))
        .collect();
    // An interior node of a beam or a column has two elements of one direction.
    let stage = |node: usize| {
        turns[node]
            .stage
            .unwrap_or(match (horizontal[node], vertical[node]) {
                (2, 0) => Stage::Beams,
                (0, 2) => Stage::Columns,
                _ => Stage::Joints,
            })
    };
    let from_left = |a: &usize, b: &usize| {
        let (p, q) = (&turns[*a], &turns[*b]);
        let elevations = p.elevation.cmp(&q.elevation);
        elevations.then(p.position.total_cmp(&q.position))
    };
    let upwards = |a: &usize, b: &usize| turns[*a].height.total_cmp(&turns[*b].height);
    let by_height =
        |a: &usize, b: &usize| upwards(a, b).then_with(|| from_left(a, b)).then(a.cmp(b));
    let along_column =
        |a: &usize, b: &usize| from_left(a, b).then_with(|| upwards(a, b)).then(a.cmp(b));
    let of_stage = |wanted: Stage| (0..nodes.len()).filter(move |&node| stage(node) == wanted);
    let mut order: Vec<(Rank, usize)> = Vec::new();
    for inside in [Stage::Beams, Stage::Columns] {
        let mut interior: Vec<usize> = of_stage(inside).collect();
        if inside == Stage::Beams {
            sort_by(&mut interior, by_height);
        } else {
            sort_by(&mut interior, along_column);
        }
        let mut chains: Vec<Vec<usize>> = Vec::new();
        for &node in &interior {
            match chains.last_mut() {
                Some(chain)
                    if chain
                        .last()
                        .is_some_and(|last| neighbours[node].contains(last)) =>
                {
                    chain.push(node);
                }
                _ => chains.push(vec![node]),
            }
        }
        // Longest first: chains that are parallel at one link are parallel at every link before. Upwards, so that
        // those on the ground, with one end less, are adjacent.
        sort_by(&mut chains, |a, b| {
            b.len().cmp(&a.len()).then_with(|| by_height(&a[0], &b[0]))
        });
        let longest = chains.first().map_or(0, Vec::len);
        for link in 0..longest {
            let side_by_side = chains.iter().filter_map(|chain| chain.get(link));
            let rank = Rank {
                stage: inside,
                link,
            };
            order.extend(side_by_side.map(|&node| (rank, node)));
        }
    }
    let mut joints: Vec<usize> = of_stage(Stage::Joints).collect();
    sort_by(&mut joints, by_height);
    order.extend(joints.into_iter().enumerate().map(|(link, node)| {
        let stage = Stage::Joints;
        (Rank { stage, link }, node)
    }));
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::testkit::frame;

    /// Nodes whose builder says when they are eliminated may stand anywhere.
    #[test]
    fn coordinates_do_not_matter_where_turns_are_given() {
        let mut sticks = frame(true).discretization.stick_model;
        let expected = node_order(&sticks);
        for (rank, node) in &expected {
            let turn = Turn {
                stage: Some(rank.stage),
                ..sticks.turn(*node)
            };
            sticks.turns.insert(*node, turn);
        }
        for (index, node) in sticks.nodes.iter_mut().enumerate() {
            (node.x, node.y) = (-(index as f64), (7 * index % 5) as f64);
        }
        assert_eq!(node_order(&sticks), expected);
    }

    /// A floor comes after what is at its height, and a mat just before the lowest floor.
    #[test]
    fn floors_follow_the_joints_that_they_tie() {
        let mut sticks = StickModel::default();
        let nodes = [0.0, 3.0, 3.0, 6.0].map(|height| sticks.add_node(0.0, height));
        let [mat, floor, joint, roof] = nodes;
        for (node, height) in [(mat, 0.0), (floor, 3.0), (roof, 6.0)] {
            sticks.turns.insert(node, Turn::of_floor(height, 3.0));
        }
        let order: Vec<usize> = node_order(&sticks)
            .into_iter()
            .map(|node_order| node_order.1)
            .collect();
        assert_eq!(order, [joint, mat, floor, roof]);
    }
}
