//! Matrices of a frame with rigid diaphragms, as OpenSees has them, through a model file.

use jostle::System;
use serde_json::Value;

use crate::data::{at, document, list, numbers};
use crate::files::model;
use crate::row::Row;

/// Eigenvalues of OpenSees and of numpy agree to 5·10⁻¹⁵; what is left is rounding of condensation and of the shift to the centre of
/// mass.
const EXACT: f64 = 1e-10;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let stored = document(include_str!("../data/space/S10_given_in_plan.json"));
    list(&stored, "/cases").iter().flat_map(compare).collect()
}

/// The building of a case in a model file.
fn text_of(case: &Value) -> String {
    let point = numbers(case, "/reference_point_m");
    let mut text = format!(
        "[[building]]\nkind = \"given\"\nplan = [\"4 m\", \"3 m\"]\nmatrices = {{ stiffness = {}, mass = {} }}\n[building.ports]\n",
        at(case, "/stiffness"),
        at(case, "/mass")
    );
    for (floor, dofs) in list(case, "/dofs").iter().enumerate() {
        text += &format!(
            "\"{}\" = {{ dofs = {dofs}, at = {point:?}, height = {} }}\n",
            floor + 1,
            3 * (floor + 1)
        );
    }
    text + "[motion]\nrecord = \"el-centro\"\n"
}

fn compare(case: &Value) -> Vec<Row> {
    let name = at(case, "/name").as_str().unwrap_or_default();
    let source = format!("space/S10_given_in_plan, {name}");
    let input = model(&text_of(case));
    let system = System::assemble(&input.model).expect("a sound model");
    let building = &system.buildings[0];
    let periods: Vec<f64> = building
        .modes
        .iter()
        .map(jostle::eigen::Mode::period)
        .collect();
    let expected = numbers(case, "/periods_s");
    let mut rows = vec![Row::worst_of(
        &source,
        "periods [s]",
        &expected,
        &periods,
        EXACT,
    )];
    let last = expected.len() - 1;
    rows.push(Row::relative(
        &source,
        "shortest period [s]",
        expected[last],
        periods[last],
        EXACT,
    ));
    rows.push(Row::worst_of(
        &source,
        "centre of mass of the roof [m]",
        &numbers(case, "/mass_centre_m"),
        &building.discretization.centres[1],
        EXACT,
    ));
    rows
}
