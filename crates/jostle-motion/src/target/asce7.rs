//! ASCE 7-16, section 11.4.6; ASCE 7-22, section 11.4.5.2 (the two-period spectrum).

use crate::fault::MotionFault;

/// Design response spectrum of ASCE 7 for 5 % damping.
///
/// ```text
/// T < T₀        S_a = S_DS (0.4 + 0.6 T/T₀),     T₀ = 0.2 S_D1/S_DS
/// T ≤ T_S       S_a = S_DS,                      T_S = S_D1/S_DS
/// T ≤ T_L       S_a = S_D1 (1 s)/T
/// T > T_L       S_a = S_D1 (1 s) T_L/T²
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asce7 {
    /// Design acceleration at short periods, > 0 \[m/s²\].
    pub short: f64,
    /// Design acceleration at 1 s, > 0 \[m/s²\].
    pub one_second: f64,
    /// Long-period transition period, > 0 \[s\].
    pub long_period: f64,
}

/// The only damping ratio of this code \[–\].
const DAMPING: f64 = 0.05;

impl Asce7 {
    pub(super) fn acceleration(&self, t: f64, damping: f64) -> Result<f64, MotionFault> {
        if damping != DAMPING {
            return Err(MotionFault::OtherDamping {
                given: DAMPING,
                wanted: damping,
            });
        }
        let (sds, sd1, tl) = (self.short, self.one_second, self.long_period);
        let ts = sd1 / sds;
        let t0 = 0.2 * ts;
        Ok(if t < t0 {
            sds * (0.4 + 0.6 * t / t0)
        } else if t <= ts {
            sds
        } else if t <= tl {
            sd1 / t
        } else {
            sd1 * tl / (t * t)
        })
    }

    pub(super) fn name(&self) -> String {
        format!(
            "ASCE 7, SDS = {} m/s², SD1 = {} m/s², TL = {} s",
            self.short, self.one_second, self.long_period
        )
    }
}
