//! Prints all contacts of the examples, as if the layouts allowed every pair:
//! `contacts [LAYOUT [CAPACITY]]`. `!`: the layout does not allow the pair.

use autogen::executor::Executor;
use autogen_tests::{LAYOUTS, Texts, ariac, on_all_processors, own_line};
use runtime_sim::run::run;

fn texts(name: &str) -> Texts {
    if LAYOUTS.contains(&name) { ariac(name) } else { own_line(name) }
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let layout = arguments.next();
    let capacity: Option<usize> = arguments.next().and_then(|text| text.parse().ok());
    let mut inputs = Vec::new();
    for name in LAYOUTS.into_iter().chain(["buffer", "shared_agv"]) {
        if layout.as_ref().is_none_or(|wanted| wanted == name) {
            match capacity {
                Some(capacity) => inputs.push((name, capacity)),
                None => inputs.extend([1, 2, 4, 6, 8, 12].map(|capacity| (name, capacity))),
            }
        }
    }
    let reports = on_all_processors(&inputs, |(name, capacity)| {
        let mut project = texts(name).set(&format!("agv.capacity={capacity}")).project();
        let allowed = project.plant.may_touch.clone();
        let machines = project.plant.machines.iter().map(|m| m.name.clone());
        let names: Vec<String> =
            machines.chain(project.plant.obstacles.iter().map(|o| o.name.clone())).collect();
        for (i, a) in names.iter().enumerate() {
            for b in &names[i..] {
                project.plant.may_touch.push([a.clone(), b.clone()]);
            }
        }
        let mut executor = Executor::new(&project.system);
        let report = run(&project.plant, &mut executor, &mut |_| {}).expect("a line that can be run");
        project.plant.may_touch = allowed;
        (project.plant, report)
    });
    for ((name, capacity), (line, report)) in inputs.iter().zip(reports) {
        println!("{name}, capacity {capacity}: {}, {} s", report.reason, report.simulated_s);
        for contact in report.collisions {
            let [a, b] = &contact.pair;
            let mark = if line.allows([a, b]) { ' ' } else { '!' };
            let [of_a, of_b] = contact.parts;
            let place = contact.place;
            println!(
                "{mark} {:9.3} s  {a} ({of_a}) - {b} ({of_b}) at ({:.3}, {:.3}, {:.3}), {} times",
                contact.time_s, place.x, place.y, place.z, contact.count
            );
        }
    }
}
