//! The transfer path: displacements of a building in the order of the recursion.

use crate::linear::{Row, sort_by_key};
use crate::structure::element::{THETA, X, Y, index_of, place_of, places};
use crate::structure::order::{Rank, node_order};
use crate::structure::{StickModel, Support};

/// Degrees of freedom of a stick model in the order of the transfer path.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    /// Degree of freedom of (node, component); `None` where the node moves with the ground.
    dofs: Vec<[Option<usize>; 3]>,
    count: usize,
}

impl Path {
    /// Ties axially rigid members and rigid hinges together (theory, Eq. K4) and orders what remains: beam
    /// interiors from left to right, column interiors upwards, then the floors upwards. A displacement
    /// shared by several nodes comes when the last of them does.
    pub(crate) fn through(stick_model: &StickModel) -> Self {
        let mut ties = Ties::new(stick_model);
        let mut last_met: Vec<Option<(Rank, usize, usize)>> = vec![None; ties.len()];
        for (position, &(rank, node)) in node_order(stick_model).iter().enumerate() {
            for component in [X, Y, THETA] {
                if let Some(root) = ties.root(node, component) {
                    // Within a rank equal components are adjacent: long runs of equal work.
                    last_met[root] = Some((rank, component, position));
                }
            }
        }
        // Storeys deform by the rotation of their foundation, and rise with it: it comes after the last of them, and leaves no fill-in.
        if let Some(foundation) = &stick_model.foundation {
            let moves = [Y, THETA];
            let stands = |node: &usize| {
                let carried = stick_model.ties.contains_key(&index_of((*node, Y)));
                let mut springs = stick_model.springs.iter();
                carried
                    || springs.any(|spring| spring.lever.is_some() && spring.ends.contains(node))
            };
            let order = node_order(stick_model);
            let mut last = order.iter().enumerate();
            let last = last.rfind(|(_, (_, node))| stands(node));
            if let Some((position, &(rank, _))) = last {
                for component in moves {
                    if let Some(root) = ties.root(foundation.node, component) {
                        let after = Some((rank, component, position));
                        last_met[root] = last_met[root].max(after);
                    }
                }
            }
        }
        let mut roots: Vec<usize> = (0..last_met.len())
            .filter(|&root| last_met[root].is_some())
            .collect();
        sort_by_key(&mut roots, |&root| last_met[root]);
        let mut number = vec![None; last_met.len()];
        for (dof, &root) in roots.iter().enumerate() {
            number[root] = Some(dof);
        }
        let dofs = (0..stick_model.nodes.len())
            .map(|node| {
                [X, Y, THETA]
                    .map(|component| ties.root(node, component).and_then(|root| number[root]))
            })
            .collect();
        Self {
            dofs,
            count: roots.len(),
        }
    }

    /// Degree of freedom of a displacement of a node.
    pub(crate) fn dof(&self, node: usize, component: usize) -> Option<usize> {
        self.dofs[node][component]
    }

    /// A row over displacements of nodes as one over degrees of freedom; the ground does not move.
    pub(crate) fn row(&self, over_nodes: &Row) -> Row {
        let moved = places(over_nodes).filter(|(_, share)| *share != 0.0);
        let row: Row = moved
            .filter_map(|((node, component), share)| Some((self.dof(node, component)?, share)))
            .collect();
        // Nodes that move together have one term: tangents of springs are products of every two.
        let dofs = row.entries();
        let repeats = |(index, (dof, _)): (usize, &(usize, f64))| {
            dofs[..index].iter().any(|(known, _)| known == dof)
        };
        if dofs.iter().enumerate().any(repeats) {
            row.merged()
        } else {
            row
        }
    }

    /// Number of degrees of freedom.
    pub(crate) fn len(&self) -> usize {
        self.count
    }
}

/// Displacements merged by rigid connections.
struct Ties {
    parent: Vec<usize>,
}

/// Index of the ground in the forest.
const GROUND: usize = 0;

impl Ties {
    fn new(stick_model: &StickModel) -> Self {
        let mut ties = Self {
            parent: (0..=3 * stick_model.nodes.len()).collect(),
        };
        for (node, properties) in stick_model.nodes.iter().enumerate() {
            let held: &[usize] = match properties.support {
                Support::Free => &[],
                Support::Fixed => &[X, Y, THETA],
                Support::Guided => &[Y, THETA],
                Support::Turning => &[X, Y],
                Support::Swaying => &[THETA],
            };
            for &component in held {
                ties.merge(Self::place(node, component), GROUND);
            }
        }
        for member in stick_model
            .members
            .iter()
            .filter(|member| member.axial_rigidity.is_none())
        {
            let axial = if member.is_vertical(&stick_model.nodes) {
                Y
            } else {
                X
            };
            ties.merge(
                Self::place(member.ends[0], axial),
                Self::place(member.ends[1], axial),
            );
        }
        for hinge in &stick_model.hinges {
            let [horizontal, vertical] = hinge.translational_stiffness;
            let directions = [horizontal, vertical, hinge.rotational_stiffness];
            for (component, stiffness) in directions.into_iter().enumerate() {
                if stiffness.is_none() {
                    ties.merge(
                        Self::place(hinge.ends[0], component),
                        Self::place(hinge.ends[1], component),
                    );
                }
            }
        }
        // What moves with others is no displacement of its own.
        for index in stick_model.ties.keys() {
            let (node, component) = place_of(*index);
            ties.merge(Self::place(node, component), GROUND);
        }
        if let Some(foundation) = &stick_model.foundation {
            for &foot in &foundation.feet {
                for component in [X, THETA] {
                    ties.merge(
                        Self::place(foot, component),
                        Self::place(foundation.node, component),
                    );
                }
            }
            // Without contact springs it does not rise.
            let held = [(X, !foundation.sways), (Y, stick_model.bed.is_empty())];
            for (component, _) in held.into_iter().filter(|(_, held)| *held) {
                ties.merge(Self::place(foundation.node, component), GROUND);
            }
        }
        ties
    }

    fn len(&self) -> usize {
        self.parent.len()
    }

    fn place(node: usize, component: usize) -> usize {
        1 + 3 * node + component
    }

    fn find(&mut self, mut place: usize) -> usize {
        while self.parent[place] != place {
            self.parent[place] = self.parent[self.parent[place]];
            place = self.parent[place];
        }
        place
    }

    fn merge(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        // The smaller index becomes the root, so the ground is always a root.
        self.parent[a.max(b)] = a.min(b);
    }

    fn root(&mut self, node: usize, component: usize) -> Option<usize> {
        Some(self.find(Self::place(node, component))).filter(|root| *root != GROUND)
    }
}
