//! Frames of any size and stiffness.

use jostle::eigen::{Spectrum, modes};
use jostle::{Axial, Frame, Joint};
use proptest::prelude::*;

use crate::modal::support::{deviation, disorder, framed, library_modes, section};

fn frames() -> impl Strategy<Value = Frame> {
    let size = (1_usize..=8, 1_usize..=3, 1_usize..=4, 1_usize..=5);
    let kind = (any::<bool>(), any::<bool>(), prop::option::of(6.0..11.0));
    (size, kind).prop_flat_map(|((storeys, bays, column_segments, segments), kind)| {
        let list = |low: f64, high: f64, n: usize| prop::collection::vec(low..high, n);
        (
            list(2.5, 5.0, storeys),
            list(2.0, 9.0, bays),
            list(0.3, 0.9, storeys),
            list(0.2, 0.8, storeys),
            list(0.0, 9000.0, storeys),
            list(0.0, 2e4, storeys),
        )
            .prop_map(
                move |(storey_heights, spans, columns, beams, beam_mass, floor_mass)| Frame {
                    storey_heights,
                    columns: columns
                        .into_iter()
                        .map(|side| section(side, side))
                        .collect(),
                    beams: beams.into_iter().map(|depth| section(0.3, depth)).collect(),
                    beam_mass,
                    floor_mass,
                    column_segments,
                    beam_segments: vec![segments; spans.len()],
                    spans,
                    axial: Axial {
                        columns_flexible: kind.0,
                        beams_flexible: kind.1,
                    },
                    joint: Joint {
                        rotational_stiffness: kind.2.map(|exponent| 10_f64.powf(exponent)),
                        ..Joint::default()
                    },
                    ..Frame::default()
                },
            )
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    #[test]
    fn in_frequencies_count_and_lateral_modes(frame in frames()) {
        let building = framed(frame);
        let dense = library_modes(&building).expect("the frame stands");
        let found = modes(&building, usize::MAX).expect("the frame stands");
        let expected: Vec<f64> = dense.iter().map(|mode| mode.circular_frequency).collect();
        prop_assert_eq!(found.len(), expected.len());
        // The library's small eigenvalues carry the rounding of the greatest.
        for (found, expected) in found.iter().zip(&expected) {
            let tolerance = 1e-10 + 1e-14 * (expected / dense[0].circular_frequency).powi(2);
            let error = (found.circular_frequency / expected - 1.0).abs();
            prop_assert!(error < tolerance, "ω = {expected}: off by {error:e}");
        }
        prop_assert!(disorder(&building, &found) < 1e-8, "{:e}", disorder(&building, &found));
        let mut spectrum = Spectrum::new(&building).expect("the frame stands");
        for (j, pair) in found.windows(2).enumerate() {
            let (a, b) = (pair[0].circular_frequency, pair[1].circular_frequency);
            if b > a * (1.0 + 1e-6) {
                prop_assert_eq!(spectrum.below((a * b).sqrt()), j + 1);
            }
        }
        let lateral: Vec<f64> = dense
            .iter()
            .filter(|mode| mode.is_lateral())
            .map(|mode| mode.circular_frequency)
            .collect();
        let sure = |share: f64| (share - jostle::eigen::LATERAL_SHARE).abs() > 1e-9;
        if dense.iter().all(|mode| sure(mode.effective_mass_ratio_x)) {
            prop_assert_eq!(building.modes.len(), lateral.len());
            prop_assert!(deviation(&building.modes, &lateral) < 1e-9);
        }
    }
}
