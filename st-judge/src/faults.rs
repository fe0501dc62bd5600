//! Faults that are seeded into a text, to prove that the judge finds them.

mod declaration;
mod expression;
mod statement;
mod survey;
mod written;

use crate::check::Checked;
use crate::finding::Span;
use runtime_sim::random::Random;
use std::collections::BTreeSet;
use std::thread;
use survey::Survey;

/// A kind of fault.
pub struct Fault {
    pub name: &'static str,
    /// Every way to bring it into a text that has none.
    mutations: fn(&Survey) -> Vec<Mutation>,
}

/// Replacements that do not overlap, in any order.
pub(crate) type Mutation = Vec<(Span, String)>;

/// The published list: what real compilers were tried with.
pub const PUBLISHED: [&str; 39] = [
    "undefined variable",
    "undefined variable inside an expression",
    "BOOL := DINT",
    "DINT := LREAL",
    "LREAL := BOOL",
    "missing END_IF",
    "missing END_CASE",
    "missing semicolon",
    "unknown FB parameter",
    "unknown FB output",
    "unknown type",
    "unknown function",
    "unknown function argument",
    "missing function argument",
    "wrong FB parameter type",
    "duplicate variable",
    "VAR_EXTERNAL without VAR_GLOBAL",
    "VAR_EXTERNAL of another type",
    "unknown program in CONFIGURATION",
    "unknown task in CONFIGURATION",
    "IF on a number",
    "AND on LREAL",
    "BOOL > DINT",
    "LREAL index",
    "indexing a scalar",
    "constant index out of bounds",
    "duplicate CASE label",
    "CASE on LREAL",
    "assignment to VAR_INPUT",
    "assignment to an FB's output",
    "reading an FB's local",
    "reserved word as a name",
    "unbalanced parentheses",
    "`==`",
    "`=` for `:=`",
    "stray ELSE",
    "double underscore",
    "literal too large",
    "`//` comment",
];

/// What became of one kind of fault.
#[derive(Clone, Debug)]
pub struct Row {
    pub name: &'static str,
    /// The rules by which it was found first.
    pub rules: BTreeSet<&'static str>,
    /// At how many places of the text it could be.
    pub possible: usize,
    pub seeded: usize,
    pub caught: usize,
    /// For each one that was not found, what was changed.
    pub missed: Vec<String>,
}

/// The faults of the published list, then those against the other rules of the portable core.
pub fn all() -> Vec<Fault> {
    let lists = [expression::FAULTS, statement::FAULTS, declaration::FAULTS, written::FAULTS];
    let mut faults: Vec<_> =
        lists.into_iter().flatten().map(|&(name, mutations)| Fault { name, mutations }).collect();
    faults.sort_by_key(|fault| PUBLISHED.iter().position(|name| *name == fault.name).unwrap_or(usize::MAX));
    faults
}

type Entry = (&'static str, fn(&Survey) -> Vec<Mutation>);

/// Seeds each fault at drawn places of the text and judges the result.
pub fn seed(source: &str, checked: &Checked, places: usize, random_seed: u64) -> Vec<Row> {
    let survey = Survey::new(source, checked);
    let mut random = Random::new(random_seed);
    all()
        .iter()
        .map(|fault| {
            let mut mutations = (fault.mutations)(&survey);
            let possible = mutations.len();
            random.shuffle(&mut mutations);
            mutations.truncate(places);
            let seeded = mutations.len();
            let mut row =
                Row { name: fault.name, rules: BTreeSet::new(), possible, seeded, caught: 0, missed: vec![] };
            for (mutation, found) in mutations.iter().zip(judged(source, &mutations)) {
                match found {
                    Some(rule) => {
                        row.caught += 1;
                        row.rules.extend(rule);
                    }
                    None => row.missed.push(described(source, mutation)),
                }
            }
            row
        })
        .collect()
}

/// By which rule each of the changed texts is found first, if it is found; on all processors.
fn judged(source: &str, mutations: &[Mutation]) -> Vec<Option<Option<&'static str>>> {
    let judge = |mutation: &Mutation| {
        let findings = crate::judge(&applied(source, mutation)).err()?;
        Some(findings.first().map(|finding| finding.code))
    };
    let workers = thread::available_parallelism().map_or(1, |count| count.get());
    let size = mutations.len().div_ceil(workers).max(1);
    thread::scope(|scope| {
        let parts = mutations.chunks(size);
        let parts: Vec<_> =
            parts.map(|part| scope.spawn(move || part.iter().map(judge).collect::<Vec<_>>())).collect();
        parts.into_iter().flat_map(|part| part.join().expect("the judge does not panic")).collect()
    })
}

fn applied(source: &str, mutation: &Mutation) -> String {
    let mut edits: Vec<_> = mutation.iter().collect();
    edits.sort_by_key(|(span, _)| *span);
    let mut text = String::with_capacity(source.len() + 100);
    let mut at = 0;
    for (span, replacement) in edits {
        text.push_str(&source[at..span.start]);
        text.push_str(replacement);
        at = span.end;
    }
    text + &source[at..]
}

fn described(source: &str, mutation: &Mutation) -> String {
    let Some((span, replacement)) = mutation.first() else { return String::new() };
    let place = crate::finding::Place::of(source, span.start);
    format!("{place}: `{}` becomes `{replacement}`", &source[span.start..span.end])
}

/// The table as text.
pub fn table(rows: &[Row]) -> String {
    let line = |name: &str, counts: [usize; 3], rules: &str| {
        format!("{name:<40} {:>8} {:>7} {:>7}  {rules}\n", counts[0], counts[1], counts[2])
    };
    let sum = |name: &str, rows: &[&Row]| {
        let sum = |count: fn(&Row) -> usize| rows.iter().map(|row| count(row)).sum::<usize>();
        line(name, [sum(|r| r.possible), sum(|r| r.seeded), sum(|r| r.caught)], "")
    };
    let mut text =
        format!("{:<40} {:>8} {:>7} {:>7}  found first as\n", "fault", "possible", "seeded", "caught");
    let (published, own): (Vec<&Row>, Vec<&Row>) = rows.iter().partition(|r| PUBLISHED.contains(&r.name));
    for (title, rows) in [("published", published), ("other rules", own)] {
        for row in &rows {
            let rules: Vec<_> = row.rules.iter().copied().collect();
            text += &line(row.name, [row.possible, row.seeded, row.caught], &rules.join(" "));
            row.missed.iter().for_each(|missed| text += &format!("    missed: {missed}\n"));
        }
        text += &sum(&format!("all {}: {title}", rows.len()), &rows);
    }
    text
}
