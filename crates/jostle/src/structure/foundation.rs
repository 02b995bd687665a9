//! Buildings on rigid foundations.

use super::Discretization;
use super::element::{Element, Part, Place, THETA, X, Y, index_of, over_nodes, places};
use super::spring_place::SpringPlace;
use super::stick_model::{RigidFoundation, StickModel, Support, YieldingElement};
use crate::hysteresis::Hysteresis;
use crate::linear::Row;
use crate::model::{BedSpring, Foundation, ProportionalDamping};

/// Springs and dashpots under a rigid foundation.
#[derive(Clone, Debug, Default)]
pub(crate) struct Subgrade {
    /// Stiffness over displacement and rotation: uu, uθ, θθ \[N/m, N, N·m\].
    pub(crate) stiffness: [f64; 3],
    /// Dashpots over the same \[N·s/m, N·s, N·m·s\].
    pub(crate) damping: [f64; 3],
    /// Whether the foundation moves sideways.
    pub(crate) sways: bool,
    /// Contact springs, which then resist rotation; empty under a foundation that does not rise.
    pub(crate) bed: Vec<BedSpring>,
    /// Dashpot against rising and sinking \[N·s/m\].
    pub(crate) vertical_damping: f64,
}

impl Discretization {
    /// The node on which the building stands, if it can move: that of its foundation, its mat, or the last of its feet on springs. Ends of
    /// columns beyond hinges stand at the same height, but come after the first floor.
    pub(crate) fn base_node(&self) -> Option<usize> {
        let StickModel {
            nodes, foundation, ..
        } = &self.stick_model;
        if let Some(foundation) = foundation {
            return Some(foundation.node);
        }
        let feet = nodes.iter().take_while(|node| node.y == 0.0).count();
        let mut feet = nodes[..feet].iter();
        feet.rposition(|node| node.support != Support::Fixed)
    }

    /// Puts the feet of the building, which are fixed so far, on a rigid foundation on springs and dashpots: its middle lies
    /// below the middle of the building. Storeys of a shear building deform by w_i = u_i − u_f + h_i θ (theory, Eq. B22).
    pub(crate) fn put_on_foundation(&mut self, foundation: &Foundation, under: &Subgrade) {
        let lifts = !under.bed.is_empty();
        let sticks = &mut self.stick_model;
        let mut feet: Vec<usize> = (0..sticks.nodes.len())
            .filter(|&node| sticks.nodes[node].support == Support::Fixed)
            .collect();
        let (Some(&first), Some(&last)) = (feet.first(), feet.last()) else {
            return;
        };
        for &foot in &feet {
            sticks.nodes[foot].support = Support::Free;
        }
        let middle = 0.5 * (sticks.nodes[first].x + sticks.nodes[last].x);
        let plate = match feet.len() {
            1 => first,
            _ => sticks.add_node(middle, 0.0),
        };
        let stick_node = &mut sticks.nodes[plate];
        stick_node.add_mass(foundation.mass);
        *stick_node = stick_node.with_rotary_inertia(foundation.rotary_inertia);
        let mut node = plate;
        if lifts && plate != first {
            // It rises about the centre of what it carries, with its own mass at its middle.
            feet.push(plate);
            let centre = centre_of_what_rises(sticks, &feet, middle);
            node = sticks.add_node(centre, 0.0);
        }
        let centre = sticks.nodes[node].x;
        for spring in &mut sticks.springs {
            let [lower, upper] = spring.ends.map(|end| sticks.nodes[end].y);
            spring.lever = Some(upper - lower);
        }
        if plate != first {
            let levers = levers(sticks, &feet, centre).into_iter().enumerate();
            let ties = levers.filter_map(|(at, lever)| {
                let turned = ((node, THETA), lever?);
                let raised = lifts.then_some(((node, Y), 1.0));
                Some((
                    index_of((at, Y)),
                    over_nodes(raised.into_iter().chain([turned])),
                ))
            });
            // Faces of walls follow their axes, which now follow the foundation.
            let faces = std::mem::take(&mut sticks.ties);
            sticks.ties.extend(ties);
            let faces = faces.into_iter();
            let faces: Vec<_> = faces
                .map(|(index, row)| (index, sticks.carried_row(&row)))
                .collect();
            sticks.ties.extend(faces);
        }
        if lifts {
            // Floors that do not turn rise all the same.
            let guided =
                (0..sticks.nodes.len()).filter(|&at| sticks.nodes[at].support == Support::Guided);
            let raised = guided.map(|at| (index_of((at, Y)), over_nodes([((node, Y), 1.0)])));
            let raised: Vec<_> = raised.collect();
            sticks.ties.extend(raised);
        }
        let [uu, ut, tt] = under.stiffness;
        sticks.foundation = Some(RigidFoundation {
            node,
            feet,
            stiffness: if lifts { [uu, 0.0, 0.0] } else { [uu, ut, tt] },
            damping: under.damping,
            sways: under.sways,
            middle: middle - centre,
        });
        self.foot = Some(node);
        let middle = middle - centre;
        let sinking = |spring: &BedSpring| {
            over_nodes([((node, Y), 1.0), ((node, THETA), middle + spring.at)])
        };
        self.add_bed(foundation, under.bed.clone(), sinking);
        if under.vertical_damping > 0.0 {
            self.stick_model.elements.push(Element::Spring {
                part: Part::Dashpot,
                stiffness: under.vertical_damping,
                row: over_nodes([((node, Y), 1.0), ((node, THETA), middle)]),
            });
        }
    }

    /// Adds contact springs in compression alone under a foundation; `rise`: that of the foundation at a spring (theory, Eq. B25).
    pub(super) fn add_bed(
        &mut self,
        foundation: &Foundation,
        bed: Vec<BedSpring>,
        rise: impl Fn(&BedSpring) -> Row,
    ) {
        let bearing = foundation.uplift.and_then(|uplift| uplift.bearing);
        for (index, spring) in bed.iter().enumerate() {
            let strength =
                bearing.map(|bearing| [bearing.strength * spring.area, bearing.hardening]);
            // What is not positive is a fault of the model.
            let Ok(hysteresis) = Hysteresis::ground(spring.stiffness, strength) else {
                continue;
            };
            self.stick_model.yielding.push(YieldingElement {
                row: rise(spring),
                hysteresis,
                proportional_damping: ProportionalDamping::None,
            });
            let (line, spring) = (None, index + 1);
            self.spring_places
                .push(SpringPlace::Footing { line, spring });
        }
        self.stick_model.bed = bed;
    }

    /// Adds ground in compression alone under every foot of a column, by column lines.
    pub(super) fn let_feet_lift(&mut self, feet: &[Option<usize>], stiffness: f64) {
        for (line, foot) in feet.iter().enumerate() {
            // What is not positive is a fault of the model.
            let (Some(foot), Ok(hysteresis)) = (*foot, Hysteresis::ground(stiffness, None)) else {
                continue;
            };
            self.stick_model.yielding.push(YieldingElement {
                row: over_nodes([((foot, Y), 1.0)]),
                hysteresis,
                proportional_damping: ProportionalDamping::None,
            });
            let (line, spring) = (Some(line + 1), 1);
            self.spring_places
                .push(SpringPlace::Footing { line, spring });
        }
    }

    /// Adds mass-proportional damping of the motion relative to the foundation, for a building whose equations have the same on
    /// its motion relative to the ground: C = Tᵀ α M T (theory, Eq. B22).
    ///
    /// Dashpots α m between the motion of every mass and that of the turned foundation there take the place of those to the
    /// ground, which have −α m here.
    pub(crate) fn damp_relative_to_foundation(&mut self, alpha: f64) {
        let Some(foundation) = self.stick_model.foundation.clone() else {
            return;
        };
        if alpha == 0.0 {
            return;
        }
        let sticks = &mut self.stick_model;
        let lifts = !sticks.bed.is_empty();
        let ground = sticks.add_node(0.0, 0.0);
        sticks.nodes[ground].support = Support::Fixed;
        let base = sticks.nodes[foundation.node];
        let turning = (foundation.node, THETA);
        let raised = lifts.then_some(((foundation.node, Y), -1.0));
        for node in 0..ground {
            let stick_node = sticks.nodes[node];
            let of_mass = alpha * stick_node.mass;
            if stick_node.mass > 0.0 {
                let place = (node, X);
                sticks.add_dashpot(ground, &over_nodes([(place, 1.0)]), -of_mass);
                if stick_node.y > 0.0 {
                    let relative = [
                        (place, 1.0),
                        ((foundation.node, X), -1.0),
                        (turning, stick_node.y),
                    ];
                    sticks.add_dashpot(ground, &over_nodes(relative), of_mass);
                }
                // Floors of a shear building rise with their foundation alone, and it does not rise unless it can lift off.
                let rises = stick_node.support == Support::Free && node != foundation.node;
                if rises || raised.is_some() {
                    sticks.add_dashpot(ground, &over_nodes([((node, Y), 1.0)]), -of_mass);
                }
                if rises {
                    let lever = stick_node.x - base.x;
                    let relative = [((node, Y), 1.0), (turning, -lever)];
                    let relative = relative.into_iter().chain(raised);
                    sticks.add_dashpot(ground, &over_nodes(relative), of_mass);
                }
            }
            if stick_node.inertia[THETA] > 0.0 {
                let of_inertia = alpha * stick_node.inertia[THETA];
                let turned = over_nodes([((node, THETA), 1.0)]);
                sticks.add_dashpot(ground, &turned, -of_inertia);
            }
        }
    }
}

/// Centre of the masses that rise and sink with the feet: about it, rising and turning do not act on each other \[m\].
fn centre_of_what_rises(sticks: &StickModel, feet: &[usize], middle: f64) -> f64 {
    let (mut carried, mut moment) = (0.0, 0.0);
    for (node, lever) in sticks.nodes.iter().zip(levers(sticks, feet, middle)) {
        if let Some(lever) = lever {
            carried += node.inertia[Y];
            moment += node.inertia[Y] * lever;
        }
    }
    middle + moment / carried
}

/// Distance to the right of the node of the foundation, for nodes that rise with a foot.
fn levers(sticks: &StickModel, feet: &[usize], middle: f64) -> Vec<Option<f64>> {
    let feet = risers(sticks, feet).into_iter();
    feet.map(|foot| Some(sticks.nodes[foot?].x - middle))
        .collect()
}

/// The foot with which every node rises: those on columns that keep their length, and those beyond hinges that do not stretch.
fn risers(sticks: &StickModel, feet: &[usize]) -> Vec<Option<usize>> {
    followers(sticks, feet, Y)
}

/// The foot with which every node moves in a displacement, as columns that keep their length and hinges that are rigid in it say.
pub(super) fn followers(
    sticks: &StickModel,
    feet: &[usize],
    component: usize,
) -> Vec<Option<usize>> {
    let mut followed = vec![None; sticks.nodes.len()];
    for &foot in feet {
        followed[foot] = Some(foot);
    }
    let columns = sticks.members.iter().filter(|member| {
        let is_rigid = component == Y && member.axial_rigidity.is_none();
        is_rigid && member.is_vertical(&sticks.nodes)
    });
    let hinges = sticks.hinges.iter().filter(|hinge| {
        let [horizontal, vertical] = hinge.translational_stiffness;
        [horizontal, vertical, hinge.rotational_stiffness][component].is_none()
    });
    let ties: Vec<[usize; 2]> = columns
        .map(|member| member.ends)
        .chain(hinges.map(|hinge| hinge.ends))
        .collect();
    loop {
        let mut found = false;
        for &[a, b] in &ties {
            for (from, to) in [(a, b), (b, a)] {
                if let (Some(foot), None) = (followed[from], followed[to]) {
                    followed[to] = Some(foot);
                    found = true;
                }
            }
        }
        if !found {
            return followed;
        }
    }
}

impl StickModel {
    /// Adds a dashpot whose deformation is a row over displacements of nodes, as one between every two of them and one from each
    /// to the ground.
    fn add_dashpot(&mut self, ground: usize, row: &Row, value: f64) {
        let mut add = |ends: [Place; 2], dashpot: f64| {
            if dashpot != 0.0 {
                self.elements
                    .push(Element::between(ends, Part::Dashpot, dashpot));
            }
        };
        let sum: f64 = row.entries().iter().map(|(_, share)| share).sum();
        for (index, (a, of_a)) in places(row).enumerate() {
            for (b, of_b) in places(row).skip(index + 1) {
                add([a, b], -value * of_a * of_b);
            }
            add([(ground, X), a], value * of_a * sum);
        }
    }
}
