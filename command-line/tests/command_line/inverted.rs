//! Contacts that a table of addresses inverts.

use super::*;

/// What a build says of an inverted input.
fn notes(folder: &Path, rows: &str) -> Vec<String> {
    let table = format!("robot,name,address,raw type,scale,offset,inversion\n{rows}");
    fs::write(folder.join("io.csv"), table).expect("a file");
    let output = autogen(folder, &["build", "line.json", "--io", "io.csv", "-o", "out", "--force"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    said.lines().filter(|line| line.contains("inverted")).map(String::from).collect()
}

#[test]
fn an_inverted_contact_of_a_person_is_noted() {
    let folder = folder("inverted");
    let layout = fs::read_to_string(example("scenes/lifting_table.json")).expect("the example");
    let layout = layout.replacen('{', "{\"panel\": \"machines\",", 1);
    for name in ["lifting_table.aut", "lifting_table.scenario.json"] {
        fs::copy(example(&format!("scenes/{name}")), folder.join(name)).expect("a copy");
    }
    fs::write(folder.join("line.json"), &layout).expect("a file");
    let robot =
        layout.split("\"name\": \"").nth(1).and_then(|rest| rest.split('"').next()).expect("a machine");
    let inverted = format!(
        ",start,%IX0.1,BOOL,,,TRUE\n,reset,%IX0.2,BOOL,,,TRUE\n\
         {robot},{robot}_panel_jog,%IX0.3,BOOL,,,TRUE\n{robot},{robot}_panel_enable,%IX0.4,BOOL,,,TRUE\n"
    );
    let found = notes(&folder, &inverted);
    assert_eq!(found.len(), 4, "{found:?}");
    for name in ["start", "reset", &format!("{robot}_panel_jog"), &format!("{robot}_panel_enable")] {
        let begin = format!("note: {name} is inverted: a broken wire");
        assert!(found.iter().any(|note| note.starts_with(&begin)), "{name}: {found:?}");
    }
    assert_eq!(notes(&folder, &inverted.replace("TRUE", "FALSE")), [] as [&str; 0]);
}
