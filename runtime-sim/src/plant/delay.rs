//! The bus between devices and controllers: answers come late, in order.

use crate::line::IoDelay;
use crate::random::Random;

/// The last images of each machine, and which of them its controller has seen.
#[derive(Clone, Debug)]
pub struct Bus {
    delay: IoDelay,
    random: Random,
    wires: Vec<Wire>,
}

#[derive(Clone, Debug)]
struct Wire {
    words: usize,
    /// A ring of `max + 1` images: that of scan n begins at `n % (max + 1) * words`.
    ring: Vec<f64>,
    /// The scan whose image was delivered last.
    delivered: u64,
}

impl Bus {
    /// `images` are those of the plant before scan 0.
    pub fn new(delay: IoDelay, images: &[Vec<f64>]) -> Self {
        let depth = delay.max() as usize + 1;
        let wires = images
            .iter()
            .map(|image| Wire { words: image.len(), ring: image.repeat(depth), delivered: 0 })
            .collect();
        let seed = match delay {
            IoDelay::Fixed(_) => 0,
            IoDelay::Random { seed, .. } => seed,
        };
        Self { delay, random: Random::new(seed), wires }
    }

    /// Sends the images that the plant has at the start of `scan`, and delivers those that have come
    /// through by then. True if what a controller sees differs from the scan before.
    pub fn exchange(&mut self, scan: u64, images: &[Vec<f64>], inputs: &mut [Vec<f64>]) -> bool {
        let depth = u64::from(self.delay.max()) + 1;
        let mut changed = false;
        for ((wire, image), input) in self.wires.iter_mut().zip(images).zip(inputs) {
            let slot = |scan: u64| {
                let start = (scan % depth) as usize * wire.words;
                start..start + wire.words
            };
            wire.ring[slot(scan)].copy_from_slice(image);
            let late = match self.delay {
                IoDelay::Fixed(scans) => scans,
                IoDelay::Random { max, .. } => self.random.up_to(max),
            };
            wire.delivered = wire.delivered.max(scan.saturating_sub(u64::from(late)));
            let arrived = &wire.ring[slot(wire.delivered)];
            if arrived != input.as_slice() {
                changed = true;
                input.copy_from_slice(arrived);
            }
        }
        changed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(delay: IoDelay, scans: u64) -> Vec<u64> {
        let mut bus = Bus::new(delay, &[vec![0.0]]);
        let mut inputs = vec![vec![0.0]];
        (0..scans)
            .map(|scan| {
                bus.exchange(scan, &[vec![scan as f64]], &mut inputs);
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
