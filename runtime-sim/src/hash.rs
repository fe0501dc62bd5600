//! The hash by which the traces of two engines are compared.

/// Of changes: of each its scan, its place in the trace, and the bits of the new value. FNV-1a over words of 64 bits,
/// with their upper halves mixed in, since a product carries upward only.
#[derive(Clone, Copy, Debug)]
pub struct Hash(u64);

impl Default for Hash {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Hash {
    /// 0.0 and -0.0 differ.
    pub fn change(&mut self, scan: u64, place: usize, value: f64) {
        for word in [scan, place as u64, value.to_bits()] {
            let product = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
            self.0 = product ^ (product >> 32);
        }
    }

    /// Hash of all that was taken in so far.
    pub fn value(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Computed by a few lines of Python from what is said above.
    #[test]
    fn the_hash_of_two_changes() {
        let mut hash = Hash::default();
        hash.change(3, 7, 1.5);
        hash.change(70_000, 0, -0.0);
        assert_eq!(hash.value(), 0xa938928e3b46a5f4);
    }
}
