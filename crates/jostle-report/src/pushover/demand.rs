//! Capacity and demand over spectral displacement and acceleration, and where they meet.

use jostle::pushover::{Bilinear, EquivalentOscillator, PushPoint, PushedBuilding, Pushover};
use jostle_motion::{
    Accelerogram, Oscillator, Reading, bilinear_displacement, response_spectrum, spaced_periods,
};
use maud::{Markup, html};

use crate::format;
use crate::message;
use crate::scale::{Scale, name_upwards};

/// What a building is asked to withstand.
#[derive(Clone, Copy, Debug)]
pub struct Demand<'a> {
    /// Name of the ground motion.
    pub name: &'a str,
    /// The ground motion.
    pub motion: &'a Accelerogram,
    /// Damping ratio of the spectrum and of the equivalent oscillator, below one \[–\].
    pub damping: f64,
}

/// Plot area: left, top, width, height.
const AREA: [f64; 4] = [70.0, 30.0, 580.0, 320.0];
/// Periods of the spectrum, first and last \[s\], and their number.
const PERIODS: (f64, f64, usize) = (0.05, 6.0, 160);
/// Periods whose lines through the origin are drawn \[s\].
const LINES: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 4.0];

/// What a motion does to the equivalent bilinear oscillator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PerformancePoint {
    /// Of small vibration, from the secant of the bilinear curve \[s\].
    pub(super) period: f64,
    /// Spectral displacement at yield \[m\].
    pub(super) at_yield: f64,
    /// Greatest spectral displacement \[m\].
    pub(super) reached: f64,
    /// Spectral acceleration there, on the bilinear curve \[m/s²\].
    pub(super) acceleration: f64,
}

/// Where the motion takes the oscillator that the bilinear curve describes; `None` for one that softens at once.
pub(super) fn performance_point(
    one: EquivalentOscillator,
    two: &Bilinear,
    demand: &Demand<'_>,
) -> Option<PerformancePoint> {
    let [at_yield, strength] = one.spectral(two.yield_displacement, two.yield_force);
    let stiffness = strength / at_yield;
    let oscillator = Oscillator {
        period: std::f64::consts::TAU / stiffness.sqrt(),
        damping: demand.damping,
    };
    // A curve that falls after yield is taken as flat.
    let hardening = two.hardening().max(0.0);
    let reached = bilinear_displacement(demand.motion, &oscillator, hardening, at_yield).ok()?;
    let beyond = (reached - at_yield).max(0.0);
    Some(PerformancePoint {
        period: oscillator.period,
        at_yield,
        reached,
        acceleration: stiffness * (reached.min(at_yield) + hardening * beyond),
    })
}

/// The section of one building: a picture, and what it says of each curve.
pub(super) fn section(index: usize, one: &PushedBuilding<'_>, demand: &Demand<'_>) -> Markup {
    let periods = spaced_periods(PERIODS.0, PERIODS.1, PERIODS.2);
    let spectrum = response_spectrum(demand.motion, &periods, &[demand.damping], Reading::Between);
    let Ok(spectrum) = spectrum else {
        return html! {};
    };
    let wanted: Vec<[f64; 2]> = spectrum
        .curves
        .iter()
        .flat_map(|curve| curve.displacement.iter().zip(&curve.pseudo_acceleration))
        .map(|(displacement, acceleration)| [*displacement, *acceleration])
        .collect();
    let capacities: Vec<Capacity<'_>> = one
        .curves
        .iter()
        .filter_map(|curve| Capacity::new(one, curve, demand))
        .collect();
    if capacities.is_empty() {
        return html! {};
    }
    html! {
        figure.chart.adrs {
            figcaption {
                span.chart-title { (message::capacity_and_demand()) }
                span.legend {
                    span.key { span.swatch style="--c:var(--c1)" {} (message::elastic_demand_damping(format::plain(100.0 * demand.damping, 2))) }
                    @for (k, capacity) in capacities.iter().enumerate() {
                        span.key { span.swatch.dashed[k > 0] style=(super::chart::colour(k)) {} (message::capacity_to(capacity.curve.settings.direction.name())) }
                    }
                    span.key { span.swatch.dashed {} (message::bilinear()) }
                    span.key { span.swatch.round.reached {} (message::reached()) }
                }
            }
            (picture(index, &one.building.name, &wanted, &capacities))
        }
        @for capacity in &capacities { p { (capacity.in_words(demand)) } }
        p.quiet {
            (message::spectral_displacement_is_the_roof())
        }
    }
}

/// A capacity curve as that of an oscillator.
struct Capacity<'a> {
    curve: &'a Pushover,
    one: EquivalentOscillator,
    two: Option<Bilinear>,
    performance: Option<PerformancePoint>,
}

impl<'a> Capacity<'a> {
    fn new(pushed: &PushedBuilding<'_>, curve: &'a Pushover, demand: &Demand<'_>) -> Option<Self> {
        let one = EquivalentOscillator::new(pushed.building, curve)?;
        let two = Bilinear::fit(&curve.points);
        let performance = two
            .as_ref()
            .and_then(|two| performance_point(one, two, demand));
        Some(Self {
            curve,
            one,
            two,
            performance,
        })
    }

    fn points(&self) -> Vec<[f64; 2]> {
        let spectral = |point: &PushPoint| self.one.spectral(point.roof, point.base_shear);
        self.curve.points.iter().map(spectral).collect()
    }

    fn in_words(&self, demand: &Demand<'_>) -> String {
        let mass = format::tonnes(self.one.mass);
        let shape = message::pushed_to_the_m(
            self.curve.settings.direction.name(),
            &mass,
            format::significant(self.one.participation, 4),
        );
        let Some(found) = self.performance else {
            return message::the_curve_has_no_bilinear(&shape);
        };
        let roof = self.one.participation * found.reached;
        let last = self.curve.points.last().map_or(0.0, |point| point.roof);
        let beyond = if roof > last {
            message::beyond_the_end()
        } else {
            ""
        };
        message::t_s_under_the_roof(
            &shape,
            format::significant(found.period, 3),
            demand.name,
            format::millimetres(roof),
            format::significant(100.0 * roof / self.curve.height, 3),
            beyond,
            format::significant(found.reached / found.at_yield, 3),
        )
    }
}

fn picture(index: usize, name: &str, wanted: &[[f64; 2]], capacities: &[Capacity<'_>]) -> Markup {
    let [left, top, width, height] = AREA;
    let bottom = top + height;
    let reached = capacities
        .iter()
        .filter_map(|capacity| capacity.performance);
    let ends = capacities.iter().flat_map(Capacity::points);
    let far = ends
        .clone()
        .map(|point| point[0])
        .chain(reached.map(|found| found.reached))
        .fold(1e-9, f64::max);
    // As far as the capacity, and as much of the demand as lies above it.
    let far = 1.1 * far;
    let high = wanted
        .iter()
        .filter(|point| point[0] <= far)
        .copied()
        .chain(ends)
        .map(|point| point[1])
        .fold(1e-9, f64::max);
    let high = 1.06 * high;
    let x = Scale::new([0.0, far], [left, left + width], format::LENGTH.size(), 7.0);
    let y = Scale::new([0.0, high], [bottom, top], format::ACCELERATION.size(), 6.0);
    let place = |point: [f64; 2]| [x.at(point[0]), y.at(point[1])];
    let path = |points: &[[f64; 2]]| {
        let text: Vec<String> = points
            .iter()
            .map(|point| place(*point))
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        format!("M{}", text.join("L"))
    };
    let bilinear = |capacity: &Capacity<'_>, two: &Bilinear| {
        let corner = capacity
            .one
            .spectral(two.yield_displacement, two.yield_force);
        let end = capacity
            .one
            .spectral(two.ultimate_displacement, two.ultimate_force);
        path(&[[0.0, 0.0], corner, end])
    };
    html! {
        svg.capacity viewBox="0 0 720 400" role="img" aria-label={ (message::spectral_acceleration_of_against_spectral(name)) } {
            clipPath id={ "adrs-clip-" (index) } { rect x=(left) y=(top) width=(width) height=(height) {} }
            g.grid {
                (x.across([top, bottom]))
                (y.up([left, left + width]))
                text x=(left + width / 2.0) y=(bottom + 40.0) text-anchor="middle" { (message::spectral_displacement_mm()) }
                (name_upwards(message::spectral_acceleration_m_s(), 14.0, top + height / 2.0))
            }
            @for period in LINES {
                @let stiffness = (std::f64::consts::TAU / period).powi(2);
                @let end = if stiffness * far > high { [high / stiffness, high] } else { [far, stiffness * far] };
                @let [x, y] = place(end);
                path.ray d=(path(&[[0.0, 0.0], end])) {}
                text.axis x=(format!("{x:.1}")) y=(format!("{:.1}", y - 5.0)) text-anchor=(if end[0] < far { "middle" } else { "end" }) { (format::plain(period, 2)) " s" }
            }
            g clip-path={ "url(#adrs-clip-" (index) ")" } {
                path.curve.wanted style="--c:var(--c1)" d=(path(wanted)) {}
                @for (k, capacity) in capacities.iter().enumerate() {
                    @if let Some(two) = &capacity.two { path.two d=(bilinear(capacity, two)) {} }
                    path.curve.second[k > 0] style=(super::chart::colour(k)) d=(path(&capacity.points())) {}
                }
            }
            @for found in capacities.iter().filter_map(|capacity| capacity.performance) {
                @let [x, y] = place([found.reached, found.acceleration]);
                circle.reached cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="5.5" {
                    title { (format::millimetres(found.reached)) ", " (format::significant(format::ACCELERATION.of(found.acceleration), 3)) " " (format::ACCELERATION.name()) }
                }
            }
        }
    }
}
