//! `autogen import`.

use super::*;

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The input of a fixture, as a file of the folder.
fn file(folder: &Path, fixture: &str, name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/fixtures/import").join(fixture);
    let text = fs::read_to_string(path).unwrap();
    let (input, _) = text.split_once("--- expect").unwrap();
    fs::write(folder.join(name), input).unwrap();
    input.into()
}

#[test]
fn a_device_is_printed_or_an_error_and_nothing_else() {
    let folder = folder("import");
    file(&folder, "urdf/right.txt", "arm.urdf");
    let output = autogen(&folder, &["import", "urdf", "arm.urdf", "--name", "my_arm"]);
    assert_eq!(status(&output), 0);
    assert!(said(&output).starts_with("// From arm.urdf: arm."), "{}", said(&output));
    assert!(said(&output).contains("device my_arm {"));
    assert!(String::from_utf8_lossy(&output.stderr).starts_with("note: six axes with a spherical wrist"));
    for (fixture, words) in [
        ("urdf/doctype.txt", ["import", "urdf"]),
        ("opw/anchor.txt", ["import", "opw"]),
        ("lif/junction.txt", ["import", "lif"]),
    ] {
        file(&folder, fixture, "wrong");
        let output = autogen(&folder, &[words[0], words[1], "wrong"]);
        assert_eq!((status(&output), said(&output).as_str()), (1, ""), "{fixture}");
        assert!(String::from_utf8_lossy(&output.stderr).contains("1 error"), "{fixture}");
    }
    assert_eq!(status(&autogen(&folder, &["import", "urdf", "none.urdf"])), 2);
    assert_eq!(status(&autogen(&folder, &["import", "step", "arm.urdf"])), 2);
}

#[test]
fn meshes_are_read_below_their_folder_only() {
    let folder = folder("import_meshes");
    fs::create_dir_all(folder.join("package/meshes")).unwrap();
    let text = "solid a\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 1\n";
    fs::write(folder.join("secret.stl"), text).unwrap();
    fs::write(folder.join("package/meshes/l1.stl"), text).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("../../secret.stl", folder.join("package/meshes/link.stl")).unwrap();
    let right = file(&folder, "urdf/right.txt", "arm.urdf");
    let with = |name: &str| {
        let mesh = format!(
            "<link name=\"l1\"><collision><geometry><mesh filename=\"{name}\"/></geometry></collision></link>"
        );
        fs::write(folder.join("arm.urdf"), right.replace("<link name=\"l1\"/>", &mesh)).unwrap();
        let output = autogen(&folder, &["import", "urdf", "arm.urdf", "--meshes", "package"]);
        assert_eq!(status(&output), 0);
        said(&output)
    };
    assert!(with("package://arm/meshes/l1.stl").contains("part l1_shape"));
    let outside =
        ["package://arm/../secret.stl", "../secret.stl", "package://arm//etc/a.stl", "http://a/b.stl"];
    for name in outside.into_iter().chain(cfg!(unix).then_some("package://arm/meshes/link.stl")) {
        let text = with(name);
        assert!(
            !text.contains("part l1_shape") && text.contains("no body is written for the mesh"),
            "{name}: {text}"
        );
    }
}
