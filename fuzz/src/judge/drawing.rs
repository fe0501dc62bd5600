//! Drawings: XML whose lengths and places are numbers.

use roxmltree::{Document, ParsingOptions};

/// Attributes that hold one number or several.
const NUMBERS: [&str; 17] = [
    "x", "y", "x1", "y1", "x2", "y2", "cx", "cy", "r", "rx", "ry", "width", "height", "viewBox", "points",
    "refX", "refY",
];

/// Panics with what is wrong.
pub fn svg(text: &str) {
    let options = ParsingOptions { allow_dtd: false, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).unwrap_or_else(|e| panic!("SVG: {e}\n{text}"));
    assert_eq!(document.root_element().tag_name().name(), "svg");
    for node in document.descendants().filter(|n| n.is_element()) {
        for attribute in node.attributes().filter(|a| NUMBERS.contains(&a.name())) {
            let mut numbers = attribute.value().split([' ', ',']).filter(|word| !word.is_empty());
            let are_finite = numbers.all(|word| word.parse::<f64>().is_ok_and(f64::is_finite));
            assert!(are_finite, "{} of {}: {}", attribute.name(), node.tag_name().name(), attribute.value());
        }
    }
}
