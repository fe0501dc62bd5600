//! What a run that is recorded is recorded by.

use crate::history::History;
use crate::io_trace::Source as Word;
use crate::line::Line;
use crate::path::{Path, Recorder};
use crate::plant::Plant;

pub struct Recorders {
    pub paths: Recorder,
    pub history: History,
}

impl Recorders {
    /// `watched` are the words of the controllers that are kept.
    pub fn new(line: &Line, watched: &[Word]) -> Self {
        Self { paths: Recorder::new(line), history: History::new(line, watched) }
    }

    /// At the end of the run.
    pub fn finish(self, plant: &Plant) -> (Vec<Path>, History) {
        (self.paths.finish(plant), self.history.finish(plant))
    }
}
