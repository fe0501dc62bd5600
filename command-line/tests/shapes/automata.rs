//! Files of automata.

use super::{Shape, repeated};

pub const ALL: &[fn(usize) -> Shape] = &[
    heads,
    open_braces,
    foreign_signs,
    one_long_word,
    long_number,
    long_comment,
    documentation,
    text_of_a_requirement,
    states,
    chained_states,
    transitions,
    unknown_names,
    locals,
    arrays,
    arrays_of_many_robots,
    parameters,
    defines,
    doubling_defines,
    long_condition,
    nested_quantifiers,
    enumerations,
    members,
    interfaces,
    cells,
    roles,
    invariants,
    requirements_of_many_robots,
    updates,
    sequence,
    automata,
    automata_twice,
    states_of_many_robots,
];

fn text(name: &'static str, automata: String) -> Shape {
    Shape { name, automata, ..Shape::default() }
}

/// An automaton `T` with these members, and a state that leads to itself.
fn members_of(name: &'static str, members: &str) -> Shape {
    text(name, format!("automaton T on bin {{ {members} initial state A {{ when after 1 s -> A {{}} }} }}"))
}

fn items(name: &'static str, bytes: usize, item: impl Fn(usize) -> String) -> Shape {
    members_of(name, &repeated(bytes, item))
}

/// So many robots of type `t` as a layout of about half of the bytes has.
fn many(bytes: usize, shape: Shape) -> Shape {
    let robots = repeated(bytes / 2, |i| format!("{{\"name\":\"t{i}\",\"type\":\"t\",\"pose\":[0,0,0]}},"));
    Shape { layout: format!("{{\"robots\":[{}]}}", robots.trim_end_matches(',')), ..shape }
}

fn heads(bytes: usize) -> Shape {
    text("heads", repeated(bytes, |_| "automaton T on bin {\n".into()))
}

fn open_braces(bytes: usize) -> Shape {
    text("open_braces", "{".repeat(bytes))
}

fn foreign_signs(bytes: usize) -> Shape {
    text("foreign_signs", "$".repeat(bytes))
}

fn one_long_word(bytes: usize) -> Shape {
    text("one_long_word", format!("automaton {} on bin {{}}", "T".repeat(bytes)))
}

fn long_number(bytes: usize) -> Shape {
    members_of("long_number", &format!("local n: int 0..{};", "9".repeat(bytes)))
}

fn long_comment(bytes: usize) -> Shape {
    members_of("long_comment", &format!("// {}\n", "c".repeat(bytes)))
}

fn documentation(bytes: usize) -> Shape {
    text("documentation", repeated(bytes, |_| "/// d\n".into()) + &members_of("", "").automata)
}

fn text_of_a_requirement(bytes: usize) -> Shape {
    members_of("text_of_a_requirement", &format!("require true else \"{}\";", "{1}".repeat(bytes / 3)))
}

fn states(bytes: usize) -> Shape {
    items("states", bytes, |i| format!("state S{i} {{ when after 1 s -> A {{}} }}\n"))
}

fn chained_states(bytes: usize) -> Shape {
    items("chained_states", bytes, |i| format!("state S{i} {{ when after 1 s -> S{} {{}} }}\n", i + 1))
}

fn transitions(bytes: usize) -> Shape {
    text(
        "transitions",
        format!(
            "automaton T on bin {{ initial state A {{ {} }} }}",
            repeated(bytes, |_| "when after 1 s -> A {}\n".into())
        ),
    )
}

fn unknown_names(bytes: usize) -> Shape {
    items("unknown_names", bytes, |i| format!("define d{i} = unknown_{i};\n"))
}

fn locals(bytes: usize) -> Shape {
    items("locals", bytes, |i| format!("local n{i}: int 0..2147483647;\n"))
}

fn arrays(bytes: usize) -> Shape {
    items("arrays", bytes, |i| format!("local n{i}: real[1024];\n"))
}

fn arrays_of_many_robots(bytes: usize) -> Shape {
    many(bytes, items("arrays_of_many_robots", bytes / 100, |i| format!("local n{i}: real[1024];\n")))
}

fn parameters(bytes: usize) -> Shape {
    many(
        bytes,
        items("parameters_of_types", bytes / 100, |i| format!("parameter n{i}: real[1024] := 1.0;\n")),
    )
}

fn defines(bytes: usize) -> Shape {
    items("defines", bytes, |i| format!("define d{i} = 1 + {i};\n"))
}

fn doubling_defines(_: usize) -> Shape {
    let doubling = (1..31).map(|i| format!("define d{i} = d{0} and d{0};\n", i - 1)).collect::<String>();
    let uses = "require d30 else \"no\"; invariant d30;";
    members_of("doubling_defines", &format!("define d0 = true;\n{doubling}{uses}"))
}

fn long_condition(bytes: usize) -> Shape {
    members_of("long_condition", &format!("invariant true{};", " and true".repeat(bytes / 9)))
}

fn nested_quantifiers(bytes: usize) -> Shape {
    let nested = (0..60).map(|i| format!("exists v{i} in 0..2147483647: ")).collect::<String>();
    items("nested_quantifiers", bytes, |_| format!("invariant {nested} true;\n"))
}

fn enumerations(bytes: usize) -> Shape {
    text(
        "enumerations",
        repeated(bytes, |i| format!("enum E{i} {{ M{i} }}\n")) + &members_of("", "").automata,
    )
}

fn members(bytes: usize) -> Shape {
    let members = repeated(bytes, |i| format!("M{i}, "));
    text("members", format!("enum E {{ {members} Last }}\n{}", members_of("", "local e: E;").automata))
}

fn interfaces(bytes: usize) -> Shape {
    text("interfaces", repeated(bytes, |i| format!("interface I{i} {{ }}\n")) + &members_of("", "").automata)
}

fn cells(bytes: usize) -> Shape {
    items("cells", bytes, |i| format!("shared c{i}: bool := false;\n"))
}

fn roles(bytes: usize) -> Shape {
    many(bytes, items("roles", bytes / 100, |i| format!("knows r{i}: T[];\n")))
}

fn invariants(bytes: usize) -> Shape {
    items("invariants", bytes, |_| "invariant true;\n".into())
}

fn requirements_of_many_robots(bytes: usize) -> Shape {
    let require = "require (count a in 0..99, b in 0..99, c in 0..40: true) > 1 else \"no\";\n";
    many(bytes, items("requirements_of_many_robots", bytes / 100, |_| require.into()))
}

fn updates(bytes: usize) -> Shape {
    let updates = repeated(bytes, |_| "n := 1; ".into());
    let state = format!("initial state A {{ when after 1 s -> A {{ {updates} }} }}");
    text("updates", format!("automaton T on bin {{ local n: int 0..1; {state} }}"))
}

fn sequence(bytes: usize) -> Shape {
    let steps = repeated(bytes, |_| "wait 1 s; ".into());
    text("sequence", format!("automaton T on bin {{ initial state A = sequence {{ {steps} }} -> A {{}} }}"))
}

fn automata(bytes: usize) -> Shape {
    let other = |i| format!("automaton T{i} on bin {{ initial state A {{ when after 1 s -> A {{}} }} }}\n");
    text("automata", repeated(bytes, other) + &members_of("", "").automata)
}

fn automata_twice(bytes: usize) -> Shape {
    text("automata_twice", repeated(bytes, |_| members_of("", "").automata + "\n"))
}

fn states_of_many_robots(bytes: usize) -> Shape {
    let state = |i| format!("state S{i} {{ when after 1 s -> S{} {{}} }}\n", i + 1);
    let states = repeated(bytes / 100, state);
    let last = states.matches("state S").count();
    let first = "initial state A { when after 1 s -> S0 {} }";
    let end = format!("state S{last} {{ when after 1 s -> A {{}} }}");
    many(bytes, text("states_of_many_robots", format!("automaton T on bin {{ {states}{end}{first} }}")))
}
