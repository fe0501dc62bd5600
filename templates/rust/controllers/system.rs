//! All controllers of the line in one scan.
//!
//! Inputs are latched, the robots step one after another in the order of the layout, then outputs are
//! published. After power-up nothing moves before a rising edge of `start`. This is not a safety function.

{% if alarms %}use crate::alarm::Alarm;
{% endif %}use crate::cells::{% if uses_cells || retains && has_cells %}{Cells, Wiring}{% else %}Wiring{% endif %};
{% if retains %}use crate::retained::{Retained, UNCHECKED, Words, check, check_word};
{% endif %}use crate::robot::Robot;
use crate::types::Fault;

/// Inputs of the system as a whole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SystemInputs {
    /// False when the emergency stop has acted or the fieldbus is lost.
    pub run_permit: bool,
    /// Starts the line on its rising edge.
    pub start: bool,
    /// {% if alarms %}Acknowledges all alarms, and clears{% else %}Clears{% endif %} a fault on its rising edge; all values are kept, and the time in each state begins anew.
    pub reset: bool,
}

/// Outputs of the system as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SystemOutputs {
    pub running: bool,
    pub fault: bool,
    /// 0 without a fault.
    pub fault_code: i32,
    /// Number of the robot that raised the fault, from 0 in layout order; -1 if there is none.
    pub fault_robot: i32,
    {%- if alarms %}
    /// An alarm is active, or not acknowledged.
    pub alarm: bool,
    /// Code of the first raised alarm that is not acknowledged, or else of those that are active; 0 if there is none.
    pub alarm_code: i32,
    /// Number of the robot that raised it; -1 if there is none.
    pub alarm_robot: i32,
    {%- endif %}
}

/// The state of the system from scan to scan, without robots and cells.
#[derive(Clone, Debug)]
pub struct System {
    running: bool,
    /// The first fault, and the robot that raised it.
    fault: Option<(Fault, usize)>,
    start_before: bool,
    reset_before: bool,
    {%- if alarms %}
    /// Scans since power-up; stops at its greatest value.
    scan: i32,
    {%- endif %}
}

impl System {
    pub const fn new() -> Self {
        Self { running: false, fault: None, start_before: true, reset_before: true{% if alarms %}, scan: 0{% endif %} }
    }

    pub fn fault(&self) -> Option<Fault> {
        self.fault.map(|(fault, _)| fault)
    }

    /// One scan. The caller has written the inputs of the robots, and publishes the result of
    /// `published` of each robot, which depends on whether the system runs.
    pub fn scan(
        &mut self,
        inputs: SystemInputs,
        wiring: &Wiring,
        robots: &mut [Robot],
        {%- if uses_cells %}
        cells: &mut Cells,
        {%- endif %}
    ) -> SystemOutputs {
        {%- if limits_inputs %}
        for robot in robots.iter_mut() {
            robot.limit_inputs();
        }
        {%- endif %}
        let faulted_before = self.fault.is_some();
        {%- if alarms %}
        let reset = inputs.reset && !self.reset_before;
        if reset {
            robots.iter_mut().for_each(Robot::acknowledge);
        }
        if reset && self.fault.take().is_some() {
        {%- else %}
        if inputs.reset && !self.reset_before && self.fault.take().is_some() {
        {%- endif %}
            robots.iter_mut().for_each(Robot::stay_anew);
        }
        let start = inputs.start && !self.start_before;
        self.start_before = inputs.start;
        self.reset_before = inputs.reset;
        if !inputs.run_permit || self.fault.is_some() {
            self.running = false;
        } else if start && !faulted_before {
            self.running = true;
        }
        {%- if modes %}
        if let Err(fault) = run(inputs.run_permit, self.running, {% else %}
        if self.running
            && let Err(fault) = run({% endif %}wiring, robots{% if uses_cells %}, cells{% endif %}{% if scan %}, self.scan{% endif %}{% if start %}, start{% endif %})
        {
            self.fault = Some(fault);
            self.running = false;
        }
        {%- if alarms %}
        self.scan = self.scan.saturating_add(1);
        let first = first_alarm(robots);
        {%- endif %}
        SystemOutputs {
            running: self.running,
            fault: self.fault.is_some(),
            fault_code: self.fault.map_or(0, |(fault, _)| fault.code),
            fault_robot: self.fault.map_or(-1, |(_, robot)| robot as i32),
            {%- if alarms %}
            alarm: first.is_some(),
            alarm_code: first.map_or(0, |(alarm, _)| alarm.cause.code),
            alarm_robot: first.map_or(-1, |(_, robot)| robot as i32),
            {%- endif %}
        }
    }

    /// Replaces so many scans in which nothing happens: no input that a state reads changes, and no timer expires. The
    /// comment of every state says what it reads. A controller does not need this; it saves time in a simulator.
    pub fn skip(&{% if alarms %}mut {% endif %}self, scans: u64, wiring: &Wiring, robots: &mut [Robot]) {
        {%- if alarms %}
        self.scan = self.scan.saturating_add(i32::try_from(scans).unwrap_or(i32::MAX));
        {%- endif %}
        if self.running {
            let passed = i32::try_from(scans).unwrap_or(i32::MAX).saturating_mul(wiring.scan_ms);
            robots.iter_mut().for_each(|robot| robot.stay(passed));
        }
    }
}

{%- if retains %}
/// The fault with which the line begins if the retained values are not of this line, or not of one scan: it has its
/// initial values.
pub const NOT_RETAINED: i32 = 32766;

impl System {
    /// Writes the retained values of one scan: the number of the line, the values, and a check of all words before it.
    pub fn retain(
        &self,
        wiring: &Wiring,
        robots: &[Robot],
        {%- if has_cells %}
        cells: &Cells,
        {%- endif %}
        put: &mut dyn FnMut(f64),
    ) {
        let mut sum = UNCHECKED;
        let checked: &mut dyn FnMut(f64) = &mut |word| {
            sum = check(sum, word);
            put(word);
        };
        checked(f64::from(wiring.retained_of));
        self.fault.map_or(0, |(fault, _)| fault.code).put(checked);
        self.fault.map_or(-1, |(_, robot)| robot as i32).put(checked);
        for robot in robots {
            robot.retain({% if has_cells %}cells, {% endif %}checked);
        }
        put(check_word(sum));
    }

    /// Begins after power-up with the retained values; all others are the initial ones, whatever happened before. Without
    /// words, or if all that [`System::retain`] writes are 0, nothing was ever retained: all values are the initial ones. If
    /// the words are not those of this line or not of one scan, the fault [`NOT_RETAINED`] is added: a person clears the
    /// machines, then resets.
    pub fn restore(
        &mut self,
        wiring: &Wiring,
        robots: &mut [Robot],
        {%- if has_cells %}
        cells: &mut Cells,
        {%- endif %}
        words: &mut Words,
    ) {
        self.forget(robots{% if has_cells %}, cells{% endif %});
        let Some(first) = words() else { return };
        let is_restored = match first == 0.0 {
            true => self.are_blank(wiring, robots{% if has_cells %}, cells{% endif %}, words),
            false => self.restored(first, wiring, robots{% if has_cells %}, cells{% endif %}, words).is_some(),
        };
        if !is_restored {
            self.forget(robots{% if has_cells %}, cells{% endif %});
            self.fault = Some((Fault::new(NOT_RETAINED, "the retained values are not of this line or not of one scan"), usize::MAX));
        }
    }

    /// Sets the initial values.
    fn forget(&mut self, robots: &mut [Robot]{% if has_cells %}, cells: &mut Cells{% endif %}) {
        *self = Self::new();
        robots.iter_mut().for_each(|robot| robot.forget({% if has_cells %}cells{% endif %}));
    }

    /// Behind a first word that is 0, all others are 0, and there are as many as are retained.
    fn are_blank(
        &self,
        wiring: &Wiring,
        robots: &[Robot],
        {%- if has_cells %}
        cells: &Cells,
        {%- endif %}
        words: &mut Words,
    ) -> bool {
        let mut count = 0;
        self.retain(wiring, robots, {% if has_cells %}cells, {% endif %}&mut |_| count += 1);
        (1..count).all(|_| words() == Some(0.0)) && words().is_none()
    }

    /// Nothing, if the words are not those that the line retained in one scan.
    fn restored(
        &mut self,
        first: f64,
        wiring: &Wiring,
        robots: &mut [Robot],
        {%- if has_cells %}
        cells: &mut Cells,
        {%- endif %}
        words: &mut Words,
    ) -> Option<()> {
        if first != f64::from(wiring.retained_of) {
            return None;
        }
        let mut sum = check(UNCHECKED, first);
        let checked: &mut Words = &mut || {
            let word = words()?;
            sum = check(sum, word);
            Some(word)
        };
        let (code, robot) = (i32::take(checked)?, i32::take(checked)?);
        if code != 0 {
            let number = usize::try_from(robot).unwrap_or(usize::MAX);
            self.fault = Some((Fault::new(code, "the fault was present when power was lost"), number));
        }
        for robot in robots {
            robot.restore({% if has_cells %}cells, {% endif %}checked)?;
        }
        (words()? == check_word(sum) && words().is_none()).then_some(())
    }
}

{% endif -%}
impl Default for System {
    fn default() -> Self {
        Self::new()
    }
}

{%- if alarms %}
/// The first raised alarm that is not acknowledged, or else of those that are active, and its robot.
fn first_alarm<'a>(robots: &'a [Robot]) -> Option<(&'a Alarm, usize)> {
    let robots = robots.iter().enumerate();
    let alarms = robots.flat_map(|(number, robot)| robot.alarms().iter().map(move |alarm| (alarm, number)));
    alarms.filter(|(alarm, _)| alarm.is_open()).min_by_key(|(alarm, _)| (alarm.acknowledged, alarm.last))
}

{% endif -%}
{% if modes %}/// The panel and a step of each robot, in turn; no steps after the first fault.
fn run(
    permit: bool,
    running: bool,
{%- else %}/// A step of each robot, up to the first fault.
fn run(
{%- endif %}
    wiring: &Wiring,
    robots: &mut [Robot],
    {%- if uses_cells %}
    cells: &mut Cells,
    {%- endif %}
    {%- if scan %}
    scan: i32,
    {%- endif %}
    {%- if start %}
    start: bool,
    {%- endif %}
) -> Result<(), (Fault, usize)> {
    {%- if modes %}
    let mut so_far = Ok(());
    for (number, robot) in robots.iter_mut().enumerate() {
        robot.operate(permit{% if operate_writes_cells %}, cells{% endif %});
        if running && so_far.is_ok() {
            so_far = robot.step(wiring{% if uses_cells %}, cells{% endif %}).map_err(|fault| (fault, number));
        }
    }
    so_far?;
    if !running {
        return Ok(());
    }
    {%- else %}
    for (number, robot) in robots.iter_mut().enumerate() {
        robot.step(wiring{% if uses_cells %}, cells{% endif %}).map_err(|fault| (fault, number))?;
    }
    {%- endif %}
    {%- if properties %}
    for (number, robot) in robots.iter{% if properties_change %}_mut{% endif %}().enumerate() {
        robot.properties({{ properties_arguments }}).map_err(|fault| (fault, number))?;
    }
    {%- endif %}
    Ok(())
}
