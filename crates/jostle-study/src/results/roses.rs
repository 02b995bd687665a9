//! Results over the angle of incidence: roses, and the worst angle of every quantity.

use jostle::linear::sort_by;
use jostle_io::Values;
use jostle_io::shown::{FORCE, LENGTH};
use jostle_report::message;
use jostle_report::{Axis, Petal, Rose, Section, with_unit};

use super::{Results, words};
use crate::study::{Study, StudyError};

/// Columns that are drawn unless the study names some: of all gaps together, of every gap and of every building.
const OF_ALL: [&str; 2] = ["peak_force_n", "impact_count"];
const OF_GAPS: [&str; 2] = ["peak_force_n", NEEDED];
const OF_BUILDINGS: [&str; 7] = [
    "corner_displacement_peak_m",
    "rotation_peak_rad",
    "drift_peak",
    "drift_across_peak",
    "base_shear_peak_n",
    "base_shear_across_peak_n",
    "base_torque_peak_n_m",
];
/// How the name of a column tells that it is of the run without contact.
const WITHOUT: &str = "_without_contact";
/// The gap that the run without contact needs.
const NEEDED: &str = "closing_without_contact_m";
/// Curves of a rose at most, one for each colour.
const MOST_CURVES: usize = 7;

/// Columns that [`Results::roses`] reads; none if the angle does not vary.
pub(super) fn columns(study: &Study) -> Vec<String> {
    if !study.file.factors.iter().any(jostle_io::Factor::is_angle) {
        return Vec::new();
    }
    let names = study.layout.names();
    let mut wanted = study.file.roses.clone();
    if wanted.is_empty() {
        wanted = usual(study);
    }
    // Each is followed by that of the run without contact.
    let mut all = Vec::new();
    for column in wanted {
        let is_own = |name: &&&str| **name != column && name.replacen(WITHOUT, "", 1) == column;
        let free = names.iter().find(is_own).map(|name| (*name).to_owned());
        all.push(column);
        all.extend(free);
    }
    all
}

/// Forces, impacts and peaks, as far as the study has them.
fn usual(study: &Study) -> Vec<String> {
    let Ok(input) = study.file.base.input() else {
        return Vec::new();
    };
    let names = study.layout.names();
    let mut wanted: Vec<String> = OF_ALL.map(str::to_owned).to_vec();
    let pairs = || super::head::pairs(&input).map(|pair| pair.join("-"));
    for quantity in OF_GAPS {
        // That of the only gap is that of all.
        if quantity != "peak_force_n" || input.model.gaps.len() > 1 {
            wanted.extend(pairs().map(|pair| format!("{pair}.{quantity}")));
        }
    }
    for quantity in OF_BUILDINGS {
        let buildings = input.model.buildings.iter();
        wanted.extend(buildings.map(|building| format!("{}.{quantity}", building.name)));
    }
    wanted.retain(|name| names.contains(&&name[..]));
    wanted
}

/// One curve over the angle.
struct Curve {
    /// Its column.
    column: String,
    /// What else varies, in words; empty if nothing does.
    group: String,
    /// Angle \[rad\], value in SI and case, by growing angle.
    points: Vec<(f64, f64, usize)>,
}

impl Curve {
    /// The first of the greatest.
    fn worst(&self) -> Option<&(f64, f64, usize)> {
        self.points.iter().rev().max_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn least(&self) -> Option<&(f64, f64, usize)> {
        self.points.iter().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn mean(&self) -> f64 {
        let sum: f64 = self.points.iter().map(|point| point.1).sum();
        sum / self.points.len().max(1) as f64
    }
}

impl Results<'_> {
    /// The roses and the table of worst angles; also written as `worst_angles`.
    pub(super) fn roses(&mut self, columns: &[String]) -> Result<Option<Section>, StudyError> {
        let mut factors = self.study.file.factors.iter();
        let Some(factor) = factors.position(jostle_io::Factor::is_angle) else {
            return Ok(None);
        };
        let curves: Vec<Curve> = columns
            .iter()
            .flat_map(|column| self.curves_of(column, factor))
            .collect();
        if curves.is_empty() {
            return Ok(None);
        }
        self.write(
            "worst_angles",
            message::greatest_and_least_over_angle(),
            table(&curves),
        )?;
        self.say_needed(&curves);
        self.say_worst(&curves);
        let mut groups: Vec<String> = Vec::new();
        for curve in &curves {
            if !groups.contains(&curve.group) {
                groups.push(curve.group.clone());
            }
        }
        let input = self.study.file.base.input().ok();
        let north = input.and_then(|input| input.north).map(f64::to_degrees);
        let mut roses: Vec<(String, Rose)> = Vec::new();
        for curve in &curves {
            let (_, quantity) = parts(&curve.column);
            let owner = &owner_of(&curve.column)[..];
            let is_free = is_free(&curve.column);
            // Buildings share a rose, unless curves differ by what else varies.
            let key = if groups.len() > 1 {
                curve.column.replacen(WITHOUT, "", 1)
            } else {
                quantity.replacen(WITHOUT, "", 1)
            };
            let (axis, size) = words::axis(quantity);
            let at = match roses.iter().position(|(known, _)| *known == key) {
                Some(at) => at,
                None => {
                    let several = groups.len() > 1 && !owner.is_empty();
                    let name = name_of(&axis);
                    let title = if several {
                        format!("{name}, {owner}")
                    } else {
                        name
                    };
                    let value = Axis {
                        name: axis.name.clone(),
                        unit: axis.unit.clone(),
                    };
                    let rose = Rose {
                        north,
                        ..Rose::new(title, value)
                    };
                    roses.push((key, rose));
                    roses.len() - 1
                }
            };
            let rose = &mut roses[at].1;
            let name = match groups.len() {
                0 | 1 if owner.is_empty() => String::new(),
                0 | 1 => owner.to_owned(),
                _ => curve.group.clone(),
            };
            let mut petals = rose.petals.iter();
            let known = petals
                .find(|petal| petal.name == name)
                .map(|petal| petal.colour);
            let colour = known.unwrap_or_else(|| {
                let all = rose.petals.iter().filter(|petal| !petal.dashed);
                all.count()
            });
            if known.is_none() && colour >= MOST_CURVES {
                continue;
            }
            let points = curve.points.iter();
            rose.petals.push(Petal {
                name,
                points: points
                    .map(|(angle, value, _)| [angle.to_degrees(), size * value.abs()])
                    .collect(),
                colour,
                dashed: is_free,
            });
        }
        Ok(Some(Section {
            title: message::over_the_angle().into(),
            remark: message::angles_of_roses().into(),
            roses: roses.into_iter().map(|(_, rose)| rose).collect(),
            table: Some(rows(&curves, groups.len() > 1)),
            ..Section::default()
        }))
    }

    /// A column over the angle, one curve for every combination of what else varies.
    fn curves_of(&self, column: &str, factor: usize) -> Vec<Curve> {
        let (angles, values) = (self.input(factor), self.table.column(column));
        if values.is_empty() {
            return Vec::new();
        }
        let groups = self.grouped(&self.others(&[factor]));
        let curves = groups.into_iter().map(|(group, cases)| {
            let known = cases.into_iter().filter(|case| self.completed(*case));
            let mut points: Vec<(f64, f64, usize)> = known
                .filter_map(|case| {
                    Some((
                        angles[case]?,
                        values[case]?,
                        self.sample.case(case) as usize,
                    ))
                })
                .collect();
            sort_by(&mut points, |a, b| a.0.total_cmp(&b.0));
            Curve {
                column: column.to_owned(),
                group,
                points,
            }
        });
        curves.filter(|curve| !curve.points.is_empty()).collect()
    }

    /// A sentence about the greatest force.
    fn say_worst(&mut self, curves: &[Curve]) {
        let forces = curves.iter().filter(|curve| curve.column == "peak_force_n");
        let worst = forces
            .filter_map(|curve| Some((curve, curve.worst()?, curve.least()?)))
            .max_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let Some((curve, (angle, force, _), least)) = worst.filter(|(_, worst, _)| worst.1 > 0.0)
        else {
            return;
        };
        let group = match &curve.group[..] {
            "" => String::new(),
            group => format!(" ({group})"),
        };
        self.said.push(message::worst_angle_is(
            degrees(*angle),
            group,
            with_unit(FORCE.of(least.1), ""),
            with_unit(FORCE.of(*force), ""),
        ));
    }

    /// A sentence about the gap needed, over all angles.
    fn say_needed(&mut self, curves: &[Curve]) {
        let gaps = curves.iter();
        let gaps = gaps.filter(|curve| parts(&curve.column).1 == NEEDED);
        let worst = gaps.filter_map(|curve| Some((curve, curve.worst()?)));
        let Some((curve, (angle, gap, _))) = worst.max_by(|a, b| a.1.1.total_cmp(&b.1.1)) else {
            return;
        };
        self.said.push(message::gap_needed_at_angle(
            owner_of(&curve.column),
            with_unit(LENGTH.of(*gap), ""),
            degrees(*angle),
        ));
    }
}

/// Whether a column is of the run without contact, beside one of the run with it.
fn is_free(column: &str) -> bool {
    column.contains(WITHOUT) && !column.ends_with(NEEDED)
}

/// An angle with the fewest digits \[°\].
fn degrees(angle: f64) -> String {
    let text = format!("{:.2}", angle.to_degrees());
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Building or pair, and quantity, of a column such as `A.drift_peak`. Names of buildings may have dots.
fn parts(column: &str) -> (&str, &str) {
    column.rsplit_once('.').unwrap_or(("", column))
}

/// Building or pair in words: names of pairs are joined by a hyphen.
fn owner_of(column: &str) -> String {
    let (owner, quantity) = parts(column);
    match OF_GAPS.contains(&quantity) {
        true => owner.replacen('-', " ↔ ", 1),
        false => owner.to_owned(),
    }
}

/// A quantity as the title of its rose.
fn name_of(axis: &Axis) -> String {
    let plain = axis.name.replacen(" without contact", "", 1);
    if plain == message::greatest_force_axis() {
        return message::greatest_contact_force_title().into();
    }
    if plain == message::impacts_axis() {
        return message::number_of_impacts_title().into();
    }
    // Others are names of columns.
    match &plain.replace(' ', "_")[..] {
        "closing" => message::smallest_gap_title().into(),
        "corner_displacement_peak" => message::corner_displacement_title().into(),
        "rotation_peak" => message::floor_rotation_title().into(),
        "drift_peak" => message::drift_along_title().into(),
        "drift_across_peak" => message::drift_across_title().into(),
        "base_shear_peak" => message::base_shear_along_title().into(),
        "base_shear_across_peak" => message::base_shear_across_title().into(),
        "base_torque_peak" => message::base_torque_title().into(),
        _ => {
            let mut letters = plain.chars();
            let first = letters.next().map(|c| c.to_uppercase().to_string());
            first.unwrap_or_default() + letters.as_str()
        }
    }
}

/// Heads and rows of the table on the page.
fn rows(curves: &[Curve], several: bool) -> (Vec<String>, Vec<Vec<String>>) {
    let mut heads: Vec<String> = [
        message::quantity_head(),
        message::of_head(),
        message::greatest_head(),
        message::at_head(),
        message::case_head(),
        message::least_head(),
        message::at_head(),
        message::greatest_over_mean_head(),
    ]
    .map(str::to_owned)
    .to_vec();
    if several {
        heads.insert(2, message::with_head().into());
    }
    let row = |curve: &Curve| {
        let (worst, least) = (curve.worst()?, curve.least()?);
        let (_, quantity) = parts(&curve.column);
        let owner = &owner_of(&curve.column)[..];
        let (axis, size) = words::axis(quantity);
        let shown = |value: f64| with_unit(size * value, &axis.unit);
        let free = match is_free(&curve.column) {
            true => message::and_without_contact(),
            false => "",
        };
        let mean = curve.mean();
        let ratio = if mean > 0.0 {
            format!("{:.2}", worst.1 / mean)
        } else {
            "–".into()
        };
        let owner = if owner.is_empty() {
            message::all_gaps_owner()
        } else {
            owner
        };
        let mut row = vec![
            format!("{}{free}", name_of(&axis)),
            owner.to_owned(),
            shown(worst.1),
            format!("{}°", degrees(worst.0)),
            worst.2.to_string(),
            shown(least.1),
            format!("{}°", degrees(least.0)),
            ratio,
        ];
        if several {
            row.insert(2, curve.group.clone());
        }
        Some(row)
    };
    (heads, curves.iter().filter_map(row).collect())
}

/// The same as a file.
fn table(curves: &[Curve]) -> Vec<(String, Values)> {
    let text = |of: &dyn Fn(&Curve) -> String| Values::Text(curves.iter().map(of).collect());
    let real =
        |of: &dyn Fn(&Curve) -> Option<f64>| Values::Instant(curves.iter().map(of).collect());
    let case = |curve: &Curve| i32::try_from(curve.worst()?.2).ok();
    vec![
        ("quantity".into(), text(&|curve| curve.column.clone())),
        ("group".into(), text(&|curve| curve.group.clone())),
        ("greatest".into(), real(&|curve| Some(curve.worst()?.1))),
        ("angle_rad".into(), real(&|curve| Some(curve.worst()?.0))),
        (
            "case".into(),
            Values::Whole(curves.iter().map(case).collect()),
        ),
        ("least".into(), real(&|curve| Some(curve.least()?.1))),
        (
            "least_angle_rad".into(),
            real(&|curve| Some(curve.least()?.0)),
        ),
        ("mean".into(), real(&|curve| Some(curve.mean()))),
    ]
}
