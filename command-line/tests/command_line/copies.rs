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

    let made = named(&folder.join("made"));
    fs::remove_dir_all(folder.join("in")).expect("a folder");
    let manifest = fs::read(folder.join("made/manifest.json")).expect("a manifest");
    let manifest: Value = serde_json::from_slice(&manifest).expect("JSON");
    let command = manifest["command"].as_str().expect("a command");
    assert_eq!(
        command,
        "autogen build 'a line.json' --specs own.aut --specs 'OWN (2).aut' --scenario other.json \
         --set agv.capacity=4 --order 3 --io io.csv --addresses bytes --texts texts.csv --no-plcopen --drives"
    );
    let tool = Path::new(env!("CARGO_BIN_EXE_autogen")).parent().expect("a folder");
    let output = Command::new("sh")
        .args(["-c", &format!("PATH={}:$PATH; {command} -q -o ../../again", tool.display())])
        .current_dir(folder.join("made/sources"))
        .output()
        .expect("a shell");
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let again = named(&folder.join("again"));
    let names = |files: &[(PathBuf, Vec<u8>)]| files.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&made), names(&again));
    let differ: Vec<_> = made.iter().zip(&again).filter(|(a, b)| a != b).map(|(a, _)| &a.0).collect();
    assert!(differ.is_empty(), "{differ:?}");
    for name in ["sources/own/own.aut", "sources/own.aut", "sources/OWN (2).aut", "library/agv.aut"] {
        assert!(made.iter().any(|(made, _)| *made == Path::new(name)), "{name}");
    }
    assert!(!made.iter().any(|(made, _)| *made == Path::new("sources/scenario.json")), "it was not read");
}
