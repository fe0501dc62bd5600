//! Parts of machines: the primitives of which every device is composed.
//!
//! A primitive is a file here and a line in [`primitives!`]: what its settings are, which signals, levels and
//! actions it has, and how it behaves while a line runs. A machine is a list of parts, see [`crate::machine`].

mod operated;
mod running;
mod settings;
pub mod stroke;

pub use operated::Operated;
pub(crate) use running::milliseconds;
pub use running::{Begun, Gripper, Looks, Progress, Running, See, Start, World};
pub use settings::{Form, Setting, Settings, VERTICAL};

use crate::device::{Extent, PortType};
use crate::value::Value;
use crate::words::Words;
use stroke::Strokes;

/// What a primitive is made of, for whoever checks a device.
#[derive(Debug, PartialEq)]
pub struct Schema {
    pub name: &'static str,
    pub purpose: &'static str,
    pub settings: &'static [Setting],
    /// Frames that other parts may be fixed to, besides the part as a whole.
    pub frames: &'static [&'static str],
    pub signals: &'static [Signal],
    pub levels: &'static [Level],
    pub actions: &'static [Action],
    /// What a person does to it, as the scenario says.
    pub operated: Option<Operated>,
    /// It moves, and stands where it is while it jams.
    pub can_jam: bool,
}

/// What a controller may read of a part.
#[derive(Debug, PartialEq)]
pub struct Signal {
    pub name: &'static str,
    pub ty: PortType,
    pub extent: Extent,
}

/// What a controller sets in every scan.
#[derive(Debug, PartialEq)]
pub struct Level {
    pub name: &'static str,
    pub ty: PortType,
}

/// What a numbered command may ask of a part.
#[derive(Debug, PartialEq)]
pub struct Action {
    pub name: &'static str,
    pub arguments: &'static [PortType],
}

impl Schema {
    /// A primitive with settings alone.
    const fn new(name: &'static str, purpose: &'static str, settings: &'static [Setting]) -> Self {
        Self {
            name,
            purpose,
            settings,
            frames: &[],
            signals: &[],
            levels: &[],
            actions: &[],
            operated: None,
            can_jam: false,
        }
    }

    pub fn find(name: &str) -> Option<&'static Schema> {
        ALL.iter().copied().find(|schema| schema.name == name)
    }

    pub fn setting(&self, name: &str) -> Option<&'static Setting> {
        self.settings.iter().find(|setting| setting.name == name)
    }
}

/// What every primitive gives.
trait Described: Sized {
    /// An error says which setting is wrong.
    fn new(settings: &Settings) -> Result<Self, String>;

    /// The part at the start of a run; none for one that does nothing.
    fn start(&self, _start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(None)
    }
}

macro_rules! primitives {
    ($($module:ident :: $Type:ident),* $(,)?) => {
        $(pub mod $module;)*

        /// All primitives.
        pub const ALL: &[&Schema] = &[$(&$module::SCHEMA),*];

        /// What a part is.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Primitive {
            $($Type($module::$Type)),*
        }

        impl Primitive {
            fn new(name: &str, settings: &Settings) -> Result<Self, String> {
                match name {
                    $(name if name == $module::SCHEMA.name => {
                        Ok(Self::$Type(Described::new(settings)?))
                    })*
                    _ => Err(format!("`{name}` is no primitive")),
                }
            }

            /// The part at the start of a run; none for one that does nothing.
            pub(crate) fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
                match self {
                    $(Self::$Type(part) => part.start(start)),*
                }
            }

            fn schema(&self) -> &'static Schema {
                match self {
                    $(Self::$Type(_) => &$module::SCHEMA),*
                }
            }
        }
    };
}

primitives! {
    axis::Axis,
    beam::Beam,
    body::Body,
    button::Button,
    camera::Camera,
    chain::Chain,
    cylinder::Cylinder,
    display::Display,
    diverter::Diverter,
    gauge::Gauge,
    grip::Grip,
    lamp::Lamp,
    lane::Lane,
    material::Material,
    orders::Orders,
    place::Place,
    positioner::Positioner,
    process::Process,
    pusher::Pusher,
    route::Route,
    scanner::Scanner,
    selector::Selector,
    setpoint::Setpoint,
    sink::Sink,
    source::Source,
    stopper::Stopper,
    tank::Tank,
    track::Track,
    zone::Zone,
}

/// A part of a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Unlike that of every other part of the machine.
    pub name: String,
    pub settings: Settings,
    pub primitive: Primitive,
}

impl Part {
    /// An error says which setting is wrong.
    pub fn new(name: &str, primitive: &str, settings: Settings) -> Result<Self, String> {
        let primitive =
            Primitive::new(primitive, &settings).map_err(|error| format!("the part {name}: {error}"))?;
        Ok(Self { name: name.into(), settings, primitive })
    }

    pub fn schema(&self) -> &'static Schema {
        self.primitive.schema()
    }

    /// None for a part that moves no others along a stroke.
    pub fn strokes(&self) -> Option<Strokes> {
        match &self.primitive {
            Primitive::Cylinder(cylinder) => Some(cylinder.strokes()),
            Primitive::Positioner(positioner) => Some(positioner.strokes()),
            _ => None,
        }
    }

    /// Whether it moves, or moves other parts or items.
    pub(crate) fn moves(&self) -> bool {
        match self.primitive {
            Primitive::Axis(_)
            | Primitive::Chain(_)
            | Primitive::Cylinder(_)
            | Primitive::Diverter(_)
            | Primitive::Grip(_)
            | Primitive::Lane(_)
            | Primitive::Positioner(_)
            | Primitive::Pusher(_)
            | Primitive::Route(_)
            | Primitive::Stopper(_)
            | Primitive::Track(_) => true,
            Primitive::Beam(_)
            | Primitive::Body(_)
            | Primitive::Button(_)
            | Primitive::Camera(_)
            | Primitive::Display(_)
            | Primitive::Gauge(_)
            | Primitive::Lamp(_)
            | Primitive::Material(_)
            | Primitive::Orders(_)
            | Primitive::Place(_)
            | Primitive::Process(_)
            | Primitive::Scanner(_)
            | Primitive::Selector(_)
            | Primitive::Setpoint(_)
            | Primitive::Sink(_)
            | Primitive::Source(_)
            | Primitive::Tank(_)
            | Primitive::Zone(_) => false,
        }
    }

    /// None for a part of another primitive.
    pub fn axis(&self) -> Option<&axis::Axis> {
        match &self.primitive {
            Primitive::Axis(axis) => Some(axis),
            _ => None,
        }
    }

    /// Appends the words that [`Self::read`] reads back.
    pub fn write(&self, out: &mut String) {
        let settings = self.settings.all();
        out.push_str(&format!("{} {} {}", self.name, self.schema().name, settings.len()));
        for (name, value) in settings {
            out.push(' ');
            out.push_str(name);
            value.write(out);
        }
    }

    pub fn read(words: &mut Words) -> Result<Self, String> {
        let (name, primitive) = (words.name()?, words.name()?);
        let Some(schema) = Schema::find(primitive) else {
            return Err(words.error(format_args!("`{primitive}` is no primitive")));
        };
        let settings = words.list(|w| {
            let name = w.name()?;
            let Some(setting) = schema.setting(name) else {
                return Err(w.error(format_args!("a {primitive} has no setting `{name}`")));
            };
            Ok((setting.name, Value::read(w)?))
        })?;
        Self::new(name, primitive, Settings::new(settings)).map_err(|error| words.error(error))
    }
}
