//! Floors of places that do not turn with their machine.

use crate::diagnostic::Diagnostic;
use crate::ir::System;
use crate::layout::{Layout, Object};
use runtime_sim::kinematics::facing::Facing;
use runtime_sim::line::Line;
use runtime_sim::part::Primitive;
use runtime_sim::part::place::Floor;
use runtime_sim::value::Value;
use std::collections::HashMap;

/// Lengths and angles that differ by less are equal, m and degrees.
const SAME: f64 = 1e-6;

pub fn check(layout: &Layout, system: &System, line: &Line) -> Vec<Diagnostic> {
    let turned = layout.objects.iter().filter(|object| object.pose.value.yaw != 0.0);
    let turned: HashMap<&str, &Object> = turned.map(|object| (object.name.value.as_str(), object)).collect();
    let mut found = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        let Some(object) = turned.get(machine.name.as_str()) else { continue };
        let turned = object.pose.value.yaw;
        for (part, made) in machine.parts.iter().enumerate() {
            let Primitive::Place(place) = &made.primitive else { continue };
            let is_at_point = matches!(made.settings.get("at"), Some(Value::Point(_)));
            let has_floor = place.facing == Facing::Down && !machine.is_on_track(place) && is_at_point;
            if !has_floor || lies_as_turned(&place.floor, turned) {
                continue;
            }
            let Some(declared) = system.automaton_of(number).device.place_of(part) else { continue };
            let message = format!(
                "the floor of `{}` does not turn with {}, which is turned by {turned} degrees",
                made.name, machine.name
            );
            let along = |[low, high]: [f64; 2]| format!("{low} to {high} m");
            let extent = format!(
                "it reaches from {} along the x axis of the world, and from {} along y",
                along(place.floor.x),
                along(place.floor.y)
            );
            found.push(
                Diagnostic::new("W0205", object.pose.span, message)
                    .other(declared, "the place")
                    .note(extent)
                    .note("items beside it fall past it")
                    .help(
                        "give `at` a frame, which turns slots and floor: `at: origin * frame(X, Y, Z, 0);`",
                    ),
            );
        }
    }
    found
}

/// Whether a floor is the same as if it were turned so, in degrees.
fn lies_as_turned(floor: &Floor, turned: f64) -> bool {
    let Floor { x: [west, east], y: [south, north], .. } = *floor;
    let is_same = |a: f64, b: f64| (a - b).abs() < SAME;
    let is_multiple_of = |angle: f64| is_same(turned / angle, (turned / angle).round());
    let is_even = is_same(-west, east) && is_same(-south, north);
    is_multiple_of(360.0)
        || is_even && (is_multiple_of(180.0) || is_same(east, north) && is_multiple_of(90.0))
}
