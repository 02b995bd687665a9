//! The page of a motion: its history, its spectra, its measures.

use jostle_motion::{
    Accelerogram, Measures, MotionFault, Reading, SpectrumCurve, displacement, fourier_spectrum,
    husid, response_spectrum, spaced_periods, velocity,
};
use maud::{Markup, html};
use serde_json::{Value, json};

use crate::document::render_document;
use crate::encode::Packed;
use crate::format;
use crate::message;

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

const SCRIPTS: [&str; 6] = [
    include_str!("../assets/messages.js"),
    include_str!("../assets/plot.js"),
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
            h2 { (message::over_time()) }
            div.controls {
                span.buttons role="group" aria-label=(message::zoom_all_charts()) {
                    button #zoom-in type="button" aria-label=(message::zoom_in()) { "+" }
                    button #zoom-out type="button" aria-label=(message::zoom_out()) { "−" }
                    button #zoom-strong type="button" { (message::strong_part()) }
                    button #zoom-all type="button" { (message::whole_motion()) }
                }
            }
            p.quiet.screen { (message::drag_across_a_chart()) }
            div #time-charts {}
        }
        section #response {
            h2 { (message::response_spectra()) }
            (spectrum_controls(true))
            div #spectra {}
            p.quiet { (message::exact_for_linear_ground_acceleration()) }
        }
        section #content {
            h2 { (message::frequency_content()) }
            div #fourier {}
        }
    };
    Ok(frame(page.name, message::ground_motion(), &body, &data))
}

pub(crate) fn frame(title: &str, kicker: &str, body: &Markup, data: &Value) -> String {
    render_document(title, kicker, &body.0, data, "", &SCRIPTS.concat())
}

pub(crate) fn spectrum_controls(quantities: bool) -> Markup {
    html! {
        div.controls {
            @if quantities {
                label { (message::show()) " "
                    select #quantity {
                        option value="psa" { (message::pseudo_acceleration()) }
                        option value="sa" { (message::total_acceleration()) }
                        option value="psv" { (message::pseudo_velocity()) }
                        option value="sd" { (message::displacement()) }
                    }
                }
            }
            label { (message::axes()) " "
                select #axes {
                    option value="semilog" { (message::logarithm_of_t()) }
                    option value="linear" { (message::linear()) }
                    option value="log" { (message::both_logarithmic()) }
                }
            }
        }
    }
}

fn sentence(page: &MotionPage) -> String {
    let m = page.measures;
    message::values_at_s_of_shaking(
        format::fixed(m.points as f64, 0),
        format::plain(m.step, 4),
        format::unit(format::fixed(m.duration, 2), "s"),
        format::unit(format::fixed(m.d5_95[0], 1), "s"),
        format::unit(format::fixed(m.d5_95[1], 1), "s"),
    )
}

fn tiles(m: &Measures) -> Markup {
    let value = |value: f64, unit: &str| format::unit(format::significant(value, 4), unit);
    let shown = |unit: format::Shown, value: f64| format::short(unit, value, 4);
    let at = |t: f64| message::at_at(format::unit(format::fixed(t, 2), "s"));
    let span = |[from, to]: [f64; 2]| {
        (
            format::unit(format::fixed(to - from, 2), "s"),
            message::from_to(
                format::fixed(from, 2),
                format::unit(format::fixed(to, 2), "s"),
            ),
        )
    };
    let gravity = format::significant(m.pga.value / format::STANDARD_GRAVITY, 4);
    let (long, long_note) = span(m.d5_95);
    let (short, short_note) = span(m.d5_75);
    let tiles = [
        (
            message::peak_acceleration_title(),
            shown(format::ACCELERATION, m.pga.value),
            format!("{gravity} g, {}", at(m.pga.at)),
        ),
        (
            message::peak_velocity(),
            shown(format::SPEED, m.pgv.value),
            at(m.pgv.at),
        ),
        (
            message::peak_displacement(),
            shown(format::LENGTH, m.pgd.value),
            at(m.pgd.at),
        ),
        (
            message::arias_intensity(),
            shown(format::SPEED, m.arias),
            message::arias_integral().to_owned(),
        ),
        (
            message::cumulative_absolute_velocity(),
            shown(format::SPEED, m.cav),
            message::absolute_integral().to_owned(),
        ),
        (message::duration_5_95(), long, long_note),
        (message::duration_5_75(), short, short_note),
        (
            message::root_mean_square(),
            shown(format::ACCELERATION, m.rms),
            message::within_5_95().to_owned(),
        ),
        (
            message::predominant_period(),
            value(m.predominant_period, "s"),
            message::largest_response_5().to_owned(),
        ),
        (
            message::mean_period(),
            value(m.mean_period, "s"),
            message::of_fourier_amplitudes().to_owned(),
        ),
        (
            message::housner_intensity(),
            shown(format::HEIGHT, m.housner),
            message::psv_over_0_1_2().to_owned(),
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
        assert_eq!(
            text.matches("</script>").count(),
            5,
            "data, texts, units, the script, and that of light and dark"
        );
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
