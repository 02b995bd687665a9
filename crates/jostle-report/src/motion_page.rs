//! The page of a motion: its history, its spectra, its measures.

use jostle_motion::{
    Accelerogram, Measures, MotionFault, Reading, SpectrumCurve, displacement, fourier_spectrum,
    husid, response_spectrum, spaced_periods, velocity,
};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde_json::{Value, json};

use crate::document::{POLICY, STYLE, theme_button};
use crate::encode::Packed;
use crate::format;

/// What the page of a motion shows.
#[derive(Clone, Copy, Debug)]
pub struct MotionPage<'a> {
    /// Name of the motion.
    pub name: &'a str,
    /// The motion.
    pub motion: &'a Accelerogram,
    /// Its measures.
    pub measures: &'a Measures,
}

const SCRIPTS: [&str; 4] = [
    include_str!("../assets/data.js"),
    include_str!("../assets/chart.js"),
    include_str!("../assets/spectrum_chart.js"),
    include_str!("../assets/motion.js"),
];
/// Damping ratios of the page of a motion.
const DAMPINGS: [f64; 4] = [0.02, 0.05, 0.1, 0.2];
/// Points of a history that are shown.
const MOST_POINTS: usize = 20_000;

/// The page of a motion: one HTML file that opens offline.
///
/// # Errors
/// None for motions that exist; spectra are computed here.
pub fn render_motion(page: &MotionPage) -> Result<String, MotionFault> {
    let periods = spaced_periods(0.02, 10.0, 200);
    let spectrum = response_spectrum(page.motion, &periods, &DAMPINGS, Reading::Steps)?;
    let spectra: Vec<Value> = spectrum
        .curves
        .iter()
        .map(|curve| curve_data(&format!("{} %", 100.0 * curve.damping), &periods, curve))
        .collect();
    let data = motion_data(page, spectra);
    let body = html! {
        p.verdict { (sentence(page)) }
        (tiles(page.measures))
        section #charts {
            h2 { "Over time" }
            div.controls {
                span.buttons role="group" aria-label="Zoom all charts" {
                    button #zoom-in type="button" aria-label="Zoom in" { "+" }
                    button #zoom-out type="button" aria-label="Zoom out" { "−" }
                    button #zoom-strong type="button" { "Strong part" }
                    button #zoom-all type="button" { "Whole motion" }
                }
            }
            p.quiet.screen { "Drag across a chart to zoom, double-click for the whole motion. Velocity and displacement are integrated from rest, without baseline correction." }
            div #time-charts {}
        }
        section #response {
            h2 { "Response spectra" }
            (spectrum_controls(true))
            div #spectra {}
            p.quiet { "Exact for linear ground acceleration between samples; peaks are read at the ends of steps, at least twenty per period." }
        }
        section #content {
            h2 { "Frequency content" }
            div #fourier {}
        }
    };
    Ok(frame(page.name, "Ground motion", &body, &data))
}

pub(crate) fn frame(title: &str, kicker: &str, body: &Markup, data: &Value) -> String {
    // A closing tag inside a name must not end the script.
    let data = data.to_string().replace('<', "\\u003c");
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { (title) " – jostle" }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) }
            }
            body {
                header.head {
                    div { p.kicker { (kicker) } h1 { (title) } }
                    (theme_button())
                }
                main { (body) }
                footer { "Made by jostle " (env!("CARGO_PKG_VERSION")) ". One file; nothing is loaded from a network." }
                noscript { p.note { "The charts need JavaScript." } }
                script #page-data type="application/json" { (PreEscaped(data)) }
                script type="module" { (PreEscaped(SCRIPTS.concat())) }
            }
        }
    };
    page.into_string()
}

pub(crate) fn spectrum_controls(quantities: bool) -> Markup {
    html! {
        div.controls {
            @if quantities {
                label { "Show "
                    select #quantity {
                        option value="psa" { "pseudo-acceleration" }
                        option value="sa" { "total acceleration" }
                        option value="psv" { "pseudo-velocity" }
                        option value="sd" { "displacement" }
                    }
                }
            }
            label { "Axes "
                select #axes {
                    option value="semilog" { "logarithm of T" }
                    option value="linear" { "linear" }
                    option value="log" { "both logarithmic" }
                }
            }
        }
    }
}

fn sentence(page: &MotionPage) -> String {
    let m = page.measures;
    format!(
        "{} values at {} s: {} of shaking, strong from {} to {}.",
        format::fixed(m.points as f64, 0),
        format::plain(m.step, 4),
        format::unit(format::fixed(m.duration, 2), "s"),
        format::unit(format::fixed(m.d5_95[0], 1), "s"),
        format::unit(format::fixed(m.d5_95[1], 1), "s"),
    )
}

fn tiles(m: &Measures) -> Markup {
    let value = |value: f64, unit: &str| format::unit(format::significant(value, 4), unit);
    let at = |t: f64| format!("at {}", format::unit(format::fixed(t, 2), "s"));
    let span = |[from, to]: [f64; 2]| {
        (
            format::unit(format::fixed(to - from, 2), "s"),
            format!(
                "from {} to {}",
                format::fixed(from, 2),
                format::unit(format::fixed(to, 2), "s")
            ),
        )
    };
    let gravity = format::significant(m.pga.value / format::STANDARD_GRAVITY, 4);
    let (long, long_note) = span(m.d5_95);
    let (short, short_note) = span(m.d5_75);
    let tiles = [
        (
            "Peak acceleration",
            value(m.pga.value, "m/s²"),
            format!("{gravity} g, {}", at(m.pga.at)),
        ),
        ("Peak velocity", value(m.pgv.value, "m/s"), at(m.pgv.at)),
        ("Peak displacement", value(m.pgd.value, "m"), at(m.pgd.at)),
        (
            "Arias intensity",
            value(m.arias, "m/s"),
            "π/2g ∫a² dt".to_owned(),
        ),
        (
            "Cumulative absolute velocity",
            value(m.cav, "m/s"),
            "∫|a| dt".to_owned(),
        ),
        ("Duration 5–95 %", long, long_note),
        ("Duration 5–75 %", short, short_note),
        (
            "Root mean square",
            value(m.rms, "m/s²"),
            "within 5–95 %".to_owned(),
        ),
        (
            "Predominant period",
            value(m.predominant_period, "s"),
            "largest response, 5 %".to_owned(),
        ),
        (
            "Mean period",
            value(m.mean_period, "s"),
            "of Fourier amplitudes".to_owned(),
        ),
        (
            "Housner intensity",
            value(m.housner, "m"),
            "PSV over 0.1–2.5 s, 5 %".to_owned(),
        ),
    ];
    html! {
        div.tiles {
            @for (name, value, note) in &tiles {
                div.tile { p.tile-name { (name) } p.tile-value { (value) } p.tile-note { (note) } }
            }
        }
    }
}

fn motion_data(page: &MotionPage, spectra: Vec<Value>) -> Value {
    let motion = page.motion;
    let kept = kept(motion.acceleration());
    let pick = |values: &[f64]| kept.iter().map(|&i| values[i]).collect::<Vec<_>>();
    let pack = |values: &[f64]| Packed::values(pick(values).iter().copied());
    let times: Vec<f64> = kept.iter().map(|&i| motion.step() * i as f64).collect();
    let husid: Vec<f64> = husid(motion)
        .iter()
        .map(|i| i / page.measures.arias)
        .collect();
    let fourier = fourier_spectrum(motion, 0.025);
    let (frequency, amplitude) = smoothed(&fourier.frequency, &fourier.amplitude);
    json!({
        "duration": motion.duration(), "run": null, "without": null, "forces": [], "gaps": [], "buildings": [],
        "ground": { "time": Packed::instants(&times), "values": pack(motion.acceleration()) },
        "velocity": pack(&velocity(motion)),
        "displacement": pack(&displacement(motion)),
        "husid": pack(&husid),
        "levels": [0.05, 0.75, 0.95],
        "strong": page.measures.d5_95,
        "spectra": spectra,
        "marks": [],
        "fourier": { "frequency": digits(&frequency), "amplitude": digits(&amplitude) },
    })
}

fn curve_data(label: &str, periods: &[f64], curve: &SpectrumCurve) -> Value {
    json!({
        "label": label,
        "periods": digits(periods),
        "psa": digits(&curve.pseudo_acceleration),
        "sa": digits(&curve.total_acceleration),
        "psv": digits(&curve.pseudo_velocity),
        "sd": digits(&curve.displacement),
    })
}

/// Values to five digits, enough to draw.
pub(crate) fn digits(values: &[f64]) -> Vec<f64> {
    let round = |value: &f64| format!("{value:.4e}").parse().unwrap_or(0.0);
    values.iter().map(round).collect()
}

/// Samples to show: all, or of long motions the extremes of equal parts.
fn kept(values: &[f64]) -> Vec<usize> {
    if values.len() <= MOST_POINTS {
        return (0..values.len()).collect();
    }
    let part = values.len().div_ceil(MOST_POINTS / 2);
    let mut kept = vec![0];
    for first in (0..values.len()).step_by(part) {
        let range = first..(first + part).min(values.len());
        let low = range
            .clone()
            .min_by(|&i, &j| values[i].total_cmp(&values[j]));
        let high = range.max_by(|&i, &j| values[i].total_cmp(&values[j]));
        let mut both: Vec<usize> = low.into_iter().chain(high).collect();
        both.sort_unstable();
        kept.extend(both);
    }
    kept.push(values.len() - 1);
    kept.dedup();
    kept
}

/// Amplitudes as root mean squares over bands of equal ratio, 40 in a decade.
fn smoothed(frequency: &[f64], amplitude: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let ratio = 10.0_f64.powf(1.0 / 40.0);
    let (mut centres, mut means) = (Vec::new(), Vec::new());
    let mut low = 0.1;
    while low < frequency.last().copied().unwrap_or(0.0) {
        let inside = |f: &f64| (low..low * ratio).contains(f);
        let band: Vec<f64> = frequency
            .iter()
            .zip(amplitude)
            .filter(|(f, _)| inside(f))
            .map(|(_, a)| a * a)
            .collect();
        if !band.is_empty() {
            centres.push(low * ratio.sqrt());
            means.push((band.iter().sum::<f64>() / band.len() as f64).sqrt());
        }
        low *= ratio;
    }
    (centres, means)
}

#[cfg(test)]
mod tests {
    use super::*;
    use jostle_motion::measures;

    #[test]
    fn a_long_motion_with_an_awkward_name_makes_a_small_safe_page() {
        let wave = |i: u32| (0.01 * f64::from(i)).sin() * (0.37 * f64::from(i)).cos();
        let motion = Accelerogram::new(0.005, (0..200_000).map(wave).collect()).unwrap();
        let measures = measures(&motion).unwrap();
        let name = "a</script><b>&\"name";
        let page = MotionPage {
            name,
            motion: &motion,
            measures: &measures,
        };
        let text = render_motion(&page).unwrap();
        assert!(text.len() < 1_000_000, "{} bytes", text.len());
        assert!(
            !text.contains("a</script>"),
            "the name must not end the script"
        );
        assert_eq!(text.matches("</script>").count(), 2);
    }

    #[test]
    fn thinning_keeps_the_extremes_in_order() {
        let mut values = vec![0.0; 100_000];
        (values[777], values[98_765]) = (5.0, -7.0);
        let kept = kept(&values);
        assert!(kept.contains(&777) && kept.contains(&98_765) && kept.len() <= MOST_POINTS + 2);
        assert!(kept.windows(2).all(|pair| pair[0] < pair[1]), "in order");
    }
}
