//! The robots of this line: what the layout fixes for each.

{%- for module in modules %}
pub mod {{ module }};
{%- endfor %}
