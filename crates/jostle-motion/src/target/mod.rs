//! Design spectra of codes or users.

mod asce7;
mod en1998;
mod gb50011;
mod table;

pub use asce7::Asce7;
pub use en1998::{En1998, EnGround, EnType};
pub use gb50011::{Gb50011, GbGroup, GbIntensity, GbLevel, GbSite};
pub use table::SpectrumTable;

use crate::fault::{MotionFault, within};

/// A design spectrum of pseudo-acceleration.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetSpectrum {
    /// Its shape and size.
    pub kind: TargetKind,
    /// Factor on every acceleration, > 0 \[–\].
    pub factor: f64,
}

/// Where a design spectrum comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum TargetKind {
    /// GB 50011-2010.
    Gb50011(Gb50011),
    /// EN 1998-1.
    En1998(En1998),
    /// ASCE 7.
    Asce7(Asce7),
    /// Points of the user's own.
    Table(SpectrumTable),
}

impl TargetSpectrum {
    /// A spectrum as its source gives it.
    #[must_use]
    pub fn new(kind: TargetKind) -> Self {
        Self { kind, factor: 1.0 }
    }

    /// Pseudo-acceleration at a period and a damping ratio \[m/s²\].
    ///
    /// # Errors
    /// If the spectrum is not defined for this period or damping ratio.
    pub fn acceleration(&self, period: f64, damping: f64) -> Result<f64, MotionFault> {
        let [first, last] = self.range();
        let good = (first..=last).contains(&period);
        within("a period", "within the range of the spectrum", period, good)?;
        let good = (0.0..1.0).contains(&damping);
        within("a damping ratio", "from 0 to below 1", damping, good)?;
        let value = match &self.kind {
            TargetKind::Gb50011(spectrum) => spectrum.acceleration(period, damping),
            TargetKind::En1998(spectrum) => spectrum.acceleration(period, damping),
            TargetKind::Asce7(spectrum) => spectrum.acceleration(period, damping)?,
            TargetKind::Table(spectrum) => spectrum.acceleration(period, damping)?,
        };
        Ok(self.factor * value)
    }

    /// The shortest and the longest period that it speaks of \[s\].
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        match &self.kind {
            TargetKind::Gb50011(_) => [0.0, 6.0],
            TargetKind::En1998(_) => [0.0, 4.0],
            TargetKind::Asce7(_) => [0.0, 20.0],
            TargetKind::Table(table) => table.range(),
        }
    }

    /// Peak ground acceleration that goes with it; `None` for a table that does not begin at zero \[m/s²\].
    #[must_use]
    pub fn peak_ground_acceleration(&self) -> Option<f64> {
        match &self.kind {
            TargetKind::Gb50011(spectrum) => Some(self.factor * spectrum.time_history_peak()),
            TargetKind::Table(table) => self.acceleration(0.0, table.damping()).ok(),
            _ => self.acceleration(0.0, 0.05).ok(),
        }
    }

    /// Description, one line.
    #[must_use]
    pub fn name(&self) -> String {
        let name = match &self.kind {
            TargetKind::Gb50011(spectrum) => spectrum.name(),
            TargetKind::En1998(spectrum) => spectrum.name(),
            TargetKind::Asce7(spectrum) => spectrum.name(),
            TargetKind::Table(table) => table.name().to_owned(),
        };
        if self.factor == 1.0 {
            name
        } else {
            format!("{name}, times {}", self.factor)
        }
    }
}
