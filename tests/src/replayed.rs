//! A violation in the simulator.

use crate::Texts;
use crate::bounds::BOUNDS;
use autogen::verify::replay::{Replay, replay};
use autogen::verify::{Asked, model};
use autogen_search::explore::explore;
use autogen_search::plant::Faults;

/// What the simulator makes of the first violation of a line that has one.
pub fn replayed(texts: &Texts, faults: Faults) -> Replay {
    let project = texts.project();
    let model = model(&project, &Asked::with(faults)).expect("a line that can be searched").model;
    let outcome = explore(&model, &BOUNDS, &mut |_| true);
    let (_, execution) = outcome.violations.first().expect("a violation");
    replay(&project, &model, execution).expect("a run")
}
