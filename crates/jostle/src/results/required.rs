//! What rules and codes require of the gaps of a run.

use super::summary::{BuildingSummary, ContactSummary, FloorSummary, Summary};
use crate::model::{Building, Damping, LEVEL_TOLERANCE, Model};
use crate::separation::{
    CodeInputs, Neighbours, Place, Requirements, Side, ddc_coefficient, floors_are_level,
    peak_at_height, required_gaps,
};

/// Height \[m\] and number of storeys above the ground: the highest floor that lies no higher than the base of the neighbour or the
/// datum, whichever is higher, if the building begins below that; else its base.
fn above_ground(building: &Building, neighbour: Option<f64>) -> (f64, usize) {
    let base = building.base.elevation;
    let street = neighbour.unwrap_or(0.0).max(0.0);
    let heights = building.floor_heights();
    let is_below = |height: &&f64| base + **height <= street + LEVEL_TOLERANCE;
    let basement = match base < street {
        true => heights.iter().take_while(is_below).count(),
        false => 0,
    };
    // What lies all below the street stands on its base.
    let basement = if basement < heights.len() {
        basement
    } else {
        0
    };
    let ground = basement.checked_sub(1).map_or(0.0, |floor| heights[floor]);
    let top = heights.last().copied().unwrap_or(0.0);
    (top - ground, heights.len() - basement)
}

impl Summary {
    /// What every rule requires of a gap of the model.
    ///
    /// Displacements are those of the run without contact, if it was made, else those of the run itself. Neighbours can touch at
    /// every contact of the gap, between floors as well; displacements there are linear between floors. `gap` is an index of
    /// `model.gaps`, whose run this is the summary of.
    #[must_use]
    pub fn required_gaps(&self, model: &Model, gap: usize, inputs: &CodeInputs) -> Requirements {
        let (Some(of_gap), Some(gap_summary)) = (model.gaps.get(gap), self.gaps.get(gap)) else {
            return Requirements::default();
        };
        let places = gap_summary.contacts.iter().filter_map(|contact| {
            let normal = normal_of(contact);
            let peaks = of_gap
                .between
                .map(|side| self.peak(model, side, contact.height_m, normal));
            // A face that stands back by more than both sides move needs no gap.
            let is_beyond = contact.width_m - gap_summary.width_m > peaks.iter().sum();
            (!is_beyond || gap_summary.contacts.len() == 1).then_some(Place {
                height: contact.height_m,
                peaks,
            })
        });
        let beside = model.buildings_beside(of_gap.between);
        let sides = [0, 1].map(|side| {
            let building = beside[side]?;
            let model_building = &model.buildings[building];
            let neighbour = beside[1 - side].map(|other| model.buildings[other].base.elevation);
            let (height, storeys) = above_ground(model_building, neighbour);
            Some(Side {
                building,
                name: model_building.name.clone(),
                height,
                storeys,
                yields: model_building.may_yield(),
            })
        });
        let neighbours = Neighbours {
            sides,
            places: places.collect(),
            floors_are_level: floors_are_level(model, of_gap),
            correlation: self.correlation(model, gap),
            peak_ground_acceleration: self.motion.pga_m_s2,
        };
        required_gaps(&neighbours, inputs)
    }

    /// Period and damping ratio of the fundamental mode of both neighbours of a gap in the direction in which they meet; `None` of a
    /// wall, and of a building without modes or damping \[s, –\].
    #[must_use]
    pub fn first_modes(&self, model: &Model, gap: usize) -> [Option<(f64, f64)>; 2] {
        let between = model.gaps.get(gap).map_or([None; 2], |gap| gap.between);
        let contacts = self.gaps.get(gap).map(|gap| &gap.contacts[..]);
        let highest = contacts.unwrap_or_default().iter();
        let highest = highest.max_by(|a, b| a.height_m.total_cmp(&b.height_m));
        let normal = highest.map_or([1.0, 0.0], normal_of);
        model.buildings_beside(between).map(|building| {
            first_mode(
                self.buildings.get(building?)?,
                &model.buildings.get(building?)?.damping,
                normal,
            )
        })
    }

    /// Correlation of the double difference; `None` beside a wall, and without periods or damping \[–\].
    #[must_use]
    pub fn correlation(&self, model: &Model, gap: usize) -> Option<f64> {
        let [left, right] = self.first_modes(model, gap);
        let ((t1, d1), (t2, d2)) = (left?, right?);
        Some(ddc_coefficient([t1, t2], [d1, d2]))
    }

    /// Greatest displacement of a side of a gap along a normal at a height above the datum, either sign; 0 of a wall that does not
    /// move \[m\].
    fn peak(&self, model: &Model, side: Option<usize>, height: f64, normal: [f64; 2]) -> f64 {
        let Some(side) = side else { return 0.0 };
        let Some(building) = self.buildings.get(side) else {
            let wall = self.walls.get(side - model.buildings.len());
            return wall.map_or(0.0, |wall| wall.displacement_peak_m);
        };
        let floors = building.floors.mat.iter().chain(&building.floors.above);
        let peak = |floor: &FloorSummary| (floor.height_m, floor.displacement_peak_m(normal));
        let foot = model.buildings[side].base.elevation;
        peak_at_height(floors.map(peak), height - foot)
    }
}

/// The direction in which two buildings meet.
fn normal_of(contact: &ContactSummary) -> [f64; 2] {
    contact.in_plan.map_or([1.0, 0.0], |plan| plan.normal)
}

/// Period and damping ratio of the fundamental mode along a normal, that of the soil included \[s, –\].
fn first_mode(
    building: &BuildingSummary,
    damping: &Damping,
    [x, across]: [f64; 2],
) -> Option<(f64, f64)> {
    let [along, sideways] = building.fundamental_periods_s;
    let nearer = if across.abs() > x.abs() {
        sideways
    } else {
        along
    };
    let known = [nearer, building.periods_s.first().copied().unwrap_or(0.0)];
    let period = known.into_iter().find(|period| *period > 0.0)?;
    let omega = std::f64::consts::TAU / period;
    let damping = match (&building.foundation, damping) {
        (Some(foundation), _) => foundation.damping_ratio,
        (None, Damping::AllModes { ratio }) => *ratio,
        (None, Damping::Ratio { .. } | Damping::Rayleigh { .. }) => {
            0.5 * (building.rayleigh_alpha_per_s / omega + building.rayleigh_beta_s * omega)
        }
    };
    (damping > 0.0 && damping.is_finite()).then_some((period, damping))
}
