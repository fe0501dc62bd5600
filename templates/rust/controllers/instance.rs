//! `{{ name }}`: number {{ number }} in the order of the steps, as in `fault_robot`; of type [`{{ ty }}`](crate::{{ module }}::{{ ty }}).
{%- for role in roles %}
//!
//! {{ role }}
{%- endfor %}

use crate::{{ module }}::Parameters;

pub const PARAMETERS: Parameters = Parameters {
    name: "{{ name }}",
    {%- for (name, value) in fields %}
    {{ name }}: {{ value }},
    {%- endfor %}
};
