//! What a line was built from, in its output.

use super::*;

/// The files of a folder by their names within it.
fn named(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let within = |path: PathBuf| path.strip_prefix(folder).expect("within").to_path_buf();
    contents(folder).into_iter().map(|(path, text)| (within(path), text)).collect()
}

/// A type that nothing in the line has.
fn own_type(name: &str) -> String {
    format!(
        "automaton {name} on bin {{\n    initial -> Idle {{}}\n    state Idle {{ when after 1 s -> Idle {{}} }}\n}}\n"
    )
}

/// Builds again what `made` has, by the command of its manifest and its copies alone, and returns that command.
fn built_again(folder: &Path) -> String {
    let manifest = fs::read(folder.join("made/manifest.json")).expect("a manifest");
    let manifest: Value = serde_json::from_slice(&manifest).expect("JSON");
    let command = manifest["command"].as_str().expect("a command");
    let tool = Path::new(env!("CARGO_BIN_EXE_autogen")).parent().expect("a folder");
    let output = Command::new("sh")
        .args(["-c", &format!("PATH={}:$PATH; {command} -q -o ../../again", tool.display())])
        .current_dir(folder.join("made/sources"))
        .output()
        .expect("a shell");
    assert_eq!(status(&output), 0, "{command}: {}", errors(&output));
    let [made, again] = ["made", "again"].map(|name| named(&folder.join(name)));
    let names = |files: &[(PathBuf, Vec<u8>)]| files.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&made), names(&again));
    let differ: Vec<_> = made.iter().zip(&again).filter(|(a, b)| a != b).map(|(a, _)| &a.0).collect();
    assert!(differ.is_empty(), "{command}: {differ:?}");
    command.into()
}

/// Everything that can be given, from folders that are gone then; the names of two files differ in case alone.
#[test]
fn the_copies_in_the_output_build_the_same_again() {
    let folder = folder("copies");
    let write = |name: &str, text: &str| {
        let path = folder.join("in").join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    };
    let layout = fs::read_to_string(example("ariac2021/default.json")).expect("the example");
    write("line/a line.json", &layout.replacen('{', "{ \"specs\": [\"own\"],", 1));
    write("line/own/own.aut", &own_type("First"));
    write("line/scenario.json", "{}");
    write("own.aut", &own_type("Second"));
    write("more/OWN.aut", &own_type("Third"));
    write("other.json", "{ \"time_limit_s\": 60 }");
    let build = |more: &[&str]| {
        let line = ["build", "in/line/a line.json", "-o", "made", "-q", "--set", "agv.capacity=4"];
        let output = autogen(&folder, &[&line, more].concat());
        assert_eq!(status(&output), 0, "{}", errors(&output));
    };
    build(&[]);
    let table = |name: &str| fs::read_to_string(folder.join("made/plc").join(name)).expect("a table");
    write("io.csv", &table("io.csv"));
    let texts: Vec<String> = table("texts.csv")
        .lines()
        .enumerate()
        .map(|(row, line)| line.to_string() + if row == 0 { ",de" } else { ",Wort" })
        .collect();
    write("texts.csv", &texts.join("\n"));
    let specs =
        ["--specs", "in/own.aut", "--specs", "in/more", "--scenario", "in/other.json", "--order", "3"];
    let tables =
        ["--io", "in/io.csv", "--addresses", "bytes", "--texts", "in/texts.csv", "--drives", "--no-plcopen"];
    build(&[&specs[..], &tables].concat());

    fs::remove_dir_all(folder.join("in")).expect("a folder");
    let command = built_again(&folder);
    assert_eq!(
        command,
        "autogen build 'a line.json' --specs own.aut --specs 'OWN (2).aut' --scenario other.json \
         --set agv.capacity=4 --order 3 --io io.csv --addresses bytes --texts texts.csv --no-plcopen --drives"
    );
    let made = named(&folder.join("made"));
    for name in ["sources/own/own.aut", "sources/own.aut", "sources/OWN (2).aut", "library/agv.aut"] {
        assert!(made.iter().any(|(made, _)| *made == Path::new(name)), "{name}");
    }
    assert!(!made.iter().any(|(made, _)| *made == Path::new("sources/scenario.json")), "it was not read");
}

/// A folder with a small line in `in`, whose layout has these keys for those of its types and its scenario.
fn small_line(name: &str, keys: &str) -> PathBuf {
    let folder = folder(name);
    assert_eq!(status(&autogen(&folder, &["new", "in", "-q"])), 0);
    let layout = folder.join("in/line.json");
    let text = fs::read_to_string(&layout).expect("a layout");
    assert!(text.contains(SPECS), "{text}");
    fs::write(layout, text.replacen(SPECS, keys, 1)).expect("a layout");
    folder
}

const SPECS: &str = "\"specs\": \"specs\",\n  \"scenario\": \"scenario.json\",";

/// Builds the line in its folder, and returns what was said.
fn built(folder: &Path, arguments: &[&str]) -> String {
    let output = autogen(&folder.join("in"), &[&["build", "-o", "../made"], arguments].concat());
    assert_eq!(status(&output), 0, "{arguments:?}: {}", errors(&output));
    errors(&output)
}

/// Gives the tables that a build has written these names.
fn tables(folder: &Path, io: &str, texts: &str) {
    let table = |name: &str| fs::read_to_string(folder.join("made/plc").join(name)).expect("a table");
    fs::write(folder.join("in").join(io), table("io.csv")).expect("a table");
    let text = table("texts.csv").replacen("use,text\n", "use,text,de\n", 1);
    fs::write(folder.join("in").join(texts), text).expect("a table");
}

#[test]
fn a_path_may_begin_with_its_folder() {
    let named = "\"specs\": [\"./specs\"], \"scenario\": \"./scenario.json\",";
    let folder = small_line("copies_here", named);
    let extra = folder.join("in/extra");
    fs::create_dir(&extra).expect("a folder");
    fs::write(extra.join("extra.aut"), own_type("Extra")).expect("a file");
    assert_eq!(built(&folder, &["line.json"]), "");
    assert_eq!(built_again(&folder), "autogen build line.json");
    tables(&folder, "io.csv", "-dash.csv");
    let given = ["--scenario", "./scenario.json", "--io", "./io.csv", "--texts", "./-dash.csv"];
    for [layout, extra] in
        [["line.json", "./extra"], ["./line.json", "extra"], ["././line.json", "./extra/."]]
    {
        built(&folder, &[&[layout, "--specs", extra], &given[..]].concat());
        assert_eq!(
            built_again(&folder),
            "autogen build line.json --specs extra/extra.aut --scenario scenario.json --io io.csv --addresses words \
             --texts ./-dash.csv"
        );
    }
}

#[test]
fn a_copy_has_a_name_that_all_systems_take() {
    let folder = small_line("copies_signs", SPECS);
    built(&folder, &["line.json"]);
    tables(&folder, "io 12:30.csv", "a\\b.csv");
    let inside = folder.join("in");
    fs::create_dir(inside.join("sp:2")).expect("a folder");
    fs::write(inside.join("sp:2/a:b.aut"), own_type("First")).expect("a file");
    fs::write(inside.join("sp:2/a_b.aut"), own_type("Second")).expect("a file");
    for (layout, copy, name) in
        [("v1:2.json", "v1_2.json", "v1_2"), ("lay*)(*\\.json", "'lay_)(__.json'", "lay")]
    {
        fs::copy(inside.join("line.json"), inside.join(layout)).expect("a layout");
        let given = ["--specs", "sp:2", "--io", "io 12:30.csv", "--texts", "a\\b.csv"];
        assert!(!built(&folder, &[&[layout], &given[..]].concat()).contains("warning"));
        assert_eq!(
            built_again(&folder),
            format!(
                "autogen build {copy} --specs sp_2/a_b.aut --specs 'sp_2/a_b (2).aut' --io 'io 12_30.csv' \
                 --addresses words --texts a_b.csv"
            )
        );
        let manifest = fs::read_to_string(folder.join("made/manifest.json")).expect("a manifest");
        assert!(manifest.contains(&format!("\"layout\": \"{name}\"")), "{manifest}");
    }
}

/// The layout itself is copied as it is, so what it names cannot have another name there.
#[test]
fn what_a_layout_names_by_a_name_that_its_copy_cannot_have_is_said() {
    for (path, file) in [("sp:2", "sp:2/stamp.aut"), ("a/../specs", "a/../specs/stamp.aut")] {
        let folder =
            small_line("copies_named", &format!("\"specs\": \"{path}\", \"scenario\": \"scenario.json\","));
        fs::create_dir(folder.join("in/a")).expect("a folder");
        if path == "sp:2" {
            fs::rename(folder.join("in/specs"), folder.join("in/sp:2")).expect("a folder");
        }
        let said = built(&folder, &["line.json"]);
        assert!(said.contains("warning: ") && said.contains(&format!("`{file}`")), "{path}: {said}");
        assert!(said.contains("line.json") && said.contains("give"), "{path}: {said}");
    }
}

/// What a person translates is a text from outside like any other.
#[test]
fn translated_texts_control_no_terminal() {
    let folder = small_line("copies_control", SPECS);
    built(&folder, &["line.json"]);
    let texts = fs::read_to_string(folder.join("made/plc/texts.csv")).expect("a table");
    let (_, text) = texts.lines().nth(1).and_then(|line| line.split_once(',')).expect("a text");
    let table = format!("use,text,de\nalarm,{text},\"\u{1b}[31mrot\u{202e}ab\0c\u{7}\r\nzwei\"\n");
    fs::write(folder.join("in/t.csv"), table).expect("a table");
    built(&folder, &["line.json", "--texts", "t.csv"]);
    for name in ["alarms.de.csv", "texts.csv"] {
        let made = fs::read_to_string(folder.join("made/plc").join(name)).expect("a table");
        assert!(made.contains("\u{241b}[31mrot\u{fffd}ab\u{2400}c\u{2407}\nzwei"), "{name}: {made:?}");
    }
}
