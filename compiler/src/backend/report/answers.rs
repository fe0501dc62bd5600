//! When commands ended in an error, by what the controller latched.

use runtime_sim::history::Word;

/// Words of one machine.
pub struct Head<'a> {
    pub cmd: &'a Word,
    pub ack: &'a Word,
    pub error: &'a Word,
}

/// Scans and errors. Two commands in a row may end in the same error, so not only changes of the error count.
pub fn errors(head: &Head) -> Vec<(u64, i32)> {
    let mut scans: Vec<u64> = [head.ack, head.error].into_iter().flat_map(changes).collect();
    scans.sort_unstable();
    scans.dedup();
    let mut told = None;
    let mut errors = Vec::new();
    for scan in scans {
        let before = scan.checked_sub(1);
        let sent = head.cmd.changes.partition_point(|(sent, _)| *sent < scan);
        let asked = before.and_then(|before| head.cmd.at(before)).unwrap_or(0.0);
        let error = head.error.at(scan).unwrap_or(0.0);
        let changed = |word: &Word| before.and_then(|before| word.at(before)) != word.at(scan);
        let is_answer = changed(head.ack) && head.ack.at(scan) == Some(asked) && told != Some(sent);
        if error != 0.0 && (is_answer || changed(head.error)) {
            errors.push((scan, error as i32));
        }
        if is_answer || error != 0.0 && changed(head.error) {
            told = Some(sent);
        }
    }
    errors
}

fn changes(word: &Word) -> impl Iterator<Item = u64> {
    word.changes.iter().map(|(scan, _)| *scan)
}

#[cfg(test)]
mod tests {
    use super::{Head, errors};
    use runtime_sim::history::Word;
    use runtime_sim::io_trace::Source;

    fn of(cmd: &[(u64, f64)], ack: &[(u64, f64)], error: &[(u64, f64)]) -> Vec<(u64, i32)> {
        let word = |changes: &[(u64, f64)]| Word { source: Source::Start, changes: changes.to_vec() };
        errors(&Head { cmd: &word(cmd), ack: &word(ack), error: &word(error) })
    }

    #[test]
    fn each_command_that_ends_in_an_error_counts() {
        let cmd = [(0, 0.0), (5, 1.0), (9, 2.0), (12, 3.0)];
        let ack = [(0, 0.0), (8, 1.0), (11, 2.0), (20, 3.0)];
        assert_eq!(of(&cmd, &ack, &[(0, 0.0), (8, 3.0), (20, 0.0)]), [(8, 3), (11, 3)]);
        assert_eq!(of(&cmd, &ack, &[(0, 0.0), (8, 3.0), (11, 2.0)]), [(8, 3), (11, 2), (20, 2)]);
        assert!(of(&cmd, &ack, &[(0, 0.0)]).is_empty());
    }

    #[test]
    fn a_number_that_is_read_again_is_no_answer() {
        // The input sticks at 0 for a time.
        let ack = [(0, 0.0), (8, 1.0), (15, 0.0), (18, 1.0)];
        assert_eq!(of(&[(0, 0.0), (5, 1.0)], &ack, &[(0, 0.0), (8, 3.0)]), [(8, 3)]);
    }
}
