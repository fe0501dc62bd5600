//! The task on the PLC: its scans must not come late, and `dt_ms` must be its interval.
//!
//! The program counts `dt_ms` in each scan and cannot know how long a scan took. With the clock of the PLC it can.
//! Without a clock the block does nothing, so it makes no difference to the executions of other engines.

use super::code::{Arm, Ex, Stmt, advance, and, assign, binary, name, not, or, when};
use super::context::Shared;
use super::declaration::{Basic, Instance, Unit, Variable};
use super::modes;
use super::value::{LATE_SCAN, WRONG_INTERVAL};

pub const WATCHDOG: &str = "FB_Watchdog";
/// The permit of the panels: a late scan is for them as one without `run_permit`.
pub const PANEL_PERMIT: &str = "panel_permit";
/// Its instance in MAIN.
const INSTANCE: &str = "watchdog";
/// The first statement of MAIN in CODESYS and TwinCAT, whose clock is a function.
pub const CODESYS: &str = "clock_ms := DWORD_TO_DINT(TIME_TO_DWORD(TIME()) AND 16#7FFFFFFF);\n";

const CLOCK: &str = "clock_ms";
const NOW: &str = "now_ms";
const LATE: &str = "late_ms";
const LIMIT: &str = "limit_ms";
const INTERVAL: &str = "interval_ms";
const BEFORE: &str = "clock_before";
const PASSED: &str = "passed_ms";
const HUNDRED: &str = "hundred_scans_ms";
const MEASURED: &str = "measured_ms";
const SCANS: &str = "measured_scans";
const CODE: &str = "code";
const IS_LATE: &str = "is_late";

/// Scans of which the mean is taken.
const WINDOW: i32 = 100;
/// A scan may come so many intervals after the one before.
const LATE_INTERVALS: i32 = 10;
/// A longer interval is none that a task has, ms. A hundred of them are a DINT.
const LONGEST: i32 = 1_000_000;

/// What the line is told of its clock.
pub fn globals(shared: Shared) -> [Variable; 2] {
    let variable = |name: &str, initial: i32, about: &str| {
        Variable::new(name, Basic::Dint).with_initial(Ex::Int(initial)).with_comment(about)
    };
    let late = shared.system.scan_ms.saturating_mul(LATE_INTERVALS);
    [
        variable(
            CLOCK,
            -1,
            "ms of the clock of the PLC, from 0 to 2147483647 and again from 0; -1: no clock",
        ),
        variable(
            LATE,
            late,
            "setting: greatest time between two scans, ms; if a scan comes later, the line stops",
        ),
    ]
}

pub fn instance() -> Instance {
    Instance { name: INSTANCE.into(), block: WATCHDOG.into(), comment: String::new(), is_retained: false }
}

/// In MAIN, before anything is decided in the scan.
pub fn call(shared: Shared) -> Vec<Stmt> {
    let interval = vec![("low", Ex::Int(1)), ("value", name("dt_ms")), ("high", Ex::Int(LONGEST))];
    let given = [
        ("cold_start", not(name("init_done"))),
        (NOW, name(CLOCK)),
        (INTERVAL, Ex::Call("F_limit", interval)),
        (LIMIT, name(LATE)),
        ("runs", name("running")),
        ("starts", name("start_now")),
    ];
    let output = |name: &str| Ex::Field(INSTANCE.into(), name.into());
    let code = || output(CODE);
    let raise = vec![assign("fault_code", code()), assign("fault_robot", Ex::Int(-1))];
    let stop =
        vec![assign("running", Ex::Bool(false)), when(binary("=", name("fault_code"), Ex::Int(0)), raise)];
    let mut statements = vec![
        Stmt::Call {
            instance: INSTANCE.into(),
            arguments: given.into_iter().map(|(name, value)| (name.into(), value)).collect(),
        },
        when(binary("<>", code(), Ex::Int(0)), stop),
    ];
    if modes::any(shared) {
        statements.push(assign(PANEL_PERMIT, and(vec![name("run_permit"), not(output(IS_LATE))])));
    }
    statements
}

/// The block.
pub fn block<'a>() -> Unit<'a> {
    let variable = |(name, about): (&str, &str)| Variable::new(name, Basic::Dint).with_comment(about);
    let truth = |name: &str, about: &str| Variable::new(name, Basic::Bool).with_comment(about);
    let inputs = [
        (NOW, "clock of the PLC: ms from 0 to 2147483647 and again from 0; -1: no clock"),
        (INTERVAL, "required interval of the task, ms"),
        (LIMIT, "greatest time between two scans, ms; a later scan is a fault"),
    ];
    Unit {
        name: WATCHDOG.into(),
        comments: vec!["Checks the interval of the task by the clock of the PLC.".into()],
        inputs: [truth("cold_start", "this is the first scan")]
            .into_iter()
            .chain(inputs.map(variable))
            .chain([truth("runs", "the line is running"), truth("starts", "a person starts it")])
            .collect(),
        outputs: [
            (CODE, "fault: 0 none, 32764 wrong interval of the task, 32765 a scan came late"),
            (PASSED, "ms since the scan before; -1: not known"),
            (HUNDRED, "ms that the last 100 scans took; -1: not measured"),
        ]
        .map(variable)
        .into_iter()
        .chain([truth(IS_LATE, "this scan came late")])
        .collect(),
        variables: [
            (BEFORE, "clock_ms in the scan before"),
            (MEASURED, "ms of the scans counted so far"),
            (SCANS, "number of these scans"),
        ]
        .map(variable)
        .into(),
        body: body().into(),
        ..Unit::default()
    }
}

fn body() -> Vec<Stmt> {
    let arm = |condition: Ex, body: Vec<Stmt>| Arm { comments: Vec::new(), condition, body };
    let is_known = |clock: &str| binary(">=", name(clock), Ex::Int(0));
    let since = binary("-", name(NOW), name(BEFORE));
    // The clock has begun again: 1 more than the sum.
    let until_end = binary("-", Ex::Int(i32::MAX), name(BEFORE));
    let around = binary("+", until_end, binary("+", name(NOW), Ex::Int(1)));
    let passed = Stmt::If(
        vec![arm(binary(">=", name(NOW), name(BEFORE)), vec![assign(PASSED, since)])],
        vec![assign(PASSED, around)],
    );
    let anew = || [assign(MEASURED, Ex::Int(0)), assign(SCANS, Ex::Int(0))];
    let mut first = vec![assign(BEFORE, Ex::Int(-1)), assign(HUNDRED, Ex::Int(-1))];
    first.extend(anew());
    let mut late = anew().to_vec();
    late.push(when(name("runs"), vec![assign(CODE, Ex::Int(LATE_SCAN))]));
    let mut whole = vec![assign(HUNDRED, name(MEASURED))];
    whole.extend(anew());
    let counted = vec![
        assign(MEASURED, binary("+", name(MEASURED), name(PASSED))),
        advance(SCANS),
        when(binary("=", name(SCANS), Ex::Int(WINDOW)), whole),
    ];
    let is_short = and(vec![is_known(PASSED), binary("<", name(PASSED), Ex::Int(LONGEST))]);
    let percent = |operator, percent| {
        binary(operator, name(HUNDRED), binary("*", name(INTERVAL), Ex::Int(WINDOW * percent / 100)))
    };
    let is_other = and(vec![
        binary("=", name(CODE), Ex::Int(0)),
        or(vec![name("runs"), name("starts")]),
        is_known(HUNDRED),
        or(vec![percent(">", 110), percent("<", 90)]),
    ]);
    vec![
        when(name("cold_start"), first),
        assign(CODE, Ex::Int(0)),
        assign(PASSED, Ex::Int(-1)),
        when(and(vec![is_known(NOW), is_known(BEFORE)]), vec![passed]),
        assign(BEFORE, name(NOW)),
        assign(IS_LATE, and(vec![is_known(PASSED), binary(">", name(PASSED), name(LIMIT))])),
        Stmt::If(vec![arm(name(IS_LATE), late), arm(is_short, counted)], Vec::new()),
        Stmt::Comment("The mean of a hundred scans, within 10 %.".into()),
        when(is_other, vec![assign(CODE, Ex::Int(WRONG_INTERVAL))]),
    ]
}
