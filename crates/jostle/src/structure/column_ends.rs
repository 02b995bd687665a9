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
    /// Index of its frame in [`Discretization::frames`]; `None` where the building is one frame, or a space frame.
    pub frame: Option<usize>,
    /// Its column.
    pub member: MemberPlace,
    /// Which end; the upper side of a point is as a foot.
    pub end: MemberEnd,
    /// Instead of an end, the point between floors where it is struck, from 1 at the lowest one.
    pub point: Option<usize>,
    /// Length over which the fibres share a deformation \[m\].
    pub length: f64,
    /// Its fibres.
    pub fibres: Arc<[Fibre]>,
    /// Strains that are judged \[–\].
    pub limits: BTreeMap<FibreLimit, f64>,
    /// Its fibres among [`field@StickModel::yielding`], or its rows among those of [`StickModel::surfaces`]; see [`Discretization::springs_of_section`].
    pub elements: Range<usize>,
    /// Elongation of its axis over displacements of nodes.
    pub elongation: Row,
    /// Rotations over displacements of nodes: positive where it stretches the right side, and, of a space frame, the side further
    /// across.
    pub rotations: Vec<Row>,
}

impl FibreSection {
    /// Whether it yields on a surface instead.
    #[must_use]
    pub fn is_surface(&self) -> bool {
        let first = self.fibres.first();
        first.is_some_and(|first| first.spring.is_on_surface())
    }

    /// Places of its fibres, or of its rows.
    pub(super) fn places(&self) -> impl Iterator<Item = SpringPlace> + '_ {
        let (member, end, point) = (self.member, self.end, self.point);
        let frame = self.frame.map(|frame| frame + 1);
        let fibres = self.fibres.iter().enumerate();
        fibres.map(move |(number, fibre)| match fibre.spring.is_on_surface() {
            true => SpringPlace::Surface {
                frame,
                member,
                end,
                point,
                row: number + 1,
            },
            false => SpringPlace::Fibre {
                frame,
                member,
                end,
                point,
                fibre: number + 1,
            },
        })
    }
}

impl std::fmt::Display for FibreSection {
    /// Its name within the building, such as `column.1.2.foot`, or `column.1.1.2.foot` in a space frame; `column.1.2.struck1` where it is
    /// struck.
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.point {
            Some(point) => write!(formatter, "{}.struck{point}", self.member),
            None => write!(formatter, "{}.{}", self.member, self.end.of_column()),
        }
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

    /// Adds fibres over an elongation and the rotations beside it: each is a spring over v + Σ x θ. Of a section that yields on a surface
    /// the rows behind its points are differences of these.
    pub(super) fn add_section(
        &mut self,
        fibres: &ColumnFibres,
        member: MemberPlace,
        end: MemberEnd,
        elongation: Row,
        rotations: Vec<Row>,
    ) -> FibreSection {
        let springs = fibres.fibres.iter().map(|fibre| {
            let mut row = elongation.clone();
            for (rotation, at) in rotations.iter().zip(fibre.at) {
                row.add_times(at, rotation);
            }
            YieldingElement {
                row,
                hysteresis: fibre.spring,
                proportional_damping: ProportionalDamping::None,
            }
        });
        let mut springs: Vec<YieldingElement> = springs.collect();
        let list = match fibres.is_surface() {
            true => &mut self.surfaces,
            false => &mut self.yielding,
        };
        if fibres.is_surface() {
            // Two points and a difference, or three of each.
            let points = springs.len().div_ceil(2);
            for difference in points..springs.len() {
                let from = difference - points;
                let mut row = springs[from].row.clone();
                row.add_times(-1.0, &springs[(from + 1) % points].row);
                springs[difference].row = row;
            }
        }
        let first = list.len();
        list.extend(springs);
        FibreSection {
            frame: None,
            member,
            end,
            point: None,
            length: fibres.length,
            fibres: fibres.fibres.clone(),
            limits: fibres.limits.clone(),
            elements: first..first + fibres.fibres.len(),
            elongation,
            rotations,
        }
    }
}

impl Discretization {
    /// Name of a section of fibres within the building, with that of its frame where several stand in a plan.
    #[must_use]
    pub fn name_of_section(&self, section: &FibreSection) -> String {
        format!("{}{section}", self.frame_of_section(section))
    }

    /// Name of the column of a section of fibres, likewise.
    #[must_use]
    pub fn column_of_section(&self, section: &FibreSection) -> String {
        format!("{}{}", self.frame_of_section(section), section.member)
    }

    fn frame_of_section(&self, section: &FibreSection) -> String {
        let name = section.frame.and_then(|frame| self.frames.get(frame));
        name.map_or_else(String::new, |name| format!("{name}."))
    }

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
        let mut before = hinges.count() + storeys.count();
        if section.is_surface() {
            before += sticks.yielding.len() + sticks.rows_of_bearings();
        }
        before + section.elements.start..before + section.elements.end
    }
}
