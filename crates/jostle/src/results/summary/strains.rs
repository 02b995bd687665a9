//! Strains that are judged at the ends of columns made of fibres, all of a building together.

use serde::Serialize;

use super::sections::FibreSummary;
use crate::model::FibreLimit;
use crate::quantity::{Quantity, Unit};

/// Ends of columns made of fibres, by the strains that they passed.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct StrainsSummary {
    /// Ends with strains that are judged.
    pub ends: usize,
    /// Ends whose cover spalled.
    pub spalled: usize,
    /// Ends whose confined core was crushed.
    pub crushed: usize,
    /// Ends where bars passed the strain from which they buckle.
    pub buckled: usize,
    /// Ends where bars broke.
    pub fractured: usize,
    /// Greatest strain over its limit \[–\].
    pub ratio: f64,
    /// When the first limit was passed; `null` if none was \[s\].
    pub first_s: Option<f64>,
}

impl StrainsSummary {
    /// Of ends of columns; `None` where nothing is judged.
    pub(crate) fn of(sections: &[FibreSummary]) -> Option<Self> {
        let limits = || sections.iter().flat_map(|section| &section.limits);
        let passed = |what: FibreLimit| {
            let same = limits().filter(|limit| limit.limit == what);
            same.filter(|limit| limit.passed_s.is_some()).count()
        };
        let ratios = sections.iter().filter_map(FibreSummary::worst_ratio);
        Some(Self {
            ends: ratios.clone().count(),
            spalled: passed(FibreLimit::Spalling),
            crushed: passed(FibreLimit::Crushing),
            buckled: passed(FibreLimit::Buckling),
            fractured: passed(FibreLimit::Fracture),
            ratio: ratios.reduce(f64::max)?,
            first_s: limits().filter_map(|limit| limit.passed_s).reduce(f64::min),
        })
    }
}

#[rustfmt::skip]
impl StrainsSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("ends", "column ends that have strain limits", |s| s.ends),
        Quantity::<Self>::whole("spalled", "column ends whose cover spalled", |s| s.spalled).in_study(),
        Quantity::<Self>::whole("crushed", "column ends whose confined core exceeded its strain limit in compression", |s| s.crushed).in_study(),
        Quantity::<Self>::whole("buckled", "column ends where bars exceeded the strain beyond which they buckle", |s| s.buckled).in_study(),
        Quantity::<Self>::whole("fractured", "column ends where bars fractured", |s| s.fractured).in_study(),
        Quantity::<Self>::real("ratio", Unit::NONE, "greatest ratio of strain to its limit", |s| s.ratio).in_study(),
        Quantity::<Self>::optional("first_s", Unit::S, "time at which a limit was first exceeded; absent if none was", |s| s.first_s).in_study(),
    ];
}
