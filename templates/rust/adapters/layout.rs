//! Between process images or texts and the controllers.

use controllers::line;
use controllers::system::{System, SystemInputs, SystemOutputs};
{%- for robot in robots %}
use controllers::{{ robot.module }}::{{ robot.ty }};
{%- endfor %}

{%- for item in enums %}

impl Put for {{ item }} {
    const WORDS: usize = 1;

    fn put(self, words: &mut [f64]) {
        (self as i32).put(words);
    }
}

impl Read for {{ item }} {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        let ordinal: usize = reader.int()?;
        Self::ALL.get(ordinal).copied().ok_or_else(|| reader.error("no such member of {{ item }}"))
    }
}
{%- endfor %}
{%- for interface in interfaces %}

impl Put for {{ interface.reference }} {
    const WORDS: usize = 1;

    fn put(self, words: &mut [f64]) {
        words[0] = f64::from(self.0);
    }
}

impl Read for {{ interface.reference }} {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        Ok(Self(reader.int()?))
    }
}
{%- if !interface.parameters.is_empty() %}

impl Read for {{ interface.parameters_type }} {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        Ok(Self {
            {%- for name in interface.parameters %}
            {{ name }}: Read::read(reader)?,
            {%- endfor %}
        })
    }
}
{%- endif %}
{%- endfor %}
{%- for robot in robots %}

impl Latch for controllers::{{ robot.module }}::Inputs {
    fn latch({% if robot.inputs.is_empty() %}_{% else %}image{% endif %}: &mut Image) -> Self {
        Self {
            {%- for name in robot.inputs %}
            {{ name }}: Latch::latch(image),
            {%- endfor %}
        }
    }
}
{%- if let Some(outputs) = robot.outputs %}

fn outputs_of_{{ robot.module }}(outputs: controllers::{{ robot.module }}::Outputs) -> impl Put {
    {{ outputs }}
}
{%- endif %}

impl Read for controllers::{{ robot.module }}::Parameters<'static> {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        Ok(Self {
            name: Read::read(reader)?,
            {%- for name in robot.parameters %}
            {{ name }}: Read::read(reader)?,
            {%- endfor %}
        })
    }
}
{%- endfor %}

/// `alarm`, `alarm_code`, `alarm_robot`{% if !alarms %}: this line has none{% endif %}.
pub fn alarm({% if !alarms %}_{% endif %}outputs: &SystemOutputs) -> (bool, i32, i32) {
    {%- if alarms %}
    (outputs.alarm, outputs.alarm_code, outputs.alarm_robot)
    {%- else %}
    (false, 0, -1)
    {%- endif %}
}
{%- if alarms %}

impl Put for &Alarm {
    const WORDS: usize = 5;

    fn put(self, words: &mut [f64]) {
        self.active.with(self.acknowledged).with([self.count, self.first, self.last]).put(words);
    }
}
{%- endif %}

/// The inputs of a robot from its process image.
pub fn latch(robot: &mut Robot, image: &[f64]) {
    let image = &mut Image::new(image);
    match robot {
        {%- for robot in robots %}
        Robot::{{ robot.ty }}(robot) => robot.inputs = Latch::latch(image),
        {%- endfor %}
    }
}

/// How many numbers the image of its inputs has.
pub fn input_words(robot: &Robot) -> usize {
    match robot {
        {%- for robot in robots %}
        Robot::{{ robot.ty }}(_) => words_of::<controllers::{{ robot.module }}::Inputs>(),
        {%- endfor %}
    }
}

/// The process image of a robot's outputs.
pub fn publish(robot: &Robot, {% if !has_outputs %}_{% endif %}running: bool, image: &mut Vec<f64>) {
    image.clear();
    match robot {
        {%- for robot in robots %}
        {%- if robot.outputs.is_some() %}
        Robot::{{ robot.ty }}(robot) => outputs_of_{{ robot.module }}(robot.published(running)).append(image),
        {%- else %}
        Robot::{{ robot.ty }}(_) => {}
        {%- endif %}
        {%- endfor %}
    }
}

impl Read for Robot<'static> {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        Ok(match reader.name()? {
            {%- for robot in robots %}
            "{{ robot.keyword }}" => Self::{{ robot.ty }}({{ robot.ty }}::new(kept(reader)?)),
            {%- endfor %}
            other => return Err(reader.error(format_args!("`{other}` is not a type of robot"))),
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
    /// The values to which the other fields refer.
    pub kept: Kept,
}

impl Layout {
    /// The layout for which the controllers were made. Its robots and cells are copied one by one: all of a long line
    /// are more than a stack has.
    pub fn compiled() -> Self {
        let {% if has_cells %}mut {% endif %}kept = Kept::default();
        Self {
            wiring: line::WIRING,
            robots: line::ROBOTS.to_vec(),
            {%- if has_cells %}
            cells: Cells {
                {%- for interface in interfaces %}
                {%- if interface.has_cells %}
                {{ interface.field }}: Table::new(
                    kept.keep(line::MEMORY.{{ interface.field }}.to_vec()),
                    {{ interface.cells_type }}::NEW,
                ),
                {%- endif %}
                {%- endfor %}
            },
            {%- endif %}
            kept,
        }
    }

    /// Any layout of the same types and kinds, from text.
    pub fn read(reader: &mut Reader) -> Result<Self, String> {
        reader.expect("parameters")?;
        reader.expect("2")?;
        reader.expect("scan_ms")?;
        let scan_ms = reader.int()?;
        {%- if retains %}
        reader.expect("retained_of")?;
        let retained_of = reader.int()?;
        {%- endif %}
        {%- for interface in interfaces %}
        reader.expect("{{ interface.keyword }}")?;
        {%- if interface.parameters.is_empty() && interface.has_cells %}
        let rows_of_{{ interface.field }}: usize = reader.int()?;
        {%- else if interface.parameters.is_empty() %}
        reader.int::<usize>()?;
        {%- else %}
        let rows_of_{{ interface.field }}: Vec<{{ interface.parameters_type }}> = reader.list(Read::read)?;
        {%- endif %}
        {%- endfor %}
        {%- if has_cells %}
        let cells = Cells {
            {%- for interface in interfaces %}
            {%- if interface.has_cells %}
            {{ interface.field }}: Table::new(
                reader.kept.keep(rows(rows_of_{{ interface.field }}{% if !interface.parameters.is_empty() %}.len(){% endif %}, {{ interface.cells_type }}::NEW)),
                {{ interface.cells_type }}::NEW,
            ),
            {%- endif %}
            {%- endfor %}
        };
        {%- endif %}
        let wiring = Wiring {
            scan_ms,
            {%- if retains %}
            retained_of,
            {%- endif %}
            {%- for interface in interfaces %}
            {%- if !interface.parameters.is_empty() %}
            {{ interface.field }}: Rows::new(reader.kept.keep(rows_of_{{ interface.field }}), {{ interface.parameters_type }}::NONE),
            {%- endif %}
            {%- endfor %}
            {%- for relation in relations %}
            {{ relation.name }}: reader.relation("{{ relation.keyword }}")?,
            {%- endfor %}
        };
        reader.expect("robots")?;
        let robots = reader.list(Read::read)?;
        reader.expect("end")?;
        let kept = std::mem::take(&mut reader.kept);
        Ok(Self { wiring, robots{% if has_cells %}, cells{% endif %}, kept })
    }

    pub fn scan(&mut self, system: &mut System, inputs: SystemInputs) -> SystemOutputs {
        system.scan(inputs, &self.wiring, &mut self.robots{% if uses_cells %}, &mut self.cells{% endif %})
    }

    {%- if retains %}
    /// [`System::retain`] of these robots.
    pub fn retain(&self, system: &System, put: &mut dyn FnMut(f64)) {
        system.retain(&self.wiring, &self.robots, {% if has_cells %}&self.cells, {% endif %}put);
    }

    /// [`System::restore`] of these robots.
    pub fn restore(&mut self, system: &mut System, words: &mut dyn FnMut() -> Option<f64>) {
        system.restore(&self.wiring, &mut self.robots, {% if has_cells %}&mut self.cells, {% endif %}words);
    }

    {% endif %}
    /// Power was lost and is back: retained values are kept, all others are the initial ones.
    pub fn power_up(&mut self, system: &mut System) {
        {%- if retains %}
        let mut words = Vec::new();
        self.retain(system, &mut |word| words.push(word));
        let mut words = words.into_iter();
        self.restore(system, &mut || words.next());
        {%- else %}
        *system = System::new();
        for robot in &mut self.robots {
            robot.forget({% if has_cells %}&mut self.cells{% endif %});
        }
        {%- endif %}
    }

    pub fn skip(&mut self, system: &mut System, scans: u64) {
        system.skip(scans, &self.wiring, &mut self.robots);
    }

    /// The position of the time in the state within the trace, by robot.
    pub fn stays(&self) -> Vec<usize> {
        let mut trace = Vec::new();
        let mut stays = Vec::new();
        for robot in &self.robots {
            stays.push(trace.len() + 1);
            self.trace_of(robot, &mut trace);
        }
        stays
    }

    /// The state of all controllers: for each robot its state, the time in it, locals, own cells, outputs, alarms.
    pub fn trace(&self, out: &mut Vec<f64>) {
        self.robots.iter().for_each(|robot| self.trace_of(robot, out));
    }

    fn trace_of(&self, robot: &Robot, out: &mut Vec<f64>) {
        {%- if traces_cells %}
        let cells = &self.cells;
        {%- endif %}
        match robot {
            {%- for robot in robots %}
            Robot::{{ robot.ty }}(robot) => {{ robot.trace }}.append(out),
            {%- endfor %}
        }
    }
}
