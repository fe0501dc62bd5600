//! How many of what a line makes in equal times.

use runtime_sim::carrier::Carrier;
use runtime_sim::event::{Event, OrderChange};
use serde_json::{Value, json};

/// Lengths of steps, s.
const SPANS_S: [u64; 15] = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400];
/// Steps of a chart: about as many as there are times, within these.
const FEWEST: u64 = 6;
const MOST: u64 = 36;

/// Orders that were made; without one the items that came into sinks. `end_ms` is the end of the run.
pub fn throughput(events: &[Event], scan_ms: u64, end_ms: u64) -> Value {
    let scans = |wanted: fn(&Event) -> Option<u64>| -> Vec<u64> {
        events.iter().filter_map(wanted).map(|scan| scan * scan_ms).collect()
    };
    let made = scans(|event| match event {
        Event::Order { scan, change: OrderChange::Made, .. } => Some(*scan),
        _ => None,
    });
    let (what, times) = match made.is_empty() {
        false => ("orders made", made),
        true => {
            let collected = scans(|event| match event {
                Event::Item { scan, to: Carrier::Sink { .. }, .. } => Some(*scan),
                _ => None,
            });
            ("items collected", collected)
        }
    };
    let span_ms = span_ms(times.len() as u64, end_ms);
    let steps: Vec<_> = steps(&times, span_ms, end_ms);
    json!({ "what": what, "count": times.len(), "span_ms": span_ms, "steps": steps })
}

fn span_ms(count: u64, end_ms: u64) -> u64 {
    let wanted = count.clamp(FEWEST, MOST);
    let fits = |span_ms: &u64| end_ms <= wanted * span_ms;
    let spans = SPANS_S.map(|s| s * 1000);
    spans.into_iter().find(fits).unwrap_or(spans[spans.len() - 1])
}

/// Begin, end and number of each step. What is left behind the last whole step belongs to it: the rate of a short rest
/// would say little, and the run often ends with what it counts.
fn steps(times: &[u64], span_ms: u64, end_ms: u64) -> Vec<[u64; 3]> {
    let whole = (end_ms / span_ms).max(1);
    let mut steps: Vec<[u64; 3]> = (0..whole).map(|i| [i * span_ms, (i + 1) * span_ms, 0]).collect();
    if let Some(last) = steps.last_mut() {
        last[1] = end_ms;
    }
    for ms in times {
        steps[(ms / span_ms).min(whole - 1) as usize][2] += 1;
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::{span_ms, steps};

    #[test]
    fn steps_fill_the_run_and_a_short_rest_belongs_to_the_last() {
        let found = steps(&[1000, 9_999, 10_000, 24_900, 25_000], 10_000, 25_000);
        assert_eq!(found, [[0, 10_000, 2], [10_000, 25_000, 3]]);
        assert_eq!(steps(&[3000], 10_000, 3000), [[0, 3000, 1]]);
        assert_eq!(steps(&[20_000], 10_000, 20_000), [[0, 10_000, 0], [10_000, 20_000, 1]]);
    }

    #[test]
    fn there_are_as_many_steps_as_there_is_to_count() {
        assert_eq!(span_ms(3, 60_000), 10_000);
        assert_eq!(span_ms(3, 61_000), 15_000);
        assert_eq!(span_ms(1000, 60_000), 2000);
        assert_eq!(span_ms(1, 1_000_000_000), 14_400_000);
    }
}
