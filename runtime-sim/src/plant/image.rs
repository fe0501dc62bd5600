//! Where the ports stand in the process images. A test holds these numbers against the table of devices.

use crate::point::Point;

/// Inputs of every commanded device.
pub mod in_head {
    pub const READY: usize = 0;
    pub const GOT: usize = 1;
    pub const ACK: usize = 2;
    pub const ERROR: usize = 3;
}

/// Inputs of a belt; `seen_at` follows `sees`.
pub mod in_belt {
    pub const MOVING: usize = 4;
    pub const SEES: usize = 5;
}

pub mod in_vehicle {
    pub const POS: usize = 4;
    pub const AT_STOP: usize = 7;
}

pub mod in_arm {
    pub const ATTACHED: usize = 4;
    pub const TOOL: usize = 5;
}

/// Inputs of a station; `order_id` follows `order_parts`.
pub mod in_station {
    pub const ORDER_OPEN: usize = 0;
    pub const ORDER_PARTS: usize = 1;
}

/// Outputs of commanded devices: the head, then the goal; of arms then the gripper and what its other
/// commands take. Only a gantry has a `turn`.
pub mod out {
    pub const CMD: usize = 0;
    pub const VERB: usize = 1;
    pub const HOLD: usize = 2;
    pub const GOAL: usize = 3;
    pub const GRIP: usize = 6;
    pub const TOP_SPEED: usize = 7;
    pub const GAIN: usize = 8;
    pub const VIA: usize = 9;
    pub const TURN: usize = 12;
}

pub mod out_station {
    pub const COMPLETE: usize = 0;
}

pub fn put_point(image: &mut [f64], at: usize, point: Point) {
    image[at..at + 3].copy_from_slice(&[point.x, point.y, point.z]);
}

pub fn point(image: &[f64], at: usize) -> Point {
    Point::new(image[at], image[at + 1], image[at + 2])
}

pub fn put_bit(image: &mut [f64], at: usize, value: bool) {
    image[at] = f64::from(u8::from(value));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::Device;

    #[test]
    fn ports_stand_where_the_table_says() {
        let kinds = 3;
        let offset = |device: &str, port: &str| Device::find(device).unwrap().offset(port, kinds).unwrap();
        for device in ["belt", "vehicle", "rail_arm", "gantry"] {
            assert_eq!(offset(device, "ready"), in_head::READY);
            assert_eq!(offset(device, "got"), in_head::GOT);
            assert_eq!(offset(device, "ack"), in_head::ACK);
            assert_eq!(offset(device, "error"), in_head::ERROR);
            assert_eq!(offset(device, "cmd"), out::CMD);
            assert_eq!(offset(device, "verb"), out::VERB);
            assert_eq!(offset(device, "hold"), out::HOLD);
        }
        for device in ["vehicle", "rail_arm", "gantry"] {
            assert_eq!(offset(device, "goal"), out::GOAL);
        }
        for device in ["rail_arm", "gantry"] {
            assert_eq!(offset(device, "grip"), out::GRIP);
            assert_eq!(offset(device, "top_speed"), out::TOP_SPEED);
            assert_eq!(offset(device, "gain"), out::GAIN);
            assert_eq!(offset(device, "via"), out::VIA);
            assert_eq!(offset(device, "attached"), in_arm::ATTACHED);
            assert_eq!(offset(device, "tool"), in_arm::TOOL);
        }
        assert_eq!(offset("gantry", "turn"), out::TURN);
        assert_eq!(offset("belt", "moving"), in_belt::MOVING);
        assert_eq!(offset("belt", "sees"), in_belt::SEES);
        assert_eq!(offset("belt", "seen_at"), in_belt::SEES + kinds);
        assert_eq!(offset("vehicle", "pos"), in_vehicle::POS);
        assert_eq!(offset("vehicle", "at_stop"), in_vehicle::AT_STOP);
        assert_eq!(offset("station", "order_open"), in_station::ORDER_OPEN);
        assert_eq!(offset("station", "order_parts"), in_station::ORDER_PARTS);
        assert_eq!(offset("station", "order_id"), in_station::ORDER_PARTS + kinds);
        assert_eq!(offset("station", "complete"), out_station::COMPLETE);
    }
}
