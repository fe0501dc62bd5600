//! Regions that come one after the other: many become one that contains them.

use super::region::Region;

/// More regions become one.
const MOST: usize = 4;

/// The least one that contains them; none of none.
pub fn around(regions: &[Region]) -> Option<Region> {
    regions.iter().copied().reduce(joined)
}

fn joined(a: Region, b: Region) -> Region {
    [0, 1, 2].map(|i| [a[i][0].min(b[i][0]), a[i][1].max(b[i][1])])
}

pub fn few(regions: impl IntoIterator<Item = Region>) -> Vec<Region> {
    let mut few = Few::default();
    few.extend(regions);
    few.regions
}

/// Regions that come one after the other: they become one when there are too many.
#[derive(Default)]
pub struct Few {
    pub regions: Vec<Region>,
    are_one: bool,
}

impl Extend<Region> for Few {
    fn extend<T: IntoIterator<Item = Region>>(&mut self, regions: T) {
        for region in regions {
            match self.regions.last_mut() {
                Some(all) if self.are_one => *all = joined(*all, region),
                Some(last) if *last == region => {}
                _ => self.regions.push(region),
            }
            if self.regions.len() > MOST {
                self.regions = around(&self.regions).into_iter().collect();
                self.are_one = true;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_four_become_one() {
        let at = |x: f64| [[x, x], [0.0, 1.0], [2.0, 2.0]];
        assert_eq!(few([at(3.0), at(3.0), at(1.0), at(2.0), at(5.0)]), [3.0, 1.0, 2.0, 5.0].map(at));
        assert_eq!(few([3.0, 1.0, 2.0, 5.0, 0.0].map(at)), [[[0.0, 5.0], [0.0, 1.0], [2.0, 2.0]]]);
    }
}
