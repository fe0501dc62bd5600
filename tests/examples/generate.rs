//! Prints a generated specification: `generate SEED COUNT`.
fn main() {
    let mut arguments = std::env::args().skip(1).map(|a| a.parse().expect("a number"));
    let (seed, count) = (arguments.next().unwrap_or(1), arguments.next().unwrap_or(5));
    let made = autogen_tests::generate::generate(seed, count as usize);
    println!("{}", made.text);
    eprintln!(
        "{} accepted, refused {:?}\n{}",
        made.automata,
        made.refused,
        made.examples.values().cloned().collect::<Vec<_>>().join("\n")
    );
}
