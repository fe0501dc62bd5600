//! Retained values as numbers: each value is written as one or more words, and read back after a loss of power.

/// Takes the next word.
pub type Words<'a> = dyn FnMut() -> Option<f64> + 'a;

/// A value that is kept while there is no power.
pub trait Retained: Sized {
    fn put(self, put: &mut dyn FnMut(f64));

    /// The value, if the words are one of this type.
    fn take(words: &mut Words) -> Option<Self>;
}

impl Retained for bool {
    fn put(self, put: &mut dyn FnMut(f64)) {
        put(f64::from(u8::from(self)));
    }

    fn take(words: &mut Words) -> Option<Self> {
        match i32::take(words)? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

impl Retained for i32 {
    fn put(self, put: &mut dyn FnMut(f64)) {
        put(f64::from(self));
    }

    fn take(words: &mut Words) -> Option<Self> {
        let word = words()?;
        let whole = word as i32;
        (f64::from(whole) == word).then_some(whole)
    }
}

impl Retained for f64 {
    fn put(self, put: &mut dyn FnMut(f64)) {
        put(self);
    }

    fn take(words: &mut Words) -> Option<Self> {
        words().filter(|word| word.is_finite())
    }
}

impl Retained for Point {
    fn put(self, put: &mut dyn FnMut(f64)) {
        [self.x, self.y, self.z].into_iter().for_each(put);
    }

    fn take(words: &mut Words) -> Option<Self> {
        Some(Point::new(f64::take(words)?, f64::take(words)?, f64::take(words)?))
    }
}

impl<T: Retained + Copy, const N: usize> Retained for Array<T, N> {
    fn put(self, put: &mut dyn FnMut(f64)) {
        self.0.into_iter().for_each(|value| value.put(put));
    }

    fn take(words: &mut Words) -> Option<Self> {
        let mut values = [None; N];
        for value in &mut values {
            *value = Some(T::take(words)?);
        }
        let first = values.first().copied().flatten()?;
        Some(Array(values.map(|value| value.unwrap_or(first))))
    }
}
{%- for item in enums %}

impl Retained for {{ item }} {
    fn put(self, put: &mut dyn FnMut(f64)) {
        (self as i32).put(put);
    }

    fn take(words: &mut Words) -> Option<Self> {
        usize::try_from(i32::take(words)?).ok().and_then(|member| Self::ALL.get(member).copied())
    }
}
{%- endfor %}
{%- for item in references %}

impl Retained for {{ item }} {
    fn put(self, put: &mut dyn FnMut(f64)) {
        i32::from(self.0).put(put);
    }

    fn take(words: &mut Words) -> Option<Self> {
        u16::try_from(i32::take(words)?).ok().map(Self)
    }
}
{%- endfor %}

/// The [`check`] of no words.
pub const UNCHECKED: u64 = 0xcbf2_9ce4_8422_2325;

/// The check of one word more: their FNV-1a hash. That of words of two scans, put together, is another one.
pub fn check(before: u64, word: f64) -> u64 {
    let bytes = word.to_bits().to_le_bytes();
    bytes.into_iter().fold(before, |check, byte| (check ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// It as a word, which holds 53 bits of it.
pub fn check_word(check: u64) -> f64 {
    (check >> 11) as f64
}
