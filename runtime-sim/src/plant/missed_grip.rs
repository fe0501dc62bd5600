//! Why a command ended that waited for a gripper to hold something.

use super::Plant;
use super::gripping::faces;
use crate::carrier::Carrier;
use crate::part::Gripper;
use crate::part::grip::HOLDS;
use crate::point::Point;
use crate::shortage::point_text;

/// The item whose grip point is nearest to a tool.
struct Nearest {
    item: usize,
    grip: Point,
    distance: f64,
}

impl Plant {
    /// Of the commands that have waited in vain in the scan that ends at `next_ms`.
    pub(super) fn note_missed_grips(&mut self, next_ms: u64) {
        for number in 0..self.grippers.len() {
            let (machine, part) = self.grippers[number];
            let Some(waited) = self.machines[machine].take_waited_in_vain(part, HOLDS) else { continue };
            let see = self.machines[machine].see(&self.items, &self.desk);
            if let Some(gripper) = self.machines[machine].gripper(part, &see) {
                let reason = self.why_nothing(&gripper);
                self.machines[machine].note_missed(waited, reason, next_ms);
            }
        }
    }

    fn why_nothing(&self, gripper: &Gripper) -> String {
        let nothing = format!("nothing was gripped at {}", point_text(gripper.tool.position));
        if !gripper.is_closed {
            return format!("{nothing}: the gripper is not closed");
        }
        let Some(Nearest { item, grip, distance }) = self.nearest(gripper.tool.position) else {
            return format!("{nothing}: there is no item that another gripper does not hold");
        };
        let name = self.names.name(item);
        if distance > gripper.near {
            let [distance, near] = [distance, gripper.near].map(|length| 1000.0 * length);
            return format!(
                "{nothing}: the nearest item, {name}, is gripped at {}, {distance:.0} mm away, and the gripper takes it within {near:.0} mm",
                point_text(grip)
            );
        }
        match faces(&gripper.tool, self.upper(item)) {
            false => format!("{nothing}: the upper side of {name} there does not face the tool"),
            true => format!(
                "{nothing}: {name} is there, but was not for long enough while the gripper looked for it"
            ),
        }
    }

    fn nearest(&self, tool: Point) -> Option<Nearest> {
        let lying =
            self.items.placed().filter(|item| !matches!(self.base_carrier(*item), Carrier::Grip { .. }));
        let all = lying.filter_map(|item| {
            let grip = self.grip_point(item)?;
            Some(Nearest { item, grip, distance: (grip - tool).length() })
        });
        all.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }
}
