//! What robots share: cells, which are written and read, and the parameters that each shows to others.
//!
//! Robots share data through interfaces. A reference is a row among the members of an interface, in layout order.

{%- for interface in interfaces %}

/// A `{{ interface.name }}` of the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct {{ interface.reference }}(pub u16);

impl Reference for {{ interface.reference }} {
    fn row(self) -> usize {
        usize::from(self.0)
    }
}
{%- if !interface.cells.is_empty() %}

{{ interface.doc }}
#[derive(Clone, Debug, PartialEq)]
pub struct {{ interface.cells_type }} {
    {%- for cell in interface.cells %}
    {{ cell.doc }}
    pub {{ cell.name }}: {{ cell.ty }},
    {%- endfor %}
}

impl {{ interface.cells_type }} {
    /// Their initial values.
    pub const NEW: Self = Self {
        {%- for cell in interface.cells %}
        {{ cell.name }}: {{ cell.initial }},
        {%- endfor %}
    };
}
{%- endif %}
{%- if !interface.parameters.is_empty() %}

/// What each `{{ interface.name }}` shows to others.
#[derive(Clone, Debug, PartialEq)]
pub struct {{ interface.parameters_type }} {
    {%- for parameter in interface.parameters %}
    {{ parameter.doc }}
    pub {{ parameter.name }}: {{ parameter.ty }},
    {%- endfor %}
}

impl {{ interface.parameters_type }} {
    /// The values for a robot that does not exist.
    pub const NONE: Self = Self {
        {%- for parameter in interface.parameters %}
        {{ parameter.name }}: {{ parameter.initial }},
        {%- endfor %}
    };
}
{%- endif %}
{%- endfor %}
{%- if has_cells %}

/// The cells of all robots; the caller owns them.
#[derive(Debug)]
pub struct Cells<'a> {
    {%- for interface in interfaces %}
    {%- if !interface.cells.is_empty() %}
    pub {{ interface.field }}: Table<'a, {{ interface.cells_type }}>,
    {%- endif %}
    {%- endfor %}
}
{%- endif %}

/// The values that a layout fixes in addition to the parameters of each robot.
#[derive(Clone, Debug)]
pub struct Wiring{% if has_wiring %}<'a>{% endif %} {
    /// Period of a scan.
    pub scan_ms: i32,
    {%- if retains %}
    /// Identifies the program and the layout of retained values.
    pub retained_of: u32,
    {%- endif %}
    {%- for interface in interfaces %}
    {%- if !interface.parameters.is_empty() %}
    pub {{ interface.field }}: Rows<'a, {{ interface.parameters_type }}>,
    {%- endif %}
    {%- endfor %}
    {%- for relation in relations %}
    {{ relation.doc }}
    pub {{ relation.name }}: Relation<'a>,
    {%- endfor %}
}
