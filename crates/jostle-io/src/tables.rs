//! `history.parquet`, `impacts.parquet`, `hinges.parquet`, `members.parquet` and `capacity.parquet`: columns with units in their names, compressed with LZ4.

use std::io::{BufWriter, Write};
use std::path::Path;
use std::sync::Arc;

use jostle::history::{MemberHistory, Owner};
use jostle::hysteresis::{ForceRow, Side};
use jostle::linear::sort_by;
use jostle::quantity::Read;
use jostle::results::in_plan::ImpactSliding;
use jostle::results::summary::{
    AcrossSummary, AxialFailureSummary, ContactSummary, ImpactSummary, RatioPlace, SectionSummary,
    SpringSummary,
};
use jostle::results::{member_name, section_name};
use jostle::structure::{BaseMotion, MemberPlace, SectionAt, SpringPlace};
use jostle::{Column, History, Model, Outcome, Quantity, SpacePlace, Summary, System, springs_of};
use parquet::basic::{Compression, ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int32Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};

use crate::output::{OutputError, write_atomically, write_atomically_by};

/// Number of rows above which compression saves more than its overhead.
const WORTH_COMPRESSING: usize = 64;

/// The values of a column of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers.
    Real(Vec<f64>),
    /// Numbers, possibly absent.
    Instant(Vec<Option<f64>>),
    /// Whole numbers, possibly absent.
    Whole(Vec<Option<i32>>),
    /// Texts.
    Text(Vec<String>),
    /// Bytes, such as outlines as WKB.
    Bytes(Vec<Vec<u8>>),
}

impl Values {
    /// Number of rows, absent values included.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Real(values) => values.len(),
            Self::Instant(values) => values.len(),
            Self::Whole(values) => values.len(),
            Self::Text(values) => values.len(),
            Self::Bytes(values) => values.len(),
        }
    }

    /// Whether there are no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// No values of the same kind.
    fn blank(&self) -> Self {
        match self {
            Self::Real(_) => Self::Real(Vec::new()),
            Self::Instant(_) => Self::Instant(Vec::new()),
            Self::Whole(_) => Self::Whole(Vec::new()),
            Self::Text(_) => Self::Text(Vec::new()),
            Self::Bytes(_) => Self::Bytes(Vec::new()),
        }
    }
}

/// Writes the time histories: one row per instant.
///
/// Columns are `time_s`, `ground_acceleration_m_s2`, then for every floor such as `J1.floor5` `….displacement_m`,
/// `….velocity_m_s`, `….total_acceleration_m_s2`, for every contact `J1-J2.floor5-5.force_n` (or
/// `J1-J2.at8000mm.force_n` between floors), for every link `J1-J2.link5-5.force_n`, and `energy_input_j`,
/// `energy_kinetic_j`, ….
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_history_parquet(
    path: &Path,
    model: &Model,
    summary: &Summary,
    history: &History,
) -> Result<(), OutputError> {
    let columns = history.columns();
    let names = history_names(model, summary, columns).into_iter();
    let names: Vec<(String, Values)> = names.map(|name| (name, Values::Real(vec![]))).collect();
    let values = |index: usize| Values::Real(history.column(columns[index]).unwrap_or_default());
    write_by_column(path, summary, &names, history.len(), values)
}

/// Writes a long table, of which one column at a time is in memory.
fn write_by_column(
    path: &Path,
    summary: &Summary,
    columns: &[(String, Values)],
    rows: usize,
    values: impl Fn(usize) -> Values,
) -> Result<(), OutputError> {
    write_atomically_by(path, |file| {
        let fields = Fields {
            version: &summary.jostle,
            title: &summary.title,
            facts: &[],
            columns,
            rows,
        };
        let out = BufWriter::new(file);
        let written = write_columns(out, &fields, &values).map_err(std::io::Error::other)?;
        written.into_inner()?;
        Ok(())
    })
}

/// Names of recorded quantities in tables, as described at [`write_history_parquet`]; all are distinct.
#[must_use]
pub fn history_names(model: &Model, summary: &Summary, columns: &[Column]) -> Vec<String> {
    let (contacts, links) = (contact_names(summary), link_names(summary));
    let mut names: Vec<String> = columns
        .iter()
        .map(|column| column_name(model, &contacts, &links, *column))
        .collect();
    number_equal(&mut names);
    names
}

/// Writes the impacts: one row per impact, in the order of their starts.
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_impacts_parquet(path: &Path, summary: &Summary) -> Result<(), OutputError> {
    let columns = impact_columns(summary).into_iter();
    let columns = columns.map(|(name, values)| (name.to_owned(), values));
    write_table(path, summary, columns.collect())
}

/// The columns of the table of impacts: one row per impact, in the order of their starts; those that start together in
/// the order of `summary.json`.
#[must_use]
pub fn impact_columns(summary: &Summary) -> Vec<(&'static str, Values)> {
    let mut rows: Vec<(String, &ContactSummary, &ImpactSummary)> = Vec::new();
    for gap in &summary.gaps {
        for contact in &gap.contacts {
            for impact in &contact.impacts {
                rows.push((gap.between.join("-"), contact, impact));
            }
        }
    }
    sort_by(&mut rows, |(_, _, a), (_, _, b)| {
        a.start_s.total_cmp(&b.start_s)
    });
    let floor = |side: usize| {
        let floors = rows.iter().map(|(_, contact, _)| {
            contact.floors[side].and_then(|floor| i32::try_from(floor).ok())
        });
        Values::Whole(floors.collect())
    };
    let heights = rows.iter().map(|(_, contact, _)| contact.height_m);
    let gaps = rows.iter().map(|row| row.0.clone());
    let mut columns = vec![
        ("gap", Values::Text(gaps.collect())),
        ("left_floor", floor(0)),
        ("right_floor", floor(1)),
        ("height_m", Values::Real(heights.collect())),
    ];
    let impacts = || rows.iter().map(|(_, _, impact)| *impact);
    columns.extend(quantity_columns(ImpactSummary::QUANTITIES, impacts));
    // Only gaps with friction have these.
    if impacts().any(|impact| impact.sliding.is_some()) {
        let of = |read: fn(&ImpactSliding) -> f64| {
            Values::Instant(
                impacts()
                    .map(|impact| impact.sliding.as_ref().map(read))
                    .collect(),
            )
        };
        columns.push(("slip_speed_m_s", of(|sliding| sliding.slip_speed_m_s)));
        columns.push((
            "tangential_impulse_n_s",
            of(|sliding| sliding.tangential_impulse_n_s),
        ));
    }
    columns
}

/// The columns of a list of quantities over rows.
pub(crate) fn quantity_columns<'r, T: 'r, R: Iterator<Item = &'r T>>(
    quantities: &'static [Quantity<T>],
    rows: impl Fn() -> R,
) -> impl Iterator<Item = (&'static str, Values)> {
    let in_table = quantities.iter().filter(|quantity| quantity.places.table);
    in_table.map(move |quantity| {
        let values = match quantity.read {
            Read::Real(read) => Values::Real(rows().map(read).collect()),
            Read::Optional(read) => Values::Instant(rows().map(read).collect()),
            Read::Whole(read) => {
                let values = rows().map(|row| i32::try_from(read(row)).ok());
                Values::Whole(values.collect())
            }
        };
        (quantity.name, values)
    })
}

/// Writes columns of numbers of equal length, named with their units.
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_columns_parquet(
    path: &Path,
    title: &str,
    columns: Vec<(String, Vec<f64>)>,
) -> Result<(), OutputError> {
    let columns = columns
        .into_iter()
        .map(|(name, values)| (name, Values::Real(values)));
    let bytes = encode_titled(env!("CARGO_PKG_VERSION"), title, columns.collect());
    let bytes = bytes.map_err(|error| OutputError::Encoding {
        path: path.to_owned(),
        reason: error.to_string(),
    })?;
    write_atomically(path, &bytes)
}

/// Writes columns of equal length of any kind, with `facts` about them, pairs of a key and a text, in the file.
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_values_parquet(
    path: &Path,
    title: &str,
    facts: &[(&str, String)],
    columns: Vec<(String, Values)>,
) -> Result<(), OutputError> {
    let bytes = encode_values_parquet(title, facts, columns);
    let bytes = bytes.map_err(|reason| OutputError::Encoding {
        path: path.to_owned(),
        reason,
    })?;
    write_atomically(path, &bytes)
}

/// The bytes that [`write_values_parquet`] writes. The last of the facts is the last text of the file's own notes.
///
/// # Errors
/// Why the columns cannot be encoded.
pub fn encode_values_parquet(
    title: &str,
    facts: &[(&str, String)],
    columns: Vec<(String, Values)>,
) -> Result<Vec<u8>, String> {
    encode_with(env!("CARGO_PKG_VERSION"), title, facts, columns).map_err(|error| error.to_string())
}

/// Writes what can crack and yield: one row per hinge or storey spring, building by building, touched or not.
///
/// `kind` is `column`, `beam`, `column shear`, `storey` or `element`; `level` is the storey of a column, the floor of a beam; `line`
/// is the column line, the bay or the number of the element, absent for storeys; `place` names the frame in plan; `end` is `foot`, `head`,
/// `left`, `right`, the direction `x` or `y` in plan, or empty. Deformations are in rad (m for shear of columns and for storeys),
/// forces in N·m (N there).
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_hinges_parquet(
    path: &Path,
    system: &System,
    outcome: &Outcome,
    summary: &Summary,
) -> Result<(), OutputError> {
    type Row<'a> = (&'a str, Option<SpringPlace>, SpringSummary);
    let mut rows: Vec<Row<'_>> = Vec::new();
    for building in system.structures() {
        for spring in springs_of(building, outcome) {
            let places = &building.discretization.spring_places;
            rows.push((&building.name, places.get(spring.index).copied(), spring));
        }
    }
    let text = |of: fn(&Row<'_>) -> String| Values::Text(rows.iter().map(of).collect());
    let whole = |of: fn(&Row<'_>) -> Option<usize>| {
        let values = rows.iter().map(of);
        Values::Whole(values.map(|v| i32::try_from(v?).ok()).collect())
    };
    let mut columns = vec![
        ("building", text(|row| row.0.to_owned())),
        ("index", whole(|row| Some(row.2.index))),
        ("place", text(|row| row.2.place.clone())),
        ("kind", text(|row| parts(row.1).0.to_owned())),
        ("level", whole(|row| parts(row.1).1)),
        ("line", whole(|row| parts(row.1).2)),
        ("end", text(|row| parts(row.1).3.to_owned())),
    ];
    let in_space = |row: &Row<'_>| match row.1 {
        Some(SpringPlace::InSpace { place, axis, .. }) => Some((place, axis)),
        _ => None,
    };
    if rows.iter().any(|row| in_space(row).is_some()) {
        let across = |row: &Row<'_>| {
            let [[_, y], _] = in_space(row)?.0.crossings();
            i32::try_from(y + 1).ok()
        };
        let axis = |row: &Row<'_>| in_space(row).map_or("", |(_, axis)| axis.name()).to_owned();
        columns.push(("line_y", Values::Whole(rows.iter().map(across).collect())));
        columns.push(("axis", Values::Text(rows.iter().map(axis).collect())));
    }
    let springs = || rows.iter().map(|(_, _, spring)| spring);
    columns.extend(quantity_columns(SpringSummary::QUANTITIES, springs));
    let named = columns
        .into_iter()
        .map(|(name, values)| (name.to_owned(), values))
        .collect();
    write_table(path, summary, named)
}

/// The columns of the table of columns and beams: one row per end, and one on either side of every point where a neighbour
/// can strike a column. `building`: those of one building only.
#[must_use]
pub fn member_columns(summary: &Summary, building: Option<usize>) -> Vec<(&'static str, Values)> {
    let mut rows: Vec<(&str, Option<f64>, &SectionSummary)> = Vec::new();
    for (index, building_summary) in summary.buildings.iter().enumerate() {
        if building.is_some_and(|building| building != index) {
            continue;
        }
        for member in &building_summary.members {
            rows.extend(member.ends.iter().map(|end| (&member.name[..], None, end)));
            for struck in &member.struck {
                for side in [&struck.below, &struck.above] {
                    rows.push((&member.name, Some(struck.height_m), side));
                }
            }
        }
    }
    let text = |of: fn(&(&str, Option<f64>, &SectionSummary)) -> String| {
        Values::Text(rows.iter().map(of).collect())
    };
    let mut columns = vec![
        ("member", text(|row| row.0.to_owned())),
        ("end", text(|row| row.2.at.to_owned())),
        (
            "struck_height_m",
            Values::Instant(rows.iter().map(|row| row.1).collect()),
        ),
    ];
    let sections = || rows.iter().map(|(.., section)| *section);
    columns.extend(quantity_columns(SectionSummary::QUANTITIES, sections));
    if sections().any(|section| section.across.is_some()) {
        let across = |of: fn(&AcrossSummary) -> f64| {
            let values = sections().map(|section| section.across.as_ref().map(of));
            Values::Instant(values.collect())
        };
        columns.extend([
            (
                "shear_across_peak_n",
                across(|peaks| peaks.shear_across_peak_n),
            ),
            (
                "moment_across_peak_n_m",
                across(|peaks| peaks.moment_across_peak_n_m),
            ),
            ("torque_peak_n_m", across(|peaks| peaks.torque_peak_n_m)),
        ]);
    }
    columns
}

/// A row of the table of demands over capacities.
struct CapacityRow<'a> {
    member: &'a str,
    rule: &'static str,
    shear: Option<(f64, &'a RatioPlace)>,
    /// Of columns and beams.
    bending: Option<(f64, &'a RatioPlace)>,
    axial_failure: Option<AxialFailureSummary>,
}

/// The columns of the table of demands over capacities: one row per member and rule, the governing rule first, then one per
/// beam–column joint and rule, building by building; no rows where no capacity is known. Joints have no bending. `building`:
/// those of one building only.
#[must_use]
pub fn capacity_columns(summary: &Summary, building: Option<usize>) -> Vec<(&'static str, Values)> {
    let mut rows: Vec<CapacityRow<'_>> = Vec::new();
    for (index, building_summary) in summary.buildings.iter().enumerate() {
        if building.is_some_and(|building| building != index) {
            continue;
        }
        for member in &building_summary.members {
            let ratios = member.ratio.iter().chain(&member.other_ratios);
            rows.extend(ratios.map(|ratio| CapacityRow {
                member: &member.name,
                rule: ratio.rule,
                shear: ratio.shear.zip(ratio.shear_at.as_ref()),
                bending: Some((ratio.bending, &ratio.bending_at)),
                axial_failure: member.axial_failure,
            }));
        }
        for joint in &building_summary.joints {
            let ratios = joint.ratio.iter().chain(&joint.other_ratios);
            rows.extend(ratios.map(|ratio| CapacityRow {
                member: &joint.name,
                rule: ratio.rule,
                shear: Some((ratio.shear, &ratio.shear_at)),
                bending: None,
                axial_failure: None,
            }));
        }
    }
    let text = |of: fn(&CapacityRow<'_>) -> String| Values::Text(rows.iter().map(of).collect());
    let maybe =
        |of: fn(&CapacityRow<'_>) -> Option<f64>| Values::Instant(rows.iter().map(of).collect());
    vec![
        ("member", text(|row| row.member.to_owned())),
        ("rule", text(|row| row.rule.to_owned())),
        ("shear_ratio", maybe(|row| Some(row.shear?.0))),
        ("shear_at_s", maybe(|row| Some(row.shear?.1.at_s))),
        ("shear_end", text(|row| end_of(row.shear))),
        ("shear_capacity_n", maybe(|row| Some(row.shear?.1.capacity))),
        ("shear_exceeded_s", maybe(|row| row.shear?.1.exceeded_s)),
        ("shear_impact_s", maybe(|row| impact_of(row.shear))),
        ("bending_ratio", maybe(|row| Some(row.bending?.0))),
        ("bending_at_s", maybe(|row| Some(row.bending?.1.at_s))),
        ("bending_end", text(|row| end_of(row.bending))),
        (
            "bending_capacity_n_m",
            maybe(|row| Some(row.bending?.1.capacity)),
        ),
        ("bending_exceeded_s", maybe(|row| row.bending?.1.exceeded_s)),
        ("bending_impact_s", maybe(|row| impact_of(row.bending))),
        (
            "axial_failure_drift",
            maybe(|row| Some(row.axial_failure?.drift)),
        ),
        (
            "axial_failure_ratio",
            maybe(|row| Some(row.axial_failure?.ratio)),
        ),
    ]
}

/// Section of a greatest ratio: an end of a member, or the core of a joint.
fn end_of(ratio: Option<(f64, &RatioPlace)>) -> String {
    ratio.map_or_else(String::new, |(_, place)| place.at.to_owned())
}

/// Start of the impact during which a ratio was greatest.
fn impact_of(ratio: Option<(f64, &RatioPlace)>) -> Option<f64> {
    Some(ratio?.1.impact.as_ref()?.start_s)
}

/// Writes demands over capacities of columns, beams and joints; see [`capacity_columns`].
///
/// # Errors
/// [`OutputError`] when the file cannot be written.
pub fn write_capacity_parquet(path: &Path, summary: &Summary) -> Result<(), OutputError> {
    let columns = capacity_columns(summary, None).into_iter();
    write_table(
        path,
        summary,
        columns
            .map(|(name, values)| (name.to_owned(), values))
            .collect(),
    )
}

/// A column of the histories of members: its name, no values of its kind, and what computes its values.
type MemberColumn<'a> = (&'static str, Values, Box<dyn Fn() -> Values + 'a>);

/// What [`member_history_columns`] computes, without its values.
fn member_history_table<'a>(
    system: &'a System,
    history: &'a MemberHistory,
) -> Vec<MemberColumn<'a>> {
    let members = move || {
        history.members().iter().map(|[building, member]| {
            let building = &system.buildings[*building];
            (building, &building.members.members[*member])
        })
    };
    let sections = move || {
        members().flat_map(|(building, member)| {
            let sections = member.sections.iter();
            sections.map(move |section| (building, member, section))
        })
    };
    let (count, instants) = (history.sections(), history.len());
    // Every instant has a row of every section.
    let texts = move |texts: Vec<String>| {
        let rows = texts.iter().cycle().take(count * instants);
        Values::Text(rows.cloned().collect())
    };
    let names = move || {
        texts(
            sections()
                .map(|(of, member, _)| member_name(of, member))
                .collect(),
        )
    };
    let ends = sections().map(|(_, member, section)| section_name(member.place, section.at));
    let ends: Vec<String> = ends.map(str::to_owned).collect();
    let heights = sections().map(|(_, _, section)| {
        let struck = matches!(section.at, SectionAt::Below | SectionAt::Above);
        struck.then_some(section.height)
    });
    let heights: Vec<Option<f64>> = heights.collect();
    let times = move || {
        let times = history.times().into_iter();
        Values::Real(times.flat_map(|t| std::iter::repeat_n(t, count)).collect())
    };
    let real = |force: usize| -> Box<dyn Fn() -> Values + 'a> {
        Box::new(move || {
            let mut values = vec![0.0; count * instants];
            for section in 0..count {
                let of_section = values.iter_mut().skip(section).step_by(count);
                let forces = history.force(section, force);
                of_section.zip(forces).for_each(|(to, from)| *to = from);
            }
            Values::Real(values)
        })
    };
    let [number, text] = [|| Values::Real(vec![]), || Values::Text(vec![])];
    let mut columns: Vec<MemberColumn<'a>> = vec![
        ("time_s", number(), Box::new(times)),
        ("member", text(), Box::new(names)),
        ("end", text(), Box::new(move || texts(ends.clone()))),
        (
            "struck_height_m",
            Values::Instant(vec![]),
            Box::new(move || {
                let rows = heights.iter().cycle().take(count * instants);
                Values::Instant(rows.copied().collect())
            }),
        ),
        ("axial_n", number(), real(0)),
        ("shear_n", number(), real(1)),
        ("moment_n_m", number(), real(2)),
    ];
    if sections().any(|(.., section)| section.across.is_some()) {
        columns.extend([
            ("shear_across_n", number(), real(3)),
            ("moment_across_n_m", number(), real(4)),
            ("torque_n_m", number(), real(5)),
        ]);
    }
    columns
}

/// The columns of the histories of members: one row per instant and section, in the order of time.
#[must_use]
pub fn member_history_columns(
    system: &System,
    history: &MemberHistory,
) -> Vec<(&'static str, Values)> {
    let columns = member_history_table(system, history).into_iter();
    columns.map(|(name, _, values)| (name, values())).collect()
}

/// Writes the histories of members that were asked for; see [`member_history_columns`].
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_members_parquet(
    path: &Path,
    system: &System,
    history: &MemberHistory,
    summary: &Summary,
) -> Result<(), OutputError> {
    let table = member_history_table(system, history);
    let names = table.iter();
    let names: Vec<_> = names
        .map(|(name, kind, _)| ((*name).to_owned(), kind.clone()))
        .collect();
    let rows = history.len() * history.sections();
    write_by_column(path, summary, &names, rows, |index| table[index].2())
}

/// Storey and line of a column, or floor and span of a beam; of a column in space the line x.
fn storey_and_line(member: MemberPlace) -> (usize, usize) {
    match member {
        MemberPlace::Column { line, storey } => (storey, line),
        MemberPlace::Beam { floor, span } => (floor, span),
        MemberPlace::InSpace(place) => (place.storey() + 1, place.crossings()[0][0] + 1),
    }
}

/// Kind, level, line and end of a place.
fn parts(place: Option<SpringPlace>) -> (&'static str, Option<usize>, Option<usize>, &'static str) {
    match place {
        Some(
            SpringPlace::Column { storey, line, end }
            | SpringPlace::ColumnInPlan {
                storey, line, end, ..
            },
        ) => ("column", Some(storey), Some(line), end.of_column()),
        Some(
            SpringPlace::Beam { floor, bay, end }
            | SpringPlace::BeamInPlan {
                floor, bay, end, ..
            },
        ) => ("beam", Some(floor), Some(bay), end.of_beam()),
        Some(SpringPlace::Struck { member, .. }) => {
            let (storey, line) = storey_and_line(member);
            ("column", Some(storey), Some(line), "struck")
        }
        Some(SpringPlace::Shear { member, end, .. }) => {
            let (storey, line) = storey_and_line(member);
            ("column shear", Some(storey), Some(line), end.of_column())
        }
        Some(SpringPlace::Fibre {
            member, end, point, ..
        }) => {
            let (storey, line) = storey_and_line(member);
            let at = point.map_or(end.of_column(), |_| "struck");
            ("column fibre", Some(storey), Some(line), at)
        }
        Some(SpringPlace::Surface {
            member, end, point, ..
        }) => {
            let (storey, line) = storey_and_line(member);
            let at = point.map_or(end.of_column(), |_| "struck");
            ("column surface", Some(storey), Some(line), at)
        }
        Some(SpringPlace::Sliding { member, .. }) => match member {
            MemberPlace::Column { line, storey } => ("wall shear", Some(storey), Some(line), ""),
            MemberPlace::Beam { floor, span } => ("beam shear", Some(floor), Some(span), ""),
            MemberPlace::InSpace(_) => ("", None, None, ""),
        },
        Some(SpringPlace::Diagonal { place, .. }) => (
            place.kind.name(),
            Some(place.storey),
            Some(place.bay),
            place.rise.name(),
        ),
        Some(SpringPlace::Storey { storey }) => ("storey", Some(storey), None, ""),
        Some(SpringPlace::Base { line, motion }) => {
            let motion = match motion {
                BaseMotion::Rocking => "rocking",
                BaseMotion::Sliding => "sliding",
            };
            ("base", Some(0), Some(line), motion)
        }
        // Contact springs of a foundation count like lines, from the left.
        Some(SpringPlace::Footing { line, spring }) => {
            ("footing", Some(0), line.or(Some(spring)), "")
        }
        Some(SpringPlace::PlanStorey { storey, axis }) => {
            ("storey", Some(storey), None, axis.name())
        }
        Some(SpringPlace::Element {
            element,
            storey,
            axis,
        }) => ("element", Some(storey), Some(element), axis.name()),
        Some(SpringPlace::InSpace { place, end, .. }) => {
            let [[x, _], _] = place.crossings();
            let kind = match place {
                SpacePlace::Column { .. } => "column",
                SpacePlace::BeamX { .. } => "beam_x",
                SpacePlace::BeamY { .. } => "beam_y",
            };
            let level = place.storey() + 1;
            (kind, Some(level), Some(x + 1), end.in_space(place))
        }
        Some(SpringPlace::Bearings) => ("isolation", Some(0), None, "bearings"),
        Some(SpringPlace::BearingInPlan { bearing, row }) => {
            ("isolation", Some(0), Some(bearing), row.name())
        }
        Some(SpringPlace::Ring { row }) => {
            let direction = match row {
                ForceRow::X => "ring, x",
                ForceRow::Y => "ring, y",
                ForceRow::Between => "ring",
            };
            ("isolation", Some(0), None, direction)
        }
        Some(SpringPlace::Stop { side }) => {
            let side = match side {
                Side::Negative => "left stop",
                Side::Positive => "right stop",
            };
            ("isolation", Some(0), None, side)
        }
        None => ("", None, None, ""),
    }
}

/// Names of the contacts in the order of the history's contact indices.
#[must_use]
pub fn contact_names(summary: &Summary) -> Vec<String> {
    let mut names = Vec::new();
    for gap in &summary.gaps {
        let pair = gap.between.each_ref().map(|name| plain(name)).join("-");
        for contact in &gap.contacts {
            let place = joint_place("floor", contact.floors, contact.height_m);
            // A slab may strike several columns at one height.
            let column = contact.struck_column.as_ref();
            let column = column.map(|line| format!("_column{}", plain(&line.replace('.', "-"))));
            names.push(format!("{pair}.{place}{}", column.unwrap_or_default()));
        }
    }
    names
}

/// Names of the links in the order of the history's link indices.
fn link_names(summary: &Summary) -> Vec<String> {
    let mut names = Vec::new();
    for link in &summary.links {
        let pair = link.between.each_ref().map(|name| plain(name)).join("-");
        for floor in &link.floors {
            let place = joint_place("link", floor.floors, floor.height_m);
            names.push(format!("{pair}.{place}"));
        }
    }
    names
}

fn joint_place(what: &str, floors: [Option<usize>; 2], height: f64) -> String {
    match floors {
        [Some(left), Some(right)] => format!("{what}{left}-{right}"),
        _ if what == "floor" => format!("at{:.0}mm", 1e3 * height),
        _ => format!("{what}_at{:.0}mm", 1e3 * height),
    }
}

fn column_name(model: &Model, contacts: &[String], links: &[String], column: Column) -> String {
    let [index, floor] = column.place();
    let joint = |names: &[String], what: &str| {
        let name = names.get(index).cloned();
        name.unwrap_or_else(|| format!("{what}{}", index + 1)) + "."
    };
    let recorded = column.recorded();
    let place = match column.owner {
        Owner::Run if recorded.owner == "energy" => "energy_".to_owned(),
        Owner::Floor { .. } => {
            if let Some(wall) = wall_behind(model, index) {
                return format!("{}.{}{}", plain(wall), recorded.name, recorded.unit.suffix);
            }
            let name = model.buildings.get(index).map(|b| plain(&b.name));
            let name = name.unwrap_or_else(|| format!("B{}", index + 1));
            format!("{name}.floor{floor}.")
        }
        Owner::Contact(_) => joint(contacts, "contact"),
        Owner::Link(_) => joint(links, "link"),
        Owner::Support(_) => match wall_behind(model, index) {
            Some(wall) => format!("{}.", plain(wall)),
            None => {
                let name = model.buildings.get(index).map(|b| plain(&b.name));
                format!("{}.isolation.", name.unwrap_or_default())
            }
        },
        Owner::Ground(_) => match ground_under(model, index) {
            Some(name) => format!("{}.", plain(name)),
            None => format!("B{}.", index + 1),
        },
        // Others are no columns of histories.
        Owner::Run
        | Owner::Building(_)
        | Owner::Bearing { .. }
        | Owner::Section { .. }
        | Owner::Foundation(_)
        | Owner::Gap(_)
        | Owner::Spring(_) => String::new(),
    };
    place + recorded.name + recorded.unit.suffix
}

/// The name of the wall that is this building of a system: those that are not rigid follow the buildings.
fn wall_behind(model: &Model, building: usize) -> Option<&str> {
    let mut moving = model.walls.iter().filter(|wall| !wall.is_rigid());
    let index = building.checked_sub(model.buildings.len())?;
    moving.nth(index).map(|wall| &wall.name[..])
}

/// The name of the building or wall above a ground.
fn ground_under(model: &Model, ground: usize) -> Option<&str> {
    let buildings = model.buildings.len();
    if let Some(building) = model.buildings.get(ground) {
        return Some(&building.name);
    }
    let wall = ground.checked_sub(buildings)?;
    model.walls.get(wall).map(|wall| &wall.name[..])
}

/// A name without the characters that split or end column names elsewhere.
fn plain(name: &str) -> String {
    name.trim()
        .chars()
        .map(|c| {
            if c.is_alphanumeric() || matches!(c, '-' | '_') {
                c
            } else {
                '_'
            }
        })
        .collect()
}

/// Numbers names that have become equal.
fn number_equal(names: &mut [String]) {
    let mut seen = std::collections::HashSet::new();
    for name in names {
        let first = name.clone();
        let mut number = 1;
        while !seen.insert(name.clone()) {
            number += 1;
            *name = format!("{first}.{number}");
        }
    }
}

pub(crate) fn write_table(
    path: &Path,
    summary: &Summary,
    columns: Vec<(String, Values)>,
) -> Result<(), OutputError> {
    let bytes = encode(summary, columns).map_err(|error| OutputError::Encoding {
        path: path.to_owned(),
        reason: error.to_string(),
    })?;
    write_atomically(path, &bytes)
}

fn encode(summary: &Summary, columns: Vec<(String, Values)>) -> Result<Vec<u8>, ParquetError> {
    encode_titled(&summary.jostle, &summary.title, columns)
}

fn encode_titled(
    version: &str,
    title: &str,
    columns: Vec<(String, Values)>,
) -> Result<Vec<u8>, ParquetError> {
    encode_with(version, title, &[], columns)
}

fn encode_with(
    version: &str,
    title: &str,
    facts: &[(&str, String)],
    mut columns: Vec<(String, Values)>,
) -> Result<Vec<u8>, ParquetError> {
    let mut all: Vec<Values> = Vec::with_capacity(columns.len());
    for (_, values) in &mut columns {
        let blank = values.blank();
        all.push(std::mem::replace(values, blank));
    }
    let fields = Fields {
        version,
        title,
        facts,
        columns: &columns,
        rows: all.first().map_or(0, Values::len),
    };
    let mut all = all.into_iter();
    let next = |_| all.next().unwrap_or(Values::Real(vec![]));
    write_columns(Vec::new(), &fields, next)
}

/// What a table is besides its values.
struct Fields<'a> {
    version: &'a str,
    title: &'a str,
    facts: &'a [(&'a str, String)],
    /// Names, and values of the kind of each, which may be none.
    columns: &'a [(String, Values)],
    rows: usize,
}

/// Writes columns one after the other; `values` gives those of a column.
fn write_columns<W: Write + Send>(
    out: W,
    fields: &Fields<'_>,
    mut values: impl FnMut(usize) -> Values,
) -> Result<W, ParquetError> {
    let (version, title) = (fields.version, fields.title);
    let types = fields.columns.iter();
    let types = types
        .map(|(name, values)| field(name, values).map(Arc::new))
        .collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("schema")
        .with_fields(types)
        .build()?;
    let pair = |key: &str, value: &str| KeyValue::new(key.to_owned(), value.to_owned());
    let mut pairs = vec![pair("jostle", version), pair("title", title)];
    pairs.extend(fields.facts.iter().map(|(key, value)| pair(key, value)));
    let compression = if fields.rows < WORTH_COMPRESSING {
        Compression::UNCOMPRESSED
    } else {
        Compression::LZ4_RAW
    };
    // Numbers seldom repeat: dictionary encoding takes as long as everything else.
    let mut properties = WriterProperties::builder()
        .set_compression(compression)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_dictionary_enabled(false)
        .set_created_by(format!("jostle {version}"))
        .set_key_value_metadata(Some(pairs));
    for (name, values) in fields.columns {
        if matches!(values, Values::Text(_)) {
            let path = ColumnPath::new(vec![name.clone()]);
            properties = properties.set_column_dictionary_enabled(path, true);
        }
    }
    let properties = Arc::new(properties.build());
    let mut writer = SerializedFileWriter::new(out, Arc::new(schema), properties)?;
    let mut group = writer.next_row_group()?;
    for index in 0..fields.columns.len() {
        let Some(mut column) = group.next_column()? else {
            return Err(ParquetError::General("fewer columns than announced".into()));
        };
        match values(index) {
            Values::Real(values) => {
                column
                    .typed::<DoubleType>()
                    .write_batch(&values, None, None)?;
            }
            Values::Instant(values) => {
                let levels: Vec<i16> = values.iter().map(|v| i16::from(v.is_some())).collect();
                let present: Vec<f64> = values.into_iter().flatten().collect();
                column
                    .typed::<DoubleType>()
                    .write_batch(&present, Some(&levels), None)?;
            }
            Values::Whole(values) => {
                let levels: Vec<i16> = values.iter().map(|v| i16::from(v.is_some())).collect();
                let present: Vec<i32> = values.into_iter().flatten().collect();
                column
                    .typed::<Int32Type>()
                    .write_batch(&present, Some(&levels), None)?;
            }
            Values::Text(values) => {
                let values: Vec<ByteArray> = values
                    .iter()
                    .map(|text| ByteArray::from(text.as_str()))
                    .collect();
                column
                    .typed::<ByteArrayType>()
                    .write_batch(&values, None, None)?;
            }
            Values::Bytes(values) => {
                let values: Vec<ByteArray> = values.into_iter().map(ByteArray::from).collect();
                column
                    .typed::<ByteArrayType>()
                    .write_batch(&values, None, None)?;
            }
        }
        column.close()?;
    }
    group.close()?;
    writer.into_inner()
}

fn field(name: &str, values: &Values) -> Result<Type, ParquetError> {
    let (physical, repetition, converted) = match values {
        Values::Real(_) => (Physical::DOUBLE, Repetition::REQUIRED, ConvertedType::NONE),
        Values::Instant(_) => (Physical::DOUBLE, Repetition::OPTIONAL, ConvertedType::NONE),
        Values::Whole(_) => (Physical::INT32, Repetition::OPTIONAL, ConvertedType::NONE),
        Values::Text(_) => (
            Physical::BYTE_ARRAY,
            Repetition::REQUIRED,
            ConvertedType::UTF8,
        ),
        Values::Bytes(_) => (
            Physical::BYTE_ARRAY,
            Repetition::REQUIRED,
            ConvertedType::NONE,
        ),
    };
    Type::primitive_type_builder(name, physical)
        .with_repetition(repetition)
        .with_converted_type(converted)
        .build()
}
