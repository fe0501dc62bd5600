//! `build --drives`.

use super::*;

#[test]
fn the_blocks_for_drives_are_written_when_they_are_asked_for() {
    let folder = folder("drives");
    let layout = example("scenes/lifting_table.json");
    let build = |more: &[&str]| {
        let output = autogen(&folder, &[&["build", &layout, "-o", "out"], more].concat());
        assert_eq!(status(&output), 0, "{}", errors(&output));
    };
    let drives = folder.join("out/plc/drives");
    build(&["--drives"]);
    for name in ["axis.st", "robot.st", "inverter.st"] {
        let template = Path::new(env!("CARGO_MANIFEST_DIR")).join("../templates/plc/drives").join(name);
        let wanted = fs::read(template).expect("a template");
        assert_eq!(fs::read(drives.join(name)).expect("a block"), wanted, "{name}");
    }
    let manifest = fs::read_to_string(folder.join("out/manifest.json")).expect("a manifest");
    assert!(manifest.contains("plc/drives/axis.st"), "{manifest}");
    build(&[]);
    assert!(!drives.exists());
}
