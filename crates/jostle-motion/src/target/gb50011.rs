//! GB 50011-2010 (2016), clauses 3.10.3 and 5.1.2 to 5.1.5.

use crate::accelerogram::STANDARD_GRAVITY;

/// Design spectrum of GB 50011-2010.
///
/// ```text
/// T ≤ 0.1 s    α = [0.45 + 10 T (η₂ − 0.45)] α_max
/// T ≤ T_g      α = η₂ α_max
/// T ≤ 5 T_g    α = (T_g/T)^γ η₂ α_max
/// T ≤ 6 s      α = [η₂ 0.2^γ − η₁ (T − 5 T_g)] α_max
/// γ = 0.9 + (0.05 − ζ)/(0.3 + 6ζ),  η₁ = 0.02 + (0.05 − ζ)/(4 + 32ζ) ≥ 0,
/// η₂ = 1 + (0.05 − ζ)/(0.08 + 1.6ζ) ≥ 0.55
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gb50011 {
    /// Fortification intensity.
    pub intensity: GbIntensity,
    /// Site class.
    pub site: GbSite,
    /// Design earthquake group.
    pub group: GbGroup,
    /// Level of shaking.
    pub level: GbLevel,
}

/// Fortification intensity with its design basic acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GbIntensity {
    /// 6, 0.05 g.
    Six,
    /// 7, 0.10 g.
    Seven,
    /// 7, 0.15 g.
    SevenHalf,
    /// 8, 0.20 g.
    Eight,
    /// 8, 0.30 g.
    EightHalf,
    /// 9, 0.40 g.
    Nine,
}

/// Site class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GbSite {
    /// Rock, I0.
    I0,
    /// I1.
    I1,
    /// II.
    II,
    /// III.
    III,
    /// IV.
    IV,
}

/// Design earthquake group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GbGroup {
    /// First group.
    First,
    /// Second group.
    Second,
    /// Third group.
    Third,
}

/// Level of shaking.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GbLevel {
    /// Exceeded with 63 % in 50 years.
    Frequent,
    /// Exceeded with 10 % in 50 years; α_max of clause 3.10.3.
    Fortification,
    /// Exceeded with 2 to 3 % in 50 years; T_g grows by 0.05 s.
    Rare,
}

impl Gb50011 {
    /// Largest influence coefficient α_max \[–\]: Table 5.1.4-1 and clause 3.10.3.
    #[must_use]
    pub fn largest_coefficient(&self) -> f64 {
        let row = match self.level {
            GbLevel::Frequent => [0.04, 0.08, 0.12, 0.16, 0.24, 0.32],
            GbLevel::Fortification => [0.12, 0.23, 0.34, 0.45, 0.68, 0.90],
            GbLevel::Rare => [0.28, 0.50, 0.72, 0.90, 1.20, 1.40],
        };
        row[self.intensity as usize]
    }

    /// Characteristic period T_g \[s\]: Table 5.1.4-2.
    #[must_use]
    pub fn characteristic_period(&self) -> f64 {
        let row = match self.group {
            GbGroup::First => [0.20, 0.25, 0.35, 0.45, 0.65],
            GbGroup::Second => [0.25, 0.30, 0.40, 0.55, 0.75],
            GbGroup::Third => [0.30, 0.35, 0.45, 0.65, 0.90],
        };
        let more = if self.level == GbLevel::Rare {
            0.05
        } else {
            0.0
        };
        row[self.site as usize] + more
    }

    /// Peak of accelerograms for time-history analysis \[m/s²\]: Table 5.1.2-2; the design basic acceleration at
    /// the fortification level.
    #[must_use]
    pub fn time_history_peak(&self) -> f64 {
        let i = self.intensity as usize;
        match self.level {
            GbLevel::Frequent => [18.0, 35.0, 55.0, 70.0, 110.0, 140.0][i] / 100.0,
            GbLevel::Fortification => STANDARD_GRAVITY * [0.05, 0.10, 0.15, 0.20, 0.30, 0.40][i],
            GbLevel::Rare => [125.0, 220.0, 310.0, 400.0, 510.0, 620.0][i] / 100.0,
        }
    }

    /// Influence coefficient α at a period in `0..=6` \[s\] and a damping ratio ζ \[–\].
    #[must_use]
    pub fn coefficient(&self, period: f64, damping: f64) -> f64 {
        let (t, tg, z) = (period, self.characteristic_period(), damping);
        let gamma = 0.9 + (0.05 - z) / (0.3 + 6.0 * z);
        let eta1 = (0.02 + (0.05 - z) / (4.0 + 32.0 * z)).max(0.0);
        let eta2 = (1.0 + (0.05 - z) / (0.08 + 1.6 * z)).max(0.55);
        let shape = if t <= 0.1 {
            0.45 + 10.0 * t * (eta2 - 0.45)
        } else if t <= tg {
            eta2
        } else if t <= 5.0 * tg {
            libm::pow(tg / t, gamma) * eta2
        } else {
            eta2 * libm::pow(0.2_f64, gamma) - eta1 * (t - 5.0 * tg)
        };
        shape * self.largest_coefficient()
    }

    pub(super) fn acceleration(&self, period: f64, damping: f64) -> f64 {
        STANDARD_GRAVITY * self.coefficient(period, damping)
    }

    pub(super) fn name(&self) -> String {
        let intensity = [
            "6",
            "7 (0.10 g)",
            "7 (0.15 g)",
            "8 (0.20 g)",
            "8 (0.30 g)",
            "9",
        ];
        let level = match self.level {
            GbLevel::Frequent => "frequent",
            GbLevel::Fortification => "fortification",
            GbLevel::Rare => "rare",
        };
        format!(
            "GB 50011, intensity {}, site {:?}, group {}, {level}",
            intensity[self.intensity as usize],
            self.site,
            self.group as usize + 1
        )
    }
}
