//! The types that come with the tool: those of ARIAC 2021.

use crate::device::{self, Device};
use crate::source::{SourceFile, Sources};
use crate::spec::parser;
use std::sync::{Arc, LazyLock};

/// The folder of the devices.
pub const DEVICES: &str = "library/devices/";

/// Names of the files, as reports show them, and their texts.
pub const FILES: &[(&str, &str)] = &[
    ("library/devices/belt.aut", include_str!("../library/devices/belt.aut")),
    ("library/devices/vehicle.aut", include_str!("../library/devices/vehicle.aut")),
    ("library/devices/ur10.aut", include_str!("../library/devices/ur10.aut")),
    ("library/devices/rail_arm.aut", include_str!("../library/devices/rail_arm.aut")),
    ("library/devices/gantry.aut", include_str!("../library/devices/gantry.aut")),
    ("library/devices/station.aut", include_str!("../library/devices/station.aut")),
    ("library/devices/bin.aut", include_str!("../library/devices/bin.aut")),
    ("library/handover.aut", include_str!("../library/handover.aut")),
    ("library/conveyor.aut", include_str!("../library/conveyor.aut")),
    ("library/agv.aut", include_str!("../library/agv.aut")),
    ("library/kitting.aut", include_str!("../library/kitting.aut")),
    ("library/gantry.aut", include_str!("../library/gantry.aut")),
    ("library/station.aut", include_str!("../library/station.aut")),
];

/// Whether a file is one of the library, as it comes with the tool.
pub fn has(file: &SourceFile) -> bool {
    FILES.iter().any(|(name, text)| file.name == *name && file.text == *text)
}

static ALL: LazyLock<Vec<Arc<Device>>> = LazyLock::new(|| {
    let mut sources = Sources::default();
    let of_devices = FILES.iter().filter(|(name, _)| name.starts_with(DEVICES));
    let trees = of_devices.flat_map(|(name, text)| parser::parse(sources.add(*name, *text), text).0.devices);
    let trees: Vec<_> = trees.collect();
    let declared = trees.iter().map(|tree| (tree.name.value.as_str(), tree)).collect();
    let devices = trees.iter().filter(|tree| !tree.is_assembly);
    devices.filter_map(|tree| device::check(tree, &declared).ok()).collect()
});

/// The devices of the library, in the order of their declarations.
pub fn devices() -> &'static [Arc<Device>] {
    &ALL
}

pub fn device(name: &str) -> Option<&'static Arc<Device>> {
    ALL.iter().find(|device| device.name == name)
}
