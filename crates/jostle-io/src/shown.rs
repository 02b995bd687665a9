//! Units in which texts and pages show results: SI, or US customary units on request.
//!
//! Results are SI numbers until they are written. [`FORCE`] and its like say the name and the size of the unit that holds.
//! Which system holds belongs to the thread that writes, as the language of pages does: [`in_units`] begins a text,
//! [`by_model`] takes what the model file asks for. Files whose names of columns and keys carry SI units stay in SI.

use std::cell::Cell;
use std::sync::OnceLock;

use jostle::statics::STANDARD_GRAVITY;

use crate::unit::{FOOT, INCH, POUND, POUND_FORCE};

/// A system of units for what is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Units {
    /// mm, m, kN, kN·m, MPa, t.
    #[default]
    Si,
    /// in, ft, kip, kip·ft, ksi; masses as their weight in kip.
    Us,
}

impl Units {
    /// The system that model files and `--units` call so: `si` or `us`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "si" => Some(Self::Si),
            "us" => Some(Self::Us),
            _ => None,
        }
    }
}

/// What a text or a page shows, with its unit in each system.
#[derive(Clone, Copy, Debug)]
pub struct Shown {
    si: (&'static str, f64),
    us: (&'static str, f64),
    /// Fewest decimals of a number in US units: an inch is 25 mm, a kip 4.4 kN.
    least: usize,
}

const KIP: f64 = 1e3 * POUND_FORCE;
/// √0.0254 m.
const ROOT_OF_INCH: f64 = 0.159_373_774_505_092_27;
const KSI: f64 = KIP / (INCH * INCH);

const fn shown(si: (&'static str, f64), us: (&'static str, f64), least: usize) -> Shown {
    Shown { si, us, least }
}

/// A gap, an indentation, a displacement, a side of a section \[m\].
pub const LENGTH: Shown = shown(("mm", 1e-3), ("in", INCH), 2);
/// A height, a span, a place \[m\].
pub const HEIGHT: Shown = shown(("m", 1.0), ("ft", FOOT), 1);
/// A force or a weight \[N\].
pub const FORCE: Shown = shown(("kN", 1e3), ("kip", KIP), 1);
/// The same where it is typed without prefix \[N\].
pub const NEWTON: Shown = shown(("N", 1.0), ("kip", KIP), 1);
/// The same where it is large \[N\].
pub const MEGANEWTON: Shown = shown(("MN", 1e6), ("kip", KIP), 0);
/// A moment \[N·m\].
pub const MOMENT: Shown = shown(("kN·m", 1e3), ("kip·ft", KIP * FOOT), 1);
/// The same of a whole building \[N·m\].
pub const LARGE_MOMENT: Shown = shown(("MN·m", 1e6), ("kip·ft", KIP * FOOT), 0);
/// An impulse \[N·s\].
pub const IMPULSE: Shown = shown(("kN·s", 1e3), ("kip·s", KIP), 1);
/// An energy \[J\].
pub const ENERGY: Shown = shown(("kJ", 1e3), ("kip·in", KIP * INCH), 1);
/// A force per length of a face \[N/m\].
pub const LINE_LOAD: Shown = shown(("kN/m", 1e3), ("kip/ft", KIP / FOOT), 2);
/// A stiffness against displacement \[N/m\].
pub const STIFFNESS: Shown = shown(("N/m", 1.0), ("kip/in", KIP / INCH), 1);
/// The same where it is large \[N/m\].
pub const LARGE_STIFFNESS: Shown = shown(("MN/m", 1e6), ("kip/in", KIP / INCH), 1);
/// A stiffness against rotation \[N·m/rad\].
pub const ROTATIONAL_STIFFNESS: Shown = shown(("MN·m/rad", 1e6), ("kip·ft/rad", KIP * FOOT), 0);
/// The same without prefix \[N·m/rad\].
pub const TURNING_STIFFNESS: Shown = shown(("N·m/rad", 1.0), ("kip·ft/rad", KIP * FOOT), 0);
/// A dashpot against rotation \[N·m·s/rad\].
pub const TURNING_DASHPOT: Shown = shown(("N·m·s/rad", 1.0), ("kip·ft·s/rad", KIP * FOOT), 0);
/// A contact stiffness of Hertz's law \[N/m^1.5\].
pub const HERTZ_STIFFNESS: Shown = shown(
    ("N/m^1.5", 1.0),
    ("kip/in^1.5", KIP / (INCH * ROOT_OF_INCH)),
    1,
);
/// A flexural rigidity \[N·m²\].
pub const RIGIDITY: Shown = shown(("N·m²", 1.0), ("kip·in²", KIP * INCH * INCH), 0);
/// The same of a wall \[N·m²\].
pub const LARGE_RIGIDITY: Shown = shown(("GN·m²", 1e9), ("kip·ft²", KIP * FOOT * FOOT), 0);
/// A rigidity against stretching or shear of a wall \[N\].
pub const LARGE_FORCE: Shown = shown(("GN", 1e9), ("kip", KIP), 0);
/// The constant of a dashpot \[N·s/m\].
pub const DASHPOT: Shown = shown(("N·s/m", 1.0), ("kip·s/in", KIP / INCH), 2);
/// The same where it is large \[N·s/m\].
pub const LARGE_DASHPOT: Shown = shown(("kN·s/m", 1e3), ("kip·s/in", KIP / INCH), 2);
/// A stress or a strength \[Pa\].
pub const STRESS: Shown = shown(("MPa", 1e6), ("ksi", KSI), 2);
/// An elastic modulus \[Pa\].
pub const MODULUS: Shown = shown(("GPa", 1e9), ("ksi", KSI), 0);
/// A pressure on soil or over a floor \[Pa\].
pub const PRESSURE: Shown = shown(("kPa", 1e3), ("ksf", KIP / (FOOT * FOOT)), 2);
/// An area of a floor \[m²\].
pub const AREA: Shown = shown(("m²", 1.0), ("ft²", FOOT * FOOT), 0);
/// A mass per area \[kg/m²\]; in US units its weight.
pub const AREA_MASS: Shown = shown(("kg/m²", 1.0), ("psf", POUND / (FOOT * FOOT)), 0);
/// A mass \[kg\]; in US units its weight.
pub const MASS: Shown = shown(("t", 1e3), ("kip", 1e3 * POUND), 0);
/// A mass per length \[kg/m\]; in US units its weight.
pub const LINE_MASS: Shown = shown(("kg/m", 1.0), ("kip/ft", 1e3 * POUND / FOOT), 3);
/// A speed of impact \[m/s\].
pub const SPEED: Shown = shown(("m/s", 1.0), ("in/s", INCH), 1);
/// A spectral speed \[m/s\].
pub const SMALL_SPEED: Shown = shown(("mm/s", 1e-3), ("in/s", INCH), 2);
/// An acceleration \[m/s²\].
pub const ACCELERATION: Shown = shown(("m/s²", 1.0), ("g", STANDARD_GRAVITY), 3);
/// A peak of the ground \[m/s²\].
pub const GROUND_ACCELERATION: Shown = shown(("cm/s²", 1e-2), ("g", STANDARD_GRAVITY), 3);
/// The speed of the ground \[m/s\].
pub const GROUND_SPEED: Shown = shown(("cm/s", 1e-2), ("in/s", INCH), 1);
/// The displacement of the ground \[m\].
pub const GROUND_DISPLACEMENT: Shown = shown(("cm", 1e-2), ("in", INCH), 2);

/// Every quantity that is shown. Messages name a unit by its SI name in braces, `[{kN}]`; scripts by `unitOf("kN")`.
pub const ALL_SHOWN: &[Shown] = &[
    LENGTH,
    HEIGHT,
    FORCE,
    NEWTON,
    MEGANEWTON,
    MOMENT,
    LARGE_MOMENT,
    IMPULSE,
    ENERGY,
    LINE_LOAD,
    STIFFNESS,
    LARGE_STIFFNESS,
    ROTATIONAL_STIFFNESS,
    TURNING_STIFFNESS,
    TURNING_DASHPOT,
    HERTZ_STIFFNESS,
    RIGIDITY,
    LARGE_RIGIDITY,
    LARGE_FORCE,
    DASHPOT,
    LARGE_DASHPOT,
    STRESS,
    MODULUS,
    PRESSURE,
    AREA,
    AREA_MASS,
    MASS,
    LINE_MASS,
    SPEED,
    SMALL_SPEED,
    ACCELERATION,
    GROUND_ACCELERATION,
    GROUND_SPEED,
    GROUND_DISPLACEMENT,
];

/// The constant of a dashpot whose force grows with a power of speed \[N·(s/m)^exponent\], and its unit.
#[must_use]
pub fn power_dashpot(si: f64, exponent: f64) -> (f64, String) {
    let (force, length) = match units() {
        Units::Si => (NEWTON, HEIGHT),
        Units::Us => (FORCE, LENGTH),
    };
    let name = format!("{}·(s/{})^{exponent}", force.name(), length.name());
    (force.of(si) * libm::pow(length.size(), exponent), name)
}

impl Shown {
    /// The quantity whose SI unit has this name.
    #[must_use]
    pub fn named(si: &str) -> Option<Self> {
        ALL_SHOWN
            .iter()
            .find(|candidate| candidate.si.0 == si)
            .copied()
    }

    /// The name of its SI unit.
    #[must_use]
    pub fn si_name(self) -> &'static str {
        self.si.0
    }

    /// The size of its SI unit \[SI\].
    pub(crate) fn si_size(self) -> f64 {
        self.si.1
    }

    /// Name of its unit in a system.
    #[must_use]
    pub fn name_in(self, units: Units) -> &'static str {
        match units {
            Units::Si => self.si.0,
            Units::Us => self.us.0,
        }
    }

    /// Name of its unit in the system that holds.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.name_in(units())
    }

    /// The same in square brackets, as heads of columns and axes name it.
    #[must_use]
    pub fn bracketed(self) -> String {
        format!("[{}]", self.name())
    }

    /// Size of its unit in the system that holds \[SI\].
    #[must_use]
    pub fn size(self) -> f64 {
        match units() {
            Units::Si => self.si.1,
            Units::Us => self.us.1,
        }
    }

    /// An SI number in its unit.
    #[must_use]
    pub fn of(self, si: f64) -> f64 {
        let size = self.size();
        // A size such as 1e-3 is not exact, its reciprocal is.
        if size < 1.0 {
            si * (1.0 / size)
        } else {
            si / size
        }
    }

    /// Decimals in its unit where SI units have so many.
    #[must_use]
    pub fn decimals(self, si: usize) -> usize {
        match units() {
            Units::Si => si,
            Units::Us => si.max(self.least),
        }
    }

    /// An SI number in its unit, with so many decimals in SI units and enough in others.
    #[must_use]
    pub fn number(self, si: f64, decimals: usize) -> String {
        format!("{:.*}", self.decimals(decimals), self.of(si))
    }

    /// An SI number rounded up, as codes do with required widths: to a whole unit, or to hundredths outside of SI.
    #[must_use]
    pub fn rounded_up(self, si: f64) -> String {
        let decimals = self.decimals(0);
        let steps = if decimals == 0 { 1.0 } else { 100.0 };
        format!(
            "{:.decimals$}",
            (self.of(si) * steps - 1e-6).ceil() / steps + 0.0
        )
    }

    /// What the user stated: as it is in SI units, with enough decimals in others.
    #[must_use]
    pub fn stated(self, si: f64) -> String {
        match units() {
            Units::Si => format!("{}", self.of(si)),
            Units::Us => self.number(si, 2),
        }
    }

    /// A number with its sign.
    #[must_use]
    pub fn signed(self, si: f64, decimals: usize) -> String {
        format!("{:+.*}", self.decimals(decimals), self.of(si))
    }

    /// The number with the name of its unit.
    #[must_use]
    pub fn text(self, si: f64, decimals: usize) -> String {
        format!("{} {}", self.number(si, decimals), self.name())
    }
}

thread_local! {
    /// Whether a system was chosen for the text, and which one holds.
    static HOLDS: Cell<(bool, Units)> = Cell::new(match FOR_ALL_THREADS.get() {
        Some(units) => (true, *units),
        None => (false, Units::Si),
    });
}

static FOR_ALL_THREADS: OnceLock<Units> = OnceLock::new();

/// Chooses a system for every thread that begins to write from now on: for programs that run one command.
pub fn choose_for_all_threads(units: Units) {
    // The first choice stays.
    let _ = FOR_ALL_THREADS.set(units);
}

/// The system that holds for what this thread writes.
#[must_use]
pub fn units() -> Units {
    HOLDS.get().1
}

/// The system that was chosen over what model files ask for; hand it to threads that write parts of the same text.
#[must_use]
pub fn chosen_units() -> Option<Units> {
    let (chosen, units) = HOLDS.get();
    chosen.then_some(units)
}

/// Returns what `write` returns. What it writes on this thread is in `chosen` units; if nothing is chosen, in those that
/// model files ask for, else in SI.
pub fn in_units<T>(chosen: Option<Units>, write: impl FnOnce() -> T) -> T {
    within((chosen.is_some(), chosen.unwrap_or_default()), write)
}

/// The same for a text about one model: `asked` by its file, unless a system was chosen.
pub fn by_model<T>(asked: Option<Units>, write: impl FnOnce() -> T) -> T {
    let (chosen, holds) = HOLDS.get();
    let units = if chosen {
        holds
    } else {
        asked.unwrap_or(holds)
    };
    within((chosen, units), write)
}

/// What a model file asks for holds until the end of the surrounding [`in_units`], unless a system was chosen: for commands
/// that open one model.
pub fn follow(asked: Option<Units>) {
    let (chosen, holds) = HOLDS.get();
    if !chosen {
        HOLDS.set((false, asked.unwrap_or(holds)));
    }
}

fn within<T>(holds: (bool, Units), write: impl FnOnce() -> T) -> T {
    struct Restore((bool, Units));
    impl Drop for Restore {
        fn drop(&mut self) {
            HOLDS.set(self.0);
        }
    }
    let _restore = Restore(HOLDS.replace(holds));
    write()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unit::Unit;

    /// The reader of units knows every unit that is shown, with the same size.
    #[test]
    fn what_is_shown_can_be_typed() {
        for unit in ALL_SHOWN {
            for (name, size) in [unit.si, unit.us] {
                let read = Unit::parse(name).unwrap_or_else(|error| panic!("{name}: {error:?}"));
                // A mass is shown as its weight.
                let weight = name != unit.si.0 && matches!(unit.si.0, "t" | "kg/m" | "kg/m²");
                let expected = if weight {
                    read.factor / STANDARD_GRAVITY
                } else {
                    read.factor
                };
                assert!(
                    (size / expected - 1.0).abs() < 1e-12,
                    "{name}: {size}, not {expected}"
                );
            }
            let named = Shown::named(unit.si.0).map(|found| found.us.0);
            assert_eq!(named, Some(unit.us.0), "{} names one quantity", unit.si.0);
        }
    }

    #[test]
    fn a_choice_comes_before_the_model_and_ends_with_its_text() {
        let us = Some(Units::Us);
        assert_eq!(units(), Units::Si);
        assert_eq!(in_units(us, units), Units::Us);
        assert_eq!(by_model(us, units), Units::Us);
        assert_eq!(in_units(Some(Units::Si), || by_model(us, units)), Units::Si);
        assert_eq!(by_model(us, || by_model(None, units)), Units::Us);
        let followed = in_units(None, || {
            follow(us);
            (units(), chosen_units())
        });
        assert_eq!(followed, (Units::Us, None));
        assert_eq!(units(), Units::Si);
    }

    /// By hand, with the inch of 25.4 mm and the pound of 0.453 592 37 kg × 9.806 65 m/s².
    #[test]
    fn numbers_are_converted_by_hand() {
        in_units(Some(Units::Us), || {
            for (unit, si, text) in [
                (LENGTH, 0.1, "3.94 in"),
                (HEIGHT, 30.48, "100.0 ft"),
                (FORCE, 4_448.221_615, "1.0 kip"),
                (MOMENT, 1e6, "737.6 kip·ft"),
                (IMPULSE, 1e4, "2.2 kip·s"),
                (ENERGY, 1e3, "8.9 kip·in"),
                (LINE_LOAD, 14_593.903, "1.00 kip/ft"),
                (LARGE_STIFFNESS, 175_126_835.0, "1000.0 kip/in"),
                (STRESS, 20.684_271_88e6, "3.00 ksi"),
                (MODULUS, 199.947_961_5e9, "29000 ksi"),
                (PRESSURE, 47_880.258_98, "1.00 ksf"),
                (MASS, 1e5, "220 kip"),
                (SPEED, 1.0, "39.4 in/s"),
                (GROUND_ACCELERATION, 9.806_65, "1.000 g"),
            ] {
                assert_eq!(unit.text(si, 0), text);
            }
        });
        assert_eq!(FORCE.text(1_282_850.0, 1), "1282.8 kN");
        assert_eq!(LENGTH.text(0.1, 1), "100.0 mm");
    }
}
