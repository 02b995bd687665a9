//! The capacity curve as a picture.

use jostle::hysteresis::Stage;
use jostle::pushover::{Bilinear, PushEventKind, PushPoint, PushedBuilding, Pushover};
use maud::{Markup, html};

use crate::format;
use crate::message;
use crate::scale::{Scale, name_upwards};

/// Plot area: left, top, width, height.
const AREA: [f64; 4] = [70.0, 30.0, 580.0, 320.0];

/// Scales of the picture of one building.
pub(super) struct Chart {
    /// Greatest roof displacement \[m\] and base shear \[N\] shown.
    size: [f64; 2],
}

/// The style attribute with the colour of a curve.
pub(super) fn colour(index: usize) -> &'static str {
    if index == 0 {
        "--c:var(--c0)"
    } else {
        "--c:var(--c2)"
    }
}

impl Chart {
    pub(super) fn new(one: &PushedBuilding) -> Self {
        let points = || one.curves.iter().flat_map(|curve| &curve.points);
        let greatest = |value: fn(&PushPoint) -> f64| points().map(value).fold(0.0, f64::max);
        let positive = |value: f64| if value > 0.0 { value } else { 1.0 };
        Self {
            size: [
                positive(greatest(|point| point.roof)),
                1.08 * positive(greatest(|point| point.base_shear)),
            ],
        }
    }

    /// Scales of roof displacements and base shears.
    pub(super) fn scales(&self) -> [Scale; 2] {
        let [left, top, width, height] = AREA;
        let [roof, shear] = self.size;
        let (roof, across) = ([0.0, roof], [left, left + width]);
        let (shear, up) = ([0.0, shear], [top + height, top]);
        [
            Scale::new(roof, across, format::LENGTH.size(), 7.0),
            Scale::new(shear, up, format::FORCE.size(), 6.0),
        ]
    }

    fn place(&self, roof: f64, shear: f64) -> [f64; 2] {
        let [x, y] = self.scales();
        [x.at(roof), y.at(shear)]
    }

    fn path(&self, points: impl Iterator<Item = [f64; 2]>) -> String {
        let text: Vec<String> = points
            .map(|[roof, shear]| self.place(roof, shear))
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        format!("M{}", text.join(" L"))
    }

    pub(super) fn draw(&self, one: &PushedBuilding) -> Markup {
        let [left, top, width, height] = AREA;
        let Some(first) = one.curves.first() else {
            return html! {};
        };
        let ([roof, shear], bottom) = (self.size, top + height);
        let [x, y] = self.scales();
        // The same in percent of the weight and of the height.
        let weight = [0.0, shear / first.weight];
        let weight = Scale::new(weight, [bottom, top], 0.01, 6.0);
        let drift = Scale::new([0.0, roof / first.height], [left, left + width], 0.01, 7.0);
        html! {
            svg.capacity viewBox="0 0 720 410" role="img" aria-label={ (message::base_shear_of_against(&one.building.name)) } {
                g.grid {
                    (x.across([top, bottom]))
                    (y.up([left, left + width]))
                    (weight.numbers_beside(left + width + 8.0, "start"))
                    (drift.numbers_at(top - 8.0))
                    text x=(left + width / 2.0) y=(top + height + 40.0) text-anchor="middle" { (message::roof_displacement_mm_above()) }
                    (name_upwards(message::base_shear_kn(), 14.0, top + height / 2.0))
                    (name_upwards(message::of_weight(), 708.0, top + height / 2.0))
                }
                @for (index, curve) in one.curves.iter().enumerate() { (self.curve(one, index, curve)) }
                circle.here data-role="here" r="7" cx=(left) cy=(top + height) {}
            }
        }
    }

    fn curve(&self, one: &PushedBuilding, index: usize, curve: &Pushover) -> Markup {
        let points = curve
            .points
            .iter()
            .map(|point| [point.roof, point.base_shear]);
        let two = Bilinear::fit(&curve.points).map(|two| {
            let corner = [two.yield_displacement, two.yield_force];
            let end = [two.ultimate_displacement, two.ultimate_force];
            self.path([[0.0, 0.0], corner, end].into_iter())
        });
        html! {
            @if let Some(two) = two { path.two d=(two) {} }
            path.curve.second[index > 0] style=(colour(index)) d=(self.path(points)) {}
            @for point in &curve.points { (self.event(one, curve, point)) }
            @if index == 0 { (self.names(curve)) }
        }
    }

    /// A dot where hinges crack or yield.
    fn event(&self, one: &PushedBuilding, curve: &Pushover, point: &PushPoint) -> Markup {
        let has = |kind| point.events.iter().any(|event| event.kind == kind);
        let yields = point.events.iter().any(|event| event.kind.is_yield());
        let (class, radius) = if has(PushEventKind::Fails) || yields {
            ("event yielded", 4.0)
        } else if has(PushEventKind::Cracks) {
            ("event cracked", 3.4)
        } else {
            return html! {};
        };
        let [x, y] = self.place(point.roof, point.base_shear);
        let events = point.events.iter().take(8);
        let said: Vec<String> = events
            .map(|event| format!("{} {}", one.place(event.spring), event.kind.name()))
            .collect();
        html! {
            circle class=(class) cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r=(radius) {
                title { (format::fixed(100.0 * curve.drift(point), 3)) " %: " (said.join("; ")) }
            }
        }
    }

    /// Names of the points that matter.
    fn names(&self, curve: &Pushover) -> Markup {
        let mut named: Vec<(&str, &PushPoint, [f64; 2], &str)> = Vec::new();
        let yields = curve.first(Stage::Yielded);
        // Where both are one point, it has one name.
        let cracks = curve.first(Stage::Cracked);
        let cracks = cracks.filter(|point| yields.is_none_or(|other| other.roof > point.roof));
        if let Some(point) = cracks {
            named.push((message::first_crack(), point, [10.0, 16.0], "start"));
        }
        if let Some(point) = yields {
            named.push((message::first_yield(), point, [10.0, 18.0], "start"));
        }
        if !named.is_empty() {
            let inside = curve.peak().roof > 0.85 * self.size[0];
            let anchor = if inside { "end" } else { "middle" };
            named.push((
                message::greatest(),
                curve.peak(),
                [if inside { -6.0 } else { 0.0 }, -11.0],
                anchor,
            ));
        }
        html! {
            @for (name, point, [dx, dy], anchor) in named {
                @let [x, y] = self.place(point.roof, point.base_shear);
                circle.ring cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="5" {}
                text.said x=(format!("{:.1}", x + dx)) y=(format!("{:.1}", y + dy)) text-anchor=(anchor) { (name) }
            }
        }
    }
}
