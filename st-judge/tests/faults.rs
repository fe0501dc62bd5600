//! Every seeded fault is found.

use autogen_st_judge::{faults, judge, listed};

#[test]
fn every_fault_in_the_sample_is_found() {
    let source = include_str!("../fixtures/sample.st");
    let checked = judge(source).unwrap_or_else(|findings| panic!("{}", listed(&findings, source)));
    let rows = faults::seed(source, &checked, usize::MAX, 1);
    println!("{}", faults::table(&rows));
    assert!(rows.iter().all(|row| row.seeded > 0 && row.caught == row.seeded), "{}", faults::table(&rows));
}

#[test]
fn the_published_list_is_whole() {
    let names: Vec<_> = faults::all().iter().map(|f| f.name).collect();
    assert_eq!(names[..39], faults::PUBLISHED);
}
