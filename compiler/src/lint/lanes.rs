//! Conveyors that nearly meet.

use crate::diagnostic::Diagnostic;
use crate::layout::Layout;
use runtime_sim::frame::Frame;
use runtime_sim::line::Line;
use runtime_sim::plant::{Gap, gaps};
use runtime_sim::point::Point;

/// One for each pair of conveyors of which one ends a little beside the beginning of the other one.
pub fn check(layout: &Layout, line: &Line) -> Vec<Diagnostic> {
    gaps(line).iter().filter_map(|gap| diagnostic(layout, line, gap)).collect()
}

fn diagnostic(layout: &Layout, line: &Line, gap: &Gap) -> Option<Diagnostic> {
    let [from, to] = [gap.from, gap.to].map(|(machine, part)| {
        let machine = &line.machines[machine];
        format!("`{}` of {}", machine.parts[part].name, machine.name)
    });
    let name = &line.machines[gap.to.0].name;
    let object = layout.objects.iter().find(|object| object.name.value == *name)?;
    let mm = gap.off().length() * 1000.0;
    let message = format!(
        "the conveyor {from} ends {mm:.0} mm from where {to} begins: they are not joined, and items fall where the first one ends"
    );
    let diagnostic = Diagnostic::new("W0201", object.pose.span, message);
    let is_turned = gap.turn().abs() > ALIGNED;
    let diagnostic = match is_turned {
        true => diagnostic.note(format!("their directions differ by {:.1} degrees", gap.turn().abs())),
        false => diagnostic,
    };
    if gap.from.0 == gap.to.0 {
        return Some(diagnostic.help("let one begin where the other one ends, in the device"));
    }
    // The machine as it is, with its beginning at the end of the other one.
    let moved = match is_turned {
        true => gap.end.then(gap.begin.inverse()).then(object.pose.value),
        false => Frame { position: object.pose.value.position + gap.off(), ..object.pose.value },
    };
    let rounded = |number: f64| format!("{}", (number * 1e6).round() / 1e6 + 0.0);
    let Point { x, y, z } = moved.position;
    let pose = [x, y, z].map(rounded).join(", ");
    let yaw = if moved.yaw == 0.0 { String::new() } else { format!(", {}", rounded(moved.yaw)) };
    Some(diagnostic.help(format!("if they should be joined, write \"pose\": [{pose}{yaw}] for {name}")))
}

/// Less is no fault of the direction, degrees.
const ALIGNED: f64 = 1.0;
