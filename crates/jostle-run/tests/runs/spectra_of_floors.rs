//! Spectra of floors against solutions that know nothing of the recursion, of recorded accelerations or of impulses.

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::path::Path;

use jostle::{Column, History, RunEnd};
use jostle_io::{Format, read_model_text};
use jostle_run::{Opened, Ran};

fn run(text: &str) -> Ran {
    run_in(text, Path::new(""))
}

fn run_in(text: &str, folder: &Path) -> Ran {
    let input = read_model_text("test", text, Format::Toml, folder).expect("a model");
    let prepared = Opened::new(input, "test").expect("assembles").prepare();
    let prepared = prepared.expect("plans");
    let settings = prepared.settings(true);
    let mut observer = |_, _| ControlFlow::Continue(());
    let mut ran = prepared.run(settings, &mut observer);
    assert_eq!(ran.outcome.end, RunEnd::Completed);
    ran.run_without_contact(settings, &mut observer);
    ran
}

/// An undamped building of one floor under a sine from rest, and undamped oscillators on it, have a closed form: the floor
/// moves with two sines, and so every oscillator with three.
#[test]
fn an_oscillator_on_an_oscillator_has_its_closed_form() {
    let (mass, stiffness, amplitude, driven, duration): (f64, f64, f64, f64, f64) =
        (5e4, 8e6, 2.0, 0.8, 12.0);
    let text = format!(
        r#"
        motion = {{ kind = "sine", amplitude = {amplitude}, period = {driven}, duration = {duration} }}
        building = [{{ name = "A", kind = "shear", mass = {mass}, stiffness = {stiffness}, storey_height = 3.0,
                       damping = {{ alpha = 0.0, beta = 0.0 }} }}]
        analysis = {{ tolerance = 1e-5 }}
        output = {{ floor_spectra = {{ damping = 0.0, periods = [0.05, 0.11, 0.3, 0.7, 1.7, 4.0] }} }}
        "#
    );
    let ran = run(&text);
    let found = ran.summary().floor_spectra.expect("asked for");
    assert_eq!(found.floors.len(), 1);
    assert!(found.resolution < 1e-3, "{}", found.resolution);
    let (w, o) = ((stiffness / mass).sqrt(), TAU / driven);
    // ü + ω²u = −A sin Ωt: total acceleration −ω²u = A ω²/(ω² − Ω²) (sin Ωt − Ω/ω sin ωt).
    let gain = amplitude * w * w / (w * w - o * o);
    let floor = [(gain, o), (-gain * o / w, w)];
    for (period, got) in found
        .periods_s
        .iter()
        .zip(&found.floors[0].response.spectra[0].pseudo_acceleration_m_s2)
    {
        let p = TAU / period;
        let response = |t: f64| -> f64 {
            let parts = floor
                .iter()
                .map(|(b, nu)| b / (p * p - nu * nu) * ((nu * t).sin() - nu / p * (p * t).sin()));
            p * p * parts.sum::<f64>()
        };
        let exact = (0..=120_000)
            .map(|i| response(duration * f64::from(i) / 120_000.0).abs())
            .fold(0.0, f64::max);
        assert!(
            (got / exact - 1.0).abs() < 1e-3,
            "T = {period} s: {got} {exact}"
        );
    }
}

/// An oscillator on a support whose displacement is known, by Runge and Kutta: z̈ = −ω²(z − x) − 2ζω(ż − ẋ). It sees
/// no acceleration at all, so impacts enter by displacements and velocities alone.
fn by_displacements(support: &[[f64; 3]], omega: f64, zeta: f64) -> f64 {
    let mut state = [support[0][1], support[0][2]];
    let mut peak = 0.0_f64;
    for pair in support.windows(2) {
        let [t0, x0, v0] = pair[0];
        let [t1, x1, v1] = pair[1];
        let h = t1 - t0;
        if h <= 0.0 {
            continue;
        }
        // The cubic through displacements and velocities.
        let at = |s: f64| {
            let rise = x1 - x0;
            let (c2, c3) = (3.0 * rise - (2.0 * v0 + v1) * h, (v0 + v1) * h - 2.0 * rise);
            let x = x0 + s * (v0 * h + s * (c2 + s * c3));
            let v = v0 + (2.0 * s * c2 + 3.0 * s * s * c3) / h;
            [x, v]
        };
        let parts = (h * omega / 0.05).ceil().max(1.0) as usize;
        let step = 1.0 / parts as f64;
        let rate = |s: f64, [z, w]: [f64; 2]| {
            let [x, v] = at(s);
            [w, -omega * omega * (z - x) - 2.0 * zeta * omega * (w - v)]
        };
        for part in 0..parts {
            let s = part as f64 * step;
            let tau = h * step;
            let add =
                |k: [f64; 2], by: f64| [state[0] + by * tau * k[0], state[1] + by * tau * k[1]];
            let k1 = rate(s, state);
            let k2 = rate(s + 0.5 * step, add(k1, 0.5));
            let k3 = rate(s + 0.5 * step, add(k2, 0.5));
            let k4 = rate(s + step, add(k3, 1.0));
            for i in 0..2 {
                state[i] += tau * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0;
            }
            peak = peak.max(omega * omega * (state[0] - at(s + step)[0]).abs());
        }
    }
    peak
}

/// Instants, displacements and velocities of a floor under a sine, ground included.
fn support(history: &History, building: usize, amplitude: f64, omega: f64) -> Vec<[f64; 3]> {
    let column = |column| history.column(column).expect("recorded");
    let time = column(Column::TIME);
    let u = column(Column::displacement(building, 1));
    let v = column(Column::velocity(building, 1));
    let ground = |t: f64| {
        let speed = amplitude / omega * (1.0 - (omega * t).cos());
        [amplitude / omega * (t - (omega * t).sin() / omega), speed]
    };
    time.iter()
        .zip(u.iter().zip(&v))
        .map(|(t, (u, v))| [*t, u + ground(*t)[0], v + ground(*t)[1]])
        .collect()
}

fn pounding_pair(law: &str, solver: &str) -> String {
    format!(
        r#"
        motion = {{ kind = "sine", amplitude = 3.0, period = 0.9, duration = 9.0 }}
        building = [
            {{ name = "A", kind = "shear", mass = 5e4, stiffness = 6e6, storey_height = 3.0, damping = {{ ratio = 0.05, modes = [1] }} }},
            {{ name = "B", kind = "shear", mass = 9e4, stiffness = 3e6, storey_height = 3.0, damping = {{ ratio = 0.05, modes = [1] }} }},
        ]
        gap = [{{ between = ["A", "B"], width = 0.02, {law} }}]
        analysis = {{ solver = "{solver}" }}
        output = {{ floor_spectra = {{ damping = [0.02, 0.05], periods = [0.03, 0.05, 0.08, 0.15, 0.4, 1.0, 2.5] }} }}
        "#
    )
}

/// With every kind of law: forces that rise from zero, that jump, and velocities that jump.
#[test]
fn spectra_beside_impacts_agree_with_an_oscillator_driven_by_displacements() {
    let laws = [
        r#"law = "hertz-damp", stiffness = 2e9, restitution = 0.65"#,
        r#"law = "kelvin", stiffness = 5e8, restitution = 0.65"#,
        r#"law = "jankowski", stiffness = 2e9, restitution = 0.65"#,
        r#"law = "restitution", stiffness = 5e8, restitution = 0.65"#,
    ];
    for law in laws {
        for solver in ["modal", "riccati"] {
            if solver == "modal" && law.contains("\"restitution\"") {
                continue;
            }
            let ran = run(&pounding_pair(law, solver));
            let summary = ran.summary();
            assert!(summary.gaps[0].impact_count > 5, "{law}");
            let found = summary.floor_spectra.expect("asked for");
            let jumps = law.contains("\"restitution\"");
            assert!(
                found.resolution < if jumps { 0.01 } else { 5e-3 },
                "{law} {solver}: {}",
                found.resolution
            );
            let history = ran.outcome.history.as_ref().expect("recorded");
            for (building, floor) in found.floors.iter().enumerate() {
                let support = support(history, building, 3.0, TAU / 0.9);
                for curve in &floor.response.spectra {
                    for (period, got) in found.periods_s.iter().zip(&curve.pseudo_acceleration_m_s2)
                    {
                        let exact = by_displacements(&support, TAU / period, curve.damping);
                        assert!(
                            (got / exact - 1.0).abs() < 5e-3,
                            "{law} {solver}: {} at T = {period} s, {}: {got} {exact}",
                            floor.building,
                            curve.damping
                        );
                    }
                }
                // Impacts are felt, and the run without contact has its own spectrum.
                let without = floor.without_contact.as_ref().expect("made");
                let felt =
                    floor.response.peak_acceleration_m_s2 > 2.0 * without.peak_acceleration_m_s2;
                assert!(felt || jumps, "{law} {solver}");
                // Where velocities jump, the acceleration itself has no bound, and only the filtered peak feels it.
                let lower = floor.response.filtered_peak_acceleration_m_s2
                    < floor.response.peak_acceleration_m_s2;
                assert!(lower || jumps, "{law} {solver}");
            }
        }
    }
}

/// Nothing is computed, and nothing is recorded more densely, unless spectra are asked for.
#[test]
fn runs_without_the_request_stay_as_they_are() {
    let asked = pounding_pair(r#"law = "hertz-damp""#, "modal");
    let plain = asked.lines().filter(|line| !line.contains("output ="));
    let plain = run(&plain.collect::<Vec<_>>().join("\n"));
    assert!(plain.floor_spectra.is_none() && plain.summary().floor_spectra.is_none());
    let rows = |ran: &Ran| ran.outcome.history.as_ref().map_or(0, History::len);
    assert!(rows(&run(&asked)) > rows(&plain));
}

/// The filter has the gain 1/(1 + (tan πfh/tan πf_c h)^2n) of two passes of a Butterworth filter.
#[test]
fn filtered_peaks_have_the_gain_of_the_filter() {
    let folder = tempfile::tempdir().expect("a folder");
    for (frequency, order) in [(20.0, 4), (25.0, 4), (33.0, 4), (25.0, 2), (10.0, 8)] {
        // A sine that rises and falls slowly, so that its filtered peak is that of a steady one.
        let value = |i: u32| {
            let t = 5e-4 * f64::from(i);
            2.0 * (TAU * frequency * t).sin() * (0.5 * TAU * t / 4.0).sin().powi(2)
        };
        let lines: Vec<String> = (0..=8000).map(|i| value(i).to_string()).collect();
        std::fs::write(folder.path().join("sine.csv"), lines.join("\n")).expect("written");
        // A building so stiff that its floor moves with the ground.
        let text = format!(
            r#"
            motion = {{ record = "sine.csv", unit = "m/s2", step = 5e-4 }}
            building = [{{ name = "A", kind = "shear", mass = 1e4, stiffness = 4e10, storey_height = 3.0,
                           damping = {{ ratio = 0.05, modes = [1] }} }}]
            analysis = {{ accept_unusual = true }}
            output = {{ floor_spectra = {{ periods = [0.02, 0.1], low_pass = "25 Hz", order = {order} }} }}
            "#
        );
        let summary = run_in(&text, folder.path()).summary();
        let building = &summary.buildings[0];
        let of_floor = building.floors[0].response.filtered_acceleration_peak_m_s2;
        let of_building = building.response.filtered_acceleration_peak_m_s2;
        let found = summary.floor_spectra;
        let got = found.expect("asked for").floors[0]
            .response
            .filtered_peak_acceleration_m_s2;
        let h = 1.0 / (50.0 * 25.0);
        let tangent = |f: f64| (0.5 * TAU * f * h).tan();
        let gain = 1.0 / (1.0 + (tangent(frequency) / tangent(25.0)).powi(2 * order));
        let mean = (0.5 * TAU * frequency * h).sin() / (0.5 * TAU * frequency * h);
        // Some fifty values in a period: the greatest of them is within 0.3 % of the peak.
        let known = 2.0 * gain * mean;
        assert!(
            (got / known - 1.0).abs() < 5e-3,
            "{frequency} {order}: {got} {known}"
        );
        // Every run reports it, by the filter that the file asks for.
        assert_eq!(of_floor, Some(got));
        assert_eq!(of_building, Some(got));
    }
}

/// Accelerations of a run without spectra: below 25 Hz, with contact and without, null where no histories are kept.
#[test]
fn every_run_with_histories_reports_filtered_accelerations() {
    let text = r#"
        motion = { kind = "ricker", amplitude = 4.0, period = 0.5 }
        building = [
            { name = "A", kind = "shear", mass = [4e4, 4e4], stiffness = 6e7, storey_height = 3.0 },
            { name = "B", kind = "shear", mass = [8e4, 8e4], stiffness = 4e7, storey_height = 3.0 },
        ]
        gap = [{ between = ["A", "B"], width = 0.002, stiffness = 2e10 }]
        "#;
    let summary = run(text).summary();
    assert!(summary.gaps[0].impact_count > 0);
    let floors = || {
        summary
            .buildings
            .iter()
            .flat_map(|building| building.floors.iter())
    };
    let mut less = 0;
    for floor in floors() {
        let filtered = floor
            .response
            .filtered_acceleration_peak_m_s2
            .expect("histories");
        let raw = floor.response.total_acceleration_peak_m_s2;
        assert!(filtered > 0.0 && filtered < 1.02 * raw, "{filtered} {raw}");
        less += usize::from(filtered < 0.8 * raw);
        // Without impacts nothing is above 25 Hz: the filter leaves the peak.
        let alone = floor.without_contact.expect("that run was made");
        let (filtered, raw) = (
            alone.filtered_acceleration_peak_m_s2.expect("histories"),
            alone.total_acceleration_peak_m_s2,
        );
        assert!((filtered / raw - 1.0).abs() < 0.03, "{filtered} {raw}");
    }
    assert!(less > 0, "impacts are cut");
    let input = read_model_text("test", text, Format::Toml, Path::new("")).expect("a model");
    let prepared = Opened::new(input, "test").expect("assembles").prepare();
    let prepared = prepared.expect("plans");
    let settings = prepared.settings(false);
    assert_eq!(settings.record_interval, None);
    let plain = prepared.run(settings, &mut |_, _| ControlFlow::Continue(()));
    let plain = &plain.summary().buildings[0];
    assert_eq!(plain.response.filtered_acceleration_peak_m_s2, None);
}
