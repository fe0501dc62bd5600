//! A writer of JSON.

use std::fmt::Write;

/// JSON text under construction. Commas come by themselves.
pub struct Json {
    text: String,
}

impl Json {
    pub fn object(fill: impl FnOnce(&mut Json)) -> String {
        let mut json = Json { text: String::new() };
        json.braces(fill);
        json.text
    }

    fn braces(&mut self, fill: impl FnOnce(&mut Json)) {
        self.text.push('{');
        fill(self);
        self.text.push('}');
    }

    fn comma(&mut self) {
        if !self.text.is_empty() && !self.text.ends_with(['{', '[', ':']) {
            self.text.push(',');
        }
    }

    fn key(&mut self, key: &str) {
        self.comma();
        self.quoted(key);
        self.text.push(':');
    }

    pub fn put_object(&mut self, key: &str, fill: impl FnOnce(&mut Json)) {
        self.key(key);
        self.braces(fill);
    }

    /// An array of objects.
    pub fn put_list<T>(&mut self, key: &str, list: &[T], mut fill: impl FnMut(&mut Json, &T)) {
        self.key(key);
        self.text.push('[');
        for element in list {
            self.comma();
            self.braces(|json| fill(json, element));
        }
        self.text.push(']');
    }

    /// An array of texts.
    pub fn put_texts(&mut self, key: &str, values: &[String]) {
        self.key(key);
        self.text.push('[');
        for value in values {
            self.comma();
            self.quoted(value);
        }
        self.text.push(']');
    }

    /// An array of numbers, each as [`Self::put_real`] writes it.
    pub fn put_reals(&mut self, key: &str, values: &[f64]) {
        self.key(key);
        self.reals(values);
    }

    /// An array of arrays of numbers.
    pub fn put_rows(&mut self, key: &str, rows: &[Vec<f64>]) {
        self.key(key);
        self.text.push('[');
        for row in rows {
            self.comma();
            self.reals(row);
        }
        self.text.push(']');
    }

    fn reals(&mut self, values: &[f64]) {
        self.text.push('[');
        for &value in values {
            self.comma();
            self.real(value);
        }
        self.text.push(']');
    }

    fn real(&mut self, value: f64) {
        let _ = match value.is_finite() {
            true => write!(self.text, "{value:?}"),
            false => write!(self.text, "null"),
        };
    }

    pub fn put_text(&mut self, key: &str, value: &str) {
        self.key(key);
        self.quoted(value);
    }

    pub fn put_int(&mut self, key: &str, value: u64) {
        self.key(key);
        let _ = write!(self.text, "{value}");
    }

    pub fn put_truth(&mut self, key: &str, value: bool) {
        self.key(key);
        let _ = write!(self.text, "{value}");
    }

    /// The shortest text that reads back to the same bits; `null` for what JSON has no number for.
    pub fn put_real(&mut self, key: &str, value: Option<f64>) {
        self.key(key);
        self.real(value.unwrap_or(f64::NAN));
    }

    fn quoted(&mut self, text: &str) {
        self.text.push('"');
        for c in text.chars() {
            match c {
                '"' => self.text.push_str("\\\""),
                '\\' => self.text.push_str("\\\\"),
                '\n' => self.text.push_str("\\n"),
                c if c < ' ' => {
                    let _ = write!(self.text, "\\u{:04x}", c as u32);
                }
                c => self.text.push(c),
            }
        }
        self.text.push('"');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_at_once() {
        let text = Json::object(|json| {
            json.put_text("a\"", "tab\t back\\ line\n");
            json.put_object("b", |json| {
                json.put_real("x", Some(0.1));
                json.put_real("y", Some(f64::NAN));
                json.put_object("none", |_| {});
            });
            json.put_reals("r", &[1.0, f64::INFINITY]);
            json.put_rows("rows", &[vec![], vec![0.5, -0.0]]);
            json.put_list("c", &[1, 2], |json, &n| json.put_int("n", n));
            json.put_truth("d", true);
        });
        assert_eq!(
            text,
            r#"{"a\"":"tab\u0009 back\\ line\n","b":{"x":0.1,"y":null,"none":{}},"r":[1.0,null],"rows":[[],[0.5,-0.0]],"c":[{"n":1},{"n":2}],"d":true}"#
        );
    }

    #[test]
    fn a_text_that_ends_like_an_object_gets_its_comma() {
        let text = Json::object(|json| {
            json.put_text("a", "{");
            json.put_text("b", ":");
        });
        assert_eq!(text, r#"{"a":"{","b":":"}"#);
    }
}
