//! The robots of this line: what the layout fixes for each, by types.

{%- for module in modules %}
pub mod {{ module }};
{%- endfor %}
