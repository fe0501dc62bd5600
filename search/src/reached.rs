//! All states that were reached, in pieces: most states differ from others in few of them.

use crate::store::Store;

/// Each state is stored as it is, as the numbers of its pieces.
pub struct Reached {
    length: usize,
    /// The values of each piece.
    pieces: Vec<Store>,
    codes: Store,
}

/// Bytes of a piece; the last one may be shorter.
const PIECE: usize = 32;
/// Bytes of the number of a value.
const NUMBER: usize = 3;
/// Of a piece that no state has.
const NONE: [u8; NUMBER] = [u8::MAX; NUMBER];
/// A piece has fewer values than this: so many less than there are numbers that those of a batch of states find place.
const MOST: usize = (1 << (8 * NUMBER)) - (1 << 22);

/// A state, and the numbers of its pieces.
pub(crate) struct Coded<'a> {
    pub state: &'a [u8],
    pub code: Vec<u8>,
}

impl Reached {
    /// For states of so many bytes, a multiple of 8.
    pub fn new(length: usize) -> Self {
        let lengths = (0..length).step_by(PIECE).map(|begin| PIECE.min(length - begin));
        let pieces: Vec<Store> = lengths.map(Store::new).collect();
        let codes = Store::new((NUMBER * pieces.len()).next_multiple_of(8));
        Self { length, pieces, codes }
    }

    #[allow(clippy::len_without_is_empty)] // The first state is always there.
    pub fn len(&self) -> usize {
        self.codes.len()
    }

    /// Bytes of a state.
    pub(crate) fn length(&self) -> usize {
        self.length
    }

    pub fn state(&self, number: usize) -> Vec<u8> {
        let mut state = Vec::with_capacity(self.length);
        for (piece, number) in self.pieces.iter().zip(self.codes.state(number).chunks_exact(NUMBER)) {
            state.extend_from_slice(piece.state(value(number)));
        }
        state
    }

    pub fn parent(&self, number: usize) -> usize {
        self.codes.parent(number)
    }

    /// The state of this number, which is `state`.
    pub(crate) fn coded<'a>(&self, number: usize, state: &'a [u8]) -> Coded<'a> {
        Coded { state, code: self.codes.state(number).to_vec() }
    }

    /// Any state.
    pub(crate) fn code<'a>(&self, state: &'a [u8]) -> Coded<'a> {
        let mut code = vec![0; self.codes.length()];
        code[..NUMBER * self.pieces.len()].fill(u8::MAX);
        self.complete(state, code)
    }

    /// Any state, of some pieces of which the numbers were known before.
    pub(crate) fn complete<'a>(&self, state: &'a [u8], mut code: Vec<u8>) -> Coded<'a> {
        for ((piece, bytes), number) in
            self.pieces.iter().zip(state.chunks(PIECE)).zip(code.chunks_exact_mut(NUMBER))
        {
            if *number == NONE {
                number.copy_from_slice(&number_in(piece, bytes));
            }
        }
        Coded { state, code }
    }

    /// Bytes of memory that it takes.
    pub fn size(&self) -> usize {
        self.codes.size() + self.pieces.iter().map(Store::size).sum::<usize>()
    }

    /// Whether it can take no more: numbers of states have 32 bits, those of the values of a piece 24.
    pub fn is_full(&self) -> bool {
        self.codes.is_full() || self.pieces.iter().any(|piece| piece.len() >= MOST)
    }

    pub fn find(&self, state: &[u8]) -> Option<usize> {
        self.find_coded(&self.code(state))
    }

    pub(crate) fn find_coded(&self, Coded { code, .. }: &Coded) -> Option<usize> {
        let mut numbers = code.chunks_exact(NUMBER).take(self.pieces.len());
        if numbers.any(|number| number == NONE) { None } else { self.codes.find(code) }
    }

    /// Another state, which has most pieces in common with this one; its code is left in `other`.
    pub(crate) fn find_beside(&self, state: &[u8], beside: &Coded, other: &mut Vec<u8>) -> Option<usize> {
        other.clone_from(&beside.code);
        let pieces = self.pieces.iter().zip(state.chunks(PIECE)).zip(beside.state.chunks(PIECE));
        let mut is_known = true;
        for (((piece, bytes), same), number) in pieces.zip(other.chunks_exact_mut(NUMBER)) {
            if bytes != same {
                number.copy_from_slice(&number_in(piece, bytes));
            }
            is_known &= *number != NONE;
        }
        if is_known { self.codes.find(other) } else { None }
    }

    /// The number of the state, and whether it is new.
    pub fn add(&mut self, state: &[u8], parent: usize) -> (usize, bool) {
        let coded = self.code(state);
        self.add_coded(coded, parent)
    }

    pub(crate) fn add_coded(&mut self, Coded { state, mut code }: Coded, parent: usize) -> (usize, bool) {
        for ((piece, bytes), number) in
            self.pieces.iter_mut().zip(state.chunks(PIECE)).zip(code.chunks_exact_mut(NUMBER))
        {
            if *number == NONE {
                let found = piece.add(bytes, 0).0;
                assert!(found < 1 << (8 * NUMBER), "`is_full` is asked before there are so many");
                number.copy_from_slice(&found.to_le_bytes()[..NUMBER]);
            }
        }
        self.codes.add(&code, parent)
    }
}

/// The number of the value of a piece.
fn number_in(piece: &Store, bytes: &[u8]) -> [u8; NUMBER] {
    let number = piece.find(bytes).map_or(u32::MAX, |number| number as u32).to_le_bytes();
    [number[0], number[1], number[2]]
}

fn value(number: &[u8]) -> usize {
    number.iter().rev().fold(0, |value, byte| value << 8 | usize::from(*byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of two pieces, the second one shorter.
    fn state(number: u64) -> Vec<u8> {
        let mut state = vec![0; 40];
        state[..8].copy_from_slice(&(number % 100).to_le_bytes());
        state[32..].copy_from_slice(&(number / 100).to_le_bytes());
        state
    }

    #[test]
    fn every_state_is_stored_once_and_as_it_is() {
        let mut reached = Reached::new(40);
        for round in 0..2 {
            for number in 0..50_000 {
                assert_eq!(reached.add(&state(number), 7), (number as usize, round == 0));
            }
        }
        assert_eq!(reached.len(), 50_000);
        let found = reached.state(4711);
        assert_eq!((reached.parent(4711), &found), (7, &state(4711)));
        let (beside, mut other) = (reached.coded(4711, &found), Vec::new());
        for (number, expected) in
            [(4711, Some(4711)), (4712, Some(4712)), (49_999, Some(49_999)), (50_000, None)]
        {
            assert_eq!(reached.find(&state(number)), expected);
            assert_eq!(reached.find_beside(&state(number), &beside, &mut other), expected);
        }
    }
}
