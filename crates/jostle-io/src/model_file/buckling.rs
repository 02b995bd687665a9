//! `hinge = { rule = "buckling" }` of `[[building.brace]]`.

use std::f64::consts::PI;

use jostle::hysteresis::{BucklingBrace, Hysteresis};
use jostle_section::BucklingCurve;

use super::steel_profile::SteelMember;
use crate::keys::{BUCKLING_CURVES, LINK_RULES};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Share of the buckling force after a brace was straightened, from fibre analyses of square tubes \[–\].
const LATER: f64 = 0.65;

/// Keys of braces that buckle, and of all others.
const KEYS: [&str; 7] = [
    "yield_strength",
    "curve",
    "buckling",
    "effective_length",
    "slenderness",
    "lever_arm",
    "later",
];
const OF_OTHERS: [&str; 7] = [
    "gamma",
    "pinching",
    "unloading_exponent",
    "damage",
    "cracking",
    "post_cracking",
    "residual",
];

/// Whether a brace buckles; `None` after a fault.
pub(super) fn asked(reader: &mut Reader<'_>, view: &View<'_>) -> Option<bool> {
    let Some(field) = reader.get(view, "rule") else {
        let rule = "add rule = \"buckling\", or \"bilinear\" if it does not buckle";
        reader.missing(view, "rule", rule);
        return None;
    };
    let rule = reader.choice(&field, LINK_RULES, &[])?;
    let buckles = rule == "buckling";
    let (needless, remedy) = match buckles {
        true => (OF_OTHERS, "remove"),
        false => (KEYS, "set rule = \"buckling\", or remove"),
    };
    let mut sound = true;
    for key in needless {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, format!("has no meaning with the rule {rule}")) =
                Some(format!("{remedy} {key}"));
            sound = false;
        }
    }
    sound.then_some(buckles)
}

/// A brace between two joints.
#[derive(Clone, Copy)]
pub(super) struct Strut {
    /// Axial force per elongation \[N/m\].
    pub(super) stiffness: f64,
    /// Length between the joints \[m\].
    pub(super) length: f64,
    /// Its profile, if it states one.
    pub(super) profile: Option<SteelMember>,
}

/// The spring of a brace that buckles; `None` after faults.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    view: &View<'_>,
    strut: Strut,
) -> Option<Hysteresis> {
    let mut number = |key: &'static str, dimension| match reader.get(view, key) {
        Some(field) => reader.positive(&field, dimension).map(Some),
        None => Some(None),
    };
    let strength = number("yield_strength", Dimension::Stress);
    let yielding = number("yield", Dimension::Force);
    let slenderness = number("slenderness", Dimension::Dimensionless);
    let lever_arm = number("lever_arm", Dimension::Length);
    let buckling = number("buckling", Dimension::Force);
    let later = number("later", Dimension::Dimensionless);
    let factor = number("effective_length", Dimension::Dimensionless);
    let post_yield = match reader.get(view, "post_yield") {
        Some(field) => reader.quantity(&field, Dimension::Dimensionless),
        None => Some(0.0),
    };
    let curve = match reader.get(view, "curve") {
        Some(field) => Some(reader.choice(&field, BUCKLING_CURVES, &[])?),
        None => None,
    };
    let (strength, yielding, buckling) = (strength?, yielding?, buckling?);
    let (slenderness, lever_arm, factor) = (slenderness?, lever_arm?, factor?.unwrap_or(1.0));
    if let (Some(_), None) = (strength, strut.profile) {
        let given = reader.get(view, "yield_strength")?;
        *reader.bad(&given, "has no meaning without a profile") =
            Some("add profile to the brace, or give yield, slenderness and lever_arm".into());
        return None;
    }
    // What profile and strength give stands in for what the table leaves out.
    let of_profile = strut.profile.zip(strength);
    let mut needed = |key: &'static str, given: Option<f64>, found: Option<f64>, example: &str| {
        let value = given.or(found);
        if value.is_none() {
            reader.missing(
                view,
                key,
                format!(
                    "add {key} = {example}; or a profile to the brace, and yield_strength here"
                ),
            );
        }
        value
    };
    let yield_force = needed(
        "yield",
        yielding,
        of_profile.map(|(steel_member, strength)| steel_member.profile.area() * strength),
        "\"900 kN\"",
    );
    let slender = |force: f64, member: SteelMember| {
        let length = factor * strut.length;
        let inertia = member.profile.inertia(member.axis);
        let euler = PI * PI * member.modulus * inertia / (length * length);
        (force / euler).sqrt()
    };
    let slenderness = needed(
        "slenderness",
        slenderness,
        yield_force.and_then(|force| Some(slender(force, strut.profile?))),
        "1.1",
    );
    let lever_arm = needed(
        "lever_arm",
        lever_arm,
        strut
            .profile
            .map(|profile| profile.profile.plastic_modulus(profile.axis) / profile.profile.area()),
        "\"60 mm\"",
    );
    let (yield_force, slenderness, lever_arm) = (yield_force?, slenderness?, lever_arm?);
    let buckling_force = match (curve, buckling) {
        (Some(_), Some(_)) => {
            let given = reader.get(view, "curve")?;
            *reader.bad(&given, "and buckling are both given") = Some("remove one of them".into());
            return None;
        }
        (None, Some(force)) => force,
        (Some(name), None) => BucklingCurve::named(name)?.share(slenderness) * yield_force,
        (None, None) => {
            let remedy = "add curve = \"c\" (cold-formed tubes by EN 1993-1-1, table 6.2) or \"aisc360\", or buckling = \"400 kN\"";
            reader.missing(view, "curve", remedy);
            return None;
        }
    };
    let brace = BucklingBrace {
        stiffness: strut.stiffness,
        yield_force,
        post_yield: post_yield?,
        buckling_force,
        later: later?.unwrap_or(LATER),
        slenderness,
        shortening: 2.0 * lever_arm * lever_arm / (factor * factor * strut.length),
    };
    match Hysteresis::buckling(brace) {
        Ok(spring) => Some(spring),
        Err(faults) => {
            for fault in faults {
                reader.bad(field, fault.problem);
            }
            None
        }
    }
}
