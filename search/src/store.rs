//! The states that have been reached, each stored as it is.

const EMPTY: u64 = u64::MAX;
const MULTIPLIER: u64 = 0x9E37_79B9_7F4A_7C15;

/// States of one length, in the order in which they were reached, in one piece of memory; a table with open addressing
/// finds them: 32 bits of the hash, then the number of the state.
pub struct Store {
    length: usize,
    bytes: Vec<u8>,
    parents: Vec<u32>,
    table: Vec<u64>,
}

impl Store {
    /// For states of so many bytes.
    pub fn new(length: usize) -> Self {
        Self { length, bytes: Vec::new(), parents: Vec::new(), table: vec![EMPTY; 1 << 12] }
    }

    /// Forgets all states, and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.bytes.clear();
        self.parents.clear();
        self.table.fill(EMPTY);
    }

    #[allow(clippy::len_without_is_empty)] // The first state is always there.
    pub fn len(&self) -> usize {
        self.parents.len()
    }

    /// Bytes of a state.
    pub(crate) fn length(&self) -> usize {
        self.length
    }

    pub fn state(&self, number: usize) -> &[u8] {
        &self.bytes[number * self.length..][..self.length]
    }

    pub fn parent(&self, number: usize) -> usize {
        self.parents[number] as usize
    }

    /// Bytes of memory that it takes.
    pub fn size(&self) -> usize {
        self.bytes.capacity() + 4 * self.parents.capacity() + 8 * self.table.len()
    }

    /// Whether it can take no more: numbers have 32 bits.
    pub fn is_full(&self) -> bool {
        self.len() >= u32::MAX as usize - 1
    }

    pub fn find(&self, state: &[u8]) -> Option<usize> {
        self.slot(state, hash(state)).ok()
    }

    /// The number of the state, and whether it is new.
    pub fn add(&mut self, state: &[u8], parent: usize) -> (usize, bool) {
        let hash = hash(state);
        let slot = match self.slot(state, hash) {
            Ok(number) => return (number, false),
            Err(slot) => slot,
        };
        let number = self.len();
        self.table[slot] = hash & !u64::from(u32::MAX) | number as u64;
        self.bytes.extend_from_slice(state);
        self.parents.push(parent as u32);
        if self.len() * 2 > self.table.len() {
            self.grow();
        }
        (number, true)
    }

    /// The state, or the free slot where it belongs.
    fn slot(&self, state: &[u8], hash: u64) -> Result<usize, usize> {
        let mask = self.table.len() - 1;
        let mut slot = (hash >> 32) as usize & mask;
        loop {
            let entry = self.table[slot];
            if entry == EMPTY {
                return Err(slot);
            }
            let number = entry as u32 as usize;
            if entry >> 32 == hash >> 32 && self.state(number) == state {
                return Ok(number);
            }
            slot = (slot + 1) & mask;
        }
    }

    fn grow(&mut self) {
        let mut table = vec![EMPTY; self.table.len() * 2];
        let mask = table.len() - 1;
        for entry in self.table.iter().filter(|entry| **entry != EMPTY) {
            let mut slot = (entry >> 32) as usize & mask;
            while table[slot] != EMPTY {
                slot = (slot + 1) & mask;
            }
            table[slot] = *entry;
        }
        self.table = table;
    }
}

/// The length of a state is a multiple of 8.
fn hash(state: &[u8]) -> u64 {
    let mut lanes = [MULTIPLIER, !MULTIPLIER];
    for (index, chunk) in state.chunks_exact(8).enumerate() {
        let mut word = [0; 8];
        word.copy_from_slice(chunk);
        let lane = &mut lanes[index % 2];
        *lane = (lane.rotate_left(23) ^ u64::from_le_bytes(word)).wrapping_mul(MULTIPLIER);
    }
    let mixed = (lanes[0].rotate_left(32) ^ lanes[1]).wrapping_mul(MULTIPLIER);
    (mixed ^ (mixed >> 29)).wrapping_mul(MULTIPLIER)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_state_is_stored_once() {
        let mut store = Store::new(8);
        for round in 0..2 {
            for value in 0..20_000_u64 {
                let (number, is_new) = store.add(&(value * 3).to_le_bytes(), 7);
                assert_eq!((number, is_new), (value as usize, round == 0));
            }
        }
        assert_eq!(store.len(), 20_000);
        assert_eq!(store.find(&9_u64.to_le_bytes()), Some(3));
        assert_eq!(store.find(&10_u64.to_le_bytes()), None);
        assert_eq!(store.parent(3), 7);
    }
}
