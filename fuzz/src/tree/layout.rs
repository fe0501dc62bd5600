//! Layouts by choices.

use super::json::{any, list, metres, name, object};
use arbitrary::{Result, Unstructured};

pub fn layout(u: &mut Unstructured) -> Result<String> {
    let robots = machines(u, &ROBOTS)?;
    let stationary = machines(u, &STATIONARY)?;
    let mut members = vec![("robots", robots), ("stationary", stationary)];
    if u.ratio(1, 8)? {
        members.push(("scan_ms", u.choose(&["1", "4", "10", "1000", "0", "1001", "2.5"])?.to_string()));
    }
    if u.ratio(1, 8)? {
        members.push(("name", name(u)?));
    }
    if u.ratio(1, 6)? {
        members.push(("may_touch", list(u, 3, touch)?));
    }
    object(u, &members)
}

/// Type, name, and where it stands in a line that works: pose and what its device needs.
type Machine = (&'static str, &'static str, [f64; 3], &'static [(&'static str, &'static str)]);

const ROBOTS: [Machine; 5] = [
    ("conveyor", "belt", [-0.573076, 0.0, 0.0], &[("orient", "\"y\""), ("orient_range", "[-5, 5]")]),
    ("kitting", "kitting", [-1.3, 0.0, 1.127], &[("rail_dim", "\"y\""), ("rail_range", "[-4.8, 4.8]")]),
    (
        "agv",
        "agv1",
        [-2.265685, 4.675404, 0.0],
        &[("destinations", "[[-5.6, 4.675404, 0], [-10.590274, 4.675404, 0]]")],
    ),
    (
        "agv",
        "agv2",
        [-2.265685, 1.367643, 0.0],
        &[("destinations", "[[-5.6, 1.367643, 0], [-10.590274, 1.367643, 0]]")],
    ),
    (
        "gantry",
        "gantry",
        [-4.0, 0.0, 2.0],
        &[("x_rail_range", "[-14.4, 0.4]"), ("y_rail_range", "[-4.5, 4.5]")],
    ),
];

const STATIONARY: [Machine; 4] = [
    ("station", "as1", [-7.3, 3.0, 0.0], &[("box", "[0.6, 0.6, 1.2]")]),
    ("station", "as2", [-12.3, 3.0, 0.0], &[("box", "[0.6, 0.6, 1.2]")]),
    ("bin", "bin1", [-1.899, 3.38, 0.0], &[("box", "[0.6, 0.6, 0.72]")]),
    ("collector", "end", [-0.577, -4.719, 0.0], &[("box", "[0.73, 0.87, 0.5]")]),
];

/// Each of the working line, a few left out, a few moved, a few more.
fn machines(u: &mut Unstructured, known: &[Machine]) -> Result<String> {
    let mut written = Vec::new();
    for machine in known {
        if !u.ratio(1, 12)? {
            written.push(self::machine(u, machine)?);
        }
    }
    for _ in 0..u.int_in_range(0..=2)? {
        let machine = u.choose(known)?;
        written.push(self::machine(u, machine)?);
    }
    Ok(format!("[{}]", written.join(",\n ")))
}

fn machine(u: &mut Unstructured, (kind, own, pose, keys): &Machine) -> Result<String> {
    let name = if u.ratio(1, 8)? { name(u)? } else { format!("\"{own}\"") };
    let kind = match u.ratio(1, 24)? {
        true => {
            u.choose(&["bin", "agv", "station", "rail", "box", "conveyor", "vehicle", "Agv", "anchor"])?
        }
        false => kind,
    };
    let mut coordinates = Vec::new();
    for coordinate in pose {
        coordinates.push(if u.ratio(1, 10)? { metres(u)? } else { format!("{coordinate}") });
    }
    let mut members = vec![
        ("name", name),
        ("type", format!("\"{kind}\"")),
        ("pose", format!("[{}]", coordinates.join(", "))),
    ];
    for (key, value) in *keys {
        let value = match (u.int_in_range(0..=20)?, *key) {
            (0, "destinations") => format!("[{}, {}]", point(u)?, point(u)?),
            (0, "box") => point(u)?,
            (0, "orient" | "rail_dim") => u.choose(&["\"x\"", "\"y\"", "\"z\""])?.to_string(),
            (0, _) => format!("[{}, {}]", metres(u)?, metres(u)?),
            (1, _) => any(u, 1)?,
            _ => value.to_string(),
        };
        members.push((*key, value));
    }
    if u.ratio(1, 8)? {
        members.push(("parameters", parameters(u)?));
    }
    if u.ratio(1, 12)? {
        members.push(("takes_from", list(u, 2, super::json::name)?));
    }
    if u.ratio(1, 12)? {
        members.push(("hands_to", list(u, 2, super::json::name)?));
    }
    object(u, &members)
}

fn point(u: &mut Unstructured) -> Result<String> {
    Ok(format!("[{}, {}, {}]", metres(u)?, metres(u)?, metres(u)?))
}

fn parameters(u: &mut Unstructured) -> Result<String> {
    let key = *u.choose(&["capacity", "speed", "hover", "clearance", "none"])?;
    let value = if u.ratio(1, 3)? { any(u, 1)? } else { metres(u)? };
    object(u, &[(key, value)])
}

fn touch(u: &mut Unstructured) -> Result<String> {
    let pair = format!("[{}, {}]", name(u)?, name(u)?);
    object(u, &[("pair", pair), ("reason", "\"it is soft\"".into())])
}
