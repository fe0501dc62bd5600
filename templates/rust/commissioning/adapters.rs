//! Between process images or texts and the controllers.

use controllers::system::{System, SystemInputs, SystemOutputs};
{%- for robot in robots %}
use controllers::{{ robot.module }}::{self, {{ robot.ty }}};
{%- endfor %}
use runtime_sim::words::Words;

{%- for item in enums %}

impl Put for {{ item }} {
    fn put(self, out: &mut Vec<f64>) {
        (self as i32).put(out);
    }
}

impl Read for {{ item }} {
    fn read(words: &mut Words) -> Result<Self, String> {
        let ordinal: usize = words.int()?;
        Self::ALL.get(ordinal).copied().ok_or_else(|| words.error("no such member of {{ item }}"))
    }
}
{%- endfor %}
{%- for interface in interfaces %}

impl Put for {{ interface.reference }} {
    fn put(self, out: &mut Vec<f64>) {
        out.push(f64::from(self.0));
    }
}

impl Read for {{ interface.reference }} {
    fn read(words: &mut Words) -> Result<Self, String> {
        Ok(Self(words.int()?))
    }
}
{%- if !interface.parameters.is_empty() %}

impl Read for {{ interface.parameters_type }} {
    fn read(words: &mut Words) -> Result<Self, String> {
        Ok(Self {
            {%- for name in interface.parameters %}
            {{ name }}: Read::read(words)?,
            {%- endfor %}
        })
    }
}
{%- endif %}
{%- endfor %}
{%- for robot in robots %}

impl Latch for {{ robot.module }}::Inputs {
    fn latch({% if robot.inputs.is_empty() %}_{% else %}image{% endif %}: &mut Image) -> Self {
        Self {
            {%- for name in robot.inputs %}
            {{ name }}: Latch::latch(image),
            {%- endfor %}
        }
    }
}

impl Put for {{ robot.module }}::Outputs {
    fn put(self, {% if robot.outputs.is_empty() %}_{% else %}out{% endif %}: &mut Vec<f64>) {
        {%- for name in robot.outputs %}
        self.{{ name }}.put(out);
        {%- endfor %}
    }
}

impl Read for {{ robot.module }}::Parameters<'static> {
    fn read(words: &mut Words) -> Result<Self, String> {
        Ok(Self {
            name: Read::read(words)?,
            {%- for name in robot.parameters %}
            {{ name }}: Read::read(words)?,
            {%- endfor %}
        })
    }
}
{%- endfor %}

/// The inputs of a robot from its process image.
pub fn latch(robot: &mut Robot, image: &[f64]) {
    let image = &mut Image::new(image);
    match robot {
        {%- for robot in robots %}
        Robot::{{ robot.ty }}(robot) => robot.inputs = Latch::latch(image),
        {%- endfor %}
    }
}

/// The process image of a robot's outputs.
pub fn publish(robot: &Robot, running: bool, image: &mut Vec<f64>) {
    image.clear();
    match robot {
        {%- for robot in robots %}
        Robot::{{ robot.ty }}(robot) => robot.published(running).put(image),
        {%- endfor %}
    }
}

impl Read for Robot<'static> {
    fn read(words: &mut Words) -> Result<Self, String> {
        Ok(match words.name()? {
            {%- for robot in robots %}
            "{{ robot.keyword }}" => Self::{{ robot.ty }}({{ robot.ty }}::new(leak(Read::read(words)?))),
            {%- endfor %}
            other => return Err(words.error(format_args!("`{other}` is no type of robot"))),
        })
    }
}

/// A layout in memory.
pub struct Layout {
    pub wiring: Wiring{% if has_wiring %}<'static>{% endif %},
    pub robots: Vec<Robot<'static>>,
    {%- if has_cells %}
    pub cells: Cells<'static>,
    {%- endif %}
}

impl Layout {
    /// The layout for which the controllers were made.
    pub fn compiled() -> Self {
        Self {
            wiring: controllers::line::WIRING,
            robots: controllers::line::robots().into(),
            {%- if has_cells %}
            cells: leak(controllers::line::Memory::NEW).cells(),
            {%- endif %}
        }
    }

    /// Any layout of the same types and kinds, from text.
    pub fn read(words: &mut Words) -> Result<Self, String> {
        words.expect("parameters")?;
        words.expect("1")?;
        words.expect("scan_ms")?;
        let scan_ms = words.int()?;
        {%- for interface in interfaces %}
        words.expect("{{ interface.keyword }}")?;
        {%- if interface.parameters.is_empty() && interface.has_cells %}
        let {{ interface.field }}: usize = words.int()?;
        {%- else if interface.parameters.is_empty() %}
        words.int::<usize>()?;
        {%- else %}
        let {{ interface.field }}: Vec<{{ interface.parameters_type }}> = words.list(Read::read)?;
        {%- endif %}
        {%- endfor %}
        {%- if has_cells %}
        let cells = Cells {
            {%- for interface in interfaces %}
            {%- if interface.has_cells %}
            {{ interface.field }}: Table::new(
                leak(rows({{ interface.field }}{% if !interface.parameters.is_empty() %}.len(){% endif %}, {{ interface.cells_type }}::NEW)),
                {{ interface.cells_type }}::NEW,
            ),
            {%- endif %}
            {%- endfor %}
        };
        {%- endif %}
        let wiring = Wiring {
            scan_ms,
            {%- for interface in interfaces %}
            {%- if !interface.parameters.is_empty() %}
            {{ interface.field }}: Rows::new(leak({{ interface.field }}), {{ interface.parameters_type }}::NONE),
            {%- endif %}
            {%- endfor %}
            {%- for relation in relations %}
            {{ relation.name }}: relation(words, "{{ relation.keyword }}")?,
            {%- endfor %}
        };
        words.expect("robots")?;
        let robots = words.list(Read::read)?;
        words.expect("end")?;
        Ok(Self { wiring, robots{% if has_cells %}, cells{% endif %} })
    }

    pub fn scan(&mut self, system: &mut System, inputs: SystemInputs) -> SystemOutputs {
        system.scan(inputs, &self.wiring, &mut self.robots{% if uses_cells %}, &mut self.cells{% endif %})
    }

    /// All that the controllers remember: for each robot state, time in it, locals, own cells, outputs.
    pub fn trace(&self, out: &mut Vec<f64>) {
        {%- if has_cells %}
        let cells = &self.cells;
        {%- endif %}
        for robot in &self.robots {
            match robot {
                {%- for robot in robots %}
                Robot::{{ robot.ty }}(robot) => {
                    (robot.state as i32).put(out);
                    robot.elapsed.put(out);
                    {%- for local in robot.locals %}
                    robot.{{ local }}.put(out);
                    {%- endfor %}
                    {%- for cell in robot.cells %}
                    {{ cell }}.put(out);
                    {%- endfor %}
                    robot.outputs.put(out);
                }
                {%- endfor %}
            }
        }
    }
}
