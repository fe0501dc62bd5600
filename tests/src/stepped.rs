//! Runs that are the same however they are stepped.

use crate::Texts;
use autogen::executor::Executor;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, run};

/// The observer sees every scan of the first one.
pub fn report(texts: &Texts, mut observer: impl FnMut(&Seen)) -> Report {
    let project = texts.project();
    let execute = |stepping, see: &mut dyn FnMut(&Seen)| {
        run(&project.plant, &mut Executor::new(&project.system), stepping, see)
            .expect("a line that can be run")
    };
    let every = execute(Stepping::EveryScan, &mut observer);
    for stepping in [Stepping::Events, Stepping::Checked] {
        assert_eq!(execute(stepping, &mut |_| {}), every, "{stepping:?}");
    }
    every
}
