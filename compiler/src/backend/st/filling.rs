//! Statements that give tables their values.

use super::code::{Ex, Stmt, advance, assign, binary, name};
use super::globals::Table;
use super::name::Name;
use super::values::Values;
use std::ops::Range;
use std::sync::Arc;

/// Tables of so many elements get the value of most of them by a loop, then the others theirs.
const LONG: usize = 16;

/// So many assignments of single elements are made at once.
const PIECE: usize = 1000;

/// How all elements of tables get their values: by loops where they are alike, the others one by one.
pub struct Filling {
    pub loops: Vec<Stmt>,
    pub others: Vec<Others>,
}

/// Some elements of a table.
pub struct Others {
    pub table: Name,
    values: Arc<Values>,
    elements: Range<usize>,
    /// A loop gives them this.
    usual: Option<Ex>,
}

impl Filling {
    pub fn new<'a>(tables: impl IntoIterator<Item = &'a Table>, counter: &str) -> Self {
        let mut alike: Vec<(usize, Vec<Stmt>)> = Vec::new();
        let mut others = Vec::new();
        for table in tables {
            let n = table.values.len();
            let usual = usual(&table.values);
            if let Some(value) = &usual {
                let target = Ex::Element(table.variable.name.clone(), Box::new(name(counter)));
                let store = Stmt::Assign(target, value.clone());
                match alike.iter_mut().find(|(size, _)| *size == n) {
                    Some((_, stores)) => stores.push(store),
                    None => alike.push((n, vec![store])),
                }
            }
            others.extend((0..n).step_by(PIECE).map(|first| Others {
                table: table.variable.name.clone(),
                values: table.values.clone(),
                elements: first..n.min(first + PIECE),
                usual: usual.clone(),
            }));
        }
        let mut loops = Vec::new();
        for (n, mut stores) in alike {
            stores.push(advance(counter));
            loops.push(assign(counter, Ex::Int(0)));
            let condition = binary("<", name(counter), Ex::Int(n as i32));
            loops.push(Stmt::While { condition, body: stores, most: n as u64 });
        }
        Self { loops, others }
    }

    /// All statements.
    pub fn statements(self) -> Vec<Stmt> {
        self.loops.into_iter().chain(self.others.iter().flat_map(Others::statements)).collect()
    }
}

impl Others {
    pub fn statements(&self) -> Vec<Stmt> {
        let elements = self.elements.clone().filter_map(|i| Some((i, self.values.get(i)?)));
        let others = elements.filter(|(_, value)| self.usual.as_ref() != Some(value));
        let store = |(i, value): (usize, Ex)| {
            Stmt::Assign(Ex::Element(self.table.clone(), Box::new(Ex::Int(i as i32))), value)
        };
        others.map(store).collect()
    }
}

/// The value of all elements, or of a long table the one that most of them have; none if there is no such value.
fn usual(values: &Values) -> Option<Ex> {
    // The only one that more than half of the elements can have.
    let (mut candidate, mut lead) = (values.get(0)?, 0);
    for value in values.iter() {
        match (value == candidate, lead) {
            (true, _) => lead += 1,
            (false, 0) => (candidate, lead) = (value, 1),
            (false, _) => lead -= 1,
        }
    }
    let count = values.iter().filter(|value| *value == candidate).count();
    let is_usual = count == values.len() || values.len() >= LONG && 2 * count > values.len();
    (values.len() > 2 && is_usual).then_some(candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(texts: &str) -> Values {
        texts.chars().map(|c| Ex::Bool(c == '1')).collect()
    }

    #[test]
    fn a_loop_gives_what_most_elements_of_a_long_table_have() {
        assert_eq!(usual(&values("111")), Some(Ex::Bool(true)));
        assert_eq!(usual(&values("110")), None, "short");
        assert_eq!(usual(&values("11")), None, "two assignments are shorter");
        assert_eq!(usual(&values("0111111111111110")), Some(Ex::Bool(true)));
        assert_eq!(usual(&values("1100110011001100")), None, "half of them");
        assert_eq!(usual(&values("1100110011001000")), Some(Ex::Bool(false)));
        assert_eq!(usual(&values("")), None);
    }
}
