//! What the belts bring when the scenario gives no list.

use runtime_sim::random::Random;

/// A supply that is drawn: the same parts with each seed, in another order.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Parts of each kind, for each order.
    pub orders: Vec<Vec<u32>>,
    pub surplus: [u32; 2],
    /// They take the lots in turn.
    pub belts: Vec<usize>,
}

impl Drawn {
    /// For each belt the kinds that it brings, in order.
    pub fn supply(&self, seed: u32) -> Vec<(usize, Vec<usize>)> {
        let mut supply: Vec<(usize, Vec<usize>)> =
            self.belts.iter().map(|belt| (*belt, Vec::new())).collect();
        if supply.is_empty() {
            return supply;
        }
        let orders: Vec<&[u32]> = self.orders.iter().map(Vec::as_slice).collect();
        for (i, lot) in lots(&orders, self.surplus, seed).into_iter().enumerate() {
            supply[i % self.belts.len()].1.extend(lot);
        }
        supply
    }
}

/// How many parts of one kind the whole supply has beyond `needed`, rounded up.
pub fn surplus(needed: u64, [numerator, denominator]: [u32; 2]) -> u64 {
    (needed * u64::from(numerator)).div_ceil(u64::from(denominator))
}

/// One lot for each order: its parts and its share of the surplus, shuffled.
/// So no part passes long before it can be wanted; the last lot always has a share.
pub fn lots(orders: &[&[u32]], fraction: [u32; 2], seed: u32) -> Vec<Vec<usize>> {
    let kinds = orders.first().map_or(0, |parts| parts.len());
    let surplus: Vec<u64> = (0..kinds)
        .map(|kind| surplus(orders.iter().map(|parts| u64::from(parts[kind])).sum(), fraction))
        .collect();
    let count = orders.len() as u64;
    let mut random = Random::new(u64::from(seed));
    (0u64..)
        .zip(orders)
        .map(|(i, parts)| {
            let mut lot = Vec::new();
            for kind in 0..kinds {
                let share = surplus[kind] * (i + 1) / count - surplus[kind] * i / count;
                lot.extend((0..u64::from(parts[kind]) + share).map(|_| kind));
            }
            random.shuffle(&mut lot);
            lot
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_lot_has_the_parts_of_its_order_and_all_have_the_surplus() {
        let orders: Vec<&[u32]> = vec![&[1, 1, 1, 1]; 8];
        let lots = lots(&orders, [1, 3], 1);
        assert_eq!(lots.len(), 8);
        for kind in 0..4 {
            let of_kind = |lot: &Vec<usize>| lot.iter().filter(|k| **k == kind).count();
            assert!(lots.iter().all(|lot| of_kind(lot) >= 1));
            assert_eq!(lots.iter().map(of_kind).sum::<usize>(), 8 + 3);
            assert_eq!(of_kind(&lots[7]), 2);
        }
    }

    #[test]
    fn the_seed_decides() {
        let orders: Vec<&[u32]> = vec![&[1, 2, 3, 4]; 8];
        assert_eq!(lots(&orders, [1, 3], 7), lots(&orders, [1, 3], 7));
        assert_ne!(lots(&orders, [1, 3], 7), lots(&orders, [1, 3], 8));
    }

    #[test]
    fn no_surplus_is_possible() {
        assert_eq!(lots(&[&[2], &[0]], [0, 1], 1), vec![vec![0, 0], vec![]]);
    }
}
