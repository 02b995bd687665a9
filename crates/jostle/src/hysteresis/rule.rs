//! A rule on a backbone: the restoring force as a pure function of memory and deformation.

use super::backbone::{Backbone, Corner, Corners, Quantity, Side, SpringFault};
use super::buckling::{self, Buckling};
use super::circular::{CircularLaw, ForceRow};
use super::concrete::{self, ConcreteFall};
use super::failing::{self, FallingBranch};
use super::friction::{Rates, Strength};
use super::memory::{Branch, HysteresisMemory, Response, Stage};
use super::menegotto_pinto::{self, MenegottoPinto};
use super::pendulums::{self, SlidingStage};
use super::pinched::{self, Pinching};
use super::surface::{self, KeptCorners};
use super::{compression, degrading, oriented, sliders};

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
    /// Friction behind a spring, with a strength that rises from `slow` at rest to the yield force at high speed;
    /// [`Hysteresis::sliding`] makes it.
    Sliding {
        /// Strength at rest \[N\].
        slow: f64,
        /// Rate of the rise \[s/m\].
        rate: f64,
    },
    /// An elastic stop: without force up to its clearance, and on the other side; [`Hysteresis::stop`] makes it. Without
    /// clearance it is a strut that bears compression alone.
    Stop {
        /// Where it stands.
        side: Side,
        /// Clearance, ≥ 0 \[m\].
        clearance: f64,
    },
    /// Loads towards the peaks in two lines, the first one softer: timber, masonry, concrete that slips (OpenSees'
    /// `Hysteretic`, Scott and Filippou).
    Pinched(Pinching),
    /// Ground under a foundation: compression alone, plastic beyond yield; [`Hysteresis::ground`] makes it.
    Ground,
    /// Elastic to the yield force, then falling to a residual force: columns that fail in shear;
    /// [`Hysteresis::failing`] makes it.
    Failing(FallingBranch),
    /// A brace that buckles in compression, straightens and yields in tension; [`Hysteresis::buckling`] makes it.
    Buckling(Buckling),
    /// Concrete that bears compression alone, crushes, and unloads towards a strain that stays; [`Hysteresis::concrete`] makes it.
    Concrete(ConcreteFall),
    /// A bar of steel whose loops bend smoothly; [`Hysteresis::menegotto_pinto`] makes it.
    MenegottoPinto(MenegottoPinto),
    /// Sliding surfaces in series: double and triple friction pendulums; [`Hysteresis::pendulums`] makes them.
    Pendulums([SlidingStage; 3]),
    /// A row of a force in plan that is the same in every direction; [`Hysteresis::in_plan`] makes all three. On its own a row
    /// along x or across is that force on a straight line.
    InPlan {
        /// Slider or ring.
        law: CircularLaw,
        /// Its direction.
        row: ForceRow,
    },
    /// A row of a section whose axial force and moment are bounded by a surface; [`Hysteresis::surface`] makes all three. On its own
    /// a row is elastic.
    Surface {
        /// Which row.
        row: ForceRow,
        /// Corners of the surface that it keeps.
        corners: KeptCorners,
    },
    /// The same of axial force and both moments; [`Hysteresis::surface_in_space`] makes all six.
    SpaceSurface {
        /// Which row, from 0.
        row: usize,
        /// Corners of the surface that it keeps, of the plane along x in the first three rows and of that across in the others.
        corners: KeptCorners,
        /// Exponent between both planes \[–\].
        exponent: f64,
    },
}

impl HysteresisRule {
    /// Every rule of hinges and storeys, those with parameters at their defaults, in the order of the documentation.
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

    /// Exponent of the unloading stiffness of Takeda's rule.
    const fn exponent(self) -> Option<f64> {
        match self {
            Self::Takeda { exponent } => Some(exponent),
            _ => None,
        }
    }

    /// The rule of a name, with parameters at their defaults.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rule| rule.name() == name)
    }

    /// Whether the force depends on the rate of deformation, so that no straight line holds it between two corners.
    #[must_use]
    pub(crate) const fn depends_on_rate(&self) -> bool {
        match self {
            Self::Sliding { .. }
            | Self::InPlan {
                law: CircularLaw::Friction { .. },
                ..
            } => true,
            Self::Elastic
            | Self::Bilinear
            | Self::Normal
            | Self::PeakOriented
            | Self::Takeda { .. }
            | Self::DegradingTrilinear
            | Self::Stop { .. }
            | Self::Pinched(_)
            | Self::Ground
            | Self::Failing(_)
            | Self::Buckling(_)
            | Self::Concrete(_)
            | Self::MenegottoPinto(_)
            | Self::Pendulums(_)
            | Self::Surface { .. }
            | Self::SpaceSurface { .. }
            | Self::InPlan { .. } => false,
        }
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
            Self::Sliding { .. } => "friction",
            Self::Stop { .. } => "stop",
            Self::Pinched(_) => "pinched",
            Self::Ground => "ground",
            Self::Failing(_) => "failing",
            Self::Buckling(_) => "buckling",
            Self::Concrete(_) => "concrete",
            Self::MenegottoPinto(_) => "menegotto-pinto",
            Self::Pendulums(_) => "pendulums",
            Self::Surface { .. } | Self::SpaceSurface { .. } => "surface",
            Self::InPlan { law, .. } => match law {
                CircularLaw::Slider | CircularLaw::Friction { .. } | CircularLaw::Pendulums(_) => {
                    "friction in plan"
                }
                CircularLaw::Ring => "ring",
            },
        }
    }
}

/// A rule on a backbone. It is immutable; the state is a [`HysteresisMemory`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hysteresis {
    pub(super) rule: HysteresisRule,
    pub(super) backbone: Backbone,
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
                "does not apply to a bilinear curve; leave it out, or use the rule normal"
                    .to_owned(),
            ),
            HysteresisRule::Pinched(pinching) => {
                if let Some(problem) = pinching.fault() {
                    refuse(Quantity::Rule, None, problem);
                }
            }
            _ => {}
        }
        if backbone.falls() && !matches!(rule, HysteresisRule::Pinched(_)) {
            refuse(
                Quantity::PostYield,
                None,
                format!(
                    "must be at least 0 with the rule {name}: only springs with the rule pinched lose force"
                ),
            );
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

    /// Friction behind a spring of this stiffness \[N/m\], with strengths at rest and at high speed \[N\], and the rate of the
    /// rise between them \[s/m\].
    ///
    /// # Errors
    /// Numbers that are not positive, or a strength at rest above that at high speed.
    pub fn sliding(
        stiffness: f64,
        strength: [f64; 2],
        rate: f64,
    ) -> Result<Self, Vec<SpringFault>> {
        let [slow, fast] = strength;
        let corners = Corners::bilinear(fast, 0.0);
        let backbone = Backbone::from_forces(stiffness, corners, corners)?;
        if slow > 0.0 && slow <= fast && rate.is_finite() && rate >= 0.0 {
            let rule = HysteresisRule::Sliding { slow, rate };
            Ok(Self { rule, backbone })
        } else {
            Err(vec![SpringFault {
                quantity: Quantity::Rule,
                side: None,
                problem: format!(
                    "needs 0 < strength at rest <= strength at high speed and a rate of at least zero, found {slow} N, {fast} N and {rate} s/m"
                ),
            }])
        }
    }

    /// A spring of this stiffness \[N/m or N·m/rad\] that never yields.
    ///
    /// # Errors
    /// A stiffness that is not positive.
    pub fn elastic(stiffness: f64) -> Result<Self, Vec<SpringFault>> {
        let corners = Corners::bilinear(1.0, 1.0);
        let backbone = Backbone::from_deformations(stiffness, corners, corners)?;
        Self::new(HysteresisRule::Elastic, backbone)
    }

    /// A spring of this stiffness \[N/m\] that is elastic to a strength \[N\], equal in both directions, and loses it from
    /// there on.
    ///
    /// # Errors
    /// Numbers that are not positive, or a residual force that is not below the strength.
    pub fn failing(
        stiffness: f64,
        strength: f64,
        falling: FallingBranch,
    ) -> Result<Self, Vec<SpringFault>> {
        let corners = Corners::bilinear(strength, 0.0);
        let backbone = Backbone::from_forces(stiffness, corners, corners)?;
        match falling.fault(strength) {
            None => Ok(Self {
                rule: HysteresisRule::Failing(falling),
                backbone,
            }),
            Some(problem) => Err(vec![SpringFault {
                quantity: Quantity::Rule,
                side: None,
                problem,
            }]),
        }
    }

    /// What happens beyond the strength, for a spring that loses it.
    #[must_use]
    pub fn falling_branch(&self) -> Option<FallingBranch> {
        if let HysteresisRule::Failing(falling) = self.rule {
            Some(falling)
        } else {
            None
        }
    }

    /// Failure and the end of the falling branch of a spring that loses its strength, as magnitudes, with its strength as
    /// lowered so far.
    #[must_use]
    pub fn failure_corners(&self, memory: &HysteresisMemory) -> Option<[Corner; 2]> {
        let falling = self.falling_branch()?;
        Some(failing::corners(&self.backbone, &falling, memory))
    }

    /// Force that a spring that loses its strength can still bear, as far as it was deformed \[N\]; the yield force of others.
    #[must_use]
    pub fn strength_left(&self, memory: &HysteresisMemory) -> f64 {
        match self.falling_branch() {
            Some(falling) => failing::strength_left(&self.backbone, &falling, memory),
            None => self.backbone.yield_force(),
        }
    }

    /// Lowers the strength of a spring that may fail \[N\], not below its present force, and not after failure. Other springs
    /// stay as they are.
    pub fn weaken(&self, memory: &mut HysteresisMemory, strength: f64) {
        if let HysteresisRule::Failing(_) = self.rule {
            failing::weaken(&self.backbone, memory, strength);
        }
    }

    /// Slope at the origin \[N·m/rad or N/m\].
    #[must_use]
    pub fn initial_tangent(&self) -> f64 {
        match self.rule {
            HysteresisRule::Stop { clearance: 0.0, .. } => 0.5 * self.backbone.initial(),
            HysteresisRule::Pinched(_) if self.backbone.open_side().is_some() => {
                0.5 * self.backbone.initial()
            }
            HysteresisRule::Stop { .. }
            | HysteresisRule::InPlan {
                law: CircularLaw::Ring,
                ..
            }
            | HysteresisRule::InPlan {
                row: ForceRow::Between,
                ..
            }
            | HysteresisRule::Surface {
                row: ForceRow::Between,
                ..
            }
            | HysteresisRule::SpaceSurface { row: 3.., .. } => 0.0,
            HysteresisRule::Elastic
            | HysteresisRule::Bilinear
            | HysteresisRule::Normal
            | HysteresisRule::PeakOriented
            | HysteresisRule::Takeda { .. }
            | HysteresisRule::DegradingTrilinear
            | HysteresisRule::Pinched(_)
            | HysteresisRule::Ground
            | HysteresisRule::Failing(_)
            | HysteresisRule::Buckling(_)
            | HysteresisRule::Concrete(_)
            | HysteresisRule::MenegottoPinto(_)
            | HysteresisRule::Pendulums(_)
            | HysteresisRule::InPlan { .. }
            | HysteresisRule::Surface { .. }
            | HysteresisRule::SpaceSurface { .. }
            | HysteresisRule::Sliding { .. } => self.backbone.initial(),
        }
    }

    /// Whether the force depends on velocities too.
    #[must_use]
    pub fn depends_on_speed(&self) -> bool {
        self.rule.depends_on_rate()
    }

    /// Strength of friction.
    fn strength(&self, slow: f64, rate: f64) -> Strength {
        let fast = self.backbone.yield_force();
        Strength { slow, fast, rate }
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

    /// Whether it loses stiffness before it yields.
    #[must_use]
    pub fn cracks(&self) -> bool {
        Side::BOTH.into_iter().any(|side| {
            let side = self.backbone.side(side);
            side.cracking.force < side.yielding.force
        })
    }

    /// The same spring seen from its other end: sides exchanged.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let rule = match self.rule {
            HysteresisRule::Stop { side, clearance } => HysteresisRule::Stop {
                side: side.opposite(),
                clearance,
            },
            rule => rule,
        };
        Self {
            rule,
            backbone: self.backbone.mirrored(),
        }
    }

    /// Force, tangent and work of a monotonic path from the committed deformation to a trial one.
    ///
    /// Without motion the committed force is returned with the unloading tangent. It is the right one for the start
    /// of a step, since only the step itself can show that loading continues.
    ///
    /// Friction that depends on speed has its strength at rest here: motion without haste.
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
            HysteresisRule::PeakOriented | HysteresisRule::Takeda { .. } => {
                oriented::respond(&self.backbone, self.rule.exponent(), memory, deformation)
            }
            HysteresisRule::DegradingTrilinear => {
                degrading::respond(&self.backbone, memory, deformation)
            }
            HysteresisRule::Sliding { slow, rate } => {
                self.slide_slowly(self.strength(slow, rate), memory, deformation)
            }
            HysteresisRule::Stop { side, clearance } => {
                let stiffness = self.backbone.initial();
                compression::stop(stiffness, [side.sign(), clearance], memory, deformation)
            }
            HysteresisRule::Ground => {
                pinched::respond(&self.backbone, &Pinching::NONE, memory, deformation)
            }
            HysteresisRule::Pinched(pinching) => {
                pinched::respond(&self.backbone, &pinching, memory, deformation)
            }
            HysteresisRule::Failing(falling) => {
                failing::respond(&self.backbone, &falling, memory, deformation)
            }
            HysteresisRule::Buckling(law) => {
                buckling::respond(&self.backbone, &law, memory, deformation)
            }
            HysteresisRule::Concrete(fall) => {
                concrete::respond(&self.backbone, &fall, memory, deformation)
            }
            HysteresisRule::MenegottoPinto(law) => {
                menegotto_pinto::respond(&self.backbone, &law, memory, deformation)
            }
            HysteresisRule::Pendulums(stages) => {
                pendulums::respond(&self.backbone, &stages, memory, deformation)
            }
            HysteresisRule::InPlan { row, .. } => self.on_a_line(row, memory, deformation),
            HysteresisRule::Surface { .. } | HysteresisRule::SpaceSurface { .. } => {
                let force = memory.force + self.initial_tangent() * change;
                Response {
                    force,
                    tangent: self.initial_tangent(),
                    work: 0.5 * (memory.force + force) * change,
                    memory: *memory,
                }
            }
        };
        let force = response.force;
        response.memory.stand_at(deformation, force, side);
        response
    }

    /// Friction on a path so slow that its strength is that at rest.
    fn slide_slowly(
        &self,
        strength: Strength,
        memory: &HysteresisMemory,
        deformation: f64,
    ) -> Response {
        let rates = Rates::default();
        let [force, tangent] =
            strength.answer(self.backbone.initial(), memory, deformation, &rates);
        let change = deformation - memory.deformation;
        // The elastic part of the path, then the part that slides.
        let elastic = (force - memory.force) / self.backbone.initial();
        Response {
            force,
            tangent,
            work: 0.5 * (memory.force + force) * elastic + force * (change - elastic),
            memory: *memory,
        }
    }

    /// Force \[N·m or N\] and tangent \[N·m/rad or N/m\] of [`Hysteresis::respond`] alone, for trials that may be
    /// rejected: no state is copied. Friction follows the motion over the step.
    #[inline]
    pub(crate) fn answer(
        &self,
        memory: &HysteresisMemory,
        deformation: f64,
        rates: &Rates,
    ) -> [f64; 2] {
        match self.rule {
            HysteresisRule::Sliding { slow, rate } => self.strength(slow, rate).answer(
                self.backbone.initial(),
                memory,
                deformation,
                rates,
            ),
            HysteresisRule::Bilinear | HysteresisRule::Normal
                if deformation != memory.deformation =>
            {
                let answer = sliders::answer(&self.backbone, memory, deformation);
                [answer.force, answer.tangent]
            }
            HysteresisRule::Concrete(fall) if deformation != memory.deformation => {
                concrete::answer(&self.backbone, &fall, memory, deformation)
            }
            HysteresisRule::Pendulums(stages) if deformation != memory.deformation => {
                let answer = pendulums::answer(&self.backbone, &stages, memory, deformation);
                [answer.force, answer.tangent]
            }
            HysteresisRule::Elastic
            | HysteresisRule::Bilinear
            | HysteresisRule::Normal
            | HysteresisRule::PeakOriented
            | HysteresisRule::Takeda { .. }
            | HysteresisRule::DegradingTrilinear
            | HysteresisRule::Stop { .. }
            | HysteresisRule::Pinched(_)
            | HysteresisRule::Ground
            | HysteresisRule::Failing(_)
            | HysteresisRule::Buckling(_)
            | HysteresisRule::Concrete(_)
            | HysteresisRule::MenegottoPinto(_)
            | HysteresisRule::Pendulums(_)
            | HysteresisRule::Surface { .. }
            | HysteresisRule::SpaceSurface { .. }
            | HysteresisRule::InPlan { .. } => {
                self.on_the_line(memory, deformation).unwrap_or_else(|| {
                    let response = self.respond(memory, deformation);
                    [response.force, response.tangent]
                })
            }
        }
    }

    /// Force and tangent on the line of the spring, where the rule knows it and the spring neither rests, turns back nor comes
    /// to a corner: no state is copied.
    #[inline]
    fn on_the_line(&self, memory: &HysteresisMemory, deformation: f64) -> Option<[f64; 2]> {
        if deformation == memory.deformation {
            return None;
        }
        match self.rule {
            HysteresisRule::PeakOriented | HysteresisRule::Takeda { .. } => {
                let exponent = self.rule.exponent();
                oriented::on_the_line(&self.backbone, exponent, memory, deformation)
            }
            HysteresisRule::Pinched(_) | HysteresisRule::Ground => {
                pinched::on_the_line(&self.backbone, memory, deformation)
            }
            HysteresisRule::Failing(falling) => {
                failing::on_the_line(&self.backbone, &falling, memory, deformation)
            }
            HysteresisRule::Elastic => {
                let stiffness = self.backbone.initial();
                Some([stiffness * deformation, stiffness])
            }
            _ => None,
        }
    }

    /// Updates the committed state in place, as [`Hysteresis::respond`] does. Friction takes the force of the step.
    #[inline]
    pub(crate) fn commit(&self, memory: &mut HysteresisMemory, deformation: f64, force: f64) {
        match self.rule {
            HysteresisRule::Sliding { .. }
            | HysteresisRule::Concrete(_)
            | HysteresisRule::Surface { .. }
            | HysteresisRule::SpaceSurface { .. }
            | HysteresisRule::InPlan { .. } => {
                let side = Side::from_change(deformation - memory.deformation);
                memory.stand_at(deformation, force, side);
            }
            HysteresisRule::Bilinear | HysteresisRule::Normal => {
                let change = deformation - memory.deformation;
                if change != 0.0 {
                    let answer = sliders::answer(&self.backbone, memory, deformation);
                    memory.offsets = answer.offsets;
                    memory.stand_at(deformation, answer.force, Side::from_change(change));
                }
            }
            HysteresisRule::Elastic
            | HysteresisRule::PeakOriented
            | HysteresisRule::Takeda { .. }
            | HysteresisRule::Pinched(_)
            | HysteresisRule::Ground
            | HysteresisRule::Failing(_) => match self.on_the_line(memory, deformation) {
                Some([force, _]) => memory.move_on_the_line(deformation, force),
                None => *memory = self.respond(memory, deformation).memory,
            },
            HysteresisRule::DegradingTrilinear
            | HysteresisRule::Stop { .. }
            | HysteresisRule::MenegottoPinto(_)
            | HysteresisRule::Pendulums(_)
            | HysteresisRule::Buckling(_) => *memory = self.respond(memory, deformation).memory,
        }
    }

    /// Whether a way through these deformations moves a peak of a spring whose peaks damage moves further.
    pub(crate) fn is_damaged_on_the_way(&self, memory: &HysteresisMemory, way: &[f64]) -> bool {
        let HysteresisRule::Pinched(pinching) = &self.rule else {
            return false;
        };
        let end = || {
            way.iter()
                .fold(*memory, |memory, to| self.respond(&memory, *to).memory)
        };
        let damage = pinching.ductility_damage + pinching.energy_damage;
        damage > 0.0 && end().peaks != memory.peaks
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
            HysteresisRule::Stop { .. }
            | HysteresisRule::InPlan {
                law: CircularLaw::Ring,
                ..
            } if memory.force == 0.0 => 0.0,
            HysteresisRule::InPlan {
                row: ForceRow::Between,
                ..
            }
            | HysteresisRule::Surface {
                row: ForceRow::Between,
                ..
            }
            | HysteresisRule::SpaceSurface { row: 3.., .. } => 0.0,
            HysteresisRule::Elastic
            | HysteresisRule::Bilinear
            | HysteresisRule::Normal
            | HysteresisRule::PeakOriented
            | HysteresisRule::Sliding { .. }
            | HysteresisRule::Failing(_)
            | HysteresisRule::MenegottoPinto(_)
            | HysteresisRule::Pendulums(_)
            | HysteresisRule::InPlan { .. }
            | HysteresisRule::Surface { .. }
            | HysteresisRule::SpaceSurface { .. }
            | HysteresisRule::Stop { .. } => self.backbone.initial(),
            HysteresisRule::Pinched(pinching) => {
                pinched::unloading_stiffness(&self.backbone, &pinching, memory)
            }
            HysteresisRule::Buckling(law) => {
                buckling::unloading_stiffness(&self.backbone, &law, memory)
            }
            HysteresisRule::Concrete(fall) => {
                concrete::unloading_stiffness(&self.backbone, &fall, memory)
            }
            HysteresisRule::Ground => {
                pinched::unloading_stiffness(&self.backbone, &Pinching::NONE, memory)
            }
        }
    }

    /// Stored energy, ≥ 0 \[J\]. The work done on the spring minus this energy is dissipated, and is never got back.
    ///
    /// Of rules with kinematic hardening, it is that of their elastic springs, those in series with sliders and the bowls of pendulums
    /// included; of others, what unloading to zero force would release, F² / 2k.
    #[must_use]
    pub fn recoverable_energy(&self, memory: &HysteresisMemory) -> f64 {
        match self.rule {
            HysteresisRule::Bilinear | HysteresisRule::Normal => {
                return sliders::stored_energy(&self.backbone, memory);
            }
            // Without force.
            HysteresisRule::Surface {
                row: ForceRow::Between,
                ..
            }
            | HysteresisRule::SpaceSurface { row: 3.., .. } => return 0.0,
            HysteresisRule::Surface { .. } | HysteresisRule::SpaceSurface { .. } => {
                return surface::stored_energy(&self.backbone, memory);
            }
            HysteresisRule::Pendulums(stages)
            | HysteresisRule::InPlan {
                law: CircularLaw::Pendulums(stages),
                row: ForceRow::X | ForceRow::Y,
            } => return pendulums::stored_energy(&self.backbone, &stages, memory),
            _ if memory.force == 0.0 => return 0.0,
            _ => {}
        }
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
            HysteresisRule::PeakOriented | HysteresisRule::Takeda { .. } => {
                oriented::next_corner(&self.backbone, self.rule.exponent(), memory, towards)
            }
            HysteresisRule::DegradingTrilinear => {
                degrading::next_corner(&self.backbone, memory, towards)
            }
            HysteresisRule::Sliding { slow, .. } => {
                let reach = (slow - towards.sign() * memory.force) / self.backbone.initial();
                if reach > 0.0 {
                    memory.deformation + towards.sign() * reach
                } else {
                    towards.sign() * f64::INFINITY
                }
            }
            HysteresisRule::Stop { side, clearance } => {
                let clearance = side.sign() * clearance;
                let ahead = towards.sign() * (clearance - memory.deformation) > 0.0;
                if ahead {
                    clearance
                } else {
                    towards.sign() * f64::INFINITY
                }
            }
            HysteresisRule::Pinched(pinching) => {
                pinched::next_corner(&self.backbone, &pinching, memory, towards)
            }
            HysteresisRule::Ground => {
                pinched::next_corner(&self.backbone, &Pinching::NONE, memory, towards)
            }
            HysteresisRule::Failing(falling) => {
                failing::next_corner(&self.backbone, &falling, memory, towards)
            }
            HysteresisRule::Buckling(law) => {
                buckling::next_corner(&self.backbone, &law, memory, towards)
            }
            HysteresisRule::Concrete(fall) => {
                concrete::next_corner(&self.backbone, &fall, memory, towards)
            }
            HysteresisRule::MenegottoPinto(law) => {
                menegotto_pinto::next_corner(&self.backbone, &law, memory, towards)
            }
            HysteresisRule::Pendulums(stages) => {
                pendulums::next_corner(&self.backbone, &stages, memory, towards)
            }
            HysteresisRule::InPlan { .. }
            | HysteresisRule::Surface { .. }
            | HysteresisRule::SpaceSurface { .. } => towards.sign() * f64::INFINITY,
        }
    }

    /// Greatest deformation of a side over its yield deformation, ≥ 0 \[–\].
    #[must_use]
    pub fn ductility(&self, memory: &HysteresisMemory, side: Side) -> f64 {
        memory.greatest(side) / self.backbone.side(side).yielding.deformation
    }

    /// Largest loading stage so far, on either side. Elastic springs, stops and rows of a force in plan never
    /// crack; a spring that failed has yielded.
    #[must_use]
    pub fn stage(&self, memory: &HysteresisMemory) -> Stage {
        if let HysteresisRule::Failing(_) = self.rule {
            return if memory.branch == Branch::Virgin {
                Stage::Uncracked
            } else {
                Stage::Yielded
            };
        }
        if let HysteresisRule::Buckling(_) = self.rule
            && self.has_buckled(memory)
        {
            return Stage::Buckled;
        }
        if matches!(
            self.rule,
            HysteresisRule::Elastic | HysteresisRule::Stop { .. } | HysteresisRule::InPlan { .. }
        ) {
            return Stage::Uncracked;
        }
        let has_force = match self.rule {
            HysteresisRule::Surface { row, .. } => Some(row != ForceRow::Between),
            HysteresisRule::SpaceSurface { row, .. } => Some(row < 3),
            _ => None,
        };
        if let Some(has_force) = has_force {
            return if has_force && self.has_flowed(memory) {
                Stage::Yielded
            } else {
                Stage::Uncracked
            };
        }
        if let HysteresisRule::Concrete(_) = self.rule {
            // It begins to crush at its strength.
            let peak = self.backbone.side(Side::Negative).yielding.deformation;
            return if memory.greatest(Side::Negative) > peak {
                Stage::Yielded
            } else {
                Stage::Uncracked
            };
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
        let falling = FallingBranch {
            slope: 4e4,
            residual: 60.0,
        };
        let failing = Hysteresis::failing(1e5, 250.0, falling).expect("sound");
        let springs = rules.into_iter().map(|(rule, backbone)| {
            Hysteresis::new(rule, backbone.expect("sound")).expect("sound")
        });
        let fall = ConcreteFall {
            residual: 0.2,
            ultimate: 4.0,
        };
        let concrete = Hysteresis::concrete(250.0, 0.004, fall).expect("sound");
        let stage = |friction: f64| SlidingStage {
            friction,
            stiffness: 4e4,
            travel: 0.008,
        };
        let stages = [stage(60.0), stage(150.0), SlidingStage::STILL];
        let pendulums = Hysteresis::pendulums(1e5, stages).expect("sound");
        for spring in springs.chain([failing, concrete, pendulums]) {
            let rule = spring.rule();
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
                let answer = spring.answer(&kept, at, &Rates::default());
                assert_eq!(answer, [response.force, response.tangent], "{rule:?}, {i}");
                if i % 3 != 0 {
                    known = response.memory;
                    spring.commit(&mut kept, at, answer[0]);
                    assert_eq!(kept, known, "{rule:?}, {i}");
                }
                furthest = furthest.max(spring.ductility(&known, Side::Negative));
            }
            assert!(furthest > 1.5, "{rule:?} never yielded: {furthest}");
        }
    }
}
