//! The line that stands around an input.

/// A belt, two arms, a vehicle and a station: the smallest line that makes an order.
const SMALL: &str = r#"{"name": "small", "robots": [
  {"name": "belt", "type": "conveyor", "pose": [-0.573076, 0, 0], "orient": "y", "orient_range": [-5, 5]},
  {"name": "kitting", "type": "kitting", "pose": [-1.3, 0, 1.127], "rail_dim": "y", "rail_range": [-4.8, 4.8]},
  {"name": "agv1", "type": "agv", "pose": [-2.265685, 4.675404, 0],
   "destinations": [[-5.6, 4.675404, 0], [-10.590274, 4.675404, 0]]},
  {"name": "gantry", "type": "gantry", "pose": [-4, 0, 2], "x_rail_range": [-14.4, 0.4], "y_rail_range": [-4.5, 4.5]}
%ROBOTS%], "stationary": [
  {"name": "as1", "type": "station", "pose": [-7.3, 3, 0], "box": [0.6, 0.6, 1.2]}]}
"#;

/// The layout of the small line, with more robots; each begins with a comma.
pub fn small(robots: &str) -> String {
    SMALL.replace("%ROBOTS%", robots)
}

/// The text of a file, as the command line reads it.
pub fn text(input: &[u8]) -> String {
    let text = String::from_utf8_lossy(input);
    text.strip_prefix('\u{feff}').unwrap_or(&text).into()
}
