//! The one table of devices and their ports.
//!
//! It feeds the simulator, the checker of the language and the I/O map. A port
//! is what a sensor or a drive of a real plant supplies; none carries what only
//! a simulator could know.
//!
//! Whatever moves is driven by numbered commands: the controller writes a
//! command's arguments, its `verb` and a new number `cmd` in one scan; the
//! device answers with the number it has accepted (`got`), the number it has
//! ended (`ack`) and an `error` (0: reached). While the output `hold` is true the
//! device halts on its path; it goes on with the same command when `hold` falls.
//!
//! A process image holds one number (`f64`) for each point of I/O: booleans as
//! 0 and 1, whole numbers, reals; a `point` takes three. Inputs and outputs of a
//! machine stand in the order of this table, arrays element by element.

/// A kind of device: its ports, the commands it obeys, the constants its place in the layout gives it.
#[derive(Debug, PartialEq)]
pub struct Device {
    pub name: &'static str,
    pub purpose: &'static str,
    pub ports: &'static [Port],
    /// Empty for a device that obeys no commands.
    pub verbs: &'static [Verb],
    pub constants: &'static [Constant],
    pub handovers: &'static [Handover],
}

#[derive(Debug, PartialEq)]
pub struct Port {
    pub name: &'static str,
    pub direction: Direction,
    pub ty: PortType,
    pub extent: Extent,
    pub unit: &'static str,
    /// What the port carries, and when it changes.
    pub meaning: &'static str,
    /// For outputs: what is published while the system does not run.
    pub stop: Stop,
}

/// Seen from the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    Input,
    Output,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PortType {
    Bool,
    Int { lo: i32, hi: i32 },
    Real,
    Point,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    One,
    /// One element for each kind of part.
    PerKind,
    Times(usize),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// The last value written stays.
    Hold,
    Value(f64),
}

/// A command: `verb` is set to `number`, the arguments to the named output ports.
#[derive(Debug, PartialEq)]
pub struct Verb {
    pub name: &'static str,
    pub number: i32,
    pub arguments: &'static [&'static str],
    pub meaning: &'static str,
}

/// A value that the layout fixes for a machine, readable in its automaton by name.
#[derive(Debug, PartialEq)]
pub struct Constant {
    pub name: &'static str,
    pub ty: PortType,
    pub extent: Extent,
    pub unit: &'static str,
    pub meaning: &'static str,
}

/// A place named behind `accepts at` or `offers at`.
#[derive(Debug, PartialEq)]
pub struct Handover {
    pub name: &'static str,
    /// Number of places, if one of several is meant by an index.
    pub indexed: Option<usize>,
}

impl PortType {
    /// Numbers that one value takes in a process image.
    pub const fn words(self) -> usize {
        match self {
            PortType::Point => 3,
            _ => 1,
        }
    }
}

impl Extent {
    /// Number of elements when there are `kinds` kinds of part.
    pub const fn elements(self, kinds: usize) -> usize {
        match self {
            Extent::One => 1,
            Extent::PerKind => kinds,
            Extent::Times(n) => n,
        }
    }
}

impl Port {
    /// Numbers that this port takes in a process image.
    pub const fn words(&self, kinds: usize) -> usize {
        self.ty.words() * self.extent.elements(kinds)
    }
}

impl Device {
    pub fn find(name: &str) -> Option<&'static Device> {
        DEVICES.iter().find(|d| d.name == name)
    }

    pub fn port(&self, name: &str) -> Option<&'static Port>
    where
        Self: 'static,
    {
        self.ports.iter().find(|p| p.name == name)
    }

    pub fn is_commanded(&self) -> bool {
        !self.verbs.is_empty()
    }

    /// Numbers of all ports of one direction in a process image.
    pub fn words(&self, direction: Direction, kinds: usize) -> usize {
        self.ports.iter().filter(|p| p.direction == direction).map(|p| p.words(kinds)).sum()
    }

    /// Where a port begins among the ports of its own direction.
    pub fn offset(&self, name: &str, kinds: usize) -> Option<usize> {
        let port = self.ports.iter().find(|p| p.name == name)?;
        Some(
            self.ports
                .iter()
                .filter(|p| p.direction == port.direction)
                .take_while(|p| p.name != name)
                .map(|p| p.words(kinds))
                .sum(),
        )
    }
}

/// Highest command number; the number after it is 1. 0 means that no command was given yet.
pub const LAST_COMMAND: i32 = 32767;

/// Answers of a device in `error`.
pub mod error {
    pub const NONE: i32 = 0;
    /// The goal, or a place to pass, has no inverse-kinematic solution within the limits.
    pub const UNREACHABLE: i32 = 1;
    /// The tool came to its goal and nothing was gripped.
    pub const NO_PART: i32 = 2;
    /// The device refused the command.
    pub const REFUSED: i32 = 3;
}

const fn input(
    name: &'static str,
    ty: PortType,
    extent: Extent,
    unit: &'static str,
    meaning: &'static str,
) -> Port {
    Port { name, direction: Direction::Input, ty, extent, unit, meaning, stop: Stop::Hold }
}

const fn output(
    name: &'static str,
    ty: PortType,
    unit: &'static str,
    meaning: &'static str,
    stop: Stop,
) -> Port {
    Port { name, direction: Direction::Output, ty, extent: Extent::One, unit, meaning, stop }
}

const READY: Port = input("ready", PortType::Bool, Extent::One, "", "the device is powered and enabled");
const GOT: Port = input(
    "got",
    PortType::Int { lo: 0, hi: LAST_COMMAND },
    Extent::One,
    "",
    "number of the last command accepted",
);
const ACK: Port = input(
    "ack",
    PortType::Int { lo: 0, hi: LAST_COMMAND },
    Extent::One,
    "",
    "number of the last command ended, reached or in error",
);
const ERROR: Port = input(
    "error",
    PortType::Int { lo: 0, hi: 255 },
    Extent::One,
    "",
    "0, or why the command `ack` ended: 1 unreachable, 2 no part, 3 refused; constant while `ack` is",
);
const CMD: Port = output(
    "cmd",
    PortType::Int { lo: 0, hi: LAST_COMMAND },
    "",
    "number of the last command; written in the same scan as its arguments",
    Stop::Hold,
);
const VERB: Port =
    output("verb", PortType::Int { lo: 0, hi: 9 }, "", "what the command `cmd` asks for", Stop::Hold);
const HOLD: Port = output(
    "hold",
    PortType::Bool,
    "",
    "halt on the path, keep the command; true while the system does not run",
    Stop::Value(1.0),
);
const GOAL: Port = output("goal", PortType::Point, "m", "where to go", Stop::Hold);
const GRIP: Port = output(
    "grip",
    PortType::Bool,
    "",
    "vacuum on; a gripper keeps holding while the system does not run",
    Stop::Hold,
);
const ATTACHED: Port = input(
    "attached",
    PortType::Bool,
    Extent::One,
    "",
    "a part hangs on the gripper; changes when it is gripped, let go or lost",
);
const TOOL: Port = input("tool", PortType::Point, Extent::One, "m", "tool centre point; moves with the arm");
const TOP_SPEED: Port =
    output("top_speed", PortType::Real, "", "part of full speed, above 0 to 1", Stop::Hold);
const GAIN: Port =
    output("gain", PortType::Real, "m/s2, rad/s2", "acceleration of every joint, above 0 to 100", Stop::Hold);
const VIA: Port = output("via", PortType::Point, "m", "where to pass on the way to `goal`", Stop::Hold);
const TURN: Port = output(
    "turn",
    PortType::Real,
    "rad",
    "turn of the torso, -2 pi to 2 pi; 0: the arm is on the side of +y; pi and -pi are different joint values",
    Stop::Hold,
);
const POINTS_12: Extent = Extent::Times(crate::geometry::SLOTS);

const HEIGHTS: Constant = Constant {
    name: "heights",
    ty: PortType::Real,
    extent: Extent::PerKind,
    unit: "m",
    meaning: "height of a part over what it lies on; the tool grips it there",
};
const REST: Constant = Constant {
    name: "rest",
    ty: PortType::Point,
    extent: Extent::One,
    unit: "m",
    meaning: "where the tool rests",
};
const MOVE: Verb =
    Verb { name: "move", number: 1, arguments: &["goal"], meaning: "tool to `goal`, all joints together" };
const PICK: Verb = Verb {
    name: "pick",
    number: 2,
    arguments: &["goal"],
    meaning: "tool to `goal`, then wait for the grip; ends when a part is attached, in error 2 if none is",
};
const PACE: Verb = Verb {
    name: "pace",
    number: 3,
    arguments: &["top_speed", "gain"],
    meaning: "limits of all later motions, until the next `pace`; before the first one they are 1 and 1; ends at once, in error 3 if a value is out of range or the arm moves: it brakes then, and the limits stay",
};
const TURN_TO: Verb = Verb {
    name: "turn_to",
    number: 4,
    arguments: &["goal", "turn"],
    meaning: "tool to `goal`, straight under the shoulder, with the torso at exactly `turn`; in error 1 where the rails or the reach forbid it",
};
const THROUGH: Verb = Verb {
    name: "through",
    number: 5,
    arguments: &["via", "goal"],
    meaning: "tool to `goal` past `via` without a stop: where the joints turn off, none is further than 0.05 m or rad from its value at `via`",
};
const TRAVEL: Verb = Verb {
    name: "travel",
    number: 6,
    arguments: &["via", "goal"],
    meaning: "tool to `via`, round what stands in the layout, and with the torso so that a `move` or `pick` from there to `goal` lowers the tool while the torso stands; straight as `move` where there is no such way",
};

pub const DEVICES: &[Device] = &[
    Device {
        name: "belt",
        purpose: "A conveyor belt with a camera over its pick zone.",
        ports: &[
            READY,
            GOT,
            ACK,
            ERROR,
            input("moving", PortType::Bool, Extent::One, "", "the belt is not at rest"),
            input(
                "sees",
                PortType::Bool,
                Extent::PerKind,
                "",
                "a part of that kind lies wholly in the pick zone; changes when one enters or the last one leaves",
            ),
            input(
                "seen_at",
                PortType::Point,
                Extent::PerKind,
                "m",
                "where the foremost part of that kind rests; of use while `sees`, constant while the belt stands",
            ),
            CMD,
            VERB,
            HOLD,
        ],
        verbs: &[
            Verb { name: "drive", number: 1, arguments: &[], meaning: "full speed; ends when it is reached" },
            Verb { name: "halt", number: 2, arguments: &[], meaning: "stop; ends when the belt stands" },
        ],
        constants: &[Constant {
            name: "pick_zone",
            ty: PortType::Point,
            extent: Extent::Times(2),
            unit: "m",
            meaning: "both ends of the pick zone, on the belt's surface",
        }],
        handovers: &[Handover { name: "pick_zone", indexed: None }],
    },
    Device {
        name: "vehicle",
        purpose: "A guided vehicle with a tray, between three stops.",
        ports: &[
            READY,
            GOT,
            ACK,
            ERROR,
            input("pos", PortType::Point, Extent::One, "m", "where the vehicle is; changes while it moves"),
            input(
                "at_stop",
                PortType::Int { lo: -1, hi: 2 },
                Extent::One,
                "",
                "number of the stop it stands at, -1 between stops",
            ),
            CMD,
            VERB,
            HOLD,
            GOAL,
        ],
        verbs: &[Verb {
            name: "move",
            number: 1,
            arguments: &["goal"],
            meaning: "go to `goal`, one of the stops",
        }],
        constants: &[
            Constant {
                name: "stops",
                ty: PortType::Point,
                extent: Extent::Times(3),
                unit: "m",
                meaning: "the start and both destinations",
            },
            Constant {
                name: "offsets",
                ty: PortType::Point,
                extent: POINTS_12,
                unit: "m",
                meaning: "the slots of the tray, from the vehicle's position",
            },
            Constant {
                name: "places",
                ty: PortType::Point,
                extent: POINTS_12,
                unit: "m",
                meaning: "the slots of the tray at the start",
            },
            Constant {
                name: "place",
                ty: PortType::Point,
                extent: Extent::One,
                unit: "m",
                meaning: "the start",
            },
        ],
        handovers: &[Handover { name: "stops", indexed: Some(3) }],
    },
    Device {
        name: "rail_arm",
        purpose: "A UR10 with a vacuum gripper on a rail.",
        ports: &[READY, GOT, ACK, ERROR, ATTACHED, TOOL, CMD, VERB, HOLD, GOAL, GRIP, TOP_SPEED, GAIN, VIA],
        verbs: &[MOVE, PICK, PACE, THROUGH],
        constants: &[REST, HEIGHTS],
        handovers: &[],
    },
    Device {
        name: "gantry",
        purpose: "A UR10 with a vacuum gripper under a torso that travels on two rails and turns.",
        ports: &[
            READY, GOT, ACK, ERROR, ATTACHED, TOOL, CMD, VERB, HOLD, GOAL, GRIP, TOP_SPEED, GAIN, VIA, TURN,
        ],
        verbs: &[MOVE, PICK, PACE, TURN_TO, THROUGH, TRAVEL],
        constants: &[REST, HEIGHTS],
        handovers: &[],
    },
    Device {
        name: "station",
        purpose: "An assembly station: a briefcase and the terminal of the order system.",
        ports: &[
            input(
                "order_open",
                PortType::Bool,
                Extent::One,
                "",
                "an order lies on the table; falls when its briefcase has been taken away",
            ),
            input(
                "order_parts",
                PortType::Int { lo: 0, hi: 12 },
                Extent::PerKind,
                "",
                "parts the order asks for; constant while `order_open`",
            ),
            input(
                "order_id",
                PortType::Int { lo: 0, hi: LAST_COMMAND },
                Extent::One,
                "",
                "number of the order, for reports",
            ),
            output(
                "complete",
                PortType::Bool,
                "",
                "asks for the briefcase to be taken away; until `order_open` falls",
                Stop::Hold,
            ),
        ],
        verbs: &[],
        constants: &[
            Constant {
                name: "places",
                ty: PortType::Point,
                extent: Extent::PerKind,
                unit: "m",
                meaning: "where a part of that kind rests in the briefcase",
            },
            Constant {
                name: "place",
                ty: PortType::Point,
                extent: Extent::One,
                unit: "m",
                meaning: "the station's position",
            },
        ],
        handovers: &[Handover { name: "places", indexed: None }],
    },
    Device {
        name: "bin",
        purpose: "A bin, or any table on which parts are put down.",
        ports: &[],
        verbs: &[],
        constants: &[
            Constant {
                name: "places",
                ty: PortType::Point,
                extent: POINTS_12,
                unit: "m",
                meaning: "places for parts, on the bin's floor",
            },
            Constant {
                name: "place",
                ty: PortType::Point,
                extent: Extent::One,
                unit: "m",
                meaning: "the bin's position",
            },
        ],
        handovers: &[Handover { name: "places", indexed: None }],
    },
];
