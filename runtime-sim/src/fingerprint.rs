//! A number of 128 bits by which things are told apart that are compared often.

use crate::random::Random;

/// Of a list of numbers. Two lists that differ have the same one with a probability of 2^-128 or so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fingerprint([u64; 2]);

/// Lengths and angles count to this, m or rad.
const GRAIN: f64 = 1e-6;

impl Default for Fingerprint {
    fn default() -> Self {
        // The first 128 bits of pi behind the point.
        Self([0x243F_6A88_85A3_08D3, 0x1319_8A2E_0370_7344])
    }
}

impl Fingerprint {
    #[inline]
    pub fn with(self, number: u64) -> Self {
        let [a, b] = self.0;
        Self([a, b.rotate_left(23)].map(|half| Random::new(half ^ number).next_u64()))
    }

    /// A length or an angle, to the nearest micrometre or microradian.
    #[inline]
    pub fn near(self, value: f64) -> Self {
        self.with((value / GRAIN).round() as i64 as u64)
    }

    #[inline]
    pub fn and(self, other: Fingerprint) -> Self {
        self.with(other.0[0]).with(other.0[1])
    }

    pub fn words(self) -> [u64; 2] {
        self.0
    }

    pub fn of_words(words: [u64; 2]) -> Self {
        Self(words)
    }

    /// Of both in any order.
    pub fn sum(self, other: Fingerprint) -> Self {
        Self([self.0[0].wrapping_add(other.0[0]), self.0[1].wrapping_add(other.0[1])])
    }
}
