//! Machines that an arm reaches and that its `takes_from` or `hands_to` leaves out: what `check` tells.

use super::*;

/// A folder with the default line as `line.json`, with lists of two arms.
fn line(name: &str, kitting: &str, gantry: &str) -> PathBuf {
    let folder = folder(&format!("left_out_{name}"));
    let layout = fs::read_to_string(example("ariac2021/default.json")).expect("the example");
    let with = |layout: String, kind: &str, list: &str| {
        let key = format!("\"type\": \"{kind}\",");
        assert!(layout.contains(&key), "{key}");
        layout.replacen(&key, &format!("{key} {list}"), 1)
    };
    let layout = with(with(layout, "kitting", kitting), "gantry", gantry);
    fs::write(folder.join("line.json"), layout).expect("a file");
    folder
}

fn told(name: &str, kitting: &str, gantry: &str) -> Vec<Value> {
    let folder = line(name, kitting, gantry);
    let answer = json(&autogen(&folder, &["check", "line.json", "--format", "json"]));
    let all = answer["diagnostics"].as_array().expect("diagnostics").iter();
    all.filter(|told| told["severity"] == "error").cloned().collect()
}

fn only(told: &[Value], code: &str, message: &str, note: &str, help: &str) {
    let [one] = told else { panic!("{told:#?}") };
    assert_eq!([&one["code"], &one["message"], &one["help"]], [code, message, help]);
    let notes = one["notes"].as_array().expect("notes");
    assert!(notes.iter().any(|told| told == note), "{one:#?}");
}

#[test]
fn vehicles_that_the_arm_does_not_take_from() {
    only(
        &told("takes_from", "", r#""takes_from": ["agv1", "agv2"],"#),
        "E0403",
        "agv3, agv4 hand over to nothing",
        "gantry reaches agv3, agv4, but its \"takes_from\" does not name them",
        "add \"agv3\", \"agv4\" to \"takes_from\" of gantry",
    );
}

#[test]
fn a_station_that_the_arm_does_not_hand_to() {
    only(
        &told("hands_to", "", r#""hands_to": ["as1", "as2", "as3"],"#),
        "E0402",
        "nothing hands over to as4",
        "gantry reaches as4, but its \"hands_to\" does not name it",
        "add \"as4\" to \"hands_to\" of gantry",
    );
}

#[test]
fn an_arm_that_hands_to_nothing() {
    let told = told("nothing", "", r#""hands_to": [],"#);
    only(
        &told,
        "E0402",
        "nothing hands over to as1, as2, as3, as4",
        "gantry reaches as1, as2, as3, as4, but its \"hands_to\" does not name them",
        "add \"as1\", \"as2\", \"as3\", \"as4\" to \"hands_to\" of gantry",
    );
    let stuck = "no item from conveyor_belt, kitting, agv1, agv2, agv3, agv4, gantry ever leaves the layout";
    assert!(told[0]["notes"].to_string().contains(stuck), "{told:#?}");
}

#[test]
fn vehicles_that_the_first_arm_does_not_hand_to() {
    only(
        &told("first_arm", r#""hands_to": ["agv1"],"#, ""),
        "E0402",
        "nothing hands over to agv2, agv3, agv4",
        "kitting reaches agv2, agv3, agv4, but its \"hands_to\" does not name them",
        "add \"agv2\", \"agv3\", \"agv4\" to \"hands_to\" of kitting",
    );
}

#[test]
fn the_list_is_shown() {
    let folder = line("shown", "", r#""takes_from": ["agv1", "agv2"],"#);
    let said = errors(&autogen(&folder, &["check", "line.json"]));
    assert!(said.contains("leaves them out"), "{said}");
}
