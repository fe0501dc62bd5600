//! Why a command ended that waited for a gripper to hold something.

use super::Plant;
use super::gripping::faces;
use super::missed::Reason;
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

    fn why_nothing(&self, gripper: &Gripper) -> Reason {
        let what = format!("nothing was gripped at {}", point_text(gripper.tool.position));
        Reason { what, details: self.details(gripper) }
    }

    fn details(&self, gripper: &Gripper) -> String {
        if let Some(item) = gripper.held {
            let name = self.names.name(item);
            return format!("{name} is held, which the gripper reports later than the command waits for it");
        }
        if !gripper.is_closed {
            return "the gripper is not closed".into();
        }
        let Some(Nearest { item, grip, distance }) = self.nearest(gripper.tool.position) else {
            return "no item lies anywhere, but those in grippers".into();
        };
        let name = self.names.name(item);
        if distance > gripper.near {
            let [distance, near] = [distance, gripper.near].map(|length| 1000.0 * length);
            return format!(
                "the nearest item, {name}, is gripped at {}, {distance:.1} mm away, and the gripper takes it within {near:.1} mm",
                point_text(grip)
            );
        }
        match faces(&gripper.tool, self.upper(item)) {
            false => format!("the upper side of {name}, which is there, does not face the tool"),
            true => format!(
                "{name} is there, but the gripper has not taken it: it looked before the tool came, or the command does not wait long enough"
            ),
        }
    }

    fn nearest(&self, tool: Point) -> Option<Nearest> {
        let all =
            self.grip_points().map(|(item, grip)| Nearest { item, grip, distance: (grip - tool).length() });
        all.min_by(|a, b| a.distance.total_cmp(&b.distance).then(a.item.cmp(&b.item)))
    }
}
