//! Springs that bear compression alone: stops, struts, and the ground under a foundation.

use super::backbone::{Backbone, Corners, Quantity, Side, SpringFault};
use super::memory::{Branch, HysteresisMemory, Response};
use super::pinched;
use super::rule::{Hysteresis, HysteresisRule};

/// Shortening at which ground without a strength would yield: further than any foundation sinks \[m\].
const NEVER: f64 = 1e3;

impl Hysteresis {
    /// An elastic stop of this stiffness \[N/m\] behind a clearance \[m\] on a side.
    ///
    /// # Errors
    /// Numbers that are not positive.
    pub fn stop(stiffness: f64, clearance: f64, side: Side) -> Result<Self, Vec<SpringFault>> {
        let corners = Corners::bilinear(clearance, 1.0);
        let backbone = Backbone::from_deformations(stiffness, corners, corners)?;
        let rule = HysteresisRule::Stop { side, clearance };
        Ok(Self { rule, backbone })
    }

    /// An elastic strut of this stiffness \[N/m\] that bears compression alone: F = k min(d, 0).
    ///
    /// Such struts come in pairs, one of which acts whichever way a bay sways: at rest each counts with half its stiffness.
    ///
    /// # Errors
    /// A stiffness that is not positive.
    pub fn without_tension(stiffness: f64) -> Result<Self, Vec<SpringFault>> {
        // It has no yield deformation; its curve of first loading says so by one metre.
        let corners = Corners::bilinear(1.0, 1.0);
        let backbone = Backbone::from_deformations(stiffness, corners, corners)?;
        let (side, clearance) = (Side::Negative, 0.0);
        let rule = HysteresisRule::Stop { side, clearance };
        Ok(Self { rule, backbone })
    }

    /// The same pinched spring in compression alone: in tension it has no force, and it bears again where it lost its force in compression.
    ///
    /// # Errors
    /// Another rule.
    pub fn in_compression(self) -> Result<Self, SpringFault> {
        match self.rule {
            HysteresisRule::Pinched(_) => Ok(Self {
                backbone: self.backbone.without_tension(),
                ..self
            }),
            _ => Err(SpringFault {
                quantity: Quantity::Rule,
                side: None,
                problem: format!(
                    "{} has no form that bears compression alone; take pinched",
                    self.rule.name()
                ),
            }),
        }
    }

    /// Whether the spring can be removed from the model: struts, which bear compression alone.
    #[must_use]
    pub fn can_be_removed(&self) -> bool {
        match self.rule {
            HysteresisRule::Stop { clearance, .. } => clearance == 0.0,
            HysteresisRule::Pinched(_) => self.backbone.open_side().is_some(),
            _ => false,
        }
    }

    /// Takes a strut out of the model: it has no force from now on, and what it had stored is lost. Other springs stay as they are.
    pub fn remove(&self, memory: &mut HysteresisMemory) {
        if self.can_be_removed() {
            (memory.branch, memory.force) = (Branch::Gone, 0.0);
        }
    }

    /// The same strut of a share of the area, > 0: forces and stiffnesses times it, deformations as they are \[–\].
    #[must_use]
    pub fn of_share(self, share: f64) -> Self {
        Self {
            backbone: self.backbone.times(share),
            ..self
        }
    }

    /// Ground of this stiffness \[N/m\] under a part of a foundation, with a strength \[N\] and the ratio of the stiffness after it
    /// to the initial one, 0…1 \[–\]; `None` is elastic. It has no force where the foundation stands higher than the ground as
    /// the greatest force has left it: F = min(k (d − p), F_y + ηk (d − F_y/k)) over the sinking *d*, with the settlement *p*
    /// (theory, Eq. B25).
    ///
    /// The weight of the building presses it, so that it counts with its whole stiffness at rest.
    ///
    /// # Errors
    /// Numbers that are not positive.
    pub fn ground(stiffness: f64, strength: Option<[f64; 2]>) -> Result<Self, Vec<SpringFault>> {
        let backbone = match strength {
            Some([strength, hardening]) => {
                let corners = Corners::bilinear(strength, hardening);
                Backbone::from_forces(stiffness, corners, corners)?
            }
            None => {
                let corners = Corners::bilinear(NEVER, 1.0);
                Backbone::from_deformations(stiffness, corners, corners)?
            }
        };
        Ok(Self {
            rule: HysteresisRule::Ground,
            backbone: backbone.without_tension(),
        })
    }

    /// How far the ground has settled where it no longer bears, ≥ 0; zero for other springs \[m\].
    #[must_use]
    pub fn settlement(&self, memory: &HysteresisMemory) -> f64 {
        if self.rule != HysteresisRule::Ground {
            return 0.0;
        }
        let lost = match pinched::open_from(&self.backbone, memory) {
            Some(corner) => corner.deformation,
            None => self.next_corner(memory, Side::Positive),
        };
        (-lost).max(0.0)
    }
}

/// Only the part of the path beyond the clearance does work.
pub(super) fn stop(
    stiffness: f64,
    [sign, clearance]: [f64; 2],
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    let into = match memory.branch {
        Branch::Gone => 0.0,
        _ => (sign * deformation - clearance).max(0.0),
    };
    let force = sign * stiffness * into;
    Response {
        force,
        tangent: if into > 0.0 { stiffness } else { 0.0 },
        work: 0.5 * (force * force - memory.force * memory.force) / stiffness,
        memory: *memory,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// F = min(k(d − p), F_y + ηk(d − F_y/k)) ≥ 0 over the sinking d; on its second branch p = d − F/k, and p never falls. Work that does not come
    /// back is dissipated.
    #[test]
    fn ground_crushes_and_leaves_a_gap() {
        let (k, strength) = (2e8, 6e5);
        for hardening in [0.0, 0.05, 0.6] {
            let ground = Hysteresis::ground(k, Some([strength, hardening])).expect("sound");
            let elastic = Hysteresis::ground(k, None).expect("sound");
            let (mut memory, mut bent) = (HysteresisMemory::default(), HysteresisMemory::default());
            let (mut crushed, mut work) = (0.0_f64, 0.0);
            for i in 0..600 {
                let x = f64::from(i);
                let sinking = 3e-5 * x * libm::sin(0.37 * x) + 1e-3 * libm::cos(1.3 * x);
                let second = strength + hardening * k * (sinking - strength / k);
                let first = k * (sinking - crushed);
                let due = first.min(second).max(0.0);
                if second < first && due > 0.0 {
                    crushed = sinking - due / k;
                }
                let response = ground.respond(&memory, -sinking);
                memory = response.memory;
                work += response.work;
                assert!(
                    (response.force + due).abs() < 1e-9 * strength.max(due),
                    "{i}: {} {due}",
                    response.force
                );
                assert!((ground.settlement(&memory) - crushed).abs() < 1e-15 + 1e-12 * crushed);
                let left = work - ground.recoverable_energy(&memory);
                assert!(left > -1e-9 * strength * 1e-2, "{left}");
                let response = elastic.respond(&bent, -sinking);
                bent = response.memory;
                let due = k * sinking.max(0.0);
                assert!((response.force + due).abs() <= 1e-12 * due);
                assert_eq!(elastic.settlement(&bent), 0.0);
            }
            assert!(crushed > 1e-3 && work > 0.0);
            assert_eq!(ground.initial_tangent(), k);
        }
    }
}
