//! Arms and tracks from files of other programs: the numbers of the file come back, and the machines move.

use autogen::executor::Executor;
use autogen::import::{lif, opw, urdf};
use autogen::source::Sources;
use autogen_tests::generate::Lot;
use autogen_tests::words::with_words;
use autogen_tests::{Texts, text};
use runtime_sim::memory::Memory;
use runtime_sim::run::{Seen, Stepping, run_again};

const URDF: urdf::Options =
    urdf::Options { base: None, tip: None, name: Some("arm_of_the_file"), mesh: None };

/// The input of a fixture.
fn fixture(path: &str) -> String {
    let text = text(&format!("tests/fixtures/import/{path}.txt"));
    text.split_once("--- expect").expect("an expectation").0.into()
}

fn of_urdf(text: &str, options: &urdf::Options) -> String {
    let mut sources = Sources::default();
    let file = sources.add("arm.urdf", text);
    match urdf::import(&sources, file, options) {
        Ok(imported) => imported.text,
        Err(found) => panic!("{text}\n{}", autogen_tests::plain(&sources, &found)),
    }
}

fn of_lif(text: &str) -> String {
    let mut sources = Sources::default();
    let file = sources.add("hall.json", text);
    let options = lif::Options { vehicle: None, name: Some("cart") };
    match lif::import(&sources, file, &options) {
        Ok(imported) => imported.text,
        Err(found) => panic!("{text}\n{}", autogen_tests::plain(&sources, &found)),
    }
}

/// The numbers of a list in a device text.
fn numbers(text: &str, key: &str) -> Vec<f64> {
    let (_, behind) = text.split_once(&format!("{key}: [")).unwrap_or_else(|| panic!("no {key} in {text}"));
    let (list, _) = behind.split_once(']').expect("the end of the list");
    list.split(", ").map(|number| number.parse().expect("a number")).collect()
}

/// The convention of the parameters with all its angles 0, written as joints: the first axis at the origin, the second
/// one a1 ahead at c1, c2 over it the third one, and so on. Each joint begins at its offset, and turns by its sign.
fn written(lengths: &[f64; 7], offsets: &[f64; 6], signs: &[f64; 6]) -> String {
    let [a1, a2, b, c1, c2, c3, c4] = *lengths;
    let steps = [[0.0, 0.0, 0.0], [a1, 0.0, c1], [0.0, 0.0, c2], [a2, b, c3], [0.0; 3], [0.0; 3]];
    let mut text = "<robot name=\"arm\">\n<link name=\"l0\"/>\n".to_string();
    for (joint, [x, y, z]) in steps.into_iter().enumerate() {
        let leans = matches!(joint, 1 | 2 | 4);
        let (angle, sign) = (-offsets[joint], signs[joint]);
        let (rpy, axis) = match leans {
            true => (format!("0 {angle} 0"), format!("0 {sign} 0")),
            false => (format!("0 0 {angle}"), format!("0 0 {sign}")),
        };
        text += &format!(
            "<link name=\"l{next}\"/>\n<joint name=\"j{next}\" type=\"revolute\"><parent link=\"l{joint}\"/>\
             <child link=\"l{next}\"/><origin xyz=\"{x} {y} {z}\" rpy=\"{rpy}\"/><axis xyz=\"{axis}\"/>\
             <limit lower=\"-6.2\" upper=\"6.2\" velocity=\"2\"/></joint>\n",
            next = joint + 1
        );
    }
    text + &format!(
        "<link name=\"tool0\"/>\n<joint name=\"end\" type=\"fixed\"><parent link=\"l6\"/><child link=\"tool0\"/>\
         <origin xyz=\"0 0 {c4}\"/></joint>\n</robot>\n"
    )
}

/// What the text lacks of the file, or has otherwise, is said.
#[test]
fn notes_tell_what_is_left_out() {
    let cases: [(&str, &[&str]); 5] = [
        (
            "urdf/fingers_and_capsules",
            &[
                "no body is written for links that do not move with a link of the arm: finger",
                "a box contains the capsule: l3",
                "direction: z; length: 0.5; radius: 0.05;",
            ],
        ),
        (
            "urdf/no_shapes",
            &["the file has no collision shapes", "`masses` is left out: the file lacks it for l2, l3"],
        ),
        (
            "urdf/partly",
            &[
                "`efforts` is left out: the file lacks it for j2",
                "j2: the narrower limits of <safety_controller>",
            ],
        ),
        (
            "lif/slow_back",
            &["parameter speed: real := 0.3;", "edges have different speeds; the vehicle has the least"],
        ),
        ("lif/parallel_edges", &["parameter speed: real := 0.3;", "also on edges without a velocity: e4"]),
    ];
    for (path, wanted) in cases {
        let text = fixture(path);
        let text = if path.starts_with("urdf") { of_urdf(&text, &URDF) } else { of_lif(&text) };
        for part in wanted {
            assert!(text.contains(part), "{path}: no `{part}` in {text}");
        }
    }
}

/// A file that is small, and has more elements than are read.
#[test]
fn elements_are_counted() {
    let codes = |count: usize| {
        let mut sources = Sources::default();
        let text = format!("<robot name=\"arm\">{}</robot>", "<a/>".repeat(count));
        let file = sources.add("arm.urdf", text);
        let found = urdf::import(&sources, file, &URDF).expect_err("a robot without links");
        found.iter().map(|found| (found.code, found.place.start)).collect::<Vec<_>>()
    };
    assert_eq!(codes(99_999), [("E1103", 0)]);
    let [("E1102", at)] = codes(100_000)[..] else { panic!("{:?}", codes(100_000)) };
    assert!(at > 300_000, "{at}");
}

#[test]
fn lengths_and_signs_of_an_arm_come_back_from_its_joints() {
    let mut lot = Lot::new(12);
    for _ in 0..300 {
        let mut length = |least: i32, most: i32| f64::from(lot.between(least, most)) / 1000.0;
        let lengths = [
            length(1, 400),
            length(-300, 300),
            length(-50, 50),
            length(0, 900),
            length(100, 1200),
            length(100, 1500),
            length(10, 300),
        ];
        let offsets: [f64; 6] = std::array::from_fn(|_| f64::from(lot.between(-314, 314)) / 100.0);
        let signs: [f64; 6] = std::array::from_fn(|_| if lot.one_in(2) { 1.0 } else { -1.0 });
        let device = of_urdf(&written(&lengths, &offsets, &signs), &URDF);
        for (found, wanted) in numbers(&device, "opw").iter().zip(lengths) {
            assert!((found - wanted).abs() < 1e-6, "{lengths:?}\n{device}");
        }
        // The angle of the fourth joint may be half a turn from that of the convention, with the fifth one bent to the
        // other side: both are the same arm. The first three are what they were.
        let (found, counted) = (numbers(&device, "offsets"), numbers(&device, "signs"));
        for joint in 0..3 {
            let apart = (found[joint].to_radians() - offsets[joint]) / std::f64::consts::TAU;
            assert!((apart - apart.round()).abs() < 1e-6, "joint {joint}: {offsets:?}\n{device}");
            assert_eq!(counted[joint], signs[joint], "joint {joint}\n{device}");
        }
    }
}

const MOVES: &str = "
automaton Mover on arm_of_the_file {
    local there: int 0..1000 := 0;
    initial -> Going {}
    state Going = sequence {
        move(rest + point(0.05, 0.1, -0.1));
        move(rest);
    } -> Counting {} else Stopped {}
    state Counting { when true -> Done { there := 1; } }
    state Done { when false -> Done {} }
    state Stopped { when false -> Stopped {} }
}";

/// Where the tool is at the end of a run, and the greatest error of its commands.
fn moved(device: String, keys: &str) -> ([f64; 3], f64, f64) {
    let layout =
        format!(r#"{{"robots": [{{"name": "arm", "type": "mover", "pose": [1, 2, 0.5, 90]{keys}}}]}}"#);
    let texts = Texts {
        specs: vec![device, MOVES.into()],
        scenario: Some(r#"{"time_limit_s": 30}"#.into()),
        ..Texts::of_layout(layout)
    };
    let (project, words) = with_words(&texts);
    let tool = ["arm_tool_x", "arm_tool_y", "arm_tool_z"].map(|name| words[name]);
    let (error, ack) = (words["arm_error"], words["arm_ack"]);
    let mut end = ([0.0; 3], 0.0, 0.0);
    let observer = &mut |seen: &Seen| {
        end = (tool.map(|word| word.value(seen)), f64::max(end.1, error.value(seen)), ack.value(seen));
    };
    let mut executor = Executor::new(&project.system);
    let report =
        run_again(&project.plant, &mut executor, Stepping::EveryScan, &mut Memory::default(), observer);
    assert_eq!(report.expect("a line that runs").reason.to_string(), "time limit reached");
    end
}

#[test]
fn imported_arms_move() {
    let mut sources = Sources::default();
    let file = sources.add("arm.yaml", fixture("opw/right"));
    let of_opw = opw::import(&sources, file, "arm_of_the_file").expect("a file that is right").text;
    for (device, keys) in [
        (of_urdf(&fixture("urdf/right"), &URDF), ""),
        (of_urdf(&fixture("urdf/universal_robots"), &URDF), ""),
        (of_urdf(&fixture("urdf/shapes_right"), &URDF), ""),
        (of_opw, r#", "joint_speed": 2.0"#),
    ] {
        let keys = format!(r#"{keys}, "acceleration": 4.0, "tool_length": 0.1"#);
        let [x, y, z] = point_of(&device);
        let (tool, error, ack) = moved(device.clone(), &keys);
        assert_eq!((error, ack), (0.0, 2.0), "{device}");
        // The machine is turned by 90 degrees to the left; the tool is 0.1 m below the flange.
        let wanted = [1.0 - y, 2.0 + x, 0.5 + z - 0.1];
        for (found, wanted) in tool.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-6, "{tool:?} {wanted:?}\n{device}");
        }
    }
}

#[test]
fn a_hung_arm_moves() {
    let upright = of_urdf(&fixture("urdf/shapes_right"), &URDF);
    let begin = upright.find("rest: origin").expect("a place to rest");
    let end = begin + upright[begin..].find(';').expect("its end");
    let rest = "hung: true; rest: origin * point(0.6, 0.2, 1.0) - point(0, 0, tool_length)";
    let device = format!("{}{rest}{}", &upright[..begin], &upright[end..]);
    // The ceiling is 2 m over the machine's place; the machine is turned to the left by 90 degrees.
    let device = device.replace("from: origin;", "from: origin * frame(0, 0, 2, 0);");
    let (tool, error, ack) = moved(device.clone(), r#", "acceleration": 4.0, "tool_length": 0.1"#);
    assert_eq!((error, ack), (0.0, 2.0), "{device}");
    for (found, wanted) in tool.iter().zip([1.0 - 0.2, 2.0 + 0.6, 0.5 + 1.0 - 0.1]) {
        assert!((found - wanted).abs() < 1e-6, "{tool:?}\n{device}");
    }
}

/// The place of the flange at the start, in the machine's frame.
fn point_of(device: &str) -> [f64; 3] {
    let (_, behind) = device.split_once("rest: origin * point(").expect("a place to rest");
    let (list, _) = behind.split_once(')').expect("its end");
    let numbers: Vec<f64> = list.split(", ").map(|number| number.parse().expect("a number")).collect();
    numbers.try_into().expect("three numbers")
}

/// Eight corners of a box of 0.2 x 0.4 x 0.6 m in millimetres, as the triangles of STL: each three are one.
fn box_in_stl() -> Vec<u8> {
    let corners = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2 & 1]);
    let points: Vec<[f32; 3]> = corners
        .map(|[x, y, z]| [x as f32 * 200.0, y as f32 * 400.0, z as f32 * 600.0])
        .chain([[0.0; 3]])
        .collect();
    let mut bytes = vec![b' '; 80];
    bytes.extend(3u32.to_le_bytes());
    for triangle in points.chunks(3) {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|number| number.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

#[test]
fn a_box_contains_a_mesh() {
    let link = r#"<link name="l1"/>"#;
    let mesh = r#"<link name="l1"><collision><origin xyz="0 0 0.1"/><geometry>
        <mesh filename="package://arm/meshes/l1.STL" scale="0.001 0.001 -0.001"/></geometry></collision></link>"#;
    let file = fixture("urdf/right").replace(link, mesh);
    let read = |name: &str| {
        assert_eq!(name, "package://arm/meshes/l1.STL");
        Ok(box_in_stl())
    };
    let device = of_urdf(&file, &urdf::Options { mesh: Some(&read), ..URDF });
    // The frame of the first joint is at the height of the second one, as is that of the link.
    let body =
        "part l1_shape = body { on: arm.shoulder; low: point(0, 0, -0.5); high: point(0.2, 0.4, 0.1); };";
    assert!(device.contains(body), "{device}");
    for broken in
        [Vec::new(), b"solid a\nvertex 1 2\n".to_vec(), box_in_stl()[..200].to_vec(), b"\0".repeat(84)]
    {
        let read = |_: &str| Ok(broken.clone());
        let device = of_urdf(&file, &urdf::Options { mesh: Some(&read), ..URDF });
        assert!(device.contains("no body is written for the mesh package://arm/meshes/l1.STL"), "{device}");
        assert!(!device.contains("part l1_shape"), "{device}");
    }
    let device = of_urdf(&file, &URDF);
    assert!(device.contains("`--meshes DIR` reads STL files: l1."), "{device}");
}

#[test]
fn shapes_of_links_become_bodies() {
    let device = of_urdf(&fixture("urdf/shapes_right"), &URDF);
    insta::assert_snapshot!("imported_arm", device);
}

#[test]
fn a_track_becomes_a_vehicle() {
    let device = of_lif(&fixture("lif/right"));
    insta::assert_snapshot!("imported_track", device);
    let automaton = "automaton Cart on cart { initial -> Going {}
        state Going = sequence { drive(2); drive(0); } -> Done {} else Done {}
        state Done { when false -> Done {} } }";
    let keys = r#""acceleration": 0.5, "length": 0.8, "width": 0.6, "height": 0.3, "mass": 50"#;
    let texts = Texts {
        layout: format!(r#"{{"robots": [{{"name": "cart", "type": "cart", "pose": [10, 20, 0], {keys}}}]}}"#),
        specs: vec![device, automaton.into()],
        scenario: Some(r#"{"time_limit_s": 60}"#.into()),
        ..Texts::default()
    };
    let (project, words) = with_words(&texts);
    let (x, y, ack) = (words["cart_pos_x"], words["cart_pos_y"], words["cart_ack"]);
    let mut seen_there = None;
    let mut end = [0.0; 3];
    let observer = &mut |seen: &Seen| {
        end = [x, y, ack].map(|word| word.value(seen));
        if end[2] == 1.0 && seen_there.is_none() {
            seen_there = Some((seen.scan, end));
        }
    };
    let mut executor = Executor::new(&project.system);
    run_again(&project.plant, &mut executor, Stepping::EveryScan, &mut Memory::default(), observer)
        .expect("a run");
    // 7 m at 1 m/s, which is the least velocity of the edges: 7/1 + 1/0.5 = 9 s.
    let (scan, there) = seen_there.expect("an answer");
    assert_eq!(there[..2], [14.0, 23.0]);
    assert!((scan as f64 / 100.0 - 9.0).abs() < 0.05, "{scan}");
    assert_eq!(end, [10.0, 20.0, 2.0]);
}
