//! {{ title }}
//!
{%- for line in about %}
//! {{ line }}
{%- endfor %}
//!
//! Device {{ device }}
//! This is not a safety function.

/// The values that the layout fixes for one of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters<'a> {
    pub name: &'a str,
    {%- for field in parameters %}
    {{ field.doc }}
    pub {{ field.name }}: {{ field.ty }},
    {%- endfor %}
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    {%- for state in states %}
    {{ state.doc }}
    {{ state.name }},
    {%- endfor %}
}
{%- if commands %}

/// The commands of the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verb {
    {%- for verb in verbs %}
    {{ verb.doc }}
    {{ verb.name }} = {{ verb.initial }},
    {%- endfor %}
}
{%- endif %}

/// The signals of the device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs {
    {%- for field in inputs %}
    {{ field.doc }}
    pub {{ field.name }}: {{ field.ty }},
    {%- endfor %}
}
{%- if !limits.is_empty() %}

impl Inputs {
    /// Limits whole numbers to the bounds that the device declares.
    pub fn limit(&mut self) {
        {%- for limit in limits %}
        {{ limit }}
        {%- endfor %}
    }
}
{%- endif %}

/// The outputs to the device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs {
    {%- for field in outputs %}
    {{ field.doc }}
    pub {{ field.name }}: {{ field.ty }},
    {%- endfor %}
}

impl Outputs {
    /// The values that are published while the system does not run.
    pub fn stopped(self) -> Self {
        {%- if stops.is_empty() %}
        self
        {%- else %}
        Self {
            {%- for stop in stops %}
            {{ stop }}
            {%- endfor %}
            {%- if !holds_all %}
            ..self
            {%- endif %}
        }
        {%- endif %}
    }
}

#[derive(Clone, Debug)]
pub struct {{ ty }}<'a> {
    pub parameters: &'a Parameters<'a>,
    pub inputs: Inputs,
    pub outputs: Outputs,
    pub state: State,
    /// Time in the present state, in ms.
    pub elapsed: i32,
    {%- for field in locals %}
    {{ field.doc }}
    pub {{ field.name }}: {{ field.ty }},
    {%- endfor %}
    {%- if !alarms.is_empty() %}
    /// In the order of the text.
    pub alarms: [Alarm; {{ alarms.len() }}],
    {%- endif %}
    {%- if can_stop %}
    /// An alarm{% if modes.is_some() %} or its panel{% endif %} has stopped it: it makes no steps, and its device is held.
    pub stopped: bool,
    {%- endif %}
}

impl<'a> {{ ty }}<'a> {
    pub const fn new(parameters: &'a Parameters<'a>) -> Self {
        Self {
            parameters,
            inputs: Inputs {
                {%- for field in inputs %}
                {{ field.name }}: {{ field.initial }},
                {%- endfor %}
            },
            outputs: Outputs {
                {%- for field in outputs %}
                {{ field.name }}: {{ field.initial }},
                {%- endfor %}
            },
            state: State::{{ first_state }},
            elapsed: 0,
            {%- for field in locals %}
            {{ field.name }}: {{ field.initial }},
            {%- endfor %}
            {%- if !alarms.is_empty() %}
            alarms: [{% for alarm in alarms %}{{ alarm }}, {% endfor %}],
            {%- endif %}
            {%- if can_stop %}
            stopped: false,
            {%- endif %}
        }
    }

    /// The first transition of the present state whose guard holds fires; at most one.
    pub fn step(&mut self, {{ step_parameters }}) -> Result<(), Fault> {
        {%- if can_stop %}
        if self.stopped {
            self.elapsed = 0;
            return Ok(());
        }
        {%- endif %}
        self.elapsed = self.elapsed.saturating_add(wiring.scan_ms);
        {%- if let Some(modes) = modes %}
        if !self.{{ modes.steps }} {
            return Ok(());
        }
        {%- endif %}
        match self.state {
            {%- for arm in arms %}
            {{ arm }}
            {%- endfor %}
        }
    }

    /// Sets the initial values.
    pub fn forget(&mut self{{ cells_parameter }}) {
        *self = Self::new(self.parameters);
        {%- for cells in own_cells %}
        {{ cells }}
        {%- endfor %}
    }
    {%- if let Some(retained) = retained %}

    /// Writes the retained values.
    pub fn retain(&self{{ retained.cells_read }}, put: &mut dyn FnMut(f64)) {
        {%- for statement in retained.put %}
        {{ statement }}
        {%- endfor %}
    }

    /// Begins with the retained values and initial values of all others; `None` if the words are not those of such a robot.
    pub fn restore(&mut self{{ retained.cells_write }}, words: &mut Words) -> Option<()> {
        {%- for statement in retained.take %}
        {{ statement }}
        {%- endfor %}
        Some(())
    }
    {%- endif %}
    {%- if let Some(modes) = modes %}

    /// Evaluates the panel, before the step of every scan.
    pub fn operate(&mut self, permit: bool{% if !modes.parameters.is_empty() %}, {{ modes.parameters }}{% endif %}) {
        {%- for statement in modes.operate %}
        {{ statement }}
        {%- endfor %}
    }

    /// As at power-up, except retained values and outputs that keep their values while it does not run.
    fn begin_anew(&mut self{% if !modes.parameters.is_empty() %}, {{ modes.parameters }}{% endif %}) {
        {%- for statement in modes.begin_anew %}
        {{ statement }}
        {%- endfor %}
    }
    {%- if let Some(is_single) = modes.is_single %}

    /// In single step no time limit is checked.
    fn is_single(&self) -> bool {
        {{ is_single }}
    }
    {%- endif %}
    {%- endif %}

    /// The outputs to the device in this scan.
    pub fn published(&self, running: bool) -> Outputs {
        {%- if let Some(modes) = modes %}
        let runs = running && !self.stopped && !self.{{ modes.moved_by_hand }};
        {% if modes.published.is_empty() %}if runs { self.outputs } else { self.outputs.stopped() }{% else %}
        let mut outputs = if runs { self.outputs } else { self.outputs.stopped() };
        {%- for statement in modes.published %}
        {{ statement }}
        {%- endfor %}
        outputs
        {%- endif %}
        {%- else if let Some(abandoned) = abandoned %}
        let mut outputs = if running{% if can_stop %} && !self.stopped{% endif %} { self.outputs } else { self.outputs.stopped() };
        outputs.hold |= self.{{ abandoned }};
        outputs
        {%- else %}
        if running{% if can_stop %} && !self.stopped{% endif %} { self.outputs } else { self.outputs.stopped() }
        {%- endif %}
    }
    {%- if !checks.body.is_empty() %}

    /// Checks the properties, after the steps of every scan{% if !masks.is_empty() %}. They see the outputs that are put out{% endif %}.
    pub fn properties(&{% if remembers %}mut {% endif %}self, {{ property_parameters }}) -> Result<(), Fault> {
        {%- for statement in checks.body %}
        {{ statement }}
        {%- endfor %}
    }
    {%- if !masks.is_empty() %}

    /// Sets the outputs that properties read to what is put out.
    fn put_out(&mut self) {
        let put = self.published(true);
        {%- for output in masks %}
        self.outputs.{{ output }} = put.{{ output }};
        {%- endfor %}
    }
    {%- endif %}
    {%- if let Some(others) = checks.others %}

    /// Checks the properties that do not stop it.
    fn check_others(&mut self{% if !others.parameters.is_empty() %}, {{ others.parameters }}{% endif %}) -> Result<(), Fault> {
        {%- for statement in others.statements %}
        {{ statement }}
        {%- endfor %}
        Ok(())
    }
    {%- endif %}
    {%- endif %}
    {%- if can_stop || !counters.is_empty() %}

    /// Adds so many milliseconds in which nothing happens.
    pub fn stay(&mut self, ms: i32) {
        {%- if can_stop %}
        if self.stopped {
            return;
        }
        {%- endif %}
        self.elapsed = self.elapsed.saturating_add(ms);
        {%- for counter in counters %}
        if self.{{ counter }} >= 0 {
            self.{{ counter }} = self.{{ counter }}.saturating_add(ms);
        }
        {%- endfor %}
    }
    {%- endif %}
    {%- if !anew.is_empty() %}

    /// Sets the initial values of the properties.
    pub fn observe_anew(&mut self) {
        {%- for statement in anew %}
        {{ statement }}
        {%- endfor %}
    }
    {%- endif %}
    {%- for method in methods %}

    {{ method }}
    {%- endfor %}
    {%- for define in defines %}

    {{ define }}
    {%- endfor %}

    fn enter(&mut self, state: State) {
        self.state = state;
        self.elapsed = 0;
    }
    {%- if commands %}

    /// Gives a command under a new number; its arguments have been written.
    fn command(&mut self, verb: Verb) {
        self.outputs.verb = verb as i32;
        self.outputs.cmd = next_command(self.outputs.cmd, self.inputs.got, self.inputs.ack);
        {%- if let Some(abandoned) = abandoned %}
        self.{{ abandoned }} = false;
        {%- if let Some(interrupted) = interrupted %}
        self.{{ interrupted }} = false;
        {%- endif %}
        {%- endif %}
    }
    {%- endif %}
    {%- if done %}

    /// The last command has ended successfully.
    fn command_done(&self) -> bool {
        {% if let Some(abandoned) = abandoned %}!self.{{ abandoned }} && {% endif %}self.outputs.cmd != 0 && self.inputs.ack == self.outputs.cmd && self.inputs.error == 0
    }
    {%- endif %}
    {%- if failed %}

    /// The last command has ended in error.
    fn command_failed(&self) -> bool {
        {% if let Some(interrupted) = interrupted %}self.{{ interrupted }} || {% endif %}{% if let Some(abandoned) = abandoned %}!self.{{ abandoned }} && {% endif %}self.outputs.cmd != 0 && self.inputs.ack == self.outputs.cmd && self.inputs.error != 0
    }
    {%- endif %}
}
