//! Reported numbers: name, unit, meaning, where they appear, and how each is read.
//!
//! A type of results lists its numbers once, as `QUANTITIES`. Tables, columns of studies, the report and the page of the
//! documentation are made from these lists; a test compares them with the keys of `summary.json`.

use serde::Serialize;

/// A unit, and how names end that have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// As in texts, such as `m/s²`; `–` for numbers without a unit.
    pub symbol: &'static str,
    /// End of names, such as `_m_s2`; empty for numbers without a unit.
    pub suffix: &'static str,
}

#[rustfmt::skip]
#[allow(missing_docs, reason = "each is the unit that it names")]
impl Unit {
    pub const NONE: Self = Self { symbol: "–", suffix: "" };
    pub const S: Self = Self { symbol: "s", suffix: "_s" };
    pub const PER_S: Self = Self { symbol: "1/s", suffix: "_per_s" };
    pub const M: Self = Self { symbol: "m", suffix: "_m" };
    pub const M_S: Self = Self { symbol: "m/s", suffix: "_m_s" };
    pub const M_S2: Self = Self { symbol: "m/s²", suffix: "_m_s2" };
    pub const RAD: Self = Self { symbol: "rad", suffix: "_rad" };
    pub const RAD_S: Self = Self { symbol: "rad/s", suffix: "_rad_s" };
    pub const RAD_S2: Self = Self { symbol: "rad/s²", suffix: "_rad_s2" };
    pub const KG: Self = Self { symbol: "kg", suffix: "_kg" };
    pub const N: Self = Self { symbol: "N", suffix: "_n" };
    pub const NM: Self = Self { symbol: "N·m", suffix: "_n_m" };
    pub const NS: Self = Self { symbol: "N·s", suffix: "_n_s" };
    pub const HZ: Self = Self { symbol: "Hz", suffix: "_hz" };
    pub const PA: Self = Self { symbol: "Pa", suffix: "_pa" };
    pub const J: Self = Self { symbol: "J", suffix: "_j" };
    pub const N_PER_M: Self = Self { symbol: "N/m", suffix: "_n_m" };
    pub const NS_PER_M: Self = Self { symbol: "N·s/m", suffix: "_n_s_m" };
    /// Numbers of any column of a history.
    pub const OF_COLUMN: Self = Self { symbol: "of the column", suffix: "" };
    pub const NM_PER_RAD: Self = Self { symbol: "N·m/rad", suffix: "_n_m_rad" };
    pub const NMS_PER_RAD: Self = Self { symbol: "N·m·s/rad", suffix: "_n_m_s_rad" };
    /// Deformations of hinges and of storeys.
    pub const RAD_OR_M: Self = Self { symbol: "rad or m", suffix: "" };
    /// Their forces.
    pub const NM_OR_N: Self = Self { symbol: "N·m or N", suffix: "" };
}

/// How a number is read from its owner.
pub enum Read<T> {
    /// A number.
    Real(fn(&T) -> f64),
    /// A number that may be absent.
    Optional(fn(&T) -> Option<f64>),
    /// A count; 1 or 0 for yes or no.
    Whole(fn(&T) -> usize),
}

/// Where a number appears.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Places {
    /// In `summary.json`.
    pub summary: bool,
    /// In the table of its owner, if it has one.
    pub table: bool,
    /// Among the columns of studies.
    pub study: bool,
    /// Compared with the run without contact; in studies if they ask for it.
    pub compared: bool,
    /// In studies only of buildings that can yield.
    pub yielding: bool,
}

/// How the report shows a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// Heading of its column.
    pub title: &'static str,
    /// Unit in the report.
    pub unit: &'static str,
    /// Size of the SI unit in that unit.
    pub factor: f64,
    /// Decimals.
    pub decimals: usize,
}

/// A number that is reported of every `T`: a floor, a building, an impact.
pub struct Quantity<T> {
    /// Key in `summary.json` and column in tables; ends with the suffix of its unit.
    pub name: &'static str,
    /// Unit.
    pub unit: Unit,
    /// Meaning, in one line.
    pub meaning: &'static str,
    /// How it is read.
    pub read: Read<T>,
    /// Where it appears.
    pub places: Places,
    /// How the report shows it, if it does.
    pub shown: Option<Shown>,
}

impl<T> Quantity<T> {
    /// A number, in the summary and in the table of its owner.
    pub(crate) const fn real(
        name: &'static str,
        unit: Unit,
        meaning: &'static str,
        read: fn(&T) -> f64,
    ) -> Self {
        Self::new(name, unit, meaning, Read::Real(read))
    }

    /// The same for a number that may be absent.
    pub(crate) const fn optional(
        name: &'static str,
        unit: Unit,
        meaning: &'static str,
        read: fn(&T) -> Option<f64>,
    ) -> Self {
        Self::new(name, unit, meaning, Read::Optional(read))
    }

    /// The same for a count.
    pub(crate) const fn whole(
        name: &'static str,
        meaning: &'static str,
        read: fn(&T) -> usize,
    ) -> Self {
        Self::new(name, Unit::NONE, meaning, Read::Whole(read))
    }

    const fn new(name: &'static str, unit: Unit, meaning: &'static str, read: Read<T>) -> Self {
        let places = Places {
            summary: true,
            table: true,
            study: false,
            compared: false,
            yielding: false,
        };
        Self {
            name,
            unit,
            meaning,
            read,
            places,
            shown: None,
        }
    }

    /// Also a column of studies.
    pub(crate) const fn in_study(mut self) -> Self {
        self.places.study = true;
        self
    }

    /// Compared with the run without contact.
    pub(crate) const fn compared(mut self) -> Self {
        self.places.compared = true;
        self
    }

    /// In studies only of buildings that can yield.
    pub(crate) const fn if_yielding(mut self) -> Self {
        self.places.yielding = true;
        self
    }

    /// Not a key of `summary.json`: it follows from others there.
    pub(crate) const fn not_in_summary(mut self) -> Self {
        self.places.summary = false;
        self
    }

    /// Not a column of the table.
    pub(crate) const fn not_in_table(mut self) -> Self {
        self.places.table = false;
        self
    }

    /// A column of the table of peaks in the report.
    pub(crate) const fn shown(
        mut self,
        title: &'static str,
        unit: &'static str,
        factor: f64,
        decimals: usize,
    ) -> Self {
        self.shown = Some(Shown {
            title,
            unit,
            factor,
            decimals,
        });
        self
    }

    /// The number, if it is there.
    pub fn value(&self, owner: &T) -> Option<f64> {
        match self.read {
            Read::Real(read) => Some(read(owner)),
            Read::Optional(read) => read(owner),
            Read::Whole(read) => Some(read(owner) as f64),
        }
    }

    /// The name without the unit.
    #[must_use]
    pub fn stem(&self) -> &'static str {
        let stem = self.name.strip_suffix(self.unit.suffix);
        stem.unwrap_or(self.name)
    }

    /// Name in tables of its value in the run without contact.
    #[must_use]
    pub fn name_without_contact(&self) -> String {
        format!("{}_without_contact{}", self.stem(), self.unit.suffix)
    }

    /// Name in tables of its amplification.
    #[must_use]
    pub fn name_of_amplification(&self) -> String {
        format!("{}_amplification", self.stem())
    }

    /// Its amplification by contact: |value| over |value without contact|; `None` if it is not compared, if one of them
    /// is absent or if the latter is zero \[–\].
    pub fn amplification(&self, with: &T, without: &T) -> Option<f64> {
        let [with, without] = [self.value(with)?, self.value(without)?];
        let ratio = (with / without).abs();
        (self.places.compared && ratio.is_finite()).then_some(ratio)
    }
}
