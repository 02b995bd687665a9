//! Ends of columns that are made of fibres: springs side by side between a joint and the end of a column.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use super::discretization::Discretization;
use super::element::{THETA, Y, over_nodes};
use super::member_forces::MemberPlace;
use super::spring_place::{MemberEnd, SpringPlace};
use super::stick_model::{Hinge, StickModel, YieldingElement};
use crate::linear::Row;
use crate::model::{ColumnFibres, Fibre, FibreLimit, ProportionalDamping};

/// An end of a column that is made of fibres.
#[derive(Clone, Debug, PartialEq)]
pub struct FibreSection {
    /// Its column.
    pub member: MemberPlace,
    /// Which end.
    pub end: MemberEnd,
    /// Length over which the fibres share a deformation \[m\].
    pub length: f64,
    /// Its fibres.
    pub fibres: Arc<[Fibre]>,
    /// Strains that are judged \[–\].
    pub limits: BTreeMap<FibreLimit, f64>,
    /// Its fibres among [`StickModel::yielding`]; see [`Discretization::springs_of_section`].
    pub elements: Range<usize>,
    /// Elongation of its axis over displacements of nodes.
    pub elongation: Row,
    /// Rotations over displacements of nodes: positive where it stretches the right side, and, of a space frame, the side further
    /// across.
    pub rotations: Vec<Row>,
}

impl FibreSection {
    /// Places of its fibres.
    pub(super) fn places(&self) -> impl Iterator<Item = SpringPlace> + '_ {
        (0..self.fibres.len()).map(|fibre| SpringPlace::Fibre {
            member: self.member,
            end: self.end,
            fibre: fibre + 1,
        })
    }
}

impl std::fmt::Display for FibreSection {
    /// Its name within the building, such as `column.1.2.foot`, or `column.1.1.2.foot` in a space frame.
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{}.{}", self.member, self.end.of_column())
    }
}

impl StickModel {
    /// Adds the fibres of an end of a column between a joint and a new node, which is returned: it moves sideways with the joint, and
    /// rises and turns as the fibres let it.
    pub(super) fn add_fibres(
        &mut self,
        joint: usize,
        fibres: &ColumnFibres,
        [storey, line]: [usize; 2],
        end: MemberEnd,
    ) -> (usize, FibreSection) {
        let member = MemberPlace::Column { line, storey };
        let node = self.add_beside(joint);
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
            |component| over_nodes([((upper, component), 1.0), ((lower, component), -1.0)]);
        let section = self.add_section(fibres, member, end, between(Y), vec![between(THETA)]);
        (node, section)
    }

    /// Adds fibres over an elongation and the rotations beside it: each is a spring over v + Σ x θ.
    pub(super) fn add_section(
        &mut self,
        fibres: &ColumnFibres,
        member: MemberPlace,
        end: MemberEnd,
        elongation: Row,
        rotations: Vec<Row>,
    ) -> FibreSection {
        let first = self.yielding.len();
        self.yielding.extend(fibres.fibres.iter().map(|fibre| {
            let mut row = elongation.clone();
            for (rotation, at) in rotations.iter().zip(fibre.at) {
                row.add_times(at, rotation);
            }
            YieldingElement {
                row,
                hysteresis: fibre.spring,
                proportional_damping: ProportionalDamping::None,
            }
        }));
        FibreSection {
            member,
            end,
            length: fibres.length,
            fibres: fibres.fibres.clone(),
            limits: fibres.limits.clone(),
            elements: first..self.yielding.len(),
            elongation,
            rotations,
        }
    }
}

impl Discretization {
    /// Springs of a section of fibres among [`Equations::springs`](super::Equations::springs).
    #[must_use]
    pub fn springs_of_section(&self, section: &FibreSection) -> Range<usize> {
        let sticks = &self.stick_model;
        let hinges = sticks
            .hinges
            .iter()
            .filter(|hinge| hinge.hysteresis.is_some());
        let storeys = sticks
            .springs
            .iter()
            .filter(|spring| spring.hysteresis.is_some());
        let before = hinges.count() + storeys.count();
        before + section.elements.start..before + section.elements.end
    }
}
