//! The values that the layout fixes for each [`{{ ty }}`](crate::{{ module }}::{{ ty }}) of this line.

use crate::{{ module }}::Parameters;
{%- for robot in robots %}

/// `{{ robot.name }}`: number {{ robot.number }} in the order of the steps, as in `fault_robot`.
{%- for role in robot.roles %}
///
/// {{ role }}
{%- endfor %}
pub const {{ robot.constant }}: Parameters = Parameters {
    name: "{{ robot.name }}",
{% for field in robot.fields %}{{ field }}{% endfor %}};
{%- endfor %}
