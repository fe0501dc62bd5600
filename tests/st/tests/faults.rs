//! Every seeded fault is found.

use autogen_st_judge::{faults, judge, listed};

#[test]
fn every_fault_in_the_sample_is_found() {
    let source = include_str!("../fixtures/sample.st");
    let checked = judge(source).unwrap_or_else(|findings| panic!("{}", listed(&findings, source)));
    let rows = faults::seed(source, &checked, 10, 1);
    println!("{}", faults::table(&rows));
    assert!(rows.iter().all(|row| row.seeded > 0 && row.caught == row.seeded), "{}", faults::table(&rows));
}
