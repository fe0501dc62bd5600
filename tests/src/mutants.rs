//! Mistakes that somebody could make in a specification, made one at a time.

/// A specification with one mistake.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// Such as `line 31: without `offer := false``.
    pub what: String,
    pub text: String,
}

/// Every mutant of a text: of each transition on one line an update dropped, or moved to the next transition of the same
/// state, the transition dropped, its guard negated, a conjunct of it dropped.
pub fn mutants(text: &str) -> Vec<Mutant> {
    let lines: Vec<&str> = text.lines().collect();
    let mut all = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let mut add = |what: String, changed: String| all.push(mutant(&lines, number, what, changed));
        let without = without_an_update(line);
        for (update, changed) in &without {
            add(format!("without `{update}`"), changed.clone());
        }
        all.extend(
            without.into_iter().filter_map(|(update, changed)| moved(&lines, number, &update, changed)),
        );
        let mut add = |what: String, changed: String| all.push(mutant(&lines, number, what, changed));
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

fn mutant(lines: &[&str], number: usize, what: String, changed: String) -> Mutant {
    let mut lines = lines.to_vec();
    lines[number] = &changed;
    Mutant { what: format!("line {}: {what}", number + 1), text: lines.join("\n") }
}

/// With an update moved to the next transition of the same state, if that is on one line.
fn moved(lines: &[&str], from: usize, update: &str, without: String) -> Option<Mutant> {
    let next = (from + 1..lines.len()).find(|line| !lines[*line].trim().starts_with("//"))?;
    let is_transition = |line: &str| line.trim().starts_with("when ") && line.trim_end().ends_with('}');
    if !is_transition(lines[from]) || !is_transition(lines[next]) {
        return None;
    }
    let (head, _) = lines[next].trim_end().rsplit_once('}')?;
    let with = format!("{} {update} }}", head.trim_end());
    let mut lines = lines.to_vec();
    (lines[from], lines[next]) = (&without, &with);
    let what = format!("line {}: `{update}` moved to line {}", from + 1, next + 1);
    Some(Mutant { what, text: lines.join("\n") })
}

/// The line without one of the updates in its braces, and which.
fn without_an_update(line: &str) -> Vec<(String, String)> {
    let Some((begin, end)) = line.find("{ ").zip(line.rfind('}')) else { return Vec::new() };
    let Some(inner) = line.get(begin + 2..end).filter(|inner| inner.contains(';')) else { return Vec::new() };
    let updates: Vec<&str> = inner.split_inclusive(';').filter(|update| !update.trim().is_empty()).collect();
    let without = |dropped: usize| {
        let kept = updates.iter().enumerate().filter(|(number, _)| *number != dropped);
        let kept: String = kept.map(|(_, update)| *update).collect();
        let changed = format!("{}{{ {} }}{}", &line[..begin], kept.trim(), &line[end + 1..]);
        (updates[dropped].trim().to_string(), changed)
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
