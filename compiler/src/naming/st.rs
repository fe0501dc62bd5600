//! Identifiers of Structured Text. Case does not count; no underscore stands at an end or beside another one.

use super::reserved::{is_reserved, keyword_inside};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Longest identifier; old tools take no longer ones.
const LONGEST: usize = 32;

/// A name that could not stay as the specification has it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Renamed {
    /// As the specification has it: `at.x` is a coordinate of `at`, `at_x` has that name itself.
    pub wanted: String,
    pub name: String,
    pub reason: &'static str,
}

/// Names that stand side by side, all different even if case is ignored.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    /// Of the scopes outside, in lower case.
    outer: Vec<Arc<HashSet<String>>>,
    /// In lower case.
    taken: Arc<HashSet<String>>,
    /// The first number that has not been tried yet: all that were are taken.
    next: HashMap<Tried, u32>,
    renamed: Vec<Renamed>,
}

/// Numbers with so many digits, behind the same beginning, before the same suffixes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Tried {
    /// In lower case.
    beginning: String,
    digits: usize,
    suffixes: String,
}

impl Scope {
    pub fn new(taken: &[&str]) -> Self {
        let taken = taken.iter().map(|name| name.to_ascii_lowercase()).collect();
        Self { taken: Arc::new(taken), ..Self::default() }
    }

    /// A scope inside this one: no name of this one is given again.
    pub fn inner(&self) -> Self {
        let outer = self.outer.iter().chain([&self.taken]).cloned().collect();
        Self { outer, ..Self::default() }
    }

    fn is_taken(&self, name: &str) -> bool {
        self.taken.contains(name) || self.outer.iter().any(|outer| outer.contains(name))
    }

    pub fn take(&mut self, wanted: &str) -> String {
        self.take_all(wanted, &[""]).concat()
    }

    /// One identifier for each suffix, with the same beginning: the wanted one, with `_v` in a keyword that some
    /// compiler finds inside of words, cut if it is too long, with `_v` behind it if it is reserved, with a number
    /// behind it if it was given away before.
    pub fn take_all(&mut self, wanted: &str, suffixes: &[&str]) -> Vec<String> {
        let longest = LONGEST - suffixes.iter().map(|s| s.len()).max().unwrap_or(0);
        let mut stem = plain(wanted);
        let mut reason = match wanted.trim_start_matches('_').starts_with(|c: char| c.is_ascii_alphabetic()) {
            true if stem == wanted => "",
            true => "an underscore at an end or beside another one",
            false => "no letter at the beginning",
        };
        while let Some(at) = keyword_inside(&stem) {
            stem.insert_str(at, "_v");
            reason = "a keyword within the name";
        }
        if stem.len() > longest {
            stem = cut(&stem, longest);
            reason = "longer than 32 characters";
        }
        if suffixes.iter().any(|suffix| is_reserved(&format!("{stem}{suffix}"))) {
            stem = format!("{}_v", cut(&stem, longest - 2));
            reason = "reserved word";
        }
        if !self.is_free(&stem, suffixes) {
            stem = self.numbered(&stem, suffixes, longest);
            reason = "name already used; case does not count";
        }
        suffixes
            .iter()
            .map(|suffix| {
                Arc::make_mut(&mut self.taken).insert(lower(&stem, suffix));
                let name = format!("{stem}{suffix}");
                if !reason.is_empty() {
                    self.renamed.push(Renamed {
                        wanted: of_specification(wanted, suffix),
                        name: name.clone(),
                        reason,
                    });
                }
                name
            })
            .collect()
    }

    fn is_free(&self, stem: &str, suffixes: &[&str]) -> bool {
        suffixes.iter().all(|suffix| !self.is_taken(&lower(stem, suffix)))
    }

    /// With the first number behind it that is free.
    fn numbered(&mut self, stem: &str, suffixes: &[&str], longest: usize) -> String {
        let mut number = 2;
        loop {
            let tail = format!("_{number}");
            let beginning = cut(stem, longest - tail.len());
            let tried = Tried {
                beginning: beginning.to_ascii_lowercase(),
                digits: tail.len(),
                suffixes: suffixes.concat(),
            };
            let next = self.next.entry(tried).or_insert(number);
            if *next > number {
                number = *next;
                continue;
            }
            number += 1;
            *next = number;
            let found = beginning + &tail;
            if self.is_free(&found, suffixes) {
                return found;
            }
        }
    }

    /// The identifier of a value as a whole, whose parts have this beginning.
    pub fn take_whole(&mut self, wanted: &str, beginning: &str) -> String {
        let known = self.renamed.len();
        let name = self.take(beginning);
        let reason = self.renamed.get(known).map(|renamed| renamed.reason);
        self.renamed.truncate(known);
        if name != wanted {
            let reason = reason.unwrap_or("as its parts");
            self.renamed.push(Renamed { wanted: wanted.into(), name: name.clone(), reason });
        }
        name
    }

    pub fn renamed(&self) -> &[Renamed] {
        &self.renamed
    }
}

fn lower(stem: &str, suffix: &str) -> String {
    let mut name = [stem, suffix].concat();
    name.make_ascii_lowercase();
    name
}

fn of_specification(wanted: &str, suffix: &str) -> String {
    match suffix {
        "_x" | "_y" | "_z" => format!("{wanted}.{}", &suffix[1..]),
        "_count" => format!("count({wanted})"),
        _ => format!("{wanted}{suffix}"),
    }
}

/// Without underscores at the ends or beside each other; with `n` in front if no letter is left there.
fn plain(name: &str) -> String {
    let parts: Vec<&str> = name.split('_').filter(|part| !part.is_empty()).collect();
    let is_begun = parts.first().is_some_and(|part| part.starts_with(|c: char| c.is_ascii_alphabetic()));
    (if is_begun { None } else { Some("n") }).into_iter().chain(parts).collect::<Vec<_>>().join("_")
}

fn cut(name: &str, longest: usize) -> String {
    plain(&name.chars().take(longest).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_renamed_by_rule() {
        let mut scope = Scope::new(&["state"]);
        let given: Vec<_> = ["step", "State", "x", "X", "a__b_"].map(|n| scope.take(n)).into();
        assert_eq!(given, ["step_v", "State_2", "x", "X_2", "a_b"]);
        let long = "a_name_that_is_longer_than_old_tools_take";
        assert_eq!(scope.take(long), "a_name_that_is_longer_than_old_t");
        assert_eq!(
            scope.take_all(long, &["_x", "_y"]),
            ["a_name_that_is_longer_than_old_x", "a_name_that_is_longer_than_old_y"]
        );
        assert_eq!(scope.take(long), "a_name_that_is_longer_than_old_2");
        assert_eq!(scope.take_all("at", &["_x", "_y", "_z"]), ["at_x", "at_y", "at_z"]);
        assert_eq!(scope.take("at_x"), "at_x_2");
        assert_eq!(scope.take_all("at", &["_x", "_y", "_z"]), ["at_2_x", "at_2_y", "at_2_z"]);
        let wanted: Vec<_> = scope.renamed().iter().rev().take(4).map(|r| r.wanted.as_str()).collect();
        assert_eq!(wanted, ["at.z", "at.y", "at.x", "at_x"]);
        let given: Vec<_> = ["max_time", "Dint_to_LReal", "nan", "max_speed"].map(|n| scope.take(n)).into();
        assert_eq!(given, ["max_time_v", "Dint_to_LReal_v", "nan_v", "max_speed"]);
        let given: Vec<_> = ["s", "R", "to_int", "char_to", "stop_to"].map(|n| scope.take(n)).into();
        assert_eq!(given, ["s_v", "R_v", "to_int_v", "char_to_v", "stop_to"]);
        let given: Vec<_> =
            ["blend_Program", "bend_function_end_action", "initial_steps"].map(|n| scope.take(n)).into();
        assert_eq!(given, ["blend_v_Program", "bend_v_function_end_v_action", "initial_v_steps"]);
        let given: Vec<_> = ["_24v_ok", "_1st", "_ok_", "___", "__"].map(|n| scope.take(n)).into();
        assert_eq!(given, ["n_24v_ok", "n_1st", "ok", "n", "n_2"]);
        assert_eq!(scope.take_all("_1", &["_x", "_y"]), ["n_1_x", "n_1_y"]);
        assert_eq!(scope.renamed().last().map(|r| r.reason), Some("no letter at the beginning"));
    }

    /// Names that begin alike are told apart by numbers, and a number is tried once: 100,000 names in a moment.
    #[test]
    fn many_long_names_that_begin_alike_are_different() {
        let mut scope = Scope::new(&[]);
        let mut all = HashSet::new();
        for machine in 0..50_000 {
            let given =
                scope.take_all(&format!("packing_hall_robot_cell_number_{machine:06}_at"), &["_x", "_y"]);
            assert!(given.iter().all(|name| name.len() <= LONGEST));
            all.extend(given.iter().map(|name| name.to_ascii_lowercase()));
        }
        assert_eq!(all.len(), 100_000);
        assert!(all.contains("packing_hall_robot_cell_50000_x"), "{:?}", all.iter().max());
    }

    #[test]
    fn names_outside_are_taken_inside_and_no_others() {
        let mut outer = Scope::new(&["x"]);
        outer.take("y");
        let mut middle = outer.inner();
        middle.take("m");
        let mut inner = middle.inner();
        let given: Vec<_> = ["X", "y", "m", "z"].map(|name| inner.take(name)).into();
        assert_eq!(given, ["X_2", "y_2", "m_2", "z"]);
        assert_eq!(outer.take("z"), "z");
        // What is named outside later is no name of the scope that it was inside of.
        outer.take("late");
        assert_eq!(inner.take("late"), "late");
    }
}
