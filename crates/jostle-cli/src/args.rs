//! Arguments of commands, as typed.

use std::path::PathBuf;

use jostle_section::capacity::CapacityRule;

use crate::Described;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "bash: jostle completions bash > ~/.local/share/bash-completion/completions/jostle\n\
                  zsh:  jostle completions zsh > FOLDER_OF_FPATH/_jostle\n\
                  fish: jostle completions fish > ~/.config/fish/completions/jostle.fish"
)]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}

#[derive(Debug, clap::Args)]
pub(crate) struct SchemaArgs {
    /// Print a page in Markdown instead
    #[arg(long)]
    pub(crate) markdown: bool,
    /// List every quantity of the results instead: name, unit, meaning, where it appears
    #[arg(long)]
    pub(crate) results: bool,
    /// List every check instead: what it compares, limits, source, remedy
    #[arg(long, conflicts_with = "results")]
    pub(crate) checks: bool,
    /// Print a table of features by kind of building instead, in Markdown
    #[arg(long, conflicts_with_all = ["results", "checks"])]
    pub(crate) combinations: bool,
}

impl SchemaArgs {
    pub(crate) fn list(&self) -> Described {
        match (self.combinations, self.checks, self.results) {
            (true, ..) => Described::Combinations,
            (_, true, _) => Described::Checks,
            (.., true) => Described::Results,
            _ => Described::Model,
        }
    }
}

/// A model, and options that change it.
#[derive(Debug, clap::Args)]
pub(crate) struct ModelArgs {
    /// Model file (TOML or JSON), or the name of a built-in example; without it, the built-in "paper"
    pub(crate) model: Option<PathBuf>,
    /// Scale the motion to this peak ground acceleration
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) pga: Option<String>,
    /// Smallest width of every gap; listed widths shift by the same amount
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    pub(crate) gap: Option<String>,
    /// Use this ground motion: a built-in name or a file
    #[arg(long, value_name = "RECORD")]
    pub(crate) record: Option<String>,
    /// Angle in plan from x to the motion, counter-clockwise, for buildings with a plan: --angle 30deg
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    pub(crate) angle: Option<String>,
    /// Accept values outside their usual ranges, like accept_unusual = true in the model file
    #[arg(long)]
    pub(crate) accept_unusual: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    /// Folder for site.svg, a plan view of the buildings, for models with plans [default: jostle-out/MODEL]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace site.svg even if jostle did not write it
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    /// Folder for the results [default: jostle-out/MODEL; with --json, none]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Omit the report and the second run without contact; with --json and without --out, also the
    /// histories
    #[arg(long)]
    pub(crate) no_report: bool,
    /// Add the results of `jostle method` to the report
    #[arg(long, conflicts_with = "no_report")]
    pub(crate) method: bool,
    /// Add the peak axial force, shear and moment of every column and beam of frames
    #[arg(long)]
    pub(crate) members: bool,
    /// Add response spectra of every floor, with and without contact, like floor_spectra = true in the model file
    #[arg(long)]
    pub(crate) floor_spectra: bool,
    /// Compare columns and beams with bars, or of steel profiles, with their capacity by these rules; the first rule governs.
    /// Implies --members. Without a rule: all rules, if ties, or yield strengths of profiles, are known
    #[arg(long, value_name = "RULE", num_args = 0..=1, default_missing_values = CapacityRule::ALL.map(CapacityRule::name), value_delimiter = ',', value_parser = clap::builder::PossibleValuesParser::new(CapacityRule::ALL.map(CapacityRule::name)))]
    pub(crate) capacity: Vec<String>,
    /// Also run at both ends of the recommended range of contact stiffness and with restitution ± 0.15, and report
    /// the spread
    #[arg(long)]
    pub(crate) sensitivity: bool,
    /// Add the derivative of every peak with respect to these values of the model file, such as gap[0].width,motion.pga, and the
    /// range in which it is linear; 23 runs for the first value and 22 for each further one
    #[arg(long, value_name = "PATHS", value_delimiter = ',')]
    pub(crate) gradients: Vec<String>,
    /// Use this solver instead of that of the model
    #[arg(long, value_enum)]
    pub(crate) solver: Option<SolverName>,
    /// Also write report.pdf, printed by an installed Chromium browser
    #[arg(long, conflicts_with = "no_report")]
    pub(crate) pdf: bool,
    /// Paper size of report.pdf
    #[arg(long, value_name = "SIZE", default_value = "a4", value_parser = jostle_run::Paper::NAMES, requires = "pdf")]
    pub(crate) paper: String,
    /// Also write an Excel workbook: summary, buildings, floors, contacts, impacts, members; for one record, see --record
    #[arg(long, value_name = "FILE")]
    pub(crate) xlsx: Option<PathBuf>,
    /// Rule for the governing value of several records [default: that of the model, else that of the code under match, else
    /// maximum]
    #[arg(long, value_name = "RULE", value_parser = jostle_motion::GoverningRule::NAMES)]
    pub(crate) governing: Option<String>,
    /// Number of records that run at the same time [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(crate) jobs: Option<u32>,
    /// Print summary.json and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Run solver = "product" even if it is expected to lose all digits, and replace files in the results folder
    /// that jostle did not write
    #[arg(long)]
    pub(crate) force: bool,
}

/// Equations that advance a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum SolverName {
    /// With automatic steps: modal for elastic buildings, and series for shear buildings that yield; otherwise riccati
    Auto,
    /// Riccati transfer recursion
    Riccati,
    /// Direct stiffness, an independent check
    Stiffness,
    /// Product of transfer matrices, as published
    Product,
    /// Mode superposition, for elastic buildings
    Modal,
    /// Power series in time, for shear buildings that yield
    Series,
}

#[derive(Debug, clap::Args)]
pub(crate) struct ModesArgs {
    /// Model file, or the name of a built-in example; without it, the built-in "paper"
    pub(crate) model: Option<PathBuf>,
    /// Modes to list for every building
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(crate) count: u32,
    /// Print JSON and nothing else
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct CollideArgs {
    /// Contact law
    #[arg(long, value_name = "LAW", default_value = "hertz-damp", value_parser = jostle_io::LAW_NAMES)]
    pub(crate) law: String,
    /// A user-defined law instead, such as "k * d^1.5 * (1 + 0.6 * v / v0)": d indentation, v its rate, v0 impact speed, k
    /// stiffness, e restitution, m effective mass, in SI
    #[arg(long, value_name = "FORMULA", conflicts_with_all = ["law", "all", "damping", "variant", "yield_share", "design_speed", "thickness", "exponent", "restitution_is"])]
    pub(crate) formula: Option<String>,
    /// Compare all laws
    #[arg(long, conflicts_with = "law")]
    pub(crate) all: bool,
    /// Mass of the left body
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) m1: String,
    /// Mass of the right body
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) m2: String,
    /// Closing speed at first contact
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) speed: String,
    /// Contact stiffness in N/m^1.5 or N/m; laws of the other family use the stiffness with the same secant at the greatest
    /// elastic Hertz indentation [default: 2e9 N/m^1.5]
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) stiffness: Option<String>,
    /// Coefficient of restitution
    #[arg(long, value_name = "NUMBER", default_value = "0.65")]
    pub(crate) restitution: String,
    /// input: used in the published formula; realised: damping is calibrated so that free masses rebound with it
    #[arg(long, value_name = "MEANING", default_value = "input", value_parser = ["input", "realised"])]
    pub(crate) restitution_is: String,
    /// Dashpot instead of --restitution, for kelvin, kelvin-no-tension and modified-kelvin (mahmoud-jankowski)
    #[arg(long, value_name = "QUANTITY", conflicts_with_all = ["restitution", "restitution_is", "all"])]
    pub(crate) damping: Option<String>,
    /// Variant of modified-kelvin
    #[arg(long, default_value = "ye", value_parser = ["ye", "mahmoud-jankowski"])]
    pub(crate) variant: String,
    /// bilinear: yield indentation ÷ greatest design indentation
    #[arg(long, value_name = "NUMBER", default_value = "0.1")]
    pub(crate) yield_share: String,
    /// bilinear: impact speed used to compute its stiffnesses [default: --speed]
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) design_speed: Option<String>,
    /// rubber: thickness of the bumper
    #[arg(long, value_name = "QUANTITY", default_value = "50 mm")]
    pub(crate) thickness: String,
    /// rubber: exponent of the compression
    #[arg(long, value_name = "NUMBER", default_value = "2.65")]
    pub(crate) exponent: String,
    /// Write the curves to this file
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Write a page with table and charts to this file
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
    /// Print JSON and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Replace files even if jostle did not write them
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MethodArgs {
    /// Model file, or the name of a built-in example; without it, the built-in "paper"
    pub(crate) model: Option<PathBuf>,
    /// Folder for a page with tables and plots, method.html
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace files even if jostle did not write them
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, clap::Args)]
#[command(after_help = "Either a model, or --width, --depth and --bars:\n  \
                  jostle section --width 500mm --depth 500mm --bars \"12 d20\" --axial-load 800kN --length 3.2m")]
pub(crate) struct SectionArgs {
    /// Model file, or the name of a built-in example: analyses every reinforced member
    #[arg(conflicts_with_all = ["width", "depth", "bars"])]
    pub(crate) model: Option<PathBuf>,
    /// Width, perpendicular to the direction of bending
    #[arg(long, value_name = "QUANTITY", required_unless_present = "model")]
    pub(crate) width: Option<String>,
    /// Depth, in the direction of bending
    #[arg(long, value_name = "QUANTITY", required_unless_present = "model")]
    pub(crate) depth: Option<String>,
    /// Bars, such as "12 d20" around, or "4 d25 top, 3 d25 bottom"
    #[arg(long, value_name = "BARS", required_unless_present = "model")]
    pub(crate) bars: Option<String>,
    /// C30, C30/37, "f'c = 4 ksi", or prismatic strength
    #[arg(long, value_name = "GRADE", default_value = "C30")]
    pub(crate) concrete: String,
    /// HRB400, B500B, "Grade 60", or yield strength
    #[arg(long, value_name = "GRADE", default_value = "HRB400")]
    pub(crate) steel: String,
    /// Strength level of the grade
    #[arg(long, value_name = "LEVEL", default_value = jostle_section::StrengthLevel::NAMES[0], value_parser = jostle_section::StrengthLevel::NAMES)]
    pub(crate) strength: String,
    /// Concrete cover of the bars
    #[arg(long, value_name = "QUANTITY", default_value = "35mm")]
    pub(crate) cover: String,
    /// Ties that confine the core, such as "d10 @ 100 mm"
    #[arg(long, value_name = "TIES")]
    pub(crate) ties: Option<String>,
    /// Axial compression; without it, a beam
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    pub(crate) axial_load: Option<String>,
    /// Length of the member, bent in double curvature
    #[arg(long, value_name = "QUANTITY", default_value = "3m")]
    pub(crate) length: String,
    /// Print JSON and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Write a page with the curves and the sections
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
    /// Replace files even if jostle did not write them
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct PushoverArgs {
    /// Model file, or the name of a built-in example; without it, the built-in "paper"
    pub(crate) model: Option<PathBuf>,
    /// Analyse only this building
    #[arg(long, value_name = "NAME")]
    pub(crate) building: Option<String>,
    /// Load pattern over the height: mass × first mode, mass, or mass × height
    #[arg(long, value_enum, default_value_t = Spread::FirstMode)]
    pub(crate) pattern: Spread,
    /// Roof displacement ÷ height at which to stop
    #[arg(long, value_name = "RATIO", default_value = "0.02")]
    pub(crate) drift: String,
    /// Direction of the load
    #[arg(long, value_enum, default_value_t = Push::Right)]
    pub(crate) direction: Push,
    /// Folder for the results [default: jostle-out/MODEL; with --json, none]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Replace files even if jostle did not write them
    #[arg(long)]
    pub(crate) force: bool,
}

/// Distribution of the load of a pushover.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Spread {
    FirstMode,
    Uniform,
    Triangular,
}

/// Direction of the load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Push {
    Left,
    Right,
    Both,
}

#[derive(Debug, clap::Args)]
pub(crate) struct NewArgs {
    /// Name of the file to write; ".toml" is added when it has no extension
    pub(crate) name: PathBuf,
    /// Template to start from
    #[arg(long, value_name = "TEMPLATE", default_value = jostle_io::TEMPLATE_NAMES[0], value_parser = jostle_io::TEMPLATE_NAMES)]
    pub(crate) template: String,
}
