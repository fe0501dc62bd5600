//! What the last build into a folder, or a run, has left there and this one has not.

/// What each of them puts into the files.
const OPTIONS: [(&str, &str); 3] = [
    ("--io", "the addresses of the PLC"),
    ("--texts", "texts in other languages"),
    ("--drives", "reference blocks for drives"),
];

/// What is gone, by two commands that built the same folder.
pub fn notes(last: &str, now: &str) -> Vec<String> {
    let has = |command: &str, option: &str| command.split_whitespace().any(|word| word == option);
    let dropped = OPTIONS.iter().filter(|(option, _)| has(last, option) && !has(now, option));
    dropped
        .map(|(option, what)| format!("without `{option}`, {what} are no longer there: `{last}` wrote them"))
        .collect()
}

/// What of an earlier run was there and is no more.
pub fn of_a_run(before: &[&str], after: &[&str]) -> Option<String> {
    let gone: Vec<&str> = before.iter().filter(|name| !after.contains(name)).copied().collect();
    let belongs = match gone[..] {
        [] => return None,
        [_] => "was removed: it does",
        _ => "were removed: they do",
    };
    Some(format!("{} of an earlier run {belongs} not belong to what the folder has now", gone.join(" and ")))
}

#[cfg(test)]
mod tests {
    use super::notes;

    #[test]
    fn what_is_gone_is_said() {
        let with = "autogen build cell.json --io io.csv --addresses words";
        let note =
            format!("without `--io`, the addresses of the PLC are no longer there: `{with}` wrote them");
        assert_eq!(notes(with, "autogen build cell.json --drives"), [note]);
        assert!(notes(with, "autogen build cell.json --io other.csv").is_empty());
        assert!(notes("autogen build cell.json", with).is_empty());
    }
}
