//! Stiffness and restitution for the contacts of a gap, estimated from slabs, material and colliding masses.

use jostle::contact::{
    HERTZ_DURATION, JANKOWSKI_HERTZ, LATERAL_FACTORS, Rod, Slab, SlabMaterial, USUAL_HERTZ,
    effective_mass, hertz_indentation, hertz_of_force, hertz_peak_force, hertz_stiffness,
    rod_collision, spring_of_duration, spring_of_force,
};
use jostle::interface::Contact;
use jostle::judgement::Stated;
use jostle::statics::stiffness_at;
use jostle::{Model, Summary, System};
use jostle_io::shown::MASS;
use jostle_io::{Dimension, parse_concrete, parse_quantity};
use jostle_report::ContactBox;
use jostle_section::StrengthLevel;
use serde::Serialize;

use crate::error::RunError;
use crate::opened::Opened;

/// What is known of the colliding floors, as written: numbers in SI, or with a unit. A value of two parts, such as
/// `12 m, 15 m`, is of the left and the right floor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdviceOptions {
    /// Masses, > 0; needed without a model.
    pub mass: Option<String>,
    /// Length of the slabs in the direction of the impact, > 0.
    pub length: Option<String>,
    /// Width of the slabs across it, > 0.
    pub width: Option<String>,
    /// Thickness of the slabs, > 0.
    pub thickness: Option<String>,
    /// Grade of concrete that gives the modulus.
    pub concrete: Option<String>,
    /// Modulus of elasticity instead, > 0.
    pub modulus: Option<String>,
    /// Poisson's ratio, 0 ≤ ν < 0.5.
    pub poisson_ratio: String,
    /// Density, > 0.
    pub density: String,
    /// Impact speed, > 0.
    pub speed: String,
}

impl Default for AdviceOptions {
    /// Concrete of 30 GPa, 0.2 and 2500 kg/m³, at 0.4 m/s.
    fn default() -> Self {
        Self {
            mass: None,
            length: None,
            width: None,
            thickness: None,
            concrete: None,
            modulus: None,
            poisson_ratio: "0.2".into(),
            density: "2500 kg/m3".into(),
            speed: "0.4 m/s".into(),
        }
    }
}

/// Stiffness and restitution for one pair of floors.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactAdvice {
    /// Names of the neighbours.
    pub between: [String; 2],
    /// Height of the contact; `null` without a model \[m\].
    pub height_m: Option<f64>,
    /// Colliding masses; `null` is a rigid wall \[kg\].
    pub masses_kg: [Option<f64>; 2],
    /// Impact speed \[m/s\].
    pub speed_m_s: f64,
    /// Young's moduli \[Pa\].
    pub moduli_pa: [f64; 2],
    /// Collision of the slabs as rods; `null` without their size.
    pub wave: Option<WaveAdvice>,
    /// Estimates of stiffness.
    pub estimates: Vec<StiffnessEstimate>,
    /// Recommended stiffness of the Hertz laws and its range \[N/m^1.5\].
    pub hertz: RangeAdvice,
    /// Recommended stiffness of the linear laws and its range; `null` without the size of the slabs \[N/m\].
    pub linear: Option<RangeAdvice>,
    /// What the habit of many studies gives for linear laws; `null` without a model, and where no building can be pushed.
    pub lateral: Option<LateralAdvice>,
    /// Recommended restitution and its range \[–\].
    pub restitution: RangeAdvice,
    /// What was assumed, and what to heed.
    pub notes: Vec<String>,
}

/// A value and the range in which it may lie.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RangeAdvice {
    /// Recommended value.
    pub value: f64,
    /// Lowest plausible value.
    pub low: f64,
    /// Highest plausible value.
    pub high: f64,
}

/// The rule of many studies: contact as a multiple of the lateral stiffness of the stiffer neighbour.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LateralAdvice {
    /// Name of the stiffer neighbour.
    pub of: String,
    /// Force on its struck floor ÷ displacement of that floor, the rest of the building free to follow \[N/m\].
    pub lateral_n_m: f64,
    /// Ten times that \[N/m\].
    pub low_n_m: f64,
    /// A hundred times that \[N/m\].
    pub high_n_m: f64,
}

/// The collision of two floors as elastic rods with distributed mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WaveAdvice {
    /// Times in which a wave runs along the left and the right floor \[s\].
    pub transit_s: [f64; 2],
    /// Greatest force \[N\].
    pub peak_force_n: f64,
    /// Time in contact \[s\].
    pub duration_s: f64,
    /// Apparent restitution of the centres of mass \[–\].
    pub restitution: f64,
}

/// One estimate.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StiffnessEstimate {
    /// Name.
    pub name: &'static str,
    /// `hertz` or `linear`.
    pub family: &'static str,
    /// Stiffness \[N/m^1.5 or N/m\].
    pub stiffness: f64,
    /// Unit of the stiffness.
    pub unit: &'static str,
    /// Peak force that an elastic collision of the masses has with it \[N\].
    pub peak_force_n: f64,
    /// Time in contact of that collision \[s\].
    pub duration_s: f64,
    /// Whether its assumptions hold here.
    pub is_valid: bool,
    /// Where it comes from.
    pub source: &'static str,
    /// What it assumes.
    pub validity: &'static str,
}

/// Restitution if nothing is stated \[–\].
const USUAL_RESTITUTION: f64 = 0.65;
/// Change of the restitution that `jostle run --sensitivity` makes \[–\].
const RESTITUTION_CHANGE: f64 = 0.15;
/// A Hertz contact must last this many times longer than a wave takes along a floor and back: below it, the floor is not
/// a rigid body with a local spring \[–\].
pub const LEAST_TRANSITS: f64 = 2.0;
/// Mass that stands for a rigid wall, relative to the floor \[–\].
const WALL: f64 = 1e9;

/// Advice on the contacts that a model has, or on two floors given by options alone.
///
/// Of every gap of a model, the pair of floors with the greatest effective mass is shown: there the force is greatest.
///
/// # Errors
/// [`RunError::Argument`] with the option first.
pub fn contact_advice(
    opened: Option<&Opened>,
    options: &AdviceOptions,
) -> Result<Vec<ContactAdvice>, RunError> {
    let known = Known::read(options)?;
    let Some(opened) = opened else {
        let Some(masses) = known.masses else {
            return Err(RunError::Argument(
                "--mass: is missing; give the colliding masses, such as --mass \"40 t, 60 t\", or a model".into(),
            ));
        };
        let names = ["left", "right"].map(str::to_owned);
        let known = known.with_stated([None; 2]);
        return Ok(vec![known.advise(names, None, masses.map(Some))]);
    };
    if opened.system.contacts.is_empty() {
        return Err(RunError::Argument("the model has no contact".into()));
    }
    let model = &opened.input.model;
    let stated = &opened.input.stated;
    let of_gap = |gap| of_contact(&known, model, stated, &opened.system, gap);
    Ok((0..model.gaps.len()).filter_map(of_gap).collect())
}

/// Advice on the contact of a gap with the greatest effective mass; `None` without a contact.
fn of_contact(
    known: &Known,
    model: &Model,
    stated: &Stated,
    system: &System,
    gap: usize,
) -> Option<ContactAdvice> {
    let contacts = system.contacts.iter().filter(|contact| contact.gap == gap);
    let contact = contacts.max_by(|a, b| a.effective_mass().total_cmp(&b.effective_mass()))?;
    let names = model.gaps[gap]
        .between
        .map(|side| system.side_name(side).to_owned());
    let masses = contact
        .struck_masses()
        .map(|mass| mass.is_finite().then_some(mass));
    let given = known.masses.map(|given| given.map(Some));
    let buildings = model.buildings_beside(model.gaps[gap].between);
    let known = known.with_stated(buildings.map(|side| stated.buildings.get(side?)?.modulus));
    let advice = known.advise(names, Some(contact.height), given.unwrap_or(masses));
    Some(ContactAdvice {
        lateral: lateral(system, contact),
        ..advice
    })
}

/// Multiples of the lateral stiffness of the stiffer building beside a contact.
fn lateral(system: &System, contact: &Contact) -> Option<LateralAdvice> {
    let ports = contact.ports.0.iter().flatten();
    let pushed = ports.filter_map(|port| {
        let building = &system.buildings[port.building];
        let at = port.row.moved_down(building.offset);
        Some((&building.name, stiffness_at(building.alone(), &at)?))
    });
    let (name, stiffness) = pushed.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let [low, high] = LATERAL_FACTORS.map(|factor| factor * stiffness);
    Some(LateralAdvice {
        of: name.clone(),
        lateral_n_m: stiffness,
        low_n_m: low,
        high_n_m: high,
    })
}

/// Contact data of a run for its report: what is used, and what masses and the greatest impact speed suggest.
pub(crate) fn contact_boxes(
    model: &Model,
    stated: &Stated,
    system: &System,
    summary: &Summary,
) -> Vec<ContactBox> {
    let Ok(mut known) = Known::read(&AdviceOptions::default()) else {
        return Vec::new();
    };
    let usual_speed = known.speed;
    let mut boxes = Vec::new();
    for (index, (gap, found)) in model.gaps.iter().zip(&summary.gaps).enumerate() {
        let impacts = found.contacts.iter().flat_map(|contact| &contact.impacts);
        let speeds = impacts.map(|impact| impact.impact_speed_m_s);
        let fastest = speeds.fold(0.0, f64::max);
        let impact_speed = (fastest > 0.0).then_some(fastest);
        known.speed = impact_speed.unwrap_or(usual_speed);
        let Some(advice) = of_contact(&known, model, stated, system, index) else {
            continue;
        };
        boxes.push(ContactBox {
            between: advice.between,
            law: gap.law.kind.full_name(),
            is_hertzian: gap.law.kind.is_hertzian(),
            stiffness: gap.law.stiffness,
            restitution: (!gap.law.kind.has_given_constants()).then_some(gap.law.restitution),
            hertz: [advice.hertz.value, advice.hertz.low, advice.hertz.high],
            restitution_range: [advice.restitution.low, advice.restitution.high],
            masses: advice.masses_kg,
            impact_speed,
        });
    }
    boxes
}

/// Options in SI.
#[derive(Clone)]
struct Known {
    masses: Option<[f64; 2]>,
    size: Option<[[f64; 2]; 3]>,
    material: [SlabMaterial; 2],
    /// Whether options name the modulus.
    modulus_is_given: bool,
    speed: f64,
    notes: Vec<String>,
}

impl Known {
    fn read(options: &AdviceOptions) -> Result<Self, RunError> {
        let mut notes = Vec::new();
        let masses = pair("--mass", options.mass.as_deref(), Dimension::Mass)?;
        let sizes = [
            ("--length", &options.length),
            ("--width", &options.width),
            ("--thickness", &options.thickness),
        ];
        let mut size = Vec::new();
        for (option, text) in sizes {
            size.extend(pair(option, text.as_deref(), Dimension::Length)?);
        }
        let size = match <[[f64; 2]; 3]>::try_from(size) {
            Ok(size) => Some(size),
            Err(some) if some.is_empty() => None,
            Err(_) => {
                return Err(RunError::Argument(
                    "--length, --width and --thickness: give all three, or none".into(),
                ));
            }
        };
        if size.is_none() {
            notes.push(
                "The size of the slabs is not known: with --length, --width and --thickness there are also E A/L and the estimate by waves.".to_owned(),
            );
        }
        let given = moduli(options)?;
        let moduli = given.unwrap_or([SlabMaterial::default().modulus; 2]);
        let ratio = parse_quantity(&options.poisson_ratio, Dimension::Dimensionless)
            .map_err(|error| RunError::Argument(format!("--poisson-ratio: {error}")))?;
        if !(0.0..0.5).contains(&ratio) {
            return Err(RunError::Argument(format!(
                "--poisson-ratio: must be at least 0 and below 0.5, found {ratio}"
            )));
        }
        let density = pair("--density", Some(&options.density), Dimension::Density)?;
        let density = density.unwrap_or([SlabMaterial::default().density; 2]);
        let speed = positive("--speed", &options.speed, Dimension::Speed)?;
        let material = [0, 1].map(|side| SlabMaterial {
            modulus: moduli[side],
            poisson_ratio: ratio,
            density: density[side],
        });
        Ok(Self {
            masses,
            size,
            material,
            modulus_is_given: given.is_some(),
            speed,
            notes,
        })
    }

    /// The same with the moduli that a model states for the concrete of its buildings, where no option names one.
    fn with_stated(&self, stated: [Option<f64>; 2]) -> Self {
        let mut copy = self.clone();
        if self.modulus_is_given {
            return copy;
        }
        // A wall is as stiff as the floor beside it.
        let moduli = [stated[0].or(stated[1]), stated[1].or(stated[0])];
        for (material, modulus) in copy.material.iter_mut().zip(moduli) {
            material.modulus = modulus.unwrap_or(material.modulus);
        }
        if moduli[0].is_none() {
            copy.notes.push(format!(
                "E = {:.0} GPa is assumed; state it with --concrete or --modulus.",
                1e-9 * copy.material[0].modulus
            ));
        }
        copy
    }

    fn advise(
        &self,
        between: [String; 2],
        height: Option<f64>,
        masses: [Option<f64>; 2],
    ) -> ContactAdvice {
        // A wall is as stiff as the floor, and far heavier.
        let heavy = [masses[1], masses[0]].map(|other| WALL * other.unwrap_or(1.0));
        let bodies = [0, 1].map(|side| masses[side].unwrap_or(heavy[side]));
        let effective = effective_mass(bodies[0], bodies[1]);
        let speed = self.speed;
        let mut notes = self.notes.clone();
        let slabs = self.size.map(|[length, width, thickness]| {
            [0, 1].map(|side| Slab {
                length: length[side],
                width: width[side],
                thickness: thickness[side],
                material: self.material[side],
                mass: bodies[side],
            })
        });
        let wave = slabs.and_then(|slabs| {
            let rods = [0, 1].map(|side| match masses[side] {
                Some(_) => slabs[side].rod(),
                None => wall_beside(slabs[1 - side].rod()),
            });
            let found = rod_collision(rods, speed)?;
            Some(WaveAdvice {
                transit_s: rods.map(|rod| rod.transit),
                peak_force_n: found.peak_force,
                duration_s: found.duration,
                restitution: found.restitution,
            })
        });
        if slabs.is_some() && wave.is_none() {
            notes.push("The floors differ too much in length for the estimate by waves.".into());
        }
        if let Some(slabs) = slabs {
            for side in [0, 1] {
                if let (Some(mass), slab_mass) = (masses[side], slabs[side].own_mass())
                    && mass < slab_mass
                {
                    notes.push(format!(
                        "The mass of {} is {}, less than the {} of its slab alone: check the size.",
                        between[side],
                        MASS.text(mass, 1),
                        MASS.text(slab_mass, 1)
                    ));
                }
            }
        }
        let estimates = self.estimates(bodies, effective, slabs, wave.as_ref());
        let hertz = of_family(&estimates, "hertz").unwrap_or(RangeAdvice {
            value: USUAL_HERTZ,
            low: USUAL_HERTZ,
            high: USUAL_HERTZ,
        });
        let linear = of_family(&estimates, "linear");
        ContactAdvice {
            between,
            height_m: height,
            masses_kg: masses,
            speed_m_s: speed,
            moduli_pa: self.material.map(|material| material.modulus),
            wave,
            estimates,
            hertz,
            linear,
            lateral: None,
            restitution: RangeAdvice {
                value: USUAL_RESTITUTION,
                low: USUAL_RESTITUTION - RESTITUTION_CHANGE,
                high: USUAL_RESTITUTION + RESTITUTION_CHANGE,
            },
            notes,
        }
    }

    /// Estimates; the first valid one of a family is recommended.
    fn estimates(
        &self,
        bodies: [f64; 2],
        effective: f64,
        slabs: Option<[Slab; 2]>,
        wave: Option<&WaveAdvice>,
    ) -> Vec<StiffnessEstimate> {
        let speed = self.speed;
        let mut estimates = Vec::new();
        let hertz = |name, stiffness: f64, is_valid, source, validity| {
            let indentation = hertz_indentation(stiffness, effective, speed);
            StiffnessEstimate {
                name,
                family: "hertz",
                stiffness,
                unit: "N/m^1.5",
                peak_force_n: hertz_peak_force(stiffness, effective, speed),
                duration_s: HERTZ_DURATION * indentation / speed,
                is_valid,
                source,
                validity,
            }
        };
        let linear = |name, stiffness: f64, is_valid, source, validity| StiffnessEstimate {
            name,
            family: "linear",
            stiffness,
            unit: "N/m",
            peak_force_n: speed * (stiffness * effective).sqrt(),
            duration_s: std::f64::consts::PI * (effective / stiffness).sqrt(),
            is_valid,
            source,
            validity,
        };
        let of_spheres = hertz_stiffness(self.material, bodies);
        let mut spheres = hertz(
            "Hertz, effective radius",
            of_spheres,
            true,
            "Goldsmith 1960; Muthukumar and DesRoches 2006",
            "local contact of rounded bodies that move as a whole: the contact lasts longer than two round trips of a wave along the shorter floor",
        );
        if let Some(wave) = wave {
            let longest = wave.transit_s[0].min(wave.transit_s[1]);
            spheres.is_valid = spheres.duration_s >= LEAST_TRANSITS * 2.0 * longest;
        }
        estimates.push(spheres);
        if let Some(wave) = wave {
            estimates.push(hertz(
                "Hertz, peak force of waves",
                hertz_of_force(effective, speed, wave.peak_force_n),
                true,
                "wave equation of two rods (Goldsmith 1960; Cole et al. 2011), at this speed",
                "plane faces that meet over the whole section, elastic; depends on the speed",
            ));
        }
        for (name, stiffness, source) in [
            (
                "usual in studies",
                USUAL_HERTZ,
                "Muthukumar and DesRoches 2006; default of jostle",
            ),
            (
                "fitted to a test",
                JANKOWSKI_HERTZ,
                "Jankowski 2005, concrete elements",
            ),
        ] {
            let validity = "fitted or assumed for other bodies: an order of magnitude";
            estimates.push(hertz(name, stiffness, true, source, validity));
        }
        if let (Some(slabs), Some(wave)) = (slabs, wave) {
            estimates.push(linear(
                "waves, same peak force",
                spring_of_force(effective, speed, wave.peak_force_n),
                true,
                "wave equation of two rods (Goldsmith 1960; Cole et al. 2011); E A/2L for equal floors",
                "plane faces that meet over the whole section, elastic",
            ));
            estimates.push(linear(
                "waves, same duration",
                spring_of_duration(effective, wave.duration_s),
                true,
                "wave equation of two rods; π²/8 · E A/L for equal floors",
                "as above",
            ));
            let [k1, k2] = slabs.map(|slab| slab.axial_stiffness());
            estimates.push(linear(
                "E A/L, both floors in series",
                k1 * k2 / (k1 + k2),
                true,
                "axial stiffness of the floors",
                "floors compressed evenly over their length",
            ));
            estimates.push(linear(
                "E A/L of the softer floor",
                k1.min(k2),
                true,
                "axial stiffness of one floor against a rigid one",
                "as above",
            ));
        }
        estimates
    }
}

/// A rod that does not move and does not yield beside another one.
fn wall_beside(rod: Rod) -> Rod {
    Rod {
        transit: 100.0 * rod.transit,
        impedance: WALL * rod.impedance,
    }
}

/// The first valid estimate, within all of its family.
fn of_family(estimates: &[StiffnessEstimate], family: &str) -> Option<RangeAdvice> {
    let estimates = || {
        estimates
            .iter()
            .filter(|estimate| estimate.family == family)
    };
    let value = estimates().find(|estimate| estimate.is_valid)?.stiffness;
    let valid = || estimates().filter(|estimate| estimate.is_valid);
    Some(RangeAdvice {
        value,
        low: valid().map(|e| e.stiffness).fold(value, f64::min),
        high: valid().map(|e| e.stiffness).fold(value, f64::max),
    })
}

fn moduli(options: &AdviceOptions) -> Result<Option<[f64; 2]>, RunError> {
    match (&options.modulus, &options.concrete) {
        (Some(_), Some(_)) => Err(RunError::Argument(
            "--concrete: cannot be combined with --modulus".into(),
        )),
        (Some(text), None) => pair("--modulus", Some(text), Dimension::Modulus),
        (None, Some(text)) => {
            let concrete = parse_concrete(text, StrengthLevel::Characteristic)
                .map_err(|problem| RunError::Argument(format!("--concrete: {problem}")))?;
            Ok(Some([concrete.modulus; 2]))
        }
        (None, None) => Ok(None),
    }
}

/// One value for both floors, or two with a comma.
fn pair(
    option: &str,
    text: Option<&str>,
    dimension: Dimension,
) -> Result<Option<[f64; 2]>, RunError> {
    let Some(text) = text else { return Ok(None) };
    let parts: Vec<&str> = text.split(',').collect();
    match parts[..] {
        [one] => positive(option, one, dimension).map(|value| Some([value; 2])),
        [left, right] => Ok(Some([
            positive(option, left, dimension)?,
            positive(option, right, dimension)?,
        ])),
        _ => Err(RunError::Argument(format!(
            "{option}: expected one value, or one for the left and one for the right floor, found {text}"
        ))),
    }
}

fn positive(option: &str, text: &str, dimension: Dimension) -> Result<f64, RunError> {
    let value = parse_quantity(text.trim(), dimension)
        .map_err(|error| RunError::Argument(format!("{option}: {error}")))?;
    if value > 0.0 {
        return Ok(value);
    }
    Err(RunError::Argument(format!(
        "{option}: must be greater than zero, found {text}"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slabs() -> AdviceOptions {
        AdviceOptions {
            mass: Some("45 t".into()),
            length: Some("12 m".into()),
            width: Some("10 m".into()),
            thickness: Some("150 mm".into()),
            modulus: Some("30 GPa".into()),
            ..AdviceOptions::default()
        }
    }

    fn advise(options: &AdviceOptions) -> ContactAdvice {
        let found = contact_advice(None, options).unwrap_or_else(|error| panic!("{error}"));
        found.into_iter().next().expect("one pair")
    }

    fn of<'a>(advice: &'a ContactAdvice, name: &str) -> &'a StiffnessEstimate {
        let found = advice.estimates.iter().find(|e| e.name == name);
        found.unwrap_or_else(|| panic!("no {name}"))
    }

    /// Two slabs of 45 t, their own weight: E A/L = 30 GPa · 1.5 m²/12 m = 3.75 GN/m; waves 1/2 and π²/8 of it.
    #[test]
    fn equal_slabs_have_the_multiples_of_the_wave_equation() {
        let advice = advise(&slabs());
        let relative = |name| of(&advice, name).stiffness / 3.75e9;
        assert!((relative("E A/L of the softer floor") - 1.0).abs() < 1e-12);
        assert!((relative("E A/L, both floors in series") - 0.5).abs() < 1e-12);
        assert!((relative("waves, same peak force") - 0.5).abs() < 1e-9);
        assert!((relative("waves, same duration") - 1.233_70).abs() < 1e-5);
        let wave = advice.wave.expect("the size is known");
        // c = √(30e9/2500) = 3464.1 m/s: 2 · 12/3464.1 = 6.928 ms; F = 2500 · 3464.1 · 1.5 · 0.4/2 = 2598 kN.
        assert!((1e3 * wave.duration_s - 6.928).abs() < 1e-3);
        assert!((1e-3 * wave.peak_force_n - 2598.1).abs() < 0.1);
        assert!((wave.restitution - 1.0).abs() < 1e-9);
        // The linear spring of the same force gives that force.
        let same = of(&advice, "waves, same peak force");
        assert!((same.peak_force_n / wave.peak_force_n - 1.0).abs() < 1e-9);
        let linear = advice.linear.expect("the size is known");
        assert!(linear.low <= linear.value && linear.value <= linear.high);
    }

    /// Hertz is a local spring between rigid bodies: long slabs, in which waves take longer than the contact lasts, are
    /// outside its validity, and the range then leaves it out.
    #[test]
    fn hertz_is_not_valid_when_waves_are_slower() {
        let short = advise(&AdviceOptions {
            length: Some("3 m".into()),
            mass: Some("100 t".into()),
            speed: "0.01 m/s".into(),
            width: Some("20 m".into()),
            ..slabs()
        });
        assert!(of(&short, "Hertz, effective radius").is_valid);
        let long = advise(&AdviceOptions {
            length: Some("90 m".into()),
            ..slabs()
        });
        let spheres = of(&long, "Hertz, effective radius");
        assert!(!spheres.is_valid, "{spheres:?}");
        assert_ne!(long.hertz.value, spheres.stiffness);
    }

    #[test]
    fn masses_alone_give_hertz_only() {
        let advice = advise(&AdviceOptions {
            mass: Some("40 t, 60 t".into()),
            ..AdviceOptions::default()
        });
        assert_eq!((advice.wave, advice.linear), (None, None));
        assert_eq!(advice.masses_kg, [Some(40e3), Some(60e3)]);
        // R = (3 · 40e3/(4π · 2500))^⅓ = 1.5632 and 1.7894 m; k = 4/3 · 30e9/(2 · 0.96) · √0.83435 = 1.9030e10.
        assert!(
            (advice.hertz.value / 1.9030e10 - 1.0).abs() < 1e-4,
            "{:?}",
            advice.hertz
        );
        assert_eq!(advice.hertz.low, 2e9);
        assert_eq!(advice.notes.len(), 2, "{:?}", advice.notes);
    }

    #[test]
    fn wrong_options_are_named() {
        let wrong = |change: fn(&mut AdviceOptions)| {
            let mut options = slabs();
            change(&mut options);
            let error = contact_advice(None, &options).expect_err("it is wrong");
            error.to_string()
        };
        assert!(wrong(|o| o.mass = None).starts_with("--mass: is missing"));
        assert!(wrong(|o| o.mass = Some("-1 t".into())).starts_with("--mass: must be"));
        assert!(wrong(|o| o.length = Some("12".to_owned() + " kg")).starts_with("--length: "));
        assert!(wrong(|o| o.width = None).starts_with("--length, --width and --thickness"));
        assert!(wrong(|o| o.poisson_ratio = "0.5".into()).starts_with("--poisson-ratio: "));
        assert!(wrong(|o| o.concrete = Some("C30".into())).starts_with("--concrete: "));
        assert!(wrong(|o| o.thickness = Some("1 m, 2 m, 3 m".into())).starts_with("--thickness: "));
        assert!(wrong(|o| o.speed = "0 m/s".into()).starts_with("--speed: must be"));
    }

    /// A rigid wall: F = ρ c A v, as if two equal slabs met at twice the speed.
    #[test]
    fn a_wall_is_hit_with_twice_the_force() {
        let known = Known::read(&slabs()).unwrap_or_else(|error| panic!("{error}"));
        let names = ["floor", "wall"].map(str::to_owned);
        let advice = known.advise(names, None, [Some(45e3), None]);
        let wave = advice.wave.expect("the size is known");
        assert!((1e-3 * wave.peak_force_n - 2.0 * 2598.1).abs() < 0.2);
        assert_eq!(advice.masses_kg, [Some(45e3), None]);
    }
}
