//! Judges the texts named on the command line.

use autogen_st_judge::dead::dead;
use autogen_st_judge::{judge, listed};

fn main() -> std::process::ExitCode {
    let mut clean = true;
    for path in std::env::args().skip(1) {
        let source = match std::fs::read_to_string(&path) {
            Ok(source) => source,
            Err(error) => {
                eprintln!("{path}: {error}");
                return 2.into();
            }
        };
        match judge(&source) {
            Err(findings) => {
                clean = false;
                println!("{path}: {} findings\n{}", findings.len(), listed(&findings, &source));
            }
            Ok(checked) => {
                println!("{path}: no findings; untried:\n{}", listed(&checked.untried, &source));
                println!("dead:\n{}", listed(&dead(&checked), &source));
            }
        }
    }
    u8::from(!clean).into()
}
