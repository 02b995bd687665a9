//! Displacements that are equal, as constraints of OpenSees.
//!
//! OpenSees' transformation handler takes one constraint for a node, and none for the node that others follow: it
//! applies the first and ignores the rest. So horizontal ties come first, and anything that would need a second
//! constraint is left to very stiff elements.
//!
//! Buildings on a foundation or with rigid arms need `Plain`, which ties single displacements: there every displacement has a constraint of
//! its own.

use std::collections::BTreeMap;

use jostle::structure::{StickModel, Support};

/// Horizontal, vertical, rotation.
pub(super) const COMPONENTS: usize = 3;
const HORIZONTAL: usize = 0;
const VERTICAL: usize = 1;
pub(super) const ROTATION: usize = 2;
/// Nodes closer than this lie on one line \[m\].
pub(super) const SAME_LINE: f64 = 1e-9;

/// How every displacement of one building is held.
pub(super) struct Ties {
    /// (node, component) that stand still although their node is free: members that keep their length hold them.
    pub(super) held: Vec<(usize, usize)>,
    /// Node that is followed, node that follows, components.
    pub(super) followed: Vec<(usize, usize, Vec<usize>)>,
    /// By (node, component): whether a constraint determines it.
    constrained: Vec<[bool; COMPONENTS]>,
    classes: Vec<usize>,
}

/// Whether the supports hold a component.
pub(super) fn is_held_by(support: Support, component: usize) -> bool {
    match support {
        Support::Free => false,
        Support::Fixed => true,
        Support::Guided => component != 0,
        Support::Turning => component != 2,
        Support::Swaying => component == 2,
    }
}

/// Whether supports hold a component of a node: below columns and floors on a foundation, only what it holds.
pub(super) fn is_held(stick_model: &StickModel, node: usize, component: usize) -> bool {
    let support = stick_model.nodes[node].support;
    let Some(foundation) = &stick_model.foundation else {
        return is_held_by(support, component);
    };
    let lifts = !stick_model.bed.is_empty();
    match component {
        HORIZONTAL if node == foundation.node && !foundation.sways => true,
        // Floors of a shear building rise with a foundation that lifts off.
        VERTICAL if lifts && support == Support::Guided => false,
        VERTICAL if node == foundation.node || stands_above(stick_model, node) => !lifts,
        // Floors of a shear building turn with their foundation.
        ROTATION if support == Support::Guided => false,
        _ => is_held_by(support, component),
    }
}

/// Whether a node rises with a foundation as its node does, at no distance from it.
fn stands_above(stick_model: &StickModel, node: usize) -> bool {
    let lever = stick_model.lever(node);
    lever.is_some_and(|lever| lever.abs() <= SAME_LINE)
}

impl Ties {
    pub(super) fn new(stick_model: &StickModel) -> Self {
        let mut union = Union::new(stick_model.nodes.len() * COMPONENTS);
        let place = |node: usize, component: usize| node * COMPONENTS + component;
        for member in &stick_model.members {
            if member.axial_rigidity.is_none() {
                let [a, b] = member.ends;
                let along = usize::from(is_vertical(stick_model, member.ends));
                union.join(place(a, along), place(b, along));
            }
        }
        for hinge in &stick_model.hinges {
            let [a, b] = hinge.ends;
            for (component, stiffness) in stiffnesses(hinge).into_iter().enumerate() {
                if stiffness.is_none() {
                    union.join(place(a, component), place(b, component));
                }
            }
        }
        if let Some(foundation) = &stick_model.foundation {
            let lifts = !stick_model.bed.is_empty();
            for foot in &foundation.feet {
                for component in [HORIZONTAL, ROTATION] {
                    union.join(place(*foot, component), place(foundation.node, component));
                }
                if lifts && stands_above(stick_model, *foot) {
                    union.join(place(*foot, VERTICAL), place(foundation.node, VERTICAL));
                }
            }
            for (node, stick_node) in stick_model.nodes.iter().enumerate() {
                if stick_node.support == Support::Guided {
                    union.join(place(node, ROTATION), place(foundation.node, ROTATION));
                    if lifts {
                        union.join(place(node, VERTICAL), place(foundation.node, VERTICAL));
                    }
                }
            }
        }
        // Arms and foundations need the handler `Plain`, which every building in one plane has.
        let single = !stick_model.ties.is_empty();
        let classes: Vec<usize> = (0..stick_model.nodes.len() * COMPONENTS)
            .map(|at| union.root(at))
            .collect();
        let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (at, class) in classes.iter().enumerate() {
            members.entry(*class).or_default().push(at);
        }
        let mut ties = Self {
            held: Vec::new(),
            followed: Vec::new(),
            constrained: vec![[false; COMPONENTS]; stick_model.nodes.len()],
            classes,
        };
        let (mut leader, mut is_leader) = (
            vec![None; stick_model.nodes.len()],
            vec![false; stick_model.nodes.len()],
        );
        // Horizontal ties first: they make the floors.
        let mut of_component: Vec<&Vec<usize>> = members.values().collect();
        of_component.sort_by_key(|class| (class[0] % COMPONENTS == VERTICAL, class[0]));
        for class in of_component {
            let component = class[0] % COMPONENTS;
            let nodes: Vec<usize> = class.iter().map(|at| at / COMPONENTS).collect();
            let is_support = |node: &usize| is_held(stick_model, *node, component);
            if nodes.iter().any(is_support) {
                for node in nodes {
                    ties.constrained[node][component] = true;
                    if !is_support(&node) {
                        ties.held.push((node, component));
                    }
                }
                continue;
            }
            let [first, others @ ..] = &nodes[..] else {
                continue;
            };
            let possible = single
                || leader[*first].is_none()
                    && others.iter().all(|node| {
                        !is_leader[*node] && leader[*node].is_none_or(|known| known == *first)
                    });
            if others.is_empty() || !possible {
                continue;
            }
            is_leader[*first] = true;
            ties.constrained[*first][component] = true;
            for node in others {
                leader[*node] = Some(*first);
                ties.constrained[*node][component] = true;
                let known = ties
                    .followed
                    .iter_mut()
                    .find(|(a, b, _)| (a, b) == (first, node));
                match known {
                    Some((_, _, components)) => components.push(component),
                    None => ties.followed.push((*first, *node, vec![component])),
                }
            }
        }
        ties
    }

    /// The node whose displacement that of a node is equal to, for buildings on a foundation: it may be the node itself.
    pub(super) fn followed_by(&self, node: usize, component: usize) -> usize {
        self.classes[node * COMPONENTS + component] / COMPONENTS
    }

    /// Whether two displacements are equal by a constraint or a support.
    pub(super) fn are_tied(&self, ends: [usize; 2], component: usize) -> bool {
        let [a, b] = ends.map(|node| self.classes[node * COMPONENTS + component]);
        a == b && ends.iter().all(|node| self.constrained[*node][component])
    }
}

/// Whether both ends lie on one vertical.
pub(super) fn is_vertical(stick_model: &StickModel, ends: [usize; 2]) -> bool {
    let [a, b] = ends.map(|end| stick_model.nodes[end]);
    (b.y - a.y).abs() > (b.x - a.x).abs()
}

/// Stiffness of a hinge in x, y, θ; `None` is rigid.
pub(super) fn stiffnesses(hinge: &jostle::structure::Hinge) -> [Option<f64>; COMPONENTS] {
    let [horizontal, vertical] = hinge.translational_stiffness;
    [horizontal, vertical, hinge.rotational_stiffness]
}

/// Sets that grow together.
struct Union(Vec<usize>);

impl Union {
    fn new(len: usize) -> Self {
        Self((0..len).collect())
    }

    fn root(&self, mut at: usize) -> usize {
        while self.0[at] != at {
            at = self.0[at];
        }
        at
    }

    /// The lower index represents both.
    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}
