//! Names that are misspelt, missing or in another place than they belong to, in a line that is right otherwise: what `check`
//! tells, and that it tells nothing else.

use super::*;

/// Of the machining cell with a change in each of its texts: codes, place, and help with notes.
struct Cell {
    layout: String,
    automata: String,
    scenario: String,
}

impl Cell {
    fn new() -> Self {
        let text = |name: &str| fs::read_to_string(example(&format!("tending/{name}"))).expect("the example");
        Self {
            layout: text("tending.json"),
            automata: text("tending.aut"),
            scenario: text("tending.scenario.json"),
        }
    }

    fn layout(mut self, from: &str, to: &str) -> Self {
        assert!(self.layout.contains(from), "{from}");
        self.layout = self.layout.replacen(from, to, 1);
        self
    }

    fn automata(mut self, from: &str, to: &str) -> Self {
        assert!(self.automata.contains(from), "{from}");
        self.automata = self.automata.replacen(from, to, 1);
        self
    }

    fn scenario(mut self, from: &str, to: &str) -> Self {
        assert!(self.scenario.contains(from), "{from}");
        self.scenario = self.scenario.replacen(from, to, 1);
        self
    }

    /// What is told, one a line: code, file, column, notes and help.
    fn told(&self, name: &str, settings: &[&str]) -> Vec<String> {
        let folder = folder(&format!("misplaced_{name}"));
        let write = |name: &str, text: &str| fs::write(folder.join(name), text).expect("a file");
        write("tending.json", &self.layout);
        write("tending.aut", &self.automata);
        write("tending.scenario.json", &self.scenario);
        let mut arguments = vec!["check", "tending.json", "--format", "json"];
        arguments.extend(settings.iter().flat_map(|setting| ["--set", setting]));
        let answer = json(&autogen(&folder, &arguments));
        let all = answer["diagnostics"].as_array().expect("diagnostics").iter();
        let errors = all.filter(|told| told["severity"] == "error");
        errors.map(ToString::to_string).collect()
    }
}

/// With what the cell itself does not have: a kind that an automaton names.
fn with_kind() -> Cell {
    Cell::new().automata(
        "    local outlet: Outlet;",
        "    local outlet: Outlet;\n    local made: Kind := bracket;\n    define is_made = made = Kind.bracket;",
    )
}

fn only(told: &[String], words: &[&str]) {
    let [one] = told else { panic!("{told:#?}") };
    for word in words {
        assert!(one.contains(word), "{word}: {one}");
    }
}

#[test]
fn kinds_are_known_whatever_else_is_wrong_with_the_scenario() {
    assert_eq!(with_kind().told("right", &[]), [""; 0]);
    let key = with_kind().scenario("\"supply\"", "\"suply\"");
    only(&key.told("scenario_key", &[]), &["E0111", "suply"]);
    let of_goal = with_kind().scenario("{\"bracket\": 41}", "{\"bracket\": 41, \"braket\": 1}");
    only(&of_goal.told("scenario_goal", &[]), &["E0111", "braket"]);
    // What they are called is known, so another name is none of them.
    let other = key.automata("Kind := bracket", "Kind := braket");
    let told = other.told("scenario_other", &[]);
    assert_eq!(told.len(), 2, "{told:#?}");
    assert!(told.iter().any(|told| told.contains("E0305")), "{told:#?}");
}

#[test]
fn what_may_be_a_kind_is_not_told_while_the_kinds_are_not_known() {
    let kinds = with_kind().scenario("\"kinds\"", "\"kindz\"");
    let told = kinds.told("kinds", &[]);
    assert!(told.iter().all(|told| told.contains("scenario.json")), "{told:#?}");
    let key = with_kind().layout("\"scenario\"", "\"scenarios\"");
    only(&key.told("layout_key", &[]), &["E0111", "scenarios"]);
    let cut = with_kind().scenario("\n}", "\n");
    let told = cut.told("cut", &[]);
    assert!(!told.is_empty() && told.iter().all(|told| told.contains("scenario.json")), "{told:#?}");
}

#[test]
fn an_arm_that_loads_and_unloads_is_told_to_name_the_place_in_both() {
    let lists = ",\n     \"takes_from\": [\"infeed\", \"mill\"], \"hands_to\": [\"mill\", \"outfeed\"]";
    only(
        &Cell::new().layout(lists, "").told("both", &[]),
        &["E0504", "name \\\"mill\\\" in both", "\\\"takes_from\\\": [\\\"mill\\\", ...]"],
    );
}

#[test]
fn a_kind_that_a_process_makes_is_one_of_the_scenario() {
    let makes = |pair: &str| Cell::new().automata("makes: [blank, bracket]", &format!("makes: [{pair}]"));
    only(&makes("blank, braket").told("makes", &[]), &["E0710", "tending.aut", "is `bracket` meant?"]);
    // Another line has such kinds.
    assert_eq!(makes("blank, bracket, wood, box").told("makes_of_others", &[]), [""; 0]);
    // No process makes a bracket.
    only(&makes("wood, bracket").told("makes_none", &[]), &["E0410", "let a process make it"]);
    let cell =
        Cell::new().scenario("\"supply\": {\"items\": [\"blank\"]", "\"supply\": {\"items\": [\"rod\"]");
    let cell = cell.scenario("\"kinds\": [", "\"kinds\": [{\"name\": \"rod\", \"height\": 0.02},");
    only(&cell.told("makes_of_nothing", &[]), &["E0410", "mill makes it of a `blank`"]);
}

#[test]
fn keys_of_the_device_and_parameters_are_told_apart() {
    let keys = "is `cut` meant? One can set: cut, door_time, clamp_time";
    only(&Cell::new().told("set", &["mill.cutt=2"]), &["E0511", keys]);
    let lists = "its parameters are over_vise, over_lane, height; the keys of its device are waits_at";
    only(&Cell::new().told("set_nothing", &["arm.colour=2"]), &["E0511", lists]);
    let common = "keys of every object, such as `pose`, stand in the layout alone";
    only(&Cell::new().told("set_pose", &["arm.pose=[0,0,0]"]), &["E0511", "of its device `pose`", common]);
    let inside = Cell::new().layout("\"cut\": 90", "\"cut\": 90, \"parameters\": {\"cut\": 90}");
    only(&inside.told("inside", &[]), &["E0501", "`cut` is a key of the device `mill`"]);
    let beside = Cell::new().layout("\"type\": \"tender\"", "\"type\": \"tender\", \"height\": 0.03");
    only(
        &beside.told("beside", &[]),
        &["E0111", "`height` is a parameter of `Tender`", "\\\"parameters\\\": {\\\"height\\\": 0.03}"],
    );
}

#[test]
fn a_misspelt_pose_is_where_it_is_written() {
    let pose = Cell::new().layout("\"mill\", \"pose\"", "\"mill\", \"poze\"");
    let told = pose.told("pose", &[]);
    only(&told, &["E0112", "\\\"pose\\\" or \\\"at\\\" is required", "\"column\":38"]);
    let none = Cell::new().layout(", \"pose\": [1.50, 0, 0, 90]", "");
    only(&none.told("no_pose", &[]), &["E0112", "\"column\":5", "add \\\"pose\\\": ... or \\\"at\\\": ..."]);
}

/// Obstacles alone: types without variants would be no program.
#[test]
fn a_line_without_a_machine_has_nothing_to_control() {
    let folder = folder("misplaced_no_machine");
    let alone = r#"{"name": "wall", "type": "box", "pose": [0, 0, 0], "box": [1, 1, 1]}"#;
    for stationary in ["", alone] {
        let layout = format!(r#"{{"robots": [], "stationary": [{stationary}]}}"#);
        fs::write(folder.join("line.json"), layout).expect("a file");
        let output = autogen(&folder, &["check", "line.json", "--format", "json"]);
        assert_eq!(status(&output), 1, "{stationary}");
        let told: Vec<String> =
            json(&output)["diagnostics"].as_array().expect("a list").iter().map(Value::to_string).collect();
        only(&told, &["E0512", "the layout has no machine", "line.json", "add one to"]);
    }
    let station = r#"{"robots": [], "stationary": [{"name": "bin", "type": "counter", "pose": [0, 0, 0]}]}"#;
    fs::write(folder.join("line.json"), station.replacen('{', r#"{"specs": "counter.aut", "#, 1))
        .expect("a file");
    fs::write(
        folder.join("counter.aut"),
        "automaton Counter on bin { initial state Rest { when after 1 s -> Rest {} } }\n",
    )
    .expect("a file");
    let output = autogen(&folder, &["check", "line.json"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
}
