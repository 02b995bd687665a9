//! The transfer path: which displacements a building has, and the order in which the recursion meets them.

use crate::element::{THETA, X, Y};
use crate::skeleton::{Skeleton, Support};

/// Degrees of freedom of a skeleton in the order of the transfer path.
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
    pub(crate) fn through(skeleton: &Skeleton) -> Self {
        let mut ties = Ties::new(skeleton);
        let mut last_met = vec![None; ties.len()];
        for (position, &node) in node_order(skeleton).iter().enumerate() {
            for component in [X, Y, THETA] {
                if let Some(root) = ties.root(node, component) {
                    last_met[root] = Some((position, component));
                }
            }
        }
        let mut roots: Vec<usize> = (0..last_met.len())
            .filter(|&root| last_met[root].is_some())
            .collect();
        roots.sort_by_key(|&root| last_met[root]);
        let mut number = vec![None; last_met.len()];
        for (dof, &root) in roots.iter().enumerate() {
            number[root] = Some(dof);
        }
        let dofs = (0..skeleton.nodes.len())
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

    /// Number of degrees of freedom.
    pub(crate) fn len(&self) -> usize {
        self.count
    }
}

/// Displacements merged by rigid connections.
struct Ties {
    parent: Vec<usize>,
}

/// Place of the ground in the forest.
const GROUND: usize = 0;

impl Ties {
    fn new(skeleton: &Skeleton) -> Self {
        let mut ties = Self {
            parent: (0..=3 * skeleton.nodes.len()).collect(),
        };
        for (node, properties) in skeleton.nodes.iter().enumerate() {
            let held: &[usize] = match properties.support {
                Support::Free => &[],
                Support::Fixed => &[X, Y, THETA],
                Support::Guided => &[Y, THETA],
            };
            for &component in held {
                ties.merge(Self::place(node, component), GROUND);
            }
        }
        for member in skeleton
            .members
            .iter()
            .filter(|member| member.axial_rigidity.is_none())
        {
            let axial = if member.is_vertical(&skeleton.nodes) {
                Y
            } else {
                X
            };
            ties.merge(
                Self::place(member.ends[0], axial),
                Self::place(member.ends[1], axial),
            );
        }
        for hinge in &skeleton.hinges {
            for component in [X, Y] {
                if hinge.translational_stiffness[component].is_none() {
                    ties.merge(
                        Self::place(hinge.ends[0], component),
                        Self::place(hinge.ends[1], component),
                    );
                }
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
        // The smaller place becomes the root, so that the ground always is one.
        self.parent[a.max(b)] = a.min(b);
    }

    fn root(&mut self, node: usize, component: usize) -> Option<usize> {
        Some(self.find(Self::place(node, component))).filter(|root| *root != GROUND)
    }
}

/// Nodes in the order of the transfer path.
fn node_order(skeleton: &Skeleton) -> Vec<usize> {
    // A node inside a beam or a column has elements of one direction only, two of them.
    let mut horizontal = vec![0; skeleton.nodes.len()];
    let mut vertical = vec![0; skeleton.nodes.len()];
    for member in &skeleton.members {
        let count = if member.is_vertical(&skeleton.nodes) {
            &mut vertical
        } else {
            &mut horizontal
        };
        member.ends.iter().for_each(|end| count[*end] += 1);
    }
    for end in skeleton.hinges.iter().flat_map(|hinge| hinge.ends) {
        horizontal[end] += 1;
    }
    let stage = |node: usize| match (horizontal[node], vertical[node]) {
        (2, 0) => 0,
        (0, 2) => 1,
        _ => 2,
    };
    let mut order: Vec<usize> = (0..skeleton.nodes.len()).collect();
    order.sort_by(|&a, &b| {
        let (p, q) = (&skeleton.nodes[a], &skeleton.nodes[b]);
        let along = match stage(a) {
            // Column by column within a storey is the same as height by height: the columns do not meet.
            1 => p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)),
            _ => p.y.total_cmp(&q.y).then(p.x.total_cmp(&q.x)),
        };
        stage(a).cmp(&stage(b)).then(along).then(a.cmp(&b))
    });
    order
}
