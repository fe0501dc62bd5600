//! Which part of a machine each point of its I/O belongs to, and what its commands ask of the parts.

use crate::device::Extent;
use crate::words::Words;

/// What a device gives all machines of its type. Parts, signals, levels and actions are numbers: of the machine's
/// parts, and in the lists of [`crate::part::Schema`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wiring {
    /// In the order of the process image.
    pub inputs: Vec<Input>,
    pub outputs: Vec<Output>,
    pub commands: Vec<Command>,
}

/// Words that a port takes in a process image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Of one element.
    pub each: usize,
    pub extent: Extent,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    pub size: Size,
    pub source: Source,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The head of every device with commands.
    Ready,
    Got,
    Ack,
    Error,
    Signal {
        part: usize,
        signal: usize,
    },
}

#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    pub size: Size,
    pub drives: Drives,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drives {
    /// The head of every device with commands.
    Command,
    Verb,
    Hold,
    /// An argument of commands.
    Argument,
    Level {
        part: usize,
        level: usize,
    },
}

/// What a numbered command does.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// The value of the output `verb`.
    pub number: i32,
    pub part: usize,
    pub action: usize,
    /// Outputs whose words are the arguments, one after another.
    pub arguments: Vec<usize>,
    /// What it waits for when the action has ended.
    pub then: Option<Await>,
}

/// A signal that has to be true for the command to end well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Await {
    pub part: usize,
    pub signal: usize,
    pub within_ms: u64,
    /// The answer if it is not true by then.
    pub error: i32,
}

impl Size {
    pub fn words(&self, kinds: usize) -> usize {
        self.each.saturating_mul(self.extent.elements(kinds))
    }
}

impl Wiring {
    /// It has numbered commands.
    pub fn is_commanded(&self) -> bool {
        !self.commands.is_empty()
    }

    /// Numbers of all inputs in a process image.
    pub fn input_words(&self, kinds: usize) -> usize {
        self.inputs.iter().map(|input| input.size.words(kinds)).sum()
    }

    pub fn output_words(&self, kinds: usize) -> usize {
        self.outputs.iter().map(|output| output.size.words(kinds)).sum()
    }

    /// Where an input begins in the image.
    pub fn input_at(&self, source: Source, kinds: usize) -> Option<usize> {
        let index = self.inputs.iter().position(|input| input.source == source)?;
        Some(self.inputs[..index].iter().map(|input| input.size.words(kinds)).sum())
    }

    /// Where an output begins in the image.
    pub fn output_at(&self, drives: Drives, kinds: usize) -> Option<usize> {
        let index = self.outputs.iter().position(|output| output.drives == drives)?;
        Some(self.begin_of_output(index, kinds))
    }

    pub fn begin_of_output(&self, index: usize, kinds: usize) -> usize {
        self.outputs[..index].iter().map(|output| output.size.words(kinds)).sum()
    }

    /// Appends the lines that [`Self::read`] reads back.
    pub fn write(&self, out: &mut String) {
        out.push_str(&format!("    inputs {}\n", self.inputs.len()));
        for input in &self.inputs {
            let source = match input.source {
                Source::Ready => "ready".to_string(),
                Source::Got => "got".into(),
                Source::Ack => "ack".into(),
                Source::Error => "error".into(),
                Source::Signal { part, signal } => format!("signal {part} {signal}"),
            };
            out.push_str(&format!("      {} {source}\n", size_text(input.size)));
        }
        out.push_str(&format!("    outputs {}\n", self.outputs.len()));
        for output in &self.outputs {
            let drives = match output.drives {
                Drives::Command => "cmd".to_string(),
                Drives::Verb => "verb".into(),
                Drives::Hold => "hold".into(),
                Drives::Argument => "argument".into(),
                Drives::Level { part, level } => format!("level {part} {level}"),
            };
            out.push_str(&format!("      {} {drives}\n", size_text(output.size)));
        }
        out.push_str(&format!("    commands {}\n", self.commands.len()));
        for Command { number, part, action, arguments, then } in &self.commands {
            let arguments: String = arguments.iter().map(|argument| format!(" {argument}")).collect();
            let count = arguments.split_whitespace().count();
            let then = then.map_or("end".to_string(), |Await { part, signal, within_ms, error }| {
                format!("await {part} {signal} {within_ms} {error}")
            });
            out.push_str(&format!("      {number} {part} {action} {count}{arguments} {then}\n"));
        }
    }

    pub fn read(words: &mut Words) -> Result<Self, String> {
        words.expect("inputs")?;
        let inputs = words.list(|w| Ok(Input { size: read_size(w)?, source: read_source(w)? }))?;
        words.expect("outputs")?;
        let outputs = words.list(|w| Ok(Output { size: read_size(w)?, drives: read_drives(w)? }))?;
        words.expect("commands")?;
        let commands = words.list(|w| {
            let (number, part, action) = (w.int()?, w.int()?, w.int()?);
            let arguments = w.list(|w| w.int())?;
            let then = match w.name()? {
                "end" => None,
                "await" => {
                    Some(Await { part: w.int()?, signal: w.int()?, within_ms: w.int()?, error: w.int()? })
                }
                other => return Err(w.error(format_args!("`{other}` is neither `end` nor `await`"))),
            };
            Ok(Command { number, part, action, arguments, then })
        })?;
        Ok(Self { inputs, outputs, commands })
    }
}

fn size_text(size: Size) -> String {
    let extent = match size.extent {
        Extent::One => "one".to_string(),
        Extent::PerKind => "kinds".into(),
        Extent::Times(n) => n.to_string(),
    };
    format!("{} {extent}", size.each)
}

fn read_size(words: &mut Words) -> Result<Size, String> {
    let each = words.int()?;
    let extent = match words.name()? {
        "one" => Extent::One,
        "kinds" => Extent::PerKind,
        number => match number.parse() {
            Ok(n) => Extent::Times(n),
            Err(_) => return Err(words.error(format_args!("`{number}` is no number of elements"))),
        },
    };
    Ok(Size { each, extent })
}

fn read_source(words: &mut Words) -> Result<Source, String> {
    Ok(match words.name()? {
        "ready" => Source::Ready,
        "got" => Source::Got,
        "ack" => Source::Ack,
        "error" => Source::Error,
        "signal" => Source::Signal { part: words.int()?, signal: words.int()? },
        other => return Err(words.error(format_args!("`{other}` is no source of an input"))),
    })
}

fn read_drives(words: &mut Words) -> Result<Drives, String> {
    Ok(match words.name()? {
        "cmd" => Drives::Command,
        "verb" => Drives::Verb,
        "hold" => Drives::Hold,
        "argument" => Drives::Argument,
        "level" => Drives::Level { part: words.int()?, level: words.int()? },
        other => return Err(words.error(format_args!("`{other}` is nothing that an output drives"))),
    })
}
