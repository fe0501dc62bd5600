//! Numbers in lists of JSON, as short as they may be.

use std::fmt::Write;

/// A list of JSON that grows.
#[derive(Default)]
pub struct List(String);

impl List {
    /// Rounded to a thousand-millionth: a nanometre, a nanosecond.
    pub fn put(&mut self, value: f64) -> &mut Self {
        self.separate();
        let rounded = (value * 1e9).round() / 1e9;
        match rounded.is_finite() {
            // Without a minus before zero.
            true => write!(self.0, "{}", rounded + 0.0),
            false => write!(self.0, "null"),
        }
        .unwrap_or_default();
        self
    }

    pub fn put_all(&mut self, values: impl IntoIterator<Item = f64>) -> &mut Self {
        values.into_iter().for_each(|value| {
            self.put(value);
        });
        self
    }

    pub fn put_whole(&mut self, value: impl std::fmt::Display) -> &mut Self {
        self.separate();
        let _ = write!(self.0, "{value}");
        self
    }

    /// A value that is JSON.
    pub fn put_json(&mut self, json: &str) -> &mut Self {
        self.separate();
        self.0.push_str(json);
        self
    }

    fn separate(&mut self) {
        if !self.0.is_empty() {
            self.0.push(',');
        }
    }

    pub fn end(&self) -> String {
        format!("[{}]", self.0)
    }
}

/// A list of values that are JSON.
pub fn list<T: AsRef<str>>(values: impl IntoIterator<Item = T>) -> String {
    let mut list = List::default();
    for value in values {
        list.put_json(value.as_ref());
    }
    list.end()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_always_json() {
        let mut list = List::default();
        list.put(0.1 + 0.2)
            .put(-0.0)
            .put(-1e-12)
            .put(f64::INFINITY)
            .put(f64::NAN)
            .put(86_400_000.0)
            .put_whole(3);
        assert_eq!(list.end(), "[0.3,0,0,null,null,86400000,3]");
        assert_eq!(super::list::<String>([]), "[]");
    }
}
