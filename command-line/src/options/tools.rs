//! The options of the commands that help while a line is made.

use super::{Format, InputOptions};
use clap::{Args, Subcommand, ValueEnum};
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
pub struct WhyOptions {
    #[command(flatten)]
    pub input: InputOptions,
    /// Time of the run in seconds; default: its end
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub at: Option<String>,
    /// Only this machine; may be given several times
    #[arg(long, value_name = "NAME")]
    pub robot: Vec<String>,
    /// Also say when the clauses became true after that time, and when the machines left their states
    #[arg(long, requires = "at")]
    pub until: bool,
    /// Number of scans by which devices answer late: a number, or `random` or `random:SEED` for 0 to 5
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value = "0")]
    pub io_delay: String,
}

#[derive(Args, Debug)]
pub struct CompareOptions {
    /// A layout, a `results.json`, or a folder with one
    #[arg(value_name = "A")]
    pub first: PathBuf,
    /// The other one, of the same kind
    #[arg(value_name = "B")]
    pub second: PathBuf,
    /// Of layouts: a folder of automata (*.aut), or one such file, for both
    #[arg(long, value_name = "PATH")]
    pub specs: Vec<PathBuf>,
    /// Of layouts: the scenario of both; default: the one of each
    #[arg(long, value_name = "FILE")]
    pub scenario: Option<PathBuf>,
    /// Of layouts: sets a parameter or a key of the device in both, such as agv.capacity=4
    #[arg(long = "set", value_name = "NAME.KEY=VALUE")]
    pub settings: Vec<String>,
    #[arg(long, value_enum, default_value = "text")]
    pub format: Format,
    /// Print errors only
    #[arg(short, long)]
    pub quiet: bool,
}

impl CompareOptions {
    /// What one of the two layouts is run with.
    pub fn input(&self, layout: &Path) -> InputOptions {
        InputOptions {
            layout: layout.into(),
            specs: self.specs.clone(),
            scenario: self.scenario.clone(),
            settings: self.settings.clone(),
            order: None,
            format: self.format,
            quiet: self.quiet,
        }
    }
}

#[derive(Args, Debug)]
pub struct FmtOptions {
    /// Files of automata, or folders of them (*.aut)
    #[arg(required = true, value_name = "PATH")]
    pub paths: Vec<PathBuf>,
    /// Change nothing; name the files that are not formatted, and end with 1 if there are any
    #[arg(long)]
    pub check: bool,
    /// Print errors only
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Args, Debug)]
pub struct CompletionsOptions {
    /// The shell
    pub shell: clap_complete::Shell,
}

#[derive(Args, Debug)]
pub struct LspOptions {
    /// No effect; many editors give this option
    #[arg(long, hide = true)]
    pub stdio: bool,
}

#[derive(Args, Debug)]
pub struct SchemaOptions {
    #[arg(value_enum, value_name = "WHAT")]
    pub of: SchemaOf,
    /// Of layouts: a folder of automata (*.aut), or one such file, whose types the schema knows beside the library's
    #[arg(long, value_name = "PATH")]
    pub specs: Vec<PathBuf>,
    /// Of layouts: the scenario whose kinds of part the schema knows
    #[arg(long, value_name = "FILE")]
    pub scenario: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SchemaOf {
    Layout,
    Scenario,
}

#[derive(Args, Debug)]
pub struct TestOptions {
    /// Files of tests (*.test), or folders that are searched for them, to a depth of 8
    #[arg(required = true, value_name = "PATH")]
    pub paths: Vec<PathBuf>,
    /// Engines of the controllers, such as `executor,rust,st`: the reference executor, the compiled Rust, the
    /// Structured Text on an evaluator
    #[arg(long, value_enum, value_delimiter = ',', value_name = "ENGINE", default_value = "executor")]
    pub on: Vec<TestEngine>,
    /// A folder of automata (*.aut), or one such file: adds to the library and replaces types of the same name
    #[arg(long, value_name = "PATH")]
    pub specs: Vec<PathBuf>,
    /// Also write the results to this file, as XML in the JUnit format
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Print failures only
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TestEngine {
    Executor,
    Rust,
    St,
}

impl TestEngine {
    /// Behind the title of a test; of the reference executor nothing.
    pub fn suffix(self) -> &'static str {
        match self {
            TestEngine::Executor => "",
            TestEngine::Rust => " (compiled Rust)",
            TestEngine::St => " (Structured Text)",
        }
    }
}

#[derive(Args, Debug)]
pub struct NewOptions {
    /// The new folder; it may exist if it is empty
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Print errors only
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Args, Debug)]
pub struct ImportOptions {
    #[command(subcommand)]
    pub format: ImportFormat,
}

#[derive(Debug, Subcommand)]
pub enum ImportFormat {
    /// An arm of six axes from URDF: joints, limits, velocities, collision shapes
    Urdf(UrdfOptions),
    /// An arm of six axes from a YAML file of OPW parameters: lengths, offsets and signs
    Opw(OpwOptions),
    /// Tracks of vehicles from LIF, the Layout Interchange Format of the VDMA
    Lif(LifOptions),
}

#[derive(Args, Debug)]
pub struct UrdfOptions {
    /// The file; xacro is to be expanded before
    pub file: PathBuf,
    /// The link that stands still; default: the root of the tree
    #[arg(long, value_name = "LINK")]
    pub base: Option<String>,
    /// The link whose frame is the flange; default: `tool0`, `flange` or `ee_link` behind the last joint, else its link
    #[arg(long, value_name = "LINK")]
    pub tip: Option<String>,
    /// Read meshes from this folder: of `package://NAME/PATH` the file PATH in it. Only STL is read; a box is written
    /// for each mesh
    #[arg(long, value_name = "DIR")]
    pub meshes: Option<PathBuf>,
    /// Name of the device; default: that of the robot
    #[arg(long)]
    pub name: Option<String>,
    /// Print errors only
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Args, Debug)]
pub struct OpwOptions {
    /// The file
    pub file: PathBuf,
    /// Name of the device; default: that of the file
    #[arg(long)]
    pub name: Option<String>,
    /// Print errors only
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Args, Debug)]
pub struct LifOptions {
    /// The file
    pub file: PathBuf,
    /// The type of vehicle whose edges are taken; default: the only one of the file
    #[arg(long, value_name = "TYPE")]
    pub vehicle: Option<String>,
    /// Name of the device; default: that of the project
    #[arg(long)]
    pub name: Option<String>,
    /// Print errors only
    #[arg(short, long)]
    pub quiet: bool,
}
