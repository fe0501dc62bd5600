//! The path of one item, as a table has it.

use runtime_sim::point::Point;

/// Where an item was, in the order of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    pub name: String,
    pub points: Vec<Point>,
    /// Places where it changed hands.
    pub handovers: Vec<Point>,
    /// The machines that bore it, and at last the order.
    pub machines: Vec<String>,
    begin_s: f64,
    end_s: f64,
}

impl Track {
    /// For the legend: when it was where.
    pub fn text(&self) -> String {
        let way = self.machines.join(" \u{2192} ");
        format!("{}: {way}, {:.1} s to {:.1} s", self.name, self.begin_s, self.end_s)
    }
}

/// The tracks in a table, in its order; lines that are no rows are passed over.
pub fn read(table: &str) -> Vec<Track> {
    let mut tracks: Vec<Track> = Vec::new();
    let mut last_carrier = "";
    for row in table.lines() {
        let words: Vec<&str> = row.split(',').collect();
        let [name, _, t, x, y, z, carrier] = words[..] else { continue };
        let (Ok(t), Ok(x), Ok(y), Ok(z)) = (t.parse(), x.parse(), y.parse(), z.parse()) else { continue };
        if tracks.last().is_none_or(|track| track.name != name) {
            last_carrier = "";
            tracks.push(Track {
                name: name.into(),
                points: Vec::new(),
                handovers: Vec::new(),
                machines: Vec::new(),
                begin_s: t,
                end_s: t,
            });
        }
        let Some(track) = tracks.last_mut() else { continue };
        let point = Point::new(x, y, z);
        track.end_s = t;
        track.points.push(point);
        if carrier != last_carrier {
            if !last_carrier.is_empty() {
                track.handovers.push(point);
            }
            let machine = carrier.split_once(" of ").map_or(carrier, |(_, machine)| machine);
            track.machines.push(machine.into());
            last_carrier = carrier;
        }
    }
    tracks
}

#[cfg(test)]
mod tests {
    use super::*;
    use runtime_sim::path::HEAD;

    #[test]
    fn a_track_has_the_handovers_and_the_times_of_its_item() {
        let rows = [
            "a_1,a,1.000000,0.000000,4.000000,0.900000,belt",
            "a_1,a,2.500000,0.000000,3.000000,0.900000,belt",
            "a_1,a,2.500000,0.000000,3.000000,0.900000,gripper of kitting",
            "a_1,a,4.000000,-2.000000,3.000000,0.700000,tray of agv1",
            "b_1,b,3.000000,0.000000,4.000000,0.900000,belt",
        ];
        let tracks = read(&format!("{HEAD}\n{}\n", rows.join("\n")));
        let [a, b] = tracks.as_slice() else { panic!("{tracks:?}") };
        assert_eq!(a.text(), "a_1: belt \u{2192} kitting \u{2192} agv1, 1.0 s to 4.0 s");
        assert_eq!(a.points.len(), 4);
        assert_eq!(a.handovers, [Point::new(0.0, 3.0, 0.9), Point::new(-2.0, 3.0, 0.7)]);
        assert_eq!(b.text(), "b_1: belt, 3.0 s to 3.0 s");
        assert!(b.handovers.is_empty());
    }
}
