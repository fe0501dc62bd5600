//! Choices by lot, which depend on a seed only.

use runtime_sim::random::Random;

pub struct Lot {
    random: Random,
}

impl Lot {
    pub fn new(seed: u64) -> Self {
        Self { random: Random::new(seed) }
    }

    pub fn below(&mut self, count: usize) -> usize {
        self.random.up_to(count as u32 - 1) as usize
    }

    pub fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    pub fn between(&mut self, lo: i32, hi: i32) -> i32 {
        lo + self.random.up_to((hi - lo) as u32) as i32
    }

    pub fn pick<'t, T>(&mut self, list: &'t [T]) -> &'t T {
        &list[self.below(list.len())]
    }

    /// A real with three places behind the point.
    pub fn real(&mut self) -> f64 {
        f64::from(self.between(-4000, 4000)) / 1000.0
    }
}
