//! The compiled controllers behind their C interface: the module of the same name among the emitted files.
#![allow(unsafe_code)] // Functions of a library that was loaded have no checked types.

use libloading::Library;
use runtime_sim::line::Line;
use runtime_sim::scan::{self, SystemInputs, SystemOutputs};
use std::ffi::c_void;
use std::path::Path;
use std::sync::Arc;

/// Of the interface that is spoken here.
const VERSION: u32 = 4;
/// Bytes of a message.
const MESSAGE: usize = 1000;

/// A library that stays loaded as long as anything of it is used.
#[derive(Clone)]
pub struct SharedLibrary(Arc<Functions>);

struct Functions {
    open: unsafe extern "C" fn(*const u8, usize, *mut u8, usize, *mut usize) -> *mut c_void,
    close: unsafe extern "C" fn(*mut c_void),
    robots: unsafe extern "C" fn(*const c_void) -> usize,
    scan: unsafe extern "C" fn(*mut c_void, Inputs, *const Image, *const Image, usize, *mut Outputs) -> usize,
    state: unsafe extern "C" fn(*const c_void, usize) -> usize,
    trace: unsafe extern "C" fn(*mut c_void, *mut f64, usize) -> usize,
    power_up: unsafe extern "C" fn(*mut c_void),
    skip: unsafe extern "C" fn(*mut c_void, u64),
    stays: unsafe extern "C" fn(*const c_void, *mut usize),
    _library: Library,
}

#[repr(C)]
struct Image {
    words: *mut f64,
    count: usize,
}

#[repr(C)]
struct Inputs {
    run_permit: u8,
    start: u8,
    reset: u8,
}

#[repr(C)]
#[derive(Default)]
struct Outputs {
    running: u8,
    fault: u8,
    fault_code: i32,
    fault_robot: i32,
    alarm: u8,
    alarm_code: i32,
    alarm_robot: i32,
}

impl SharedLibrary {
    /// Loads a library that was compiled from the emitted files.
    pub fn load(path: &Path) -> Result<Self, String> {
        let failed = |e: libloading::Error| format!("{}: {e}", path.display());
        // SAFETY: the library is the tool's own, made of safe code and of the C interface, and runs nothing when
        // it is loaded. Its functions have these types as long as the versions are equal.
        unsafe {
            let library = Library::new(path).map_err(failed)?;
            let version =
                *library.get::<unsafe extern "C" fn() -> u32>(b"autogen_version\0").map_err(failed)?;
            match version() {
                VERSION => {}
                other => return Err(format!("{}: its interface has version {other}", path.display())),
            }
            Ok(Self(Arc::new(Functions {
                open: *library.get(b"autogen_open\0").map_err(failed)?,
                close: *library.get(b"autogen_close\0").map_err(failed)?,
                robots: *library.get(b"autogen_robots\0").map_err(failed)?,
                scan: *library.get(b"autogen_scan\0").map_err(failed)?,
                state: *library.get(b"autogen_state\0").map_err(failed)?,
                trace: *library.get(b"autogen_trace\0").map_err(failed)?,
                power_up: *library.get(b"autogen_power_up\0").map_err(failed)?,
                skip: *library.get(b"autogen_skip\0").map_err(failed)?,
                stays: *library.get(b"autogen_stays\0").map_err(failed)?,
                _library: library,
            })))
        }
    }

    /// The controllers of a line, with these parameters.
    pub fn controllers(&self, line: &Line, parameters: &str) -> Result<Controllers, String> {
        let mut message = [0; MESSAGE];
        let mut length = 0;
        // SAFETY: each pointer goes with its length.
        let session = unsafe {
            let (text, message) = (parameters.as_bytes(), &mut message);
            (self.0.open)(text.as_ptr(), text.len(), message.as_mut_ptr(), MESSAGE, &mut length)
        };
        if session.is_null() {
            let message = message.get(..length).unwrap_or_default();
            return Err(format!(
                "the controllers do not accept their parameters: {}",
                String::from_utf8_lossy(message)
            ));
        }
        let controllers =
            Controllers { library: self.clone(), session, inputs: Vec::new(), outputs: Vec::new() };
        // SAFETY: the session is open.
        match unsafe { (self.0.robots)(session) } {
            robots if robots == line.machines.len() => Ok(controllers),
            robots => Err(format!("{robots} robots for {} machines", line.machines.len())),
        }
    }
}

/// A session: the controllers of one line.
pub struct Controllers {
    library: SharedLibrary,
    session: *mut c_void,
    inputs: Vec<Image>,
    outputs: Vec<Image>,
}

impl Drop for Controllers {
    fn drop(&mut self) {
        // SAFETY: it was opened, and is closed once.
        unsafe { (self.library.0.close)(self.session) }
    }
}

impl scan::Controllers for Controllers {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        self.inputs.clear();
        // The library reads these and does not write.
        self.inputs.extend(inputs.iter().map(|i| Image { words: i.as_ptr().cast_mut(), count: i.len() }));
        self.outputs.clear();
        self.outputs.extend(outputs.iter_mut().map(|o| Image { words: o.as_mut_ptr(), count: o.len() }));
        let SystemInputs { run_permit, start, reset } = system;
        let system = Inputs { run_permit: run_permit.into(), start: start.into(), reset: reset.into() };
        let mut answer = Outputs::default();
        let robots = self.inputs.len().min(self.outputs.len());
        let (inputs, images) = (self.inputs.as_ptr(), self.outputs.as_ptr());
        // SAFETY: the session is open, both lists have that many images, and each image its own words.
        let wrong =
            unsafe { (self.library.0.scan)(self.session, system, inputs, images, robots, &mut answer) };
        if let Some(output) = wrong.checked_sub(1).and_then(|robot| outputs.get_mut(robot)) {
            // Of another size, which ends the run.
            output.clear();
        }
        SystemOutputs {
            running: answer.running != 0,
            fault: answer.fault != 0,
            fault_code: answer.fault_code,
            fault_robot: answer.fault_robot,
            alarm: answer.alarm != 0,
            alarm_code: answer.alarm_code,
            alarm_robot: answer.alarm_robot,
        }
    }

    fn power_up(&mut self) {
        // SAFETY: the session is open.
        unsafe { (self.library.0.power_up)(self.session) };
    }

    fn state(&self, machine: usize) -> usize {
        // SAFETY: the session is open.
        unsafe { (self.library.0.state)(self.session, machine) }
    }

    fn stays(&self) -> Vec<usize> {
        // SAFETY: the session is open.
        let mut stays = vec![0; unsafe { (self.library.0.robots)(self.session) }];
        // SAFETY: the session is open, and there is a number for each robot.
        unsafe { (self.library.0.stays)(self.session, stays.as_mut_ptr()) };
        stays
    }

    fn skip(&mut self, scans: u64) {
        // SAFETY: the session is open.
        unsafe { (self.library.0.skip)(self.session, scans) }
    }

    fn trace(&self, out: &mut Vec<f64>) {
        loop {
            let free = out.spare_capacity_mut();
            // SAFETY: the session is open, and so many words are free.
            let count = unsafe { (self.library.0.trace)(self.session, free.as_mut_ptr().cast(), free.len()) };
            if count <= free.len() {
                // SAFETY: the library has written so many.
                unsafe { out.set_len(out.len() + count) };
                return;
            }
            out.reserve(count);
        }
    }
}
