//! Sliding surfaces one above the other: double and triple friction pendulums.
//!
//! Stages in series share a force *F*; each slides against its friction *f* up a bowl of stiffness *k*, as far as its travel *d*
//! (D. M. Fenz and M. C. Constantinou, 2008, Earthquake Eng. Struct. Dyn. 37, 163–183 and 185–205):
//!
//! ```text
//! u = F / kₑ + Σ sᵢ,   |F − kᵢ sᵢ| ≤ fᵢ,   |sᵢ| ≤ dᵢ
//! ```
//!
//! An elastic spring *kₑ* is in series with them; it bears alone where no stage slides, also where all stand at their rims. Moving to one
//! side, a stage stands still, slides, and stands at its rim, so that *u* rises with *F* along straight lines.

use std::cmp::Ordering;

use super::backbone::{Backbone, Corners, Quantity, Side, SpringFault};
use super::memory::{HysteresisMemory, Response};
use super::rule::{Hysteresis, HysteresisRule};

/// A stage of a bearing with several sliding surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingStage {
    /// Friction *f*, > 0 \[N\].
    pub friction: f64,
    /// Stiffness *k* of the bowl, weight over radius, > 0 \[N/m\].
    pub stiffness: f64,
    /// How far it slides to either side, > 0; may be infinite \[m\].
    pub travel: f64,
}

impl SlidingStage {
    /// One that never slides.
    pub const STILL: Self = Self {
        friction: f64::INFINITY,
        stiffness: 1.0,
        travel: f64::INFINITY,
    };

    /// The same of a bearing with a share of the weight, > 0 \[–\].
    pub(crate) fn of_share(self, share: f64) -> Self {
        match self == Self::STILL {
            true => self,
            false => Self {
                friction: share * self.friction,
                stiffness: share * self.stiffness,
                ..self
            },
        }
    }

    /// Force at which it starts to slide from a place, and that at which it reaches its rim, towards the positive side.
    fn slides_between(&self, place: f64) -> [f64; 2] {
        [place, self.travel].map(|at| self.friction + self.stiffness * at)
    }

    /// Place under a force that has risen from less.
    fn place(&self, from: f64, force: f64) -> f64 {
        let [start, rim] = self.slides_between(from);
        if force >= rim {
            self.travel
        } else if force > start {
            (force - self.friction) / self.stiffness
        } else {
            from
        }
    }
}

impl Hysteresis {
    /// Stages in series behind an elastic spring \[N/m\]; [`SlidingStage::STILL`] fills the places of those that there are not.
    ///
    /// # Errors
    /// Numbers that are not positive, or no stage that slides.
    pub fn pendulums(elastic: f64, stages: [SlidingStage; 3]) -> Result<Self, Vec<SpringFault>> {
        let sound = |stage: &SlidingStage| {
            let finite = stage.stiffness > 0.0 && stage.stiffness.is_finite();
            stage.friction > 0.0 && finite && stage.travel > 0.0
        };
        if !stages.iter().all(sound) {
            return Err(vec![SpringFault {
                quantity: Quantity::Rule,
                side: None,
                problem: "every stage needs a friction, a stiffness and a travel greater than zero"
                    .into(),
            }]);
        }
        // First loading goes on with the stage that slides first.
        let mut first = stages[0];
        for stage in &stages[1..] {
            if stage.friction < first.friction {
                first = *stage;
            }
        }
        let ratio = first.stiffness / (elastic + first.stiffness);
        let corners = Corners::bilinear(first.friction, ratio);
        let backbone = Backbone::from_forces(elastic, corners, corners)?;
        Ok(Self {
            rule: HysteresisRule::Pendulums(stages),
            backbone,
        })
    }

    /// Where the stages stand \[m\]; zeros for other springs.
    #[must_use]
    pub fn places(&self, memory: &HysteresisMemory) -> [f64; 3] {
        match self.rule {
            HysteresisRule::Pendulums(_) => memory.offsets,
            _ => [0.0; 3],
        }
    }

    /// How far each stage went, from rest, where no force was greater than this \[N\], beside its travel \[m\]; empty for other springs.
    #[must_use]
    pub fn travels(&self, greatest_force: f64) -> Vec<[f64; 2]> {
        let HysteresisRule::Pendulums(stages) = &self.rule else {
            return Vec::new();
        };
        let there = stages.iter().filter(|stage| **stage != SlidingStage::STILL);
        let went = there.map(|stage| [stage.place(0.0, greatest_force), stage.travel]);
        went.collect()
    }
}

/// Force and slope at a deformation, and the places of the stages there.
pub(super) struct Answer {
    pub(super) force: f64,
    pub(super) tangent: f64,
    pub(super) places: [f64; 3],
}

/// What a stage does on the way to a deformation.
#[derive(Clone, Copy, PartialEq)]
enum Motion {
    Still,
    Sliding,
    AtRim,
}

/// Energy of the elastic spring and of the bowls, up which stages have slid along one axis \[J\].
pub(super) fn stored_energy(
    backbone: &Backbone,
    stages: &[SlidingStage; 3],
    memory: &HysteresisMemory,
) -> f64 {
    let bowls = stages.iter().zip(memory.offsets);
    let bowls = bowls.map(|(stage, place)| stage.stiffness * place * place);
    0.5 * (memory.force * memory.force / backbone.initial() + bowls.sum::<f64>())
}

pub(super) fn answer(
    backbone: &Backbone,
    stages: &[SlidingStage; 3],
    memory: &HysteresisMemory,
    deformation: f64,
) -> Answer {
    // Seen from the side towards which it moves, all moves upwards.
    let sign = Side::from_change(deformation - memory.deformation).sign();
    let (to, from) = (sign * deformation, memory.offsets.map(|at| sign * at));
    let mut motions = [Motion::Still; 3];
    loop {
        let mut flexibility = 1.0 / backbone.initial();
        let (mut stretch, mut next) = (to, (f64::INFINITY, 0));
        for (index, (stage, motion)) in stages.iter().zip(motions).enumerate() {
            let [start, rim] = stage.slides_between(from[index]);
            let event = match motion {
                Motion::Still => {
                    stretch -= from[index];
                    start
                }
                Motion::Sliding => {
                    stretch += stage.friction / stage.stiffness;
                    flexibility += 1.0 / stage.stiffness;
                    rim
                }
                Motion::AtRim => {
                    stretch -= stage.travel;
                    f64::INFINITY
                }
            };
            if event < next.0 {
                next = (event, index);
            }
        }
        let force = stretch / flexibility;
        // What is not a number ends here too.
        if !matches!(
            force.partial_cmp(&next.0),
            Some(Ordering::Greater | Ordering::Equal)
        ) {
            let place = |index: usize| match motions[index] {
                Motion::Still => from[index],
                Motion::Sliding => (force - stages[index].friction) / stages[index].stiffness,
                Motion::AtRim => stages[index].travel,
            };
            return Answer {
                force: sign * force,
                tangent: 1.0 / flexibility,
                places: [0, 1, 2].map(|index| sign * place(index)),
            };
        }
        let motion = &mut motions[next.1];
        *motion = match motion {
            Motion::Still => Motion::Sliding,
            Motion::Sliding | Motion::AtRim => Motion::AtRim,
        };
    }
}

pub(super) fn respond(
    backbone: &Backbone,
    stages: &[SlidingStage; 3],
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    let side = Side::from_change(deformation - memory.deformation);
    let answer = answer(backbone, stages, memory, deformation);
    let stored = |force: f64| 0.5 * force * force / backbone.initial();
    let mut work = stored(answer.force) - stored(memory.force);
    // Against friction and up the bowls.
    for ((stage, from), to) in stages.iter().zip(memory.offsets).zip(answer.places) {
        let slid = to - from;
        if slid != 0.0 {
            work += (side.sign() * stage.friction + 0.5 * stage.stiffness * (to + from)) * slid;
        }
    }
    Response {
        force: answer.force,
        tangent: answer.tangent,
        work,
        memory: HysteresisMemory {
            offsets: answer.places,
            ..*memory
        },
    }
}

pub(super) fn next_corner(
    backbone: &Backbone,
    stages: &[SlidingStage; 3],
    memory: &HysteresisMemory,
    towards: Side,
) -> f64 {
    let sign = towards.sign();
    let from = memory.offsets.map(|at| sign * at);
    let here = sign * memory.deformation;
    let places = stages.iter().zip(from);
    let nearest = places
        .flat_map(|(stage, place)| stage.slides_between(place))
        .filter(|force| force.is_finite())
        .map(|force| {
            let slid = stages.iter().zip(from);
            force / backbone.initial() + slid.map(|(stage, at)| stage.place(at, force)).sum::<f64>()
        })
        // A stage that has just started or stopped is at its corner, within rounding.
        .filter(|corner| corner - here > 4.0 * f64::EPSILON * (here.abs() + corner.abs()))
        .fold(f64::INFINITY, f64::min);
    sign * nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    const STAGES: [SlidingStage; 3] = [
        SlidingStage {
            friction: 15e3,
            stiffness: 1e6 / 0.6,
            travel: 0.1857,
        },
        SlidingStage {
            friction: 40e3,
            stiffness: 1e6 / 1.8,
            travel: 0.2571,
        },
        SlidingStage {
            friction: 80e3,
            stiffness: 1e6 / 1.8,
            travel: 0.2571,
        },
    ];

    fn bearing() -> Hysteresis {
        Hysteresis::pendulums(15e6, STAGES).expect("sound")
    }

    /// Small steps with the place of every stage by bisection on the force: nothing of the walk along corners.
    struct Bisected {
        places: [f64; 3],
    }

    impl Bisected {
        fn places_under(&self, force: f64) -> [f64; 3] {
            let mut places = self.places;
            for (place, stage) in places.iter_mut().zip(&STAGES) {
                let (low, high) = (
                    (force - stage.friction) / stage.stiffness,
                    (force + stage.friction) / stage.stiffness,
                );
                *place = place.max(low).min(high).clamp(-stage.travel, stage.travel);
            }
            places
        }

        fn force(&mut self, deformation: f64) -> f64 {
            let (mut low, mut high) = (-1e8, 1e8);
            for _ in 0..200 {
                let force = 0.5 * (low + high);
                let there = force / 15e6 + self.places_under(force).iter().sum::<f64>();
                if there < deformation {
                    low = force;
                } else {
                    high = force;
                }
            }
            self.places = self.places_under(high);
            high
        }
    }

    /// Cycles that slide on every stage, reach the rims and turn anywhere.
    #[test]
    fn forces_and_work_are_those_of_bisection() {
        let bearing = bearing();
        let mut memory = HysteresisMemory::default();
        let mut other = Bisected { places: [0.0; 3] };
        let (mut worst, mut furthest): (f64, f64) = (0.0, 0.0);
        for i in 0..4_000 {
            let x = f64::from(i);
            let to = 2.2e-4 * x * (0.01 * x).sin() + 0.01 * (0.37 * x).sin();
            memory = bearing.respond(&memory, to).memory;
            worst = worst.max((memory.force() - other.force(to)).abs());
            furthest = furthest.max(memory.force().abs());
        }
        assert!(worst < 1e-6, "{worst} N");
        assert!(furthest > 1e6, "never at the rims: {furthest} N");
    }

    /// A path in one direction gives the same bits in any number of parts, and straight lines end at the corners that are foretold.
    #[test]
    fn parts_of_a_path_give_the_same_bits_and_lines_end_at_corners() {
        let bearing = bearing();
        let mut at_once = HysteresisMemory::default();
        let mut memory = at_once;
        for turn in [0.15, -0.6, 0.75, 0.1, 0.3, -0.72, 0.0] {
            let side = Side::from_change(turn - memory.deformation());
            at_once = bearing.respond(&at_once, turn).memory;
            let mut corners = 0;
            loop {
                let corner = bearing.next_corner(&memory, side);
                let end = if side.sign() * (corner - turn) < 0.0 {
                    corner
                } else {
                    turn
                };
                let middle = 0.5 * (memory.deformation() + end);
                let half = bearing.respond(&memory, middle);
                let whole = bearing.respond(&memory, end);
                let straight = 0.5 * (memory.force() + whole.force);
                assert!((half.force - straight).abs() < 1e-6, "no line to {end}");
                let trapezium = straight * (end - memory.deformation());
                assert!((whole.work - trapezium).abs() < 1e-7 * trapezium.abs().max(1.0));
                memory = bearing.respond(&half.memory, end).memory;
                if end == turn {
                    break;
                }
                corners += 1;
            }
            assert!((1..=6).contains(&corners), "{corners} corners to {turn}");
            assert_eq!(memory, at_once);
        }
    }
}
