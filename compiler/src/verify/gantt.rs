//! An execution as a Gantt chart, SVG: a row for each machine, a column for each scan in which something happens.

use crate::lower::Project;
use crate::plain;
use autogen_search::story::Execution;
use std::fmt::Write;

/// Pixels: of names, of a column, of a row, of a bar, and of the numbers above.
const GUTTER: usize = 150;
const COLUMN: usize = 44;
const ROW: usize = 26;
const BAR: usize = 18;
const TOP: usize = 26;
/// About the width of a letter.
const LETTER: f64 = 6.2;

/// Bars are states, dots are what devices did, and the last column is that of the violation.
pub fn svg(project: &Project, execution: &Execution) -> String {
    let instances = &project.system.instances;
    let happened: Vec<usize> = (0..execution.scans.len())
        .filter(|scan| {
            let at = &execution.scans[*scan];
            *scan + 1 == execution.scans.len() || !at.events.is_empty() || !at.told.fired.is_empty()
        })
        .collect();
    let (width, height) = (GUTTER + COLUMN * happened.len() + 8, TOP + ROW * instances.len() + 8);
    let x = |column: usize| GUTTER + COLUMN * column;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"11\">\n"
    );
    let last = happened.len().saturating_sub(1);
    let _ = writeln!(
        out,
        "<rect class=\"violation\" x=\"{}\" y=\"0\" width=\"{COLUMN}\" height=\"{height}\" fill=\"#f6c8c4\"/>",
        x(last)
    );
    for (column, scan) in happened.iter().enumerate() {
        let middle = x(column) + COLUMN / 2;
        let _ = writeln!(
            out,
            "<text x=\"{middle}\" y=\"15\" style=\"text-anchor:middle\" fill=\"#5b6675\">{}</text>",
            scan + 1
        );
    }
    for (number, instance) in instances.iter().enumerate() {
        let y = TOP + ROW * number;
        let text_y = y + BAR / 2 + 4;
        let _ = writeln!(
            out,
            "<text x=\"4\" y=\"{text_y}\" style=\"text-anchor:start\">{}</text>",
            text(&instance.name, GUTTER - 10)
        );
        let automaton = project.system.automaton_of(number);
        let mut bar = (0, 0);
        let mut bars = Vec::new();
        for (column, scan) in happened.iter().enumerate() {
            for fired in execution.scans[*scan].told.fired.iter().filter(|fired| fired.instance == number) {
                let transition = &automaton.states[fired.state].transitions[fired.transition];
                if let Some(target) = transition.target {
                    bars.push((bar, column));
                    bar = (target.0, column);
                }
            }
        }
        bars.push((bar, happened.len()));
        for ((state, from), to) in bars.into_iter().filter(|((_, from), to)| to > from) {
            let wide = COLUMN * (to - from) - 2;
            let name = text(&automaton.states[state].name, wide - 6);
            let _ = writeln!(
                out,
                "<rect x=\"{}\" y=\"{y}\" width=\"{wide}\" height=\"{BAR}\" rx=\"2\" fill=\"#cfdcec\"/><text x=\"{}\" y=\"{text_y}\" style=\"text-anchor:start\">{name}</text>",
                x(from) + 1,
                x(from) + 4
            );
        }
        for (column, scan) in happened.iter().enumerate() {
            if execution.scans[*scan].events.iter().any(|event| event.machine == number) {
                let _ = writeln!(
                    out,
                    "<circle cx=\"{}\" cy=\"{}\" r=\"3\" fill=\"#8a4b08\"/>",
                    x(column) + 1,
                    y + BAR + 2
                );
            }
        }
    }
    out + "</svg>\n"
}

/// As far as there is room for it.
fn text(text: &str, width: usize) -> String {
    let room = (width as f64 / LETTER) as usize;
    let shown: String = text.chars().take(room).collect();
    plain::xml(&shown)
}
