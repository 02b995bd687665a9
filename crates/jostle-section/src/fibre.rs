//! Axial force and moment of a section from the stresses of its fibres.

use crate::law::{self, ConcreteLaw, SteelLaw};
use crate::section::Section;

/// A section cut into fibres.
///
/// Plane sections stay plane. The depth is cut where a law has a corner (neutral axis, crack, peak stress, edge
/// of the core), and each part into fibres with two Gauss points, so that no fibre straddles a corner. The sum
/// converges with nearly the third power of their number; more would need a concrete smoother at zero strain.
#[derive(Clone, Debug)]
pub struct Fibres {
    section: Section,
    plain: ConcreteLaw,
    core: Option<ConcreteLaw>,
    steel: SteelLaw,
    count: usize,
}

/// Stress resultants about mid-depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resultants {
    /// Axial compression \[N\].
    pub axial: f64,
    /// Moment, positive when it stretches the bottom \[N·m\].
    pub moment: f64,
}

impl Fibres {
    /// Cuts a section into about `count` fibres, at least one; the core is confined if the section has ties.
    #[must_use]
    pub fn new(section: &Section, count: usize) -> Self {
        Self {
            plain: ConcreteLaw::unconfined(&section.concrete),
            core: law::confined(section),
            steel: SteelLaw(section.steel),
            section: section.clone(),
            count: count.max(1),
        }
    }

    /// Law of the concrete outside the ties.
    #[must_use]
    pub fn plain(&self) -> &ConcreteLaw {
        &self.plain
    }

    /// Law of the concrete inside the ties, if they confine it.
    #[must_use]
    pub fn core(&self) -> Option<&ConcreteLaw> {
        self.core.as_ref()
    }

    /// Compressive strain at a depth below the top \[–\].
    pub(crate) fn strain_at(&self, strain: f64, curvature: f64, depth: f64) -> f64 {
        strain + curvature * (0.5 * self.section.depth - depth)
    }

    /// Resultants for a compressive strain at mid-depth \[–\] and a curvature \[1/m\].
    #[must_use]
    pub fn resultants(&self, strain: f64, curvature: f64) -> Resultants {
        let mut sum = Resultants {
            axial: 0.0,
            moment: 0.0,
        };
        let half = 0.5 * self.section.depth;
        let mut add = |force: f64, depth: f64| {
            sum.axial += force;
            sum.moment += force * (half - depth);
        };
        let inset = law::core_inset(&self.section);
        let (core_width, _) = law::core(&self.section);
        let cuts = self.cuts(strain, curvature, inset);
        // Two points of Gauss and Legendre.
        let offset = 0.5 / 3.0_f64.sqrt();
        for ends in cuts.windows(2) {
            let (from, height) = (ends[0], ends[1] - ends[0]);
            if height <= 0.0 {
                continue;
            }
            let middle = from + 0.5 * height;
            let in_core = middle > inset && middle < self.section.depth - inset;
            let fibres = (self.count as f64 * height / self.section.depth).ceil();
            let part = height / fibres;
            for fibre in 0..fibres as usize {
                let centre = from + part * (fibre as f64 + 0.5);
                for depth in [centre - offset * part, centre + offset * part] {
                    let local = self.strain_at(strain, curvature, depth);
                    let outside = self.plain.stress(local);
                    let force = match &self.core {
                        Some(core) if in_core => {
                            core.stress(local) * core_width
                                + outside * (self.section.width - core_width)
                        }
                        _ => outside * self.section.width,
                    };
                    add(0.5 * part * force, depth);
                }
            }
        }
        let around = self.core.as_ref().unwrap_or(&self.plain);
        for bar in &self.section.bars {
            let local = self.strain_at(strain, curvature, bar.depth);
            // Bars displace concrete. In tension that is left out: it would make the force jump where a crack
            // passes a bar.
            let displaced = if local > 0.0 {
                around.stress(local)
            } else {
                0.0
            };
            add(
                bar.area() * (self.steel.stress(local) - displaced),
                bar.depth,
            );
        }
        sum
    }

    /// Depths at which the concrete stress has a corner, with both faces, in rising order.
    fn cuts(&self, strain: f64, curvature: f64, inset: f64) -> Vec<f64> {
        let height = self.section.depth;
        let mut cuts = vec![0.0, height];
        if self.core.is_some() {
            cuts.extend([inset, height - inset]);
        }
        let strains = [0.0, -self.plain.cracking_strain(), self.plain.peak_strain]
            .into_iter()
            .chain(self.core.as_ref().map(|core| core.peak_strain));
        if curvature != 0.0 {
            cuts.extend(strains.map(|corner| 0.5 * height - (corner - strain) / curvature));
        }
        cuts.retain(|depth| (0.0..=height).contains(depth));
        cuts.sort_by(f64::total_cmp);
        cuts
    }

    /// The section.
    #[must_use]
    pub fn section(&self) -> &Section {
        &self.section
    }
}
