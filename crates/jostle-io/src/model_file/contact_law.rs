//! The contact law of a `[[gap]]`: its name, its constants, and which of them go together.

use jostle::contact::{BilinearConstants, Crush, Dashpot, DashpotLaw, Formula, ModifiedKelvin};
use jostle::{ContactLaw, LawKind, RestitutionIs};

use crate::keys::{LAW_VARIANTS, LAWS, RESTITUTION_IS, Section};
use crate::quantity::Dimension;
use crate::reader::{Reader, View};

/// Law where none is named.
pub(super) const DEFAULT_LAW: LawKind = LawKind::HertzDamp;
/// Contact stiffness of the Hertz laws for colliding concrete floors \[N/m^1.5\].
pub(super) const CONCRETE_STIFFNESS: f64 = 2e9;
/// Name of the law that is a formula of the user, and of its key.
const FORMULA: &str = "formula";
/// Stiffness of lasting contact under the momentum law \[N/m\].
const LASTING_STIFFNESS: f64 = 1e9;
/// Restitution of colliding concrete \[–\].
pub(super) const CONCRETE_RESTITUTION: f64 = 0.65;

/// The law of a gap; `per_length`: its stiffness is read elsewhere.
pub(super) fn contact_law(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    per_length: bool,
) -> ContactLaw {
    let named = reader
        .get(view, "law")
        .map(|field| reader.choice(&field, LAWS, &[]));
    let known = match named.flatten() {
        Some(FORMULA) => formula(reader, view).map(LawKind::Formula),
        name => name.and_then(LawKind::from_name),
    };
    let kind = known.unwrap_or(DEFAULT_LAW);
    let law_is_bad = named.is_some() && known.is_none();
    let kind = with_parameters(reader, view, kind, law_is_bad);
    let kind = with_constants(reader, view, kind, law_is_bad);
    if per_length
        && matches!(kind, LawKind::BilinearGiven(_))
        && let Some(field) = reader.get(view, "second_stiffness")
    {
        *reader.bad(&field, "cannot be combined with stiffness_per_length") =
            Some("give stiffness, that of a whole face".into());
    }
    let stiffness = match per_length {
        true => None,
        false => stiffness(reader, view, kind, law_is_bad),
    };
    let restitution = optional(reader, view, "restitution", Dimension::Dimensionless);
    let restitution_is = match reader.get(view, "restitution_is") {
        Some(field) => reader.choice(&field, RESTITUTION_IS, &[]),
        None => None,
    };
    if kind.has_given_constants() {
        refuse_restitution(reader, view, kind);
    }
    ContactLaw {
        kind,
        stiffness: stiffness.unwrap_or(if kind == LawKind::Restitution {
            LASTING_STIFFNESS
        } else {
            CONCRETE_STIFFNESS
        }),
        restitution: restitution.unwrap_or(CONCRETE_RESTITUTION),
        restitution_is: restitution_is
            .and_then(RestitutionIs::from_name)
            .unwrap_or_default(),
    }
}

/// The formula of a law.
fn formula(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Formula> {
    let Some(field) = reader.get(view, FORMULA) else {
        reader.missing(
            view,
            FORMULA,
            "add formula = \"k * d^1.5 * (1 + 0.6 * v / v0)\"",
        );
        return None;
    };
    let text = reader.text(&field)?;
    match Formula::parse(&text) {
        Ok(formula) => Some(formula),
        Err(error) => {
            *reader.bad(&field, error.to_string()) =
                Some("write the force in N as in \"k * d^1.5 * (1 + 0.6 * v / v0)\"".into());
            None
        }
    }
}

/// Where constants state what a law dissipates, no coefficient can.
fn refuse_restitution(reader: &mut Reader<'_>, view: &View<'_>, kind: LawKind) {
    let stated = match kind {
        LawKind::Dashpot(_) => "damping",
        LawKind::BilinearGiven(_) => "second_stiffness and yield",
        LawKind::Formula(_) => "a formula without e",
        _ => "crush",
    };
    for key in ["restitution", "restitution_is"] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, format!("cannot be combined with {stated}")) = Some(format!(
                "leave {key} out, or {stated}: both say what an impact dissipates"
            ));
        }
    }
}

pub(super) fn optional(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
    dimension: Dimension,
) -> Option<f64> {
    let field = reader.get(view, key)?;
    reader.quantity(&field, dimension)
}

/// Keys that only some laws have.
fn with_parameters(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    mut kind: LawKind,
    law_is_bad: bool,
) -> LawKind {
    match &mut kind {
        LawKind::ModifiedKelvin(variant) => {
            let named = reader.get(view, "variant");
            let named = named.and_then(|field| reader.choice(&field, LAW_VARIANTS, &[]));
            *variant = named
                .and_then(ModifiedKelvin::from_name)
                .unwrap_or(*variant);
        }
        LawKind::Bilinear(shape) => {
            let share = optional(reader, view, "yield_share", Dimension::Dimensionless);
            shape.yield_share = share.unwrap_or(shape.yield_share);
            shape.design_speed = optional(reader, view, "design_speed", Dimension::Speed);
        }
        LawKind::Rubber(bumper) => {
            match optional(reader, view, "thickness", Dimension::Length) {
                Some(thickness) => bumper.thickness = thickness,
                None if reader.get(view, "thickness").is_none() => {
                    reader.missing(view, "thickness", "add thickness = \"50 mm\"");
                }
                None => {}
            }
            let exponent = optional(reader, view, "exponent", Dimension::Dimensionless);
            bumper.exponent = exponent.unwrap_or(bumper.exponent);
        }
        LawKind::Linear
        | LawKind::Kelvin
        | LawKind::KelvinNoTension
        | LawKind::Hertz
        | LawKind::HertzDamp
        | LawKind::Ye
        | LawKind::Jankowski
        | LawKind::Restitution
        | LawKind::Dashpot(_)
        | LawKind::BilinearGiven(_)
        | LawKind::Crushing(_)
        | LawKind::Formula(_) => {}
    }
    if !law_is_bad {
        for (key, owner) in [
            ("formula", FORMULA),
            ("variant", "modified-kelvin"),
            ("yield_share", "bilinear"),
            ("design_speed", "bilinear"),
            ("thickness", "rubber"),
            ("exponent", "rubber"),
        ] {
            if kind.name() != owner
                && let Some(field) = reader.get(view, key)
            {
                *reader.bad(
                    &field,
                    format!("belongs to the law {owner}, not to {}", kind.name()),
                ) = Some(format!("leave it out, or write law = \"{owner}\""));
            }
        }
    }
    kind
}

/// The form of the law with given constants, where they stand in place of a coefficient of restitution.
fn with_constants(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    kind: LawKind,
    law_is_bad: bool,
) -> LawKind {
    let damping = optional(reader, view, "damping", Dimension::Damping);
    let second = optional(reader, view, "second_stiffness", Dimension::Stiffness);
    let yields = optional(reader, view, "yield", Dimension::Length);
    let crush = crush(reader, view);
    if law_is_bad {
        return kind;
    }
    let is_bilinear = matches!(kind, LawKind::Bilinear(_));
    let crushes = matches!(kind, LawKind::Linear | LawKind::Hertz);
    let dashpot = match kind {
        LawKind::Kelvin => Some(DashpotLaw::Kelvin),
        LawKind::KelvinNoTension => Some(DashpotLaw::KelvinNoTension),
        LawKind::ModifiedKelvin(ModifiedKelvin::MahmoudJankowski) => Some(DashpotLaw::Approach),
        _ => None,
    };
    let allowed = [
        (
            "damping",
            dashpot.is_some(),
            "kelvin, kelvin-no-tension and modified-kelvin with variant = \"mahmoud-jankowski\"",
            "write law = \"kelvin-no-tension\", or leave it out",
        ),
        (
            "second_stiffness",
            is_bilinear,
            "bilinear",
            "write law = \"bilinear\", or leave it out",
        ),
        (
            "yield",
            is_bilinear,
            "bilinear",
            "write law = \"bilinear\", or leave it out",
        ),
        (
            "crush",
            crushes,
            "linear and hertz",
            "write law = \"linear\" or \"hertz\", or leave it out",
        ),
    ];
    for (key, fits, owners, remedy) in allowed {
        if !fits && let Some(field) = reader.get(view, key) {
            let name = kind.full_name();
            *reader.bad(
                &field,
                format!("belongs to the law {owners}, not to {name}"),
            ) = Some(remedy.into());
        }
    }
    if let (Some(law), Some(damping)) = (dashpot, damping) {
        return LawKind::Dashpot(Dashpot { law, damping });
    }
    if is_bilinear && (view.has("second_stiffness") || view.has("yield")) {
        return bilinear(reader, view, second, yields);
    }
    match crush {
        Some(crush) if crushes => LawKind::Crushing(Crush {
            hertzian: kind == LawKind::Hertz,
            ..crush
        }),
        _ => kind,
    }
}

/// The bilinear law with K₂ and δ_y as read.
fn bilinear(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    second: Option<f64>,
    yields: Option<f64>,
) -> LawKind {
    for (key, example) in [
        ("second_stiffness", "\"120 MN/m\""),
        ("yield", "\"1.5 mm\""),
    ] {
        if !view.has(key) {
            reader.missing(view, key, format!("add {key} = {example}"));
        }
    }
    for key in ["yield_share", "design_speed"] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "cannot be combined with second_stiffness and yield") = Some(
                "leave it out: the law has its constants, or give restitution instead of these"
                    .into(),
            );
        }
    }
    // What is missing has been said.
    LawKind::BilinearGiven(BilinearConstants {
        second_stiffness: second.unwrap_or(1.0),
        yield_indentation: yields.unwrap_or(1.0),
    })
}

/// How a face crushes.
fn crush(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Crush> {
    let field = reader.get(view, "crush")?;
    let table = reader.open(&field, &[Section::Crush])?;
    let force = optional(reader, &table, "force", Dimension::Force);
    if !table.has("force") {
        reader.missing(&table, "force", "add force = \"600 kN\"");
    }
    let hardening = optional(reader, &table, "hardening", Dimension::Dimensionless);
    Some(Crush {
        force: force?,
        hardening: hardening.unwrap_or(0.0),
        hertzian: false,
    })
}

/// The contact stiffness in the unit of the law.
fn stiffness(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    kind: LawKind,
    law_is_bad: bool,
) -> Option<f64> {
    let Some(field) = reader.get(view, "stiffness") else {
        let usual = kind.is_hertzian() && !matches!(kind, LawKind::Formula(_));
        if !usual && kind != LawKind::Restitution && !law_is_bad {
            reader.missing(
                view,
                "stiffness",
                format!("the law {} has no usual stiffness; add stiffness = \"500 MN/m\", for example some ten times the stiffness of a storey", kind.name()),
            );
        }
        return None;
    };
    // With an unknown law, either unit may be right.
    if law_is_bad {
        return None;
    }
    let dimension = if kind.is_hertzian() {
        Dimension::HertzStiffness
    } else {
        Dimension::Stiffness
    };
    reader.quantity(&field, dimension)
}
