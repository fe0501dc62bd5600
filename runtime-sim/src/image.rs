//! Process images and traces as words that are compared to the bit.

/// Whether all words are the same, to the bit; of two slices of the same length.
pub fn are_same(a: &[f64], b: &[f64]) -> bool {
    // Without a way out of the loop it compares several words at once.
    a.iter().zip(b).fold(0, |differs, (a, b)| differs | (a.to_bits() ^ b.to_bits())) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_compared_to_the_bit() {
        let words = [0.0, 1.5, f64::NAN, -3.0, 7.0];
        assert!(are_same(&words, &words));
        assert!(are_same(&[], &[]));
        for (place, other) in [(0, -0.0), (1, 1.5 + f64::EPSILON), (2, 0.0), (4, 8.0)] {
            let mut changed = words;
            changed[place] = other;
            assert!(!are_same(&words, &changed), "word {place}");
        }
    }
}
