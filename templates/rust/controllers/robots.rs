//! The robots of this line: the values that the layout fixes for each, by type.

{%- for module in modules %}
pub mod {{ module }};
{%- endfor %}
