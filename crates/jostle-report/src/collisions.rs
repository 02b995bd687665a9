//! The page of `jostle collide`: collisions of two free masses under contact laws.

use jostle::ContactLaw;
use jostle::contact::{CollisionPoint, FreeCollision};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::document::{POLICY, STYLE, on_paper, theme_button, theme_script};
use crate::format;
use crate::message;

/// A law and its collision.
#[derive(Clone, Debug)]
pub struct CollidedLaw {
    /// As asked for, with its own stiffness.
    pub law: ContactLaw,
    /// The collision.
    pub collision: FreeCollision,
}

/// Two free masses under one or several laws.
#[derive(Clone, Debug)]
pub struct Collisions {
    /// Masses \[kg\].
    pub masses: [f64; 2],
    /// Closing speed at first contact \[m/s\].
    pub speed: f64,
    /// Coefficient of restitution asked for; `None` where a dashpot is given \[–\].
    pub restitution: Option<f64>,
    /// How the stiffnesses of the two families compare, and what a given dashpot stands for, for people.
    pub stiffnesses: String,
    /// Laws in order.
    pub laws: Vec<CollidedLaw>,
}

/// Which quantity lies on the horizontal axis.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Across {
    Time,
    Indentation,
}

impl Across {
    fn value(self, point: &CollisionPoint) -> f64 {
        match self {
            Self::Time => point.time,
            Self::Indentation => point.indentation,
        }
    }

    /// Size of the unit of the axis \[SI\].
    fn unit(self) -> f64 {
        match self {
            Self::Time => 1e-3,
            Self::Indentation => format::LENGTH.size(),
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Time => message::time_ms(),
            Self::Indentation => message::indentation_mm(),
        }
    }
}

/// Greatest values of the axes \[s or m, N\] and the least force.
#[derive(Clone, Copy)]
struct Extent {
    across: f64,
    force: f64,
    least: f64,
}

/// Panel: width, height, and margins left, top, right, bottom.
const PANEL: [f64; 2] = [320.0, 190.0];
const MARGIN: [f64; 4] = [46.0, 8.0, 10.0, 34.0];
/// A law that reaches this many times further than most has axes of its own.
const FAR: f64 = 1.8;

/// The whole page.
#[must_use]
pub fn render_collisions(collisions: &Collisions) -> String {
    let [m1, m2] = collisions.masses;
    let title = message::against_at_m_s(
        format::tonnes(m1),
        format::tonnes(m2),
        format::plain(format::SPEED.of(collisions.speed), 3),
    );
    let page = html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { (title) " – jostle" }
                style { (PreEscaped(STYLE)) }
                (on_paper(&title))
            }
            body {
                header.head { div {
                    p.kicker { (message::collision_of_two_free_masses()) }
                    h1 { (title) }
                    p {
                        @match collisions.restitution {
                            Some(e) => (message::input_restitution(format::plain(e, 3), &collisions.stiffnesses)),
                            None => (collisions.stiffnesses),
                        }
                    }
                } (theme_button()) }
                main {
                    p.verdict { (verdict(collisions)) }
                    section { h2 { (message::numbers()) } (table(collisions)) }
                    @for (across, heading) in [(Across::Time, message::force_over_time()), (Across::Indentation, message::force_over_indentation())] {
                        section {
                            h2 { (heading) }
                            (panels(collisions, across))
                        }
                    }
                    p.quiet {
                        (message::dashed_the_elastic_law())
                    }
                }
                footer { (message::made_by_jostle()) }
                (theme_script())
            }
        }
    };
    page.into_string()
}

/// The result in a sentence.
fn verdict(collisions: &Collisions) -> String {
    let restitution = |law: &CollidedLaw| law.collision.realised_restitution();
    let shown = |e: f64| format::fixed(e, 2);
    if let [law] = &collisions.laws[..] {
        let force = law
            .collision
            .peak_force
            .map_or(format::NOTHING.into(), format::force);
        let name = format::capital(&law.law.kind.full_name());
        return message::one_law_rebounds(name, force, shown(restitution(law)));
    }
    let forces = collisions
        .laws
        .iter()
        .filter_map(|law| law.collision.peak_force);
    let all = collisions.laws.iter().map(restitution);
    let least = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::INFINITY, f64::min);
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::NEG_INFINITY, f64::max);
    message::laws_differ(
        collisions.laws.len(),
        format::force(least(&mut forces.clone())),
        format::force(most(&mut forces.clone())),
        shown(least(&mut all.clone())),
        shown(most(&mut all.clone())),
    )
}

fn table(collisions: &Collisions) -> Markup {
    let columns = [
        (message::realised_e(), "–"),
        (message::peak_force(), format::FORCE.name()),
        (message::indentation(), format::LENGTH.name()),
        (message::duration(), "ms"),
        (message::dissipated(), format::ENERGY.name()),
        (message::impulse(), format::IMPULSE.name()),
        (message::separation_speed(), format::SPEED.name()),
    ];
    html! {
        div.scroll { table {
            thead { tr {
                th scope="col" { (message::law()) }
                @for (name, unit) in columns { th.number scope="col" { (name) @if unit != "–" { br; span.unit { "[" (unit) "]" } } } }
            } }
            tbody {
                @for CollidedLaw { law, collision } in &collisions.laws {
                    tr {
                        td { (law.kind.full_name()) }
                        td.number { (format::fixed(collision.realised_restitution(), 4)) }
                        td.number { (collision.peak_force.map_or(format::NOTHING.into(), |force| format::significant(format::FORCE.of(force), 4))) }
                        td.number { (format::significant(format::LENGTH.of(collision.peak_indentation), 4)) }
                        td.number { (format::significant(collision.duration * 1e3, 4)) }
                        td.number { (format::significant(format::ENERGY.of(collision.dissipated), 4)) }
                        td.number { (format::significant(format::IMPULSE.of(collision.impulse), 4)) }
                        td.number { (format::significant(format::SPEED.of(collision.separation_speed), 4)) }
                    }
                }
            }
        } }
    }
}

fn panels(collisions: &Collisions, across: Across) -> Markup {
    let common = common_extent(&collisions.laws, across);
    html! {
        div.multiples {
            @for law in collisions.laws.iter().filter(|law| law.collision.curve.len() > 1) {
                @let own = extent(law, across);
                @let extent = fitting(own, common);
                figure.multiple {
                    figcaption {
                        (law.law.kind.full_name())
                        @if extent.across != common.across { span.unit { " " (message::own_axes()) } }
                    }
                    svg viewBox={ "0 0 " (PANEL[0]) " " (PANEL[1]) } role="img" aria-label={ (message::force_over(law.law.kind.full_name(), across.label())) } {
                        (panel(law, elastic(&collisions.laws, law), across, extent))
                    }
                }
            }
        }
    }
}

/// The elastic law of the same family, if it is there and another one.
fn elastic<'a>(laws: &'a [CollidedLaw], law: &CollidedLaw) -> Option<&'a CollidedLaw> {
    laws.iter().find(|other| {
        !matches!(law.law.kind, jostle::LawKind::Rubber(_))
            && !other.law.kind.is_dissipative()
            && other.law.kind != law.law.kind
            && other.law.kind.is_hertzian() == law.law.kind.is_hertzian()
    })
}

fn extent(law: &CollidedLaw, across: Across) -> Extent {
    let points = &law.collision.curve;
    Extent {
        across: points.iter().map(|p| across.value(p)).fold(0.0, f64::max),
        force: points.iter().map(|p| p.force).fold(0.0, f64::max),
        least: points.iter().map(|p| p.force).fold(0.0, f64::min),
    }
}

/// Axes that hold all laws but the far ones.
fn common_extent(laws: &[CollidedLaw], across: Across) -> Extent {
    let extents: Vec<Extent> = laws
        .iter()
        .filter(|law| law.collision.curve.len() > 1)
        .map(|law| extent(law, across))
        .collect();
    let limit = |value: fn(&Extent) -> f64| {
        let mut values: Vec<f64> = extents.iter().map(value).collect();
        values.sort_by(f64::total_cmp);
        FAR * values.get(values.len() / 2).copied().unwrap_or(1.0)
    };
    let (far_across, far_force) = (limit(|e| e.across), limit(|e| e.force));
    extents
        .iter()
        .filter(|e| e.across <= far_across && e.force <= far_force)
        .fold(
            Extent {
                across: 0.0,
                force: 0.0,
                least: 0.0,
            },
            |all, e| Extent {
                across: all.across.max(e.across),
                force: all.force.max(e.force),
                least: all.least.min(e.least),
            },
        )
}

fn fitting(extent: Extent, common: Extent) -> Extent {
    if extent.across > common.across || extent.force > common.force {
        extent
    } else {
        common
    }
}

/// A round distance between marks, with some four of them.
fn tick(greatest: f64) -> f64 {
    let rough = greatest / 4.0;
    let power = 10f64.powf(rough.log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|share| share * power)
        .find(|tick| *tick >= rough)
        .unwrap_or(rough)
}

fn panel(
    law: &CollidedLaw,
    elastic: Option<&CollidedLaw>,
    across: Across,
    extent: Extent,
) -> Markup {
    let [left, top, right, bottom] = MARGIN;
    let (width, height) = (PANEL[0] - left - right, PANEL[1] - top - bottom);
    let span = (extent.force - extent.least) * 1.05;
    let place = |x: f64, force: f64| {
        [
            left + x / (extent.across * 1.02) * width,
            top + (extent.force * 1.03 - force) / span * height,
        ]
    };
    let inside = |p: &&CollisionPoint| across.value(p) <= extent.across * 1.02;
    // An elastic law goes back as it came; drawing it once keeps its dashes.
    let once = |p: &&CollisionPoint, whole: bool| whole || across == Across::Time || p.rate >= 0.0;
    let path = |law: &CollidedLaw, whole: bool| {
        let mut points: Vec<String> = law
            .collision
            .curve
            .iter()
            .filter(inside)
            .filter(|p| once(p, whole))
            .map(|p| place(across.value(p), p.force))
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        // A force that begins or ends with a jump.
        if let (Some(first), Some(last)) = (law.collision.curve.first(), law.collision.curve.last())
        {
            for (end, p) in [(0, first), (usize::MAX, last)]
                .into_iter()
                .filter(|(_, p)| once(p, whole))
            {
                let [x, y] = place(across.value(p), 0.0);
                points.insert(end.min(points.len()), format!("{x:.1},{y:.1}"));
            }
        }
        points.dedup();
        format!("M{}", points.join("L"))
    };
    let (step_x, step_y) = (
        tick(extent.across / across.unit()),
        tick(format::FORCE.of(extent.force)),
    );
    let marks = |step: f64, from: f64, to: f64| {
        let (low, high) = ((from / step).ceil() as i64, (to / step).floor() as i64);
        (low..=high).map(move |i| i as f64 * step)
    };
    html! {
        g.grid {
            @for kn in marks(step_y, format::FORCE.of(extent.least), format::FORCE.of(extent.force)) {
                @let y = place(0.0, kn * format::FORCE.size())[1];
                line.zero[kn == 0.0] x1=(left) x2=(left + width) y1=(format!("{y:.1}")) y2=(format!("{y:.1}")) {}
                text x=(left - 6.0) y=(format!("{:.1}", y + 4.0)) text-anchor="end" { (format::plain(kn, 3)) }
            }
            @for milli in marks(step_x, 0.0, extent.across / across.unit()) {
                @let x = place(milli * across.unit(), 0.0)[0];
                line x1=(format!("{x:.1}")) x2=(format!("{x:.1}")) y1=(top) y2=(top + height) {}
                text x=(format!("{x:.1}")) y=(top + height + 15.0) text-anchor="middle" { (format::plain(milli, 3)) }
            }
            text x=(left + width) y=(PANEL[1] - 3.0) text-anchor="end" { (across.label()) }
            text x=(left - 6.0) y=(PANEL[1] - 3.0) text-anchor="end" { (format::FORCE.bracketed()) }
        }
        @if let Some(elastic) = elastic {
            path class="line dashed" style="--c:var(--ink-2)" d=(path(elastic, false)) {}
        }
        path class="line" style="--c:var(--c0)" d=(path(law, true)) {}
    }
}

/// The loops of all laws as one picture for documents: light or dark as the reader's system, nothing loaded.
#[must_use]
pub fn loops_svg(collisions: &Collisions) -> String {
    const COLUMNS: usize = 3;
    const HEADING: f64 = 42.0;
    let laws: Vec<&CollidedLaw> = collisions
        .laws
        .iter()
        .filter(|law| law.collision.curve.len() > 1)
        .collect();
    let common = common_extent(&collisions.laws, Across::Indentation);
    let rows = laws.len().div_ceil(COLUMNS);
    let (width, height) = (
        COLUMNS as f64 * PANEL[0],
        rows as f64 * (PANEL[1] + HEADING),
    );
    let picture = html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox={ "0 0 " (width) " " (height) } font-family="system-ui, sans-serif" font-size="11.5" {
            title { (message::force_over_indentation_under_every()) }
            style { (PreEscaped(PICTURE_STYLE)) }
            rect.paper width=(width) height=(height) {}
            @for (i, law) in laws.iter().enumerate() {
                @let extent = fitting(extent(law, Across::Indentation), common);
                g transform={ "translate(" ((i % COLUMNS) as f64 * PANEL[0]) " " ((i / COLUMNS) as f64 * (PANEL[1] + HEADING) + HEADING) ")" } {
                    text.name x=(MARGIN[0]) y="-20" { (law.law.kind.full_name()) }
                    text x=(MARGIN[0]) y="-6" {
                        (message::realised_e_is(format::fixed(law.collision.realised_restitution(), 3))) @if extent.across != common.across { (message::and_own_axes()) }
                    }
                    (panel(law, elastic(&collisions.laws, law), Across::Indentation, extent))
                }
            }
        }
    };
    picture.into_string() + "\n"
}

const PICTURE_STYLE: &str = "\
svg{--paper:#fff;--rule:#d9dde3;--ink:#1a1d21;--ink-2:#59616b;--c0:#0072b2}
@media(prefers-color-scheme:dark){svg{--paper:#15181c;--rule:#343a43;--ink:#e9ebee;--ink-2:#a3abb6;--c0:#56b4e9}}
.paper{fill:var(--paper)}text{fill:var(--ink-2)}.name{fill:var(--ink);font-weight:650;font-size:13px}
.grid line{stroke:var(--rule)}.grid .zero{stroke:var(--ink-2)}.line{fill:none;stroke:var(--c);stroke-width:1.6;stroke-linejoin:round}.line.dashed{stroke-dasharray:5 3;stroke-width:1.1}";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round() {
        for (greatest, expected) in [(10.0, 5.0), (7.4, 2.0), (0.9, 0.5), (1300.0, 500.0)] {
            assert_eq!(tick(greatest), expected, "up to {greatest}");
        }
    }
}
