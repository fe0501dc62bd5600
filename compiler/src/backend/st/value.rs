//! Values that variables have where no controller has given them one.

use crate::device::Port;
use crate::ir::Value;
use runtime_sim::device::{PortType, Stop};

/// Published if the state has no meaning: the controller's memory is damaged.
pub const NO_SUCH_STATE: i32 = 32767;

/// Published at the start if what was retained is not of this program, or not of one scan.
pub const NOT_RETAINED: i32 = 32766;

/// Published if a scan comes late by the clock of the PLC.
pub const LATE_SCAN: i32 = 32765;

/// Published if the interval of the task is not `dt_ms`, by the clock of the PLC.
pub const WRONG_INTERVAL: i32 = 32764;

/// What a port holds before anything was latched or written.
pub fn first_value(ty: PortType) -> Value {
    match ty {
        PortType::Bool => Value::Bool(false),
        PortType::Int { lo, hi } => Value::Int(0.clamp(lo, hi)),
        PortType::Real => Value::Real(0.0),
        PortType::Point => Value::Point([0.0; 3]),
    }
}

/// The value that is published while the system does not run, if it is not the last one.
pub fn stop_value(port: &Port) -> Option<Value> {
    let Stop::Value(value) = port.stop else { return None };
    Some(match port.ty {
        PortType::Bool => Value::Bool(value != 0.0),
        PortType::Int { .. } => Value::Int(value as i32),
        PortType::Real => Value::Real(value),
        PortType::Point => Value::Point([value; 3]),
    })
}
