//! The controllers as a shared library.
//!
//! A session has the controllers of one layout. A caller opens it with the text of the parameters, scans, and
//! closes it. Sessions share nothing, and each is used by one thread at a time.
#![allow(unsafe_code)] // A C interface has only pointers.

use crate::layout::{Layout, alarm, input_words, latch, publish};
use crate::read::Reader;
use controllers::system::{System, SystemInputs};

/// Changes with the functions below.
pub const VERSION: u32 = 4;

pub struct Session {
    layout: Layout,
    system: System,
    /// Words of the inputs and of the outputs of each robot.
    sizes: Vec<[usize; 2]>,
    image: Vec<f64>,
    trace: Vec<f64>,
}

impl Session {
    fn new(layout: Layout) -> Self {
        let mut image = Vec::new();
        let size = |robot| {
            publish(robot, false, &mut image);
            [input_words(robot), image.len()]
        };
        let sizes = layout.robots.iter().map(size).collect();
        Self { layout, system: System::new(), sizes, image, trace: Vec::new() }
    }
}

/// Words of a process image; they belong to the caller.
#[repr(C)]
pub struct Image {
    pub words: *mut f64,
    pub count: usize,
}

/// Inputs of the system as a whole: 1 is true, and every other number is false.
#[repr(C)]
pub struct Inputs {
    pub run_permit: u8,
    pub start: u8,
    pub reset: u8,
}

/// Outputs of the system as a whole: 1 is true.
#[repr(C)]
#[derive(Default)]
pub struct Outputs {
    pub running: u8,
    pub fault: u8,
    pub fault_code: i32,
    pub fault_robot: i32,
    pub alarm: u8,
    pub alarm_code: i32,
    pub alarm_robot: i32,
}

#[unsafe(no_mangle)]
pub extern "C" fn autogen_version() -> u32 {
    VERSION
}

/// A session, or null: then `message` has the reason, cut to `capacity` bytes, and `length` its length.
///
/// # Safety
/// `text` points to `text_length` bytes, `message` to `capacity` bytes, `length` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn autogen_open(
    text: *const u8,
    text_length: usize,
    message: *mut u8,
    capacity: usize,
    length: *mut usize,
) -> *mut Session {
    // SAFETY: as the caller promises.
    let bytes = unsafe { std::slice::from_raw_parts(text, text_length) };
    let read = || Layout::read(&mut Reader::new(str::from_utf8(bytes).map_err(|e| e.to_string())?));
    match read() {
        Ok(layout) => Box::into_raw(Box::new(Session::new(layout))),
        Err(reason) => {
            let count = reason.len().min(capacity);
            // SAFETY: no more than `capacity` bytes are written, and the two do not overlap.
            unsafe {
                message.copy_from_nonoverlapping(reason.as_ptr(), count);
                length.write(count);
            }
            std::ptr::null_mut()
        }
    }
}

/// Frees a session.
///
/// # Safety
/// `session` is one that was opened, and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn autogen_close(session: *mut Session) {
    // SAFETY: `autogen_open` has made the box.
    let Session { mut layout, .. } = *unsafe { Box::from_raw(session) };
    let kept = std::mem::take(&mut layout.kept);
    drop(layout);
    // SAFETY: nothing of the layout has left the session.
    unsafe { kept.free() }
}

/// Number of robots.
///
/// # Safety
/// `session` is open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn autogen_robots(session: *const Session) -> usize {
    // SAFETY: as the caller promises.
    unsafe { &*session }.layout.robots.len()
}

/// One scan: latches `inputs`, steps all robots, publishes into `outputs`. Both have an image for each robot,
/// in layout order. 0, or the number of the first robot from 1 that has no images, or one of another size: then nothing
/// was done, and `answer` is as it was.
///
/// # Safety
/// `session` is open; `inputs` and `outputs` point to `robots` images, `answer` to the outputs of the system,
/// and none of them overlap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn autogen_scan(
    session: *mut Session,
    system: Inputs,
    inputs: *const Image,
    outputs: *const Image,
    robots: usize,
    answer: *mut Outputs,
) -> usize {
    // SAFETY: as the caller promises.
    let (session, inputs, outputs, answer) = unsafe {
        (
            &mut *session,
            std::slice::from_raw_parts(inputs, robots),
            std::slice::from_raw_parts(outputs, robots),
            &mut *answer,
        )
    };
    let fits = |(size, images): (&[usize; 2], (&Image, &Image))| *size == [images.0.count, images.1.count];
    let count = session.sizes.iter().zip(inputs.iter().zip(outputs)).take_while(|robot| fits(*robot)).count();
    if count < session.sizes.len().max(robots) {
        return count + 1;
    }
    for (robot, image) in session.layout.robots.iter_mut().zip(inputs) {
        // SAFETY: an image is `count` words.
        latch(robot, unsafe { std::slice::from_raw_parts(image.words, image.count) });
    }
    let system = SystemInputs {
        run_permit: system.run_permit == 1,
        start: system.start == 1,
        reset: system.reset == 1,
    };
    let found = session.layout.scan(&mut session.system, system);
    let (alarm, alarm_code, alarm_robot) = alarm(&found);
    *answer = Outputs {
        running: found.running.into(),
        fault: found.fault.into(),
        fault_code: found.fault_code,
        fault_robot: found.fault_robot,
        alarm: alarm.into(),
        alarm_code,
        alarm_robot,
    };
    for (robot, image) in session.layout.robots.iter().zip(outputs) {
        publish(robot, found.running, &mut session.image);
        // SAFETY: an image is `count` words, as many as are published, and is not the session's own.
        unsafe { image.words.copy_from_nonoverlapping(session.image.as_ptr(), image.count) };
    }
    0
}

/// Number of the state of a robot; the greatest number if there is no such robot.
///
/// # Safety
/// `session` is open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn autogen_state(session: *const Session, robot: usize) -> usize {
    // SAFETY: as the caller promises.
    unsafe { &*session }.layout.robots.get(robot).map_or(usize::MAX, |robot| robot.state())
}

/// Power was lost after the last scan and is back before the next.
///
/// # Safety
/// `session` is open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn autogen_power_up(session: *mut Session) {
    // SAFETY: as the caller promises.
    let Session { layout, system, .. } = unsafe { &mut *session };
    layout.power_up(system);
}

/// Replaces so many scans in which nothing happens.
///
/// # Safety
/// `session` is open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn autogen_skip(session: *mut Session, scans: u64) {
    // SAFETY: as the caller promises.
    let Session { layout, system, .. } = unsafe { &mut *session };
    layout.skip(system, scans);
}

/// Writes the position of the time in the state within the trace, for each robot.
///
/// # Safety
/// `session` is open, and `words` points to a number for each robot.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn autogen_stays(session: *const Session, words: *mut usize) {
    // SAFETY: as the caller promises.
    let stays = unsafe { &*session }.layout.stays();
    // SAFETY: there is one for each robot.
    unsafe { words.copy_from_nonoverlapping(stays.as_ptr(), stays.len()) };
}

/// Number of words of the state of all controllers; they are written if they fit into `capacity`.
///
/// # Safety
/// `session` is open, and `words` points to `capacity` words.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn autogen_trace(session: *mut Session, words: *mut f64, capacity: usize) -> usize {
    // SAFETY: as the caller promises.
    let session = unsafe { &mut *session };
    session.trace.clear();
    session.layout.trace(&mut session.trace);
    if session.trace.len() <= capacity {
        // SAFETY: they fit, and are not the session's own.
        unsafe { words.copy_from_nonoverlapping(session.trace.as_ptr(), session.trace.len()) };
    }
    session.trace.len()
}
