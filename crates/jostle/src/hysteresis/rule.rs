//! A rule on a backbone: the restoring force as a pure function of memory and deformation.

use super::backbone::{Backbone, Quantity, Side, SpringFault};
use super::memory::{HysteresisMemory, Response, Stage};
use super::pinched::{self, Pinching};
use super::{degrading, oriented, sliders};

/// Exponent of the unloading stiffness of Takeda's rule after yield \[–\] (Takeda, Sozen and Nielsen, 1970).
pub const DEFAULT_TAKEDA_EXPONENT: f64 = 0.4;

/// Unloading and reloading rule of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HysteresisRule {
    /// Always the initial stiffness.
    Elastic,
    /// Kinematic hardening with one corner (Prager's model).
    Bilinear,
    /// Kinematic hardening with two corners: Masing's rule, as sliders in parallel (Iwan, 1966).
    Normal,
    /// Unloads with the initial stiffness; loads straight to the greatest deformation of that side so far,
    /// initially its cracking point (Clough and Johnston, 1966, on a trilinear curve).
    PeakOriented,
    /// Takeda, Sozen and Nielsen (1970): unloads towards the cracking point of the other side, after yield with
    /// a stiffness that falls with the ductility; inner loops go straight to the peaks.
    Takeda {
        /// Exponent of this decrease, 0…1 \[–\]; [`DEFAULT_TAKEDA_EXPONENT`] is usual.
        exponent: f64,
    },
    /// Degrading trilinear (Fukada, 1969; Muto, 1973): between the peaks a bilinear loop whose stiffnesses are
    /// reduced by one factor, so that it connects both peaks.
    DegradingTrilinear,
    /// Loads towards the peaks in two lines, the first one softer: timber, masonry, concrete that slips (OpenSees'
    /// `Hysteretic`, Scott and Filippou).
    Pinched(Pinching),
}

impl HysteresisRule {
    /// Every rule, those with parameters at their defaults, in the order of the documentation.
    pub const ALL: [Self; 7] = [
        Self::Normal,
        Self::PeakOriented,
        Self::Takeda {
            exponent: DEFAULT_TAKEDA_EXPONENT,
        },
        Self::DegradingTrilinear,
        Self::Pinched(Pinching::USUAL),
        Self::Bilinear,
        Self::Elastic,
    ];

    /// The rule of a name, with parameters at their defaults.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rule| rule.name() == name)
    }

    /// Name in model files.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Elastic => "elastic",
            Self::Bilinear => "bilinear",
            Self::Normal => "normal",
            Self::PeakOriented => "peak-oriented",
            Self::Takeda { .. } => "takeda",
            Self::DegradingTrilinear => "d-tri",
            Self::Pinched(_) => "pinched",
        }
    }
}

/// A rule on a backbone. It is immutable; the state is a [`HysteresisMemory`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hysteresis {
    rule: HysteresisRule,
    backbone: Backbone,
}

impl Hysteresis {
    /// Combines a rule and a backbone.
    ///
    /// # Errors
    /// All errors: an exponent out of range, a cracking point for `bilinear` or none for `d-tri`, sides with
    /// different stiffness ratios where the rule has only one.
    pub fn new(rule: HysteresisRule, backbone: Backbone) -> Result<Self, Vec<SpringFault>> {
        let mut faults = Vec::new();
        let mut refuse = |quantity, side, problem: String| {
            faults.push(SpringFault {
                quantity,
                side,
                problem,
            });
        };
        let [positive, negative] = Side::BOTH.map(|side| backbone.side(side));
        let name = rule.name();
        match rule {
            HysteresisRule::Takeda { exponent } if !(0.0..=1.0).contains(&exponent) => refuse(
                Quantity::Rule,
                None,
                format!("the exponent of takeda must lie between 0 and 1, found {exponent}"),
            ),
            HysteresisRule::Bilinear if !backbone.is_bilinear() => refuse(
                Quantity::Cracking,
                None,
                "has no place in a bilinear curve; leave it out, or use the rule normal".to_owned(),
            ),
            HysteresisRule::Pinched(pinching) => {
                if let Some(problem) = pinching.fault() {
                    refuse(Quantity::Rule, None, problem);
                }
            }
            _ => {}
        }
        let one_second_slope = matches!(
            rule,
            HysteresisRule::Normal | HysteresisRule::DegradingTrilinear
        );
        if one_second_slope && positive.post_cracking != negative.post_cracking {
            refuse(
                Quantity::PostCracking,
                Some(Side::Negative),
                format!(
                    "must be equal on both sides with the rule {name}; peak-oriented, takeda and pinched allow any"
                ),
            );
        }
        let one_third_slope = matches!(rule, HysteresisRule::Normal | HysteresisRule::Bilinear);
        if one_third_slope && positive.post_yield != negative.post_yield {
            refuse(
                Quantity::PostYield,
                Some(Side::Negative),
                format!(
                    "must be equal on both sides with the rule {name}; peak-oriented, takeda and pinched allow any"
                ),
            );
        }
        if rule == HysteresisRule::DegradingTrilinear {
            for side in Side::BOTH {
                let curve = backbone.side(side);
                let three = curve.post_cracking < backbone.initial()
                    && curve.cracking.deformation < curve.yielding.deformation;
                if !three {
                    refuse(
                        Quantity::Cracking,
                        Some(side),
                        "must lie below yield, with post_cracking below 1: the loops of d-tri live between the two".to_owned(),
                    );
                }
            }
        }
        if faults.is_empty() {
            Ok(Self { rule, backbone })
        } else {
            Err(faults)
        }
    }

    /// The rule.
    #[must_use]
    pub fn rule(&self) -> HysteresisRule {
        self.rule
    }

    /// The curve of first loading.
    #[must_use]
    pub fn backbone(&self) -> &Backbone {
        &self.backbone
    }

    /// The same spring seen from its other end: sides exchanged.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self {
            rule: self.rule,
            backbone: self.backbone.mirrored(),
        }
    }

    /// Force, tangent and work of a monotonic path from the committed deformation to a trial one.
    ///
    /// Without motion the committed force is returned with the unloading tangent. It is the right one for the start
    /// of a step, since only the step itself can show that loading continues.
    #[must_use]
    #[inline]
    pub fn respond(&self, memory: &HysteresisMemory, deformation: f64) -> Response {
        let change = deformation - memory.deformation;
        if change == 0.0 {
            return Response {
                force: memory.force,
                tangent: self.unloading_stiffness(memory),
                work: 0.0,
                memory: *memory,
            };
        }
        let side = Side::from_change(change);
        let mut response = match self.rule {
            HysteresisRule::Elastic => elastic(&self.backbone, memory, deformation),
            HysteresisRule::Bilinear | HysteresisRule::Normal => {
                sliders::respond(&self.backbone, memory, deformation)
            }
            HysteresisRule::PeakOriented => {
                oriented::respond(&self.backbone, None, memory, deformation)
            }
            HysteresisRule::Takeda { exponent } => {
                oriented::respond(&self.backbone, Some(exponent), memory, deformation)
            }
            HysteresisRule::DegradingTrilinear => {
                degrading::respond(&self.backbone, memory, deformation)
            }
            HysteresisRule::Pinched(pinching) => {
                pinched::respond(&self.backbone, &pinching, memory, deformation)
            }
        };
        let force = response.force;
        response.memory.stand_at(deformation, force, side);
        response
    }

    /// Force \[N·m or N\] and tangent \[N·m/rad or N/m\] of [`Hysteresis::respond`] alone, for trials that may be
    /// rejected: no state is copied.
    #[inline]
    pub(crate) fn answer(&self, memory: &HysteresisMemory, deformation: f64) -> [f64; 2] {
        match self.rule {
            HysteresisRule::Bilinear | HysteresisRule::Normal
                if deformation != memory.deformation =>
            {
                let answer = sliders::answer(&self.backbone, memory, deformation);
                [answer.force, answer.tangent]
            }
            _ => {
                let response = self.respond(memory, deformation);
                [response.force, response.tangent]
            }
        }
    }

    /// Updates the committed state in place, as [`Hysteresis::respond`] does.
    #[inline]
    pub(crate) fn commit(&self, memory: &mut HysteresisMemory, deformation: f64) {
        match self.rule {
            HysteresisRule::Bilinear | HysteresisRule::Normal => {
                let change = deformation - memory.deformation;
                if change != 0.0 {
                    let answer = sliders::answer(&self.backbone, memory, deformation);
                    memory.offsets = answer.offsets;
                    memory.stand_at(deformation, answer.force, Side::from_change(change));
                }
            }
            _ => *memory = self.respond(memory, deformation).memory,
        }
    }

    /// Slope of the spring after a reversal at the present point \[N·m/rad or N/m\].
    #[must_use]
    pub fn unloading_stiffness(&self, memory: &HysteresisMemory) -> f64 {
        match self.rule {
            HysteresisRule::Takeda { exponent } => {
                oriented::unloading_stiffness(&self.backbone, Some(exponent), memory)
            }
            HysteresisRule::DegradingTrilinear => {
                degrading::factor(&self.backbone, memory) * self.backbone.initial()
            }
            HysteresisRule::Pinched(pinching) => {
                pinched::unloading_stiffness(&self.backbone, &pinching, memory)
            }
            _ => self.backbone.initial(),
        }
    }

    /// Energy that unloading to zero force would release, F² / 2k, ≥ 0 \[J\]. The work done on the spring minus
    /// this energy is dissipated.
    #[must_use]
    pub fn recoverable_energy(&self, memory: &HysteresisMemory) -> f64 {
        0.5 * memory.force * memory.force / self.unloading_stiffness(memory)
    }

    /// Deformation at the end of the straight line on which the spring moves towards a side, after a reversal if
    /// necessary; infinite if the line has no end \[rad or m\].
    #[must_use]
    pub fn next_corner(&self, memory: &HysteresisMemory, towards: Side) -> f64 {
        match self.rule {
            HysteresisRule::Elastic => towards.sign() * f64::INFINITY,
            HysteresisRule::Bilinear | HysteresisRule::Normal => {
                sliders::next_corner(&self.backbone, memory, towards)
            }
            HysteresisRule::PeakOriented => {
                oriented::next_corner(&self.backbone, None, memory, towards)
            }
            HysteresisRule::Takeda { exponent } => {
                oriented::next_corner(&self.backbone, Some(exponent), memory, towards)
            }
            HysteresisRule::DegradingTrilinear => {
                degrading::next_corner(&self.backbone, memory, towards)
            }
            HysteresisRule::Pinched(pinching) => {
                pinched::next_corner(&self.backbone, &pinching, memory, towards)
            }
        }
    }

    /// Greatest deformation of a side over its yield deformation, ≥ 0 \[–\].
    #[must_use]
    pub fn ductility(&self, memory: &HysteresisMemory, side: Side) -> f64 {
        memory.greatest(side) / self.backbone.side(side).yielding.deformation
    }

    /// Largest loading stage so far, on either side. Elastic springs never crack.
    #[must_use]
    pub fn stage(&self, memory: &HysteresisMemory) -> Stage {
        if self.rule == HysteresisRule::Elastic {
            return Stage::Uncracked;
        }
        let of = |side: Side| {
            let (curve, reached) = (self.backbone.side(side), memory.greatest(side));
            if reached > curve.yielding.deformation {
                Stage::Yielded
            } else if reached > curve.cracking.deformation {
                Stage::Cracked
            } else {
                Stage::Uncracked
            }
        };
        of(Side::Positive).max(of(Side::Negative))
    }
}

fn elastic(backbone: &Backbone, memory: &HysteresisMemory, deformation: f64) -> Response {
    let force = backbone.initial() * deformation;
    Response {
        force,
        tangent: backbone.initial(),
        work: 0.5 * (force + memory.force) * (deformation - memory.deformation),
        memory: *memory,
    }
}

#[cfg(test)]
mod tests {
    use super::super::backbone::Corners;
    use super::*;

    const WORN: Pinching = Pinching {
        unloading_exponent: 0.3,
        ductility_damage: 0.01,
        energy_damage: 0.01,
        ..Pinching::USUAL
    };

    /// The short functions give the same force and state as the long one, bit by bit, when sliding and reversing.
    #[test]
    fn answers_and_commits_are_those_of_whole_responses() {
        let corners = |yielding: f64, post_yield: f64| Corners {
            cracking: 100.0,
            yielding,
            post_cracking: 0.3,
            post_yield,
        };
        let trilinear = |negative: f64| {
            Backbone::from_forces(1e5, corners(250.0, 0.02), corners(negative, 0.02))
        };
        let bilinear = Corners::bilinear(250.0, 0.02);
        let bilinear = Backbone::from_forces(1e5, bilinear, bilinear);
        let exponent = DEFAULT_TAKEDA_EXPONENT;
        let rules = [
            (HysteresisRule::Elastic, trilinear(250.0)),
            (HysteresisRule::Bilinear, bilinear),
            (HysteresisRule::Normal, trilinear(180.0)),
            (HysteresisRule::PeakOriented, trilinear(180.0)),
            (HysteresisRule::Takeda { exponent }, trilinear(180.0)),
            (HysteresisRule::DegradingTrilinear, trilinear(250.0)),
            (HysteresisRule::Pinched(WORN), trilinear(180.0)),
        ];
        for (rule, backbone) in rules {
            let spring = Hysteresis::new(rule, backbone.expect("sound")).expect("sound");
            let (mut known, mut kept) = (HysteresisMemory::default(), HysteresisMemory::default());
            let mut furthest = 0.0_f64;
            for i in 0..400 {
                // Every third point is only a trial, every seventh does not move.
                let x = f64::from(i);
                let at = if i % 7 == 6 {
                    known.deformation()
                } else {
                    4e-5 * x * (0.9 * x).sin()
                };
                let response = spring.respond(&known, at);
                let answer = spring.answer(&kept, at);
                assert_eq!(answer, [response.force, response.tangent], "{rule:?}, {i}");
                if i % 3 != 0 {
                    known = response.memory;
                    spring.commit(&mut kept, at);
                    assert_eq!(kept, known, "{rule:?}, {i}");
                }
                furthest = furthest.max(spring.ductility(&known, Side::Negative));
            }
            assert!(furthest > 1.5, "{rule:?} never yielded: {furthest}");
        }
    }
}
