//! A reader of text made of words: names and numbers between white space.

use std::fmt::Display;
use std::str::FromStr;

/// The words of a text, taken from the front. Every error names the line of the word it is about.
pub struct Words<'a> {
    rest: &'a str,
    line: usize,
}

impl<'a> Words<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { rest: text, line: 1 }
    }

    /// A name: the next word, whatever it is.
    pub fn name(&mut self) -> Result<&'a str, String> {
        self.skip_space();
        if self.rest.is_empty() {
            return Err(self.error("the text ends where a word is expected"));
        }
        let end = self.rest.find(char::is_whitespace).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        Ok(word)
    }

    /// A whole number of the type asked for.
    pub fn int<T: FromStr>(&mut self) -> Result<T, String> {
        let word = self.name()?;
        word.parse().map_err(|_| self.error(format_args!("`{word}` is no whole number that fits here")))
    }

    /// A finite number.
    pub fn real(&mut self) -> Result<f64, String> {
        let word = self.name()?;
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.error(format_args!("`{word}` is no finite number"))),
        }
    }

    /// The next word has to be this one.
    pub fn expect(&mut self, keyword: &str) -> Result<(), String> {
        let word = self.name()?;
        if word == keyword {
            Ok(())
        } else {
            Err(self.error(format_args!("`{keyword}` is expected, not `{word}`")))
        }
    }

    /// A number of elements, then so many elements.
    pub fn list<T>(
        &mut self,
        mut element: impl FnMut(&mut Self) -> Result<T, String>,
    ) -> Result<Vec<T>, String> {
        let count: usize = self.int()?;
        let mut list = Vec::new();
        for _ in 0..count {
            list.push(element(self)?);
        }
        Ok(list)
    }

    pub fn is_empty(&mut self) -> bool {
        self.skip_space();
        self.rest.is_empty()
    }

    /// A message about the word read last.
    pub fn error(&self, message: impl Display) -> String {
        format!("line {}: {message}", self.line)
    }

    fn skip_space(&mut self) {
        let trimmed = self.rest.trim_start();
        let skipped = &self.rest[..self.rest.len() - trimmed.len()];
        self.line += skipped.matches('\n').count();
        self.rest = trimmed;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_come_one_after_another() {
        let mut words = Words::new(" one -2\n3.5  4 a b c d\n");
        assert_eq!(words.name(), Ok("one"));
        assert_eq!(words.int::<i32>(), Ok(-2));
        assert_eq!(words.real(), Ok(3.5));
        assert_eq!(words.list(|w| w.name()).unwrap(), ["a", "b", "c", "d"]);
        assert!(words.is_empty());
    }

    #[test]
    fn errors_name_the_line() {
        let mut words = Words::new("1\n\n -1 nan 7");
        assert_eq!(words.int::<u8>(), Ok(1));
        assert_eq!(words.int::<u8>(), Err("line 3: `-1` is no whole number that fits here".into()));
        assert_eq!(words.real(), Err("line 3: `nan` is no finite number".into()));
        assert_eq!(words.expect("8"), Err("line 3: `8` is expected, not `7`".into()));
        assert!(words.name().is_err());
    }

    #[test]
    fn a_huge_count_takes_no_memory() {
        assert!(Words::new("18446744073709551615 1 2").list(|w| w.int::<u8>()).is_err());
    }
}
