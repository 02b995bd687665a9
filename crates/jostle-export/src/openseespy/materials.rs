//! Hysteresis rules and contact laws as uniaxial materials of OpenSees.

use jostle::LinkLaw;
use jostle::contact::ForceLaw;
use jostle::hysteresis::{
    Backbone, BackboneSide, ConcreteFall, Corner, FallingBranch, Hysteresis, HysteresisRule,
    MenegottoPinto, Side, energy_to_yield,
};
use jostle::interface::{Contact, LinkElement};

/// Materials of a script, numbered from 1, equal ones listed once.
#[derive(Default)]
pub(super) struct Materials {
    /// Name in OpenSees, and the arguments after the tag.
    list: Vec<(&'static str, Vec<f64>)>,
}

/// How far the last straight line of a backbone is drawn, in yield deformations \[–\].
const FAR: f64 = 1e4;
/// Gap of sides that touch at rest: OpenSees needs a number below zero \[m\].
const NO_GAP: f64 = 1e-12;
/// A force that elastic-plastic contact never reaches \[N\].
const NEVER: f64 = 1e30;

/// Three points of one side of a backbone, as magnitudes.
fn corners(curve: &BackboneSide) -> [Corner; 3] {
    let limit = curve.yielding.deformation;
    let last = curve
        .end_of_fall()
        .map_or(FAR * limit, |end| end.deformation);
    let deformations = if curve.cracking.deformation < limit {
        [curve.cracking.deformation, limit, last]
    } else if curve.post_yield < 0.0 {
        [0.5 * limit, limit, last]
    } else {
        [limit, 2.0 * limit, last]
    };
    deformations.map(|deformation| Corner {
        deformation,
        force: curve.force_at(deformation),
    })
}

/// Area under both sides of the backbone, as OpenSees computes it \[J\].
fn area(backbone: &Backbone) -> f64 {
    let mut total = 0.0;
    for side in Side::BOTH {
        let mut last = Corner::default();
        for corner in corners(backbone.side(side)) {
            total += 0.5 * (corner.force + last.force) * (corner.deformation - last.deformation);
            last = corner;
        }
    }
    total
}

impl Materials {
    /// Every material: tag, name, arguments. A word after the name follows its arguments.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, &'static str, &[f64])> {
        let numbered = self.list.iter().enumerate();
        numbered.map(|(index, (name, arguments))| (index + 1, *name, &arguments[..]))
    }

    /// Tag of a material.
    fn add(&mut self, name: &'static str, arguments: Vec<f64>) -> usize {
        let known = self
            .list
            .iter()
            .position(|(other, others)| *other == name && *others == arguments);
        known.unwrap_or_else(|| {
            self.list.push((name, arguments));
            self.list.len() - 1
        }) + 1
    }

    /// A spring with a parallel dashpot.
    pub(super) fn elastic(&mut self, stiffness: f64, dashpot: f64) -> usize {
        let mut arguments = vec![stiffness];
        if dashpot != 0.0 {
            arguments.push(dashpot);
        }
        self.add("Elastic", arguments)
    }

    /// A spring that yields.
    ///
    /// # Errors
    /// The name of a rule that OpenSees does not have.
    pub(super) fn yielding(&mut self, hysteresis: &Hysteresis) -> Result<usize, &'static str> {
        let backbone = hysteresis.backbone();
        match hysteresis.rule() {
            HysteresisRule::Elastic => Ok(self.elastic(backbone.initial(), 0.0)),
            HysteresisRule::Bilinear | HysteresisRule::Normal => Ok(self.sliders(backbone)),
            HysteresisRule::PeakOriented => {
                Ok(self.hysteretic(backbone, [1.0, 1.0, 0.0, 0.0, 0.0]))
            }
            HysteresisRule::Pinched(_) if backbone.open_side().is_some() => {
                Err("pinched in compression only")
            }
            HysteresisRule::Pinched(pinching) => {
                // OpenSees relates dissipated energy to the area of the whole backbone.
                let ratio = area(backbone) / energy_to_yield(backbone);
                let parameters = [
                    pinching.deformation,
                    pinching.force,
                    pinching.ductility_damage,
                    pinching.energy_damage * ratio,
                    pinching.unloading_exponent,
                ];
                Ok(self.hysteretic(backbone, parameters))
            }
            HysteresisRule::Stop { side, clearance } => {
                Ok(self.gap(backbone.initial(), clearance, side.sign()))
            }
            HysteresisRule::Failing(falling) => Ok(self.failing(backbone, falling)),
            HysteresisRule::Concrete(fall) => Ok(self.concrete(backbone, fall)),
            HysteresisRule::MenegottoPinto(law) => Ok(self.smooth_steel(backbone, law)),
            rule @ (HysteresisRule::Takeda { .. }
            | HysteresisRule::DegradingTrilinear
            | HysteresisRule::Sliding { .. }
            | HysteresisRule::Buckling(_)
            | HysteresisRule::Pendulums(_)
            | HysteresisRule::Ground
            | HysteresisRule::Surface { .. }
            | HysteresisRule::SpaceSurface { .. }
            | HysteresisRule::InPlan { .. }) => Err(rule.name()),
        }
    }

    /// Ground in compression alone; where it yields, the gap that it leaves stays. Strain is the rise of what stands on it, or the
    /// opposite if it is turned.
    pub(super) fn ground(&mut self, hysteresis: &Hysteresis, turned: bool) -> usize {
        let backbone = hysteresis.backbone();
        let stiffness = backbone.initial();
        let sinking = if turned { 1.0 } else { -1.0 };
        let BackboneSide {
            yielding,
            post_yield,
            ..
        } = *backbone.side(Side::Negative);
        // Without a gap it has its stiffness at rest as well.
        let gap = sinking * 0.0;
        if post_yield == stiffness {
            return self.add("ElasticPPGap", vec![stiffness, sinking * NEVER, gap]);
        }
        let strength = sinking * yielding.force;
        let arguments = vec![stiffness, strength, gap, post_yield / stiffness];
        self.add("ElasticPPGap damage", arguments)
    }

    /// `Concrete01`: strength and residual strength, with the compressions at which they are reached.
    fn concrete(&mut self, backbone: &Backbone, fall: ConcreteFall) -> usize {
        let Corner { deformation, force } = backbone.side(Side::Negative).yielding;
        let residual = [fall.residual * force, fall.ultimate * deformation];
        let arguments = [force, deformation].into_iter().chain(residual);
        self.add("Concrete01", arguments.map(|value| -value).collect())
    }

    /// `Steel02`, after Menegotto and Pinto as well.
    fn smooth_steel(&mut self, backbone: &Backbone, law: MenegottoPinto) -> usize {
        let (initial, post_yield) = (backbone.initial(), backbone.side(Side::Positive).post_yield);
        let arguments = vec![
            backbone.yield_force(),
            initial,
            post_yield / initial,
            law.sharpness,
            law.loss,
            law.half,
        ];
        self.add("Steel02", arguments)
    }

    /// A spring that is elastic up to a strain, and then slides.
    pub(super) fn slider(&mut self, stiffness: f64, slips: f64) -> usize {
        self.add("ElasticPP", vec![stiffness, slips, -slips])
    }

    /// An elastic spring that acts beyond a strain, of positive strains with sign 1 and of negative ones with −1.
    pub(super) fn gap(&mut self, stiffness: f64, at: f64, sign: f64) -> usize {
        let at = sign * at.max(NO_GAP);
        self.add("ElasticPPGap", vec![stiffness, sign * NEVER, at])
    }

    /// The law of a link, strain being u_right − u_left and so its lengthening, or its shortening if it is turned; and what is different
    /// about it.
    ///
    /// # Errors
    /// The name of a rule that OpenSees does not have.
    pub(super) fn link(
        &mut self,
        link: &LinkElement,
        turned: bool,
    ) -> Result<(usize, Option<&'static str>), &'static str> {
        const IN_SERIES: &str = "ViscousDamper integrates spring and dashpot in series within each step, at constant rate of \
             deformation; jostle takes the mean force of the step.";
        let (stiffness, damping) = (link.stiffness, link.damping);
        let longer = if turned { -1.0 } else { 1.0 };
        Ok(match &link.law {
            LinkLaw::Linear => (self.elastic(stiffness, damping), None),
            LinkLaw::Viscous { exponent } if stiffness == 0.0 => {
                (self.add("Viscous", vec![damping, *exponent]), None)
            }
            LinkLaw::Viscous { exponent } => (
                self.add("ViscousDamper", vec![stiffness, damping, *exponent]),
                Some(IN_SERIES),
            ),
            LinkLaw::Maxwell => (
                self.add("ViscousDamper", vec![stiffness, damping, 1.0]),
                Some(IN_SERIES),
            ),
            LinkLaw::Friction {
                slip_force,
                stick_stiffness,
            } => {
                let slips = slip_force / stick_stiffness;
                (self.slider(*stick_stiffness, slips), None)
            }
            LinkLaw::Yielding(shortened) if turned => (self.yielding(shortened)?, None),
            LinkLaw::Yielding(shortened) => (self.yielding(&shortened.mirrored())?, None),
            LinkLaw::Cable { slack } => (self.gap(stiffness, *slack, longer), None),
            LinkLaw::Stopper { gap } if damping == 0.0 => {
                (self.gap(stiffness, *gap, -longer), None)
            }
            LinkLaw::Stopper { gap } => (
                self.add(
                    "ViscoelasticGap",
                    vec![stiffness, damping, -gap.max(NO_GAP)],
                ),
                Some(
                    "ViscoelasticGap of a stopper pulls before it opens; jostle cuts the force at zero.",
                ),
            ),
        })
    }

    /// Iwan's parallel springs, which is what the rules are.
    fn sliders(&mut self, backbone: &Backbone) -> usize {
        let [positive, negative] = Side::BOTH.map(|side| *backbone.side(side));
        let second = if backbone.is_bilinear() {
            backbone.initial()
        } else {
            positive.post_cracking
        };
        let mut parts = Vec::new();
        let corners = [
            (
                backbone.initial() - second,
                positive.cracking.deformation,
                negative.cracking.deformation,
            ),
            (
                second - positive.post_yield,
                positive.yielding.deformation,
                negative.yielding.deformation,
            ),
        ];
        for (stiffness, right, left) in corners {
            if stiffness > 0.0 {
                parts.push(self.add("ElasticPP", vec![stiffness, right, -left]));
            }
        }
        if positive.post_yield > 0.0 {
            parts.push(self.elastic(positive.post_yield, 0.0));
        }
        match parts[..] {
            [single] => single,
            _ => self.add("Parallel", parts.iter().map(|tag| *tag as f64).collect()),
        }
    }

    /// `Hysteretic`; the parameters are pinching in deformation and force, damage by ductility and energy, and the
    /// exponent of unloading.
    fn hysteretic(&mut self, backbone: &Backbone, parameters: [f64; 5]) -> usize {
        let mut arguments = Vec::new();
        for (side, sign) in [(Side::Positive, 1.0), (Side::Negative, -1.0)] {
            for Corner { deformation, force } in corners(backbone.side(side)) {
                arguments.extend([sign * force, sign * deformation]);
            }
        }
        arguments.extend(parameters);
        self.add("Hysteretic", arguments)
    }

    /// `LimitState`: three points of the backbone, the slope of the falling branch and the residual force. The driver adds the
    /// limit curve, which must name an element, and the other parameters.
    fn failing(&mut self, backbone: &Backbone, falling: FallingBranch) -> usize {
        let failure = backbone.side(Side::Positive).yielding;
        let end = Corner {
            deformation: failure.deformation + (failure.force - falling.residual) / falling.slope,
            force: falling.residual,
        };
        let middle = Corner {
            deformation: 0.5 * (failure.deformation + end.deformation),
            force: 0.5 * (failure.force + end.force),
        };
        let mut arguments = Vec::new();
        for sign in [1.0, -1.0] {
            for Corner { deformation, force } in [failure, middle, end] {
                arguments.extend([sign * force, sign * deformation]);
            }
        }
        arguments.extend([falling.slope, falling.residual]);
        self.add("LimitState", arguments)
    }

    /// The law of a contact, strain being u_right − u_left, and what is different about it.
    ///
    /// # Errors
    /// Replacement for a law that OpenSees does not have.
    pub(super) fn contact(
        &mut self,
        contact: &Contact,
    ) -> Result<(usize, Option<&'static str>), &'static str> {
        let gap = -contact.width.max(NO_GAP);
        const IMPACT_SPEED: &str = "Hertzdamp divides by the closing rate at the end of the first closed step, not at first \
             contact: its damping depends on the step and converges with it. It is in tension where damping exceeds \
             the spring force; jostle cuts the force at zero. Its tangent has the wrong sign, which is harmless at small steps.";
        const FIRST_ORDER: &str = "ImpactMaterial adds the first stiffness times the whole increment of the step that closes the gap, \
             its open part too: it tends to jostle's law with the first order of the step. At 0.2 ms, 0.05 ms and 0.02 ms the \
             impulse of an example was 1.4, 0.4 and 0.2 % off, the peak force 0.2, 0.04 and 0.03 %.";
        Ok(match contact.law {
            ForceLaw::Hertz { stiffness, damping } => (
                self.add("Hertzdamp", vec![stiffness, damping, gap, 1.5]),
                (damping > 0.0).then_some(IMPACT_SPEED),
            ),
            ForceLaw::DampedLinear { stiffness, damping } => (
                self.add("Hertzdamp", vec![stiffness, damping, gap, 1.0]),
                Some(IMPACT_SPEED),
            ),
            ForceLaw::Kelvin {
                stiffness,
                damping: 0.0,
                ..
            } => (
                self.add("ElasticPPGap", vec![stiffness, -NEVER, gap]),
                None,
            ),
            ForceLaw::Kelvin {
                stiffness,
                damping,
                tension,
            } => (
                self.add("ViscoelasticGap", vec![stiffness, damping, gap]),
                (!tension).then_some(
                    "ViscoelasticGap pulls before it opens; jostle's kelvin-no-tension cuts the force at zero. Compare \
                     with law = \"kelvin\" instead.",
                ),
            ),
            ForceLaw::Jankowski { stiffness, damping } => {
                let mass = contact.effective_mass();
                let ratio = damping / (2.0 * (stiffness * mass).sqrt());
                (
                    self.add("JankowskiImpact", vec![stiffness, ratio, mass, gap, 1.5]),
                    None,
                )
            }
            ForceLaw::ApproachKelvin { stiffness, damping } => {
                let mass = contact.effective_mass();
                let ratio = damping / (2.0 * (stiffness * mass).sqrt());
                (
                    self.add("JankowskiImpact", vec![stiffness, ratio, mass, gap, 1.0]),
                    None,
                )
            }
            ForceLaw::Bilinear(law) if !law.follows_speed => (
                self.add(
                    "ImpactMaterial",
                    vec![
                        law.first_stiffness,
                        law.second_stiffness,
                        -law.yield_indentation,
                        gap,
                    ],
                ),
                Some(FIRST_ORDER),
            ),
            ForceLaw::Crushing(law) if law.hertzian => {
                return Err(
                    "OpenSees has no contact after Hertz that stays crushed; write law = \"linear\" with crush, or leave crush out",
                );
            }
            // Crushed material stays crushed: the gap widens.
            ForceLaw::Crushing(law) => (
                self.add(
                    "ElasticPPGap damage",
                    vec![law.stiffness, -law.force, gap, law.hardening],
                ),
                Some(
                    "Faces crush as in jostle, but impacts are counted here where they come closer than the original gap: \
                     jostle counts from the crushed face, and fewer.",
                ),
            ),
            ForceLaw::Bilinear(_) => {
                return Err(
                    "OpenSees' ImpactMaterial has the same stiffnesses at every impact; give the law a design_speed, or second_stiffness and yield",
                );
            }
            ForceLaw::Restitution { .. } => {
                return Err(
                    "OpenSees cannot change velocities at once; use a law with a force, such as hertz-damp",
                );
            }
            ForceLaw::Formula(_) => {
                return Err("OpenSees has no contact law by a formula; use hertz-damp or kelvin");
            }
            ForceLaw::Rubber(_) => {
                return Err("OpenSees has no rubber bumper; use hertz-damp or kelvin");
            }
        })
    }
}
