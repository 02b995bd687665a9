//! Forces of columns and beams: greatest and least values, and histories.

use super::Settings;
use super::member_ratios::MemberRatios;
use crate::history::MemberHistory;
use crate::state::State;
use crate::system::{GroundsAt, System};

/// Follows the forces of columns and beams of all buildings that were asked for.
pub(crate) struct MemberPeaks {
    /// Greatest and least value of every form of every building.
    pub(crate) extremes: Vec<Vec<[f64; 2]>>,
    pub(crate) history: Option<MemberHistory>,
    /// Demand over capacity of those that are rated.
    pub(crate) ratios: MemberRatios,
    /// Values now.
    values: Vec<Vec<f64>>,
    asked: bool,
}

impl MemberPeaks {
    /// With histories if the settings of the run say so.
    pub(crate) fn new(system: &System, settings: Settings) -> Self {
        let sizes = || system.buildings.iter().map(|b| b.members.forms.len());
        Self {
            extremes: sizes()
                .map(|n| vec![[f64::NEG_INFINITY, f64::INFINITY]; n])
                .collect(),
            history: settings
                .record_interval
                .and_then(|_| MemberHistory::new(system, settings.storage)),
            ratios: MemberRatios::new(system),
            values: sizes().map(|n| vec![0.0; n]).collect(),
            asked: sizes().any(|n| n > 0),
        }
    }

    /// Adds a state; `links`: forces of links \[N\].
    pub(crate) fn take(
        &mut self,
        system: &System,
        state: &State,
        links: &[f64],
        grounds: GroundsAt<'_>,
    ) {
        for (index, building) in system.buildings.iter().enumerate() {
            let (values, extremes) = (&mut self.values[index], &mut self.extremes[index]);
            let ground = grounds.of(index)[0];
            building.member_forces(state, links, ground, |form, value| {
                let [greatest, least] = &mut extremes[form];
                *greatest = greatest.max(value);
                *least = least.min(value);
                values[form] = value;
            });
        }
        self.ratios.take(system, state, &self.values);
    }

    /// Whether any force is followed.
    pub(crate) fn is_asked(&self) -> bool {
        self.asked
    }

    /// Adds a row to the histories.
    pub(crate) fn record(&mut self, system: &System, time: f64) {
        if let Some(history) = &mut self.history {
            history.push(system, time, &self.values);
        }
    }

    pub(crate) fn reserve(&mut self, rows: usize) {
        if let Some(history) = &mut self.history {
            history.reserve(rows);
        }
    }
}
