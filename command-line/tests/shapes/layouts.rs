//! Layouts.

use super::{Shape, repeated};

pub const ALL: &[fn(usize) -> Shape] = &[
    distinct_keys,
    equal_keys,
    deep,
    numbers,
    long_number,
    long_text,
    blanks,
    no_objects,
    unknown_keys,
    same_name,
    robots_apart,
    robots_on_one_spot,
    obstacles,
    neighbours,
    unknown_neighbours,
    pairs,
    parameters,
    names_of_specs,
    lines_with_errors,
    one_line_with_errors,
];

fn shape(name: &'static str, layout: String) -> Shape {
    Shape { name, layout, ..Shape::default() }
}

fn list(name: &'static str, head: &str, bytes: usize, item: impl Fn(usize) -> String) -> Shape {
    let items = repeated(bytes, item);
    shape(name, format!("{head}{}]}}", items.trim_end_matches(',')))
}

fn distinct_keys(bytes: usize) -> Shape {
    let keys = repeated(bytes, |i| format!("\"k{i}\":0,"));
    shape("distinct_keys", format!("{{{keys}\"robots\":[]}}"))
}

fn equal_keys(bytes: usize) -> Shape {
    let keys = repeated(bytes, |_| "\"k\":0,".into());
    shape("equal_keys", format!("{{{keys}\"robots\":[]}}"))
}

fn deep(bytes: usize) -> Shape {
    shape("deep", format!("{{\"robots\":{}", "[".repeat(bytes)))
}

fn numbers(bytes: usize) -> Shape {
    list("numbers", "{\"robots\":[", bytes, |_| "0,".into())
}

fn long_number(bytes: usize) -> Shape {
    shape("long_number", format!("{{\"robots\":[],\"scan_ms\":{}}}", "1".repeat(bytes)))
}

fn long_text(bytes: usize) -> Shape {
    shape("long_text", format!("{{\"robots\":[],\"name\":\"{}\"}}", "n".repeat(bytes)))
}

fn blanks(bytes: usize) -> Shape {
    shape("blanks", format!("{{{}\"robots\":[]}}", "\n".repeat(bytes)))
}

fn no_objects(bytes: usize) -> Shape {
    list("no_objects", "{\"robots\":[", bytes, |_| "{},".into())
}

fn unknown_keys(bytes: usize) -> Shape {
    list("unknown_keys", "{\"robots\":[", bytes, |i| format!("{{\"nam\":\"a{i}\",\"tipe\":1,\"pos\":[]}},"))
}

fn robot(name: &str, kind: &str, x: f64, further: &str) -> String {
    format!("{{\"name\":\"{name}\",\"type\":\"{kind}\",\"pose\":[{x},0,0]{further}}},")
}

const BELT: &str = ",\"orient\":\"y\",\"orient_range\":[-5,5]";
const RAIL: &str = ",\"rail_dim\":\"y\",\"rail_range\":[-4.8,4.8]";

fn same_name(bytes: usize) -> Shape {
    list("same_name", "{\"robots\":[", bytes, |_| robot("a", "conveyor", 0.0, BELT))
}

fn arm(i: usize, x: f64) -> String {
    let belt = robot(&format!("b{i}"), "conveyor", x, BELT);
    let arm = robot(&format!("k{i}"), "kitting", x - 0.7, RAIL).replace(",0,0]", ",0,1.127]");
    let stops = format!(",\"destinations\":[[{},5,0],[{},9,0]]", x - 1.7, x - 1.7);
    belt + &arm + &robot(&format!("v{i}"), "agv", x - 1.7, &stops)
}

fn robots_apart(bytes: usize) -> Shape {
    list("robots_apart", "{\"robots\":[", bytes, |i| arm(i, (i % 200) as f64 * 9.0 - 900.0))
}

fn robots_on_one_spot(bytes: usize) -> Shape {
    list("robots_on_one_spot", "{\"robots\":[", bytes, |i| arm(i, 0.0))
}

fn obstacles(bytes: usize) -> Shape {
    list("obstacles", "{\"robots\":[],\"stationary\":[", bytes, |i| robot(&format!("o{i}"), "box", 1.0, ""))
}

fn neighbours(bytes: usize) -> Shape {
    let names = repeated(bytes / 2, |i| format!("\"b{i}\","));
    let further = format!("{RAIL},\"takes_from\":[{}]", names.trim_end_matches(','));
    let arm = robot("k", "kitting", 0.0, &further);
    list("neighbours", &format!("{{\"robots\":[{arm}"), bytes / 2, |i| {
        robot(&format!("b{i}"), "conveyor", 0.0, BELT)
    })
}

fn unknown_neighbours(bytes: usize) -> Shape {
    list("unknown_neighbours", "{\"robots\":[", bytes, |i| {
        robot(&format!("k{i}"), "kitting", 0.0, &format!("{RAIL},\"takes_from\":[\"x{i}\"]"))
    })
}

fn pairs(bytes: usize) -> Shape {
    let robots = (0..300).map(|i| robot(&format!("b{i}"), "conveyor", 0.0, BELT)).collect::<String>();
    let head = format!("{{\"robots\":[{}],\"may_touch\":[", robots.trim_end_matches(','));
    list("pairs", &head, bytes, |i| {
        format!("{{\"pair\":[\"b{}\",\"b{}\"],\"reason\":\"r\"}},", i / 300 % 300, i % 300)
    })
}

fn parameters(bytes: usize) -> Shape {
    let keys = repeated(bytes, |i| format!("\"p{i}\":0,"));
    let further = format!("{BELT},\"parameters\":{{{}}}", keys.trim_end_matches(','));
    let robot = robot("b", "conveyor", 0.0, &further);
    shape("parameters", format!("{{\"robots\":[{}]}}", robot.trim_end_matches(',')))
}

fn names_of_specs(bytes: usize) -> Shape {
    list("names_of_specs", "{\"robots\":[],\"specs\":[", bytes, |_| "\"a\",".into())
}

fn lines_with_errors(bytes: usize) -> Shape {
    list("lines_with_errors", "{\"robots\":[", bytes, |i| robot(&format!("a_{i}_"), "agv", 5000.0, "") + "\n")
}

fn one_line_with_errors(bytes: usize) -> Shape {
    list("one_line_with_errors", "{\"robots\":[", bytes, |i| robot(&format!("a_{i}_"), "agv", 5000.0, ""))
}
