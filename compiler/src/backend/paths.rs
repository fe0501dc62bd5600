//! Paths of items as SVG: from above, and from the side under it.
//!
//! The plan is turned by 270 degrees: y points to the right and x downwards, so that a belt along y lies at the
//! bottom. The side view shares its y and has the height upwards.

mod outline;
mod panel;
mod track;

use super::footprint;
use crate::lower::Project;
use askama::Template;
use panel::{Panel, Tick, View, tenths};
use runtime_sim::line::Line;
use runtime_sim::machine::Machine;
use runtime_sim::part::lane::CentreLine;
use runtime_sim::part::place::Place;
use runtime_sim::point::{Axis, Point};
use track::Track;

/// Every drawing bears this text.
pub const MARK: &str = "<!-- Drawn by autogen";

/// Pixels per metre, unless the drawing would be wider than [`WIDEST`].
const SCALE: f64 = 70.0;
const WIDEST: f64 = 1000.0;
/// Empty border around what the items touch, m.
const BORDER: f64 = 0.4;
/// The side view begins so deep, m.
const UNDER_FLOOR: f64 = 0.1;
/// Room for the axes and between the panels, in pixels.
const LEFT: f64 = 58.0;
const TOP: f64 = 14.0;
const GAP: f64 = 14.0;
const BELOW: f64 = 44.0;
/// Items that the legend names, and the height of each, in pixels.
const NAMED: usize = 12;
const ROW: f64 = 20.0;

/// Told apart by those who see few colours (Okabe and Ito), and by their dashes where lines lie on one another.
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000"];
const DASHES: [&str; 4] = ["none", "7 5", "2 4", "10 4 2 4"];

#[derive(Template)]
#[template(path = "svg/paths.svg")]
struct Drawing {
    mark: &'static str,
    title: String,
    width: String,
    height: String,
    panels: Vec<Panel>,
    /// Where the texts at the axes stand.
    ticks_below: Vec<Tick>,
    tick_text_x: f64,
    below_y: f64,
    tick_text_y: f64,
    axis_text_y: f64,
    axis_text_x: f64,
    rows: Vec<Row>,
    legend_x: f64,
    legend_text_x: f64,
    /// Where the key of the marks stands.
    key_y: f64,
}

/// A line of the legend.
struct Row {
    y: f64,
    text_y: f64,
    colour: &'static str,
    dash: &'static str,
    text: String,
}

/// One drawing of all paths in a table, see [`runtime_sim::path::table_csv`].
pub fn svg(project: &Project, table: &str) -> String {
    let tracks = track::read(table);
    let line = &project.plant;
    let (low, high) = extent(line, &tracks);
    let scale = SCALE.min(WIDEST / (high.y - low.y));

    let mut above = Panel::new("above", View::Above, (LEFT, TOP), scale, low, high);
    for obstacle in &project.plant.obstacles {
        let size = obstacle.size.unwrap_or(Point::new(0.4, 0.4, 0.0));
        above.rectangle(obstacle.pose, (size.x, size.y), "obstacle");
    }
    for machine in &line.machines {
        above.machine(machine);
    }
    let mut side = Panel::new("side", View::Side, (LEFT, above.bottom() + GAP), scale, low, high);
    for machine in line.machines.iter().filter(|machine| is_visited(machine, &tracks)) {
        for (from, to) in supports(machine) {
            side.support(from, to);
        }
    }
    for (i, track) in tracks.iter().enumerate() {
        for panel in [&mut above, &mut side] {
            panel.track(track, COLOURS[i % COLOURS.len()], DASHES[i % DASHES.len()]);
        }
    }

    let first_row = side.bottom() + BELOW + ROW / 2.0;
    let mut rows = Vec::new();
    let mut row = |colour: &'static str, dash: &'static str, text: String| {
        let y = first_row + ROW * rows.len() as f64;
        rows.push(Row { y: tenths(y), text_y: tenths(y + 4.0), colour, dash, text });
    };
    for (i, track) in tracks.iter().take(NAMED).enumerate() {
        row(COLOURS[i % COLOURS.len()], DASHES[i % DASHES.len()], track.text());
    }
    if tracks.len() > NAMED {
        row("none", "none", format!("and {} more", tracks.len() - NAMED));
    }
    let key_y = tenths(first_row + ROW * rows.len() as f64);
    above.axis = "x (m)";
    side.axis = "z (m)";
    let drawing = Drawing {
        mark: MARK,
        title: format!("{}: paths of {}", project.name, names(&tracks)),
        width: format!("{:.0}", above.right() + GAP),
        height: format!("{:.0}", key_y + ROW),
        ticks_below: side.ticks_below.clone(),
        tick_text_x: LEFT - 9.0,
        below_y: side.bottom(),
        tick_text_y: tenths(side.bottom() + 18.0),
        axis_text_x: tenths(LEFT + side.width / 2.0),
        axis_text_y: tenths(side.bottom() + 35.0),
        panels: vec![above, side],
        rows,
        legend_x: LEFT,
        legend_text_x: LEFT + 44.0,
        key_y,
    };
    drawing.render().unwrap_or_default()
}

fn names(tracks: &[Track]) -> String {
    let names: Vec<&str> = tracks.iter().take(NAMED).map(|track| track.name.as_str()).collect();
    let dots = if tracks.len() > NAMED { ", ..." } else { "" };
    names.join(", ") + dots
}

fn is_visited(machine: &Machine, tracks: &[Track]) -> bool {
    tracks.iter().any(|track| track.machines.contains(&machine.name))
}

/// The lowest and the highest coordinates of the drawing: of all paths, and of what the items lay on.
fn extent(line: &Line, tracks: &[Track]) -> (Point, Point) {
    let mut points: Vec<Point> = tracks.iter().flat_map(|track| track.points.iter().copied()).collect();
    for machine in line.machines.iter().filter(|machine| is_visited(machine, tracks)) {
        for (shape, class) in footprint::shapes(machine) {
            match (shape, class) {
                (footprint::Shape::Rectangle { centre, size: (x, y) }, "belt" | "vehicle" | "station") => {
                    let half = Point::new(x / 2.0, y / 2.0, 0.0);
                    points.extend([centre - half, centre + half]);
                }
                (footprint::Shape::Polygon(corners), _) => points.extend(corners),
                _ => {}
            }
        }
    }
    if points.is_empty() {
        points.push(Point::default());
    }
    let fold = |pick: fn(f64, f64) -> f64, start: f64| {
        points.iter().fold(Point::new(start, start, start), |all, p| {
            Point::new(pick(all.x, p.x), pick(all.y, p.y), pick(all.z, p.z))
        })
    };
    let border = Point::new(BORDER, BORDER, BORDER);
    let low = fold(f64::min, f64::INFINITY) - border;
    let high = fold(f64::max, f64::NEG_INFINITY) + border;
    (Point { z: -UNDER_FLOOR, ..low }, high)
}

/// What items lie on, from the side: both ends of each surface.
fn supports(machine: &Machine) -> Vec<(Point, Point)> {
    let across = |middle: Point, half: f64, height: f64| {
        let middle = middle.up(height);
        (middle - Point::new(0.0, half, 0.0), middle + Point::new(0.0, half, 0.0))
    };
    if let Some(lane) = machine.lane() {
        return match lane.centre_line {
            CentreLine::Axis { along: Axis::Y, range: [low, high], surface } => {
                vec![(Point { y: low, ..surface }, Point { y: high, ..surface })]
            }
            CentreLine::Axis { along: Axis::X, surface, .. } => {
                vec![across(surface, lane.outline / 2.0, 0.0)]
            }
            CentreLine::Line { .. } | CentreLine::Arc { .. } => {
                let end = |place: f64| lane.centre_line.point(place, 0.0);
                vec![(end(lane.centre_line.begin()), end(lane.centre_line.end()))]
            }
        };
    }
    let of_place = |place: &Place| -> Vec<(Point, Point)> {
        let corners = place.floor.corners().map(|corner| corner.y);
        let [low, high] = [
            corners.into_iter().fold(f64::INFINITY, f64::min),
            corners.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ];
        let middle = Point::new(place.floor.middle.x, (low + high) / 2.0, 0.0);
        let stops = machine.stops();
        let origins = if machine.is_driven(place) { stops } else { std::slice::from_ref(&place.at) };
        origins
            .iter()
            .map(|origin| across(*origin + middle, (high - low) / 2.0, place.floor.middle.z))
            .collect()
    };
    machine.places().filter(|place| !machine.is_on_track(place)).flat_map(of_place).collect()
}
