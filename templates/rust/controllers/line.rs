//! This line: its robots, what they show to each other, and the storage of their cells.

use crate::robots;
{%- for (module, ty) in types %}
use crate::{{ module }}::{{ ty }};
{%- endfor %}

{%- for interface in interfaces %}
{%- if interface.has_parameters %}

static {{ interface.constant }}: [{{ interface.parameters_type }}; {{ interface.count }}] = [
    {%- for row in interface.rows %}
    {{ interface.parameters_type }} {
        {%- for (name, value) in row %}
        {{ name }}: {{ value }},
        {%- endfor %}
    },
    {%- endfor %}
];
{%- endif %}
{%- endfor %}

pub const WIRING: Wiring = Wiring {
    scan_ms: {{ scan_ms }},
    {%- if let Some(number) = retained_of %}
    retained_of: {{ number }},
    {%- endif %}
    {%- for interface in interfaces %}
    {%- if interface.has_parameters %}
    {{ interface.field }}: Rows::new(&{{ interface.constant }}, {{ interface.parameters_type }}::NONE),
    {%- endif %}
    {%- endfor %}
{% for relation in relations %}{{ relation }}{% endfor %}};

/// All robots, in the order in which they step, as at power-up.
///
/// They are `size_of::<[Robot; {{ robots.len() }}]>()` bytes, which of a long line are more than a stack has. A program without
/// a heap puts them into a `static`, which needs no stack, for example with the crate `static_cell`:
/// `static ROBOTS: ConstStaticCell<[Robot; {{ robots.len() }}]> = ConstStaticCell::new(line::robots());`
pub const fn robots() -> [Robot<'static>; {{ robots.len() }}] {
    [
        {%- for robot in robots %}
        Robot::{{ robot.ty }}({{ robot.ty }}::new(&robots::{{ robot.module }}::{{ robot.constant }})),
        {%- endfor %}
    ]
}

/// The same, for a program with a heap, into which it copies them.
pub static ROBOTS: [Robot<'static>; {{ robots.len() }}] = robots();
{%- if has_cells %}

/// Storage for the cells of all robots.
#[derive(Clone, Debug)]
pub struct Memory {
    {%- for interface in interfaces %}
    {%- if interface.has_cells %}
    pub {{ interface.field }}: [{{ interface.cells_type }}; {{ interface.count }}],
    {%- endif %}
    {%- endfor %}
}

impl Memory {
    /// The initial values of the cells.
    pub const NEW: Self = Self {
        {%- for interface in interfaces %}
        {%- if interface.has_cells %}
        {{ interface.field }}: [{{ interface.cells_type }}::NEW; {{ interface.count }}],
        {%- endif %}
        {%- endfor %}
    };

    pub fn cells(&mut self) -> Cells<'_> {
        Cells {
            {%- for interface in interfaces %}
            {%- if interface.has_cells %}
            {{ interface.field }}: Table::new(&mut self.{{ interface.field }}, {{ interface.cells_type }}::NEW),
            {%- endif %}
            {%- endfor %}
        }
    }
}

/// The initial values of the cells, for a program with a heap.
pub static MEMORY: Memory = Memory::NEW;
{%- endif %}
