//! Four eliminations that share nothing but the elements.

use jostle::RiccatiSweep;
use jostle::stiffness::DirectStiffness;
use jostle::transfer::{ElementwiseRiccati, ProductEquations};

use crate::support::{COLUMN, VARIANTS, difference, frame, solution, step_factors, step_load};

#[test]
fn four_solvers_agree_on_sixty_three_frames() {
    let mut cases = 0;
    let mut worst = [0.0_f64; 3];
    for variant in VARIANTS {
        for spans in [&[4.0, 6.0][..], &[6.0], &[6.0, 3.0, 6.0]] {
            for newmark in [[0.25, 0.5], [1.0 / 6.0, 0.5], [0.3025, 0.6]] {
                let building = frame(variant, spans, 5, COLUMN);
                let factors = step_factors(newmark, 0.02, [0.35, 0.0025]);
                let load = step_load(&building, factors.1);
                let direct = solution::<DirectStiffness>(&building, factors, &load);
                let others = [
                    solution::<RiccatiSweep>(&building, factors, &load),
                    solution::<ElementwiseRiccati>(&building, factors, &load),
                    solution::<ProductEquations>(&building, factors, &load),
                ];
                for (index, other) in others.iter().enumerate() {
                    let apart = difference(other, &direct);
                    worst[index] = worst[index].max(apart);
                    assert!(
                        apart <= 1e-10,
                        "{variant:?}, bays {spans:?}, {newmark:?}, solver {index}: {apart:e}"
                    );
                }
                cases += 1;
            }
        }
    }
    assert_eq!(
        cases, 63,
        "seven variants, three sets of bays, three integrators"
    );
    // Different eliminations do not round alike.
    assert!(worst.iter().all(|worst| *worst > 0.0), "{worst:?}");
}
