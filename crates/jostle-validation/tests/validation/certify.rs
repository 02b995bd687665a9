//! Random models hold the tolerance: the reduced form of `jostle-validation --certify`.

use jostle::Solver;
use jostle_validation::certify;

/// Models drawn; the whole proof takes a thousand, and `./check-all` draws fifty others every time. Of fewer models, two numbers of
/// 0.1 % that miss would be more than the share allowed below.
const MODELS: u64 = 8;

#[test]
fn random_models_hold_the_tolerance() {
    // Riccati's recursion at 1e-4 would take most of the time.
    let mut runs = certify::every_run(None, &certify::TOLERANCES);
    runs.retain(|run| *run != (Solver::Riccati, 1e-4));
    let all = certify::study(None, MODELS, 1, None, &runs);
    let mut shares = Vec::new();
    for (solver, least) in [("modal", 0.997), ("riccati", 0.997)] {
        let runs = all.iter().flat_map(|model| &model.runs);
        let runs = runs.filter(|run| run.solver == solver);
        let errors = runs.flat_map(|run| {
            run.errors
                .iter()
                .flatten()
                .map(|error| error / run.tolerance)
        });
        let errors: Vec<f64> = errors.collect();
        assert!(
            errors.len() > 400,
            "{solver}: only {} numbers",
            errors.len()
        );
        let within = errors.iter().filter(|error| **error <= 1.0).count() as f64;
        shares.push((solver, within / errors.len() as f64, least));
    }
    assert!(
        shares.iter().all(|(_, share, least)| share >= least),
        "{shares:?}"
    );
}

/// Models drawn of every family with a reference of its own.
const MODELS_OF_FAMILY: u64 = 5;

#[test]
fn random_models_of_every_family_hold_the_tolerance() {
    for family in certify::FAMILIES {
        let runs = certify::every_run(Some(family), &[1e-2, 1e-3]);
        let all = certify::study(Some(family), MODELS_OF_FAMILY, 1, None, &runs);
        let mut compared = 0;
        for model in &all {
            assert_eq!(model.failed, None, "{} {}", family.name, model.number);
            assert!(!model.runs.is_empty(), "{} {}", family.name, model.number);
            for run in &model.runs {
                assert_eq!(run.failed, None, "{} {}", family.name, model.number);
                for (quantity, error) in run.truth.quantities.iter().zip(&run.errors) {
                    let Some(error) = error else { continue };
                    assert!(
                        *error <= run.tolerance,
                        "{} {}, {} at {:.0e}: {quantity:?} is off by {error:e}",
                        family.name,
                        model.number,
                        run.solver,
                        run.tolerance
                    );
                    compared += 1;
                }
            }
        }
        assert!(compared > 150, "{}: only {compared} numbers", family.name);
    }
}
