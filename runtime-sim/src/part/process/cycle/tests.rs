use super::*;
use crate::part::Described;
use crate::part::settings::Settings;
use crate::value::Value;

const CYCLES: u32 = 100_000;

fn words(words: &[&str]) -> Value {
    Value::List(words.iter().map(|word| Value::Word(word.to_string())).collect())
}

fn numbers(numbers: &[f64]) -> Value {
    Value::List(numbers.iter().map(|number| Value::Number(*number)).collect())
}

fn word(word: &str) -> Value {
    Value::Word(word.into())
}

fn process(settings: Vec<(&'static str, Value)>) -> Result<Process, String> {
    let on = ("on", Value::Part { part: 0, frame: 0 });
    Process::new(&Settings::new([vec![on], settings].concat()))
}

fn kind(name: &str) -> Kind {
    Kind {
        name: name.into(),
        height: 0.05,
        grasp: 0.05,
        size: [0.1, 0.1],
        is: Vec::new(),
        mass: 0.1,
        deck: None,
    }
}

fn cycle(settings: Vec<(&'static str, Value)>, place: [u64; 2]) -> Cycle {
    let kinds = ["blank", "bracket", "scrap", "rework"].map(kind);
    Cycle::new(&process(settings).expect("settings"), &kinds, 7, place)
}

/// What comes of so many cycles.
fn each<T>(mut cycle: Cycle, read: impl Fn(&Cycle) -> T) -> Vec<T> {
    let next = |number: u32| {
        cycle.started = number;
        read(&cycle)
    };
    (1..=CYCLES).map(next).collect()
}

fn triangle() -> Vec<(&'static str, Value)> {
    let time = |ms: f64| Value::Number(ms);
    vec![("time", time(90_000.0)), ("shortest", time(85_000.0)), ("longest", time(100_000.0))]
}

fn rejecting() -> Vec<(&'static str, Value)> {
    let rejects = words(&["blank", "scrap", "blank", "rework", "bracket", "scrap"]);
    let shares = numbers(&[0.02, 0.05, 0.5]);
    vec![("makes", words(&["blank", "bracket"])), ("rejects", rejects), ("shares", shares)]
}

#[test]
fn a_share_of_the_items_becomes_another_kind() {
    let made = each(cycle([triangle(), rejecting()].concat(), [1, 2]), |cycle| cycle.made_of(0, 0));
    for (kind, share) in [(0, 0.0), (1, 0.93), (2, 0.02), (3, 0.05)] {
        let found = made.iter().filter(|made| **made == kind).count() as f64 / f64::from(CYCLES);
        let noise = 4.0 * (share * (1.0 - share) / f64::from(CYCLES)).sqrt();
        assert!((found - share).abs() <= noise, "{kind}: {found}");
    }
    let all = vec![
        ("time", Value::Number(1.0)),
        ("rejects", words(&["blank", "scrap"])),
        ("shares", numbers(&[1.0])),
    ];
    assert!(each(cycle(all, [1, 2]), |cycle| cycle.made_of(0, 0)).iter().all(|made| *made == 2));
}

/// Whether an item is rejected says nothing of its time, nor of the next item.
#[test]
fn numbers_drawn_for_one_use_are_not_those_of_another() {
    let all = [triangle(), rejecting()].concat();
    let times = |cycle: &Cycle| cycle.time_ms(0);
    let with = each(cycle(all.clone(), [1, 2]), times);
    assert_eq!(with, each(cycle(triangle(), [1, 2]), times), "rejects change no time");
    for other in [[1, 3], [2, 2], [2, 1]] {
        let others = each(cycle(triangle(), other), times);
        let same = with.iter().zip(&others).filter(|(one, other)| one == other).count();
        assert!(same < 100, "{same} times of {other:?} are the same");
    }
    // Correlation of numbers without any: within four of its deviations, 1 / sqrt(n).
    let drawn = each(cycle(all.clone(), [1, 2]), |cycle| cycle.drawn(Drawn::Time, 0));
    let rejects = each(cycle(all, [1, 2]), |cycle| cycle.drawn(Drawn::Reject, 0));
    let correlation = |one: &[f64], other: &[f64]| {
        let sum: f64 = one.iter().zip(other).map(|(a, b)| (a - 0.5) * (b - 0.5)).sum();
        sum * 12.0 / f64::from(CYCLES)
    };
    for found in [correlation(&drawn, &rejects), correlation(&drawn, &drawn[1..])] {
        assert!(found.abs() < 4.0 / f64::from(CYCLES).sqrt(), "{found}");
    }
}

/// The same number drawn is the same share of the times of each kind.
#[test]
fn each_kind_has_times_of_its_own() {
    let times = |times: [f64; 2]| numbers(&times);
    let settings = vec![
        ("kinds", words(&["bracket", "blank"])),
        ("distribution", word("uniform")),
        ("shortest", times([1000.0, 20_000.0])),
        ("longest", times([2000.0, 40_000.0])),
    ];
    let cycle = cycle(settings, [1, 2]);
    let found = each(cycle.clone(), |cycle| [0, 1].map(|kind| cycle.time_ms(kind)));
    for [blank, bracket] in found {
        assert!((1000..=2000).contains(&bracket) && (20_000..=40_000).contains(&blank));
        assert!((blank as f64 - 20.0 * bracket as f64).abs() <= 11.0, "{blank} {bracket}");
    }
    assert_eq!(cycle.times, [Some(1), Some(0), None, None]);
    assert_eq!(cycle.process.shortest_ms(), 1000);
}

#[test]
fn a_process_may_take_hours() {
    let cycle = cycle(vec![("time", Value::Number(1e9))], [1, 2]);
    assert_eq!(cycle.time_ms(0), 1_000_000_000);
}

#[test]
fn wrong_settings_are_refused() {
    let ms = Value::Number;
    let uniform = ("distribution", word("uniform"));
    let rejects = |share: &[f64]| {
        let pairs = words(&["blank", "scrap", "blank", "rework"]);
        vec![("time", ms(5.0)), ("rejects", pairs), ("shares", numbers(share))]
    };
    let kinds = ("kinds", words(&["a", "b"]));
    let wrong = [
        (vec![], "a fixed time needs the setting time"),
        (
            vec![("time", ms(0.0))],
            "the setting time is no time over 0 and of at most 1000000 s, in whole milliseconds",
        ),
        (
            vec![("time", ms(1e9 + 1.0))],
            "the setting time is no time over 0 and of at most 1000000 s, in whole milliseconds",
        ),
        (
            vec![("time", ms(5.0)), ("shortest", ms(6.0))],
            "its times are not in order: shortest, time, longest",
        ),
        (
            vec![("time", ms(5.0)), ("longest", ms(4.0))],
            "its times are not in order: shortest, time, longest",
        ),
        (vec![("time", ms(5.0)), ("deviation", ms(4.0))], "a fixed time has no deviation"),
        (vec![uniform.clone(), ("time", ms(5.0))], "a uniform time needs the setting shortest"),
        (
            vec![uniform.clone(), ("time", ms(5.0)), ("shortest", ms(4.0)), ("longest", ms(9.0))],
            "a uniform time has no time",
        ),
        (
            vec![uniform, ("shortest", ms(9.0)), ("longest", ms(4.0))],
            "its times are not in order: shortest, time, longest",
        ),
        (
            vec![("time", ms(5.0)), ("distribution", word("normal"))],
            "a normal time needs the setting deviation",
        ),
        (
            vec![("time", ms(5.0)), ("distribution", word("gamma"))],
            "there is no distribution `gamma`: distributions are fixed, triangular, uniform, normal, exponential",
        ),
        (vec![("time", numbers(&[5.0, 6.0]))], "time has 2 times: name their kinds in `kinds`"),
        (vec![("time", numbers(&[5.0, 6.0, 7.0])), kinds.clone()], "time has 3 times for 2 kinds"),
        (
            vec![("time", numbers(&[])), kinds],
            "time is an empty list: write a time, or one for each of `kinds`",
        ),
        (vec![("time", ms(5.0)), ("kinds", words(&["a", "a"]))], "the setting kinds names a twice"),
        (rejects(&[0.5]), "the setting rejects has 2 pairs, and shares 1 numbers"),
        (rejects(&[0.5, -0.1]), "a share is a number from 0 to 1, not -0.1"),
        (rejects(&[0.5, 0.6]), "the shares of the kind blank are more than 1 together"),
        (
            vec![("time", ms(5.0)), ("makes", words(&["blank"]))],
            "the setting makes names blank without what becomes of it",
        ),
    ];
    for (settings, message) in wrong {
        assert_eq!(process(settings), Err(message.to_string()));
    }
}
