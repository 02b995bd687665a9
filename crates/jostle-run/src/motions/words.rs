//! A motion in words, numbers and small pictures.

use std::fmt::Write;

use jostle_io::shown::{ACCELERATION, HEIGHT, LENGTH, SPEED};
use jostle_motion::{
    Accelerogram, Measures, Reading, STANDARD_GRAVITY, response_spectrum, spaced_periods,
};
use serde_json::{Value, json};

use super::wrong;
use crate::error::RunError;
use crate::style::{BOLD, DIM, styled};

/// The JSON of `jostle motion show`.
#[must_use]
pub fn measures_json(name: &str, m: &Measures) -> Value {
    json!({
        "name": name,
        "points": m.points,
        "step_s": m.step,
        "duration_s": m.duration,
        "pga_m_s2": m.pga.value,
        "pga_at_s": m.pga.at,
        "pgv_m_s": m.pgv.value,
        "pgv_at_s": m.pgv.at,
        "pgd_m": m.pgd.value,
        "pgd_at_s": m.pgd.at,
        "arias_m_s": m.arias,
        "cav_m_s": m.cav,
        "d5_95_s": m.d5_95[1] - m.d5_95[0],
        "d5_75_s": m.d5_75[1] - m.d5_75[0],
        "rms_m_s2": m.rms,
        "predominant_period_s": m.predominant_period,
        "mean_period_s": m.mean_period,
        "housner_m": m.housner,
    })
}

/// A motion in numbers and in small pictures.
///
/// # Errors
/// [`RunError::Argument`] if its spectrum cannot be computed.
pub fn motion_text(name: &str, motion: &Accelerogram, m: &Measures) -> Result<String, RunError> {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{}  {} values, step {} s, {:.2} s",
        styled(BOLD, name),
        m.points,
        m.step,
        m.duration
    );
    let _ = writeln!(text, "  {}", picture(motion));
    let end = format!("{:.0} s", m.duration);
    let _ = writeln!(text, "  {}", styled(DIM, &format!("0{end:>71}")));
    let mut row = |what: &str, value: String, note: String| {
        let _ = writeln!(text, "  {what:<26}{value:<16}{}", styled(DIM, &note));
    };
    let at = |t: f64| format!("at {t:.2} s");
    let gravity = m.pga.value / STANDARD_GRAVITY;
    row(
        "peak acceleration",
        ACCELERATION.text(m.pga.value, 4),
        format!("{gravity:.4} g, {}", at(m.pga.at)),
    );
    row("peak velocity", SPEED.text(m.pgv.value, 4), at(m.pgv.at));
    row(
        "peak displacement",
        HEIGHT.text(m.pgd.value, 4),
        at(m.pgd.at),
    );
    row("Arias intensity", SPEED.text(m.arias, 4), String::new());
    row(
        "cumulative abs. velocity",
        SPEED.text(m.cav, 3),
        String::new(),
    );
    for (what, [from, to]) in [("duration 5–95 %", m.d5_95), ("duration 5–75 %", m.d5_75)] {
        row(
            what,
            format!("{:.2} s", to - from),
            format!("{from:.2} to {to:.2} s"),
        );
    }
    row("rms in 5–95 %", ACCELERATION.text(m.rms, 4), String::new());
    row(
        "predominant period",
        format!("{:.3} s", m.predominant_period),
        "largest response, 5 %".into(),
    );
    row(
        "mean period",
        format!("{:.3} s", m.mean_period),
        "of Fourier amplitudes".into(),
    );
    row(
        "Housner intensity",
        HEIGHT.text(m.housner, 4),
        "PSV over 0.1–2.5 s, 5 %".into(),
    );
    let periods = [0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0];
    let spectrum = response_spectrum(motion, &periods, &[0.05], Reading::Steps).map_err(wrong)?;
    let cells = |head: &str, values: &mut dyn Iterator<Item = String>| {
        let values: String = values.map(|value| format!("{value:>7}")).collect();
        format!("  {head:<14}{values}\n")
    };
    text.push('\n');
    text += &cells("period s", &mut periods.iter().map(f64::to_string));
    let curve = &spectrum.curves[0];
    // Columns of seven characters hold no more.
    let short = ACCELERATION.size() == 1.0;
    let psa = curve.pseudo_acceleration.iter();
    text += &cells(
        &format!("PSA 5 % {}", ACCELERATION.name()),
        &mut psa.map(|a| ACCELERATION.number(*a, if short { 3 } else { 1 })),
    );
    text += &cells(
        &format!("SD 5 % {}", LENGTH.name()),
        &mut curve.displacement.iter().map(|u| LENGTH.number(*u, 1)),
    );
    text += &format!("  {}\n", sparkline(motion)?);
    Ok(text)
}

const BARS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
/// Characters of a picture.
const WIDTH: usize = 72;

fn bar(share: f64) -> char {
    BARS[((share * 8.0).round().clamp(0.0, 8.0)) as usize]
}

/// Largest magnitudes over time.
fn picture(motion: &Accelerogram) -> String {
    let (a, peak) = (motion.acceleration(), motion.peak());
    let part = |i: usize| {
        let (first, last) = (
            i * a.len() / WIDTH,
            ((i + 1) * a.len() / WIDTH).max(i * a.len() / WIDTH + 1),
        );
        let largest = a[first..last.min(a.len())]
            .iter()
            .fold(0.0, |m: f64, a| m.max(a.abs()));
        bar(largest / peak)
    };
    (0..WIDTH).map(part).collect()
}

/// Pseudo-acceleration over the logarithm of the period.
fn sparkline(motion: &Accelerogram) -> Result<String, RunError> {
    let periods = spaced_periods(0.05, 5.0, 48);
    let spectrum = response_spectrum(motion, &periods, &[0.05], Reading::Steps).map_err(wrong)?;
    let values = &spectrum.curves[0].pseudo_acceleration;
    let largest = values.iter().fold(0.0, |m: f64, a| m.max(*a));
    let bars: String = values.iter().map(|a| bar(a / largest)).collect();
    Ok(format!("0.05 s {bars} 5 s"))
}

/// One line about a motion.
#[must_use]
pub fn motion_in_short(motion: &Accelerogram) -> String {
    format!(
        "{} values, step {} s, {:.2} s, PGA {} ({:.4} g)",
        motion.points(),
        motion.step(),
        motion.duration(),
        ACCELERATION.text(motion.peak(), 4),
        motion.peak() / STANDARD_GRAVITY
    )
}
