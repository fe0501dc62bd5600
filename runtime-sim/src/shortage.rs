//! What the open orders lack, and where the parts are that they will not get.

use crate::carrier::Carrier;
use crate::item::Names;
use crate::line::Line;
use crate::plant::Plant;
use crate::point::Point;

/// What each open order lacks or has too much, which machines wait for `complete` to fall,
/// then the items that lie elsewhere than on a lane or at an order's place, and those that passed.
pub fn shortage(line: &Line, plant: &Plant) -> String {
    let mut facts = Vec::new();
    for (machine, station) in line.machines.iter().enumerate() {
        let Some(order) = plant.open_order(machine) else {
            let to_open = plant.orders_to_open(machine);
            if to_open > 0 {
                facts.push(format!("{to_open} more of {} cannot open while `complete` is set", station.name));
            }
            continue;
        };
        facts.push(format!(
            "order {} at {} {}",
            order + 1,
            station.name,
            state_of(line, plant, machine, order)
        ));
    }
    let names = Names::new(line);
    for (index, item) in plant.items().all().enumerate() {
        let kind = &line.kinds[item.kind].name;
        let on = |machine: usize, what: &str| format!("{what} of {}", line.machines[machine].name);
        let bearer = match plant.base_carrier(index) {
            Carrier::Floor { .. } => "the floor".to_string(),
            Carrier::Place { machine, part, .. } if !line.machines[machine].is_place_of_orders(part) => {
                match line.machines[machine].title(part) {
                    Some(title) => on(machine, &format!("the {title}")),
                    None => line.machines[machine].name.clone(),
                }
            }
            Carrier::Grip { machine, .. } => on(machine, "the gripper"),
            _ => continue,
        };
        let carrier = item.carrier.item().map_or(bearer, |under| names.name(under));
        let place = plant.place(index).map_or(String::new(), |point| format!(" at {}", point_text(point)));
        facts.push(format!("{kind} (item {index}) lies on {carrier}{place}"));
    }
    for (kind, name) in line.kinds.iter().map(|kind| &kind.name).enumerate() {
        let parts = |wanted: fn(&Carrier) -> bool| {
            plant.items().all().filter(|item| item.kind == kind && wanted(&item.carrier)).count()
        };
        let collected = parts(|carrier| matches!(carrier, Carrier::Sink { .. } | Carrier::Collector));
        if collected > 0 {
            facts.push(format!("{collected} {name} in the collector"));
        }
    }
    facts.join("; ")
}

fn state_of(line: &Line, plant: &Plant, machine: usize, order: usize) -> String {
    let mut lacks = Vec::new();
    let mut surplus = Vec::new();
    for (kind, &wanted) in line.scenario.orders[order].parts.iter().enumerate() {
        let name = &line.kinds[kind].name;
        let items = plant.items();
        let is_there = |item: &&usize| {
            items[**item].carrier.part().is_some_and(|part| line.machines[machine].is_place_of_orders(part))
        };
        let held = items.borne_by(machine).iter().filter(is_there).flat_map(|item| items.with_loads(*item));
        let held = held.filter(|item| items[*item].kind == kind).count();
        let wanted = wanted as usize;
        if held < wanted {
            let of_kind = (0..items.count()).filter(|item| items[*item].kind == kind);
            let to_come = of_kind.filter(|item| can_come(line, &plant.base_carrier(*item))).count();
            let none_left = if to_come == 0 { " (none left)" } else { "" };
            lacks.push(match wanted - held {
                1 => format!("{name}{none_left}"),
                missing => format!("{missing} {name}{none_left}"),
            });
        } else if held > wanted {
            surplus.push(format!("{} {name}", held - wanted));
        }
    }
    match (lacks.is_empty(), surplus.is_empty()) {
        (true, true) => "has its parts and is not reported complete".into(),
        (false, true) => format!("lacks {}", lacks.join(", ")),
        (true, false) => format!("has {} too many", surplus.join(", ")),
        (false, false) => format!("lacks {} and has {} too many", lacks.join(", "), surplus.join(", ")),
    }
}

/// Whether an item may still come to the place of an order at which it is not.
fn can_come(line: &Line, carrier: &Carrier) -> bool {
    match *carrier {
        Carrier::Supply | Carrier::Lane { .. } | Carrier::Grip { .. } => true,
        Carrier::Place { machine, part, .. } => !line.machines[machine].is_place_of_orders(part),
        Carrier::On { .. }
        | Carrier::Floor { .. }
        | Carrier::Sink { .. }
        | Carrier::Collector
        | Carrier::Part { .. }
        | Carrier::Shipped { .. } => false,
    }
}

/// To the millimetre.
pub fn point_text(point: Point) -> String {
    format!("({:.3}, {:.3}, {:.3})", point.x, point.y, point.z)
}
