//! Tables: addresses of a small line's points, and figures to stand beside a sweep.

use super::Effort;
use super::line::{small, text};
use crate::judge;
use autogen::backend::st;
use autogen::io_map::{self, Counting, Point};
use autogen::lower::Project;
use autogen::source::Sources;
use autogen_command_line::Measured;
use autogen_tests::Texts;
use std::sync::OnceLock;

struct Line {
    project: Project,
    sources: Sources,
    points: Vec<Point>,
}

fn line() -> &'static Line {
    static LINE: OnceLock<Line> = OnceLock::new();
    LINE.get_or_init(|| {
        let outcome = Texts::of_layout(small("")).compile();
        let project = outcome.project.expect("the small line is right");
        let points = st::points(&project.system);
        Line { project, sources: outcome.sources, points }
    })
}

pub fn answer(input: &[u8], effort: Effort) {
    let text = text(input);
    let Line { project, sources, points } = line();
    let mut tables = Sources::default();
    let file = tables.add("io.csv", text.as_str());
    let counted = [Counting::Words, Counting::Bytes, Counting::Apart];
    let some = match effort {
        Effort::Whole => &counted[..],
        Effort::Sampled | Effort::Rare => std::slice::from_ref(&counted[input.len() % counted.len()]),
    };
    for &counting in some {
        match io_map::read(&tables, file, points, counting) {
            Err(found) => {
                assert!(!found.is_empty(), "refused without a word");
                judge::diagnostics(&tables, &found, input, effort);
            }
            Ok(map) if counting == Counting::Apart && effort.takes(input, 32) => {
                let (files, columns) = st::mapped(&project.system, sources, &map);
                judge::structured_text(&files);
                assert_eq!(
                    runtime_sim::io_trace::Columns::from_text(&columns.to_text()),
                    Ok(columns),
                    "columns that are not read back"
                );
                let mut written = Sources::default();
                let file = written.add("io.csv", files["io.csv"].as_str());
                let again = io_map::read(&written, file, points, counting);
                assert_eq!(again.ok(), Some(map), "the table that is written is not the one that was read");
            }
            Ok(map) => assert!(map.len() <= points.len()),
        }
    }
    beside(&text);
}

/// A figure that is read is a time, and the row that has it is found by its names.
fn beside(text: &str) {
    const COLUMNS: [&str; 4] = ["layout", "agv.capacity", "order", "io_delay"];
    let Ok(mut measured) = Measured::parse("table.csv", text, &COLUMNS) else { return };
    let figure = measured.beside(Some(2.0), |_| String::new());
    assert!(figure.seconds_per_order.is_none_or(|s| s.is_finite() && s > 0.0), "{figure:?}");
    assert_eq!(figure.seconds_per_order.is_some(), figure.ratio.is_some());
    assert_eq!(measured.rms().is_some(), figure.ratio.is_some());
}
