//! Ends of columns that are made of fibres: rows of springs side by side between a joint and the end of a column.

use std::ops::Range;

use super::discretization::Discretization;
use super::element::{THETA, Y, over_nodes};
use super::spring_place::{MemberEnd, SpringPlace};
use super::stick_model::{Hinge, StickModel, YieldingElement};
use crate::linear::Row;
use crate::model::{ColumnFibres, ProportionalDamping};

/// An end of a column that is made of fibres.
#[derive(Clone, Debug, PartialEq)]
pub struct FibreSection {
    /// Storey, from 1.
    pub storey: usize,
    /// Column line, from 1.
    pub line: usize,
    /// Which end.
    pub end: MemberEnd,
    /// Length over which the fibres share a deformation \[m\].
    pub length: f64,
    /// Distance of every fibre from the axis, to the right \[m\].
    pub at: Vec<f64>,
    /// Its fibres among [`StickModel::yielding`]; see [`Discretization::springs_of_section`].
    pub elements: Range<usize>,
    /// Elongation of its axis over displacements of nodes.
    pub elongation: Row,
    /// Rotation over displacements of nodes, positive where it stretches the right side.
    pub rotation: Row,
}

impl FibreSection {
    /// Places of its fibres.
    pub(super) fn places(&self) -> impl Iterator<Item = SpringPlace> + '_ {
        (0..self.at.len()).map(|fibre| SpringPlace::Fibre {
            storey: self.storey,
            line: self.line,
            end: self.end,
            fibre: fibre + 1,
        })
    }
}

impl std::fmt::Display for FibreSection {
    /// Its name within the building, such as `column.1.2.foot`.
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let end = self.end.of_column();
        write!(formatter, "column.{}.{}.{end}", self.line, self.storey)
    }
}

impl StickModel {
    /// Adds the fibres of an end of a column between a joint and a new node, which is returned: it moves sideways with the joint, and
    /// rises and turns as the fibres let it.
    pub(super) fn add_fibres(
        &mut self,
        joint: usize,
        own: &ColumnFibres,
        [storey, line]: [usize; 2],
        end: MemberEnd,
    ) -> (usize, FibreSection) {
        let node = self.add_node(self.nodes[joint].x, self.nodes[joint].y);
        self.hinges.push(Hinge {
            ends: [joint, node],
            rotational_stiffness: Some(0.0),
            hysteresis: None,
            translational_stiffness: [None, Some(0.0)],
            dashpots: [0.0; 3],
            proportional_damping: ProportionalDamping::None,
        });
        // The upper side moves away from the lower one; a turn counter-clockwise stretches what lies to the right.
        let [lower, upper] = match end {
            MemberEnd::First => [joint, node],
            MemberEnd::Last => [node, joint],
        };
        let between =
            |component, share: f64| [((upper, component), share), ((lower, component), -share)];
        let first = self.yielding.len();
        self.yielding
            .extend(own.fibres.iter().map(|fibre| YieldingElement {
                row: over_nodes(between(Y, 1.0).into_iter().chain(between(THETA, fibre.at))),
                hysteresis: fibre.spring,
                proportional_damping: ProportionalDamping::None,
            }));
        let section = FibreSection {
            storey,
            line,
            end,
            length: own.length,
            at: own.fibres.iter().map(|fibre| fibre.at).collect(),
            elements: first..self.yielding.len(),
            elongation: over_nodes(between(Y, 1.0)),
            rotation: over_nodes(between(THETA, 1.0)),
        };
        (node, section)
    }
}

impl Discretization {
    /// Springs of a section of fibres among [`Equations::springs`](super::Equations::springs).
    #[must_use]
    pub fn springs_of_section(&self, section: &FibreSection) -> Range<usize> {
        let sticks = &self.stick_model;
        let hinges = sticks.hinges.iter().filter(|own| own.hysteresis.is_some());
        let storeys = sticks.springs.iter().filter(|own| own.hysteresis.is_some());
        let before = hinges.count() + storeys.count();
        before + section.elements.start..before + section.elements.end
    }
}
