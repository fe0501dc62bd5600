//! Paths as a table of places.

use super::Path;
use crate::item;
use crate::line::Line;
use crate::report::carrier_text;
use std::fmt::Write;

/// The first row.
pub const HEAD: &str = "item,kind,t,x,y,z,carrier";

/// The paths of some items as comma-separated values, item by item: at every whole multiple of `every_ms`, and
/// where a segment begins or ends. Seconds and metres, rounded to millionths. Where an item changes its carrier
/// there are two rows of the same time. `paths` are those of all items.
pub fn table_csv(line: &Line, paths: &[Path], items: &[usize], every_ms: u64) -> String {
    let mut text = format!("{HEAD}\n");
    let names = item::Names::new(line).all();
    let kinds: Vec<usize> = line.scenario.supply.iter().flat_map(|s| s.items.iter().copied()).collect();
    for &item in items {
        let name = &names[item];
        let mut last = String::new();
        for segment in &paths[item].segments {
            let carrier = carrier_text(line, segment.carrier);
            for ms in times(segment.begin_ms, segment.end_ms, every_ms) {
                let place = segment.place(ms);
                let kind = &line.kinds[paths[item].kind_at(ms, kinds[item])].name;
                let [t, x, y, z] = [ms / 1000.0, place.x, place.y, place.z].map(millionths);
                let row = format!("{name},{kind},{t},{x},{y},{z},{carrier}\n");
                if row != last {
                    text += &row;
                    last = row;
                }
            }
        }
    }
    text
}

/// Both ends and the multiples of `every_ms` between them.
fn times(begin_ms: f64, end_ms: f64, every_ms: u64) -> impl Iterator<Item = f64> {
    let every = every_ms.max(1) as f64;
    let first = (begin_ms / every).floor() as u64 + 1;
    let within = (first..).map(move |n| n as f64 * every).take_while(move |ms| *ms < end_ms);
    std::iter::once(begin_ms).chain(within).chain(std::iter::once(end_ms))
}

/// A number with six digits after the point, without a minus before zero.
fn millionths(value: f64) -> String {
    let mut text = String::new();
    let _ = write!(text, "{value:.6}");
    if text == "-0.000000" { "0.000000".into() } else { text }
}
