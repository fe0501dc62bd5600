//! Drawn times and rejects of a process in whole runs: the mill of the tending cell.

use autogen::executor::Executor;
use autogen_tests::{Texts, side_by_side};
use runtime_sim::memory::Memory;
use runtime_sim::run::{Seen, Stepping, run_again};

const PARTS: usize = 12;

/// The cell for some minutes; its mill takes a time as these settings say. `faults` stands in the scenario.
fn cell(settings: &str, faults: &str) -> Texts {
    let mut texts = side_by_side("tending/tending");
    texts.specs[0] = texts.specs[0].replace("time: cut;", settings);
    let kinds = ["blank", "bracket", "scrap"]
        .map(|kind| format!(r#"{{"name": "{kind}", "height": 0.02, "size": [0.04, 0.04]}}"#));
    texts.scenario = Some(format!(
        r#"{{"kinds": [{}], "supply": {{"items": ["blank"], "times": {PARTS}}},
            "time_limit_s": 600, "faults": {{{faults}}}}}"#,
        kinds.join(", ")
    ));
    texts
}

/// How long each cycle was seen to run, in scans, and the names of the kinds that left by the outfeed. However the run
/// is stepped, it is the same.
fn cycles(texts: &Texts) -> (Vec<u64>, Vec<String>) {
    let project = texts.project();
    let machine = |name: &str| {
        project
            .plant
            .machines
            .iter()
            .position(|machine| machine.name == name)
            .expect("a machine of the layout")
    };
    let mill = machine("mill");
    const CUTTING: usize = 4;
    let mut began = None;
    let mut lengths = Vec::new();
    let mut kinds = Vec::new();
    let execute = |stepping, see: &mut dyn FnMut(&Seen)| {
        let mut executor = Executor::new(&project.system);
        run_again(&project.plant, &mut executor, stepping, &mut Memory::default(), see)
            .expect("a line that can be run")
    };
    let every = execute(Stepping::EveryScan, &mut |seen: &Seen| {
        match (began, seen.inputs[mill][CUTTING] != 0.0) {
            (None, true) => began = Some(seen.scan),
            (Some(from), false) => {
                lengths.push(seen.scan - from);
                began = None;
            }
            _ => {}
        }
        kinds = seen.plant.items().all().map(|item| project.plant.kinds[item.kind].name.clone()).collect();
    });
    for stepping in [Stepping::Events, Stepping::Checked] {
        assert_eq!(execute(stepping, &mut |_| {}), every, "{stepping:?}");
    }
    kinds.truncate(lengths.len());
    (lengths, kinds)
}

const NORMAL: &str = "distribution: normal; time: 20 s; deviation: 3 s; shortest: 15 s;";

#[test]
fn a_time_is_drawn_for_each_cycle() {
    let (usual, kinds) = cycles(&cell(NORMAL, ""));
    assert!(usual.len() >= 6, "{usual:?}");
    assert!(usual.iter().all(|scans| (1500..4000).contains(scans)), "{usual:?}");
    assert!(usual.windows(2).any(|two| two[0] != two[1]), "{usual:?}");
    assert!(kinds.iter().all(|kind| kind == "bracket"), "{kinds:?}");

    // A cycle that takes longer than usual takes so much longer than what was drawn for it.
    let slow = r#""slow": [{"robot": "mill", "part": "cycle", "cycle": 2, "longer_s": 30}]"#;
    let (slow, _) = cycles(&cell(NORMAL, slow));
    for (number, (slow, usual)) in slow.iter().zip(&usual).enumerate() {
        assert_eq!(*slow, usual + if number == 1 { 3000 } else { 0 }, "{number}");
    }
}

/// A sweep makes a run once if nothing is drawn in it.
#[test]
fn a_line_says_whether_anything_is_drawn() {
    let rejects = "time: 20 s; rejects: [blank, scrap]; shares:";
    for (settings, is_drawn) in [
        ("time: 20 s;".into(), false),
        ("time: 20 s; shortest: 20 s; longest: 20 s;".into(), false),
        ("time: 20 s; longest: 21 s;".into(), true),
        ("distribution: uniform; shortest: 20 s; longest: 21 s;".into(), true),
        ("distribution: exponential; time: 20 s;".into(), true),
        (NORMAL.into(), true),
        (format!("{rejects} [0];"), false),
        (format!("{rejects} [0.4];"), true),
        (format!("{rejects} [1];"), false),
    ] {
        assert_eq!(cell(&settings, "").project().plant.is_drawn(), is_drawn, "{settings}");
    }
}

/// What is drawn for the mill depends on nothing else in the line, so that two lines can be compared.
#[test]
fn another_machine_and_rejects_change_no_time() {
    let (usual, _) = cycles(&cell(NORMAL, ""));
    let rejecting = format!("{NORMAL} rejects: [blank, scrap]; shares: [0.4];");
    let (times, kinds) = cycles(&cell(&rejecting, ""));
    assert_eq!(times, usual);
    for kind in ["bracket", "scrap"] {
        assert!(kinds.iter().any(|made| made == kind), "{kinds:?}");
    }
    let mut more = cell(NORMAL, "");
    let (first, post) = (r#""robots": ["#, r#"{"name": "post", "type": "post", "pose": [9, 9, 0]},"#);
    assert!(more.layout.contains(first));
    more.layout = more.layout.replacen(first, &format!("{first}{post}"), 1);
    more.specs.push(
        "device post { part light = lamp { at: pose; colour: red; }; out on: bool = light.on stop false; }
         automaton Post on post { initial state On { when false -> On {} } }"
            .into(),
    );
    assert_eq!(cycles(&more).0, usual);
    // Another seed draws other times.
    let mut seed = cell(NORMAL, "");
    seed.scenario = seed.scenario.map(|text| text.replace(r#""items": ["#, r#""seed": 2, "items": ["#));
    assert_ne!(cycles(&seed).0, usual);
}

/// The mill opens as soon as it has begun, and the arm takes the blank out.
#[test]
fn an_item_that_is_taken_before_the_end_is_a_crash() {
    let mut early = cell("time: 2 min;", "");
    let waits = "when finished and not cutting -> Opening";
    assert!(early.specs[0].contains(waits));
    early.specs[0] = early.specs[0].replace(waits, "when cutting -> Opening");
    let project = early.project();
    let reports = [Stepping::EveryScan, Stepping::Events, Stepping::Checked].map(|stepping| {
        let mut executor = Executor::new(&project.system);
        run_again(&project.plant, &mut executor, stepping, &mut Memory::default(), &mut |_| {})
            .expect("a line that can be run")
    });
    assert_eq!(
        reports[0].reason,
        "interlock of mill: a blank was taken from the process cycle before its end"
    );
    assert!(reports.iter().all(|report| *report == reports[0]), "{reports:?}");
}

#[test]
fn a_kind_without_a_time_is_a_crash() {
    let reason = |kinds: &str| {
        let cell = cell(&format!("kinds: [{kinds}]; time: [20 s];"), "");
        let makes = format!("makes: [{kinds}, bracket]");
        let project = cell.replaced(&[("makes: [blank, bracket]", &makes)]).project();
        let mut executor = Executor::new(&project.system);
        let report =
            run_again(&project.plant, &mut executor, Stepping::Events, &mut Memory::default(), &mut |_| {});
        report.expect("a line that can be run").reason
    };
    assert_eq!(
        reason("bracket"),
        "interlock of mill: the process cycle was started without a time for a blank"
    );
    assert_eq!(reason("blank"), "time limit reached");
}

/// How many items of a kind processes make is not known before the run, so their orders are not refused.
#[test]
fn what_a_process_makes_may_be_ordered() {
    let refusals = |ordered: &str| {
        let mut texts = side_by_side("tending/tending");
        let kinds = ["blank", "bracket", "scrap"]
            .map(|kind| format!(r#"{{"name": "{kind}", "height": 0.02, "size": [0.04, 0.04]}}"#));
        texts.scenario = Some(format!(
            r#"{{"kinds": [{}], "supply": {{"items": ["blank"], "times": 3}},
                "orders": {{"count": 3, "parts": {{"{ordered}": 1}}}}}}"#,
            kinds.join(", ")
        ));
        let desk = "device desk {
                define table = origin * point(0, 0, 0.8);
                part top = place {
                    at: table; slots: [point(-0.1, 0, 0), point(0, 0, 0), point(0.1, 0, 0)]; by_kind: true;
                    floor: point(0, 0, 0); floor_x: [-0.2, 0.2]; floor_y: [-0.2, 0.2];
                };
                part terminal = orders { at: top; };
                in open: bool = terminal.open;
            }
            automaton Desk on desk { initial state On { when open -> On {} } }";
        texts.specs.push(desk.into());
        let first = r#""robots": ["#;
        texts.layout = texts.layout.replacen(
            first,
            &format!(r#"{first}{{"name": "desk", "type": "desk", "pose": [9, 9, 0]}},"#),
            1,
        );
        let found = texts.compile().diagnostics;
        found.iter().map(|found| format!("{}: {}", found.code, found.message)).collect::<Vec<_>>()
    };
    assert!(!refusals("bracket").iter().any(|found| found.starts_with("E0138")), "{:?}", refusals("bracket"));
    let scrap = "E0138: the belts bring too few parts \"scrap\": 0 of 3".to_string();
    assert!(refusals("scrap").contains(&scrap), "{:?}", refusals("scrap"));
}
