//! How many digits a product of transfer matrices leaves (theory, Eq. R0).

use super::layout::Layout;
use super::{Heading, StateVector};
use crate::system::BuildingSystem;

/// Digits that a step should keep.
pub(super) const DIGITS_WANTED: f64 = 6.0;

/// Decimal digits of the largest displacement that the total transfer equation is expected to get right in one
/// step with K̂ = κ K + g M; negative when even the order of magnitude is lost.
#[must_use]
pub fn digits_left(building: &BuildingSystem, stiffness_factor: f64, mass_factor: f64) -> f64 {
    let Ok(layout) = Layout::of(building) else {
        return 0.0;
    };
    let mut worst = 0.0_f64;
    let (mut c, mut b) = (0.0, 0.0);
    for line in &layout.columns {
        let g = growth(
            &layout,
            &line.links,
            &line.nodes,
            Heading::Up,
            stiffness_factor,
            mass_factor,
        );
        c = f64::max(c, g);
    }
    for beam in &layout.beams {
        let g = growth(
            &layout,
            &beam.links,
            &beam.nodes,
            Heading::Right,
            stiffness_factor,
            mass_factor,
        );
        b = f64::max(b, g);
    }
    worst = worst.max(c + b);
    16.0 - worst
}

fn growth(
    layout: &Layout,
    links: &[super::layout::Link],
    nodes: &[usize],
    heading: Heading,
    k: f64,
    g: f64,
) -> f64 {
    let mut z = StateVector::at_base([1.0, 1.0, 1.0]).to_array();
    let mut sum = 0.0;
    for (&link, &node) in links.iter().zip(&nodes[1..]) {
        z = layout
            .mass(node, g)
            .apply(
                layout
                    .transfer(link, heading, k)
                    .apply(StateVector::from_array(z)),
            )
            .to_array();
        let n = z.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        sum += n.log10();
        z.iter_mut().for_each(|v| *v /= n);
    }
    sum
}
