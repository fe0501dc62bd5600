//! The sample by hand keeps every rule.

use autogen_st_judge::{judge, listed};

pub const SAMPLE: &str = include_str!("../fixtures/sample.st");

#[test]
fn the_sample_is_clean() {
    if let Err(findings) = judge(SAMPLE) {
        panic!("{}", listed(&findings, SAMPLE));
    }
}
