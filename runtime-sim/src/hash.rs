//! The hashes by which the traces of two engines are compared, and by which names give numbers.

/// Of a name: FNV-1a over its bytes.
pub fn of_name(name: &str) -> u64 {
    name.bytes().fold(BASIS, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(PRIME))
}

const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0000_0100_0000_01b3;

/// Of changes: of each its scan, its place in the trace, and the bits of the new value. FNV-1a over words of 64 bits,
/// with their upper halves mixed in, since a product carries upward only.
#[derive(Clone, Copy, Debug)]
pub struct Hash(u64);

impl Default for Hash {
    fn default() -> Self {
        Self(BASIS)
    }
}

impl Hash {
    /// 0.0 and -0.0 differ.
    pub fn change(&mut self, scan: u64, place: usize, value: f64) {
        for word in [scan, place as u64, value.to_bits()] {
            let product = (self.0 ^ word).wrapping_mul(PRIME);
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

    /// Fowler, Noll, Vo: test vectors of FNV-1a.
    #[test]
    fn the_hash_of_a_name() {
        assert_eq!([of_name(""), of_name("foobar")], [0xcbf2_9ce4_8422_2325, 0x8594_4171_f739_67e8]);
    }

    /// Computed by a few lines of Python from what is said above.
    #[test]
    fn the_hash_of_two_changes() {
        let mut hash = Hash::default();
        hash.change(3, 7, 1.5);
        hash.change(70_000, 0, -0.0);
        assert_eq!(hash.value(), 0xa938928e3b46a5f4);
    }
}
