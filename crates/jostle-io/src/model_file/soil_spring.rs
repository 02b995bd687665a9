//! `[[building.soil_spring]]`: soil beside floors below ground, as links between them and the base.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Pinching, SpringFault};
use jostle::model::LEVEL_TOLERANCE;
use jostle::{FloorPairs, Level, Link, LinkLaw};

use super::damper::Damper;
use super::hinges::read_spring;
use super::link::MOST_LINKS;
use super::places::range;
use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Unloads and reloads on one line, so that plastic deformation leaves a gap.
const LEAVES_A_GAP: Pinching = Pinching {
    deformation: 1.0,
    force: 1.0,
    unloading_exponent: 0.0,
    ductility_damage: 0.0,
    energy_damage: 0.0,
};

/// Reads the soil springs of a building, whose index is given.
pub(super) fn read_all(reader: &mut Reader<'_>, building: &Field<'_>, index: usize) -> Vec<Damper> {
    let Some(view) = reader.reopen(building, &[Section::Building]) else {
        return Vec::new();
    };
    let Some(field) = reader.get(&view, "soil_spring") else {
        return Vec::new();
    };
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        *reader.bad(&field, format!("expected a list of tables, found {found}")) = Some(
            "write [[building.soil_spring]] with double brackets; in JSON \"soil_spring\": [{ … }]"
                .into(),
        );
        return Vec::new();
    };
    let kind = reader.get(&view, "kind");
    let in_space = kind.is_some_and(|kind| kind.as_text() == Some("space-frame"));
    for (key, what) in [
        ("plan", "a building with a plan"),
        ("isolation", "an isolated building"),
        ("foundation", "a building whose foundation moves"),
        ("base", "a building whose base moves"),
    ] {
        if view.has(key) || (in_space && key == "plan") {
            *reader.bad(
                &field,
                format!("is not possible under {what}: it joins floors and the base"),
            ) = Some(
                "write [[link]] between a [[wall]] and the floors, which moves with the ground"
                    .into(),
            );
            break;
        }
    }
    let all = entries
        .iter()
        .filter_map(|entry| read(reader, entry, index));
    all.flatten().collect()
}

fn read(reader: &mut Reader<'_>, field: &Field<'_>, index: usize) -> Option<Vec<Damper>> {
    let view = reader.open(field, &[Section::SoilSpring])?;
    let floors = match view.has("floors") {
        true => range(reader, &view, "floors", MOST_LINKS),
        false => {
            reader.missing(&view, "floors", "add floors = [1, 2], the first and the last floor that soil holds, counted from the foundation");
            None
        }
    };
    let stiffness = match reader.get(&view, "stiffness") {
        Some(field) => reader.positive(&field, Dimension::Stiffness),
        None => {
            reader.missing(
                &view,
                "stiffness",
                "add stiffness = \"200 MN/m\", that of the soil on one side of one floor",
            );
            None
        }
    };
    let gapping = match reader.get(&view, "gapping") {
        Some(field) => reader.flag(&field),
        None => Some(false),
    };
    let dashpot = match reader.get(&view, "dashpot") {
        Some(field) => reader.positive(&field, Dimension::Damping),
        None => Some(0.0),
    };
    let law = law(reader, &view, stiffness, gapping == Some(true));
    let ([first, last], stiffness) = (floors?, stiffness?);
    let (gapping, dashpot, law) = (gapping?, dashpot?, law?);
    let link = |law: LinkLaw, stiffness: f64, damping: f64| Damper {
        link: Link {
            between: [Some(index); 2],
            floors: FloorPairs::Listed(
                (first..=last)
                    .map(|floor| [Level::Floor(0), Level::Floor(floor)])
                    .collect(),
            ),
            level_tolerance: LEVEL_TOLERANCE,
            stiffness,
            damping,
            law,
            at: None,
        },
        path: field.path.clone(),
        is_single: true,
    };
    let Some(law) = law else {
        return Some(vec![link(LinkLaw::Linear, stiffness, dashpot)]);
    };
    // Soil on the other side is pressed when the floor moves the other way.
    let other = gapping.then(|| law.mirrored());
    let springs = [law].into_iter().chain(other);
    let springs = springs.map(|law| link(LinkLaw::Yielding(law), 0.0, 0.0));
    let dashpot = (dashpot > 0.0).then(|| link(LinkLaw::Linear, 0.0, dashpot));
    Some(springs.chain(dashpot).collect())
}

/// Law of the soil on one side, or of both without gaps; nothing inside for a linear spring, `None` after a fault.
fn law(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    stiffness: Option<f64>,
    gapping: bool,
) -> Option<Option<Hysteresis>> {
    let strength = match reader.get(view, "strength") {
        Some(field) => Some((reader.positive(&field, Dimension::Force)?, field)),
        None => None,
    };
    let post_yield = match reader.get(view, "post_yield") {
        Some(field) => {
            let share = reader.quantity(&field, Dimension::Dimensionless)?;
            if !(0.0..1.0).contains(&share) {
                reader.bad(
                    &field,
                    format!("must be at least 0 and less than 1, found {share}"),
                );
                return None;
            }
            if strength.is_none() {
                *reader.bad(&field, "has no meaning without strength") =
                    Some("add strength, or remove post_yield".into());
                return None;
            }
            share
        }
        None => 0.0,
    };
    let hinge = reader.get(view, "hinge");
    let one_sided = |hysteresis: Hysteresis| match gapping {
        true => hysteresis.in_compression(),
        false => Ok(hysteresis),
    };
    let rule = match gapping {
        true => HysteresisRule::Pinched(LEAVES_A_GAP),
        false => HysteresisRule::Bilinear,
    };
    match (strength, hinge) {
        (Some((_, field)), Some(_)) => {
            *reader.bad(&field, "and hinge are both given") =
                Some("leave out one of them: hinge states all corners".into());
            None
        }
        (Some((strength, field)), None) => {
            let corners = Corners::bilinear(strength, post_yield);
            let hysteresis = Backbone::from_forces(stiffness?, corners, corners)
                .and_then(|backbone| Hysteresis::new(rule, backbone));
            let hysteresis = hysteresis.map_err(|faults| faults.into_iter().next());
            let sided = hysteresis.and_then(|sided| one_sided(sided).map_err(Some));
            match sided {
                Ok(sided) => Some(Some(sided)),
                Err(fault) => {
                    let problem =
                        fault.map_or_else(String::new, |fault: SpringFault| fault.problem);
                    reader.bad(&field, problem);
                    None
                }
            }
        }
        (None, Some(field)) => {
            let sections = &[Section::LinkHinge];
            let spring = read_spring(reader, &field, sections, stiffness, Dimension::Force)?;
            match one_sided(spring) {
                Ok(sided) => Some(Some(sided)),
                Err(fault) => {
                    *reader.bad(&field, fault.problem) =
                        Some("set rule = \"pinched\" with pinching, or leave gapping out".into());
                    None
                }
            }
        }
        (None, None) => match gapping {
            false => Some(None),
            // Elastic soil on both sides that cannot pull.
            true => Some(Hysteresis::without_tension(stiffness?).ok()),
        },
    }
}
