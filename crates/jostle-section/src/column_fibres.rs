//! The fibres of an end of a column that follows its axial force.

use std::collections::BTreeMap;
use std::sync::Arc;

use jostle::hysteresis::{
    Backbone, ConcreteFall, Corners, Hysteresis, HysteresisRule, MenegottoPinto, SpringFault,
};
use jostle::{Fibre, FibreLimit, FibreMaterial};

use crate::law::{self, ConcreteLaw};
use crate::section::Section;

/// How a section is cut into fibres, and what replaces its own materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FibreOptions {
    /// Layers of concrete over the depth, ≥ 2.
    pub layers: usize,
    /// Parts of every layer over the width, of a column that bends about both axes; `None`: a layer is one, as are the bars of a row.
    pub across: Option<usize>,
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
    /// How the loops of bars bend; `None`: straight lines with one corner.
    pub loops: Option<MenegottoPinto>,
}

impl FibreOptions {
    /// 20 layers of one part, materials of the section; a fifth of the strength stays (Scott, Park and Priestley, 1982).
    #[must_use]
    pub fn over(length: f64) -> Self {
        Self {
            layers: 20,
            across: None,
            length,
            peak_strain: None,
            residual: 0.2,
            ultimate_strain: None,
            hardening: None,
            loops: None,
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
    /// Over parts of layers, the left face of the section is the nearer one, and every bar is a fibre. A part that the edge of the
    /// core crosses is two fibres.
    ///
    /// # Errors
    /// Numbers of the options out of range.
    pub fn fibres(&self, options: &FibreOptions) -> Result<Arc<[Fibre]>, Vec<SpringFault>> {
        let plain = ConcreteLaw::unconfined(&self.concrete);
        let core = law::confined(self);
        let (inset, (core_width, _)) = (law::core_inset(self), law::core(self));
        let layer = self.depth / options.layers as f64;
        let mut fibres = Vec::new();
        for number in 0..options.layers {
            let from_top = (number as f64 + 0.5) * layer;
            let strips = match options.across {
                Some(count) => {
                    let strip = self.width / count as f64;
                    let layers = in_core(from_top, layer, self.depth, inset);
                    let strips = (0..count).map(|number| {
                        let from_left = (number as f64 + 0.5) * strip;
                        let share = layers * in_core(from_left, strip, self.width, inset);
                        (from_left - 0.5 * self.width, strip, share * strip)
                    });
                    strips.collect()
                }
                None if from_top > inset && from_top < self.depth - inset => {
                    vec![(0.0, self.width, core_width)]
                }
                None => vec![(0.0, self.width, 0.0)],
            };
            for (across, width, confined) in strips {
                let (core, confined) = match &core {
                    Some(core) => (core, confined),
                    None => (&plain, 0.0),
                };
                let parts = [
                    (core, confined, FibreMaterial::Core),
                    (&plain, width - confined, FibreMaterial::Cover),
                ];
                for (law, width, material) in parts {
                    if width > 1e-9 * self.width {
                        let spring = options.concrete(law, width * layer)?;
                        let at = [from_top - 0.5 * self.depth, across];
                        fibres.push(Fibre {
                            at,
                            spring,
                            material,
                        });
                    }
                }
            }
        }
        let steel = &self.steel;
        for ([depth, across], area) in self.bar_fibres(options.across.is_some()) {
            let post_yield = options.hardening.unwrap_or(steel.hardening);
            let strength = steel.yield_strength * area;
            let stiffness = steel.modulus * area / options.length;
            let spring = match options.loops {
                Some(law) => Hysteresis::menegotto_pinto(stiffness, strength, post_yield, law)?,
                None => {
                    let corners = Corners::bilinear(strength, post_yield);
                    let backbone = Backbone::from_forces(stiffness, corners, corners)?;
                    Hysteresis::new(HysteresisRule::Bilinear, backbone)?
                }
            };
            fibres.push(Fibre {
                at: [depth - 0.5 * self.depth, across],
                spring,
                material: FibreMaterial::Bar,
            });
        }
        Ok(fibres.into())
    }

    /// Strains at which its own materials fail: the cover at the crushing strain of unconfined concrete, the core within ties at that
    /// of confined concrete ([`crate::law::confined`]), bars at their rupture strain. No rule is known here for bars that buckle.
    #[must_use]
    pub fn strain_limits(&self) -> BTreeMap<FibreLimit, f64> {
        let cover = ConcreteLaw::unconfined(&self.concrete).crushing_strain;
        let core = law::confined(self).map(|law| (FibreLimit::Crushing, law.crushing_strain));
        let others = [
            (FibreLimit::Spalling, cover),
            (FibreLimit::Fracture, self.steel.rupture_strain),
        ];
        others.into_iter().chain(core).collect()
    }

    /// Depths below the top of bars, their places across from the axis, and their areas: each by itself, or all of a row on the axis.
    fn bar_fibres(&self, each: bool) -> Vec<([f64; 2], f64)> {
        if each {
            let middle = 0.5 * self.width;
            let bars = self.bars.iter();
            return bars
                .map(|bar| ([bar.depth, bar.x - middle], bar.area()))
                .collect();
        }
        let mut rows: Vec<([f64; 2], f64)> = Vec::new();
        for bar in &self.bars {
            let same = |depth: f64| (depth - bar.depth).abs() < 1e-9;
            match rows.iter_mut().find(|([depth, _], _)| same(*depth)) {
                Some((_, area)) => *area += bar.area(),
                None => rows.push(([bar.depth, 0.0], bar.area())),
            }
        }
        rows.sort_by(|([a, _], _), ([b, _], _)| a.total_cmp(b));
        rows
    }
}

/// Share of a strip about `middle` that lies within the core of a side, `inset` from both of its faces \[–\].
fn in_core(middle: f64, strip: f64, side: f64, inset: f64) -> f64 {
    let from = (middle - 0.5 * strip).max(inset);
    let to = (middle + 0.5 * strip).min(side - inset);
    ((to - from) / strip).clamp(0.0, 1.0)
}
