//! Process images: a number for each point of I/O.

use controllers::types::{Array, Point};

/// The numbers of an image, from the front; missing numbers are 0.
pub struct Image<'a> {
    rest: std::slice::Iter<'a, f64>,
    taken: usize,
}

impl<'a> Image<'a> {
    pub fn new(image: &'a [f64]) -> Self {
        Self { rest: image.iter(), taken: 0 }
    }

    fn word(&mut self) -> f64 {
        self.taken += 1;
        self.rest.next().copied().unwrap_or(0.0)
    }
}

/// How many numbers of an image such a value is latched from.
pub fn words_of<T: Latch>() -> usize {
    let image = &mut Image::new(&[]);
    T::latch(image);
    image.taken
}

/// A value that is latched from an image.
pub trait Latch {
    fn latch(image: &mut Image) -> Self;
}

impl Latch for bool {
    fn latch(image: &mut Image) -> Self {
        image.word() != 0.0
    }
}

impl Latch for i32 {
    fn latch(image: &mut Image) -> Self {
        image.word() as i32
    }
}

impl Latch for f64 {
    fn latch(image: &mut Image) -> Self {
        image.word()
    }
}

impl Latch for Point {
    fn latch(image: &mut Image) -> Self {
        Point::new(image.word(), image.word(), image.word())
    }
}

impl<T: Latch, const N: usize> Latch for Array<T, N> {
    fn latch(image: &mut Image) -> Self {
        Array(std::array::from_fn(|_| T::latch(image)))
    }
}

/// A value that is written to an image.
pub trait Put: Sized {
    /// How many numbers it is.
    const WORDS: usize;

    /// Writes it to as many words.
    fn put(self, words: &mut [f64]);

    /// This one and the next one.
    fn with<T: Put>(self, next: T) -> With<Self, T> {
        With(self, next)
    }

    fn append(self, image: &mut Vec<f64>) {
        let begin = image.len();
        let end = begin + Self::WORDS;
        image.resize(end, 0.0);
        self.put(&mut image[begin..end]);
    }
}

/// Two values, one after the other.
pub struct With<A, B>(A, B);

impl<A: Put, B: Put> Put for With<A, B> {
    const WORDS: usize = A::WORDS + B::WORDS;

    fn put(self, words: &mut [f64]) {
        let (first, next) = words.split_at_mut(A::WORDS);
        self.0.put(first);
        self.1.put(next);
    }
}

impl Put for bool {
    const WORDS: usize = 1;

    fn put(self, words: &mut [f64]) {
        words[0] = f64::from(u8::from(self));
    }
}

impl Put for i32 {
    const WORDS: usize = 1;

    fn put(self, words: &mut [f64]) {
        words[0] = f64::from(self);
    }
}

impl Put for f64 {
    const WORDS: usize = 1;

    fn put(self, words: &mut [f64]) {
        words[0] = self;
    }
}

impl Put for Point {
    const WORDS: usize = 3;

    fn put(self, words: &mut [f64]) {
        words.copy_from_slice(&[self.x, self.y, self.z]);
    }
}

impl<T: Put, const N: usize> Put for [T; N] {
    const WORDS: usize = N * T::WORDS;

    fn put(self, words: &mut [f64]) {
        self.into_iter().zip(words.chunks_exact_mut(T::WORDS)).for_each(|(value, words)| value.put(words));
    }
}

impl<T: Put, const N: usize> Put for Array<T, N> {
    const WORDS: usize = N * T::WORDS;

    fn put(self, words: &mut [f64]) {
        self.0.put(words);
    }
}
