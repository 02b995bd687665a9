//! What is stepped: buildings, the gaps between them, their ground motion.

use std::f64::consts::PI;

/// Buildings of one row.
pub(crate) const MOST_BUILDINGS: usize = 32;

/// Storeys of one building.
pub(crate) const MOST_STOREYS: usize = 16;

/// How storeys of a building yield.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// They do not; corners are not read.
    Elastic,
    /// Kinematic hardening from the first corner on; the second corner is not read.
    Bilinear,
    /// Reloads towards the greatest deformation of the side; unloads with the initial stiffness.
    PeakOriented,
    /// Reloads in two lines through a pinch point.
    Pinched {
        /// Where the steep line begins, 0…1 of the way from zero force to the unloading line of the peak \[–\].
        deformation: f64,
        /// Force there over the force at the peak, 0…1 \[–\].
        force: f64,
        /// Exponent a of the unloading stiffness k₁ (d_c/p)^a, p the greatest deformation, 0…1 \[–\].
        unloading_exponent: f64,
    },
}

/// One storey and the floor above it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Storey {
    /// Mass of the floor above \[kg\], > 0.
    pub mass: f64,
    /// Initial stiffness k₁ \[N/m\], > 0.
    pub stiffness: f64,
    /// Height \[m\], > 0; drifts are in metres, so it matters only where floors of neighbours differ in level.
    pub height: f64,
    /// Drift at the first corner d_c \[m\], > 0.
    pub first_corner: f64,
    /// Drift at the second corner d_y ≥ d_c \[m\].
    pub second_corner: f64,
    /// k₂/k₁ beyond the first corner, 0…1 \[–\].
    pub second_ratio: f64,
    /// k₃/k₁ beyond the second corner, 0…`second_ratio` \[–\].
    pub third_ratio: f64,
}

/// A shear building on a fixed base, 1–16 storeys from the ground up.
#[derive(Clone, Debug, PartialEq)]
pub struct Building {
    /// From the ground up.
    pub storeys: Vec<Storey>,
    /// How its storeys yield.
    pub rule: Rule,
    /// Damping in proportion to mass \[1/s\], ≥ 0.
    pub alpha: f64,
    /// Damping in proportion to the initial stiffness, also of storeys that yield \[s\], ≥ 0.
    pub beta: f64,
}

/// Where a contact acts on a building: `share` of the force on `floor`, the rest on the floor below (lever rule).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Floor from 0, the one above the first storey.
    pub floor: usize,
    /// Share of the force on `floor`, 0 < share ≤ 1; 1 is at the slab, less is on the columns below it \[–\].
    pub share: f64,
}

/// One point where neighbours touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// On the left building.
    pub left: Face,
    /// On the right building.
    pub right: Face,
}

/// Force law of contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// F = k δ^1.5 (1 + ¾(1 − e²) δ̇/v₀), not below zero.
    HertzDamp {
        /// k \[N/m^1.5\], > 0.
        stiffness: f64,
        /// e, 0…1 \[–\].
        restitution: f64,
    },
    /// F = k δ + c δ̇ until release; c from the masses of the floors that touch.
    Kelvin {
        /// k \[N/m\], > 0.
        stiffness: f64,
        /// e, 0 < e ≤ 1 \[–\].
        restitution: f64,
    },
    /// F = k δ.
    Linear {
        /// k \[N/m\], > 0.
        stiffness: f64,
    },
}

/// The gap between a building and the next to its right.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Width \[m\], ≥ 0.
    pub width: f64,
    /// `None` lets the buildings pass through each other, and measures how near they come.
    pub law: Option<Law>,
    /// Where they touch, at most 32.
    pub contacts: Vec<Contact>,
}

/// Ground acceleration at equal steps, linear between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Time step \[s\], > 0.
    pub step: f64,
    /// Acceleration \[m/s²\], at least two points.
    pub acceleration: Vec<f64>,
}

/// Buildings in a line, from left to right.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// 1–32 buildings.
    pub buildings: Vec<Building>,
    /// One fewer.
    pub gaps: Vec<Gap>,
    /// Index of its motion.
    pub motion: usize,
    /// Factor on the motion \[–\].
    pub scale: f64,
}

impl Contact {
    /// Slab against slab of the same floor, from 0.
    #[must_use]
    pub const fn of_floor(floor: usize) -> Self {
        let face = Face { floor, share: 1.0 };
        Self {
            left: face,
            right: face,
        }
    }

    /// Whether a slab strikes columns.
    #[must_use]
    pub fn strikes_column(&self) -> bool {
        self.left.share < 1.0 || self.right.share < 1.0
    }
}

impl Building {
    /// Levels of floors above the ground \[m\].
    fn levels(&self) -> Vec<f64> {
        let mut level = 0.0;
        let up = |storey: &Storey| {
            level += storey.height;
            level
        };
        self.storeys.iter().map(up).collect()
    }

    /// Where a level above the ground meets the building; slabs nearer than `slab` count as that slab.
    fn face_at(&self, level: f64, slab: f64) -> Option<Face> {
        let levels = self.levels();
        let near = |floor_level: &f64| (floor_level - level).abs() <= slab;
        if let Some(floor) = levels.iter().position(near) {
            return Some(Face { floor, share: 1.0 });
        }
        let floor = levels.iter().position(|candidate| *candidate > level)?;
        let height = self.storeys[floor].height;
        let share = 1.0 - (levels[floor] - level) / height;
        (share > 0.0).then_some(Face { floor, share })
    }

    /// Square of a frequency that no mode exceeds \[1/s²\].
    pub(crate) fn highest_squared(&self) -> f64 {
        let above = |i: usize| {
            self.storeys
                .get(i + 1)
                .map_or(0.0, |storey| storey.stiffness)
        };
        let rows = self.storeys.iter().enumerate();
        rows.map(|(i, storey)| 2.0 * (storey.stiffness + above(i)) / storey.mass)
            .fold(0.0, f64::max)
    }
}

impl Gap {
    /// Contacts wherever a slab of either side meets the other building: slab to slab where floors differ by no more
    /// than 0.3 m, else slab to column. The right ground lies `right_base` above the left one \[m\].
    #[must_use]
    pub fn between(
        left: &Building,
        right: &Building,
        width: f64,
        law: Option<Law>,
        right_base: f64,
    ) -> Self {
        const SLAB: f64 = 0.3;
        let mut contacts = Vec::new();
        for (floor, level) in left.levels().iter().enumerate() {
            if let Some(other) = right.face_at(level - right_base, SLAB) {
                let face = Face { floor, share: 1.0 };
                contacts.push(Contact {
                    left: face,
                    right: other,
                });
            }
        }
        for (floor, level) in right.levels().iter().enumerate() {
            let met = left.face_at(level + right_base, SLAB);
            if let Some(other) = met.filter(|met| met.share < 1.0) {
                let face = Face { floor, share: 1.0 };
                contacts.push(Contact {
                    left: other,
                    right: face,
                });
            }
        }
        Self {
            width,
            law,
            contacts,
        }
    }
}

/// Constants of a contact: force per δ or δ^1.5, its dashpots by rate over v₀ and by rate.
pub(crate) struct ContactConstants {
    pub(crate) stiffness: f64,
    pub(crate) hertz: bool,
    pub(crate) by_ratio: f64,
    pub(crate) by_rate: f64,
}

impl Law {
    /// For a contact between faces of a reduced mass \[kg\].
    pub(crate) fn constants(self, reduced_mass: f64) -> ContactConstants {
        let (stiffness, hertz, by_ratio, by_rate) = match self {
            Self::HertzDamp {
                stiffness,
                restitution,
            } => (
                stiffness,
                true,
                0.75 * (1.0 - restitution * restitution),
                0.0,
            ),
            Self::Kelvin {
                stiffness,
                restitution,
            } => {
                let ln = libm::log(restitution);
                let ratio = -ln / (PI * PI + ln * ln).sqrt();
                (
                    stiffness,
                    false,
                    0.0,
                    2.0 * ratio * (stiffness * reduced_mass).sqrt(),
                )
            }
            Self::Linear { stiffness } => (stiffness, false, 0.0, 0.0),
        };
        ContactConstants {
            stiffness,
            hertz,
            by_ratio,
            by_rate,
        }
    }
}
