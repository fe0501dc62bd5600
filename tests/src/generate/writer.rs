//! What is known at a place of the text, and readings of it.

use super::lot::Lot;
use super::world::{Extent, Finite, Named, Rule, Ty, World};

/// Whether what is written may fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Caution {
    Safe,
    Risky,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    Guard,
    Update,
    /// A definition or an invariant: no `after`.
    Elsewhere,
}

pub struct Writer<'a> {
    pub lot: &'a mut Lot,
    pub world: &'a World,
    pub device: std::sync::Arc<autogen::device::Device>,
    /// Own names.
    pub names: Vec<Named>,
    /// Interfaces of this automaton, for `self`.
    pub own: Vec<String>,
    /// Roles with their interfaces.
    pub roles: Vec<(String, Vec<String>)>,
    /// Variables of binders and quantifiers in scope.
    pub variables: Vec<(String, Ty)>,
    /// Readings whose bounds the guard has narrowed.
    pub facts: Vec<(String, Ty)>,
    /// Readings that the guard has proved to differ from 0.
    pub divisors: Vec<String>,
    /// Names that must keep their values, since facts are about them.
    pub frozen: Vec<String>,
    pub caution: Caution,
    pub stage: Stage,
    /// Something written in this transition may fault.
    pub faults: usize,
}

/// Names of variables. They are few, so that definitions, guards and updates share them; some are names that generated
/// texts have for variables of their own.
const VARIABLES: [&str; 12] =
    ["element", "element", "element2", "j", "j", "number", "row", "best", "key", "holds", "found", "Element"];

impl Writer<'_> {
    /// A name that no variable in scope has.
    pub fn new_variable(&mut self) -> String {
        let is_free = |name: &str| self.variables.iter().all(|(known, _)| known != name);
        let names = VARIABLES.iter().map(|name| name.to_string());
        let further = (0..=self.variables.len()).map(|number| format!("v{number}"));
        let free: Vec<String> = names.chain(further).filter(|name| is_free(name)).collect();
        self.lot.pick(&free).clone()
    }

    /// A text that reads a value whose type fits, and its type.
    pub fn reading(&mut self, fits: &dyn Fn(&Ty) -> bool) -> Option<(String, Ty)> {
        if self.lot.one_in(3)
            && let Some(found) = self.shown(fits, 2)
        {
            return Some(found);
        }
        let narrowed = self.variables.iter().chain(&self.facts).filter(|(_, ty)| fits(ty));
        let narrowed: Vec<(String, Ty)> = narrowed.cloned().collect();
        if !narrowed.is_empty() && self.lot.below(5) < 3 {
            return Some(self.lot.pick(&narrowed).clone());
        }
        let is_safe = self.caution == Caution::Safe;
        let own = self.names.iter().filter(|n| fits(&n.ty) && !(is_safe && n.finite == Finite::Perhaps));
        let own: Vec<Named> = own.cloned().collect();
        if own.is_empty() {
            return self.shown(fits, 1);
        }
        let defined: Vec<&Named> = own.iter().filter(|n| is_definition(&n.name)).collect();
        if !defined.is_empty() && self.lot.one_in(3) {
            let named = self.lot.pick(&defined);
            return Some((named.name.clone(), named.ty.clone()));
        }
        let named = self.lot.pick(&own).clone();
        let text = self.element(&named.name, &named.extent);
        Some((text, named.ty))
    }

    /// A cell or parameter that a neighbour shows.
    fn shown(&mut self, fits: &dyn Fn(&Ty) -> bool, depth: usize) -> Option<(String, Ty)> {
        let interface = self.lot.pick(&["Shelf", "Shelf", "Post"]).to_string();
        let of = self.plain_reference(&interface, depth)?;
        let shown = self.world.interface(&interface)?;
        let fitting: Vec<&Named> =
            shown.parameters.iter().chain(&shown.cells).filter(|n| fits(&n.ty)).collect();
        if fitting.is_empty() {
            return None;
        }
        let named = (*self.lot.pick(&fitting)).clone();
        let text = self.element(&format!("{of}.{}", named.name), &named.extent);
        Some((text, named.ty))
    }

    /// A reference behind which a `.` can stand.
    pub fn plain_reference(&mut self, interface: &str, depth: usize) -> Option<String> {
        let wanted = Ty::Ref(interface.into());
        let bound = self.variables.iter().filter(|(_, ty)| *ty == wanted);
        let bound: Vec<String> = bound.map(|(name, _)| name.clone()).collect();
        if !bound.is_empty() && !self.lot.one_in(4) {
            return Some(self.lot.pick(&bound).clone());
        }
        if depth > 0 && self.lot.one_in(5) {
            let of = self.plain_reference("Shelf", depth - 1)?;
            if interface == "Shelf" {
                let way = *self.lot.pick(&["friend", "friends", "partner"]);
                return Some(match way {
                    "friends" => self.element(&format!("{of}.friends"), &Extent::Count(3)),
                    way => format!("{of}.{way}"),
                });
            }
        }
        let own: Vec<Named> = self.names.iter().filter(|n| n.ty == wanted).cloned().collect();
        if own.is_empty() {
            return None;
        }
        let named = self.lot.pick(&own).clone();
        Some(self.element(&named.name, &named.extent))
    }

    /// A reading, with an index if it is an array.
    pub fn element(&mut self, text: &str, extent: &Extent) -> String {
        match extent {
            Extent::One => text.into(),
            extent => format!("{text}[{}]", self.index(extent)),
        }
    }

    /// An index that is proved to be within an array.
    pub fn index(&mut self, extent: &Extent) -> String {
        let n = match extent {
            Extent::One => 1,
            Extent::By(name) => return self.index_by(name),
            Extent::Count(n) => *n as i64,
        };
        let inside = |ty: &Ty| matches!(ty, Ty::Int(lo, hi) if *lo >= 0 && *hi < n);
        let known: Vec<String> = self
            .variables
            .iter()
            .chain(&self.facts)
            .filter(|(_, ty)| inside(ty))
            .map(|(name, _)| name.clone())
            .collect();
        if !known.is_empty() && !self.lot.one_in(3) {
            return self.lot.pick(&known).clone();
        }
        let own = self.names.iter().filter(|v| inside(&v.ty) && v.extent == Extent::One);
        let own: Vec<String> = own.map(|v| v.name.clone()).collect();
        let whole = self.names.iter().filter(|v| matches!(v.ty, Ty::Int(..)) && v.extent == Extent::One);
        let whole: Vec<String> = whole.map(|v| v.name.clone()).collect();
        match self.lot.below(6) {
            0 if !whole.is_empty() => {
                format!("min(max({}, 0), {})", self.lot.pick(&whole), n - 1)
            }
            1 if !whole.is_empty() => format!("abs({} mod {n})", self.lot.pick(&whole)),
            2..4 if !own.is_empty() => self.lot.pick(&own).clone(),
            _ => self.lot.below(n as usize).to_string(),
        }
    }

    fn index_by(&mut self, name: &str) -> String {
        let wanted = Ty::Enum(name.into());
        let bound = self.variables.iter().filter(|(_, ty)| *ty == wanted).map(|(name, _)| name.clone());
        let own = self.names.iter().filter(|n| n.ty == wanted && n.extent == Extent::One);
        let known: Vec<String> = bound.chain(own.map(|n| n.name.clone())).collect();
        if known.is_empty() || self.lot.one_in(3) {
            return self.lot.pick(self.world.members(name)).clone();
        }
        self.lot.pick(&known).clone()
    }

    /// Arrays that can be read as a whole.
    pub fn arrays(&mut self) -> Vec<Named> {
        let is_safe = self.caution == Caution::Safe;
        let own = self.names.iter().filter(|n| n.extent != Extent::One && n.ty != Ty::Ref(String::new()));
        let mut arrays: Vec<Named> =
            own.filter(|n| !(is_safe && n.finite == Finite::Perhaps)).cloned().collect();
        if let Some(of) = self.plain_reference("Shelf", 1) {
            let shown =
                self.world.interface("Shelf").into_iter().flat_map(|i| i.parameters.iter().chain(&i.cells));
            arrays.extend(shown.filter(|n| n.extent != Extent::One).map(|n| Named {
                name: format!("{of}.{}", n.name),
                rule: Rule::Fixed,
                ..n.clone()
            }));
        }
        arrays
    }
}

/// Definitions are `d0`, `d1` and so on.
pub fn is_definition(name: &str) -> bool {
    name.strip_prefix('d').is_some_and(|rest| rest.parse::<u8>().is_ok())
}
