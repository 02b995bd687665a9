//! A building on its own, assembled.

use super::{Discretization, Equations, InnerLink, StoreyForce, StoreyForces};

/// Masses, elements and matrices of one building, before it stands in a row.
#[derive(Clone, Debug)]
pub struct AssembledBuilding {
    /// Name.
    pub name: String,
    /// Lumped masses and massless elements.
    pub discretization: Discretization,
    /// Mass, damping and stiffness.
    pub equations: Equations,
    /// How storey shears and overturning moments follow from displacements.
    pub storeys: StoreyForces,
    /// Links between its floors.
    pub inner_links: Vec<InnerLink>,
    /// Degree of freedom of every floor in the vectors of this building, from the ground up; floors that cannot move
    /// are left out.
    pub floor_dofs: Vec<usize>,
}

impl AssembledBuilding {
    /// Assembles the equations of a discretized building, without damping.
    #[must_use]
    pub fn new(name: &str, discretization: Discretization) -> Self {
        let equations = Equations::assemble(&discretization.stick_model);
        let floors = discretization.floors.iter();
        let (floor_dofs, heights): (Vec<usize>, Vec<f64>) = floors
            .filter_map(|&node| {
                let height = discretization.stick_model.nodes[node].y;
                Some((equations.horizontal(node)?, height))
            })
            .unzip();
        let (sticks, centres) = (&discretization.stick_model, &discretization.centres);
        let storeys = StoreyForces::new(sticks, &equations, &heights, centres);
        Self {
            name: name.to_owned(),
            discretization,
            equations,
            storeys,
            inner_links: Vec::new(),
            floor_dofs,
        }
    }

    /// Base shear of its elastic parts and of the springs of links to its base, for a displacement of an elastic building \[N\].
    #[must_use]
    pub fn elastic_base_shear(&self, displacement: &[f64]) -> f64 {
        let links = self.inner_links.iter();
        let links =
            links.map(|link| link.of_base() * link.stiffness * link.shortening.value(displacement));
        self.equations.base_shear(displacement) + links.sum::<f64>()
    }

    /// Storey shears for a displacement, in the order of [`StoreyForces`], as long as nothing has yielded \[N\].
    #[must_use]
    pub fn initial_storey_shears(&self, displacement: &[f64]) -> Vec<f64> {
        let spring = |index: usize| {
            let spring = &self.equations.springs[index];
            spring.hysteresis.initial_tangent() * spring.deformation(displacement)
        };
        let link = |index: usize| {
            let link = &self.inner_links[index];
            link.stiffness * link.shortening.value(displacement)
        };
        let mut shears = vec![0.0; self.storeys.len()];
        let take = |storey: usize, force: StoreyForce| shears[storey] = force.shear;
        self.storeys.for_each(displacement, spring, link, take);
        shears
    }

    /// Adds links between its floors to its storey forces.
    pub(crate) fn link(&mut self, links: Vec<InnerLink>) {
        let axis = self.discretization.centres.first().copied();
        for (index, link) in links.iter().enumerate() {
            self.storeys
                .add_link(index, &link.ends, axis.unwrap_or_default());
        }
        self.inner_links = links;
    }
}
