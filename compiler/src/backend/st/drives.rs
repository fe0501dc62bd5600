//! Reference blocks between the ports of a generated controller and what moves: fixed texts, written when asked for.

/// Name and text of each.
pub const FILES: [(&str, &str); 3] = [
    ("axis.st", include_str!("../../../../templates/plc/drives/axis.st")),
    ("robot.st", include_str!("../../../../templates/plc/drives/robot.st")),
    ("inverter.st", include_str!("../../../../templates/plc/drives/inverter.st")),
];
