//! Two free masses under contact laws.

use jostle::contact::{
    BilinearShape, Dashpot, DashpotLaw, ForceLaw, Formula, FreeCollision, ModifiedKelvin,
    RubberBumper, effective_mass, hertz_indentation,
};
use jostle::{ContactLaw, LawKind, RestitutionIs};
use jostle_io::shown::{HERTZ_STIFFNESS, STIFFNESS};
use jostle_io::{Dimension, LAW_NAMES, parse_quantity};
use jostle_report::{CollidedLaw, Collisions, with_three_digits};
use serde_json::{Value, json};

use crate::error::RunError;

/// Variants of `modified-kelvin`.
const VARIANTS: [&str; 2] = ["ye", "mahmoud-jankowski"];
/// What a coefficient of restitution means.
const MEANINGS: [&str; 2] = ["input", "realised"];

/// Two masses and the contact between them, as written: numbers in SI, or with a unit.
#[derive(Clone, Debug)]
pub struct CollideOptions {
    /// Contact law.
    pub law: String,
    /// A formula of the force instead; `None` for none.
    pub formula: Option<String>,
    /// Every law instead; those that cannot realise the restitution are left out.
    pub all: bool,
    /// Mass of the left body, > 0.
    pub m1: String,
    /// Mass of the right body, > 0.
    pub m2: String,
    /// Closing speed at the beginning of the contact, > 0.
    pub speed: String,
    /// Contact stiffness of either family, > 0; `None` is 2e9 N/m^1.5.
    pub stiffness: Option<String>,
    /// Coefficient of restitution, above 0 and at most 1.
    pub restitution: String,
    /// `input` or `realised`.
    pub restitution_is: String,
    /// Dashpot instead of the restitution, ≥ 0, for `kelvin`, `kelvin-no-tension` and `modified-kelvin` after Mahmoud and
    /// Jankowski.
    pub damping: Option<String>,
    /// `ye` or `mahmoud-jankowski`, for `modified-kelvin`.
    pub variant: String,
    /// Yield indentation over the greatest design indentation, above 0 and below 0.5, for `bilinear`.
    pub yield_share: String,
    /// Speed that the stiffnesses of `bilinear` are computed for; `None` is `speed`.
    pub design_speed: Option<String>,
    /// Thickness of the bumper, > 0, for `rubber`.
    pub thickness: String,
    /// Exponent of the compression, 1 to 6, for `rubber`.
    pub exponent: String,
}

impl Default for CollideOptions {
    /// Everything but masses and speed, which have no usual value.
    fn default() -> Self {
        Self {
            law: "hertz-damp".into(),
            formula: None,
            all: false,
            m1: String::new(),
            m2: String::new(),
            speed: String::new(),
            stiffness: None,
            restitution: "0.65".into(),
            restitution_is: MEANINGS[0].into(),
            damping: None,
            variant: VARIANTS[0].into(),
            yield_share: "0.1".into(),
            design_speed: None,
            thickness: "50 mm".into(),
            exponent: "2.65".into(),
        }
    }
}

fn known(option: &str, found: &str, names: &[&str]) -> Result<(), RunError> {
    if names.contains(&found) {
        return Ok(());
    }
    Err(RunError::Argument(format!(
        "{option}: expected {}, found \"{found}\"",
        names.join(", ")
    )))
}

/// The collisions that options ask for.
///
/// # Errors
/// [`RunError::Argument`] with the option first.
pub fn collide(options: &CollideOptions) -> Result<Collisions, RunError> {
    known("--law", &options.law, &LAW_NAMES)?;
    known("--variant", &options.variant, &VARIANTS)?;
    known("--restitution-is", &options.restitution_is, &MEANINGS)?;
    let positive = |option: &str, text: &str, dimension| {
        let value = parse_quantity(text, dimension)
            .map_err(|error| RunError::Argument(format!("{option}: {error}")))?;
        if value > 0.0 {
            Ok(value)
        } else {
            Err(RunError::Argument(format!(
                "{option}: must be greater than zero, found {text}"
            )))
        }
    };
    let masses = [
        positive("--m1", &options.m1, Dimension::Mass)?,
        positive("--m2", &options.m2, Dimension::Mass)?,
    ];
    let speed = positive("--speed", &options.speed, Dimension::Speed)?;
    let restitution = positive(
        "--restitution",
        &options.restitution,
        Dimension::Dimensionless,
    )?;
    if restitution > 1.0 {
        return Err(RunError::Argument(format!(
            "--restitution: must be greater than 0 and at most 1, found {restitution}"
        )));
    }
    let shape = BilinearShape {
        yield_share: positive(
            "--yield-share",
            &options.yield_share,
            Dimension::Dimensionless,
        )?,
        design_speed: options
            .design_speed
            .as_ref()
            .map(|text| positive("--design-speed", text, Dimension::Speed))
            .transpose()?,
    };
    if shape.yield_share >= 0.5 {
        return Err(RunError::Argument(format!(
            "--yield-share: must lie between 0 and 0.5, found {}",
            shape.yield_share
        )));
    }
    let bumper = RubberBumper {
        thickness: positive("--thickness", &options.thickness, Dimension::Length)?,
        exponent: positive("--exponent", &options.exponent, Dimension::Dimensionless)?,
    };
    if !(1.0..=6.0).contains(&bumper.exponent) {
        return Err(RunError::Argument(format!(
            "--exponent: must lie between 1 and 6, found {}",
            bumper.exponent
        )));
    }
    let kinds = match &options.formula {
        None => kinds(options, shape, bumper),
        Some(text) => vec![LawKind::Formula(Formula::parse(text).map_err(|error| {
            RunError::Argument(format!("--formula \"{text}\": {error}"))
        })?)],
    };
    let energy = effective_mass(masses[0], masses[1]) * speed * speed;
    let stiffness = Stiffness::read(options, &kinds, energy)?;
    let restitution_is = if options.restitution_is == "realised" {
        RestitutionIs::Realised
    } else {
        RestitutionIs::Input
    };
    let kinds = match &options.damping {
        Some(text) => vec![given_dashpot(options, &kinds, text)?],
        None => kinds,
    };
    let mut laws = Vec::new();
    for kind in kinds {
        let law = ContactLaw {
            kind,
            stiffness: stiffness.for_law(kind),
            restitution,
            restitution_is,
        };
        let least = law.least_restitution();
        if restitution <= least {
            if options.all {
                continue;
            }
            return Err(RunError::Argument(format!(
                "--restitution: {} cannot realise {restitution}; at least {least:.4}",
                kind.name()
            )));
        }
        let numbers = law.between(masses[0], masses[1]);
        if let (ForceLaw::Formula(formula), LawKind::Formula(text)) = (numbers, kind)
            && let Some(problem) = formula.fault()
        {
            return Err(RunError::Argument(format!(
                "--formula \"{text}\" {problem}"
            )));
        }
        let ratio = numbers.damping_ratio(effective_mass(masses[0], masses[1]));
        if numbers.jumps_at_release() && ratio.is_some_and(|ratio| ratio >= 1.0) {
            return Err(RunError::Argument(format!(
                "--damping: damps these masses beyond critical, ζ = {:.2}: under kelvin, which may pull, they never part; use --law kelvin-no-tension, or less",
                ratio.unwrap_or_default()
            )));
        }
        laws.push(CollidedLaw {
            law,
            collision: FreeCollision::new(&numbers, masses[0], masses[1], speed),
        });
    }
    let dashpot = laws
        .first()
        .map_or_else(String::new, |law| dashpot_words(law, masses));
    let stiffnesses = dashpot
        + &format!(
            "Stiffness {} for the Hertz family, {} for the others: the same secant at the greatest elastic Hertz indentation.",
            with_three_digits(HERTZ_STIFFNESS.of(stiffness.hertz), HERTZ_STIFFNESS.name()),
            with_three_digits(STIFFNESS.of(stiffness.linear), STIFFNESS.name())
        );
    let by_restitution = laws.iter().any(|law| !law.law.kind.has_given_constants());
    Ok(Collisions {
        masses,
        speed,
        restitution: by_restitution.then_some(restitution),
        stiffnesses,
        laws,
    })
}

/// The law of these with a dashpot in place of its restitution.
fn given_dashpot(
    options: &CollideOptions,
    kinds: &[LawKind],
    text: &str,
) -> Result<LawKind, RunError> {
    let law = match kinds {
        [LawKind::Kelvin] => DashpotLaw::Kelvin,
        [LawKind::KelvinNoTension] => DashpotLaw::KelvinNoTension,
        [LawKind::ModifiedKelvin(ModifiedKelvin::MahmoudJankowski)] => DashpotLaw::Approach,
        _ => {
            return Err(RunError::Argument(format!(
                "--damping: belongs to the laws kelvin, kelvin-no-tension and modified-kelvin with --variant mahmoud-jankowski, not to {}",
                if options.all { "--all" } else { &options.law }
            )));
        }
    };
    let damping = parse_quantity(text, Dimension::Damping)
        .map_err(|error| RunError::Argument(format!("--damping: {error}")))?;
    if damping < 0.0 {
        return Err(RunError::Argument(format!(
            "--damping: must not be negative, found {text}"
        )));
    }
    Ok(LawKind::Dashpot(Dashpot { law, damping }))
}

/// What a given dashpot stands for between these masses \[kg\]; empty without one.
fn dashpot_words(law: &CollidedLaw, masses: [f64; 2]) -> String {
    let LawKind::Dashpot(dashpot) = law.law.kind else {
        return String::new();
    };
    let numbers = law.law.between(masses[0], masses[1]);
    let ratio = numbers.damping_ratio(effective_mass(masses[0], masses[1]));
    let ratio = ratio.unwrap_or_default();
    format!(
        "Dashpot {:.4e} N.s/m: damping ratio {ratio:.4}, which is that of restitution {:.4} in the published formula. ",
        dashpot.damping,
        dashpot.law.equivalent_restitution(ratio)
    )
}

fn kinds(options: &CollideOptions, shape: BilinearShape, bumper: RubberBumper) -> Vec<LawKind> {
    let with_parameters = |kind| match kind {
        LawKind::Bilinear(_) => LawKind::Bilinear(shape),
        LawKind::Rubber(_) => LawKind::Rubber(bumper),
        other => other,
    };
    let all = LawKind::ALL.into_iter().map(with_parameters);
    if options.all {
        return all.collect();
    }
    let variant = ModifiedKelvin::MahmoudJankowski;
    let wanted = |kind: &LawKind| {
        kind.name() == options.law
            && kind
                .variant()
                .is_none_or(|found| (found == variant) == (options.variant == variant.name()))
    };
    all.filter(wanted).collect()
}

/// The stiffness in the units of both families.
struct Stiffness {
    hertz: f64,
    linear: f64,
}

impl Stiffness {
    /// Reads it in either unit; a bare number is in that of the law. The other follows from k_linear = k_Hertz √δ with
    /// δ = (5 m v²/(4k))^0.4; `energy` is m v².
    fn read(options: &CollideOptions, kinds: &[LawKind], energy: f64) -> Result<Self, RunError> {
        let bare_is_hertzian = options.all || kinds.iter().any(|kind| kind.is_hertzian());
        let (first, second) = if bare_is_hertzian {
            (Dimension::HertzStiffness, Dimension::Stiffness)
        } else {
            (Dimension::Stiffness, Dimension::HertzStiffness)
        };
        let text = options.stiffness.as_deref().unwrap_or("2e9 N/m^1.5");
        let (value, dimension) = match parse_quantity(text, first) {
            Ok(value) => (value, first),
            Err(error) => match parse_quantity(text, second) {
                Ok(value) => (value, second),
                Err(_) => return Err(RunError::Argument(format!("--stiffness: {error}"))),
            },
        };
        if value <= 0.0 {
            return Err(RunError::Argument(format!(
                "--stiffness: must be greater than zero, found {text}"
            )));
        }
        let hertz = if dimension == Dimension::HertzStiffness {
            value
        } else {
            libm::pow(value / libm::pow(1.25 * energy, 0.2), 1.25)
        };
        let linear = if dimension == Dimension::Stiffness {
            value
        } else {
            hertz * hertz_indentation(hertz, energy, 1.0).sqrt()
        };
        Ok(Self { hertz, linear })
    }

    fn for_law(&self, kind: LawKind) -> f64 {
        if kind.is_hertzian() {
            self.hertz
        } else {
            self.linear
        }
    }
}

/// The numbers of a collision as the JSON of `jostle collide`.
#[must_use]
pub fn collision_json(collided: &CollidedLaw) -> Value {
    let CollidedLaw { law, collision } = collided;
    let variant = law.kind.variant().map(ModifiedKelvin::name);
    json!({
        "law": law.kind.name(),
        "variant": variant,
        "stiffness": law.stiffness,
        "stiffness_unit": if law.kind.is_hertzian() { "N/m^1.5" } else { "N/m" },
        "restitution": (!law.kind.has_given_constants()).then_some(law.restitution),
        "damping_n_s_m": match law.kind {
            LawKind::Dashpot(dashpot) => Some(dashpot.damping),
            _ => None,
        },
        "impact_speed_m_s": collision.impact_speed,
        "separation_speed_m_s": collision.separation_speed,
        "realised_restitution": collision.realised_restitution(),
        "peak_force_n": collision.peak_force,
        "peak_force_at_s": collision.peak_force_at,
        "least_force_n": collision.least_force,
        "peak_indentation_m": collision.peak_indentation,
        "duration_s": collision.duration,
        "impulse_n_s": collision.impulse,
        "dissipated_j": collision.dissipated,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(law: &str, damping: &str) -> CollideOptions {
        CollideOptions {
            law: law.into(),
            m1: "100 t".into(),
            m2: "70 t".into(),
            speed: "0.5 m/s".into(),
            stiffness: Some("200 MN/m".into()),
            damping: Some(damping.into()),
            ..CollideOptions::default()
        }
    }

    /// e = exp(−πζ/√(1 − ζ²)) with ζ = c/(2√(k m)).
    #[test]
    fn a_dashpot_rebounds_by_its_damping_ratio() {
        let found = collide(&options("kelvin", "1.1 MN.s/m")).unwrap_or_else(|e| panic!("{e}"));
        let mass = 1e5 * 7e4 / 1.7e5_f64;
        let ratio = 1.1e6 / (2.0 * (2e8 * mass).sqrt());
        let due = (-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt()).exp();
        let law = &found.laws[0];
        assert!((law.collision.realised_restitution() - due).abs() < 1e-9);
        assert!(
            found.stiffnesses.contains("restitution 0.5415"),
            "{}",
            found.stiffnesses
        );
        let json = collision_json(law);
        assert_eq!(json["damping_n_s_m"], 1.1e6);
        assert_eq!(json["restitution"], Value::Null);
    }

    #[test]
    fn dashpots_that_do_not_fit_are_refused() {
        let refused = |law: &str, damping: &str| {
            let error = collide(&options(law, damping))
                .map(drop)
                .expect_err("it is wrong");
            error.to_string()
        };
        let found = refused("hertz-damp", "1 MN.s/m");
        assert!(
            found.starts_with("--damping: belongs to the laws kelvin"),
            "{found}"
        );
        let found = refused("kelvin", "-1 MN.s/m");
        assert!(
            found.starts_with("--damping: must not be negative"),
            "{found}"
        );
        let found = refused("kelvin", "9 MN.s/m");
        assert!(
            found.contains("they never part; use --law kelvin-no-tension"),
            "{found}"
        );
        assert!(collide(&options("kelvin-no-tension", "9 MN.s/m")).is_ok());
    }
}
