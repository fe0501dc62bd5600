//! Conveyors and places through which a vehicle drives, where no contact is found.

use crate::diagnostic::Diagnostic;
use crate::layout::{Layout, Object};
use runtime_sim::collision::{DrivenThrough, driven_through};
use runtime_sim::line::Line;

pub fn check(layout: &Layout, line: &Line) -> Vec<Diagnostic> {
    driven_through(line).iter().filter_map(|found| diagnostic(layout, line, found)).collect()
}

fn diagnostic(layout: &Layout, line: &Line, found: &DrivenThrough) -> Option<Diagnostic> {
    let [vehicle, machine] = [found.vehicle, found.machine].map(|machine| &line.machines[machine]);
    let object = |name: &str| layout.objects.iter().find(|object| object.name.value == name);
    let stands = |object: &Object| object.at.as_ref().map_or(object.pose.span, |at| at.span);
    let part = &machine.parts[found.part];
    let message = format!(
        "`{}` of {} drives through the {} `{}` of {}",
        found.body,
        vehicle.name,
        part.schema().name,
        part.name,
        machine.name
    );
    let told = Diagnostic::new("W0204", stands(object(&machine.name)?), message)
        .other(stands(object(&vehicle.name)?), "the vehicle")
        .note(format!("it is there when the vehicle is at ({:.3}, {:.3})", found.at.x, found.at.y))
        .note("conveyors and places have no solid of their own: a run finds no contact there");
    Some(told.help(format!(
        "move the path of the vehicle or {}; or give its device a body there, so that runs find the contact",
        machine.name
    )))
}
