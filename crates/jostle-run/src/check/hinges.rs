//! What `jostle check` says of hinges.

use std::fmt::Write as _;

use crate::numbers::counted;
use jostle::hysteresis::{Hysteresis, HysteresisRule, Side};
use jostle::model::{Hinges, PlanAxis, PlanSpring, Tiers};
use jostle::{ColumnFibres, ShearSpring, SpaceFrame, SpaceMember, SpacePlace};
use jostle_io::shown::{FORCE, HEIGHT, MOMENT, Shown};

pub(super) fn describe_hinges(text: &mut String, hinges: &Hinges) -> std::fmt::Result {
    match hinges {
        Hinges::Frame(hinges) => {
            if let Some(([storey, line], first)) = hinges.fibres.first_key_value() {
                let first_of = format!("column {} of storey {}", line + 1, storey + 1);
                let all = hinges.fibres.values();
                writeln!(text, "  {}", fibres(all, &first_of, first))?;
            }
            for (name, rows) in [("columns", &hinges.columns), ("beams", &hinges.beams)] {
                let springs: Vec<&Hysteresis> = rows.iter().flatten().collect();
                let sides = [(Side::Positive, " +"), (Side::Negative, " −")];
                let differ = springs
                    .iter()
                    .any(|spring| spring.backbone().mirrored() != *spring.backbone());
                for (side, sign) in sides {
                    if springs.is_empty() || (side == Side::Negative && !differ) {
                        continue;
                    }
                    let sign = if differ { sign } else { "" };
                    let rule = springs[0].rule().name();
                    let forces = crack_and_yield(extents(&springs, side), MOMENT);
                    writeln!(text, "  hinges {rule}, {name}{sign}: {forces}")?;
                }
            }
            let shear = hinges.shear.iter().flatten();
            describe_shear(text, "columns", &shear.collect::<Vec<_>>())?;
        }
        Hinges::Storeys(springs) => {
            let springs: Vec<&Hysteresis> = springs.iter().collect();
            if let Some(first) = springs.first() {
                let forces = crack_and_yield(extents(&springs, Side::Positive), FORCE);
                writeln!(text, "  storeys {}: {forces}", first.rule().name())?;
            }
        }
    }
    Ok(())
}

/// Columns that fail in shear, and at which strengths.
fn describe_shear(text: &mut String, what: &str, all: &[&ShearSpring]) -> std::fmt::Result {
    let springs: Vec<&Hysteresis> = all.iter().map(|column| &column.spring).collect();
    if springs.is_empty() {
        return Ok(());
    }
    let [_, strength] = extents(&springs, Side::Positive);
    let (strength, force) = (range(strength, FORCE), FORCE.name());
    writeln!(text, "  {what} fail in shear at {strength} {force}")
}

/// Columns whose ends are made of fibres: how many, and how strong the first of them is.
fn fibres<'a>(
    all: impl Iterator<Item = &'a ColumnFibres>,
    first_of: &str,
    first: &ColumnFibres,
) -> String {
    let ends = |fibres: &ColumnFibres| fibres.at_ends.into_iter().filter(|stands| *stands).count();
    let count: usize = all.map(ends).sum();
    let surface = first.corners();
    if let [corners, ..] = &surface[..] {
        let largest = |least: [f64; 2], corner: &[f64; 2]| {
            if corner[1] > least[1] { *corner } else { least }
        };
        let greatest = surface.iter().map(|corners| {
            let [force, moment] = corners.iter().fold([0.0; 2], largest);
            let (moment, force) = (MOMENT.text(moment, 1), FORCE.text(-force, 0));
            format!("{moment} under {force}")
        });
        let greatest = match &greatest.collect::<Vec<_>>()[..] {
            [along, across] => format!("{along} along x and {across} along y"),
            all => all.concat(),
        };
        let ends = [corners.first(), corners.last()];
        let [compression, tension] = ends.map(|end| end.map_or(0.0, |end| end[0]));
        return format!(
            "surfaces of axial force and moment at {} of columns; {first_of}: {} over {}, {} of compression to {} of tension, up to {}",
            counted(count, "end"),
            counted(corners.len(), "corner"),
            HEIGHT.text(first.length, 3),
            FORCE.text(-compression, 0),
            FORCE.text(tension, 0),
            greatest,
        );
    }
    let ([concrete, steel], layers) =
        first
            .fibres
            .iter()
            .fold(([0.0; 2], 0), |(sums, layers), fibre| {
                let force = fibre.spring.backbone().side(Side::Negative).yielding.force;
                match fibre.spring.rule() {
                    HysteresisRule::Concrete(_) => ([sums[0] + force, sums[1]], layers + 1),
                    _ => ([sums[0], sums[1] + force], layers),
                }
            });
    let limits = first.limits.iter();
    let limits = limits.map(|(limit, strain)| format!("{} {:.2} ‰", limit.name(), 1e3 * strain));
    let limits = match limits.collect::<Vec<_>>() {
        none if none.is_empty() => String::new(),
        some => format!("; strains judged: {}", some.join(", ")),
    };
    format!(
        "fibres at {} of columns; {first_of}: {} over {}, {} of concrete and {} of bars{limits}",
        counted(count, "end"),
        counted(layers, "concrete fibre"),
        HEIGHT.text(first.length, 3),
        FORCE.text(concrete, 0),
        FORCE.text(steel, 0),
    )
}

/// What yields of a building in plan: frames, whole storeys, and every column or wall, by direction.
pub(super) fn describe_yielding_in_plan(text: &mut String, tiers: &Tiers) -> std::fmt::Result {
    for frame in tiers.frames.iter().filter(|frame| frame.may_yield()) {
        writeln!(text, "  frame {}:", frame.name)?;
        describe_hinges(text, &Hinges::Frame(frame.hinges.clone()))?;
    }
    if let Some(frame) = &tiers.space_frame {
        describe_space_hinges(text, frame)?;
    }
    let mut elements: Vec<Option<usize>> = tiers
        .yielding
        .iter()
        .map(|yielding| yielding.element)
        .collect();
    elements.sort_unstable();
    elements.dedup();
    for element in elements {
        for axis in PlanAxis::BOTH {
            let plan_springs: Vec<&PlanSpring> = tiers
                .yielding
                .iter()
                .filter(|yielding| yielding.element == element && yielding.axis == axis)
                .collect();
            let Some(first) = plan_springs.first() else {
                continue;
            };
            let springs: Vec<&Hysteresis> = plan_springs
                .iter()
                .map(|yielding| &yielding.hysteresis)
                .collect();
            let what = match element {
                None => "storeys".to_owned(),
                Some(index) => {
                    let [x, y] = first.at.map(|value| HEIGHT.number(value, 2));
                    let name = tiers.element_names.get(index).cloned().flatten();
                    let name = name.unwrap_or_else(|| format!("element {}", index + 1));
                    format!("{name} at ({x}, {y}) {}", HEIGHT.name())
                }
            };
            writeln!(
                text,
                "  {what}, {} by {}: {}",
                axis.name(),
                first.hysteresis.rule().name(),
                crack_and_yield(extents(&springs, Side::Positive), FORCE)
            )?;
        }
    }
    Ok(())
}

/// Fibres and hinges of a space frame: how many, and at which moments, of columns along x and across, and of beams.
fn describe_space_hinges(text: &mut String, frame: &SpaceFrame) -> std::fmt::Result {
    // Walls say theirs by themselves.
    let is_wall = |place: &SpacePlace| frame.walls.iter().any(|wall| wall.has(*place));
    let of_columns = frame.fibres.iter().filter(|(place, _)| !is_wall(place));
    if let Some((place, first)) = of_columns.clone().next() {
        let all = of_columns.map(|(_, own)| own);
        writeln!(text, "  {}", fibres(all, &place.to_string(), first))?;
    }
    let is_column = |member: &SpaceMember| matches!(member.place, SpacePlace::Column { .. });
    let sorts = [
        ("columns, x,", true, 0),
        ("columns, y,", true, 1),
        ("beams", false, 0),
    ];
    for (what, columns, plane) in sorts {
        let members = frame.members.iter();
        let members = members.filter(|member| is_column(member) == columns);
        let springs: Vec<&Hysteresis> = members
            .filter_map(|member| member.hinges[plane].as_ref())
            .collect();
        if springs.is_empty() {
            continue;
        }
        let mut rules: Vec<&str> = springs.iter().map(|spring| spring.rule().name()).collect();
        rules.sort_unstable();
        rules.dedup();
        writeln!(
            text,
            "  {} of {what} {}: {}",
            counted(2 * springs.len(), "hinge"),
            rules.join(" and "),
            crack_and_yield(extents(&springs, Side::Positive), MOMENT)
        )?;
    }
    for axis in PlanAxis::BOTH {
        let shear = frame.shear.iter().filter(|((_, along), _)| *along == axis);
        let shear: Vec<&ShearSpring> = shear.map(|(_, spring)| spring).collect();
        describe_shear(text, &format!("columns, {},", axis.name()), &shear)?;
    }
    Ok(())
}

/// Least and greatest cracking and yield force of some springs.
fn extents(springs: &[&Hysteresis], side: Side) -> [[f64; 2]; 2] {
    springs
        .iter()
        .fold([[f64::INFINITY, 0.0]; 2], |extents, spring| {
            let side = spring.backbone().side(side);
            let [c, y] = [side.cracking.force, side.yielding.force];
            [
                [extents[0][0].min(c), extents[0][1].max(c)],
                [extents[1][0].min(y), extents[1][1].max(y)],
            ]
        })
}

/// Where springs crack and yield, or yield only.
fn crack_and_yield([cracking, yielding]: [[f64; 2]; 2], shown: Shown) -> String {
    let unit = shown.name();
    let cracks = match cracking == yielding {
        true => String::new(),
        false => format!("crack at {} {unit}, ", range(cracking, shown)),
    };
    format!("{cracks}yield at {} {unit}", range(yielding, shown))
}

/// A range, or one number where its ends look the same.
fn range(ends: [f64; 2], shown: Shown) -> String {
    let [low, high] = ends.map(|value| shown.number(value, 1));
    if low == high {
        low
    } else {
        format!("{low} to {high}")
    }
}
