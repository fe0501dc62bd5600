//! An independent reading of SDF 1.7: what may stand where, what belongs together, and where joints put links.

pub mod chain;
pub mod elements;
pub mod meaning;

use crate::xml::{self, Element};

/// All that is wrong with a world, each with its line; what is no XML at all has one finding.
pub fn findings(text: &str) -> Vec<String> {
    match xml::read(text) {
        Ok(root) => {
            let mut found = elements::findings(&root);
            found.extend(meaning::findings(&root));
            found
        }
        Err(error) => vec![error],
    }
}

/// The numbers of an element's text; none if one of them is no finite number.
pub fn numbers(element: &Element) -> Option<Vec<f64>> {
    let number = |word: &str| word.parse::<f64>().ok().filter(|n| n.is_finite());
    element.text.split_whitespace().map(number).collect()
}
