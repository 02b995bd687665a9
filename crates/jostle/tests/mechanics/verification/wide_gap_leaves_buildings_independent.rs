use jostle::{Column, LawKind};

use crate::verification::support::{
    assembled, column, frame, framed, law, row, run, shaking, steps, tower,
};

#[test]
fn wide_gap_leaves_buildings_independent_bit_for_bit() {
    let buildings = vec![
        framed("left", frame(4, &[4.0, 6.0])),
        tower("middle", 6, 4e4, 0.9),
        framed("right", frame(2, &[5.0])),
    ];
    let contact = law(LawKind::HertzDamp, 0.65);
    let together = assembled(&row(buildings.clone(), 10.0, contact));
    assert_eq!(
        together.contacts.len(),
        6,
        "contacts are there, only never reached"
    );
    let motion = shaking(3.0);
    let plan = steps(2e-3, 4);
    let outcome = run(&together, &motion, &plan);
    assert!(outcome.impacts.is_empty(), "the gap is wide");
    for (index, building) in buildings.into_iter().enumerate() {
        let floors = building.floors();
        let alone = run(
            &assembled(&row(vec![building], 0.0, contact)),
            &motion,
            &plan,
        );
        for floor in 1..=floors {
            for quantity in [
                |building, floor| Column::displacement(building, floor),
                |building, floor| Column::velocity(building, floor),
                |building, floor| Column::total_acceleration(building, floor),
            ] {
                let bits = |values: Vec<f64>| -> Vec<u64> {
                    values.into_iter().map(f64::to_bits).collect()
                };
                let (here, there) = (
                    column(&outcome, quantity(index, floor)),
                    column(&alone, quantity(0, floor)),
                );
                assert_eq!(bits(here), bits(there), "building {index}, floor {floor}");
            }
        }
        let floors = outcome.peaks.floors(index);
        for (floor, other) in floors.iter().zip(&alone.peaks.floors(0)) {
            for (column, peak) in alone.peaks.iter() {
                if column.owner == other.column(column.kind).owner {
                    let got = floor.to(column.direction).of(column.kind);
                    assert_eq!(got, peak, "building {index}: {column:?}");
                }
            }
        }
        assert_eq!(
            outcome.peaks.base_shear(index).to_bits(),
            alone.peaks.base_shear(0).to_bits()
        );
    }
}
