//! Mistakes that somebody could make in a specification, made one at a time.

/// A specification with one mistake.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// Such as `line 31: without `offer := false``.
    pub what: String,
    pub text: String,
}

/// Every mutant of a text: of each transition on one line an update dropped, the transition dropped, its guard negated, a
/// conjunct of it dropped.
pub fn mutants(text: &str) -> Vec<Mutant> {
    let lines: Vec<&str> = text.lines().collect();
    let mut all = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let mut add = |what: String, changed: String| {
            let mut lines = lines.clone();
            lines[number] = &changed;
            all.push(Mutant { what: format!("line {}: {what}", number + 1), text: lines.join("\n") });
        };
        for (what, changed) in without_an_update(line) {
            add(what, changed);
        }
        let Some((before, rest)) = line.split_once("when ") else { continue };
        let Some(end) = rest.find(" -> ").or_else(|| rest.find(" { ")) else { continue };
        let (guard, after) = rest.split_at(end);
        if !before.trim().is_empty() || !line.trim_end().ends_with('}') {
            continue;
        }
        add(format!("without `when {guard}`"), String::new());
        if !guard.contains(',') && !guard.contains("first ") {
            add(format!("`{guard}` negated"), format!("{before}when not ({guard}){after}"));
        }
        for clauses in parts(guard, ", ") {
            add(format!("without a clause of `{guard}`"), format!("{before}when {clauses}{after}"));
        }
        if !guard.contains(',') && !guard.contains(':') {
            for conjuncts in parts(guard, " and ") {
                add(format!("`{conjuncts}` for `{guard}`"), format!("{before}when {conjuncts}{after}"));
            }
        }
    }
    all
}

/// The line without one of the updates in its braces.
fn without_an_update(line: &str) -> Vec<(String, String)> {
    let Some((begin, end)) = line.find("{ ").zip(line.rfind('}')) else { return Vec::new() };
    let Some(inner) = line.get(begin + 2..end).filter(|inner| inner.contains(';')) else { return Vec::new() };
    let updates: Vec<&str> = inner.split_inclusive(';').filter(|update| !update.trim().is_empty()).collect();
    let without = |dropped: usize| {
        let kept = updates.iter().enumerate().filter(|(number, _)| *number != dropped);
        let kept: String = kept.map(|(_, update)| *update).collect();
        let changed = format!("{}{{ {} }}{}", &line[..begin], kept.trim(), &line[end + 1..]);
        (format!("without `{}`", updates[dropped].trim()), changed)
    };
    (0..updates.len()).map(without).collect()
}

/// A text of several parts without one of them.
fn parts(text: &str, between: &str) -> Vec<String> {
    let all: Vec<&str> = text.split(between).collect();
    if all.len() < 2 {
        return Vec::new();
    }
    let without = |dropped: usize| {
        let kept = all.iter().enumerate().filter(|(number, _)| *number != dropped);
        kept.map(|(_, part)| *part).collect::<Vec<_>>().join(between)
    };
    (0..all.len()).map(without).collect()
}
