//! Command lines by choices, from the definition of the command line itself.

use super::json::any;
use arbitrary::{Result, Unstructured};
use autogen_command_line::Cli;
use clap::{ArgAction, CommandFactory};

pub fn command_line(u: &mut Unstructured) -> Result<String> {
    let cli = Cli::command();
    let commands: Vec<_> = cli.get_subcommands().collect();
    let command = u.choose(&commands)?;
    let mut words = vec![command.get_name().to_string()];
    let options: Vec<_> = command.get_arguments().filter(|a| !a.is_positional()).collect();
    let positional: Vec<_> = command.get_arguments().filter(|a| a.is_positional()).collect();
    for argument in &positional {
        words.push(value(u, argument.get_id().as_str())?);
    }
    for _ in 0..u.int_in_range(0..=5)? {
        let Some(option) = (!options.is_empty()).then(|| u.choose(&options)).transpose()? else { break };
        let Some(name) = option.get_long() else { continue };
        let takes_value = !matches!(option.get_action(), ArgAction::SetTrue | ArgAction::Help);
        let possible = option.get_possible_values();
        let value = match (takes_value, possible.is_empty() || u.ratio(1, 16)?) {
            (false, _) => None,
            (true, true) => Some(value(u, name)?),
            (true, false) => Some(u.choose(&possible)?.get_name().to_string()),
        };
        match value {
            None => words.push(format!("--{name}")),
            Some(value) if u.ratio(1, 2)? => words.push(format!("--{name}={value}")),
            Some(value) => words.extend([format!("--{name}"), value]),
        }
    }
    Ok(words.join("\n"))
}

fn value(u: &mut Unstructured, name: &str) -> Result<String> {
    Ok(match name {
        "set" => {
            let target = u.choose(&["agv", "agv1", "kitting", "gantry", "station", "x", ""])?;
            let parameter = u.choose(&["capacity", "speed", "hover", "clearance", "x", ""])?;
            let mut values = Vec::new();
            for _ in 0..u.int_in_range(1..=3)? {
                values.push(any(u, 2)?);
            }
            format!("{target}.{parameter}={}", values.join(","))
        }
        "order" | "io-delay" | "jobs" | "every" => u
            .choose(&[
                "0", "1", "7", "1000", "1001", "random", "random:3", "random:", "0.1", "-1", "1,2", "1e3",
            ])?
            .to_string(),
        "code" => u.choose(&["E0401", "E9999", "", "e0401", "## E0101"])?.to_string(),
        _ => u.choose(&["line.json", "a/b.csv", "", "--", "x.svg", "é"])?.to_string(),
    })
}
