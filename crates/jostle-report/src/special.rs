//! Special features of a building: base springs, gravity, shear deformation, joints, reinforcement.

use jostle::hysteresis::Side;
use jostle::model::{Base, Building, Joint, Structure};
use jostle_section::formula::Member;
use jostle_section::{Section, bar_size};

use crate::facts::{Facts, by_place};
use crate::message;
use crate::{Page, ReinforcedSection, format};

/// One entry for each special feature.
pub(crate) fn facts(building: &Building) -> Facts {
    let mut facts = base(&building.base);
    let gravity = match (building.gravity.preload, building.gravity.p_delta) {
        (true, true) => Some(message::starts_from_the_displacements_under()),
        (true, false) => Some(message::starts_bent_under_its_weight()),
        (false, true) => Some(message::p_delta_of_every_column()),
        (false, false) => None,
    };
    facts.extend(gravity.map(|text| (message::gravity(), text.to_owned())));
    if let Structure::Frame(frame) = &building.structure {
        let storeys = frame.storey_heights.len();
        let of = |section: &jostle::Section| section.shear_rigidity.unwrap_or(f64::INFINITY);
        let text = |value: f64| match value.is_finite() {
            true => format::force(value),
            false => message::rigid().into(),
        };
        let shears = |section: &jostle::Section| section.shear_rigidity.is_some();
        if frame.all_columns().any(|(_, section)| shears(section)) {
            let row = |storey: usize| {
                let all = (0..frame.lines()).map(|line| frame.column(storey, line).map(of));
                all.collect()
            };
            facts.push((message::columns_ga(), by_place(storeys, row, text)));
        }
        if frame.all_beams().any(|(_, section)| shears(section)) {
            let row = |floor: usize| {
                let all = (0..frame.spans.len()).map(|bay| frame.beam(floor, bay).map(of));
                all.collect()
            };
            facts.push((message::beams_ga(), by_place(storeys, row, text)));
        }
    }
    facts
}

fn base(base: &Base) -> Facts {
    if base.is_fixed() {
        return Vec::new();
    }
    if let Some(isolation) = &base.isolation {
        return vec![
            (message::bearings(), isolation.isolator.name().to_owned()),
            (message::mat(), format::tonnes(isolation.mat_mass)),
        ];
    }
    if let Some(foundation) = &base.foundation {
        let metres = |value: f64| format::plain(format::HEIGHT.of(value), 3);
        let unit = format::HEIGHT.name();
        let depth = match foundation.embedment > 0.0 {
            true => message::m_deep(metres(foundation.embedment)),
            false => String::new(),
        };
        let lifts = foundation
            .uplift
            .map(|uplift| message::lifts_off(uplift.springs));
        let lifts = lifts.unwrap_or_default();
        return vec![
            (
                message::size_of_the_foundation(),
                format!(
                    "{} {unit} × {} {unit}{depth}{lifts}",
                    metres(foundation.length),
                    metres(foundation.width)
                ),
            ),
            (
                message::mass_of_the_foundation(),
                format::tonnes(foundation.mass),
            ),
        ];
    }
    let lifts = match base.uplift {
        true => message::vertical_springs_lift_off(),
        false => "",
    };
    // The vertical one is the last.
    let on_springs = springs(&[
        (message::rotation(), base.rotational_stiffness, "N·m/rad"),
        (message::sideways(), base.horizontal_stiffness, "N/m"),
        (message::torsion(), base.torsional_stiffness, "N·m/rad"),
        (message::vertical(), base.vertical_stiffness, "N/m"),
    ]);
    let mut facts: Facts = vec![(message::base(), on_springs + lifts)];
    for (name, hinge, unit) in [
        (message::base_rocks(), base.rotational_hinge, format::MOMENT),
        (message::base_slides(), base.horizontal_hinge, format::FORCE),
    ] {
        if let Some(hinge) = hinge {
            let yielding = hinge.backbone().side(Side::Positive).yielding.force;
            let value = format::unit(format::plain(unit.of(yielding), 4), unit.name());
            facts.push((
                name,
                message::name_yields_at_value(hinge.rule().name(), &value),
            ));
        }
    }
    let dashpots = springs(&[
        (
            message::rotation(),
            positive(base.rotational_damping),
            "N·m·s/rad",
        ),
        (
            message::sideways(),
            positive(base.horizontal_damping),
            "N·s/m",
        ),
        (
            message::torsion(),
            positive(base.torsional_damping),
            "N·m·s/rad",
        ),
        (
            message::vertical(),
            positive(base.vertical_damping),
            "N·s/m",
        ),
    ]);
    if !dashpots.is_empty() {
        facts.push((message::base_dashpots(), dashpots));
    }
    if let Some(across) = base.across {
        let parts = springs(&[
            (message::rotation(), across.rotational_stiffness, "N·m/rad"),
            (message::sideways(), across.horizontal_stiffness, "N/m"),
            (
                message::rotation(),
                positive(across.rotational_damping),
                "N·m·s/rad",
            ),
            (
                message::sideways(),
                positive(across.horizontal_damping),
                "N·s/m",
            ),
        ]);
        facts.push((message::base_across(), parts));
    }
    if base.mass > 0.0 {
        facts.push((message::footing_mass(), format::tonnes(base.mass)));
    }
    facts
}

fn positive(value: f64) -> Option<f64> {
    (value > 0.0).then_some(value)
}

/// "rotation 2 × 10⁸ N·m/rad, sideways …" of flexible directions.
fn springs(parts: &[(&str, Option<f64>, &str)]) -> String {
    let known = parts.iter().filter_map(|(name, value, unit)| {
        let (factor, unit) = format::factor_of(unit);
        let value = format::plain((*value)? * factor, 3);
        Some(format!("{name} {value}\u{a0}{unit}"))
    });
    known.collect::<Vec<_>>().join(", ")
}

/// How beams are joined to columns.
pub(crate) fn joint(joint: &Joint) -> String {
    if *joint == Joint::default() {
        return message::rigid().into();
    }
    springs(&[
        (message::rotation(), joint.rotational_stiffness, "N·m/rad"),
        (message::sideways(), joint.horizontal_stiffness, "N/m"),
        (message::vertical(), joint.vertical_stiffness, "N/m"),
    ])
}

/// The reinforced sections of a building.
pub(crate) fn sections(page: &Page, building: usize) -> Facts {
    let sections = page.sections.iter().filter(|s| s.building == building);
    sections
        .map(|known| {
            let name = match known.member {
                Member::Column => message::column_section(),
                Member::Beam => message::beam_section(),
            };
            (name, section(known))
        })
        .collect()
}

fn section(known: &ReinforcedSection) -> String {
    let section = known.section;
    let floors = match known.floors {
        [low, high] if low == high => format!("{low}: "),
        [low, high] => format!("{low}–{high}: "),
    };
    let size = |metres: f64| format::plain(format::LENGTH.of(metres), 4);
    let mut text = message::section_on_floors(
        &floors,
        size(section.width),
        size(section.depth),
        bars(section),
        format::fixed(section.steel_area() / section.area() * 100.0, 2),
        format::plain(format::STRESS.of(section.concrete.strength), 3),
        format::plain(format::STRESS.of(section.steel.yield_strength), 3),
    );
    if let Some(ties) = &section.ties {
        text.push_str(&message::ties_d_at_mm_legs(
            bar_size(ties.diameter),
            size(ties.spacing),
            ties.legs,
        ));
    }
    if known.member == Member::Column {
        let [low, high] = known.compression.map(format::force);
        let range = if low == high {
            low
        } else {
            message::low_to_high(&low, &high)
        };
        text.push_str(&message::axial_compression(&range));
    }
    text
}

/// "12 d22", or "4 d22 + 2 d20 top, 3 d22 bottom" where top and bottom differ.
fn bars(section: &Section) -> String {
    if section.is_symmetric() {
        return counted(section, |_| true);
    }
    let middle = 0.5 * section.depth;
    let (top, bottom) = (
        counted(section, |depth| depth < middle),
        counted(section, |depth| depth >= middle),
    );
    message::top_bottom(&top, &bottom)
}

/// Bars at the depths asked for, by diameter.
fn counted(section: &Section, wanted: impl Fn(f64) -> bool) -> String {
    let mut sizes: Vec<(f64, usize)> = Vec::new();
    for bar in section.bars.iter().filter(|bar| wanted(bar.depth)) {
        match sizes.iter_mut().find(|(size, _)| *size == bar.diameter) {
            Some((_, count)) => *count += 1,
            None => sizes.push((bar.diameter, 1)),
        }
    }
    let texts: Vec<String> = sizes
        .iter()
        .map(|(size, count)| format!("{count}\u{a0}{}", bar_size(*size)))
        .collect();
    texts.join(" + ")
}

#[cfg(test)]
mod tests {
    use jostle::{Damping, Shear};
    use jostle_section::{Concrete, Reinforcement, Steel, StrengthLevel};

    use super::*;

    #[test]
    fn plain_buildings_have_nothing_special() {
        let mut building = Building {
            name: "A".into(),
            structure: Structure::Shear(Shear {
                mass: vec![1e4],
                stiffness: vec![1e7],
                storey_heights: vec![3.0],
            }),
            damping: Damping::Rayleigh {
                alpha: 0.0,
                beta: 0.0,
            },
            ..Building::default()
        };
        assert!(facts(&building).is_empty());
        building.base.horizontal_stiffness = Some(5e8);
        building.base.mass = 3e3;
        building.gravity.p_delta = true;
        let names: Vec<&str> = facts(&building).iter().map(|fact| fact.0).collect();
        assert_eq!(names, ["base", "footing mass", "gravity"]);
        assert_eq!(
            joint(&Joint {
                horizontal_stiffness: Some(2e8),
                ..Joint::default()
            }),
            "sideways 2\u{202f}×\u{202f}10⁸\u{a0}N/m"
        );
    }

    #[test]
    fn sections_say_their_bars_and_loads() {
        let level = StrengthLevel::default();
        let lay = |width: f64, bars: &str| {
            Section::new(
                width,
                0.5,
                Concrete::grade("C30", level).expect("known"),
                Steel::grade("HRB400", level).expect("known"),
                &Reinforcement::parse(bars).expect("bars"),
                0.035,
                None,
            )
            .expect("fits")
        };
        let beam = lay(0.3, "4 d22 top, 3 d20 bottom");
        assert_eq!(
            bars(&beam).replace('\u{a0}', " "),
            "4 d22 top, 3 d20 bottom"
        );
        let column = lay(0.5, "12 d22");
        let mut known = ReinforcedSection {
            building: 0,
            member: Member::Column,
            section: &column,
            members: vec!["column.1.1"],
            floors: [1, 1],
            compression: [9e5; 2],
        };
        known.add("column.1.5", 5, 1e5);
        let text = section(&known).replace('\u{a0}', " ");
        assert_eq!(
            text,
            "1–5: 500 × 500 mm, 12 d22 (1.82 %), concrete 20.1 MPa, steel 400 MPa, axial compression 100.0 kN to 900.0 kN"
        );
    }
}
