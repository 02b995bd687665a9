//! JSON Schema (draft 2020-12) of the model file, made from the table of keys.

use serde_json::{Map, Value, json};

use crate::keys::{Key, Kind, Section, keys_of};
use crate::quantity::Dimension;

/// The JSON Schema of a model file, as text with a final line break.
#[must_use]
pub fn model_schema() -> String {
    let mut schema = table(&[Section::Root]);
    if let Value::Object(map) = &mut schema {
        map.insert(
            "$schema".into(),
            json!("https://json-schema.org/draft/2020-12/schema"),
        );
        map.insert("title".into(), json!("jostle model file"));
    }
    // Plain maps of strings always serialise.
    serde_json::to_string_pretty(&schema).unwrap_or_default() + "\n"
}

/// A table with the keys of some sections and no others.
fn table(sections: &[Section]) -> Value {
    let mut properties = Map::new();
    for key in keys_of(sections) {
        properties.insert(key.name.into(), property(key));
    }
    let required: Vec<&str> = keys_of(sections)
        .filter(|key| key.required)
        .map(|key| key.name)
        .collect();
    let mut schema = json!({
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
    });
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    schema
}

/// A building: the keys of its kind.
fn building() -> Value {
    let of_kinds = |sections: &'static [Section], kind: &str, named: &[&str]| {
        let mut schema = table(sections);
        schema["properties"]["kind"] = json!({ "const": kind });
        if !named.is_empty() {
            match schema["required"].as_array_mut() {
                Some(required) => required.extend(named.iter().map(|key| json!(key))),
                None => schema["required"] = json!(named),
            }
        }
        schema
    };
    json!({ "oneOf": [
        of_kinds(&[Section::Building, Section::Frame], "frame", &[]),
        of_kinds(&[Section::Building, Section::Shear], "frame", &["kind", "plan", "frame"]),
        of_kinds(&[Section::Building, Section::Shear], "shear", &["kind"]),
        of_kinds(
            &[Section::Building, Section::SpaceFrame, Section::Shear],
            "space-frame",
            &["kind"],
        ),
        of_kinds(&[Section::Building, Section::Given], "given", &["kind"]),
    ] })
}

fn property(key: &Key) -> Value {
    let mut schema = kind(key.kind);
    let description = match key.default {
        Some(default) => format!("{} Default: {default}.", key.doc),
        None => key.doc.to_owned(),
    };
    schema["description"] = json!(description);
    schema
}

fn kind(kind: Kind) -> Value {
    let count = json!({ "type": "integer", "minimum": 0 });
    let one_or_list = |one: Value| json!({ "anyOf": [one, { "type": "array", "items": one }] });
    match kind {
        Kind::Text => json!({ "type": "string" }),
        Kind::TextOrTexts => json!({ "anyOf": [
            { "type": "string" },
            { "type": "array", "items": { "type": "string" }, "minItems": 1, "uniqueItems": true },
        ] }),
        Kind::Texts => json!({ "type": "array", "items": { "type": "string" } }),
        Kind::Component => {
            json!({ "anyOf": [{ "type": "string" }, { "type": "integer", "minimum": 1 }] })
        }
        Kind::Count => count,
        Kind::Any => json!({}),
        Kind::Named(section) => {
            json!({ "type": "object", "additionalProperties": table(&[section]) })
        }
        Kind::TextOrNumbers => json!({ "anyOf": [{ "type": "string" }, { "type": "array" }] }),
        // The table is that of [motion], which contains this key.
        Kind::TextOrMotion => json!({ "type": ["string", "array", "object"] }),
        Kind::Plan => json!({ "type": "array", "items": { "anyOf": [
            quantity(Dimension::Length),
            { "type": "array", "items": quantity(Dimension::Length) },
            table(&[Section::FloorPlan]),
        ] } }),
        Kind::PlanPoints => json!({ "type": "array", "items": { "anyOf": [
            quantity(Dimension::Length),
            { "type": "array", "items": quantity(Dimension::Length) },
        ] } }),
        Kind::PlanStiffness => one_or_list(json!({ "anyOf": [
            quantity(Dimension::Stiffness),
            table(&[Section::PlanStiffness]),
        ] })),
        Kind::NumberLists => {
            json!({ "type": "array", "items": { "type": "array", "items": { "type": "number" } } })
        }
        Kind::FlagOrTexts => json!({ "anyOf": [
            { "type": "boolean" },
            { "type": "array", "items": { "type": "string" } },
        ] }),
        Kind::FlagTextsOrTable(section) => json!({ "anyOf": [
            { "type": "boolean" },
            { "type": "array", "items": { "type": "string" }, "minItems": 1 },
            table(&[section]),
        ] }),
        Kind::OneOrMore(dimension) => one_or_list(quantity(dimension)),
        Kind::FlagOrChoices(words) => json!({ "anyOf": [
            { "type": "boolean" },
            { "enum": words },
            { "type": "array", "items": { "enum": words } },
        ] }),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Quantity(dimension) => quantity(dimension),
        Kind::PerStorey(dimension) | Kind::PerContact(dimension) => {
            one_or_list(quantity(dimension))
        }
        Kind::Quantities(dimension) => json!({ "type": "array", "items": quantity(dimension) }),
        Kind::ContactStiffness => {
            let mut schema = quantity(Dimension::HertzStiffness);
            schema["examples"] = json!(["2e9 N/m^1.5", "500 MN/m"]);
            schema
        }
        Kind::LinkDamping => {
            let mut schema = quantity(Dimension::Damping);
            schema["examples"] = json!(["2 MN.s/m", "150 kN.(s/m)^0.35"]);
            schema
        }
        Kind::Counts => json!({ "type": "array", "items": count }),
        Kind::CountPerSpan => one_or_list(count),
        Kind::Modes => {
            json!({ "anyOf": [{ "const": "all" }, one_or_list(count)] })
        }
        Kind::Choice(words) => json!({ "enum": words }),
        Kind::WordOr(word, dimension) => {
            json!({ "anyOf": [{ "const": word }, quantity(dimension)] })
        }
        Kind::ChoiceOr(words, dimension) => {
            json!({ "anyOf": [{ "enum": words }, quantity(dimension)] })
        }
        Kind::WordOrTable(word, sections) => {
            json!({ "anyOf": [{ "const": word }, table(sections)] })
        }
        Kind::ChoiceOrTable(words, section) => {
            json!({ "anyOf": [{ "enum": words }, table(&[section])] })
        }
        Kind::NumberOrTable(section) => {
            json!({ "anyOf": [quantity(Dimension::Dimensionless), table(&[section])] })
        }
        Kind::NumbersOrTable(section) => json!({ "anyOf": [
            one_or_list(quantity(Dimension::Dimensionless)),
            table(&[section]),
        ] }),
        Kind::Table(section) => table(&[section]),
        Kind::TableOf(sections) => table(sections),
        Kind::TextOrTable(section) => {
            json!({ "anyOf": [{ "type": "string" }, table(&[section])] })
        }
        Kind::Word(words) => json!({ "anyOf": [{ "enum": words }, { "type": "number" }] }),
        Kind::FromTo | Kind::OneOrTwo => json!({ "anyOf": [
            { "type": "integer", "minimum": 1 },
            { "type": "array", "minItems": 2, "maxItems": 2, "items": { "type": "integer", "minimum": 1 } },
        ] }),
        Kind::TablePerStorey(section) | Kind::TablePerPlace(section) => {
            one_or_list(table(&[section]))
        }
        Kind::Tables(sections) if sections.contains(&Section::Building) => {
            json!({ "type": "array", "minItems": 1, "items": building() })
        }
        Kind::Tables(sections) => json!({ "type": "array", "items": table(sections) }),
        Kind::Neighbours => json!({
            "type": "array", "items": { "type": "string" }, "minItems": 2, "maxItems": 2,
        }),
        Kind::FloorPairs => json!({ "anyOf": [
            { "enum": ["common", "all"] },
            { "type": "array", "items": { "type": "array", "minItems": 2, "maxItems": 2, "items":
                { "anyOf": [count, quantity(Dimension::Length), { "const": "wall" }] } } },
            { "type": "array", "items": quantity(Dimension::Length) },
        ] }),
        Kind::Concrete(grades) => json!({ "anyOf": [{ "enum": grades }, cylinder()] }),
        Kind::ConcreteOr(grades) => {
            json!({ "anyOf": [{ "enum": grades }, cylinder(), quantity(Dimension::Stress)] })
        }
        Kind::GradeOr(grades) => {
            json!({ "anyOf": [{ "enum": grades }, quantity(Dimension::Stress)] })
        }
    }
}

/// A cylinder strength.
fn cylinder() -> Value {
    json!({ "type": "string", "pattern": "^f(c'|'c)", "examples": ["f'c = 4 ksi"] })
}

/// A text with a unit, or a number in SI.
fn quantity(dimension: Dimension) -> Value {
    json!({
        "type": ["string", "number"],
        "examples": [dimension.example()],
        "$comment": format!("{dimension}; a number is in {}", dimension.si_unit()),
    })
}
