//! The types that come with the tool: those of ARIAC 2021.

/// Names of the files, as reports show them, and their texts.
pub const FILES: &[(&str, &str)] = &[
    ("library/handover.aut", include_str!("../library/handover.aut")),
    ("library/conveyor.aut", include_str!("../library/conveyor.aut")),
    ("library/agv.aut", include_str!("../library/agv.aut")),
    ("library/kitting.aut", include_str!("../library/kitting.aut")),
    ("library/gantry.aut", include_str!("../library/gantry.aut")),
    ("library/station.aut", include_str!("../library/station.aut")),
];
