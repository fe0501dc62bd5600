//! A gripper: vacuum or fingers.

use super::place::OPPOSITE;
use super::running::milliseconds;
use super::settings::{Form, Setting, Settings};
use super::{Described, Gripper, Level, Looks, Progress, Running, Schema, See, Signal, Start, World};
use crate::carrier::Carrier;
use crate::device::{Extent, PortType};
use crate::kinematics::arm::direction_of;
use crate::kinematics::pose::Pose;
use crate::point::Point;

/// The first signal: an item hangs on it.
pub const HOLDS: usize = 0;

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "holds", ty: PortType::Bool, extent: Extent::One },
        Signal { name: "is_open", ty: PortType::Bool, extent: Extent::One },
    ],
    levels: &[Level { name: "close", ty: PortType::Bool }],
    ..Schema::new(
        "grip",
        "A gripper at the tool of a chain. With `period` and `looks` it is a vacuum gripper: it attaches an item after `looks` consecutive checks with contact. With `closes`, `opens` and `sure_after` it has fingers: they hold the item between them `closes` after they begin to close, and the gripper reports this `sure_after` later; they release it when they begin to open.",
        &[
            Setting::new("on", Form::Part(&["chain"]), "", "the chain whose tool it is"),
            Setting::new("period", Form::Positive, "ms", "time between two checks for contact").optional(),
            Setting::new(
                "looks",
                Form::Positive,
                "",
                "consecutive checks with contact before an item is attached",
            )
            .optional(),
            Setting::new("closes", Form::Positive, "ms", "from open fingers to an item between them").optional(),
            Setting::new("opens", Form::Positive, "ms", "from an item between the fingers to open fingers").optional(),
            Setting::new("sure_after", Form::Number, "ms", "from an item between the fingers to the report").optional(),
            Setting::new(
                "near",
                Form::Positive,
                "m",
                "greatest distance of the tool from the grip point of an item that is a contact",
            ),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Grip {
    pub chain: usize,
    pub kind: Kind,
    pub near: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Vacuum {
        period_ms: u64,
        looks: u32,
    },
    /// From the beginning until an item is held, and from then until it is reported; until they are open.
    Fingers {
        closes_ms: u64,
        sure_ms: u64,
        opens_ms: u64,
    },
}

impl Described for Grip {
    fn new(settings: &Settings) -> Result<Self, String> {
        let given = |names: &[&str]| names.iter().filter(|name| settings.has(name)).count();
        let kind = match (given(&["period", "looks"]), given(&["closes", "opens", "sure_after"])) {
            (2, 0) => {
                let (period_ms, looks) = (settings.milliseconds("period")?, settings.positive("looks")?);
                if period_ms == 0 || looks.fract() != 0.0 {
                    return Err("the settings period and looks are whole numbers over 0".into());
                }
                Kind::Vacuum { period_ms, looks: looks as u32 }
            }
            (0, 3) => Kind::Fingers {
                closes_ms: settings.milliseconds("closes")?,
                sure_ms: settings.milliseconds("sure_after")?,
                opens_ms: settings.milliseconds("opens")?,
            },
            _ => return Err("a gripper has period and looks, or closes, opens and sure_after".into()),
        };
        Ok(Self { chain: settings.part("on")?, kind, near: settings.positive("near")? })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let slips = start.line.scenario.slips.iter().filter(|slip| slip.machine == start.machine);
        let slips = slips.map(|slip| Slip { pick: slip.pick, after_ms: milliseconds(slip.after_s) });
        Ok(Some(Box::new(Gripping::new(self, slips.collect()))))
    }
}

/// A gripper at work.
#[derive(Clone, Debug)]
pub struct Gripping {
    grip: Grip,
    close: Close,
    /// Since when it is on or off, and what it was when that was noted.
    since: (u64, Close),
    now_ms: u64,
    looks: u32,
    held: Option<usize>,
    let_go: Option<usize>,
    slips: Vec<Slip>,
    loses_at_ms: Option<u64>,
}

/// The item that the arm picks as number `pick`, from 1, falls so long after it was attached, or with fingers, after that
/// was reported.
#[derive(Clone, Copy, Debug)]
pub struct Slip {
    pub pick: u32,
    pub after_ms: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Close {
    On,
    Off,
}

impl Gripping {
    pub fn new(grip: &Grip, slips: Vec<Slip>) -> Self {
        Self {
            grip: grip.clone(),
            close: Close::Off,
            since: (0, Close::Off),
            now_ms: 0,
            looks: 0,
            held: None,
            let_go: None,
            slips,
            loses_at_ms: None,
        }
    }

    fn is_open(&self) -> bool {
        let opens_ms = match self.grip.kind {
            Kind::Vacuum { .. } => 0,
            Kind::Fingers { opens_ms, .. } => opens_ms,
        };
        self.since.1 == Close::Off && (self.since.0 == 0 || self.now_ms >= self.since.0 + opens_ms)
    }

    /// How long after an item is held this is reported, ms.
    fn sure_ms(&self) -> u64 {
        match self.grip.kind {
            Kind::Vacuum { .. } => 0,
            Kind::Fingers { sure_ms, .. } => sure_ms,
        }
    }

    fn reports(&self) -> bool {
        let is_sure = match self.grip.kind {
            Kind::Vacuum { .. } => true,
            Kind::Fingers { closes_ms, sure_ms, .. } => self.now_ms >= self.since.0 + closes_ms + sure_ms,
        };
        self.held.is_some() && is_sure
    }

    fn lose(&mut self) -> Option<usize> {
        self.loses_at_ms = None;
        self.held.take()
    }
}

impl Running for Gripping {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn level(&mut self, _level: usize, value: &[f64]) {
        if value[0] != 0.0 {
            self.close = Close::On;
        } else {
            self.close = Close::Off;
            self.looks = 0;
            self.let_go = self.lose();
        }
    }

    fn let_go(&mut self) -> Option<usize> {
        self.let_go.take()
    }

    fn slip(&mut self, next_ms: u64) -> Option<usize> {
        let due = self.loses_at_ms?;
        if next_ms < due {
            return None;
        }
        self.lose()
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        if self.since.1 != self.close {
            self.since = (world.now_ms, self.close);
        }
        self.now_ms = world.next_ms();
        Progress::Going
    }

    fn seeks(&self, see: &See, now_ms: u64, next_ms: u64) -> Option<(Pose, f64)> {
        let looks = self.close == Close::On
            && self.held.is_none()
            && match self.grip.kind {
                Kind::Vacuum { period_ms, .. } => now_ms / period_ms != next_ms / period_ms,
                Kind::Fingers { closes_ms, .. } => {
                    (now_ms + 1..=next_ms).contains(&(self.since.0 + closes_ms))
                }
            };
        looks.then(|| Some((see.tool(self.grip.chain)?, self.grip.near))).flatten()
    }

    fn meets(&mut self, item: Option<usize>, pick: u32, now_ms: u64, next_ms: u64) -> Option<usize> {
        let Some(item) = item else {
            self.looks = 0;
            return None;
        };
        if let Kind::Vacuum { period_ms, looks } = self.grip.kind {
            let more = next_ms / period_ms - now_ms / period_ms;
            self.looks = self.looks.saturating_add(u32::try_from(more).unwrap_or(looks));
            if self.looks < looks {
                return None;
            }
        }
        self.looks = 0;
        self.held = Some(item);
        let slip = self.slips.iter().find(|slip| slip.pick == pick);
        self.loses_at_ms = slip.map(|slip| next_ms + self.sure_ms() + slip.after_ms);
        self.held
    }

    /// It loses an item, or its fingers hold one, report it or are open.
    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        let loses = self.loses_at_ms.map_or(f64::INFINITY, |ms| ms as f64);
        let Kind::Fingers { closes_ms, sure_ms, opens_ms } = self.grip.kind else { return loses };
        if self.since.1 != self.close {
            return now_ms as f64;
        }
        let times = match self.close {
            Close::On => [closes_ms, closes_ms + sure_ms],
            Close::Off => [opens_ms; 2],
        };
        let ends = times.into_iter().map(|ms| self.since.0 + ms).filter(|ms| *ms > now_ms);
        ends.map(|ms| ms as f64).fold(loses, f64::min)
    }

    fn gripper(&self, see: &See) -> Option<Gripper> {
        let Grip { chain, near, .. } = self.grip;
        Some(Gripper { tool: see.tool(chain)?, near, is_closed: self.close == Close::On, held: self.held })
    }

    fn looks(&self) -> Option<Looks> {
        let Grip { chain, near, .. } = self.grip;
        let Kind::Vacuum { period_ms, .. } = self.grip.kind else { return None };
        let looks = Looks { chain, period_ms, near, has_found: self.looks > 0 };
        (self.close == Close::On && self.held.is_none()).then_some(looks)
    }

    fn signal(&self, signal: usize, _see: &See, out: &mut [f64]) {
        let shown = if signal == HOLDS { self.reports() } else { self.is_open() };
        out[0] = f64::from(u8::from(shown));
    }

    /// What it holds is going to slip, or its fingers move.
    fn is_busy(&self, see: &See) -> bool {
        self.next_change(see, self.now_ms).is_finite()
    }

    /// It faces the tool.
    fn upper(&self, _carrier: &Carrier, see: &See) -> Option<Point> {
        let back = see.tool(self.grip.chain)?.axis(2).scaled(-1.0);
        (back.z < -OPPOSITE).then_some(back)
    }

    fn tool_turn(&self, see: &See) -> f64 {
        see.tool(self.grip.chain).map_or(0.0, |tool| direction_of(&tool))
    }

    fn place(&self, _item: usize, carrier: &Carrier, see: &See) -> Option<Point> {
        match *carrier {
            Carrier::Grip { hang, .. } => Some(see.tool(self.grip.chain)?.point(hang)),
            _ => None,
        }
    }
}
