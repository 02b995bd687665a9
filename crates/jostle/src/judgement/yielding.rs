//! A9, A10, B3, B4 and B5: what yields, and what would.

use super::{Known, Tally, quoted};
use crate::hysteresis::Hysteresis;
use crate::interface::PlanPart;
use crate::linear::sort_by;
use crate::model::{
    Building, Diagonal, DiagonalKind, FramePlace, Hinges, PlanColumn, STANDARD_GRAVITY, Structure,
    capacity_rule_title,
};
use crate::results::summary::{BuildingSummary, ContactSummary, MemberSummary, RatioSummary};
use crate::structure::{MemberPlace, SpringPlace};

/// Drift at which storeys of concrete frames yield: θ_y = 0.5 ε_y L_b/h_b with ε_y = 0.2 % and L_b/h_b = 10 \[–\].
const YIELD_DRIFT: f64 = 0.01;

/// Whether storeys or members of a building can yield, not its base alone.
#[must_use]
pub fn structure_yields(building: &Building) -> bool {
    let yields = |diagonal: &Diagonal| {
        diagonal.place.kind == DiagonalKind::Brace && diagonal.hysteresis.is_some()
    };
    match &building.structure {
        _ if building.hinges.is_some() => true,
        Structure::Tiers(tiers) => tiers.may_yield(),
        Structure::Frame(frame) => frame.diagonals.iter().any(yields) || frame.walls_yield(),
        Structure::Shear(_) | Structure::Given(_) => false,
    }
}

/// 1 for a building that yields without P-Delta, 0 for others.
pub(super) fn without_p_delta(known: &Known<'_>, tally: &mut Tally<'_>) {
    for building in &known.model.buildings {
        if !structure_yields(building) || building.gravity.p_delta {
            continue;
        }
        tally.add(1.0, || {
            let text = format!(
                "{} yields without P-Delta: drifts after yield are underestimated",
                quoted(&building.name)
            );
            (building.name.clone(), text)
        });
    }
}

/// Factor on EI of members whose hinges crack as well.
pub(super) fn cracking_twice(known: &Known<'_>, tally: &mut Tally<'_>) {
    for (index, building) in known.model.buildings.iter().enumerate() {
        let stated = known.stated(index);
        let Some(Hinges::Frame(hinges)) = &building.hinges else {
            continue;
        };
        if stated.hinges_from_sections {
            continue;
        }
        let members = [("columns", &hinges.columns), ("beams", &hinges.beams)];
        for ((name, rows), factor) in members.into_iter().zip(stated.stiffness_factor) {
            if !rows.iter().flatten().any(Hysteresis::cracks) {
                continue;
            }
            tally.add(factor, || {
                let text = format!(
                    "{}: cracking of the {name} is counted twice: stiffness_factor reduces their EI to {factor} of that of the full section, and their hinges soften again at the cracking moment",
                    quoted(&building.name)
                );
                (format!("{}, {name}", building.name), text)
            });
        }
    }
}

/// Greatest ductility of the hinges or storeys of a building.
pub(super) fn ductility(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for building in &summary.buildings {
        let Some(ductility) = building.response.ductility else {
            continue;
        };
        tally.add(ductility, || {
            let text = format!(
                "{}: ductility reaches {ductility:.1}",
                quoted(&building.name)
            );
            (building.name.clone(), text)
        });
    }
}

/// Rotation of members over the last of the accepted ones.
pub(super) fn rotation(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for member in summary
        .buildings
        .iter()
        .flat_map(|building| &building.members)
    {
        for acceptance in &member.acceptance {
            let Some(last) = acceptance.limits.last() else {
                continue;
            };
            tally.add(acceptance.rotation_rad / last.rotation_rad, || {
                let text = format!(
                    "{}: a {}rotation of {:.1} mrad exceeds the {:.1} mrad of {} ({})",
                    member.name,
                    match acceptance.measure {
                        "plastic" => "plastic ",
                        _ => "",
                    },
                    1e3 * acceptance.rotation_rad,
                    1e3 * last.rotation_rad,
                    last.level,
                    capacity_rule_title(acceptance.rule)
                );
                (member.name.clone(), text)
            });
        }
    }
}

/// Greatest shear over its capacity of columns that are struck between floors, during an impact.
pub(super) fn struck_columns(known: &Known<'_>, tally: &mut Tally<'_>) {
    for (_, member, ratio) in struck(known) {
        let (Some(times), Some(place)) = (ratio.shear, &ratio.shear_at) else {
            continue;
        };
        if place.impact.is_none() {
            continue;
        }
        tally.add(times, || {
            let text = format!(
                "the shear in {} at an impact is {times:.1} times its capacity ({})",
                member.name,
                capacity_rule_title(ratio.rule)
            );
            (member.name.clone(), text)
        });
    }
}

/// Greatest moment over its capacity at struck points of columns that have no hinge there.
pub(super) fn struck_bending(known: &Known<'_>, tally: &mut Tally<'_>) {
    let hinged = |building: &BuildingSummary, of: &MemberSummary| {
        let place = (of.frame.map(|frame| frame + 1), of.place);
        let mut hinges = building.hinges.list.iter();
        hinges.any(|hinge| match hinge.at {
            Some(SpringPlace::Struck { frame, member, .. }) => (frame, Some(member)) == place,
            _ => false,
        })
    };
    for (building, member, ratio) in struck(known) {
        let (times, place) = (ratio.bending, &ratio.bending_at);
        if !matches!(place.at, "below" | "above") || hinged(building, member) {
            continue;
        }
        tally.add(times, || {
            let text = format!(
                "the moment in {} at the point of impact is {times:.1} times its capacity ({}), but the column is elastic there",
                member.name, capacity_rule_title(ratio.rule)
            );
            (member.name.clone(), text)
        });
    }
}

/// Columns that are struck between floors and not compared with their capacity: 1 where nobody asked, 2 where it is not known.
pub(super) fn struck_unrated(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for (gap, model) in summary.gaps.iter().zip(&known.model.gaps) {
        let sides = known.model.buildings_beside(model.between);
        let contacts = gap
            .contacts
            .iter()
            .filter(|contact| contact.impact_count > 0);
        // Of columns alike the one that is hit hardest.
        let mut contacts: Vec<_> = contacts.collect();
        sort_by(&mut contacts, |a, b| {
            b.peak_force_n.total_cmp(&a.peak_force_n)
        });
        for (contact, side) in contacts
            .into_iter()
            .flat_map(|contact| [(contact, 0), (contact, 1)])
        {
            let Some(index) = sides[side].filter(|_| contact.floors[side].is_none()) else {
                continue;
            };
            let building = &summary.buildings[index];
            let column = struck_column(&known.model.buildings[index], contact, side);
            let name = column.map(|column| format!("{}.{column}", building.name));
            let mut members = building.members.iter();
            let member = members.find(|member| name.as_ref() == Some(&member.name));
            let rated = member.is_some_and(|member| member.ratio.is_some());
            if rated || building.shear_failures.is_some() {
                continue;
            }
            let asked = f64::from(u8::from(member.is_some()));
            tally.add(1.0 + asked, || {
                let name = name.unwrap_or_else(|| format!("a column of {}", quoted(&building.name)));
                let text = format!(
                    "{name} is hit between floors, at {:.3} m, with up to {:.1} kN, and is not compared with its capacity",
                    contact.height_m,
                    1e-3 * contact.peak_force_n
                );
                (name, text)
            });
        }
    }
}

/// Name within its building of the column that a contact between floors strikes. `side`: that of the building.
fn struck_column(model: &Building, contact: &ContactSummary, side: usize) -> Option<String> {
    let height = contact.height_m - model.base.elevation;
    let storey = model
        .floor_heights()
        .iter()
        .filter(|floor| **floor < height)
        .count();
    if let Some(in_plan) = &contact.in_plan {
        let PlanPart::Column(line) = in_plan.parts[side] else {
            return None;
        };
        let Structure::Tiers(tiers) = &model.structure else {
            return None;
        };
        let frames = tiers.frames.iter().map(|frame| frame.name.clone());
        return Some(PlanColumn { line, storey }.name(&frames.collect::<Vec<_>>()));
    }
    let Structure::Frame(frame) = &model.structure else {
        return None;
    };
    // What stands left of a gap is struck on its right face.
    let line = frame.outer_lines(storey + 1)?[1 - side] + 1;
    let storey = storey + 1;
    Some(MemberPlace::Column { line, storey }.to_string())
}

/// Columns that were struck between floors, and what they bear; not those that fail in this model, which bear no more than they can.
fn struck<'a>(
    known: &Known<'a>,
) -> impl Iterator<Item = (&'a BuildingSummary, &'a MemberSummary, &'a RatioSummary)> {
    let buildings = known
        .results
        .iter()
        .flat_map(|(summary, _)| &summary.buildings);
    let lasting = buildings.filter(|building| building.shear_failures.is_none());
    lasting
        .flat_map(|lasting| lasting.members.iter().map(move |member| (lasting, member)))
        .filter_map(|(building, member)| {
            let is_struck = member.struck.iter().any(|point| point.impact_count > 0);
            let ratio = member.ratio.as_ref().filter(|_| is_struck)?;
            Some((building, member, ratio))
        })
}

/// Elastic buildings that are not isolated, whatever their panels do: drift over that at yield, base shear over weight, name, and
/// how elastic it is in words.
fn elastic(known: &Known<'_>, mut add: impl FnMut(f64, f64, &str, &str)) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for (model, building) in known.model.buildings.iter().zip(&summary.buildings) {
        if structure_yields(model) || model.base.isolation.is_some() || building.mass_kg <= 0.0 {
            continue;
        }
        let across = building
            .in_plan
            .map_or(0.0, |plan| plan.base_shear_across_peak_n);
        let shear = building.response.base_shear_peak_n.max(across);
        add(
            building.greatest_drift() / YIELD_DRIFT,
            shear / (STANDARD_GRAVITY * building.mass_kg),
            &building.name,
            match panels_yield(model) {
                true => "is elastic apart from its infill panels",
                false => "is elastic",
            },
        );
    }
}

/// Whether infill panels of a building yield.
fn panels_yield(building: &Building) -> bool {
    match &building.structure {
        Structure::Frame(frame) => frame.diagonals.iter().any(|diagonal| {
            diagonal.place.kind == DiagonalKind::Infill && diagonal.hysteresis.is_some()
        }),
        Structure::Tiers(_) | Structure::Shear(_) | Structure::Given(_) => false,
    }
}

/// Drift of elastic buildings over that at yield.
pub(super) fn elastic_drift(known: &Known<'_>, tally: &mut Tally<'_>) {
    elastic(known, |times, _, name, elastic| {
        tally.add(times, || {
            let text = format!(
                "{} {elastic}, but its drift of {:.1} % is {times:.1} times the yield drift of frames",
                quoted(name),
                100.0 * YIELD_DRIFT * times
            );
            (name.to_owned(), text)
        });
    });
}

/// Base shear of elastic buildings over their weight.
pub(super) fn elastic_shear(known: &Known<'_>, tally: &mut Tally<'_>) {
    elastic(known, |_, shear, name, elastic| {
        tally.add(shear, || {
            let text = format!(
                "{} {elastic}, but its base shear is {shear:.2} times its weight",
                quoted(name)
            );
            (name.to_owned(), text)
        });
    });
}

/// Greatest tension of columns over their greatest compression, where self weight is part of their forces.
pub(super) fn column_tension(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for (model, building) in known.model.buildings.iter().zip(&summary.buildings) {
        if !model.weight_is_in_axial_forces() {
            continue;
        }
        let columns = building
            .members
            .iter()
            .filter(|m| m.name.contains(".column."));
        for (column, end) in columns.flat_map(|m| m.ends.iter().map(move |end| (m, end))) {
            let (tension, compression) = (end.axial_max_n, -end.axial_min_n);
            tally.add(tension / compression.max(1.0), || {
                let text = format!(
                    "{}: a column has {:.1} kN of tension and up to {:.1} kN of compression",
                    column.name,
                    1e-3 * tension,
                    1e-3 * compression.max(0.0)
                );
                (column.name.clone(), text)
            });
        }
    }
}

/// Greatest change of the axial force of a column against the one for which its hinges were made, over A f_ck.
pub(super) fn hinge_axial_force(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for (index, model) in known.model.buildings.iter().enumerate() {
        let stated = known.stated(index);
        let (Structure::Frame(frame), Some(modulus), Some(strength), Some(building)) = (
            &model.structure,
            stated.modulus,
            stated.strength,
            summary.buildings.get(index),
        ) else {
            continue;
        };
        for member in &building.members {
            let Some(([storey, line], made_for)) =
                made_for(&member.name, &stated.hinge_compression)
            else {
                continue;
            };
            let Some(axial) = frame
                .column(storey, line)
                .and_then(|column| column.axial_rigidity)
            else {
                continue;
            };
            // Forces without self weight are changes.
            let contained = model.weight_is_in_axial_forces();
            let rest = if contained { made_for } else { 0.0 };
            for end in &member.ends {
                let [most, least] = [end.axial_max_n, end.axial_min_n].map(|force| force + rest);
                let change = if -least > most { least } else { most };
                let ratio = change.abs() * modulus / (axial * strength);
                tally.add(ratio, || {
                    let compression = 1e-3 * (made_for - change);
                    let becomes = match compression < 0.0 {
                        true => format!("it goes into tension, {:.1} kN", -compression),
                        false => format!("its compression changes to {compression:.1} kN"),
                    };
                    let text = format!(
                        "{}: {becomes}, but its hinges are computed for {:.1} kN of compression; ν changes by {ratio:.2}, and the strength with it",
                        member.name,
                        1e-3 * made_for
                    );
                    (member.name.clone(), text)
                });
            }
        }
    }
}

/// Storey and line from 0 of a column `NAME.column.LINE.STOREY`, and the compression for which its hinges were made \[N\].
fn made_for(name: &str, compressions: &[Vec<f64>]) -> Option<(FramePlace, f64)> {
    let (_, place) = name.rsplit_once(".column.")?;
    let (line, storey) = place.split_once('.')?;
    let [line, storey] = [line, storey].map(|number| number.parse::<usize>().ok()?.checked_sub(1));
    Some(([storey?, line?], *compressions.get(storey?)?.get(line?)?))
}
