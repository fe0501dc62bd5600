//! The output folder that nobody names: whose it is, and the command that builds it again.

use super::*;

/// A line of one machine, as small as can be.
fn put_line(folder: &Path, name: &str) {
    fs::write(folder.join(name), r#"{"robots": [], "specs": "rest.aut", "stationary": [{"name": "bin", "type": "rester", "pose": [0, 0, 0]}]}"#)
        .expect("a file");
    let automaton = "automaton Rester on bin { initial state Rest { when after 1 s -> Rest {} } }\n";
    fs::write(folder.join("rest.aut"), automaton).expect("a file");
}

#[test]
fn layouts_of_the_same_name_do_not_replace_one_another() {
    let folder = folder("same_name");
    put_line(&folder, "名前.json");
    put_line(&folder, "工場.json");
    let build = |layout: &str, more: &[&str]| autogen(&folder, &[&["build", layout][..], more].concat());
    for _ in 0..2 {
        let output = build("名前.json", &[]);
        assert_eq!(status(&output), 0, "{}", errors(&output));
    }
    let before = contents(&folder.join("out"));
    for command in ["build", "commission"] {
        let output = autogen(&folder, &[command, "工場.json"]);
        assert_eq!(status(&output), 2, "{command}");
        let said = errors(&output);
        assert!(
            said.contains("out/layout has what `autogen build 名前.json` has built from another layout"),
            "{said}"
        );
        assert!(said.contains("another name with its key \"name\""), "{said}");
    }
    assert_eq!(before, contents(&folder.join("out")));
    assert_eq!(status(&build("工場.json", &["-o", "out/layout"])), 0, "it is named");
    assert_eq!(status(&build("名前.json", &["--force"])), 0);

    // Another folder with a layout of the same name goes on as the same line.
    fs::create_dir(folder.join("copy")).expect("a folder");
    put_line(&folder.join("copy"), "名前.json");
    assert_eq!(status(&build("copy/名前.json", &[])), 0);
}

#[cfg(unix)]
#[test]
fn a_layout_whose_name_looks_like_an_option_is_built_again() {
    let folder = folder("like_an_option");
    put_line(&folder, "-line.json");
    assert_eq!(status(&autogen(&folder, &["build", "./-line.json", "-q", "-o", "made"])), 0);
    let manifest = fs::read(folder.join("made/manifest.json")).expect("a manifest");
    let command = serde_json::from_slice::<Value>(&manifest).expect("JSON")["command"].clone();
    assert_eq!(command, "autogen build ./-line.json");
    let tool = Path::new(env!("CARGO_BIN_EXE_autogen")).parent().expect("a folder");
    let again =
        format!("PATH={}:$PATH; {} -q -o ../../again", tool.display(), command.as_str().expect("a text"));
    let output = Command::new("sh")
        .args(["-c", &again])
        .current_dir(folder.join("made/sources"))
        .output()
        .expect("a shell");
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert_eq!(fs::read(folder.join("again/manifest.json")).expect("a manifest"), manifest);
}
