//! Design spectra as users write them: words of a code, or a file of points.

use std::path::Path;

use jostle_motion::{
    Asce7, En1998, EnGround, EnType, Gb50011, GbGroup, GbIntensity, GbLevel, GbSite, SpectrumTable,
    TargetKind, TargetSpectrum,
};

use crate::files::{FileError, Files};
use crate::quantity::{Dimension, parse_quantity, shorten};

/// Codes that are known.
pub const TARGET_CODES: &[&str] = &["gb50011", "en1998", "asce7"];

/// The words that choose a design spectrum, as typed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TargetWords {
    /// `gb50011`, `en1998` or `asce7`.
    pub code: Option<String>,
    /// GB 50011: `6`, `7`, `7.5` (0.15 g), `8`, `8.5` (0.30 g), `9`.
    pub intensity: Option<String>,
    /// GB 50011: `I0`, `I1`, `II`, `III`, `IV`.
    pub site: Option<String>,
    /// GB 50011: `1`, `2`, `3`.
    pub group: Option<String>,
    /// GB 50011: `frequent` (default), `fortification`, `rare`.
    pub level: Option<String>,
    /// EN 1998-1: `1` (default) or `2`.
    pub kind: Option<String>,
    /// EN 1998-1: `A` to `E`.
    pub ground: Option<String>,
    /// EN 1998-1: design ground acceleration with its importance factor.
    pub ag: Option<String>,
    /// ASCE 7: S_DS.
    pub sds: Option<String>,
    /// ASCE 7: S_D1.
    pub sd1: Option<String>,
    /// ASCE 7: T_L, 8 s by default.
    pub tl: Option<String>,
    /// Factor on every acceleration, 1 by default.
    pub factor: Option<String>,
}

/// An error in the parameters or the file of a design spectrum.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TargetError {
    /// A word is missing or wrong.
    #[error("{key} {problem}")]
    Word {
        /// The word's key.
        key: &'static str,
        /// The problem, and a valid alternative.
        problem: String,
    },
    /// A file of points has a fault.
    #[error("{name}{problem}")]
    File {
        /// The file.
        name: String,
        /// `:line: problem`.
        problem: String,
    },
}

/// Most bytes of a file of points.
const LARGEST_FILE: usize = 1 << 20;

impl TargetWords {
    /// The spectrum that the words choose.
    ///
    /// # Errors
    /// [`TargetError::Word`] with the first word that is missing, wrong, or does not go with the code.
    pub fn target(&self) -> Result<TargetSpectrum, TargetError> {
        let code = choose("code", self.code.as_deref(), None, TARGET_CODES)?;
        let keys: &[&str] = match code {
            0 => &["intensity", "site", "group", "level"],
            1 => &["type", "ground", "ag"],
            _ => &["sds", "sd1", "tl"],
        };
        for (key, word) in self.words() {
            if word.is_some() && !keys.contains(&key) {
                let problem = format!("does not go with code = \"{}\"", TARGET_CODES[code]);
                return Err(TargetError::Word { key, problem });
            }
        }
        let kind = match code {
            0 => TargetKind::Gb50011(self.gb50011()?),
            1 => TargetKind::En1998(self.en1998()?),
            _ => TargetKind::Asce7(self.asce7()?),
        };
        let factor = quantity(
            "factor",
            self.factor.as_deref(),
            Some("1"),
            Dimension::Dimensionless,
        )?;
        Ok(TargetSpectrum { kind, factor })
    }

    /// The words that belong to single codes.
    fn words(&self) -> [(&'static str, &Option<String>); 10] {
        [
            ("intensity", &self.intensity),
            ("site", &self.site),
            ("group", &self.group),
            ("level", &self.level),
            ("type", &self.kind),
            ("ground", &self.ground),
            ("ag", &self.ag),
            ("sds", &self.sds),
            ("sd1", &self.sd1),
            ("tl", &self.tl),
        ]
    }

    fn gb50011(&self) -> Result<Gb50011, TargetError> {
        use {GbGroup as G, GbIntensity as I, GbLevel as L, GbSite as S};
        let intensity = choose(
            "intensity",
            self.intensity.as_deref(),
            None,
            &["6", "7", "7.5", "8", "8.5", "9"],
        )?;
        let site = choose(
            "site",
            self.site.as_deref(),
            None,
            &["I0", "I1", "II", "III", "IV"],
        )?;
        let group = choose("group", self.group.as_deref(), None, &["1", "2", "3"])?;
        let level = choose(
            "level",
            self.level.as_deref(),
            Some("frequent"),
            &["frequent", "fortification", "rare"],
        )?;
        Ok(Gb50011 {
            intensity: [
                I::Six,
                I::Seven,
                I::SevenHalf,
                I::Eight,
                I::EightHalf,
                I::Nine,
            ][intensity],
            site: [S::I0, S::I1, S::II, S::III, S::IV][site],
            group: [G::First, G::Second, G::Third][group],
            level: [L::Frequent, L::Fortification, L::Rare][level],
        })
    }

    fn en1998(&self) -> Result<En1998, TargetError> {
        use EnGround as E;
        let kind = choose("type", self.kind.as_deref(), Some("1"), &["1", "2"])?;
        let ground = choose(
            "ground",
            self.ground.as_deref(),
            None,
            &["A", "B", "C", "D", "E"],
        )?;
        Ok(En1998 {
            kind: [EnType::One, EnType::Two][kind],
            ground: [E::A, E::B, E::C, E::D, E::E][ground],
            ground_acceleration: quantity("ag", self.ag.as_deref(), None, Dimension::Acceleration)?,
        })
    }

    fn asce7(&self) -> Result<Asce7, TargetError> {
        Ok(Asce7 {
            short: quantity("sds", self.sds.as_deref(), None, Dimension::Acceleration)?,
            one_second: quantity("sd1", self.sd1.as_deref(), None, Dimension::Acceleration)?,
            long_period: quantity("tl", self.tl.as_deref(), Some("8 s"), Dimension::Time)?,
        })
    }
}

/// Index of a word among those known; case does not matter.
fn choose(
    key: &'static str,
    word: Option<&str>,
    default: Option<&str>,
    known: &[&str],
) -> Result<usize, TargetError> {
    let fault = |problem: String| TargetError::Word { key, problem };
    let list = known.join(", ");
    let word = word
        .or(default)
        .ok_or_else(|| fault(format!("is missing; one of {list}")))?;
    let found = known
        .iter()
        .position(|known| known.eq_ignore_ascii_case(word.trim()));
    found.ok_or_else(|| {
        fault(format!(
            "must be one of {list}; found \"{}\"",
            shorten(word)
        ))
    })
}

/// A positive quantity.
fn quantity(
    key: &'static str,
    word: Option<&str>,
    default: Option<&str>,
    dimension: Dimension,
) -> Result<f64, TargetError> {
    let fault = |problem: String| TargetError::Word { key, problem };
    let missing = || {
        fault(format!(
            "is missing; {dimension} such as \"{}\"",
            dimension.example()
        ))
    };
    let word = word.or(default).ok_or_else(missing)?;
    let value =
        parse_quantity(word, dimension).map_err(|error| fault(format!("is wrong: {error}")))?;
    if value > 0.0 {
        Ok(value)
    } else {
        Err(fault(format!(
            "must be greater than zero, found \"{}\"",
            shorten(word)
        )))
    }
}

/// Reads a design spectrum from a file of points: lines of period and acceleration, and among the comments
/// `# unit = g` (or another unit) and, if it is not 0.05, `# damping = 0.02`.
///
/// # Errors
/// [`TargetError::File`] naming the line.
pub fn read_target_file(path: &Path) -> Result<TargetSpectrum, TargetError> {
    let name = path.to_str().ok_or_else(|| TargetError::File {
        name: path.display().to_string(),
        problem: ": the name of the file is not UTF-8".into(),
    })?;
    read_target(&Files::beside(Path::new("")), name)
}

/// The same for a file that a model or a study names.
///
/// # Errors
/// As [`read_target_file`].
pub(crate) fn read_target(files: &Files, name: &str) -> Result<TargetSpectrum, TargetError> {
    let path = files.shown(name);
    let fault = |problem: String| TargetError::File {
        name: path.display().to_string(),
        problem,
    };
    let bytes = files
        .read(name, LARGEST_FILE)
        .map_err(|error| match error {
            FileError::TooLarge { .. } => {
                fault(": is larger than a spectrum can be (1 MiB)".into())
            }
            error => fault(format!(": {error}")),
        })?;
    let text = String::from_utf8_lossy(&bytes);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    parse_target(&stem, &text).map_err(fault)
}

/// The same from text; errors begin with `:line`.
fn parse_target(name: &str, text: &str) -> Result<TargetSpectrum, String> {
    let (mut unit, mut damping, mut points, mut lines) = (None, 0.05, Vec::new(), Vec::new());
    for (index, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let (number, line) = (index + 1, line.trim());
        if let Some(comment) = line.strip_prefix('#') {
            let Some((key, value)) = comment.split_once('=') else {
                continue;
            };
            let value = value.trim();
            match key.trim() {
                "unit" => {
                    let size = parse_quantity(&format!("1 {value}"), Dimension::Acceleration);
                    unit = Some(size.map_err(|error| format!(":{number}: {error}"))?);
                }
                "damping" => {
                    damping = parse_quantity(value, Dimension::Dimensionless)
                        .ok()
                        .filter(|z| (0.0..1.0).contains(z))
                        .ok_or_else(|| {
                            format!(":{number}: the damping must lie from 0 to below 1")
                        })?;
                }
                _ => {}
            }
            continue;
        }
        let fields: Vec<&str> = line
            .split([',', ';', ' ', '\t'])
            .filter(|f| !f.is_empty())
            .collect();
        match fields
            .iter()
            .map(|field| field.parse::<f64>())
            .collect::<Result<Vec<_>, _>>()
        {
            Ok(numbers) if numbers.is_empty() => {}
            Ok(numbers) => match numbers[..] {
                [t, a] => {
                    points.push([t, a]);
                    lines.push(number);
                }
                _ => {
                    return Err(format!(
                        ":{number}: expected a period and an acceleration, found {} numbers",
                        numbers.len()
                    ));
                }
            },
            // A row of column names.
            Err(_) if points.is_empty() => {}
            Err(_) => {
                return Err(format!(
                    ":{number}: \"{}\" is not a period and an acceleration",
                    shorten(line)
                ));
            }
        }
    }
    let unit = unit
        .ok_or("the unit of the accelerations is missing; add a line such as # unit = g")
        .map_err(|problem| format!(": {problem}"))?;
    for point in &mut points {
        point[1] *= unit;
    }
    let table = SpectrumTable::new(name, damping, points).map_err(|error| match &error {
        jostle_motion::MotionFault::Table { point } => match lines.get(point - 1) {
            Some(line) => format!(":{line}: {error}"),
            None => format!(": {error}"),
        },
        _ => format!(": {error}"),
    })?;
    Ok(TargetSpectrum::new(TargetKind::Table(table)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(pairs: &[(&str, &str)]) -> TargetWords {
        let mut words = TargetWords::default();
        for (key, word) in pairs {
            let field = match *key {
                "code" => &mut words.code,
                "intensity" => &mut words.intensity,
                "site" => &mut words.site,
                "group" => &mut words.group,
                "level" => &mut words.level,
                "ground" => &mut words.ground,
                "ag" => &mut words.ag,
                other => panic!("no key {other}"),
            };
            *field = Some((*word).to_owned());
        }
        words
    }

    #[test]
    fn words_choose_a_spectrum() {
        let nanjing = words(&[
            ("code", "gb50011"),
            ("intensity", "7"),
            ("site", "ii"),
            ("group", "1"),
        ]);
        let target = nanjing.target().unwrap();
        assert!((target.acceleration(0.2, 0.05).unwrap() - 0.08 * 9.80665).abs() < 1e-14);
        assert_eq!(target.peak_ground_acceleration(), Some(0.35));
        for (wrong, part) in [
            (words(&[]), "code is missing; one of gb50011"),
            (
                words(&[("code", "gb50011"), ("intensity", "5")]),
                "intensity must be one of 6, 7, 7.5",
            ),
            (
                words(&[("code", "en1998"), ("ground", "B"), ("ag", "2 m")]),
                "ag is wrong: expected an acceleration",
            ),
            (
                words(&[("code", "en1998"), ("site", "II")]),
                "site does not go with code = \"en1998\"",
            ),
            (
                words(&[("code", "en1998"), ("ground", "B"), ("ag", "-1")]),
                "ag must be greater than zero",
            ),
        ] {
            let error = wrong.target().unwrap_err().to_string();
            assert!(error.starts_with(part), "{error}");
        }
    }

    #[test]
    fn points_are_read_and_faults_have_lines() {
        let good = "# unit = g\n# damping = 2 %\nperiod_s,sa_g\n0.1,1.0\n1.0,0.5\n";
        let target = parse_target("own", good).unwrap();
        assert!((target.acceleration(0.1, 0.02).unwrap() - 9.80665).abs() < 1e-12);
        for (text, part) in [
            ("0.1 1\n1 2\n", ": the unit"),
            ("# unit = g\n0.1 1\n0.1 2\n", ":3: "),
            ("# unit = g\n0.1 1\nx y\n", ":3: \"x y\""),
            ("# unit = g\n0.1 1 2\n", ":2: expected a period"),
            ("# unit = s\n", ":1: expected an acceleration"),
            ("# unit = g\n# damping = 3\n", ":2: the damping"),
            ("# unit = g\n", ": a spectrum needs"),
        ] {
            let error = parse_target("own", text).unwrap_err();
            assert!(error.starts_with(part), "{text:?}: {error}");
        }
    }
}
