//! Faults that are seeded into a text, to prove that the judge finds them.

mod declaration;
mod expression;
mod statement;
mod survey;
mod written;

use crate::check::Checked;
use crate::finding::Span;
use runtime_sim::random::Random;
use survey::Survey;

/// A kind of fault.
pub struct Fault {
    pub name: &'static str,
    /// Every way to bring it into a text that has none.
    mutations: fn(&Survey) -> Vec<Mutation>,
}

/// Replacements that do not overlap, in any order.
pub(crate) type Mutation = Vec<(Span, String)>;

/// What became of one kind of fault.
#[derive(Clone, Debug)]
pub struct Row {
    pub name: &'static str,
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
    let mut faults = Vec::new();
    for list in lists {
        faults.extend(list.iter().map(|&(name, mutations)| Fault { name, mutations }));
    }
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
            let mut row =
                Row { name: fault.name, possible, seeded: mutations.len(), caught: 0, missed: vec![] };
            for mutation in &mutations {
                match crate::judge(&applied(source, mutation)) {
                    Err(_) => row.caught += 1,
                    Ok(_) => row.missed.push(described(source, mutation)),
                }
            }
            row
        })
        .collect()
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
    let mut text = format!("{:<44} {:>8} {:>7} {:>7}\n", "fault", "possible", "seeded", "caught");
    for row in rows {
        text += &format!("{:<44} {:>8} {:>7} {:>7}\n", row.name, row.possible, row.seeded, row.caught);
        for missed in &row.missed {
            text += &format!("    missed: {missed}\n");
        }
    }
    let sum = |count: fn(&Row) -> usize| rows.iter().map(count).sum::<usize>();
    text + &format!(
        "{:<44} {:>8} {:>7} {:>7}\n",
        "all",
        sum(|r| r.possible),
        sum(|r| r.seeded),
        sum(|r| r.caught)
    )
}
