//! What large inputs cost, `large [MEGABYTES]`: pieces of each grammar repeated, one line for each input.
//! Bounds are those of one input below 10 MB: 2 s and 500 MB. Build it with `--release`.

use autogen_fuzz::{Effort, Target, memory};
use std::time::Instant;

/// Target, name, what stands before, what is repeated (`#` is its number), what stands behind.
const SHAPES: [(&str, &str, &str, &str, &str); 33] = [
    ("layout", "brackets", "", "[", ""),
    ("layout", "objects", "", "{\"a\":", ""),
    ("layout", "spaces", "", " \n", ""),
    ("layout", "digits", "", "1", ""),
    ("layout", "quotes", "", "\"", ""),
    ("layout", "commas", "[", ",", "]"),
    ("layout", "numbers", "{\"robots\": [", "1,", "1]}"),
    ("layout", "keys", "{", "\"k#\":1,", "\"robots\": []}"),
    ("layout", "long name", "{\"robots\": [{\"name\": \"", "a", "\"}]}"),
    (
        "layout",
        "robots",
        "{\"robots\": [",
        "{\"name\": \"a#\", \"type\": \"agv\", \"pose\": [0, 0, 0], \"destinations\": [[0,0,0],[1,0,0]]},\n",
        "{}]}",
    ),
    (
        "layout",
        "bins",
        "{\"robots\": [], \"stationary\": [",
        "{\"name\": \"a#\", \"type\": \"bin\", \"pose\": [0, 0, 0]},\n",
        "{\"name\": \"end\", \"type\": \"bin\", \"pose\": [0, 0, 0]}]}",
    ),
    (
        "layout",
        "may_touch",
        "{\"robots\": [], \"may_touch\": [",
        "{\"pair\": [\"a\", \"b#\"], \"reason\": \"x\"},",
        "{}]}",
    ),
    (
        "layout",
        "unknown neighbours",
        "{\"robots\": [{\"name\": \"a\", \"type\": \"agv\", \"pose\": [0,0,0], \"takes_from\": [",
        "\"b#\",",
        "\"b\"]}]}",
    ),
    ("specification", "signs", "", "+", ""),
    ("specification", "words", "", "when ", ""),
    ("specification", "braces", "", "{", ""),
    ("specification", "comments", "", "/* */", ""),
    ("specification", "docs", "", "/// a\n", ""),
    ("specification", "odd letters", "", "é", ""),
    ("specification", "enums", "", "enum E# { A }\n", ""),
    ("specification", "members", "enum E { ", "A#, ", "A }"),
    (
        "specification",
        "locals",
        "automaton A on bin { ",
        "local v#: int 0..9;\n",
        "initial state S { when false -> S {} } }",
    ),
    (
        "specification",
        "states",
        "automaton A on bin { initial -> S0 {}\n",
        "state S# { when true -> S# {} }\n",
        "}",
    ),
    (
        "specification",
        "transitions",
        "automaton A on bin { initial state S {\n",
        "when false -> S {}\n",
        "} }",
    ),
    (
        "specification",
        "long expression",
        "automaton A on bin { initial state S { when ",
        "true and ",
        "true -> S {} } }",
    ),
    ("specification", "automata", "", "automaton A# on bin { initial state S { when false -> S {} } }\n", ""),
    (
        "specification",
        "shown text",
        "automaton A on bin { require true else \"",
        "{1}",
        "\"; initial state S { when true -> S {} } }",
    ),
    ("scenario", "kinds", "{\"kinds\": [", "{\"name\": \"k#\", \"height\": 0.1},", "{}], \"orders\": []}"),
    (
        "scenario",
        "orders",
        "{\"kinds\": [{\"name\": \"a\", \"height\": 0.1}], \"orders\": [",
        "{\"parts\": {\"a\": 1}},",
        "{}]}",
    ),
    (
        "scenario",
        "items",
        "{\"kinds\": [{\"name\": \"a\", \"height\": 0.1}], \"orders\": {\"count\": 1, \"parts\": {\"a\": 1}}, \"supply\": {\"items\": [",
        "\"a\",",
        "\"a\"]}}",
    ),
    (
        "table",
        "strangers",
        "robot,name,address,raw type,scale,offset,inversion\n",
        "x#,x#_cmd,%QW#,INT,,,\n",
        "",
    ),
    (
        "table",
        "addresses",
        "robot,name,address,raw type,scale,offset,inversion\n",
        "agv1,agv1_got,%IW#,INT,,,\n",
        "",
    ),
    ("table", "figures", "layout,seconds_per_order\n", "a#,1\n", ""),
];

fn main() {
    let megabytes: f64 = std::env::args().nth(1).map_or(9.9, |text| text.parse().expect("a number"));
    let length = (megabytes * 1e6) as usize;
    for (target, name, front, piece, behind) in SHAPES {
        let mut text = String::from(front);
        let mut number = 0_usize;
        while text.len() + behind.len() < length {
            text += &piece.replace('#', &number.to_string());
            number += 1;
        }
        text += behind;
        let target = Target::find(target).expect("a target");
        let begin = Instant::now();
        let taken = memory::peak(|| (target.answer)(text.as_bytes(), Effort::Sampled));
        let seconds = begin.elapsed().as_secs_f64();
        let verdict = if seconds > 2.0 || taken > memory::MOST { "over" } else { "" };
        println!("{:14} {name:20} {seconds:8.2} s {:6} MB {verdict}", target.name, taken >> 20);
    }
}
