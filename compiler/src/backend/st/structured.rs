//! The same units with structures and enumerations, for tools that have them.
//!
//! What the portable text keeps in a variable for each coordinate and in an array for each cell is one variable of a
//! structure here. A block is given what it shares with others: values as inputs, everything that it writes and every
//! array by reference. So a block names nothing that stands outside of it.

mod access;
mod calls;
mod enumerations;
mod globals;
mod layout;
mod rewrite;
mod units;

use super::Line;
use super::context::Shared;
use super::declaration::Variable;
use super::globals::Index;
use super::program::Blocks;
use super::{block::Block, declaration::Unit};
use crate::ir::AutomatonId;
use crate::naming::st::Scope;
use access::Places;
use calls::Calls;
pub use enumerations::Enumerated;
use std::sync::Arc;
use units::Given;

/// The type of a point.
pub const POINT: &str = "ST_Point";

/// A structure, and its fields.
pub struct Structure {
    pub name: String,
    pub about: String,
    pub fields: Vec<Variable>,
}

/// What the line has alike in all flavours with structures.
pub struct Common {
    places: Places,
    /// For each robot.
    ports: Arc<Vec<Vec<Arc<Variable>>>>,
}

impl Common {
    pub fn new(shared: Shared, line: &Line) -> Self {
        Self { places: Places::shared(shared), ports: Arc::new(globals::ports(shared, line)) }
    }
}

/// The line with structures. `scope` has the names of the program.
pub fn structured<'a>(
    shared: Shared<'a>,
    line: &'a Line<'a>,
    common: &Common,
    enumerated: Enumerated,
    scope: &mut Scope,
) -> Line<'a> {
    let typed = enumerations::typed(shared, line, enumerated);
    let (globals, structures) = globals::globals(shared, line, common, &typed);
    let shared_places = &common.places;
    let index = Index::new(&globals);
    let of_unit = |unit: &Unit, id: Option<AutomatonId>| -> Given {
        let places = match id {
            Some(id) => shared_places.of_automaton(shared, id),
            None => shared_places.clone(),
        };
        units::unit(unit, &places, &index, &typed)
    };
    let layout = layout::unit(shared, line);
    let layout = units::unit(&layout, shared_places, &index, &typed);
    let mut given: Vec<Given> = vec![layout];
    given.push(of_unit(&line.watchdog, None));
    let blocks: Vec<Option<Blocks>> = (line.blocks.iter().enumerate())
        .map(|(id, blocks)| {
            let blocks = blocks.as_ref()?;
            let id = Some(AutomatonId(id));
            let mut structured = |block: &Block| {
                let of = of_unit(&block.unit, id);
                given.push(of.clone());
                Block { unit: of.unit, arguments: Vec::new() }
            };
            let steps = structured(&blocks.steps);
            let properties = blocks.properties.as_ref().map(structured);
            Some(Blocks { steps, properties })
        })
        .collect();
    let [layout, watchdog] = [0, 1].map(|i| given[i].unit.clone());
    let mut calls = Calls::new(shared, given, &line.program, shared_places);
    let mut globals = globals;
    globals.parameters.extend(calls.name_points(&line.blocks, scope));
    let program = units::program(&line.program, calls);
    let (functions, blocks, globals) = (line.functions.clone(), Arc::new(blocks), Arc::new(globals));
    Line { functions, blocks, watchdog, layout, program, globals, structures }
}
