//! Going on after a loss of power or a download: what is retained, and the first scan after it.
//!
//! Retained variables are declared so, and the first scan leaves them alone if [`WARM`] says that all of them are of
//! this program and of one scan. Otherwise everything has its initial value.

use super::block::{Candidate, kept_values};
use super::code::{Arm, Ex, Stmt, and, assign, binary, name, not, when};
use super::context::{Lowering, Shared};
use super::declaration::{Basic, Variable};
use super::filling::Filling;
use super::globals::{Globals, Table};
use super::name::Name;
use super::names::ELEMENT;
use super::value::NOT_RETAINED;
use crate::ir::InterfaceId;
use crate::version;

/// The first scan begins with what was retained.
pub const WARM: &str = "warm_start";
/// Of which program the retained values are.
const OF: &str = "retained_of";
/// They are all of one scan.
const WHOLE: &str = "retained_whole";

/// Of which program the values of all variables are. It is a variable of MAIN, and not retained: where a download gives the
/// instances of the blocks their initial values, it gets its own.
pub const VALUES_OF: &str = "values_of";

/// In what is retained as a whole: a block, or the cells of an interface. It is false where that was not kept.
pub const KEPT: &str = "kept";

/// The mark of a block or of a structure.
pub fn mark() -> Variable {
    let about = "false in the first scan if what is retained here was not kept";
    Variable::new(KEPT, Basic::Bool).with_comment(about).retained(true)
}

/// Whether a cell of any member of its interface is retained.
pub fn retains_cell(shared: Shared, interface: InterfaceId, cell: usize) -> bool {
    let instances = shared.system.members[interface.0].iter();
    let mut automata = instances.map(|instance| shared.system.automaton_of(*instance));
    automata.any(|automaton| automaton.retained.cells.contains(&(interface, cell)))
}

pub fn variables(shared: Shared) -> Vec<Variable> {
    if !shared.system.model.retains() {
        return Vec::new();
    }
    let variable = |name: &str, basic: Basic, initial: Ex, about: &str| {
        Variable::new(name, basic).with_initial(initial).with_comment(about)
    };
    vec![
        variable(WARM, Basic::Bool, Ex::Bool(false), "the first scan begins with retained values"),
        variable(OF, Basic::Dint, Ex::Int(0), "identifies the program of the retained values; 0: none")
            .retained(true),
        variable(WHOLE, Basic::Bool, Ex::Bool(false), "all retained values are of one scan").retained(true),
    ]
}

/// A variable of MAIN.
pub fn values_of() -> Variable {
    Variable::new(VALUES_OF, Basic::Dint).with_comment("identifies the program of the last scan; 0: none")
}

/// Another one if a file, a parameter, or autogen is another one. Never 0.
fn program_number(shared: Shared) -> i32 {
    let number = shared.sources.hash() ^ shared.system.shape_of_instances() as i32 ^ version::number();
    number.max(1)
}

/// The first statement of MAIN.
pub fn begin_anew(shared: Shared) -> Stmt {
    let number = || Ex::Int(program_number(shared));
    let mut anew = vec![
        Stmt::Comment(
            "The first scan of this program: after power-up, a download, or an online change.".into(),
        ),
        assign("init_done", Ex::Bool(false)),
        assign("running", Ex::Bool(false)),
        Stmt::Comment("No edge.".into()),
        assign("start_before", Ex::Bool(true)),
        assign("reset_before", Ex::Bool(true)),
    ];
    if !shared.system.model.retains() {
        anew.extend([assign("fault_code", Ex::Int(0)), assign("fault_robot", Ex::Int(-1))]);
    }
    anew.push(assign(VALUES_OF, number()));
    when(binary("<>", name(VALUES_OF), number()), anew)
}

/// What follows. `retained` are the instances of blocks that have a [`mark`].
pub fn begin<'n>(shared: Shared, retained: impl Iterator<Item = &'n str>) -> Vec<Stmt> {
    if !shared.system.model.retains() {
        return Vec::new();
    }
    let shape = || Ex::Int(shared.system.shape_of_retained() as i32);
    let is_cold = || not(name(WARM));
    let lost = |condition: Ex, code: i32| Arm {
        comments: Vec::new(),
        condition,
        body: vec![assign("fault_code", Ex::Int(code)), assign("fault_robot", Ex::Int(-1))],
    };
    let mut first = vec![
        Stmt::Comment(
            "Retained values are used if they are of this program and of one scan, and all are there.".into(),
        ),
        assign(WARM, and(vec![name(WHOLE), binary("=", name(OF), shape())])),
    ];
    let mark = |instance: &str| Ex::Field(instance.into(), KEPT.into());
    first.extend(retained.map(|instance| assign(WARM, and(vec![name(WARM), mark(instance)]))));
    first.extend([
        Stmt::If(
            vec![
                lost(and(vec![is_cold(), binary("<>", name(OF), Ex::Int(0))]), NOT_RETAINED),
                lost(is_cold(), 0),
            ],
            Vec::new(),
        ),
        assign(OF, shape()),
    ]);
    vec![when(not(name("init_done")), first), assign(WHOLE, Ex::Bool(false))]
}

/// The end of MAIN.
pub fn end(shared: Shared) -> Option<Stmt> {
    shared.system.model.retains().then(|| assign(WHOLE, Ex::Bool(true)))
}

/// Cells at power-up, in the block of the layout.
pub fn cells(cells: &[Table]) -> Vec<Stmt> {
    let of = |is_retained: bool| {
        let tables = cells.iter().filter(|table| table.variable.is_retained == is_retained);
        Filling::new(tables, ELEMENT).statements()
    };
    let (mut out, retained) = (of(false), of(true));
    if !retained.is_empty() {
        out.push(when(not(name(WARM)), retained));
    }
    out
}

impl Lowering<'_> {
    /// What the block of a robot does in the first scan.
    pub fn power_up(&self, kept: &[&Candidate], globals: &Globals) -> Vec<Stmt> {
        let automaton = self.automaton();
        let first_state = || Ex::Member(self.state(self.id, 0));
        let beginning = || assign("state", first_state());
        let retained = &automaton.retained;
        if retained.is_empty() {
            let mut body = vec![beginning(), assign("elapsed", Ex::Int(0))];
            body.extend(kept_values(kept));
            body.extend(self.own_cells(globals, |table| table.variable.is_retained));
            return body;
        }
        let (stays, begins): (Vec<&Candidate>, Vec<&Candidate>) =
            kept.iter().copied().partition(|candidate| candidate.variable.is_retained);
        let outputs = self.outputs_that_stop();
        let commands: Vec<&Candidate> =
            stays.iter().filter(|candidate| outputs.contains(&&candidate.variable.name)).copied().collect();
        let mut cold = Vec::new();
        let mut body = Vec::new();
        if retained.state { &mut cold } else { &mut body }.push(beginning());
        cold.extend(kept_values(&stays));
        body.insert(0, when(not(name(WARM)), cold));
        let resumable: Vec<usize> = automaton.resumable().collect();
        let begins_anew: Vec<Ex> = (1..automaton.states.len())
            .filter(|state| retained.state && !resumable.contains(state))
            .map(|state| binary("=", name("state"), Ex::Member(self.state(self.id, state))))
            .collect();
        if !begins_anew.is_empty() {
            body.push(Stmt::Comment("It continues only in states that say `resume`.".into()));
            body.push(when(super::code::or(begins_anew), vec![beginning()]));
        }
        if !commands.is_empty() {
            body.push(Stmt::Comment("From its beginning no earlier command is finished.".into()));
            let commands = kept_values(&commands);
            match retained.state {
                true => body.push(when(binary("=", name("state"), first_state()), commands)),
                false => body.extend(commands),
            }
        }
        body.push(assign("elapsed", Ex::Int(0)));
        let told: Vec<Name> = (automaton.abandoned.iter().chain(&automaton.interrupted))
            .map(|local| self.own().locals[*local][0].clone())
            .collect();
        let others: Vec<&Candidate> =
            begins.into_iter().filter(|c| !retained.state || !told.contains(&c.variable.name)).collect();
        body.extend(kept_values(&others));
        body.extend(self.own_cells(globals, |table| {
            table.variable.is_retained && !self.retains_own(&table.variable.name)
        }));
        if let ([abandoned, interrupted], true) = (told.as_slice(), retained.state) {
            let goes_on = binary("<>", name("state"), first_state());
            body.push(assign(abandoned, binary("<>", self.command_number(), Ex::Int(0))));
            body.push(assign(interrupted, and(vec![name(abandoned), goes_on])));
        }
        body
    }

    /// Whether the robot retains its own element of this array of cells.
    pub fn retains_own(&self, wanted: &str) -> bool {
        self.automaton().retained.cells.iter().any(|(interface, cell)| {
            self.names.interfaces[interface.0].cells[*cell].iter().any(|held| held == wanted)
        })
    }

    fn command_number(&self) -> Ex {
        let port = self.automaton().device.ports.iter().position(|port| port.name == "cmd");
        port.map_or(Ex::Int(0), |port| name(&self.own().ports[port][0]))
    }

    /// The answer to the last command does not count.
    pub fn is_abandoned(&self) -> Option<Ex> {
        self.automaton().abandoned.map(|local| name(&self.own().locals[local][0]))
    }

    /// The last command counts as failed.
    pub fn is_interrupted(&self) -> Option<Ex> {
        self.automaton().interrupted.map(|local| name(&self.own().locals[local][0]))
    }
}
