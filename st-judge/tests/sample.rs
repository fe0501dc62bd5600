//! The sample by hand keeps every rule, and runs.

use autogen_st_judge::{judge, listed, machine::Machine};

const SAMPLE: &str = include_str!("../fixtures/sample.st");

#[test]
fn the_sample_is_clean() {
    if let Err(findings) = judge(SAMPLE) {
        panic!("{}", listed(&findings, SAMPLE));
    }
}

#[test]
fn the_sample_makes_parts() {
    let mut machine = Machine::new(SAMPLE).expect("a clean text");
    for (name, value) in
        [("run_permit", 1.0), ("cart1_ready", 1.0), ("cart2_ready", 1.0), ("press1_pressure", 3.0)]
    {
        machine.set(name, value);
    }
    for scan in 0..2000 {
        machine.set("start", f64::from(scan > 1));
        for cart in ["cart1", "cart2"] {
            let command = machine.get(&format!("{cart}_cmd"));
            machine.set(&format!("{cart}_got"), command);
            machine.set(&format!("{cart}_ack"), command);
        }
        machine.scan().unwrap();
    }
    assert_eq!((machine.get("fault_code"), machine.get("running")), (0.0, 1.0));
    assert!(machine.get("parts_made") > 10.0);
}
