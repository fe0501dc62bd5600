//! The hash by which the traces of two engines are compared.

/// FNV-1a, 64 bits.
#[derive(Clone, Copy, Debug)]
pub struct Hash(u64);

impl Default for Hash {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Hash {
    /// Takes in the eight bytes of each number, lowest first. 0.0 and -0.0 differ.
    pub fn take(&mut self, words: &[f64]) {
        for word in words {
            for byte in word.to_bits().to_le_bytes() {
                self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
            }
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

    #[test]
    fn the_published_value() {
        // FNV-1a of the bytes of "foobarfo", computed by an implementation that yields the published
        // 85944171f73967e8 for "foobar".
        let mut hash = Hash::default();
        hash.take(&[f64::from_bits(u64::from_le_bytes(*b"foobarfo"))]);
        assert_eq!(hash.value(), 0x7396_e6eb_4e20_40df);
    }
}
