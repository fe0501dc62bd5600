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

    pub fn step(&mut self, {{ step_parameters }}) -> Result<(), Fault> {
        match self {
            {%- for robot in robots %}
            Self::{{ robot.ty }}(robot) => robot.step({{ robot.step_arguments }}),
            {%- endfor %}
        }
    }
    {%- if invariants %}

    /// What holds at the end of every scan.
    pub fn invariants(&self, {{ invariants_parameters }}) -> Result<(), Fault> {
        match self {
            {%- for robot in robots %}
            {%- if robot.has_invariants %}
            Self::{{ robot.ty }}(robot) => robot.invariants({{ robot.invariants_arguments }}),
            {%- else %}
            Self::{{ robot.ty }}(_) => Ok(()),
            {%- endif %}
            {%- endfor %}
        }
    }
    {%- endif %}

    /// So many milliseconds pass in which nothing happens.
    pub fn stay(&mut self, ms: i32) {
        match self {
            {%- for robot in robots %}
            Self::{{ robot.ty }}(robot) => robot.elapsed = robot.elapsed.saturating_add(ms),
            {%- endfor %}
        }
    }

    /// The time in the present state begins anew.
    pub fn stay_anew(&mut self) {
        match self {
            {%- for robot in robots %}
            Self::{{ robot.ty }}(robot) => robot.elapsed = 0,
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
