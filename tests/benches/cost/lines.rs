//! Layouts of any size, made of the default one.

/// So many lines like the default one, each with four vehicles: seven robots. They stand 30 m apart in x,
/// 66 in a row, and rows 20 m apart in y, so that up to 6600 of them are within the limits of a layout.
pub fn copies(count: usize) -> String {
    assert!(count <= 6600);
    let vehicles = [4.675404, 1.367643, -1.333917, -4.696062];
    let mut layout = Layout::default();
    for copy in 0..count {
        let (x, y) = ((copy % 66) as f64 * 30.0 - 975.0, (copy / 66) as f64 * 20.0 - 980.0);
        layout.line(copy, [x, y], &vehicles, 4.8);
    }
    layout.text()
}

/// Lines of up to 1000 robots, most of them vehicles 0.8 m apart; one line stands 30 m from the next.
pub fn long(robots: usize) -> String {
    let lines = robots.div_ceil(1000);
    let mut layout = Layout::default();
    for line in 0..lines {
        let robots = robots * (line + 1) / lines - robots * line / lines;
        let vehicles = robots - 3;
        let middle = (vehicles - 1) as f64 / 2.0;
        let places: Vec<f64> = (0..vehicles).map(|i| (i as f64 - middle) * 0.8).collect();
        layout.line(line, [line as f64 * 30.0 - 900.0, 0.0], &places, middle * 0.8 + 5.0);
    }
    layout.text()
}

#[derive(Default)]
struct Layout {
    robots: Vec<String>,
    stationary: Vec<String>,
}

impl Layout {
    /// The machines of the default layout, moved by `x` and `y`: vehicles at these places along y, rails so
    /// long to both sides.
    fn line(&mut self, number: usize, [x, y]: [f64; 2], vehicles: &[f64], rail: f64) {
        let mut robot = |name: &str, kind: &str, more: String| {
            self.robots.push(format!(r#"{{"name": "{name}_{number}", "type": "{kind}", {more}}}"#));
        };
        let range = |low: f64, high: f64| format!("[{:.6}, {:.6}]", low, high);
        let point = |px: f64, py: f64, z: f64| format!("[{:.6}, {:.6}, {z}]", x + px, y + py);
        let orient = range(y - 5.0, y + 5.0);
        let pose = point(-0.573076, 0.0, 0.0);
        robot("belt", "conveyor", format!(r#""pose": {pose}, "orient": "y", "orient_range": {orient}"#));
        let along = range(y - rail, y + rail);
        let pose = point(-1.3, 0.0, 1.127);
        robot("kitting", "kitting", format!(r#""pose": {pose}, "rail_dim": "y", "rail_range": {along}"#));
        for (index, &place) in vehicles.iter().enumerate() {
            let [pose, near, far] = [-2.265685, -5.6, -10.590274].map(|px| point(px, place, 0.0));
            robot(
                &format!("agv{index}"),
                "agv",
                format!(r#""pose": {pose}, "destinations": [{near}, {far}]"#),
            );
        }
        let (pose, across) = (point(-4.0, 0.0, 2.0), range(x - 14.4, x + 0.4));
        let more = format!(r#""pose": {pose}, "x_rail_range": {across}, "y_rail_range": {along}"#);
        robot("gantry", "gantry", more);
        for (index, (px, py)) in
            [(-7.3, 3.0), (-12.3, 3.0), (-7.3, -3.0), (-12.3, -3.0)].into_iter().enumerate()
        {
            let (pose, name) = (point(px, py, 0.0), format!("as{index}_{number}"));
            self.stationary.push(format!(
                r#"{{"name": "{name}", "type": "station", "pose": {pose}, "box": [0.6, 0.6, 1.2]}}"#
            ));
        }
    }

    fn text(&self) -> String {
        let (robots, stationary) = (self.robots.join(",\n"), self.stationary.join(",\n"));
        format!("{{\"robots\": [\n{robots}\n],\n\"stationary\": [\n{stationary}\n]}}\n")
    }
}
