//! Buildings on rigid foundations.

use super::Discretization;
use super::element::{Element, Part, Place, THETA, X, Y, index_of, over_nodes, places};
use super::stick_model::{RigidFoundation, StickModel, Support};
use crate::linear::Row;
use crate::model::Foundation;

impl Discretization {
    /// Puts the feet of the building, which are fixed so far, on a rigid foundation on springs and dashpots: its middle lies
    /// below the middle of the building. Storeys of a shear building deform by w_i = u_i − u_f + h_i θ (theory, Eq. B22).
    pub(crate) fn put_on_foundation(
        &mut self,
        foundation: &Foundation,
        stiffness: [f64; 3],
        damping: [f64; 3],
    ) {
        let sticks = &mut self.stick_model;
        let feet: Vec<usize> = (0..sticks.nodes.len())
            .filter(|&node| sticks.nodes[node].support == Support::Fixed)
            .collect();
        let (Some(&first), Some(&last)) = (feet.first(), feet.last()) else {
            return;
        };
        for &foot in &feet {
            sticks.nodes[foot].support = Support::Free;
        }
        let middle = 0.5 * (sticks.nodes[first].x + sticks.nodes[last].x);
        let node = if feet.len() == 1 {
            first
        } else {
            sticks.add_node(middle, 0.0)
        };
        let own = &mut sticks.nodes[node];
        own.add_mass(foundation.mass);
        *own = own.with_rotary_inertia(foundation.rotary_inertia);
        for spring in &mut sticks.springs {
            let [lower, upper] = spring.ends.map(|end| sticks.nodes[end].y);
            spring.lever = Some(upper - lower);
        }
        if feet.len() > 1 {
            let levers = levers(sticks, &feet, middle).into_iter().enumerate();
            let ties = levers.filter_map(|(at, lever)| {
                let turned = over_nodes([((node, THETA), lever?)]);
                Some((index_of((at, Y)), turned))
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
        sticks.foundation = Some(RigidFoundation {
            node,
            feet,
            stiffness,
            damping,
        });
        self.foot = Some(node);
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
        let ground = sticks.add_node(0.0, 0.0);
        sticks.nodes[ground].support = Support::Fixed;
        let base = sticks.nodes[foundation.node];
        let turning = (foundation.node, THETA);
        for node in 0..ground {
            let own = sticks.nodes[node];
            let of_mass = alpha * own.mass;
            if own.mass > 0.0 {
                let place = (node, X);
                sticks.add_dashpot(ground, &over_nodes([(place, 1.0)]), -of_mass);
                if own.y > 0.0 {
                    let relative = [(place, 1.0), ((foundation.node, X), -1.0), (turning, own.y)];
                    sticks.add_dashpot(ground, &over_nodes(relative), of_mass);
                }
                // Floors of a shear building do not rise.
                if own.support == Support::Free && node != foundation.node {
                    let lever = own.x - base.x;
                    sticks.add_dashpot(ground, &over_nodes([((node, Y), 1.0)]), -of_mass);
                    let relative = [((node, Y), 1.0), (turning, -lever)];
                    sticks.add_dashpot(ground, &over_nodes(relative), of_mass);
                }
            }
            if own.inertia[THETA] > 0.0 {
                let of_inertia = alpha * own.inertia[THETA];
                let turned = over_nodes([((node, THETA), 1.0)]);
                sticks.add_dashpot(ground, &turned, -of_inertia);
            }
        }
    }
}

/// Distance to the right of the middle of the foundation, for nodes that rise with a foot: those on columns that keep their
/// length, and those beyond hinges that do not stretch.
fn levers(sticks: &StickModel, feet: &[usize], middle: f64) -> Vec<Option<f64>> {
    let mut levers = vec![None; sticks.nodes.len()];
    for &foot in feet {
        levers[foot] = Some(sticks.nodes[foot].x - middle);
    }
    let columns = sticks
        .members
        .iter()
        .filter(|member| member.axial_rigidity.is_none() && member.is_vertical(&sticks.nodes));
    let hinges = sticks.hinges.iter();
    let hinges = hinges.filter(|hinge| hinge.translational_stiffness[1].is_none());
    let ties: Vec<[usize; 2]> = columns
        .map(|member| member.ends)
        .chain(hinges.map(|hinge| hinge.ends))
        .collect();
    loop {
        let mut found = false;
        for &[a, b] in &ties {
            for (from, to) in [(a, b), (b, a)] {
                if let (Some(lever), None) = (levers[from], levers[to]) {
                    levers[to] = Some(lever);
                    found = true;
                }
            }
        }
        if !found {
            return levers;
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
