//! What varies in a sweep, and the values that it goes through.

/// `--set NAME.KEY=V1,V2,...`, its values as they were written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// `NAME.KEY`.
    pub name: String,
    /// At least one.
    pub values: Vec<String>,
}

impl Axis {
    /// The setting is not checked here: without `=` all of it is the name, and there is one value, none.
    pub fn parse(text: &str) -> Self {
        let (name, values) = text.split_once('=').unwrap_or((text, ""));
        Self { name: name.into(), values: split(values) }
    }

    /// The setting of one value.
    pub fn setting(&self, value: &str) -> String {
        format!("{}={value}", self.name)
    }
}

/// At commas outside of brackets, braces and quotes.
fn split(text: &str) -> Vec<String> {
    let mut values = vec![String::new()];
    let (mut depth, mut quoted, mut escaped) = (0_usize, false, false);
    for c in text.chars() {
        match c {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            '[' | '{' if !quoted => depth += 1,
            ']' | '}' if !quoted => depth = depth.saturating_sub(1),
            ',' if !quoted && depth == 0 => {
                values.push(String::new());
                continue;
            }
            _ => {}
        }
        if let Some(value) = values.last_mut() {
            value.push(c);
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_within_a_value_stay() {
        let values = |text| Axis::parse(text).values;
        assert_eq!(values("agv.capacity=2,4,8"), ["2", "4", "8"]);
        assert_eq!(values("a.p=[0,1,2],[3,4,5]"), ["[0,1,2]", "[3,4,5]"]);
        assert_eq!(
            values(r#"a.p={"x":[1,2],"y":3},{"x":[4,5],"y":6}"#),
            [r#"{"x":[1,2],"y":3}"#, r#"{"x":[4,5],"y":6}"#]
        );
        assert_eq!(values(r#"a.p="a,b","c\",d",e]"#), [r#""a,b""#, r#""c\",d""#, "e]"]);
        assert_eq!(values("a.p=2,,4,"), ["2", "", "4", ""]);
        assert_eq!(values("a.p"), [""]);
    }

    #[test]
    fn only_the_first_equals_sign_divides() {
        let axis = Axis::parse("a.p=x=1,y=2");
        assert_eq!(axis.name, "a.p");
        assert_eq!(axis.setting(&axis.values[1]), "a.p=y=2");
    }
}
