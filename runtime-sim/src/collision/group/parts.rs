//! What moves on a machine: items on its conveyors, and cylinders.

use super::{Anchor, Body};
use crate::fingerprint::Fingerprint;
use crate::part::stroke::Stroking;
use crate::plant::Plant;
use crate::plant::conveyed::Conveyed;

/// How items and cylinders continue from the last look on, by their numbers, in the order of the bodies.
#[derive(Clone, Debug, Default)]
pub struct Parts {
    conveyed: Vec<(usize, Conveyed)>,
    strokes: Vec<(usize, Stroking)>,
}

impl Parts {
    /// None of an item that lies where nothing conveys or carries it.
    pub fn conveyed(&self, item: usize) -> Option<&Conveyed> {
        find(&self.conveyed, item)
    }

    pub fn stroking(&self, part: usize) -> Option<&Stroking> {
        find(&self.strokes, part)
    }

    pub fn strokes(&self) -> impl Iterator<Item = &Stroking> {
        self.strokes.iter().map(|(_, stroking)| stroking)
    }

    pub fn moves(&self) -> bool {
        self.conveyed.iter().any(|(_, conveyed)| conveyed.moves()) || self.strokes().any(Stroking::moves)
    }

    /// Seconds until the first of them rests; infinity: none moves, or never.
    pub fn rests_after(&self) -> f64 {
        let items = self.conveyed.iter().filter(|(_, conveyed)| conveyed.moves());
        let items = items.map(|(_, conveyed)| conveyed.rests_after());
        items.chain(self.strokes().map(Stroking::rests_after)).fold(f64::INFINITY, f64::min)
    }

    /// Of how they continue; none if a cylinder moves or carries one of them.
    pub fn law(&self) -> Option<Fingerprint> {
        if self.strokes().any(Stroking::moves) {
            return None;
        }
        let mut laws = self.conveyed.iter().map(|(_, conveyed)| conveyed.law());
        laws.try_fold(Fingerprint::default(), |all, law| Some(all.and(law?)))
    }

    /// Looks again, so many seconds after the last time.
    pub fn follow(
        &mut self,
        bodies: &[Option<Body>],
        machine: usize,
        plant: &Plant,
        passed: f64,
    ) -> Followed {
        let lying = bodies.iter().flatten().filter_map(Body::lying);
        let conveyed = lying.filter_map(|item| Some((item, plant.conveyed(item)?)));
        let items = replace(&mut self.conveyed, conveyed, |then: &Conveyed, now| then.becomes(now, passed));
        let cylinders = bodies.iter().flatten().filter_map(|body| match body.anchor {
            Anchor::Carriage(part) => Some(part),
            _ => None,
        });
        let strokes = cylinders.filter_map(|part| Some((part, plant.stroking(machine, part)?)));
        let strokes = replace(&mut self.strokes, strokes, |then: &Stroking, now| then.becomes(now, passed));
        Followed { all_go_on: items.all_go_on && strokes.all_go_on, items: items.new, strokes: strokes.new }
    }
}

/// What has become of the items and the cylinders of a machine since the last look.
pub struct Followed {
    /// They are the same, and have continued as they were going to.
    pub all_go_on: bool,
    /// Those that have not, or were not there, in the order of the bodies.
    pub items: Vec<usize>,
    pub strokes: Vec<usize>,
}

fn find<T>(all: &[(usize, T)], number: usize) -> Option<&T> {
    all.iter().find(|(known, _)| *known == number).map(|(_, one)| one)
}

struct Replaced {
    /// All old ones are there, and there are no new ones.
    all_go_on: bool,
    /// Numbers of those that are not what an old one becomes, in order.
    new: Vec<usize>,
}

/// Replaces the old ones by the new ones, both by their numbers.
fn replace<T>(
    all: &mut Vec<(usize, T)>,
    new: impl Iterator<Item = (usize, T)>,
    becomes: impl Fn(&T, &T) -> bool,
) -> Replaced {
    let (mut count, mut replaced) = (0, Replaced { all_go_on: true, new: Vec::new() });
    for (number, now) in new {
        match all[count..].iter().position(|(known, _)| *known == number) {
            // Those before it are gone, or come later.
            Some(ahead) => {
                replaced.all_go_on &= ahead == 0;
                all[count..=count + ahead].rotate_right(1);
                if !becomes(&all[count].1, &now) {
                    replaced.new.push(number);
                }
                all[count].1 = now;
            }
            None => {
                replaced.new.push(number);
                all.insert(count, (number, now));
            }
        }
        count += 1;
    }
    replaced.all_go_on &= count == all.len() && replaced.new.is_empty();
    all.truncate(count);
    replaced
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What becomes of three that do not change, and the numbers of those that are new.
    fn replaced(new: &[(usize, f64)]) -> (bool, Vec<usize>) {
        let mut all = vec![(1, 0.1), (2, 0.2), (3, 0.3)];
        let Replaced { all_go_on, new: numbers } = replace(&mut all, new.iter().copied(), |a, b| a == b);
        assert_eq!(all, new);
        (all_go_on, numbers)
    }

    #[test]
    fn those_beside_what_comes_or_goes_go_on() {
        assert_eq!(replaced(&[(1, 0.1), (2, 0.2), (3, 0.3)]), (true, vec![]));
        assert_eq!(replaced(&[(2, 0.2), (3, 0.3)]), (false, vec![]));
        assert_eq!(replaced(&[(1, 0.1), (2, 0.2)]), (false, vec![]));
        assert_eq!(replaced(&[(1, 0.1), (4, 0.4), (2, 0.2), (3, 0.3)]), (false, vec![4]));
        assert_eq!(replaced(&[(1, 0.1), (4, 0.4), (3, 0.3)]), (false, vec![4]));
        assert_eq!(replaced(&[(1, 0.1), (2, 0.25), (3, 0.3)]), (false, vec![2]));
        assert_eq!(replaced(&[(3, 0.3), (1, 0.1), (2, 0.2)]), (false, vec![]));
        assert_eq!(replaced(&[]), (false, vec![]));
    }
}
