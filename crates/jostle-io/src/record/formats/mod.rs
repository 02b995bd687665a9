//! The formats of records: their names, what reads them, and their recognition from the content of a file. One file per format turns bytes
//! into [`Contents`].

use std::borrow::Cow;
use std::fmt;

use super::RecordOptions;
use super::contents::Contents;
use super::error::RecordError;
use super::header::find_phrase;
use super::lines::{Lines, without_fill};

mod afad;
mod at2;
mod columns;
mod cosmos;
mod csmip;
mod cwa;
mod esm;
mod geonet;
mod knet;
mod miniseed;
mod nees;
mod sac;
mod simcenter;
mod smc;

/// A format of ground-motion records.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RecordFormat {
    /// PEER AT2: short header with NPTS and DT, values in free format.
    At2,
    /// One or more columns of text, with or without times.
    Columns,
    /// COSMOS strong-motion data format, version 1.20 (V1c, V2c).
    Cosmos,
    /// CSMIP and CDMG volumes 1 and 2.
    Csmip,
    /// K-NET and KiK-net ASCII.
    Knet,
    /// ESM (Engineering Strong-Motion database) ASCII, also written by ITACA and AFAD-TADAS.
    Esm,
    /// USGS SMC.
    Smc,
    /// GeoNet (New Zealand) V1A and V2A.
    GeoNet,
    /// AFAD (Türkiye), three columns below a header.
    Afad,
    /// CWA (Taiwan), text with three components.
    Cwa,
    /// NEES `.asc` of shake tables: six header rows, then one row per instant.
    Nees,
    /// miniSEED 2 and 3.
    MiniSeed,
    /// SAC, binary, of either byte order.
    Sac,
    /// Records of NHERI SimCenter, JSON.
    SimCenter,
}

impl RecordFormat {
    /// Every format.
    pub const ALL: [Self; 14] = [
        Self::At2,
        Self::Columns,
        Self::Cosmos,
        Self::Csmip,
        Self::Knet,
        Self::Esm,
        Self::Smc,
        Self::GeoNet,
        Self::Afad,
        Self::Cwa,
        Self::Nees,
        Self::MiniSeed,
        Self::Sac,
        Self::SimCenter,
    ];

    /// The word for it in model files and on the command line.
    #[must_use]
    pub const fn key(self) -> &'static str {
        self.facts().key
    }

    /// One line for each format.
    #[rustfmt::skip]
    const fn facts(self) -> Facts {
        match self {
            Self::At2 => Facts::text("at2", "PEER AT2", at2::read),
            Self::Columns => Facts::text("columns", "columns of text", columns::read),
            Self::Cosmos => Facts::text("cosmos", "COSMOS", |bytes, _| cosmos::read(bytes)),
            Self::Csmip => Facts::text("csmip", "CSMIP", csmip::read),
            Self::Knet => Facts::text("knet", "K-NET", |bytes, _| knet::read(bytes)),
            Self::Esm => Facts::text("esm", "ESM", |bytes, _| esm::read(bytes)),
            Self::Smc => Facts::text("smc", "USGS SMC", smc::read),
            Self::GeoNet => Facts::text("geonet", "GeoNet", |bytes, _| geonet::read(bytes)),
            Self::Afad => Facts::text("afad", "AFAD", |bytes, _| afad::read(bytes)),
            Self::Cwa => Facts::text("cwa", "CWA", |bytes, _| cwa::read(bytes)),
            Self::Nees => Facts::text("nees", "NEES asc", |bytes, _| nees::read(bytes)),
            Self::MiniSeed => Facts::binary("miniseed", "miniSEED", |bytes, _| miniseed::read(bytes)),
            Self::Sac => Facts::binary("sac", "SAC", sac::read),
            Self::SimCenter => Facts::text("simcenter", "SimCenter JSON", |bytes, _| simcenter::read(bytes)),
        }
    }

    /// Reads a file in this format.
    pub(super) fn read(
        self,
        bytes: &[u8],
        options: &RecordOptions,
    ) -> Result<Contents, RecordError> {
        let facts = self.facts();
        if !facts.is_text {
            return (facts.read)(bytes, options);
        }
        let text = without_fill(bytes);
        check_text(text)?;
        (facts.read)(text, options)
    }

    /// The format of this word.
    ///
    /// # Errors
    /// [`RecordError::UnknownFormat`] with the words there are.
    pub fn from_key(key: &str) -> Result<Self, RecordError> {
        let wanted = key.trim().to_ascii_lowercase().replace(['-', '_'], "");
        Self::ALL
            .into_iter()
            .find(|format| format.key() == wanted)
            .ok_or_else(|| RecordError::UnknownFormat {
                found: crate::quantity::shorten(key),
            })
    }

    /// The words for all formats, for messages.
    pub(crate) fn keys() -> String {
        Self::ALL.map(Self::key).join(", ")
    }

    /// Tells the format from the content of a file; columns of text when nothing else fits.
    ///
    /// # Errors
    /// [`RecordError::Binary`] or [`RecordError::Wrapped`] for files in no format that is read.
    pub fn detect(bytes: &[u8]) -> Result<Self, RecordError> {
        if miniseed::is_miniseed(bytes) {
            return Ok(Self::MiniSeed);
        }
        if sac::is_sac(bytes) {
            return Ok(Self::Sac);
        }
        let text = without_fill(bytes);
        check_text(text)?;
        check_family(text)?;
        Ok(detect_text(text))
    }
}

impl fmt::Display for RecordFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.facts().title)
    }
}

/// What is known of a format.
struct Facts {
    key: &'static str,
    title: &'static str,
    is_text: bool,
    read: Read,
}

/// Turns bytes into channels.
type Read = fn(&[u8], &RecordOptions) -> Result<Contents, RecordError>;

impl Facts {
    const fn text(key: &'static str, title: &'static str, read: Read) -> Self {
        Self {
            key,
            title,
            is_text: true,
            read,
        }
    }

    const fn binary(key: &'static str, title: &'static str, read: Read) -> Self {
        Self {
            is_text: false,
            ..Self::text(key, title, read)
        }
    }
}

/// First bytes of files that are not text.
#[rustfmt::skip]
const WRAPPED: &[(&[u8], &str, &str)] = &[
    (b"PK\x03\x04", "a ZIP archive", "unpack it and give one of the records in it"),
    (b"\x1f\x8b", "compressed with gzip", "unpack it first"),
    (b"BZh", "compressed with bzip2", "unpack it first"),
    (b"\x89HDF", "an HDF5 file", "export the record as AT2, CSV or columns of text"),
    (b"%PDF", "a PDF document", "give the record itself, as AT2, CSV or columns of text"),
    (b"\xff\xfe", "text in UTF-16", "save it as UTF-8 or plain ASCII"),
    (b"\xfe\xff", "text in UTF-16", "save it as UTF-8 or plain ASCII"),
];

/// Whether a text begins as web pages do.
fn is_page(bytes: &[u8]) -> bool {
    let text = bytes.trim_ascii_start();
    ["<!doctype html", "<html"].iter().any(|mark| {
        text.get(..mark.len())
            .is_some_and(|start| start.eq_ignore_ascii_case(mark.as_bytes()))
    })
}

/// Refuses what cannot be read as text.
pub(crate) fn check_text(bytes: &[u8]) -> Result<(), RecordError> {
    if let Some((_, what, remedy)) = WRAPPED.iter().find(|(mark, ..)| bytes.starts_with(mark)) {
        return Err(RecordError::Wrapped { what, remedy });
    }
    if is_page(bytes) {
        return Err(RecordError::Wrapped {
            what: "a web page (HTML)",
            remedy: "save the record that the page links to, not the page",
        });
    }
    if bytes.contains(&0) {
        return Err(RecordError::Binary);
    }
    Ok(())
}

/// Refuses text formats that are known by name but not read.
///
/// Layouts: the readers `bhrc`, `unam` and `usc` of gmprocess (USGS).
fn check_family(bytes: &[u8]) -> Result<(), RecordError> {
    let lines: Vec<_> = Lines::new(bytes)
        .take(FAMILY_LINES)
        .map(|line| line.text)
        .collect();
    let line = |number: usize| lines.get(number - 1).map_or("", |text| text.as_ref());
    let has = |text: &str, phrase| find_phrase(text, phrase).is_some();
    let (what, remedy) = if line(1).starts_with("* VOL") && line(7).starts_with("COMP") {
        (
            "a BHRC file (Iran Strong Motion Network)",
            "copy the values of one component, one on a line, into a file of their own and say its unit and step beside record (volume 1: unit = \"g/10\", and the duration over the number of points less one)",
        )
    } else if lines
        .iter()
        .any(|text| has(text, "archivo estandar de aceleracion"))
    {
        (
            "an accelerogram in the standard format of UNAM (Mexico)",
            "copy the three columns below the header into a file of their own and say unit = \"gal\", column = 1 (to 3) and step (INTERVALO DE MUESTREO) beside record",
        )
    } else if is_usc(&lines) {
        (
            "a file of the University of Southern California (USC)",
            "take the same record as AT2 from PEER, or copy the accelerations of one component, one on a line, into a file of their own and say its unit and step beside record",
        )
    } else {
        return Ok(());
    };
    Err(RecordError::Wrapped { what, remedy })
}

/// Lines in which these families name themselves.
const FAMILY_LINES: usize = 14;

/// USC volumes resemble those of CSMIP, with the number of the line in columns 73 and 74.
fn is_usc(lines: &[Cow<'_, str>]) -> bool {
    let first = lines.first().map_or("", AsRef::as_ref);
    let start = if find_phrase(first, "of uncorrected accelerogram data of").is_some() {
        1
    } else if find_phrase(first, "corrected accelerogram").is_some() {
        2
    } else {
        return false;
    };
    let numbered = |text: &Cow<'_, str>| {
        let number = text.get(72..).map(|rest| rest.get(..2).unwrap_or(rest));
        number.is_some_and(|number| number.trim().parse::<u8>().is_ok())
    };
    let header = lines.get(start..start + 12).unwrap_or_default();
    !header.is_empty() && header.iter().all(numbered)
}

pub(crate) use columns::Times;
pub(crate) use nees::HEADER_ROWS;

/// Lines that can identify a format.
const FIRST_LINES: usize = 64;
/// Lines of AT2 in which NPTS must stand.
pub(crate) const AT2_HEADER_LINES: usize = 12;

/// Every format has more than one mark, so that a damaged first line does not silently change the format.
fn detect_text(bytes: &[u8]) -> RecordFormat {
    use RecordFormat as F;
    if simcenter::is_table(bytes) {
        return F::SimCenter;
    }
    let mut starred = false;
    let mut accelerogram = false;
    let mut npts = false;
    for line in Lines::new(bytes).take(FIRST_LINES) {
        let text = line.text.trim();
        let upper = text.to_ascii_uppercase();
        let starts = |mark: &str| upper.starts_with(mark);
        let has = |mark: &str| upper.contains(mark);
        if starts("ORIGIN TIME ") || starts("SAMPLING FREQ(HZ)") || starts("SCALE FACTOR ") {
            return F::Knet;
        }
        if starts("EVENT_NAME:") || starts("SAMPLING_INTERVAL_S:") || starts("NDATA:") {
            return F::Esm;
        }
        if has("(FORMAT V") || has("INTEGER-HEADER VALUES FOLLOW") || has("REAL-HEADER VALUES") {
            return F::Cosmos;
        }
        if has("STRONG GROUND MOTION RECORDS OF TURK") || starts("SAMPLING INTERVAL (SEC)") {
            return F::Afad;
        }
        if starts("#SAMPLERATE(HZ):") || starts("#AMPLITUDEMAX.") || starts("#DATASEQUENCE:") {
            return F::Cwa;
        }
        if has("GNS SCIENCE") || has("MM/S/S") {
            return F::GeoNet;
        }
        // Empty text lines of SMC are a single star.
        if line.number == 2 && starts("*") {
            starred = true;
        }
        accelerogram |= line.number <= 2 && has("ORRECTED ACCELEROGRAM");
        if starred && smc_kind(Lines::first(bytes).trim()) {
            return F::Smc;
        }
        if line.number > 2 && accelerogram
            || has("FOURIER AMPLITUDE SPECTRA (") && line.number == 1
            || starts("INSTR PERIOD =")
        {
            return F::Csmip;
        }
        npts |= line.number <= AT2_HEADER_LINES && has("NPTS");
        // A comment or a column name may contain NPTS, so other formats are tried first.
        if npts && line.number >= AT2_HEADER_LINES {
            return F::At2;
        }
    }
    match npts {
        true => F::At2,
        false if nees::is_nees(bytes) => F::Nees,
        false => F::Columns,
    }
}

/// `2 CORRECTED ACCELEROGRAM` and its like.
fn smc_kind(first: &str) -> bool {
    let mut chars = first.chars();
    chars.next().is_some_and(|c| c.is_ascii_digit())
        && chars.next() == Some(' ')
        && first.contains(char::is_alphabetic)
}
