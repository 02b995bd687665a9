//! Members against stated limits of rotation, as numbers to report.

use super::summarise::Run;
use super::summary::{MemberLevel, ReachedLevel, RotationLevelsSummary};
use crate::history::{Kind, Owner};
use crate::linear::sort_by;
use crate::model::{RotationLevel, RotationMeasure};

/// Members of a building with limits; `None` without any.
pub(super) fn rotation_levels(building: usize, run: &Run) -> Option<RotationLevelsSummary> {
    let building = &run.system.buildings[building];
    if building.limited_ends.is_empty() {
        return None;
    }
    let mut list: Vec<MemberLevel> = Vec::new();
    for end in &building.limited_ends {
        let global = building.spring_offset + end.spring;
        let law = &building.equations.springs[end.spring].hysteresis;
        let peaks = run.outcome.peaks.owned_by(Owner::Spring(global));
        let rotation_rad = match end.on_surface {
            Some(_) => peaks.of(Kind::Turned).size(),
            None => end.rotation(law, &run.outcome.state.springs[global]),
        };
        let limits = end.limits.iter().map(|(level, limit)| {
            let passed = peaks.of(Kind::Beyond(*level)).greatest;
            ReachedLevel {
                level: *level,
                limit_rad: *limit,
                beyond_s: (passed.value > 0.0).then_some(passed.at),
            }
        });
        let limits: Vec<ReachedLevel> = limits.collect();
        let highest = limits.last().map_or(f64::INFINITY, |limit| limit.limit_rad);
        let found = MemberLevel {
            member: format!("{}.{}", building.name, end.member),
            at: end.at,
            measure: match end.measure {
                RotationMeasure::Plastic => "plastic",
                RotationMeasure::Chord => "chord",
            },
            rotation_rad,
            ratio: rotation_rad / highest,
            beyond: None,
            limits,
        };
        match list.iter_mut().find(|known| known.member == found.member) {
            Some(known) => known.join(found),
            None => list.push(found),
        }
    }
    for member in &mut list {
        let beyond = member
            .limits
            .iter()
            .filter(|level| level.beyond_s.is_some());
        member.beyond = beyond.map(|level| level.level).next_back();
    }
    sort_by(&mut list, |a, b| {
        let level = |rank: &MemberLevel| rank.beyond.map_or(0, |level| 1 + level as usize);
        level(b).cmp(&level(a)).then(b.ratio.total_cmp(&a.ratio))
    });
    let beyond = |level: RotationLevel| {
        let all = list.iter().filter_map(|member| member.beyond);
        all.filter(|beyond| *beyond >= level).count()
    };
    let [beyond_io, beyond_ls, beyond_cp] = RotationLevel::ALL.map(beyond);
    Some(RotationLevelsSummary {
        members: list.len(),
        beyond_io,
        beyond_ls,
        beyond_cp,
        list,
    })
}

impl MemberLevel {
    /// With another end of the same member: the rotation of that which came further, and the first instant of each level.
    fn join(&mut self, other: Self) {
        for (limit, other) in self.limits.iter_mut().zip(&other.limits) {
            let instants = [limit.beyond_s, other.beyond_s].into_iter().flatten();
            limit.beyond_s = instants.reduce(f64::min);
        }
        if other.ratio > self.ratio {
            let limits = std::mem::take(&mut self.limits);
            *self = Self { limits, ..other };
        }
    }
}
