//! What guards and properties have decided before. A step that reads the same values takes the same transition, so guards are
//! evaluated once; then what they have asked is asked again, in the same order.

use crate::model::Model;
use crate::program::{Instance, Int};
use crate::property::Always;
use crate::scan::Scan;
use crate::value::{Count, Var};

/// So many nodes and outcomes, at most.
const MOST: usize = 1 << 16;
/// What asks more questions than this is evaluated each time.
const MOST_QUESTIONS: usize = 256;

/// Decision trees.
#[derive(Default)]
pub(crate) struct Decisions {
    /// Of each state of each instance, then of each property of each instance.
    roots: Vec<Next>,
    /// Where those of an instance begin: of its states, and of its properties.
    begins: Vec<[usize; 2]>,
    nodes: Vec<Node>,
    outcomes: Vec<Outcome>,
    /// What is asked by what is evaluated, and the answers.
    asked: Vec<(Question, i32)>,
    records: Records,
    /// Only places and reals that had a number then have the same one from now on.
    pub numbered: Option<Count>,
}

#[derive(Clone, Copy, PartialEq, Eq, Default)]
enum Records {
    #[default]
    Off,
    On,
    /// From here on the outcome depends on more than answers.
    Ended,
}

#[derive(Clone, Copy)]
enum Next {
    /// It has not come up.
    New,
    /// This node tells.
    Node(u32),
    /// No transition fires; the condition does not hold.
    No,
    /// Index into the outcomes.
    Yes(u32),
    /// The outcome depends on more than answers.
    Open,
}

/// What guards ask, and get the same answer each time in one step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Question {
    Value(Var),
    /// The value of an input that changes by itself.
    Input(usize),
}

struct Node {
    question: Question,
    /// The answer that came up first, and what comes then: it stands here, where it is found at once.
    first: (i32, Next),
    /// The same of all others, in the order of the answers.
    others: Vec<(i32, Next)>,
}

struct Outcome {
    /// Of a state, which fires; of an `invariant`, one of [`Kept`]; 0 of another property.
    transition: usize,
    /// What its binders have chosen.
    variables: Box<[i32]>,
}

/// Why an `invariant` holds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kept {
    Holds,
    /// Nothing but its excuse was asked.
    Excused,
}

impl Decisions {
    pub fn new(model: &Model) -> Self {
        let mut found = Self::default();
        for Instance { states, properties, .. } in &model.instances {
            let begin = found.roots.len();
            found.begins.push([begin, begin + states.len()]);
            found.roots.resize(begin + states.len() + properties.len(), Next::New);
        }
        found
    }

    /// Bytes of memory that it takes.
    pub fn size(&self) -> usize {
        let of_node = |node: &Node| size_of::<Node>() + node.others.capacity() * size_of::<(i32, Next)>();
        let of_outcome = |outcome: &Outcome| size_of::<Outcome>() + size_of_val(&*outcome.variables);
        let nodes: usize = self.nodes.iter().map(of_node).sum();
        nodes + self.outcomes.iter().map(of_outcome).sum::<usize>()
    }

    #[inline]
    pub fn note(&mut self, question: Question, answer: i32) {
        if self.records == Records::On && self.asked.iter().all(|(other, _)| *other != question) {
            self.asked.push((question, answer));
        }
    }

    /// What comes next depends on more than values.
    pub fn end_record(&mut self) {
        if self.records == Records::On {
            self.records = Records::Ended;
        }
    }

    fn after(&self, node: u32, value: i32) -> Next {
        let Node { first, others, .. } = &self.nodes[node as usize];
        if first.0 == value {
            return first.1;
        }
        others.binary_search_by_key(&value, |(other, _)| *other).map_or(Next::New, |found| others[found].1)
    }

    /// Adds what was asked, and the outcome.
    fn learn(&mut self, root: usize, outcome: Next) {
        let mut at = At::Root(root);
        for (question, answer) in std::mem::take(&mut self.asked) {
            let next = match self.next(at) {
                Next::Node(node) => node,
                _ => {
                    self.nodes.push(Node { question, first: (answer, Next::New), others: Vec::new() });
                    let node = (self.nodes.len() - 1) as u32;
                    self.set(at, Next::Node(node));
                    node
                }
            };
            debug_assert_eq!(self.nodes[next as usize].question, question);
            at = At::Node(next, answer);
        }
        self.set(at, outcome);
    }

    fn next(&self, at: At) -> Next {
        match at {
            At::Root(root) => self.roots[root],
            At::Node(node, answer) => self.after(node, answer),
        }
    }

    fn set(&mut self, at: At, next: Next) {
        match at {
            At::Root(root) => self.roots[root] = next,
            At::Node(node, answer) => {
                let Node { first, others: all, .. } = &mut self.nodes[node as usize];
                if first.0 == answer {
                    first.1 = next;
                    return;
                }
                match all.binary_search_by_key(&answer, |(other, _)| *other) {
                    Ok(found) => all[found].1 = next,
                    Err(place) => all.insert(place, (answer, next)),
                }
            }
        }
    }
}

/// Where an outcome or a node stands.
#[derive(Clone, Copy)]
enum At {
    Root(usize),
    /// Of a node, by the answer.
    Node(u32, i32),
}

impl Scan<'_> {
    /// The first transition of a state whose clauses hold; the variables of its binders are as chosen.
    pub(crate) fn decide(&mut self, instance: usize, state: usize) -> Option<usize> {
        self.not_passed = i32::MAX;
        let root = self.decisions.begins.get(instance).map(|[states, _]| states + state);
        self.look_up(root, self.model.instances[instance].variables, |scan| {
            let transitions = &scan.model.instances[instance].states[state].transitions;
            transitions.iter().position(|transition| scan.choose(&transition.clauses))
        })
    }

    /// Whether the condition of a property of an instance holds.
    pub(crate) fn decide_condition(&mut self, instance: usize, property: usize, condition: &Int) -> bool {
        let root = self.decisions.begins.get(instance).map(|[_, properties]| properties + property);
        self.look_up(root, 0, |scan| scan.holds(condition).then_some(0)).is_some()
    }

    /// None: it does not hold.
    pub(crate) fn decide_always(
        &mut self,
        instance: usize,
        property: usize,
        always: &Always,
    ) -> Option<Kept> {
        let root = self.decisions.begins.get(instance).map(|[_, properties]| properties + property);
        let found = self.look_up(root, 0, |scan| {
            let is_excused = always.excuse.as_ref().is_some_and(|excuse| scan.holds(excuse));
            let kept = if is_excused { Kept::Excused } else { Kept::Holds };
            (is_excused || scan.holds(&always.condition)).then_some(kept as usize)
        });
        found.map(|kept| if kept == Kept::Excused as usize { Kept::Excused } else { Kept::Holds })
    }

    /// The outcome, of which the first variables are a part.
    fn look_up(
        &mut self,
        root: Option<usize>,
        variables: usize,
        evaluate: impl FnOnce(&mut Self) -> Option<usize>,
    ) -> Option<usize> {
        let Some(root) = root else { return evaluate(self) };
        let mut next = self.decisions.roots[root];
        loop {
            match next {
                Next::Node(node) => {
                    let answer = self.ask(self.decisions.nodes[node as usize].question);
                    next = self.decisions.after(node, answer);
                }
                Next::No => return None,
                Next::Yes(outcome) => {
                    let Outcome { transition, variables } = &self.decisions.outcomes[outcome as usize];
                    self.variables[..variables.len()].copy_from_slice(variables);
                    return Some(*transition);
                }
                Next::Open => return evaluate(self),
                Next::New => break,
            }
        }
        let has_new_values = self.decisions.numbered != Some(self.values.count());
        if has_new_values || self.decisions.nodes.len() + self.decisions.outcomes.len() >= MOST {
            return evaluate(self);
        }
        self.decisions.asked.clear();
        self.decisions.records = Records::On;
        let found = evaluate(self);
        let has_ended = std::mem::take(&mut self.decisions.records) == Records::Ended;
        let outcome = match found {
            _ if has_ended => Next::Open,
            _ if self.decisions.asked.len() > MOST_QUESTIONS => {
                self.decisions.asked.clear();
                Next::Open
            }
            None => Next::No,
            Some(transition) => {
                let variables = self.variables[..variables].into();
                self.decisions.outcomes.push(Outcome { transition, variables });
                Next::Yes((self.decisions.outcomes.len() - 1) as u32)
            }
        };
        self.decisions.learn(root, outcome);
        found
    }

    fn ask(&mut self, question: Question) -> i32 {
        match question {
            Question::Value(var) => self.read(var),
            Question::Input(input) => self.input(input),
        }
    }
}
