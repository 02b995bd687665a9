//! Arguments of `jostle motion` as typed.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use jostle_io::RecordContent;

#[derive(Debug, Subcommand)]
pub(crate) enum MotionCommand {
    /// List built-in motions
    List,
    /// Show peaks, durations, intensities and spectra of a motion
    Show(ShowArgs),
    /// Compute response spectra of a motion
    Spectrum(SpectrumArgs),
    /// Cut, correct, filter, resample, scale and write a motion as AT2 or CSV
    Convert(ConvertArgs),
    /// Generate an artificial motion
    #[command(subcommand)]
    Synth(SynthCommand),
    /// Check a set of motions by the rules of a code [exit code 1 if it does not meet them]
    Select(SelectArgs),
}

/// Heading of the options of [`RecordArgs`].
const READING: &str = "Reading the record";

/// A motion, and data that its file does not contain.
#[derive(Debug, Args)]
pub(crate) struct RecordArgs {
    /// A built-in name, or a file
    pub(crate) record: String,
    /// Unit of the numbers, such as g or cm/s2, if the file does not state it. In AT2 files and columns of text, it replaces
    /// that of the file
    #[arg(long, value_name = "UNIT", help_heading = READING)]
    pub(crate) unit: Option<String>,
    /// Time step, if the file does not state it. In AT2 files and columns of text, it replaces that of the file
    #[arg(long, value_name = "TIME", help_heading = READING)]
    pub(crate) step: Option<String>,
    /// Column of the acceleration in a text file, counted from 1
    #[arg(long, value_name = "N", help_heading = READING)]
    pub(crate) column: Option<usize>,
    /// Channel of a file with several: a number, a name, H1, H2, up, N-S, an azimuth
    #[arg(long, value_name = "NAME", help_heading = READING)]
    pub(crate) component: Option<String>,
    /// Multiply the numbers of the file by this, for example the size of one count
    #[arg(long, value_name = "FACTOR", help_heading = READING)]
    pub(crate) record_scale: Option<f64>,
    /// Remove the mean of the record
    #[arg(long, help_heading = READING)]
    pub(crate) remove_mean: bool,
    /// Format of the file, if auto-detection is wrong
    #[arg(long, value_name = "FORMAT", help_heading = READING)]
    pub(crate) format: Option<String>,
    /// Number of lines to skip at the top of a text file
    #[arg(long, value_name = "LINES", help_heading = READING)]
    pub(crate) skip: Option<usize>,
    /// Last line of a text file to read, counted from 1
    #[arg(long, value_name = "LINE", help_heading = READING)]
    pub(crate) last: Option<usize>,
    /// Values on a line of a text file, if they continue from line to line
    #[arg(long, value_name = "N", help_heading = READING)]
    pub(crate) per_line: Option<usize>,
    /// Content of the lines of a text file: values, pairs of time and acceleration, or columns
    #[arg(long, value_name = "CONTENT", value_parser = RecordContent::ALL.map(RecordContent::key), help_heading = READING)]
    pub(crate) content: Option<String>,
    /// The same as --content pairs
    #[arg(long, conflicts_with = "content", help_heading = READING)]
    pub(crate) pairs: bool,
    /// Widths of numbers without separators, such as 10 for all, or 8,9
    #[arg(long, value_delimiter = ',', value_name = "WIDTHS", help_heading = READING)]
    pub(crate) widths: Vec<usize>,
}

#[derive(Debug, Args)]
pub(crate) struct ShowArgs {
    #[command(flatten)]
    pub(crate) record: RecordArgs,
    /// Print JSON and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Write a page with charts
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
    /// Replace files even if jostle did not write them
    #[arg(long)]
    pub(crate) force: bool,
}

/// Where peaks of responses are read.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum PeaksAt {
    /// At time steps, at least twenty per period, as in published tables; up to 1.2 % too low
    Steps,
    /// At and between time steps: exact for piecewise linear acceleration
    Between,
}

#[derive(Debug, Args)]
pub(crate) struct SpectrumArgs {
    #[command(flatten)]
    pub(crate) record: RecordArgs,
    /// Damping ratios
    #[arg(long, value_delimiter = ',', default_value = "0.05")]
    pub(crate) damping: Vec<String>,
    /// Periods in s [default: 200 from 0.02 to 10 s at equal ratios]
    #[arg(long, value_delimiter = ',')]
    pub(crate) periods: Vec<String>,
    /// Where peaks are evaluated
    #[arg(long, value_enum, default_value = "steps")]
    pub(crate) peaks: PeaksAt,
    /// Also compute inelastic spectra, for bilinear oscillators with these ductilities
    #[arg(long, value_delimiter = ',', value_name = "MU")]
    pub(crate) ductility: Vec<String>,
    /// Ratio of post-yield to elastic stiffness
    #[arg(long, default_value = "0", value_name = "RATIO")]
    pub(crate) post_yield: String,
    /// Print JSON and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Write a CSV table
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Write a Parquet table
    #[arg(long, value_name = "FILE")]
    pub(crate) parquet: Option<PathBuf>,
    /// Replace files even if jostle did not write them
    #[arg(long)]
    pub(crate) force: bool,
}

/// Heading of the options of [`ConvertArgs`] that change the motion.
const PROCESSING: &str = "Processing, in this order";

/// Steps are applied in the order of these options.
#[derive(Debug, Args)]
pub(crate) struct ConvertArgs {
    #[command(flatten)]
    pub(crate) record: RecordArgs,
    /// File to write: .at2 or .csv
    #[arg(required_unless_present = "output")]
    pub(crate) out: Option<PathBuf>,
    /// The same as an option
    #[arg(short, long = "out", value_name = "OUT", conflicts_with = "out")]
    pub(crate) output: Option<PathBuf>,
    /// Start of the part to keep
    #[arg(long, value_name = "TIME", help_heading = PROCESSING)]
    pub(crate) from: Option<String>,
    /// End of the part to keep
    #[arg(long, value_name = "TIME", help_heading = PROCESSING)]
    pub(crate) to: Option<String>,
    /// Fit a polynomial of this degree to the acceleration and subtract it
    #[arg(long, value_name = "DEGREE", help_heading = PROCESSING)]
    pub(crate) detrend: Option<usize>,
    /// Fit a polynomial of this degree to the velocity and subtract its derivative
    #[arg(long, value_name = "DEGREE", help_heading = PROCESSING)]
    pub(crate) detrend_velocity: Option<usize>,
    /// High-pass Butterworth filter without phase shift
    #[arg(long, value_name = "FREQUENCY", help_heading = PROCESSING)]
    pub(crate) high_pass: Option<String>,
    /// Low-pass Butterworth filter without phase shift
    #[arg(long, value_name = "FREQUENCY", help_heading = PROCESSING)]
    pub(crate) low_pass: Option<String>,
    /// Order of both filters, each applied forwards and backwards: 2, 4, 6 or 8
    #[arg(long, default_value_t = 4, help_heading = PROCESSING)]
    pub(crate) order: usize,
    /// New time step
    #[arg(long, value_name = "TIME", help_heading = PROCESSING)]
    pub(crate) resample: Option<String>,
    /// Time at rest before the motion
    #[arg(long, value_name = "TIME", help_heading = PROCESSING)]
    pub(crate) pad_before: Option<String>,
    /// Time at rest after the motion
    #[arg(long, value_name = "TIME", help_heading = PROCESSING)]
    pub(crate) pad_after: Option<String>,
    /// Correct the motion so that velocity and displacement end at zero
    #[arg(long, help_heading = PROCESSING)]
    pub(crate) at_rest: bool,
    /// Multiply the motion by this factor
    #[arg(
        long,
        allow_hyphen_values = true,
        value_name = "FACTOR",
        conflicts_with = "pga",
        help_heading = PROCESSING
    )]
    pub(crate) scale: Option<String>,
    /// Scale to this peak acceleration
    #[arg(long, value_name = "QUANTITY", help_heading = PROCESSING)]
    pub(crate) pga: Option<String>,
    /// Replace the file if it exists
    #[arg(long)]
    pub(crate) force: bool,
}

/// A design spectrum: a code with its parameters, or a file.
#[derive(Debug, Args)]
pub(crate) struct TargetArgs {
    /// gb50011, en1998 or asce7
    #[arg(long)]
    pub(crate) code: Option<String>,
    /// A file of periods and accelerations instead, with "# unit = g"
    #[arg(long, value_name = "FILE", conflicts_with = "code")]
    pub(crate) target: Option<PathBuf>,
    /// GB 50011: 6, 7, 7.5 (0.15 g), 8, 8.5 (0.30 g) or 9
    #[arg(long)]
    pub(crate) intensity: Option<String>,
    /// GB 50011: I0, I1, II, III or IV
    #[arg(long)]
    pub(crate) site: Option<String>,
    /// GB 50011: 1, 2 or 3
    #[arg(long)]
    pub(crate) group: Option<String>,
    /// GB 50011: frequent, fortification or rare
    #[arg(long)]
    pub(crate) level: Option<String>,
    /// EN 1998-1: spectrum 1 or 2
    #[arg(long = "type", value_name = "TYPE")]
    pub(crate) kind: Option<String>,
    /// EN 1998-1: A, B, C, D or E
    #[arg(long)]
    pub(crate) ground: Option<String>,
    /// EN 1998-1: design ground acceleration
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) ag: Option<String>,
    /// ASCE 7: S_DS
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) sds: Option<String>,
    /// ASCE 7: S_D1
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) sd1: Option<String>,
    /// ASCE 7: T_L
    #[arg(long, value_name = "TIME")]
    pub(crate) tl: Option<String>,
    /// Factor on the spectrum
    #[arg(long)]
    pub(crate) factor: Option<String>,
}

/// Options of every artificial motion.
#[derive(Debug, Args)]
pub(crate) struct WaveArgs {
    /// File to write: .at2 or .csv
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: PathBuf,
    /// Time step
    #[arg(long, default_value = "0.005 s", value_name = "TIME")]
    pub(crate) step: String,
    /// Replace the file if it exists
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, Subcommand)]
pub(crate) enum SynthCommand {
    /// Sines under an envelope, or a record, matched to a spectrum
    Spectrum(Box<SynthSpectrumArgs>),
    /// Filtered white noise (Kanai and Tajimi, Clough and Penzien)
    Noise(SynthNoiseArgs),
    /// A near-fault velocity pulse
    Pulse(SynthPulseArgs),
    /// A predefined motion, such as nanjing-artificial
    Recipe(SynthRecipeArgs),
}

#[derive(Debug, Args)]
pub(crate) struct SynthSpectrumArgs {
    #[command(flatten)]
    pub(crate) target: TargetArgs,
    #[command(flatten)]
    pub(crate) wave: WaveArgs,
    /// Match this record (a built-in name or a file) instead of sines; step and duration are kept
    #[arg(long)]
    pub(crate) record: Option<String>,
    /// Seed of the phases
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// Length of the motion
    #[arg(long, default_value = "40 s", value_name = "TIME")]
    pub(crate) duration: String,
    /// Peak acceleration [default: that of the code for time histories, or of the spectrum at T = 0]
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) pga: Option<String>,
    /// First and last matched period [default: from 0.05 s, or four steps, to 6 s, or the end of the spectrum]
    #[arg(long, value_delimiter = ',', num_args = 2)]
    pub(crate) periods: Vec<String>,
    /// Damping ratio
    #[arg(long, default_value = "0.05")]
    pub(crate) damping: String,
    /// Largest difference from the spectrum
    #[arg(long, default_value = "0.05")]
    pub(crate) tolerance: String,
}

#[derive(Debug, Args)]
pub(crate) struct SynthNoiseArgs {
    #[command(flatten)]
    pub(crate) wave: WaveArgs,
    /// Peak acceleration
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) pga: String,
    /// Seed of the noise
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// Length of the motion
    #[arg(long, default_value = "30 s", value_name = "TIME")]
    pub(crate) duration: String,
    /// Frequency of the ground filter
    #[arg(long, default_value = "2.5 Hz")]
    pub(crate) frequency: String,
    /// Damping of the ground filter
    #[arg(long, default_value = "0.6")]
    pub(crate) ground_damping: String,
    /// Frequency of the second filter; 0 disables it
    #[arg(long, default_value = "0.25 Hz")]
    pub(crate) corner: String,
    /// Damping of the second filter
    #[arg(long, default_value = "0.6")]
    pub(crate) corner_damping: String,
}

#[derive(Debug, Args)]
pub(crate) struct SynthPulseArgs {
    #[command(flatten)]
    pub(crate) wave: WaveArgs,
    /// mavroeidis, makris-a, makris-b, makris-c1, makris-c2, …
    #[arg(long)]
    pub(crate) shape: String,
    /// Peak velocity
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) velocity: String,
    /// Period of the pulse
    #[arg(long, value_name = "TIME")]
    pub(crate) period: String,
    /// Oscillations of a mavroeidis pulse, above 1
    #[arg(long, default_value = "2")]
    pub(crate) gamma: String,
    /// Phase of a mavroeidis pulse in rad
    #[arg(long, default_value = "0", allow_hyphen_values = true)]
    pub(crate) phase: String,
    /// Time at rest before the pulse
    #[arg(long, default_value = "1 s", value_name = "TIME")]
    pub(crate) before: String,
    /// Time at rest after the pulse
    #[arg(long, default_value = "5 s", value_name = "TIME")]
    pub(crate) after: String,
}

#[derive(Debug, Args)]
pub(crate) struct SynthRecipeArgs {
    /// Name of the motion
    pub(crate) name: String,
    /// File to write: .at2 or .csv
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: PathBuf,
    /// Replace the file if it exists
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, Args)]
pub(crate) struct SelectArgs {
    #[command(flatten)]
    pub(crate) target: TargetArgs,
    /// Recorded motions: built-in names or files
    #[arg(long, value_delimiter = ',')]
    pub(crate) natural: Vec<String>,
    /// Artificial motions: built-in names or files
    #[arg(long, value_delimiter = ',')]
    pub(crate) artificial: Vec<String>,
    /// Main periods of the structure in s; the longest is T1
    #[arg(long, value_delimiter = ',', required = true)]
    pub(crate) periods: Vec<String>,
    /// Effective mass ratio of each period [default: equal ones]
    #[arg(long, value_delimiter = ',')]
    pub(crate) mass_ratios: Vec<String>,
    /// Damping ratio
    #[arg(long, default_value = "0.05")]
    pub(crate) damping: String,
    /// Peak acceleration of every motion [default: that of the code for time histories]
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) pga: Option<String>,
    /// Do not scale the motions
    #[arg(long, conflicts_with = "pga")]
    pub(crate) unscaled: bool,
    /// Print JSON and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Write a page with charts
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
    /// Replace files even if jostle did not write them
    #[arg(long)]
    pub(crate) force: bool,
}
