//! `.LOG` and `.OUT` files of an analysis: periods, and mass, inertia and centre of every rigid diaphragm.

use jostle_io::InputError;

use crate::facts::{Facts, FloorMass, ModePeriod, fault};
use crate::text::number;
use crate::units::{INERTIA, LENGTH, MASS, Units};

/// Units of force and length that a `.LOG` states.
pub(crate) fn units(log: &str) -> Option<Units> {
    let line = log
        .lines()
        .find(|line| line.trim_start().starts_with("UNITS (FORCE"))?;
    Units::parse(line.split_once('=')?.1)
}

/// Adds the periods of a `.LOG`: those of its last modal analysis.
pub(crate) fn read_log(file: &str, text: &str, facts: &mut Facts) {
    let mut found: Vec<ModePeriod> = Vec::new();
    let mut case = String::new();
    for line in text.lines() {
        let line = line.trim();
        if let Some(name) = line.strip_prefix("CASE:") {
            case = name.trim().to_owned();
        }
        let Some(rest) = line.strip_prefix("Found mode") else {
            continue;
        };
        let mode = rest
            .split_whitespace()
            .next()
            .and_then(|text| text.parse().ok());
        let period = rest.split_once("T=").and_then(|(_, text)| number(text));
        let (Some(mode), Some(period)) = (mode, period.filter(|period| *period > 0.0)) else {
            continue;
        };
        if mode == 1 {
            found.clear();
        }
        found.push(ModePeriod {
            case: case.clone(),
            mode,
            period,
            shares: None,
        });
    }
    if found.is_empty() {
        return;
    }
    facts
        .read
        .push(format!("{file}: periods of {} modes", found.len()));
    facts.solver_periods = found
        .iter()
        .map(|period| (period.mode, period.period))
        .collect();
    if facts.periods.is_empty() {
        facts.periods = found;
        facts.periods_from = file.to_owned();
    }
}

/// Adds the masses of a `.OUT`.
///
/// # Errors
/// Units that are not known, and a file without rigid diaphragms.
pub(crate) fn read_out(
    file: &str,
    text: &str,
    units: Option<Units>,
    facts: &mut Facts,
) -> Result<(), InputError> {
    let mut lines = text.lines();
    let mut found = Vec::new();
    let mut name = String::new();
    let (mut mass, mut inertia) = (0.0, 0.0);
    let values = |line: &str| -> Vec<f64> { line.split_whitespace().filter_map(number).collect() };
    while let Some(line) = lines.next() {
        if let Some((before, _)) = line.split_once(", CONSTR = RIGID") {
            name = before.trim().to_owned();
        } else if line.contains("TRANSLATIONAL MASS AND MASS MOMENTS") {
            let numbers = lines.nth(1).map(values).unwrap_or_default();
            let [u1, _, _, _, _, r3] = numbers[..] else {
                continue;
            };
            (mass, inertia) = (u1, r3);
        } else if line.contains("CENTER OF MASS") {
            lines.next();
            let mut place = [f64::NAN; 3];
            for axis in &mut place {
                let numbers = lines.next().map(values).unwrap_or_default();
                *axis = numbers.first().copied().unwrap_or(f64::NAN);
            }
            if mass > 0.0 && place.iter().all(|axis| axis.is_finite()) {
                found.push((std::mem::take(&mut name), mass, inertia, place));
            }
            mass = 0.0;
        }
    }
    if found.is_empty() {
        return Err(fault(
            file,
            "",
            "lists no mass of a rigid diaphragm",
            "give the .OUT file of an analysis with rigid diaphragms, or the table Mass Summary by Diaphragm; semi-rigid floors have no mass of their own there",
        ));
    }
    let units = units.ok_or_else(|| fault(file, "", "does not say its units", "name the .LOG file of the same analysis or the text model beside it, or add --units \"kN, m\""))?;
    facts.read.push(format!(
        "{file}: masses of {} rigid diaphragms",
        found.len()
    ));
    let [m, j, l] = [MASS, INERTIA, LENGTH].map(|size| units.factor(size));
    facts
        .solver_masses
        .extend(
            found
                .into_iter()
                .map(|(name, mass, inertia, [x, y, z])| FloorMass {
                    story: Err(z * l),
                    diaphragm: name,
                    mass: [mass * m; 2],
                    inertia: Some(inertia * j),
                    centre: Some([x * l, y * l]),
                }),
        );
    Ok(())
}
