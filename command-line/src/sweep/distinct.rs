//! What is varied has to differ: no two points are the same run, and no two have a replication in common.

use super::axis::Axis;
use super::plan::{Line, Refusal};
use autogen::layout::json::{Json, Value};
use autogen::lower::Setting;
use runtime_sim::line::IoDelay;
use std::fmt::Display;

/// Where the first stands that is the same as one before.
pub fn twice<T>(list: &[T], same: impl Fn(&T, &T) -> bool) -> Option<usize> {
    (1..list.len()).find(|i| list[..*i].iter().any(|before| same(before, &list[*i])))
}

/// Refuses a list with two values that mean the same; `written` are the values as they were given.
pub fn once<T>(
    option: &str,
    written: &[impl Display],
    values: &[T],
    same: impl Fn(&T, &T) -> bool,
) -> Result<(), Refusal> {
    match twice(values, same) {
        Some(i) => Err(Refusal::Said(format!(
            "{option}: {} stands twice, or means the same as another value; give it once",
            written[i]
        ))),
        None => Ok(()),
    }
}

/// Whether two settings of the same name are one.
pub fn same_setting(a: &Setting, b: &Setting) -> bool {
    same(&a.value, &b.value)
}

fn same(a: &Json, b: &Json) -> bool {
    match (&a.value, &b.value) {
        (Value::List(a), Value::List(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b)),
        (Value::Object(a), Value::Object(b)) => {
            let has = |key: &str, value: &Json| b.iter().any(|b| b.key.value == key && same(value, &b.value));
            a.len() == b.len() && a.iter().all(|a| has(&a.key.value, &a.value))
        }
        (a, b) => a == b,
    }
}

/// Replications of a point take the seeds that follow its own. Were one of them that of another point, both would be
/// the same run. After the greatest number seeds go on with 0.
pub fn seeds_are_apart(
    axes: &[Axis],
    lines: &[Line],
    delays: &[IoDelay],
    replications: u32,
) -> Result<(), Refusal> {
    for (number, axis) in axes.iter().enumerate() {
        let is_of_supply = |line: &Line| {
            line.settings[number].first().is_some_and(|setting| line.draft.is_of_supply(setting))
        };
        let Some(line) = lines.iter().find(|line| is_of_supply(line)) else { continue };
        let seeds = line.settings[number].iter().filter_map(|setting| match setting.value.value {
            // The draft says what is wrong with another number.
            Value::Number(seed) if seed >= 0.0 && seed.fract() == 0.0 => Some(seed as u64),
            _ => None,
        });
        are_apart(&format!("--set {}", axis.name), seeds.collect(), u64::from(u32::MAX), replications)?;
    }
    let seeds = delays.iter().filter_map(|delay| match delay {
        IoDelay::Random { seed, .. } => Some(*seed),
        IoDelay::Fixed(_) => None,
    });
    are_apart("--io-delay", seeds.collect(), u64::MAX, replications)
}

/// `greatest` is the last seed; the first one follows it.
fn are_apart(option: &str, mut seeds: Vec<u64>, greatest: u64, replications: u32) -> Result<(), Refusal> {
    seeds.sort_unstable();
    let following = seeds.iter().cycle().skip(1);
    let mut pairs = seeds.iter().zip(following).filter(|_| seeds.len() > 1);
    match pairs.find(|(seed, next)| next.wrapping_sub(**seed) & greatest < u64::from(replications)) {
        Some((seed, next)) => Err(Refusal::Said(format!(
            "{option}: the seeds {seed} and {next} are less than {replications} apart, so that with {replications} \
             replications both points would have some runs in common; take seeds that are farther apart, or no list of \
             them"
        ))),
        None => Ok(()),
    }
}
