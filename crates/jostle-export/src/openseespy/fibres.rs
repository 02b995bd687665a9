//! Ends of columns and walls that are made of fibres: sections without length between a joint and the end of a member.
//!
//! A fibre of such a section stretches by e + a θ, as a spring of jostle does. So its material is the force of the spring over the
//! elongation, on an area of one, and the length that the fibres share stands in these.

use std::fmt::Write;
use std::sync::Arc;

use jostle::Fibre;
use jostle::structure::FibreSection;
use jostle::system::BuildingSystem;

use super::script::{Script, rounded, text};

/// An end of a member that is made of fibres.
pub(super) struct FibreEnd<'a> {
    /// Its section.
    pub(super) section: &'a FibreSection,
    /// Tags of the nodes below and above it.
    pub(super) nodes: [usize; 2],
    /// Unit vector of the direction along which the first distances of fibres count.
    pub(super) direction: [f64; 2],
}

impl Script<'_> {
    /// Fibres of a building in one plane.
    pub(super) fn add_fibres(
        &mut self,
        index: usize,
        building: &BuildingSystem,
    ) -> Result<(), &'static str> {
        for section in &building.discretization.sections {
            let mut nodes = [0; 2];
            for (place, share) in section.elongation.entries() {
                nodes[usize::from(*share > 0.0)] = self.tag(index, place / 3);
            }
            let end = FibreEnd {
                section,
                nodes,
                direction: [1.0, 0.0],
            };
            self.add_fibre_end(building, &end)?;
        }
        Ok(())
    }

    pub(super) fn add_fibre_end(
        &mut self,
        building: &BuildingSystem,
        end: &FibreEnd<'_>,
    ) -> Result<(), &'static str> {
        let number = self.fibres_of(&end.section.fibres)?;
        let tag = self.element();
        let ([lower, upper], [c, s]) = (end.nodes, end.direction);
        let name = text(&building.discretization.name_of_section(end.section));
        let _ = writeln!(
            self.fibre_ends,
            "    ({tag}, {lower}, {upper}, {number}, ({c:?}, {s:?}), {name}),"
        );
        Ok(())
    }

    /// Number of a list of fibres, from 1; equal ones are listed once.
    fn fibres_of(&mut self, fibres: &Arc<[Fibre]>) -> Result<usize, &'static str> {
        if let Some(known) = self.fibre_lists.iter().position(|list| list == fibres) {
            return Ok(known + 1);
        }
        self.fibre_lists.push(fibres.clone());
        let number = self.fibre_lists.len();
        for fibre in fibres.iter() {
            let material = self.materials.yielding(&fibre.spring)?;
            let [along, across] = fibre.at.map(rounded);
            let _ = writeln!(
                self.fibres,
                "    ({number}, {along:?}, {across:?}, {material}),"
            );
        }
        Ok(number)
    }
}
