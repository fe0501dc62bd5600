//! What the check of a layout says of the flow of items along a conveyor is what happens in a run.

use autogen::executor::Executor;
use autogen_tests::{Texts, stepped, text};
use runtime_sim::carrier::Carrier;
use runtime_sim::random::Random;
use runtime_sim::run::{Stepping, run};
use serde_json::{Value, json};

/// Where things are along the conveyor, m.
#[derive(Debug)]
struct Places {
    source: f64,
    sink: f64,
    printer: f64,
    gate: f64,
}

impl Places {
    fn texts(&self, diverts: bool, goal: &Value) -> Texts {
        let Self { source, sink, printer, gate } = self;
        let mut scenario = json!({
            "kinds": [{"name": "raw", "height": 0.1, "size": [0.2, 0.2]}, {"name": "printed", "height": 0.1, "size": [0.2, 0.2]}],
            "supply": {"first_s": 1, "items": {"line": ["raw"]}},
            "time_limit_s": 12
        });
        if !goal.is_null() {
            scenario["goal"] = goal.clone();
        }
        Texts {
            layout: json!({"robots": [{
                "name": "line", "type": "sorter", "pose": [0, 0, 1, 0], "parameters": {"diverts": i32::from(diverts)},
                "source_at": source, "sink_at": sink, "print_at": printer, "gate_at": gate
            }]})
            .to_string(),
            specs: vec![text("tests/fixtures/flow/sorter.aut")],
            scenario: Some(scenario.to_string()),
            ..Texts::default()
        }
    }

    /// The errors of the check, if this is the goal.
    fn errors(&self, diverts: bool, goal: &Value) -> Vec<autogen::diagnostic::Diagnostic> {
        let found = self.texts(diverts, goal).compile().diagnostics;
        found.into_iter().filter(|found| found.severity() == autogen::diagnostic::Severity::Error).collect()
    }

    /// The sink in which the item ends in a run without a goal, and what it is then.
    fn ends(&self, diverts: bool) -> Option<(String, String)> {
        let project = self.texts(diverts, &Value::Null).project();
        let plant = &project.plant;
        let mut end = None;
        let report = run(plant, &mut Executor::new(&project.system), Stepping::EveryScan, &mut |seen| {
            let item = &seen.plant.items()[0];
            if let Carrier::Sink { machine, part } = item.carrier {
                let sink = plant.machines[machine].parts[part].name.clone();
                end = Some((sink, plant.kinds[item.kind].name.clone()));
            }
        });
        report.expect("a line that can be run");
        end
    }
}

#[test]
fn what_is_feasible_happens_and_what_is_not_does_not() {
    let mut random = Random::new(11);
    let mut outcomes = [[0; 2]; 2];
    for _ in 0..60 {
        let mut drawn =
            |least: u32, most: u32| f64::from(5 * (least + 2 * random.up_to((most - least) / 2))) / 100.0;
        let source = drawn(2, 40);
        // No edge of an item just gets to something.
        let sink = drawn((source * 20.0).round() as u32 + 2, 60);
        let places = Places { source, sink, printer: drawn(3, 59), gate: drawn(3, 59) };
        for diverts in [false, true] {
            let (goal, wanted) = match diverts {
                false => (json!({"line.store": {"printed": 1}}), ("store", "printed")),
                true => (json!({"line.beside": {"raw": 1}}), ("beside", "raw")),
            };
            let errors = places.errors(diverts, &goal);
            let codes: Vec<&str> = errors.iter().map(|error| error.code).collect();
            assert!(codes.is_empty() || codes == ["E0410"], "{places:?}: {errors:?}");
            let (end, is_feasible) = (places.ends(diverts), codes.is_empty());
            // What is printed before it is diverted gets there too.
            let happens =
                end.as_ref().is_some_and(|(sink, kind)| sink == wanted.0 && (diverts || kind == wanted.1));
            assert_eq!(happens, is_feasible, "{places:?}, diverts {diverts}: {end:?}, {errors:?}");
            outcomes[usize::from(diverts)][usize::from(is_feasible)] += 1;
        }
    }
    assert!(outcomes.iter().flatten().all(|count| *count > 5), "{outcomes:?}");
}

#[test]
fn what_stands_where_no_item_gets_to_is_named() {
    let told = |places: Places, diverts: bool, goal: Value| -> Vec<String> {
        let errors = places.errors(diverts, &goal);
        errors
            .into_iter()
            .flat_map(|error| [vec![error.message], error.notes, vec![error.help]].concat())
            .collect()
    };
    let printed = || json!({"line.store": {"printed": 1}});
    let help = "move what no item gets to along its conveyor; or let such a kind get there, add `printed` to `items` of `supply`, or \
                take it out of the goal";
    let missing = "no `printed` can get to the sink line.store";
    let [none, maker] = ["no source brings a `printed`", "line makes it of a `raw`"];
    assert_eq!(
        told(Places { source: 0.2, sink: 1.0, printer: 1.5, gate: 0.95 }, false, printed()),
        [
            missing,
            none,
            maker,
            "line.print at 1.500 m of belt acts on a `raw` with its middle from 1.400 to 1.600 m, and this leaves it at 1.000 m, by store",
            help
        ]
    );
    assert_eq!(
        told(Places { source: 1.8, sink: 2.8, printer: 1.5, gate: 2.0 }, false, printed()),
        [
            missing,
            none,
            maker,
            "line.print at 1.500 m of belt acts on a `raw` with its middle from 1.400 to 1.600 m, and this is on it from 1.800 m on",
            help
        ]
    );
    let beside = json!({"line.beside": {"raw": 1}});
    assert_eq!(
        told(Places { source: 1.8, sink: 2.8, printer: 2.0, gate: 1.5 }, true, beside),
        [
            "no `raw` can get to the sink line.beside",
            "machines that a `raw` can get to: line",
            "line.gate at 1.500 m of belt acts on a `raw` with its middle at 1.400 m, and this is on it from 1.800 m on",
            "move what no item gets to along its conveyor; or let a conveyor begin where the one before it ends, or name a sink after \
             these machines in the goal"
        ]
    );
}

/// Its place says nothing of what may lie on it.
#[test]
fn on_trays_things_may_get_anywhere() {
    let places = Places { source: 0.2, sink: 1.0, printer: 1.5, gate: 0.95 };
    let mut texts = places.texts(false, &json!({"line.store": {"printed": 1}}));
    assert_eq!(texts.compile().diagnostics.len(), 1);
    let scenario = texts.scenario.as_mut().expect("a scenario");
    *scenario =
        scenario.replacen("[{", r#"[{"name": "tray", "height": 0.1, "size": [0.5, 0.3], "bears": {}}, {"#, 1);
    let found = texts.compile().diagnostics;
    assert!(found.iter().all(|found| found.code != "E0410"), "{found:?}");
}

#[test]
fn items_appear_before_they_leave() {
    let texts = |source| Places { source, sink: 1.0, printer: 0.5, gate: 0.95 }.texts(false, &Value::Null);
    assert!(texts(0.95).compile().diagnostics.iter().all(|found| found.code != "E0711"));
    for source in [1.0, 1.05, 2.9] {
        let found = texts(source).compile().diagnostics;
        let [one] = &found[..] else { panic!("{found:?}") };
        let expected = format!(
            "`line` cannot be built from its device: feed puts items onto belt at {source:.3} m, and store takes them off at 1.000 m"
        );
        assert_eq!((one.code, &one.message), ("E0711", &expected));
    }
}

#[test]
fn what_comes_round_to_its_beginning_gets_to_what_stands_there() {
    let texts = Texts {
        layout: json!({"robots": [{"name": "line", "type": "ring", "pose": [0, 0, 1, 0]}]}).to_string(),
        specs: vec![text("tests/fixtures/flow/ring.aut")],
        scenario: Some(
            json!({
                "kinds": [{"name": "raw", "height": 0.1, "size": [0.2, 0.2]}, {"name": "printed", "height": 0.1, "size": [0.2, 0.2]}],
                "supply": {"first_s": 1, "items": {"line": ["raw"]}},
                "goal": {"line.beside": {"printed": 1}},
                "time_limit_s": 40
            })
            .to_string(),
        ),
        ..Texts::default()
    };
    assert_eq!(stepped::report(&texts, |_| {}).reason, "all items collected");
}
