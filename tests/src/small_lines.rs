//! Small lines in which a search finds mistakes of the library's types, and of the table `Buffer`.

use crate::{Texts, own_line};
use autogen::library;
use autogen_search::plant::Faults;

const KINDS: &str = r#"[{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.11}]"#;
const ONE_PART: &str = r#"[{"station": "as1", "parts": {"battery": 1}}]"#;
const TWO_PARTS: &str = r#"[{"station": "as1", "parts": {"battery": 1, "pump": 1}}]"#;
const TWO_ORDERS: &str =
    r#"[{"station": "as1", "parts": {"battery": 1}}, {"station": "as1", "parts": {"pump": 1}}]"#;

/// A line to be searched.
pub struct Line {
    pub name: &'static str,
    pub texts: Texts,
    pub faults: Faults,
}

impl Line {
    /// The text of a type, by the name of its file.
    pub fn text_of(&self, name: &str) -> String {
        if name == "buffer" {
            return self.texts.specs[0].clone();
        }
        let file = library::FILES.iter().find(|(file, _)| *file == format!("library/{name}.aut"));
        file.unwrap_or_else(|| panic!("{name} is no type of the library")).1.to_string()
    }

    /// The texts of the line with another text of a type.
    pub fn with(&self, name: &str, text: &str) -> Texts {
        let mut texts = self.texts.clone();
        match name {
            "buffer" => texts.specs[0] = text.to_string(),
            _ => texts.specs.push(text.to_string()),
        }
        texts
    }
}

fn line(name: &'static str, layout: &str, orders: &str, faults: Faults) -> Line {
    let scenario = format!(r#"{{"kinds": {KINDS}, "orders": {orders}}}"#);
    let texts = Texts { layout: layout.into(), scenario: Some(scenario), ..own_line("buffer") };
    Line { name, texts, faults }
}

/// The layout of the buffer without an object, or with another one in its place.
fn replaced(layout: &str, name: &str, by: &str) -> String {
    let end_of = |begin: usize| begin + layout[begin..].find("\n    },\n").expect("an end") + 8;
    let at = layout.find(&format!(r#""name": "{name}""#)).expect("an object");
    let begin = layout[..at].rfind("    {\n").expect("its beginning");
    format!("{}{by}{}", &layout[..begin], &layout[end_of(begin)..])
}

/// Lines of which each shows some mistakes; with the quickest first.
pub fn all() -> Vec<Line> {
    let table = own_line("buffer").layout;
    let only = replaced(&table, "agv1", "");
    // Without the table items go by the vehicle.
    let vehicle = replaced(&table, "buffer", "");
    // A second arm on the other side of the table, with a belt of its own.
    let second = r#"    {
      "name": "conveyor_belt2", "type": "conveyor", "pose": [-3.826924, 0, 0], "orient": "y", "orient_range": [-5, 5]
    },
    {
      "name": "kitting2", "type": "kitting", "pose": [-3.1, 0, 1.127], "rail_dim": "y", "rail_range": [-4.8, 4.8],
      "takes_from": ["conveyor_belt2"]
    },
"#;
    let twins = replaced(&table, "agv1", second);
    vec![
        line("table, two parts", &table, TWO_PARTS, Faults::None),
        line("vehicle, two parts", &vehicle, TWO_PARTS, Faults::None),
        line("vehicle, two orders", &vehicle, TWO_ORDERS, Faults::None),
        line("table, one part, faults", &table, ONE_PART, Faults::All),
        line("vehicle, one part, faults", &vehicle, ONE_PART, Faults::All),
        line("table alone, two parts", &only, TWO_PARTS, Faults::None),
        line("two arms at the table", &twins, TWO_PARTS, Faults::None),
    ]
}
