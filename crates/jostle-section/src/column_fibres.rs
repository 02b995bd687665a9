//! The fibres of an end of a column that follows its axial force.

use std::sync::Arc;

use jostle::Fibre;
use jostle::hysteresis::{
    Backbone, ConcreteFall, Corners, Hysteresis, HysteresisRule, SpringFault,
};

use crate::law::{self, ConcreteLaw};
use crate::section::Section;

/// How a section is cut into fibres, and what replaces its own materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FibreOptions {
    /// Layers of concrete over the depth, ≥ 2.
    pub layers: usize,
    /// Length over which strains are constant, > 0 \[m\].
    pub length: f64,
    /// Strain of concrete at its strength; `None`: that of the concrete, by Mander, Priestley and Park where ties confine it \[–\].
    pub peak_strain: Option<f64>,
    /// Strength of crushed concrete over its strength, 0…1 \[–\].
    pub residual: f64,
    /// Strain at which it has fallen so far; `None`: on the straight line through its stress at the crushing strain \[–\].
    pub ultimate_strain: Option<f64>,
    /// Modulus of bars after yield over that before; `None`: that of the steel \[–\].
    pub hardening: Option<f64>,
}

impl FibreOptions {
    /// 20 layers, materials of the section; a fifth of the strength stays (Scott, Park and Priestley, 1982).
    #[must_use]
    pub fn over(length: f64) -> Self {
        Self {
            layers: 20,
            length,
            peak_strain: None,
            residual: 0.2,
            ultimate_strain: None,
            hardening: None,
        }
    }

    /// 0.08 L + 0.022 d f: the length of a plastic hinge by Paulay and Priestley (1992), with the distance to the point of zero moment
    /// L \[m\] and the diameter \[m\] and yield strength \[Pa\] of the thickest bars.
    #[must_use]
    pub fn hinge_length(shear_span: f64, section: &Section) -> f64 {
        let bars = section.bars.iter().map(|bar| bar.diameter);
        let thickest = bars.fold(0.0, f64::max);
        0.08 * shear_span + 0.022 * thickest * 1e-6 * section.steel.yield_strength
    }

    /// Concrete over an area, as a spring over the length.
    fn concrete(&self, law: &ConcreteLaw, area: f64) -> Result<Hysteresis, Vec<SpringFault>> {
        let strain = self.peak_strain.unwrap_or(law.peak_strain);
        let fall = ConcreteFall {
            residual: self.residual,
            ultimate: self
                .ultimate_strain
                .unwrap_or_else(|| self.end_of_fall(law))
                / strain,
        };
        Hysteresis::concrete(law.peak_stress * area, strain * self.length, fall)
    }

    /// Strain at which the straight line through the stress at the crushing strain has fallen to the residual strength.
    fn end_of_fall(&self, law: &ConcreteLaw) -> f64 {
        let lost = law.peak_stress - law.stress(law.crushing_strain);
        let beyond = law.crushing_strain - law.peak_strain;
        // Concrete that hardly falls by then is given a line that falls as little.
        let share = (lost / law.peak_stress).max(1e-3);
        law.peak_strain + beyond.max(0.1 * law.peak_strain) * (1.0 - self.residual) / share
    }
}

impl Section {
    /// Its fibres as springs side by side, from left to right: the left face of the column is the top of the section. Layers of
    /// concrete, those of the core confined where there are ties, then rows of bars. Bars displace no concrete.
    ///
    /// # Errors
    /// Numbers of the options out of range.
    pub fn fibres(&self, options: &FibreOptions) -> Result<Arc<[Fibre]>, Vec<SpringFault>> {
        let plain = ConcreteLaw::unconfined(&self.concrete);
        let core = law::confined(self);
        let (inset, (core_width, _)) = (law::core_inset(self), law::core(self));
        let (half, layer) = (0.5 * self.depth, self.depth / options.layers as f64);
        let mut fibres = Vec::new();
        for number in 0..options.layers {
            let from_top = (number as f64 + 0.5) * layer;
            let at = from_top - half;
            let mut add = |law: &ConcreteLaw, width: f64| {
                let spring = options.concrete(law, width * layer)?;
                fibres.push(Fibre { at, spring });
                Ok::<(), Vec<SpringFault>>(())
            };
            match &core {
                Some(core) if from_top > inset && from_top < self.depth - inset => {
                    add(core, core_width)?;
                    if inset > 0.0 {
                        add(&plain, self.width - core_width)?;
                    }
                }
                _ => add(&plain, self.width)?,
            }
        }
        // One fibre for the bars of a row.
        let mut rows: Vec<(f64, f64)> = Vec::new();
        for bar in &self.bars {
            match rows
                .iter_mut()
                .find(|(depth, _)| (*depth - bar.depth).abs() < 1e-9)
            {
                Some((_, area)) => *area += bar.area(),
                None => rows.push((bar.depth, bar.area())),
            }
        }
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        let steel = &self.steel;
        for (depth, area) in rows {
            let post_yield = options.hardening.unwrap_or(steel.hardening);
            let corners = Corners::bilinear(steel.yield_strength * area, post_yield);
            let stiffness = steel.modulus * area / options.length;
            let backbone = Backbone::from_forces(stiffness, corners, corners)?;
            fibres.push(Fibre {
                at: depth - half,
                spring: Hysteresis::new(HysteresisRule::Bilinear, backbone)?,
            });
        }
        Ok(fibres.into())
    }
}
