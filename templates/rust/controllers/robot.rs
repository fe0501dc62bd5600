//! A robot of any type.

{%- for robot in robots %}
use crate::{{ robot.module }}::{{ robot.ty }};
{%- endfor %}

#[derive(Clone, Debug)]
pub enum Robot<'a> {
    {%- for robot in robots %}
    {{ robot.ty }}({{ robot.ty }}<'a>),
    {%- endfor %}
}

impl Robot<'_> {
    pub fn name(&self) -> &str {
        match self {
            {%- for robot in robots %}
            Self::{{ robot.ty }}(robot) => robot.parameters.name,
            {%- endfor %}
        }
    }
    {%- if limits_inputs %}

    /// Limits the inputs to the bounds that the devices declare.
    pub fn limit_inputs(&mut self) {
        match self {
            {%- for robot in robots %}
            {%- if robot.limits %}
            Self::{{ robot.ty }}(robot) => robot.inputs.limit(),
            {%- else %}
            Self::{{ robot.ty }}(_) => {}
            {%- endif %}
            {%- endfor %}
        }
    }
    {%- endif %}

    {%- if modes %}

    /// Evaluates the panel, before the step of every scan.
    pub fn operate(&mut self, permit: bool{{ operate_parameters }}) {
        match self {
            {%- for robot in robots %}
            Self::{{ robot.ty }}(robot) => robot.operate(permit{% if !robot.operate_arguments.is_empty() %}, {{ robot.operate_arguments }}{% endif %}),
            {%- endfor %}
        }
    }
    {%- endif %}

    /// Sets the initial values.
    pub fn forget(&mut self{{ forget_parameters }}) {
        match self {
            {%- for robot in robots %}
            Self::{{ robot.ty }}(robot) => robot.forget({{ robot.forget_arguments }}),
            {%- endfor %}
        }
    }
    {%- if retains %}

    /// Writes the retained values.
    pub fn retain(&self{{ retain_parameters }}, put: &mut dyn FnMut(f64)) {
        match self {
            {%- for robot in robots %}
            {%- if robot.retains %}
            Self::{{ robot.ty }}(robot) => robot.retain({{ robot.retain_arguments }}put),
            {%- else %}
            Self::{{ robot.ty }}(_) => {}
            {%- endif %}
            {%- endfor %}
        }
    }

    /// Begins with the retained values; `None` if the words are not those of such a robot.
    pub fn restore(&mut self{{ restore_parameters }}, words: &mut Words) -> Option<()> {
        match self {
            {%- for robot in robots %}
            {%- if robot.retains %}
            Self::{{ robot.ty }}(robot) => robot.restore({{ robot.retain_arguments }}words),
            {%- else %}
            Self::{{ robot.ty }}(_) => Some(()),
            {%- endif %}
            {%- endfor %}
        }
    }
    {%- endif %}

    pub fn step(&mut self, {{ step_parameters }}) -> Result<(), Fault> {
        match self {
            {%- for robot in robots %}
            Self::{{ robot.ty }}(robot) => robot.step({{ robot.step_arguments }}),
            {%- endfor %}
        }
    }
    {%- if properties %}

    /// Checks the properties, after the steps of every scan.
    pub fn properties(&{% if properties_change %}mut {% endif %}self, {{ properties_parameters }}) -> Result<(), Fault> {
        match self {
            {%- for robot in robots %}
            {%- if robot.has_properties %}
            Self::{{ robot.ty }}(robot) => robot.properties({{ robot.properties_arguments }}),
            {%- else %}
            Self::{{ robot.ty }}(_) => Ok(()),
            {%- endif %}
            {%- endfor %}
        }
    }
    {%- endif %}

    /// Adds so many milliseconds in which nothing happens.
    pub fn stay(&mut self, ms: i32) {
        match self {
            {%- for robot in robots %}
            {%- if robot.counts %}
            Self::{{ robot.ty }}(robot) => robot.stay(ms),
            {%- else %}
            Self::{{ robot.ty }}(robot) => robot.elapsed = robot.elapsed.saturating_add(ms),
            {%- endif %}
            {%- endfor %}
        }
    }

    {%- if alarms %}
    /// In the order of the text of its type.
    pub fn alarms(&self) -> &[Alarm] {
        match self {
            {%- for robot in robots %}
            {%- if robot.has_alarms %}
            Self::{{ robot.ty }}(robot) => &robot.alarms,
            {%- else %}
            Self::{{ robot.ty }}(_) => &[],
            {%- endif %}
            {%- endfor %}
        }
    }

    /// Acknowledges all its alarms.
    pub fn acknowledge(&mut self) {
        match self {
            {%- for robot in robots %}
            {%- if robot.has_alarms %}
            Self::{{ robot.ty }}(robot) => robot.alarms.iter_mut().for_each(|alarm| alarm.acknowledged = true),
            {%- else %}
            Self::{{ robot.ty }}(_) => {}
            {%- endif %}
            {%- endfor %}
        }
    }

    {% endif -%}
    /// The time in the present state begins anew{% if properties_change %}, and so do the stored values of properties{% endif %}.
    pub fn stay_anew(&mut self) {
        match self {
            {%- for robot in robots %}
            {%- if robot.begins_anew %}
            Self::{{ robot.ty }}(robot) => {
                robot.elapsed = 0;
                robot.observe_anew();
            }
            {%- else %}
            Self::{{ robot.ty }}(robot) => robot.elapsed = 0,
            {%- endif %}
            {%- endfor %}
        }
    }

    /// Number of the state it is in.
    pub fn state(&self) -> usize {
        match self {
            {%- for robot in robots %}
            Self::{{ robot.ty }}(robot) => robot.state as usize,
            {%- endfor %}
        }
    }
}
