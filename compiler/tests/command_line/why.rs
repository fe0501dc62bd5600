//! `why`: what machines wait for at a time of a run.

use super::*;

fn why(more: &[&str]) -> Output {
    let layout = example("ariac2021/default.json");
    autogen(&folder("why"), &[&["why", layout.as_str()][..], more].concat())
}

#[test]
fn a_machine_that_does_not_leave_says_who_is_waited_for() {
    let output = why(&["--at", "120", "--robot", "agv2"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("agv2 is in Loading, for 119.23 s"), "{text}");
    assert!(text.contains("FAILS  i = 7: slot[i] = Full"), "{text}");
    assert!(
        text.contains("agv2 (Loading) waits for kitting: agv2.slot[7] is Promised, by kitting"),
        "{text}"
    );
    assert!(!text.contains("agv3 is in"), "{text}");
}

#[test]
fn scripts_get_the_same() {
    let output = why(&["--at", "120", "--robot", "agv2", "--until", "--format", "json"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let answer = json(&output);
    assert_eq!(answer["at_s"], 120.0);
    let machine = &answer["machines"][0];
    assert_eq!((&machine["name"], &machine["state"]), (&"agv2".into(), &"Loading".into()));
    assert_eq!(machine["chain"][1], "kitting");
    assert_eq!(machine["transitions"][0]["holds"], false);
    let left = answer["until"][0]["left_s"].as_f64().expect("a time");
    assert!(left > 120.0 && answer["until"][0]["to"] == "Moving", "{answer}");
}

#[test]
fn what_is_asked_has_to_be_there() {
    for (more, said) in [
        (["--at", "120", "--robot", "agv9"], "there is no such machine; there are conveyor_belt"),
        (["--at", "soon", "--robot", "agv2"], "--at soon"),
        (["--at", "-1", "--robot", "agv2"], "-1"),
        (["--io-delay", "often", "--robot", "agv2"], "--io-delay takes"),
    ] {
        let output = why(&more);
        assert_eq!(status(&output), 2, "{more:?}");
        assert!(errors(&output).contains(said), "{more:?}: {}", errors(&output));
    }
    let output = why(&["--until"]);
    assert_eq!(status(&output), 2, "--until goes with --at");
}

#[test]
fn a_time_after_the_end_is_the_end() {
    let layout = example("scenes/lifting_table.json");
    let output = autogen(&folder("why_end"), &["why", &layout, "--at", "1000"]);
    assert_eq!(status(&output), 0);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.starts_with("at 39.99 s\nthe run ends here: time limit reached\n"), "{text}");
}
