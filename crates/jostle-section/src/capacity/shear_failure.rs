//! Loss of strength of columns that fail in shear.

use super::{MPA, RatedMember, ShearRule, ShearStrength, drift_at_axial_failure};
use crate::formula::Member;
use jostle::model::CapacityLine;

/// Shear strength of a column under its axial load, and how it is lost.
#[derive(Clone, Debug, PartialEq)]
pub struct ShearLoss {
    /// Strength before any yielding \[N\].
    pub strength: f64,
    /// Strength against ductility, where the rule lets it fall; otherwise empty \[N, –\].
    pub by_ductility: CapacityLine,
    /// Drift ratio at shear failure, by Elwood and Moehle \[–\].
    pub failure_drift: f64,
    /// Drift ratio at axial failure, at which no shear strength is left \[–\].
    pub axial_failure_drift: f64,
    /// Loss of shear per displacement of the column between the two drifts, > 0; `None` if the column reaches axial failure
    /// first \[N/m\].
    pub slope: Option<f64>,
}

/// Why the loss of strength of a column is not known.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NoShearLoss {
    /// It has no ties.
    #[error("it has no ties, so that its shear strength is unknown")]
    NoTies,
    /// It is a beam.
    #[error("shear failure is for columns")]
    Beam,
}

impl RatedMember<'_> {
    /// Strength by a rule under a compression \[N\], and the slope at which it is lost: from the drift at shear failure to
    /// that at axial failure, over the clear length.
    ///
    /// # Errors
    /// [`NoShearLoss`].
    pub fn shear_loss(&self, rule: ShearRule, compression: f64) -> Result<ShearLoss, NoShearLoss> {
        if self.member == Member::Beam {
            return Err(NoShearLoss::Beam);
        }
        let strength = rule
            .strength(self, compression)
            .ok_or(NoShearLoss::NoTies)?;
        let initial = strength.initial();
        let axial = drift_at_axial_failure(self.section, compression).ok_or(NoShearLoss::NoTies)?;
        let shear = self
            .drift_at_shear_failure(initial, compression)
            .ok_or(NoShearLoss::NoTies)?;
        Ok(ShearLoss {
            strength: initial,
            by_ductility: by_ductility(rule, &strength),
            failure_drift: shear,
            axial_failure_drift: axial,
            slope: (axial > shear).then(|| initial / ((axial - shear) * self.clear_length)),
        })
    }

    /// Drift ratio at shear failure of a column that yielded before, under a shear \[N\] and a compression \[N\]:
    ///
    /// ```text
    /// Δs/L = 3/100 + 4 ρ″ − (1/40) v/√f'c − (1/40) P/(Ag f'c) ≥ 1/100    [MPa]
    /// ```
    /// ρ″ = Ast/(b s), v = V/(b d). `None` without ties.
    ///
    /// K. J. Elwood and J. P. Moehle (2005), Earthq. Spectra 21, 71–89.
    #[must_use]
    pub fn drift_at_shear_failure(&self, shear: f64, compression: f64) -> Option<f64> {
        let ties = self.section.ties?;
        let (width, strength) = (self.section.width, self.section.concrete.strength);
        let ratio = ties.area() / (width * ties.spacing);
        let stress = MPA * shear / (width * self.effective_depth());
        let drift = 0.03 + 4.0 * ratio
            - stress / (MPA * strength).sqrt() / 40.0
            - compression.max(0.0) / (self.section.area() * strength) / 40.0;
        Some(drift.max(0.01))
    }
}

/// Strength against ductility as straight lines; empty for a rule without degradation, or if the bound of the rule
/// governs at every ductility.
fn by_ductility(rule: ShearRule, strength: &ShearStrength) -> CapacityLine {
    let at = |ductility: f64| strength.at(rule.degradation().factor(ductility));
    let range = match rule.degradation() {
        super::Degradation::None => return CapacityLine::default(),
        super::Degradation::Plastic => [1.0, 6.0],
        super::Degradation::Ductility => [2.0, 6.0],
    };
    if at(range[1]) >= at(range[0]) {
        return CapacityLine::default();
    }
    let mut points = vec![[range[0], at(range[0])]];
    // Where the bound of the rule ends.
    let unbounded = strength.steady + strength.degrading;
    if unbounded > strength.limit {
        let last = strength.steady + rule.degradation().factor(range[1]) * strength.degrading;
        let share = (unbounded - strength.limit) / (unbounded - last);
        points.push([range[0] + share * (range[1] - range[0]), strength.limit]);
    }
    points.push([range[1], at(range[1])]);
    CapacityLine::new(points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Concrete, Reinforcement, Section, Steel, StrengthLevel, Ties};

    fn section(ties: &str) -> Section {
        let concrete = Concrete::grade("C30", StrengthLevel::Characteristic).expect("known");
        let steel = Steel::grade("HRB400", StrengthLevel::Characteristic).expect("known");
        let bars = Reinforcement::parse("12 d20").expect("understood");
        Section::new(
            0.5,
            0.5,
            concrete,
            steel,
            &bars,
            0.03,
            Ties::parse(ties).ok(),
        )
        .expect("sound")
    }

    fn rated(section: &Section) -> RatedMember<'_> {
        RatedMember {
            section,
            member: Member::Column,
            clear_length: 2.7,
            level: StrengthLevel::Characteristic,
        }
    }

    #[test]
    fn elwood_and_moehle_by_hand() {
        // 500 × 500 mm, fc = 20.1 MPa, d = 460 mm, two legs d10 @ 150 mm (157.08 mm²), 1000 kN.
        let section = section("d10 @ 150 mm");
        let loss = rated(&section)
            .shear_loss(ShearRule::SezenMoehle, 1e6)
            .expect("ties");
        // 447 597 N, see the test of the rule; v = 447 597/230 000 = 1.94607 MPa, √fc = 4.48330.
        // ρ″ = 157.08/(500 · 150) = 0.0020944; P/(Ag fc) = 0.199005.
        // 0.03 + 0.0083776 − 0.0108518 − 0.0049751 = 0.0225507.
        let close = |value: f64, due: f64| {
            assert!((value / due - 1.0).abs() < 2e-4, "{value} instead of {due}");
        };
        close(loss.strength, 447_597.0);
        close(loss.failure_drift, 0.022_550_7);
        // Axial failure at 0.048494, see there: 447 597/(0.0259433 · 2.7).
        close(loss.axial_failure_drift, 0.048_494);
        close(loss.slope.expect("shear first"), 6_390_000.0);
        let left: Vec<f64> = [1.0, 2.0, 4.0, 6.0, 9.0]
            .iter()
            .map(|ductility| loss.by_ductility.at(*ductility) / loss.strength)
            .collect();
        for (left, due) in left.iter().zip([1.0, 1.0, 0.85, 0.7, 0.7]) {
            close(*left, due);
        }
        // The American units of the same formula: 1/500 of v/√f'c in psi.
        let psi = 6894.757;
        let [v, root] = [
            loss.strength / (0.5 * 0.46) / psi,
            (20.1e6_f64 / psi).sqrt(),
        ];
        let american = 0.03 + 4.0 * 0.002_094_4 - v / root / 500.0 - 0.199_005 / 40.0;
        assert!((loss.failure_drift - american).abs() < 5e-4, "{american}");
    }

    #[test]
    fn columns_under_great_loads_lose_them_first() {
        // Light ties far apart: under 2500 kN, Δa is below the least Δs.
        let section = section("d6 @ 400 mm");
        let loss = rated(&section).shear_loss(ShearRule::Asce41, 2.5e6);
        let loss = loss.expect("ties");
        assert_eq!(loss.slope, None);
        assert!(loss.axial_failure_drift <= loss.failure_drift, "{loss:?}");
        let mut bare = section.clone();
        bare.ties = None;
        let found = rated(&bare).shear_loss(ShearRule::Gb50010, 1e6);
        assert_eq!(found, Err(NoShearLoss::NoTies));
    }

    #[test]
    fn a_bound_ends_at_some_ductility() {
        let strength = ShearStrength {
            steady: 100.0,
            degrading: 200.0,
            limit: 280.0,
        };
        let line = by_ductility(ShearRule::Asce41, &strength);
        // 100 + 200 k = 280 at k = 0.9, ductility 2 + 4/3.
        for (ductility, due) in [
            (1.0, 280.0),
            (3.0, 280.0),
            (10.0 / 3.0, 280.0),
            (4.0, 270.0),
            (8.0, 240.0),
        ] {
            assert!(
                (line.at(ductility) - due).abs() < 1e-9,
                "{line:?} at {ductility}"
            );
        }
        assert!(
            by_ductility(ShearRule::Gb50010, &strength)
                .points()
                .is_empty()
        );
    }
}
