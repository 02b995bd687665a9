//! `history.parquet` and `impacts.parquet`: columns with units in their names, compressed with zstd.

use std::path::Path;
use std::sync::Arc;

use jostle::summary::{ContactSummary, ImpactSummary};
use jostle::{Column, EnergyTerm, History, Model, Summary};
use parquet::basic::{Compression, ConvertedType, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int32Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::output::{OutputError, write_atomically};

/// A column of a table with its values.
enum Values {
    Real(Vec<f64>),
    /// Whole numbers, possibly absent.
    Whole(Vec<Option<i32>>),
    Text(Vec<String>),
}

/// Writes the time histories: one row per instant.
///
/// Columns are `time_s`, `ground_acceleration_m_s2`, then for every floor such as `J1.floor5`
/// `….displacement_m`, `….velocity_m_s`, `….total_acceleration_m_s2`, for every contact
/// `J1-J2.floor5-5.force_n` (or `J1-J2.at8000mm.force_n` between floors), and `energy_input_j` and its kin.
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_history_parquet(
    path: &Path,
    model: &Model,
    summary: &Summary,
    history: &History,
) -> Result<(), OutputError> {
    let contacts = contact_names(summary);
    let columns = history.columns().iter().map(|column| {
        let name = column_name(model, &contacts, *column);
        (
            name,
            Values::Real(history.column(*column).unwrap_or_default()),
        )
    });
    write_table(path, summary, unique(columns.collect()))
}

/// Writes the impacts: one row per impact, in the order of `summary.json`.
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_impacts_parquet(path: &Path, summary: &Summary) -> Result<(), OutputError> {
    let mut rows: Vec<(String, &ContactSummary, &ImpactSummary)> = Vec::new();
    for gap in &summary.gaps {
        for contact in &gap.contacts {
            for impact in &contact.impacts {
                rows.push((gap.between.join("-"), contact, impact));
            }
        }
    }
    let floor = |side: usize| {
        let floors = rows.iter().map(|(_, contact, _)| {
            contact.floors[side].and_then(|floor| i32::try_from(floor).ok())
        });
        Values::Whole(floors.collect())
    };
    let real = |value: fn(&ImpactSummary) -> f64| {
        Values::Real(rows.iter().map(|(_, _, impact)| value(impact)).collect())
    };
    let heights = rows
        .iter()
        .map(|(_, contact, _)| contact.height_m)
        .collect();
    let columns = vec![
        (
            "gap",
            Values::Text(rows.iter().map(|row| row.0.clone()).collect()),
        ),
        ("left_floor", floor(0)),
        ("right_floor", floor(1)),
        ("height_m", Values::Real(heights)),
        ("start_s", real(|i| i.start_s)),
        ("end_s", real(|i| i.end_s)),
        ("duration_s", real(|i| i.end_s - i.start_s)),
        ("peak_force_n", real(|i| i.peak_force_n)),
        ("peak_force_at_s", real(|i| i.peak_force_at_s)),
        ("peak_indentation_m", real(|i| i.peak_indentation_m)),
        ("impact_speed_m_s", real(|i| i.impact_speed_m_s)),
        ("separation_speed_m_s", real(|i| i.separation_speed_m_s)),
        ("realised_restitution", real(|i| i.realised_restitution)),
        ("impulse_n_s", real(|i| i.impulse_n_s)),
        ("dissipated_j", real(|i| i.dissipated_j)),
    ];
    let named = columns
        .into_iter()
        .map(|(name, values)| (name.to_owned(), values))
        .collect();
    write_table(path, summary, named)
}

/// Names of the contacts in the order of the history's contact indices.
fn contact_names(summary: &Summary) -> Vec<String> {
    let mut names = Vec::new();
    for gap in &summary.gaps {
        let pair = gap.between.each_ref().map(|name| plain(name)).join("-");
        for contact in &gap.contacts {
            names.push(match contact.floors {
                [Some(left), Some(right)] => format!("{pair}.floor{left}-{right}"),
                _ => format!("{pair}.at{:.0}mm", 1e3 * contact.height_m),
            });
        }
    }
    names
}

fn column_name(model: &Model, contacts: &[String], column: Column) -> String {
    let floor = |building: usize, floor: usize| {
        let name = model.buildings.get(building).map(|b| plain(&b.name));
        format!(
            "{}.floor{floor}",
            name.unwrap_or_else(|| format!("B{}", building + 1))
        )
    };
    match column {
        Column::Time => "time_s".into(),
        Column::GroundAcceleration => "ground_acceleration_m_s2".into(),
        Column::Displacement { building, floor: f } => {
            format!("{}.displacement_m", floor(building, f))
        }
        Column::Velocity { building, floor: f } => format!("{}.velocity_m_s", floor(building, f)),
        Column::TotalAcceleration { building, floor: f } => {
            format!("{}.total_acceleration_m_s2", floor(building, f))
        }
        Column::ContactForce { contact } => match contacts.get(contact) {
            Some(name) => format!("{name}.force_n"),
            None => format!("contact{}.force_n", contact + 1),
        },
        Column::Energy(term) => {
            let name = match term {
                EnergyTerm::Input => "input",
                EnergyTerm::Kinetic => "kinetic",
                EnergyTerm::Strain => "strain",
                EnergyTerm::Damped => "damped",
                EnergyTerm::Hysteretic => "hysteretic",
                EnergyTerm::Contact => "contact",
            };
            format!("energy_{name}_j")
        }
    }
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

/// Numbers columns whose names have become equal.
fn unique(mut columns: Vec<(String, Values)>) -> Vec<(String, Values)> {
    let mut seen = std::collections::HashSet::new();
    for (name, _) in &mut columns {
        let first = name.clone();
        let mut number = 1;
        while !seen.insert(name.clone()) {
            number += 1;
            *name = format!("{first}.{number}");
        }
    }
    columns
}

fn write_table(
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
    let fields = columns
        .iter()
        .map(|(name, values)| field(name, values).map(Arc::new))
        .collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("schema")
        .with_fields(fields)
        .build()?;
    let pair = |key: &str, value: &str| KeyValue::new(key.to_owned(), value.to_owned());
    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(3)?))
        .set_created_by(format!("jostle {}", summary.jostle))
        .set_key_value_metadata(Some(vec![
            pair("jostle", &summary.jostle),
            pair("title", &summary.title),
        ]))
        .build();
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    for (_, values) in columns {
        let Some(mut column) = group.next_column()? else {
            return Err(ParquetError::General("fewer columns than announced".into()));
        };
        match values {
            Values::Real(values) => {
                column
                    .typed::<DoubleType>()
                    .write_batch(&values, None, None)?;
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
        }
        column.close()?;
    }
    group.close()?;
    writer.into_inner()
}

fn field(name: &str, values: &Values) -> Result<Type, ParquetError> {
    let (physical, repetition, converted) = match values {
        Values::Real(_) => (Physical::DOUBLE, Repetition::REQUIRED, ConvertedType::NONE),
        Values::Whole(_) => (Physical::INT32, Repetition::OPTIONAL, ConvertedType::NONE),
        Values::Text(_) => (
            Physical::BYTE_ARRAY,
            Repetition::REQUIRED,
            ConvertedType::UTF8,
        ),
    };
    Type::primitive_type_builder(name, physical)
        .with_repetition(repetition)
        .with_converted_type(converted)
        .build()
}
