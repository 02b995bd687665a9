//! What a script says about springs that yield, by the rules that its model has.

use std::collections::BTreeSet;

use jostle::LinkLaw;
use jostle::hysteresis::HysteresisRule;

use super::script::Script;

impl Script<'_> {
    pub(super) fn remark_on_springs(&mut self) {
        let system = self.export.system;
        // Bearings in plan, stops and what is elastic have nothing in common with jostle's rules, or no difference.
        let of_rule = |rule: HysteresisRule| match rule {
            HysteresisRule::Normal | HysteresisRule::Bilinear => Some(Kind::Parallel),
            HysteresisRule::PeakOriented => Some(Kind::PeakOriented),
            HysteresisRule::Pinched(_) => Some(Kind::Pinched),
            HysteresisRule::Failing(_) => Some(Kind::Failing),
            HysteresisRule::Concrete(_) => Some(Kind::Concrete),
            HysteresisRule::MenegottoPinto(_) => Some(Kind::MenegottoPinto),
            HysteresisRule::Elastic
            | HysteresisRule::Takeda { .. }
            | HysteresisRule::DegradingTrilinear
            | HysteresisRule::Sliding { .. }
            | HysteresisRule::Stop { .. }
            | HysteresisRule::Buckling(_)
            | HysteresisRule::Pendulums(_)
            | HysteresisRule::Ground
            | HysteresisRule::Surface { .. }
            | HysteresisRule::SpaceSurface { .. }
            | HysteresisRule::InPlan { .. } => None,
        };
        let mut damped = false;
        let mut found = BTreeSet::new();
        for building in &system.buildings {
            let springs = building.equations.springs.iter();
            let kinds = springs.filter_map(|spring| of_rule(spring.hysteresis.rule()));
            let kinds: Vec<Kind> = kinds.collect();
            damped |= building.equations.beta != 0.0
                && building
                    .equations
                    .springs
                    .iter()
                    .any(|spring| spring.damped_by_tangent);
            found.extend(kinds);
        }
        found.extend(system.model_links().iter().filter_map(|link| {
            let LinkLaw::Yielding(hysteresis) = &link.law else {
                return None;
            };
            of_rule(hysteresis.rule())
        }));
        for kind in &found {
            self.remark(kind.remark());
        }
        if damped {
            self.remark(
                "Springs damped by their tangents have OpenSees' damping by the stiffness at the end of the last step, as in jostle; \
                 where that falls, OpenSees' damping is negative, and jostle's zero.",
            );
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Concrete,
    MenegottoPinto,
    Failing,
    PeakOriented,
    Pinched,
    Parallel,
}

impl Kind {
    fn remark(self) -> &'static str {
        match self {
            Self::Concrete => {
                "Concrete of fibres is OpenSees' Concrete01, which has the same envelope and the same unloading; jostle's parabola is a \
                 polygon of 32 chords, up to 2e-4 of the strength away."
            }
            Self::MenegottoPinto => {
                "Bars of fibres with smooth loops are OpenSees' Steel02. Where a bar turns round before it has left its first straight line, \
                 Steel02 begins another curve, which can lie above; jostle continues the one before. jostle's curves are polygons, up \
                 to 1e-3 of the yield force away."
            }
            Self::Failing => {
                "Columns that fail in shear are OpenSees' LimitState with the falling branch in its backbone; it does not \
                 look for corners inside a step."
            }
            Self::PeakOriented => {
                "Springs of the rule peak-oriented are OpenSees' Hysteretic with pinching 1, 1; it does not look for \
                 corners inside a step."
            }
            Self::Pinched => {
                "Springs of the rule pinched are OpenSees' Hysteretic with its pinching, damage and exponent of unloading; \
                 it does not look for corners inside a step, and unloads and damages a little differently."
            }
            Self::Parallel => {
                "Springs of the rules normal and bilinear are elastic-plastic springs in parallel, which is the same."
            }
        }
    }
}
