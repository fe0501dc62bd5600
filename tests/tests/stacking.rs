//! Items that lie on one another: what bears them, what they fall off, and what a process makes of a stack.

use autogen_tests::{Texts, stepped, text};

/// One machine, and kinds with height, length and width.
fn line(device: &str, kinds: &[(&str, f64, [f64; 2])], items: &[&str], faults: &str) -> Texts {
    let kind = |(name, height, size): &(&str, f64, [f64; 2])| {
        format!(r#"{{"name": "{name}", "height": {height}, "size": {size:?}}}"#)
    };
    let kinds: Vec<String> = kinds.iter().map(kind).collect();
    Texts {
        layout: format!(
            r#"{{"robots": [{{"name": "{device}", "type": "{device}", "pose": [0, 0, 0, 0]}}]}}"#
        ),
        specs: vec![text(&format!("tests/fixtures/stacking/{device}.aut"))],
        scenario: Some(format!(
            r#"{{"kinds": [{}], "supply": {{"items": {items:?}, "every_s": 4}}, "time_limit_s": 60, "faults": {{{faults}}}}}"#,
            kinds.join(", ")
        )),
        ..Texts::default()
    }
}

/// How the run ends, however it is stepped, and the height of each item there if it is on the line, mm.
fn ends(texts: &Texts) -> (String, Vec<Option<f64>>) {
    let mut heights = Vec::new();
    let report = stepped::report(texts, |seen| {
        let height = |item| Some((seen.plant.place(item)?.z * 1000.0).round());
        heights = (0..seen.plant.items().count()).map(height).collect();
    });
    (report.reason.to_string(), heights)
}

fn chute(kinds: &[(&str, f64, [f64; 2])], items: &[&str], process: &str) -> (String, Vec<Option<f64>>) {
    let press =
        ("process { on: pallet; time: 2 s;", &*format!("process {{ on: pallet; time: 2 s; {process}"));
    ends(&line("chute", kinds, items, "").replaced(&[press]))
}

const FINISHED: &str = "time limit reached";
const SIZE: [f64; 2] = [0.3, 0.1];

#[test]
fn what_lies_on_an_item_comes_down_or_up_as_that_changes() {
    let kinds = [("thick", 0.10, SIZE), ("thin", 0.02, SIZE), ("thicker", 0.13, SIZE)];
    let items = ["thick"; 3];
    let heights = |heights: [f64; 3]| (FINISHED.to_string(), heights.map(Some).to_vec());
    let kinds_of = |made: &str| chute(&kinds, &items[..2], made);
    assert_eq!(kinds_of("makes: [thick, thin];").1, [Some(150.0), Some(170.0)]);
    assert_eq!(kinds_of("makes: [thick, thicker];").1, [Some(150.0), Some(280.0)]);
    assert_eq!(chute(&kinds, &["thin"; 3], "makes: [thin, thick];"), heights([150.0, 250.0, 270.0]));
}

#[test]
fn a_place_given_by_a_frame_turns_with_its_machine() {
    let kinds = [("box", 0.10, SIZE)];
    let lies = |at: &str, yaw: f64| {
        let changes =
            [("at: origin * frame(2.0, 0, 0.15, 0)", at), ("floor_y: [-0.3, 0.3]", "floor_y: [-0.05, 0.05]")];
        let mut texts = line("chute", &kinds, &["box"], "").replaced(&changes);
        texts.layout = texts.layout.replace("[0, 0, 0, 0]", &format!("[0, 0, 0, {yaw:?}]"));
        ends(&texts).1
    };
    for yaw in [0.0, 90.0, 37.0, 180.0, -90.0] {
        assert_eq!(lies("at: origin * frame(2.0, 0, 0.15, 0)", yaw), [Some(150.0)], "{yaw}");
    }
    // A point does not turn with it.
    assert_eq!(lies("at: origin * point(2.0, 0, 0.15)", 0.0), [Some(150.0)]);
    assert_eq!(lies("at: origin * point(2.0, 0, 0.15)", 90.0), [Some(0.0)]);
}

#[test]
fn what_lies_on_a_joined_item_comes_down() {
    let kinds = [("base", 0.10, SIZE), ("cap", 0.06, SIZE), ("lid", 0.06, SIZE)];
    let (reason, heights) = chute(&kinds, &["base", "cap", "lid"], "joins: [cap];");
    assert_eq!((&*reason, heights), (FINISHED, vec![Some(150.0), None, Some(250.0)]));
}

/// The lower one becomes so short that the upper one, whose middle is beyond the floor, has nothing under its middle.
#[test]
fn what_a_process_leaves_without_support_ends_the_run() {
    let kinds = [("long", 0.05, [0.6, 0.1]), ("short", 0.05, [0.2, 0.1]), ("wide", 0.05, [0.9, 0.1])];
    let narrow = ("floor_x: [-0.4, 0.4]", "floor_x: [-0.4, -0.05]");
    let press = ("time: 2 s;", "time: 2 s; makes: [long, short];");
    let texts = line("chute", &kinds, &["long", "wide"], "").replaced(&[narrow, press]);
    assert_eq!(ends(&texts).0, "interlock of chute: a wide tips off in the process press");
}

#[test]
fn what_falls_into_the_side_of_a_stack_ends_the_run() {
    let kinds = [("long", 0.10, [0.6, 0.1]), ("short", 0.10, [0.2, 0.1])];
    let (reason, _) = chute(&kinds, &["long", "short", "long"], "");
    assert_eq!(reason, "interlock of chute: long_2 comes down on short_1, which lies there");
}

const BOX: (&str, f64, [f64; 2]) = ("box", 0.10, [0.45, 0.15]);

fn cell(changes: &[(&str, &str)], faults: &str) -> (String, Vec<Option<f64>>) {
    ends(&line("cell", &[BOX], &["box"; 2], faults).replaced(changes))
}

#[test]
fn an_item_lies_on_another_one_beyond_the_floor() {
    let heights = |upper: f64| vec![Some(150.0), Some(upper)];
    assert_eq!(cell(&[], ""), (FINISHED.into(), heights(250.0)));
    // Its middle is 25 mm beyond the lower box, which it touches.
    let farther = ("point(1.32, 0, 0.351)", "point(1.40, 0, 0.351)");
    let mut texts = line("cell", &[BOX], &["box"; 2], "").replaced(&[farther]);
    for pose in ["[0, 0, 0, 0]", "[2, -1, 0, 30]"] {
        texts.layout = texts.layout.replace("[0, 0, 0, 0]", pose);
        assert_eq!(ends(&texts).0, "interlock of cell: box_2 tips off box_1", "{pose}");
    }
    // Beside it.
    let beside = ("point(1.32, 0, 0.351)", "point(1.15, 0.35, 0.351)");
    assert_eq!(cell(&[beside], ""), (FINISHED.into(), heights(0.0)));
}

#[test]
fn a_part_that_slips_falls_off_what_cannot_bear_it() {
    let slips = r#""slips": [{"robot": "cell", "pick": 2, "after_s": 2.0}]"#;
    for (second, stacks, lies) in [
        ("point(1.15, 0, 0.351)", "stacks: true;", 250.0),
        ("point(1.15, 0, 0.351)", "", 0.0),
        ("point(1.40, 0, 0.351)", "stacks: true;", 0.0),
    ] {
        let (_, heights) = cell(&[("point(1.32, 0, 0.351)", second), ("stacks: true;", stacks)], slips);
        assert_eq!(heights, [Some(150.0), Some(lies)], "{second} {stacks}");
    }
}

/// A place on one half of the pallet.
fn half(name: &str, middle: f64) -> String {
    format!(
        "part {name} = place {{
            at: origin * point(1.0, 0, 0.15); slots: [point(0, 0, 0)]; by_kind: false; stacks: true;
            floor: point({middle}, 0, 0); floor_x: [-0.15, 0.15]; floor_y: [-0.3, 0.3];
        }};
        "
    )
}

#[test]
fn a_part_that_two_places_of_a_machine_bear_stays_or_tips() {
    let mut texts = line("cell", &[BOX], &["box"; 3], "");
    let text = &mut texts.specs[0];
    let begin = text.find("part pallet").expect("the pallet");
    let end = text.find("part wood").expect("what is next");
    text.replace_range(begin..end, &(half("far", 0.15) + &half("near", -0.15)));
    let third = |second: &str| {
        let spots = format!("[point(1.23, 0, 0.251), {second}, point(0.97, 0, 0.351)]");
        let all = "[point(1.15, 0, 0.251), point(1.32, 0, 0.351), point(1.15, 0, 0.351)]";
        ends(&texts.clone().replaced(&[(all, &*spots), ("when spot = 1", "when spot = 2")]))
    };
    let heights = vec![Some(150.0), Some(150.0), Some(250.0)];
    assert_eq!(third("point(0.77, 0, 0.251)"), (FINISHED.into(), heights.clone()));
    assert_eq!(third("point(0.77, 0.2, 0.251)").0, "interlock of cell: box_3 tips off box_1");
    // Of two machines it is so in any order, and a person takes neither of the lower two.
    let shelf = format!(
        "device shelf {{ {} }}\nautomaton Shelf on shelf {{ initial -> Standing {{}} final state Standing; }}\n",
        half("near", -0.15)
    );
    let near = half("near", -0.15);
    let robots = ["cell", "shelf"]
        .map(|name| format!(r#"{{"name": "{name}", "type": "{name}", "pose": [0, 0, 0, 0]}}"#));
    for (robots, removed) in
        [([0, 1], "box_1"), ([1, 0], "box_2")].map(|(order, item)| (order.map(|it| &robots[it][..]), item))
    {
        let mut texts = texts.clone().replaced(&[(&*near, "")]);
        texts.specs[0] += &shelf;
        texts.layout = format!(r#"{{"robots": [{}]}}"#, robots.join(", "));
        let operator =
            format!(r#""time_limit_s": 60, "operator": [{{"remove": "{removed}", "at_s": 50}}], "#);
        let texts = texts.replaced(&[
            (r#""time_limit_s": 60, "#, &*operator),
            (
                "[point(1.15, 0, 0.251), point(1.32, 0, 0.351), point(1.15, 0, 0.351)]",
                "[point(1.23, 0, 0.251), point(0.77, 0, 0.251), point(0.97, 0, 0.351)]",
            ),
            ("when spot = 1", "when spot = 2"),
        ]);
        assert_eq!(ends(&texts), (FINISHED.into(), heights.clone()), "{removed}");
    }
}

/// A press joins three parts, and takes them apart again onto its slots.
#[test]
fn what_a_process_frees_lies_where_it_can() {
    let kinds = [("base", 0.10, SIZE), ("cap", 0.02, SIZE), ("lid", 0.02, SIZE)];
    let freed = |slots: &str| {
        let slots = format!("slots: [point(0.15, 0, 0), {slots}]");
        let texts = line("chute", &kinds, &["base", "cap", "lid"], "");
        ends(&texts.replaced(&[
            ("slots: [point(0.15, 0, 0)]", &*slots),
            (
                "part press = process { on: pallet; time: 2 s; };",
                "part press = process { on: pallet; time: 2 s; joins: [cap, lid]; };
                part open = process { on: pallet; time: 1 s; frees: true; };",
            ),
            ("out start:", "out undo: bool = open.start stop false;\n    out start:"),
            ("when after 5 s -> Ended { start := false; }", "when after 5 s -> Ended { undo := true; }"),
        ]))
    };
    let heights = |caps: [f64; 2]| vec![Some(150.0), Some(caps[0]), Some(caps[1])];
    assert_eq!(freed("point(0.45, 0, 0), point(0.75, 0, 0)"), (FINISHED.into(), heights([150.0; 2])));
    // They come down on what is below.
    assert_eq!(freed("point(0.45, 0, 0.3), point(0.45, 0, 0.7)"), (FINISHED.into(), heights([150.0, 170.0])));
    // The cap has left its slot, which stays taken.
    let none = "interlock of chute: the process open has no free slot for a lid";
    assert_eq!(freed("point(0.45, 0, 0.3)").0, none);
    let into = "interlock of chute: the process open lays a lid into a cap";
    assert_eq!(freed("point(0.45, 0, 0), point(0.55, 0, 0)").0, into);
    let beside = "interlock of chute: the process open lays a cap beside its place";
    assert_eq!(freed("point(1.5, 0, 0), point(2.65, 0, 0)").0, beside);
}

#[test]
fn an_item_does_not_come_to_lie_in_one_of_another_place() {
    let kinds = [("tall", 0.20, [0.2, 0.1]), ("long", 0.10, [0.6, 0.1])];
    let near = ("floor_x: [-0.4, 0.4]", "floor_x: [-0.4, -0.2]");
    let far = "part far = place {
        at: origin * point(2.0, 0, 0.15); slots: [point(0, 0, 0)]; by_kind: false; stacks: true;
        floor: point(0.5, 0, 0); floor_x: [-0.299, 0.3]; floor_y: [-0.3, 0.3];
    };
    part press";
    let texts = line("chute", &kinds, &["tall", "long"], "").replaced(&[near, ("part press", far)]);
    assert_eq!(ends(&texts).0, "interlock of chute: long_1 comes down on tall_1, which lies there");
}

#[test]
fn a_process_that_makes_an_item_wider_moves_it_into_no_other_one() {
    let kinds = [BOX, ("big", 0.10, [0.45, 0.40])];
    let press = |place: &str| {
        [
            (
                "part wood",
                "part press = process { on: pallet; time: 1 s; makes: [box, big]; };\n    part wood"
                    .to_string(),
            ),
            ("out run", "out start: bool = press.start stop false;\n    out run".into()),
            ("when spot = 1 -> Ended;", "when spot = 1 -> Pressing { start := true; }".into()),
            (
                "final state Ended",
                "state Pressing { when after 3 s -> Ended { start := false; } }\n    final state Ended"
                    .into(),
            ),
            ("point(1.32, 0, 0.351)", place.into()),
        ]
    };
    let end = |place: &str| {
        let changes = press(place);
        let changes: Vec<(&str, &str)> = changes.iter().map(|(from, to)| (*from, &**to)).collect();
        ends(&line("cell", &kinds, &["box"; 2], "").replaced(&changes)).0
    };
    assert_eq!(end("point(1.15, 0.2, 0.251)"), "interlock of cell: the process press moves a big into a box");
    assert_eq!(end("point(1.15, 0.28, 0.251)"), FINISHED);
}
