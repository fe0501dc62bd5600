//! Names that stand side by side in a model or in a link: all different, as SDF wants them.

use std::collections::HashSet;

#[derive(Default)]
pub struct Names(HashSet<String>);

impl Names {
    /// The wanted one, with a number behind it if it was given before.
    pub fn take(&mut self, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        for number in 2.. {
            if self.0.insert(name.clone()) {
                break;
            }
            name = format!("{wanted}_{number}");
        }
        name
    }
}
