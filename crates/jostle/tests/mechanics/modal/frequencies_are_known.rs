//! Frequencies from closed forms and from two independent eigenvalue programs.

use std::f64::consts::PI;

use jostle::eigen::{Mode, Spectrum, modes};

use crate::modal::support::{
    deviation, library_modes, numbers, stored_frame, stored_frames, tower,
};

/// ω_j = 2 √(k/m) sin[(2j − 1)π/(4n + 2)].
#[test]
fn towers_of_equal_storeys_vibrate_in_sines() {
    for storeys in [1, 2, 3, 4, 5, 10, 40, 80] {
        let building = tower(storeys, 2e5, 3e8);
        let formula: Vec<f64> = (1..=storeys)
            .map(|j| {
                let angle = (2 * j - 1) as f64 * PI / (4 * storeys + 2) as f64;
                2.0 * (3e8_f64 / 2e5).sqrt() * angle.sin()
            })
            .collect();
        let sliced = modes(&building, storeys).expect("the tower stands");
        assert_eq!(sliced.len(), storeys, "all modes of {storeys} storeys");
        assert!(
            deviation(&sliced, &formula) < 2e-14,
            "{storeys} storeys: off by {:e}",
            deviation(&sliced, &formula)
        );
        let dense = library_modes(&building).expect("the tower stands");
        assert!(
            deviation(&dense, &formula) < 1e-12,
            "{storeys} storeys, library"
        );
        // Floor i of mode j moves by sin(2iα).
        for (j, mode) in sliced.iter().enumerate() {
            let angle = (2 * j + 1) as f64 * PI / (2 * storeys + 1) as f64;
            let roof = (storeys as f64 * angle).sin();
            for (i, floor) in mode.floors.iter().enumerate() {
                let expected = ((i + 1) as f64 * angle).sin() / roof;
                let got = floor / mode.floors[storeys - 1];
                assert!(
                    (got - expected).abs() < 1e-9 / roof.abs(),
                    "{storeys} storeys, mode {}, floor {}: {got} instead of {expected}",
                    j + 1,
                    i + 1
                );
            }
        }
    }
}

#[test]
fn count_steps_by_one_at_every_mode() {
    for storeys in [1, 4, 10, 40] {
        let building = tower(storeys, 2e5, 3e8);
        let mut spectrum = Spectrum::new(&building).expect("the tower stands");
        for j in 1..=storeys {
            let angle = (2 * j - 1) as f64 * PI / (4 * storeys + 2) as f64;
            let frequency = 2.0 * (3e8_f64 / 2e5).sqrt() * angle.sin();
            assert_eq!(
                spectrum.below(frequency * (1.0 - 1e-12)),
                j - 1,
                "just below mode {j}"
            );
            assert_eq!(
                spectrum.below(frequency * (1.0 + 1e-12)),
                j,
                "just above mode {j}"
            );
        }
        assert_eq!(spectrum.below(0.0), 0, "no mode is below zero");
        assert_eq!(spectrum.below(1e9), storeys, "all modes are below infinity");
    }
}

/// Two independent programs agree on these to the digits printed.
#[test]
fn stored_frames_have_the_frequencies_of_other_programs() {
    let printed: [(&str, &[f64], f64); 7] = [
        ("A_portal", &[65.562_296_182_82], 1e-11),
        (
            "B_2bay5",
            &[13.543_710_97, 42.700_535_73, 76.664_922_24, 112.783_498_8],
            1e-9,
        ),
        (
            "C_2bay5_axial",
            &[13.265_460_23, 42.055_151_81, 76.252_912_85, 103.834_593_1],
            1e-9,
        ),
        (
            "D_3bay10",
            &[7.314_988_046, 22.584_769_64, 39.633_630_12, 59.265_258_19],
            1e-9,
        ),
        (
            "E_2bay5_noHinge_1seg",
            &[
                13.612_427_391_63,
                42.728_212_623_65,
                76.137_122_382_63,
                112.140_414_171_6,
            ],
            1e-11,
        ),
        (
            "F_2bay5_PDelta",
            &[13.428_578_38, 42.473_859_70, 76.344_082_02, 112.471_568_9],
            1e-9,
        ),
        (
            "G_2bay5_Timoshenko",
            &[12.939_815_16, 41.017_632_63, 74.294_269_22, 101.175_346_0],
            1e-9,
        ),
    ];
    let frames = stored_frames();
    for (name, printed, last_digit) in printed {
        let building = stored_frame(&frames[name], 1.0);
        let stored = numbers(&frames[name]["omega"]);
        let sliced = modes(&building, stored.len()).expect("the frame stands");
        assert_eq!(sliced.len(), stored.len(), "{name} has that many modes");
        assert!(
            deviation(&sliced, &stored) < 1e-11,
            "{name}: off by {:e}",
            deviation(&sliced, &stored)
        );
        assert!(
            deviation(&sliced, printed) < last_digit,
            "{name}, as printed"
        );
    }
}

#[test]
fn a_few_modes_are_the_first_of_many() {
    let frames = stored_frames();
    let building = stored_frame(&frames["C_2bay5_axial"], 1.0);
    let frequencies = |modes: Vec<Mode>| -> Vec<f64> {
        modes.iter().map(|mode| mode.circular_frequency).collect()
    };
    let all = frequencies(modes(&building, usize::MAX).expect("the frame stands"));
    assert_eq!(all.len(), jostle::eigen::number_of_modes(&building));
    assert!(all.is_sorted(), "longest period first");
    for count in [0, 1, 2, 7, 100, 179] {
        let few = modes(&building, count).expect("the frame stands");
        assert_eq!(few.len(), count, "as many as asked for");
        assert!(deviation(&few, &all) < 1e-12, "{count} modes");
    }
}
