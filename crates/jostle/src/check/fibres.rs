//! Faults of ends of columns that are made of fibres.

use super::Faults;
use crate::model::{Building, ColumnFibres, FibreMaterial};

/// Whether the weight of a building presses its fibres.
pub(super) fn check_weight(faults: &mut Faults, path: &str, building: &Building) {
    faults.require(
        building.gravity.preload,
        path,
        || "needs the weight of the building, because what fibres bear follows the axial force: add gravity = true".into(),
    );
}

/// The fibres of one column.
pub(super) fn check_fibres(faults: &mut Faults, path: &str, fibres: &ColumnFibres, in_space: bool) {
    faults.positive(fibres.length, format!("{path}.length"), "m");
    for (limit, strain) in &fibres.limits {
        let limit_path = format!("{path}.limits.{}", limit.name());
        faults.positive(*strain, &limit_path, "");
        let judged = limit.material();
        let stands = fibres.fibres.iter().any(|fibre| fibre.material == judged);
        faults.require(stands, &limit_path, || match judged {
            FibreMaterial::Core => {
                "needs a core within ties: add ties = \"d8 @ 100 mm\" to column, or leave it out"
                    .into()
            }
            FibreMaterial::Cover => "needs concrete that no ties confine".into(),
            FibreMaterial::Bar => "needs bars".into(),
            FibreMaterial::Section => "needs fibres: a surface has no strains of materials".into(),
        });
    }
    let finite = fibres.fibres.iter().flat_map(|fibre| fibre.at);
    let finite = finite.into_iter().all(f64::is_finite);
    faults.require(finite, path, || "must stand at finite distances".into());
    faults.require(fibres.fibres.len() >= 2, path, || {
        "need at least two: one cannot bend".into()
    });
    faults.require(
        !in_space || !finite || !stand_on_a_line(fibres),
        path,
        || "stand on one line, about which they cannot bend: a column in space needs three at least".into(),
    );
}

/// Whether all fibres stand on one line.
fn stand_on_a_line(fibres: &ColumnFibres) -> bool {
    let points = fibres.fibres.iter().map(|fibre| fibre.at);
    let Some(first) = points.clone().next() else {
        return true;
    };
    let mut arms = points.map(|[x, y]| [x - first[0], y - first[1]]);
    let Some([x, y]) = arms.find(|arm| *arm != [0.0; 2]) else {
        return true;
    };
    arms.all(|arm| (x * arm[1] - y * arm[0]).abs() <= 1e-9 * (x * x + y * y))
}
