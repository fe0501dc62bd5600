//! Paths as JSON, exact.

use super::{Law, Path, Segment};
use crate::item;
use crate::json::Json;
use crate::line::Line;
use crate::motion::Piece;
use crate::plant::conveyed::{Along, Carry};
use crate::point::Point;
use crate::report::carrier_text;

/// Of this text and its version.
pub const FORMAT: &str = "autogen trajectories 1";

/// The segments of some items as one JSON object. All numbers read back to the same bits. `paths` are those
/// of all items.
pub fn segments_json(line: &Line, paths: &[Path], items: &[usize]) -> String {
    let names = item::Names::new(line).all();
    let kinds: Vec<usize> = line.scenario.supply.iter().flat_map(|s| s.items.iter().copied()).collect();
    Json::object(|json| {
        json.put_text("format", FORMAT);
        json.put_list("items", items, |json, &item| {
            json.put_text("item", &names[item]);
            json.put_text("kind", &line.kinds[kinds[item]].name);
            if !paths[item].becomes.is_empty() {
                json.put_list("becomes", &paths[item].becomes, |json, (at_ms, kind)| {
                    json.put_real("at_s", Some(at_ms / 1000.0));
                    json.put_text("kind", &line.kinds[*kind].name);
                });
            }
            json.put_list("segments", &paths[item].segments, |json, segment| put(json, line, segment));
        });
    })
}

fn put(json: &mut Json, line: &Line, segment: &Segment) {
    json.put_real("begin_s", Some(segment.begin_ms / 1000.0));
    json.put_real("end_s", Some(segment.end_ms / 1000.0));
    json.put_text("carrier", &carrier_text(line, segment.carrier));
    put_point(json, "from", segment.place(segment.begin_ms));
    put_point(json, "to", segment.place(segment.end_ms));
    match &segment.law {
        Law::Rests(_) => json.put_text("law", "rests"),
        Law::Slides { velocity, acceleration, .. } => {
            json.put_text("law", "slides");
            put_point(json, "velocity", *velocity);
            if *acceleration != Point::default() {
                put_point(json, "acceleration", *acceleration);
            }
        }
        Law::Conveyed(conveyed) => {
            match conveyed.along() {
                Along::Straight(velocity) => {
                    json.put_text("law", "slides");
                    put_point(json, "velocity", velocity);
                }
                Along::Arc { middle, rate, climb } => {
                    json.put_text("law", "turns");
                    put_point(json, "middle", middle);
                    json.put_real("rate", Some(rate));
                    json.put_real("climb", Some(climb));
                }
            }
            match conveyed.carry() {
                None => {}
                Some(Carry::Slides(velocity)) => put_point(json, "carried", velocity),
                Some(Carry::Turns { pivot, rate }) => {
                    put_point(json, "pivot", pivot);
                    json.put_real("pivot_rate", Some(rate));
                }
            }
        }
        Law::Hangs(hanging) => {
            json.put_text("law", "hangs");
            put_point(json, "hang", hanging.hang);
            let pieces = hanging.motion.pieces();
            let within = |piece: &&Piece| {
                piece.end_s * 1000.0 > segment.begin_ms && piece.begin_s * 1000.0 < segment.end_ms
            };
            let pieces: Vec<&Piece> = pieces.iter().filter(within).collect();
            json.put_list("pieces", &pieces, |json, piece| {
                json.put_real("begin_s", Some(piece.begin_s));
                json.put_real("end_s", Some(piece.end_s));
                json.put_rows("joints", &piece.joints);
            });
        }
    }
}

fn put_point(json: &mut Json, key: &str, point: Point) {
    json.put_reals(key, &[point.x, point.y, point.z]);
}
