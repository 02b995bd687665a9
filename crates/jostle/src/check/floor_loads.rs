//! Faults of the loads of floors.

use super::{Faults, each};
use crate::model::STANDARD_GRAVITY;

/// Loads of floors, none or one per storey, against the `masses` whose weight they may relieve columns of.
pub(super) fn check_floor_loads(
    faults: &mut Faults,
    path: &str,
    loads: &[f64],
    storeys: usize,
    masses: impl Fn(usize) -> f64,
) {
    let path = format!("{path}.floor_load");
    let count = loads.len();
    faults.require(count == 0 || count == storeys, &path, || {
        format!("has {count} entries for {storeys} storeys; give one value, or one per storey from the ground up")
    });
    for (floor, (field, load)) in each(loads, &path).enumerate() {
        let weight = STANDARD_GRAVITY * masses(floor);
        faults.require(load.is_finite() && *load >= -weight, field, || {
            format!("takes away more than the weight of the floor: {load} N of {weight:.0} N")
        });
    }
}
