//! Where the updates of a cell write.

use super::few::Few;
use super::region::Region;
use std::cell::OnceCell;

/// What one update writes into a cell.
pub struct WrittenBy {
    /// The members whose cell it may be.
    pub rows: Vec<usize>,
    /// None: that is not known.
    pub regions: Option<Vec<Region>>,
}

/// What all updates of a cell write.
pub struct Written {
    /// Those of any member have no rows.
    updates: Vec<WrittenBy>,
    /// The updates of the cell of each member, ascending, without those of any.
    by_member: Vec<Vec<usize>>,
    /// Those of any member, ascending.
    of_any: Vec<usize>,
    /// Into the cells of all members together.
    whole: OnceCell<Option<Vec<Region>>>,
}

impl Written {
    /// Each update may write to some member.
    pub fn new(members: usize, updates: impl Iterator<Item = WrittenBy>) -> Self {
        let (mut all, mut by_member, mut of_any) = (Vec::new(), vec![Vec::new(); members], Vec::new());
        for mut update in updates {
            if update.rows.len() == members {
                update.rows = Vec::new();
                of_any.push(all.len());
            }
            update.rows.iter().for_each(|row| by_member[*row].push(all.len()));
            all.push(update);
        }
        Self { updates: all, by_member, of_any, whole: OnceCell::new() }
    }

    /// Where these updates may write; they ascend.
    fn together(&self, updates: impl IntoIterator<Item = usize>) -> Option<Vec<Region>> {
        let mut all = Few::default();
        for update in updates {
            all.extend(self.updates[update].regions.as_ref()?.iter().copied());
        }
        Some(all.regions)
    }

    /// Where they write into the cells of these members, which differ; none where that is not known.
    pub fn of_members(&self, rows: &[usize]) -> Option<Vec<Region>> {
        if rows.is_empty() {
            return Some(Vec::new());
        }
        let all = 0..self.updates.len();
        if rows.len() == self.by_member.len() {
            return self.whole.get_or_init(|| self.together(all)).clone();
        }
        let named: usize = rows.iter().map(|row| self.by_member[*row].len()).sum();
        if named < all.len() {
            let mut updates = self.of_any.clone();
            rows.iter().for_each(|row| updates.extend(&self.by_member[*row]));
            updates.sort_unstable();
            updates.dedup();
            return self.together(updates);
        }
        let mut is_asked = vec![false; self.by_member.len()];
        rows.iter().for_each(|row| is_asked[*row] = true);
        self.together(all.filter(|update| {
            let rows = &self.updates[*update].rows;
            rows.is_empty() || rows.iter().any(|row| is_asked[*row])
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::super::few::few;
    use super::*;
    use runtime_sim::random::Random;

    #[test]
    fn what_is_written_into_cells_of_members_is_that_of_all_updates_that_name_one_of_them() {
        const MEMBERS: usize = 6;
        let mut random = Random::new(5);
        let mut drawn = |one_in: u32| -> Vec<usize> {
            (0..MEMBERS).filter(|_| one_in == 0 || random.up_to(one_in) == 0).collect()
        };
        for round in 0..200 {
            // Of few members, of many, of all.
            let rows =
                (0..10).map(|update| drawn([3, 5, 1, 0][(update + round) % if round < 100 { 2 } else { 4 }]));
            let rows: Vec<Vec<usize>> = rows.filter(|rows| !rows.is_empty()).collect();
            let region =
                |update: usize| (update != 7 || round % 5 > 0).then(|| vec![[[update as f64; 2]; 3]]);
            let updates = rows.iter().enumerate();
            let written = Written::new(
                MEMBERS,
                updates.map(|(number, rows)| WrittenBy { rows: rows.clone(), regions: region(number) }),
            );
            for asked in [drawn(3), drawn(1), drawn(0), Vec::new()] {
                let is_meant = |rows: &[usize]| rows.iter().any(|row| asked.contains(row));
                let meant = rows.iter().enumerate().filter(|(_, rows)| is_meant(rows));
                let regions: Option<Vec<Vec<Region>>> = meant.map(|(number, _)| region(number)).collect();
                let expected = regions.map(|regions| few(regions.into_iter().flatten()));
                assert_eq!(written.of_members(&asked), expected, "{rows:?}, {asked:?}");
            }
        }
    }
}
