//! The options of the command line.

mod tools;

pub use tools::{
    CompareOptions, CompletionsOptions, FmtOptions, ImportFormat, ImportOptions, LifOptions, LspOptions,
    NewOptions, OpwOptions, SchemaOf, SchemaOptions, TestEngine, TestOptions, UrdfOptions, WhyOptions,
};

use super::output::Overwrite;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

/// Compiles a factory layout and parameterized automata into controllers that can be deployed.
#[derive(Debug, Parser)]
#[command(name = "autogen", version, after_help = STATUS)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
}

const STATUS: &str = "Exit status: 0 done; 1 the input has errors, or a --check found a difference; \
2 wrong command line; \
3 the run did not reach its goal, compare found a difference, a test failed, or verify found a violation; \
4 undecided: a limit of verify came first; 70 a bug in autogen.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Write a small line to begin with, with a type of its own, a scenario and tests
    New(NewOptions),
    /// Read everything, check specifications and connectivity, print the verdict
    Check(CheckOptions),
    /// Check, then write the controllers and their files
    Build(BuildCommandOptions),
    /// Build, link the controllers with the simulator, run the scenario
    Commission(CommissionOptions),
    /// Run every layout with every combination of values, and print a table
    #[command(after_help = SWEEP_STATUS)]
    Sweep(SweepOptions),
    /// Join the parts of a sweep: print the table of the whole sweep
    Merge(MergeOptions),
    /// Search all possible sequences of events: late answers, failed commands, lost items
    Verify(VerifyOptions),
    /// Print the connectivity graph or an automaton as DOT, or the layout from above as SVG
    Graph(GraphOptions),
    /// Print the long text of a diagnostic
    Explain(ExplainOptions),
    /// Say what each machine waits for at a time of the run, and which machine waits for which
    Why(WhyOptions),
    /// Compare two results, or the runs of two layouts: all differences, and the first one
    #[command(after_help = COMPARE_STATUS)]
    Compare(CompareOptions),
    /// Run the tests in files next to specifications
    #[command(after_help = TEST_STATUS)]
    Test(TestOptions),
    /// Print a device text for an arm or for tracks of vehicles from a file of another program
    Import(ImportOptions),
    /// Format files of automata
    #[command(after_help = FMT_STATUS)]
    Fmt(FmtOptions),
    /// Print the JSON Schema of layouts or scenarios, for editors
    Schema(SchemaOptions),
    /// Print the completions of the command line for a shell
    Completions(CompletionsOptions),
    /// Serve an editor: diagnostics, definitions, references, hover, renaming, completion and formatting, by the
    /// Language Server Protocol on standard input and output
    Lsp(LspOptions),
}

#[derive(Args, Debug)]
pub struct InputOptions {
    /// The layout, a JSON file
    pub layout: PathBuf,
    /// A folder of automata (*.aut), or one such file: adds to the library and replaces types of the same name
    #[arg(long, value_name = "PATH")]
    pub specs: Vec<PathBuf>,
    /// The scenario, a JSON file; default: `scenario.json` beside the layout, else the built-in one
    #[arg(long, value_name = "FILE")]
    pub scenario: Option<PathBuf>,
    /// Sets a parameter or a key of the device, of a type or of one machine, such as agv.capacity=4 or mill.cut=60
    #[arg(long = "set", value_name = "NAME.KEY=VALUE")]
    pub settings: Vec<String>,
    /// Steps the robots in an order drawn from this seed instead of layout order
    #[arg(long, value_name = "SEED", allow_negative_numbers = true, value_parser = seed)]
    pub order: Option<u64>,
    #[arg(long, value_enum, default_value = "text")]
    pub format: Format,
    /// Print errors only
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Args, Debug)]
pub struct CheckOptions {
    #[command(flatten)]
    pub input: InputOptions,
    /// Diagnostics that end the check with exit status 1, as errors do
    #[arg(long, value_enum, value_name = "WHAT")]
    pub deny: Option<Denied>,
    /// Note transitions that can fire at the same time, of which the first one does
    #[arg(long)]
    pub notes: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Denied {
    Warnings,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    Text,
    Json,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Addresses {
    /// %IW1 is the bytes 2 and 3 (CODESYS)
    Words,
    /// %IW1 is the bytes 1 and 2 (TwinCAT)
    Bytes,
    /// %IX, %IB, %IW and %ID are separate memories (OpenPLC)
    Apart,
}

#[derive(Args, Debug)]
pub struct BuildOptions {
    #[command(flatten)]
    pub input: InputOptions,
    /// Where to write; default: out/<layout name>
    #[arg(short, long = "output", value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Addresses of the process image: plc/io.csv, with its last five columns filled
    #[arg(long, value_name = "FILE")]
    pub io: Option<PathBuf>,
    /// How the PLC counts addresses, to find two that overlap
    #[arg(long, value_enum, default_value = "words", requires = "io")]
    pub addresses: Addresses,
    /// Texts of alarms and states in other languages: plc/texts.csv, with a column for each language
    #[arg(long, value_name = "FILE")]
    pub texts: Option<PathBuf>,
    /// Do not write the Structured Text as PLCopen XML, plc/*/project.xml, which is a third of the output of a long line
    #[arg(long)]
    pub no_plcopen: bool,
    /// Also write the reference blocks for drives, plc/drives/*.st
    #[arg(long)]
    pub drives: bool,
    /// Overwrite files that autogen did not write or that were changed since
    #[arg(long)]
    pub force: bool,
}

#[derive(Args, Debug)]
pub struct BuildCommandOptions {
    #[command(flatten)]
    pub build: BuildOptions,
    /// Write nothing; say which files of the folder differ from what would be written, and end with 1 if any does
    #[arg(long, conflicts_with = "force")]
    pub check: bool,
}

impl BuildOptions {
    pub fn overwrite(&self) -> Overwrite {
        if self.force { Overwrite::Everything } else { Overwrite::Own }
    }
}

#[derive(Args, Debug)]
pub struct CommissionOptions {
    #[command(flatten)]
    pub build: BuildOptions,
    /// Number of scans by which devices answer late: a number, or `random` or `random:SEED` for 0 to 5
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value = "0")]
    pub io_delay: String,
    /// Write a row for each scan to this file: inputs, outputs, states and shared cells, as comma-separated
    /// values under the names of the Structured Text
    #[arg(long, value_name = "FILE")]
    pub io_trace: Option<PathBuf>,
    /// Write the hash of each scan's trace to this file, a line each
    #[arg(long, value_name = "FILE")]
    pub hashes: Option<PathBuf>,
    /// Do not write report.html, the page of the run
    #[arg(long)]
    pub no_report: bool,
    /// Execute every scan, also those in which nothing can happen; events and results are the same
    #[arg(long)]
    pub every_scan: bool,
    #[command(flatten)]
    pub trajectories: TrajectoryOptions,
}

#[derive(Args, Debug)]
#[command(next_help_heading = "Paths of the items")]
pub struct TrajectoryOptions {
    /// Write the path of each item: sampled (.csv), as exact segments (.json) or drawn from above (.svg);
    /// may be given several times
    #[arg(long = "trajectories", value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Seconds between two samples of a .csv, in whole milliseconds
    #[arg(
        long,
        value_name = "SECONDS",
        allow_negative_numbers = true,
        default_value = "0.1",
        requires = "files"
    )]
    pub every: String,
    /// Only these items, such as battery_1,pump_3; default: all that came onto the line
    #[arg(long, value_name = "NAMES", value_delimiter = ',', requires = "files")]
    pub items: Vec<String>,
}

#[derive(Args, Debug)]
pub struct SweepOptions {
    /// The layouts, JSON files
    #[arg(required = true)]
    pub layouts: Vec<PathBuf>,
    /// A folder of automata (*.aut), or one such file: adds to the library and replaces types of the same name
    #[arg(long, value_name = "PATH")]
    pub specs: Vec<PathBuf>,
    /// The scenario, a JSON file; default: `scenario.json` beside each layout, else the built-in one
    #[arg(long, value_name = "FILE")]
    pub scenario: Option<PathBuf>,
    /// Values of a parameter or of a key of the device, of a type or of one machine, such as agv.capacity=2,4,8 or
    /// mill.cut=30,60; commas within brackets or quotes belong to a value
    #[arg(long = "set", value_name = "NAME.KEY=V1,V2,...")]
    pub settings: Vec<String>,
    /// Seeds of orders of the steps; without it, layout order
    #[arg(long, value_name = "SEED,...", allow_negative_numbers = true, value_delimiter = ',', value_parser = seed)]
    pub order: Vec<u64>,
    /// Numbers of scans by which devices answer late, `random` or `random:SEED` for 0 to 5
    #[arg(long, value_name = "N,...", allow_negative_numbers = true, value_delimiter = ',')]
    pub io_delay: Vec<String>,
    /// Runs of each point: the first with the seeds that are given, each further one with the seed of the supply and that
    /// of random delays one higher, the same for all points. Rows then have means, with half of the width of their 95 %
    /// intervals. Default: 1; with --until-precision, at most 100
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = replications)]
    pub replications: Option<NonZeroU32>,
    /// Repeat each point, five times at least, until half of the width of the 95 % interval of its seconds per
    /// order is at most this percentage of their mean
    #[arg(long, value_name = "P%", allow_negative_numbers = true)]
    pub until_precision: Option<String>,
    /// Orders at the start of each run that do not count for its seconds per order: `20orders`, those of the first
    /// `600s`, or `auto`, by MSER-5
    #[arg(long, value_name = "auto|Norders|Ss")]
    pub warm_up: Option<String>,
    /// Only part K of N of the runs, as lines that `autogen merge` joins to a table; options for the
    /// table and its page are for `merge`
    #[arg(long, value_name = "K/N", conflicts_with_all = ["beside", "compare", "format"])]
    pub part: Option<String>,
    /// Write the rows as a page with charts to this file, for any browser
    #[arg(long, value_name = "FILE.html", conflicts_with = "part")]
    pub report: Option<PathBuf>,
    /// Rows whose runs are kept as pages, with links in the report: numbers from 1 such as 1,4, or `all`. With
    /// several replications, the first one is kept. The pages are in a folder next to the report
    #[arg(long, value_name = "ROWS", requires = "report", conflicts_with = "part")]
    pub keep: Option<String>,
    /// Number of runs at the same time; default: one for each processor
    #[arg(short, long, value_name = "N", allow_negative_numbers = true, value_parser = jobs)]
    pub jobs: Option<NonZeroUsize>,
    #[command(flatten)]
    pub table: TableOptions,
}

#[derive(Args, Debug)]
pub struct TableOptions {
    /// Figures to show beside the rows: a CSV file with the column seconds_per_order and columns of the
    /// sweep's own CSV that name a point, such as layout and agv.capacity
    #[arg(long, value_name = "FILE")]
    pub beside: Option<PathBuf>,
    /// Show the difference of the seconds per order from those of the first point with the same seeds: mean, half of
    /// the width of its 95 % interval, and the number of pairs
    #[arg(long)]
    pub compare: bool,
    #[arg(long, value_enum, default_value = "text")]
    pub format: TableFormat,
    /// Print no progress, and as text only the rows that did not finish
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Args, Debug)]
pub struct MergeOptions {
    /// The files of `autogen sweep --part`, all parts of one sweep in any order
    #[arg(required = true, value_name = "FILE")]
    pub parts: Vec<PathBuf>,
    /// Write the rows as a page with charts to this file, for any browser
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    #[command(flatten)]
    pub table: TableOptions,
}

const COMPARE_STATUS: &str =
    "Exit status: 0 the same; 1 the input has errors; 2 wrong command line; 3 different.";

const TEST_STATUS: &str = "Exit status: 0 all tests passed; 1 a test, or a line that it names, has errors; \
2 wrong command line; 3 a test failed.";

const FMT_STATUS: &str = "Exit status: 0 done, or all are formatted; 1 a file has errors, and none was changed, \
or `--check` found one that is not formatted; 2 wrong command line.";

const SWEEP_STATUS: &str = "A point that is refused, faults or runs out of time is a row with its reason.

Exit status: 0 all points made all their orders; 1 every layout has errors in its texts or types; \
2 wrong command line, or the controllers could not be compiled; 3 some points were refused or did not reach their goal; 70 a bug in autogen.";

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TableFormat {
    Text,
    /// One object
    Json,
    Csv,
    /// An object for each row, a line each
    Jsonl,
}

#[derive(Args, Debug)]
pub struct VerifyOptions {
    #[command(flatten)]
    pub input: InputOptions,
    /// Greatest number of devices that answer in one scan; default: one, and if nothing is found any number
    #[arg(long, value_name = "K", allow_negative_numbers = true, value_parser = answers)]
    pub answers: Option<NonZeroUsize>,
    /// No command fails and no item is lost
    #[arg(long)]
    pub no_faults: bool,
    /// Orders in which the machines step
    #[arg(long, value_enum, default_value = "one")]
    pub orders: StepOrders,
    /// Properties that are searched although a violation only warns
    #[arg(long, value_enum, default_value = "own")]
    pub warnings: Warnings,
    /// Limit of time or memory, such as 90s, 10min, 500MB or 2GB; one of each may be given. Default: 10min and 2GB
    #[arg(long, value_name = "LIMIT")]
    pub limit: Vec<String>,
    /// Number of processors that search; default: all
    #[arg(short, long, value_name = "N", allow_negative_numbers = true, value_parser = jobs)]
    pub jobs: Option<NonZeroUsize>,
    /// Continue after a violation, and report each different one
    #[arg(long)]
    pub all: bool,
    /// Write the scenario that shows the first violation in `commission` to this file
    #[arg(long, value_name = "FILE")]
    pub counterexample: Option<PathBuf>,
    /// Write a page with the Gantt chart and the plan of the first violation to this file
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Warnings {
    /// None of them
    None,
    /// Those of your own types and interfaces
    Own,
    /// Those of the library too
    All,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StepOrders {
    /// The order of the line
    One,
    /// Any order, which may change with each scan
    All,
}

impl From<StepOrders> for autogen_search::successor::Orders {
    fn from(orders: StepOrders) -> Self {
        match orders {
            StepOrders::One => Self::One,
            StepOrders::All => Self::All,
        }
    }
}

#[derive(Args, Debug)]
#[command(mut_arg("format", |format| format.hide(true)))]
pub struct GraphOptions {
    #[command(flatten)]
    pub input: InputOptions,
    /// `connectivity`, `plan` (the layout from above, SVG), or a type such as `agv`
    #[arg(long, value_name = "WHAT", default_value = "connectivity")]
    pub of: String,
}

#[derive(Args, Debug)]
pub struct ExplainOptions {
    /// Such as E0401
    pub code: String,
}

/// Threads at the same time: each takes memory of its own.
const MOST_JOBS: usize = 1024;

fn jobs(text: &str) -> Result<NonZeroUsize, String> {
    let number = text.parse().ok().filter(|number: &NonZeroUsize| number.get() <= MOST_JOBS);
    number.ok_or_else(|| format!("a whole number from 1 to {MOST_JOBS}"))
}

fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "a whole number from 0".into())
}

fn replications(text: &str) -> Result<NonZeroU32, String> {
    text.parse().map_err(|_| format!("a whole number from 1 to {}", u32::MAX))
}

fn answers(text: &str) -> Result<NonZeroUsize, String> {
    text.parse().map_err(|_| "a whole number from 1".into())
}
