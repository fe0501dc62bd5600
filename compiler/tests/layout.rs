//! Layouts: the fixtures, the examples, and texts that nobody would write.

mod fixture;

use autogen::diagnostic::{Diagnostic, render};
use autogen::layout::{self, Layout, Part};
use autogen::library;
use autogen::source::{FileId, Sources};
use fixture::{root, walk};

fn device(kind: &str) -> Option<&'static str> {
    match kind {
        "conveyor" => Some("belt"),
        "agv" => Some("vehicle"),
        "kitting" => Some("rail_arm"),
        "gantry" => Some("gantry"),
        "station" | "assembly_station" => Some("station"),
        "buffer" => Some("bin"),
        _ => None,
    }
}

/// Reads a layout and binds its types as the built-in library does.
fn check(sources: &Sources, file: FileId) -> Vec<Diagnostic> {
    let (layout, mut diagnostics) = layout::parse(sources, file);
    for object in layout.iter().flat_map(|l| &l.objects) {
        diagnostics.extend(match device(&object.kind.value) {
            Some(device) => {
                let device = library::device(device).unwrap();
                layout::machine(object, device, object.pose.value, &[]).err().unwrap_or_default()
            }
            None => layout::obstacle(object).err().unwrap_or_default(),
        });
    }
    diagnostics
}

fn example(name: &str) -> String {
    std::fs::read_to_string(root().join("examples/ariac2021").join(name)).unwrap()
}

fn read(name: &str, text: &str) -> Layout {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let diagnostics = check(&sources, file);
    assert_eq!(diagnostics, []);
    layout::parse(&sources, file).0.unwrap()
}

#[test]
fn fixtures() {
    walk("layout", check);
}

#[test]
fn a_key_of_a_machine_beside_the_machines_is_told_where_it_belongs() {
    let mut sources = Sources::default();
    let file = sources.add("x.json", "{\"robots\": [], \"parameters\": {}}");
    let [told] = &check(&sources, file)[..] else { panic!("one error") };
    assert_eq!(
        (told.code, told.help.as_str()),
        ("E0111", "write \"parameters\" in the object of a machine, in \"robots\"")
    );
}

#[test]
fn examples() {
    let default = read("examples/ariac2021/default.json", &example("default.json"));
    let spaced = read("spaced.json", &example("spaced.json"));
    let less = read("less_agv.json", &example("less_agv.json"));
    assert_eq!(default.name, "default");
    assert_eq!((default.scan_ms, default.scenario, default.specs.len()), (10, None, 0));
    let robots = |l: &Layout| -> Vec<String> {
        l.objects.iter().filter(|o| o.part == Part::Robot).map(|o| o.name.value.clone()).collect()
    };
    let all = ["conveyor_belt", "kitting", "agv1", "agv2", "agv3", "agv4", "gantry"];
    assert_eq!(robots(&spaced), all);
    assert_eq!(robots(&less), ["conveyor_belt", "kitting", "agv1", "agv3", "gantry"]);
    for object in &less.objects {
        let same = default.objects.iter().find(|o| o.name.value == object.name.value).unwrap();
        assert_eq!(object.pose.value, same.pose.value);
    }
}

#[test]
fn numbers_of_an_object_have_paths_and_places() {
    let mut sources = Sources::default();
    let file = sources.add("default.json", example("default.json"));
    let layout = layout::parse(&sources, file).0.unwrap();
    let agv = layout.objects.iter().find(|o| o.name.value == "agv1").unwrap();
    let numbers = layout::numbers(agv, library::device("vehicle").unwrap());
    let paths: Vec<&str> = numbers.iter().map(|n| n.path.as_str()).collect();
    assert_eq!(
        paths,
        [
            "pose[0]",
            "pose[1]",
            "pose[2]",
            "destinations[0][0]",
            "destinations[0][1]",
            "destinations[0][2]",
            "destinations[1][0]",
            "destinations[1][1]",
            "destinations[1][2]"
        ]
    );
    for number in numbers {
        assert_eq!(sources.text(number.span).parse::<f64>(), Ok(number.value));
    }
}

#[test]
fn the_name_of_a_layout_is_that_of_its_file() {
    assert_eq!(read("/a/b/my-line 2.json", "{\"robots\": []}").name, "my_line_2");
    assert_eq!(read("7.json", "{\"robots\": []}").name, "layout_7");
    assert_eq!(read("7.json", "{\"robots\": [], \"name\": \"seven\"}").name, "seven");
}

const NOISE: &[u8] = b"{}[]\",:'\\/*-+.eE01u_ \n\xff\xc3\xa9t";

/// Nothing but "no panic" is asked, of the rendering too.
fn survives(text: String) {
    let mut sources = Sources::default();
    let file = sources.add("damaged.json", text);
    let diagnostics = check(&sources, file);
    if let Some(first) = diagnostics.first() {
        render(&sources, std::slice::from_ref(first), &annotate_snippets::Renderer::plain());
    }
}

#[test]
fn every_prefix_is_read_or_refused() {
    let text = example("default.json");
    for end in (0..text.trim_end().len()).filter(|end| text.is_char_boundary(*end)) {
        let mut sources = Sources::default();
        let file = sources.add("cut.json", &text[..end]);
        assert!(!check(&sources, file).is_empty(), "prefix of {end} bytes");
    }
}

#[test]
fn mutations_are_read_or_refused() {
    let bytes = example("default.json").into_bytes();
    let mut state: u64 = 1;
    let mut random = move |below: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    for _ in 0..2000 {
        let mut mutated = bytes.clone();
        let at = random(mutated.len());
        mutated[at] = random(256) as u8;
        survives(String::from_utf8_lossy(&mutated).into_owned());
    }
    for _ in 0..500 {
        let noise: Vec<u8> = (0..random(60)).map(|_| NOISE[random(NOISE.len())]).collect();
        survives(String::from_utf8_lossy(&noise).into_owned());
    }
}

#[test]
fn deep_and_long_texts_end() {
    survives("[".repeat(1_000_000));
    survives("{\"a\":".repeat(200_000));
    survives("\u{feff}".repeat(1000));
    survives("1".repeat(100_000));
    survives(format!("{{\"robots\": [{}]}}", "{},".repeat(2_000)));
}
