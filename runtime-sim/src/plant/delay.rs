//! The bus between devices and controllers: answers come late, in order.

use crate::image::are_same;
use crate::line::IoDelay;
use crate::random::Random;

/// The last images of each machine, and which of them its controller has seen.
#[derive(Clone, Debug)]
pub struct Bus {
    delay: IoDelay,
    wires: Vec<Wire>,
    /// The last scan whose image differed from the one before in more than places of what moves.
    sent: u64,
}

#[derive(Clone, Debug)]
struct Wire {
    /// Which words change while something moves.
    is_analogue: Vec<bool>,
    /// A ring of `max + 1` images: that of scan n begins at `n % (max + 1) * words`.
    ring: Vec<f64>,
    /// The scan whose image was sent last, and the one that was delivered last.
    sent: u64,
    delivered: u64,
}

/// In what the inputs of the controllers differ from those before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Arrived {
    Nothing,
    /// Words that change while something moves.
    Places,
    Events,
}

impl Bus {
    /// `images` are those of the plant before scan 0; `analogue` says which of their words change while something moves.
    pub fn new(delay: IoDelay, images: &[Vec<f64>], analogue: Vec<Vec<bool>>) -> Self {
        let depth = delay.max() as usize + 1;
        let wires = images
            .iter()
            .zip(analogue)
            .map(|(image, is_analogue)| Wire {
                is_analogue,
                ring: image.repeat(depth),
                sent: 0,
                delivered: 0,
            })
            .collect();
        Self { delay, wires, sent: 0 }
    }

    /// Sends the images that the plant has at the start of `scan`, and delivers those that have come
    /// through by then. `moves` says which machines still move.
    pub fn exchange(
        &mut self,
        scan: u64,
        images: &[Vec<f64>],
        moves: impl Fn(usize) -> bool,
        inputs: &mut [Vec<f64>],
    ) -> Arrived {
        if self.delay.max() == 0 {
            return self.pass_on(images, inputs);
        }
        let depth = u64::from(self.delay.max()) + 1;
        let mut arrived = Arrived::Nothing;
        for (machine, ((wire, image), input)) in self.wires.iter_mut().zip(images).zip(inputs).enumerate() {
            let slot = |scan: u64| {
                let start = (scan % depth) as usize * image.len();
                start..start + image.len()
            };
            match wire.compare(image, &wire.ring[slot(wire.sent)]) {
                Arrived::Events => self.sent = scan,
                // The last places of what has come to rest.
                Arrived::Places if !moves(machine) => self.sent = scan,
                Arrived::Places | Arrived::Nothing => {}
            }
            wire.ring[slot(scan)].copy_from_slice(image);
            wire.sent = scan;
            let first = scan.saturating_sub(depth - 1);
            let through = |scan: u64| scan.saturating_sub(u64::from(late(&self.delay, machine, scan)));
            wire.delivered = (first..=scan).map(through).fold(wire.delivered, u64::max);
            let telegram = &wire.ring[slot(wire.delivered)];
            let difference = wire.compare(telegram, input);
            if difference != Arrived::Nothing {
                arrived = arrived.max(difference);
                input.copy_from_slice(telegram);
            }
        }
        arrived
    }

    /// What is sent is delivered at once.
    fn pass_on(&self, images: &[Vec<f64>], inputs: &mut [Vec<f64>]) -> Arrived {
        let mut arrived = Arrived::Nothing;
        for ((wire, image), input) in self.wires.iter().zip(images).zip(inputs) {
            let difference = wire.compare(image, input);
            if difference != Arrived::Nothing {
                arrived = arrived.max(difference);
                input.copy_from_slice(image);
            }
        }
        arrived
    }

    /// The next scan in which images have to be exchanged, if nothing happens before `quiet_until`: those of the last
    /// scans before something happens are needed, and until they have come through those after it.
    pub fn next_exchange(&self, scan: u64, quiet_until: u64, last_event: u64) -> u64 {
        let depth = u64::from(self.delay.max());
        if depth == 0 {
            return quiet_until;
        }
        let has_settled = scan > last_event.max(self.sent) + depth;
        if has_settled { quiet_until.saturating_sub(depth).max(scan + 1) } else { scan + 1 }
    }
}

impl Wire {
    fn compare(&self, image: &[f64], other: &[f64]) -> Arrived {
        if are_same(image, other) {
            return Arrived::Nothing;
        }
        let differs = |(a, b): (&f64, &f64)| a.to_bits() != b.to_bits();
        let mut difference = Arrived::Nothing;
        for (word, two) in image.iter().zip(other).enumerate() {
            if differs(two) {
                let is_place = self.is_analogue.get(word) == Some(&true);
                difference = difference.max(if is_place { Arrived::Places } else { Arrived::Events });
            }
        }
        difference
    }
}

/// How many scans the telegram of a machine takes that is sent in this scan.
fn late(delay: &IoDelay, machine: usize, scan: u64) -> u32 {
    match *delay {
        IoDelay::Fixed(scans) => scans,
        IoDelay::Random { max, seed } => Random::at(seed, [machine as u64, scan]).up_to(max),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(delay: IoDelay, scans: u64) -> Vec<u64> {
        let mut bus = Bus::new(delay, &[vec![0.0]], vec![vec![false]]);
        let mut inputs = vec![vec![0.0]];
        (0..scans)
            .map(|scan| {
                bus.exchange(scan, &[vec![scan as f64]], |_| false, &mut inputs);
                inputs[0][0] as u64
            })
            .collect()
    }

    #[test]
    fn a_fixed_delay_is_exact() {
        assert_eq!(seen(IoDelay::Fixed(0), 4), [0, 1, 2, 3]);
        assert_eq!(seen(IoDelay::Fixed(2), 6), [0, 0, 0, 1, 2, 3]);
    }

    #[test]
    fn a_random_delay_keeps_the_order() {
        let seen = seen(IoDelay::Random { max: 5, seed: 7 }, 1000);
        assert!(seen.windows(2).all(|pair| pair[0] <= pair[1]));
        assert!(seen.iter().enumerate().all(|(n, &s)| n as u64 - s <= 5));
        assert!(seen.iter().enumerate().any(|(n, &s)| n as u64 - s == 5));
        assert!(seen.iter().enumerate().skip(1).any(|(n, &s)| n as u64 == s));
    }
}
