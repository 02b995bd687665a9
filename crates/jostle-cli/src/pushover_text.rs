//! Capacity curves on a terminal.

use std::fmt::Write;
use std::path::Path;

use jostle::DiagonalKind;
use jostle::hysteresis::{Hysteresis, HysteresisRule, Stage};
use jostle::pushover::{Bilinear, PushEnd, PushEventKind, PushPoint, PushedBuilding, Pushover};
use jostle::structure::SpringPlace;

use jostle_io::shown::{FORCE, HEIGHT, LENGTH, Shown};
use jostle_run::{BOLD, DIM, LOUD, styled};
use jostle_run::{counted, kn, mm};

/// Points listed of every curve: the first ones, then the first at which hinges yield.
const FIRST: usize = 4;
const YIELDING: usize = 8;
/// Hinges named at most in a line.
const NAMED: usize = 2;

/// The curves as text; `page` is the file to open next.
pub(crate) fn describe(title: &str, pushed: &[PushedBuilding], page: Option<&Path>) -> String {
    let mut text = format!("{}\n", styled(BOLD, title));
    // Writing to a string cannot fail.
    for one in pushed {
        for curve in &one.curves {
            let _ = write_curve(&mut text, one, curve);
        }
    }
    if let Some(page) = page {
        let _ = writeln!(text, "\n→ {}", styled(BOLD, &page.display().to_string()));
    }
    text
}

fn write_curve(text: &mut String, one: &PushedBuilding, curve: &Pushover) -> std::fmt::Result {
    let settings = curve.settings;
    writeln!(
        text,
        "\n{}  pushed to the {}, {} load; {}, {}, {}",
        styled(BOLD, &one.building.name),
        settings.direction.name(),
        settings.pattern.name(),
        counted(one.building.floors.len(), "storey"),
        HEIGHT.text(curve.height, 1),
        FORCE.text(curve.weight, 0)
    )?;
    writeln!(
        text,
        "{}",
        styled(
            DIM,
            "                 base shear   of weight         roof     drift"
        )
    )?;
    let [force, length] = [FORCE, LENGTH].map(Shown::name);
    let mut row = |name: &str, point: Option<&PushPoint>| match point {
        Some(point) if point.roof == 0.0 => {
            writeln!(text, "  {name:<12}{:>15}   under gravity alone", "at rest")
        }
        Some(point) => writeln!(
            text,
            "  {name:<12}{:>12} {force}{:>12.4}{:>10} {length}{:>8.3} %",
            kn(point.base_shear),
            curve.coefficient(point),
            mm(point.roof),
            100.0 * curve.drift(point)
        ),
        None => writeln!(text, "  {name:<12}{:>12}", "none"),
    };
    let springs = one.building.equations.springs.len();
    let mut places = one.building.discretization.spring_places.iter();
    let has_fibres = places.any(|place| matches!(place, SpringPlace::Fibre { .. }));
    let mut laws = one.building.equations.springs.iter();
    let cracks = has_fibres || laws.any(|spring| spring.hysteresis.cracks());
    let yields = one.yielding_places() + one.links() > 0;
    if yields {
        if cracks {
            row("first crack", curve.first(Stage::Cracked))?;
        }
        row("first yield", curve.first(Stage::Yielded))?;
        row("greatest", Some(curve.peak()))?;
    }
    row("at the end", curve.points.last())?;
    if one.is_elastic() {
        return writeln!(
            text,
            "  The building has no hinges: it stays elastic, and the curve is a straight line."
        );
    }
    if let Some(two) = Bilinear::fit(&curve.points) {
        writeln!(
            text,
            "  bilinear of equal energy (FEMA 356): yields at {} and {}, then {:.1} % of the stiffness; ductility {:.2}",
            FORCE.text(two.yield_force, 1),
            LENGTH.text(two.yield_displacement, 1),
            100.0 * two.hardening(),
            two.ductility()
        )?;
    }
    let ended = match curve.end {
        PushEnd::Target => String::new(),
        other => format!(" {}", styled(LOUD, &format!("Ended early: {other}."))),
    };
    let places = one.building.discretization.spring_places.iter();
    let shear = places.filter(|place| place.is_shear()).count();
    let failures = match shear {
        0 => String::new(),
        _ => format!(
            " {} of {} fail in shear.",
            curve.failures(),
            counted(shear, "column end")
        ),
    };
    let links = match one.links() {
        0 => String::new(),
        links => format!(
            " {} of {} yield.",
            curve.links_yielded(springs),
            counted(links, "link")
        ),
    };
    writeln!(
        text,
        "  {}.{failures}{links}{ended}",
        damage(one, curve, [shear, springs])
    )?;
    write_events(text, one, curve)
}

/// How many hinges, braces and struts of panels crack, yield and buckle. Of all springs, `shear` can fail in shear.
fn damage(one: &PushedBuilding, curve: &Pushover, [shear, springs]: [usize; 2]) -> String {
    let (equations, discretization) = (&one.building.equations, &one.building.discretization);
    let stages = curve.stages(springs, curve.points.len());
    let laws = equations.springs.iter().map(|spring| &spring.hysteresis);
    let places = discretization.spring_places.iter();
    let all: Vec<_> = places.zip(laws).zip(&stages).collect();
    // Those of braces, of struts with a strength, or of everything else.
    let of_kind = |kind: Option<DiagonalKind>| {
        let has_strength = |law: &Hysteresis| !matches!(law.rule(), HysteresisRule::Stop { clearance, .. } if clearance == 0.0);
        all.iter().filter(move |((place, law), _)| {
            let own = match place {
                SpringPlace::Diagonal { place, .. } => Some(place.kind),
                _ => None,
            };
            own == kind && has_strength(law)
        })
    };
    let reached = |kind, least: Stage| {
        let reached = of_kind(kind).filter(|(_, stage)| **stage >= least);
        reached.count()
    };
    let (brace, strut) = (Some(DiagonalKind::Brace), Some(DiagonalKind::Infill));
    let [braces, struts] = [brace, strut].map(|kind| of_kind(kind).count());
    let hinges = one.yielding_places() - shear - braces - struts;
    let mut said = Vec::new();
    if hinges > 0 {
        let has_fibres = all
            .iter()
            .any(|((place, _), _)| matches!(place, SpringPlace::Fibre { .. }));
        let name = match has_fibres {
            true => format!("{hinges} hinges and fibres"),
            false => counted(hinges, "hinge"),
        };
        let cracks = has_fibres || of_kind(None).any(|((_, law), _)| law.cracks());
        let [cracked, yielded] = [Stage::Cracked, Stage::Yielded].map(|stage| reached(None, stage));
        said.push(match cracks {
            true => format!("{cracked} of {name} crack, {yielded} yield"),
            false => format!("{yielded} of {name} yield"),
        });
    }
    if braces > 0 {
        let name = counted(braces, "brace");
        let [yielded, buckled] =
            [Stage::Yielded, Stage::Buckled].map(|stage| reached(brace, stage));
        let buckle =
            of_kind(brace).any(|((_, law), _)| matches!(law.rule(), HysteresisRule::Buckling(_)));
        said.push(match buckle {
            true => format!("{buckled} of {name} buckle, {} yield", yielded - buckled),
            false => format!("{yielded} of {name} yield"),
        });
    }
    if struts > 0 {
        let name = counted(struts, "infill strut");
        let [cracked, crushed] =
            [Stage::Cracked, Stage::Yielded].map(|stage| reached(strut, stage));
        said.push(format!(
            "{cracked} of {name} crack, {crushed} reach their strength"
        ));
    }
    match said.is_empty() {
        true => "Nothing in it cracks or yields: its infill struts have no strength".to_owned(),
        false => said.join("; "),
    }
}

fn write_events(text: &mut String, one: &PushedBuilding, curve: &Pushover) -> std::fmt::Result {
    let eventful: Vec<&PushPoint> = curve
        .points
        .iter()
        .filter(|point| !point.events.is_empty())
        .collect();
    let yields = |point: &PushPoint| {
        let mut kinds = point.events.iter().map(|event| event.kind);
        kinds.any(|kind| kind.is_yield() || kind == PushEventKind::Fails)
    };
    let mut yielding = 0;
    let listed = eventful.iter().enumerate().filter(|(index, point)| {
        yielding += usize::from(yields(point));
        *index < FIRST || (yields(point) && yielding <= YIELDING)
    });
    let listed: Vec<&PushPoint> = listed.map(|(_, point)| *point).collect();
    for point in &listed {
        let mut said = Vec::new();
        let mut kinds: Vec<&str> = point.events.iter().map(|event| event.kind.name()).collect();
        kinds.dedup();
        for kind in kinds {
            let places: Vec<String> = point
                .events
                .iter()
                .filter(|event| event.kind.name() == kind)
                .map(|event| one.place(event.spring))
                .collect();
            let named: Vec<&str> = places.iter().take(NAMED).map(String::as_str).collect();
            let more = match places.len() - named.len() {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            said.push(format!("{kind:<7} {}{more}", named.join(" · ")));
        }
        writeln!(
            text,
            "    {:>7.3} %{:>10.4}   {}",
            100.0 * curve.drift(point),
            curve.coefficient(point),
            said.join(" | ")
        )?;
    }
    match eventful.len() - listed.len() {
        0 => Ok(()),
        more => writeln!(
            text,
            "    {}",
            styled(DIM, &format!("and {more} more points in pushover.csv"))
        ),
    }
}
