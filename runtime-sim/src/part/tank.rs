//! A tank that is filled and drained.

use super::settings::{Form, Setting, Settings};
use super::{Described, Level, Progress, Running, Schema, See, Signal, Start, World};
use crate::device::{Extent, PortType};
use crate::plant::EARLY_MS;

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "level", ty: PortType::Real, extent: Extent::One },
        Signal { name: "is_empty", ty: PortType::Bool, extent: Extent::One },
        Signal { name: "is_full", ty: PortType::Bool, extent: Extent::One },
    ],
    levels: &[
        Level { name: "fill", ty: PortType::Bool },
        Level { name: "drain", ty: PortType::Bool },
        Level { name: "fill_by", ty: PortType::Real },
        Level { name: "drain_by", ty: PortType::Real },
    ],
    ..Schema::new(
        "tank",
        "A tank with a valve that fills it and one that drains it. The level changes by (inflow - outflow) / area, from 0 to `height`; inflow into a full tank is lost. A valve is open or closed (`fill`, `drain`), or open by a fraction from 0 to 1 (`fill_by`, `drain_by`).",
        &[
            Setting::new("area", Form::Positive, "m2", "of its floor"),
            Setting::new("height", Form::Positive, "m", "of its rim over its floor"),
            Setting::new("inflow", Form::Positive, "m3/s", "with the valve open"),
            Setting::new("outflow", Form::Positive, "m3/s", "with the valve open"),
            Setting::new("begins", Form::Number, "m", "level at the start; without it, it is empty").optional(),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Tank {
    pub area: f64,
    pub height: f64,
    pub inflow: f64,
    pub outflow: f64,
    pub begins: f64,
}

impl Described for Tank {
    fn new(settings: &Settings) -> Result<Self, String> {
        let height = settings.positive("height")?;
        let begins = settings.optional("begins", Settings::number)?.unwrap_or(0.0);
        if !(0.0..=height).contains(&begins) {
            return Err("its first level is not between its floor and its rim".into());
        }
        Ok(Self {
            area: settings.positive("area")?,
            height,
            inflow: settings.positive("inflow")?,
            outflow: settings.positive("outflow")?,
            begins,
        })
    }

    fn start(&self, _start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(Some(Box::new(Filling::new(self))))
    }
}

/// Numbers of the levels.
const FILL: usize = 0;
const DRAIN: usize = 1;

/// A tank at work.
#[derive(Clone, Debug)]
pub struct Filling {
    tank: Tank,
    /// Part by which each level opens its valve. Of the two levels of a valve the one that opens it farther holds.
    open: [f64; 4],
    /// m/s.
    rate: f64,
    level: f64,
    since_ms: u64,
    now_ms: u64,
}

impl Filling {
    pub fn new(tank: &Tank) -> Self {
        Self {
            tank: tank.clone(),
            open: [0.0; 4],
            rate: 0.0,
            level: tank.begins,
            since_ms: 0,
            now_ms: 0,
        }
    }

    fn asked_rate(&self) -> f64 {
        let [fill, drain, fill_by, drain_by] = self.open;
        (fill.max(fill_by) * self.tank.inflow - drain.max(drain_by) * self.tank.outflow) / self.tank.area
    }

    fn level_at(&self, ms: u64) -> f64 {
        if self.ends_after(ms) == f64::INFINITY {
            return self.end();
        }
        (self.level + self.rate * (ms - self.since_ms) as f64 / 1000.0).clamp(0.0, self.tank.height)
    }

    /// The level to which it goes, and stays there.
    fn end(&self) -> f64 {
        if self.rate > 0.0 {
            self.tank.height
        } else if self.rate < 0.0 {
            0.0
        } else {
            self.level
        }
    }

    /// When it is there if nothing changes, ms; infinity if it is at this time.
    fn ends_after(&self, ms: u64) -> f64 {
        let left = (self.end() - self.level).abs();
        let ends_ms = self.since_ms as f64 + 1000.0 * left / self.rate.abs();
        if ends_ms > ms as f64 + EARLY_MS { ends_ms } else { f64::INFINITY }
    }
}

impl Running for Filling {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn level(&mut self, level: usize, value: &[f64]) {
        let asked = value[0];
        self.open[level] = match level {
            FILL | DRAIN => f64::from(u8::from(asked != 0.0)),
            _ if asked.is_nan() => 0.0,
            _ => asked.clamp(0.0, 1.0),
        };
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        let rate = self.asked_rate();
        if rate != self.rate {
            self.level = self.level_at(world.now_ms);
            (self.rate, self.since_ms) = (rate, world.now_ms);
        }
        self.now_ms = world.next_ms();
        Progress::Going
    }

    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        if self.asked_rate() != self.rate {
            return now_ms as f64;
        }
        self.ends_after(now_ms)
    }

    fn flows(&self) -> bool {
        self.asked_rate() != self.rate || self.ends_after(self.now_ms).is_finite()
    }

    fn is_busy(&self, _see: &See) -> bool {
        self.flows()
    }

    fn signal(&self, signal: usize, _see: &See, out: &mut [f64]) {
        let level = self.level_at(self.now_ms);
        out[0] = match signal {
            0 => level,
            1 => f64::from(u8::from(level <= 0.0)),
            _ => f64::from(u8::from(level >= self.tank.height)),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::random::Random;

    const DRAIN_BY: usize = 3;

    /// Its next change is never after the scan in which a signal changes, and there is one while it is neither full nor empty.
    #[test]
    fn it_says_when_it_is_full_or_empty() {
        let mut random = Random::new(1);
        let mut tenths = |most: f64| (1.0 + (most - 1.0) * random.between(0.0, 1.0)).round() / 100.0;
        for number in 0..2000 {
            let (height, begins) = (tenths(200.0), tenths(200.0));
            let tank = Tank {
                area: tenths(300.0),
                height: height.max(begins),
                inflow: tenths(100.0),
                outflow: tenths(100.0),
                begins: height.min(begins),
            };
            let mut filling = Filling::new(&tank);
            filling.level([FILL, DRAIN][number % 2], &[1.0]);
            (filling.rate, filling.since_ms, filling.now_ms) = (filling.asked_rate(), 20, 20);
            let has_ended = |level: f64| [tank.height, 0.0][number % 2] == level;
            let mut next_ms = filling.ends_after(20);
            while !has_ended(filling.level_at(filling.now_ms)) {
                assert!(filling.flows() && next_ms.is_finite(), "{tank:?} at {} ms", filling.now_ms);
                filling.now_ms += 10;
                if next_ms - EARLY_MS <= filling.now_ms as f64 {
                    next_ms = filling.ends_after(filling.now_ms);
                } else {
                    assert!(!has_ended(filling.level_at(filling.now_ms)), "{tank:?}: {next_ms} ms");
                }
            }
            assert_eq!(next_ms, f64::INFINITY, "{tank:?} at {} ms", filling.now_ms);
            assert!(!filling.flows(), "{tank:?} at {} ms", filling.now_ms);
        }
    }

    #[test]
    fn it_fills_and_drains_at_its_rates() {
        let tank = Tank { area: 0.5, height: 1.0, inflow: 0.05, outflow: 0.1, begins: 0.2 };
        let mut filling = Filling::new(&tank);
        let level_after = |filling: &mut Filling, fill: f64, drain: f64, ms: u64| {
            filling.level(FILL, &[fill]);
            filling.level(DRAIN_BY, &[drain]);
            filling.level = filling.level_at(filling.now_ms);
            (filling.rate, filling.since_ms) = (filling.asked_rate(), filling.now_ms);
            filling.now_ms += ms;
            filling.level_at(filling.now_ms)
        };
        // 0.1 m/s up, 0.2 m/s down.
        assert!((level_after(&mut filling, 1.0, 0.0, 5000) - 0.7).abs() < 1e-12);
        assert!((level_after(&mut filling, 1.0, 0.25, 2000) - 0.8).abs() < 1e-12);
        assert!((level_after(&mut filling, 1.0, 0.0, 5000) - 1.0).abs() < 1e-12);
        assert!((level_after(&mut filling, 0.0, 1.0, 4000) - 0.2).abs() < 1e-12);
        assert!(level_after(&mut filling, 0.0, f64::NAN, 9000) < 0.2 + 1e-12);
    }
}
