//! A vacuum gripper.

use super::running::milliseconds;
use super::settings::{Form, Setting, Settings};
use super::{Described, Level, Looks, Running, Schema, See, Signal, Start};
use crate::carrier::Carrier;
use crate::device::{Extent, PortType};
use crate::kinematics::pose::Pose;
use crate::point::Point;

pub const SCHEMA: Schema = Schema {
    signals: &[Signal { name: "holds", ty: PortType::Bool, extent: Extent::One }],
    levels: &[Level { name: "close", ty: PortType::Bool }],
    ..Schema::new(
        "grip",
        "A vacuum gripper at the tool of a chain. It attaches an item after some looks in a row with contact.",
        &[
            Setting::new("on", Form::Part(&["chain"]), "", "the chain whose tool it is"),
            Setting::new("period", Form::Positive, "ms", "how often it looks for contact"),
            Setting::new(
                "looks",
                Form::Positive,
                "",
                "looks in a row with contact before an item is attached",
            ),
            Setting::new(
                "near",
                Form::Positive,
                "m",
                "contact is a tool no farther from where an item is gripped",
            ),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Grip {
    pub chain: usize,
    pub period_ms: u64,
    pub looks: u32,
    pub near: f64,
}

impl Described for Grip {
    fn new(settings: &Settings) -> Result<Self, String> {
        let period_ms = settings.milliseconds("period")?;
        let looks = settings.positive("looks")?;
        if period_ms == 0 || looks.fract() != 0.0 {
            return Err("the settings period and looks are whole numbers over 0".into());
        }
        Ok(Self {
            chain: settings.part("on")?,
            period_ms,
            looks: looks as u32,
            near: settings.positive("near")?,
        })
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
    vacuum: Vacuum,
    looks: u32,
    held: Option<usize>,
    let_go: Option<usize>,
    /// Items attached so far.
    picks: u32,
    slips: Vec<Slip>,
    loses_at_ms: Option<u64>,
}

/// The item number `pick`, from 1, falls so long after it was attached.
#[derive(Clone, Copy, Debug)]
pub struct Slip {
    pub pick: u32,
    pub after_ms: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Vacuum {
    On,
    Off,
}

impl Gripping {
    pub fn new(grip: &Grip, slips: Vec<Slip>) -> Self {
        Self {
            grip: grip.clone(),
            vacuum: Vacuum::Off,
            looks: 0,
            held: None,
            let_go: None,
            picks: 0,
            slips,
            loses_at_ms: None,
        }
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
            self.vacuum = Vacuum::On;
        } else {
            self.vacuum = Vacuum::Off;
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

    fn seeks(&self, see: &See, now_ms: u64, next_ms: u64) -> Option<(Pose, f64)> {
        let period = self.grip.period_ms;
        let looks = self.vacuum == Vacuum::On && self.held.is_none() && now_ms / period != next_ms / period;
        looks.then(|| Some((see.tool(self.grip.chain)?, self.grip.near))).flatten()
    }

    fn meets(&mut self, item: Option<usize>, now_ms: u64, next_ms: u64) -> Option<usize> {
        let Some(item) = item else {
            self.looks = 0;
            return None;
        };
        let period = self.grip.period_ms;
        let looks = next_ms / period - now_ms / period;
        self.looks = self.looks.saturating_add(u32::try_from(looks).unwrap_or(self.grip.looks));
        if self.looks < self.grip.looks {
            return None;
        }
        self.looks = 0;
        self.held = Some(item);
        self.picks = self.picks.saturating_add(1);
        let slip = self.slips.iter().find(|slip| slip.pick == self.picks);
        self.loses_at_ms = slip.map(|slip| next_ms + slip.after_ms);
        self.held
    }

    /// It loses an item.
    fn next_change(&self, _see: &See, _now_ms: u64) -> f64 {
        self.loses_at_ms.map_or(f64::INFINITY, |ms| ms as f64)
    }

    fn looks(&self) -> Option<Looks> {
        let Grip { chain, period_ms, near, .. } = self.grip;
        let looks = Looks { chain, period_ms, near, has_found: self.looks > 0 };
        (self.vacuum == Vacuum::On && self.held.is_none()).then_some(looks)
    }

    fn signal(&self, _signal: usize, _see: &See, out: &mut [f64]) {
        out[0] = f64::from(u8::from(self.held.is_some()));
    }

    /// What it holds is going to slip.
    fn is_busy(&self, _see: &See) -> bool {
        self.loses_at_ms.is_some()
    }

    fn place(&self, _item: usize, carrier: &Carrier, see: &See) -> Option<Point> {
        match *carrier {
            Carrier::Grip { hang, .. } => Some(see.tool(self.grip.chain)?.point(hang)),
            _ => None,
        }
    }
}
