//! What is known of two groups, and the search for the time at which they meet.

use super::body::Placed;
use super::distance::Gap;
use super::free::{Question, can_meet, is_free, note_free};
use super::group::{Anchor, Body, Group, Swept};
use super::{SKIN, TOLERANCE, UNCERTAIN};
use crate::memory::Memory;
use crate::plant::Plant;
use crate::point::Point;

/// Two groups; or one and itself, for an arm that could touch itself.
#[derive(Clone, Debug)]
pub struct Pair {
    pub groups: [usize; 2],
    /// The layout allows them to touch.
    pub allowed: bool,
    /// Number of the contact that was reported.
    pub contact: Option<usize>,
    /// As long as their paths together are no longer than this, a body of the first group and one of the second have not
    /// come into contact, if both go on as they did when it was looked at; negative infinity if nothing is known, infinity
    /// if they never meet.
    bodies: Vec<Vec<f64>>,
    touching: Vec<Touching>,
    pub known: Known,
    /// Of groups that have moved near one another.
    apart: Option<Box<KnownApart>>,
}

/// That two groups do not come into contact as they move.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// Of both groups: with others it does not hold.
    pub versions: [u64; 2],
    /// Seconds from the start of the run; infinity: as long as they go on like this.
    pub until: f64,
}

/// That all bodies of two groups that moved do not come into contact, each as it was going to move: all were looked at in
/// this run, not remembered from motions that differ by the grain of a [`Fingerprint`](crate::fingerprint::Fingerprint).
#[derive(Clone, Debug, Default)]
struct KnownApart {
    /// Of the bodies, by group and number.
    versions: [Vec<u64>; 2],
    /// Seconds from the start of the run.
    until: f64,
}

/// Bodies that are in contact.
#[derive(Clone, Debug)]
pub struct Touching {
    bodies: [usize; 2],
    /// They are in contact as long as their paths together are no longer than this.
    until: f64,
}

/// That two bodies have come into contact.
#[derive(Clone, Debug)]
pub struct Touch {
    /// Seconds from now.
    pub time: f64,
    pub place: Point,
    pub parts: [String; 2],
}

/// The time that is checked, from now on, in which no motion changes.
pub struct Span<'a> {
    pub groups: &'a mut [Group],
    pub plant: &'a Plant,
    /// Seconds from now.
    pub from: f64,
    pub to: f64,
    /// Bodies that are no farther apart than this meet, m.
    pub contact: f64,
    /// Those that do not meet stay so far apart at least, m.
    pub apart: f64,
    /// What contains the bodies of the first group and those of the second; none if that is not known.
    pub swept: Option<[&'a Swept; 2]>,
}

/// Two bodies by the numbers of their groups and by their own.
type Two = [(usize, usize); 2];

/// How far two bodies are apart, at least.
enum Apart {
    /// Nobody looked closer.
    AtLeast(f64),
    /// And the numbers of the nearest pieces.
    Exactly(Gap, [usize; 2]),
}

/// What the search in a span comes to.
enum Search {
    /// They could go so much further.
    Clear(f64),
    Meet(Touch),
}

/// Bodies whose balls are so much farther apart than they can go in a span are not looked at more closely, m.
const FAR: f64 = 0.1;
/// The time for which it is looked is halved so often at most, where boxes of the bodies meet.
const HALVINGS: u32 = 4;
/// What may come into contact is looked for so far ahead, s.
const AHEAD: f64 = 20.0;
/// What is looked at ahead stays so far apart, m: then it does not come into contact either where its places differ by
/// the grain of a [`Fingerprint`](crate::fingerprint::Fingerprint).
const FREE: f64 = TOLERANCE + UNCERTAIN;
/// Times no farther apart are one, s.
pub const AT_ONCE: f64 = 1e-9;
/// No search takes shorter steps, s: whatever moves goes less than a thousandth of the tolerance.
const SHORTEST_STEP: f64 = 1e-9;

impl Pair {
    pub fn new(groups: [usize; 2], allowed: bool) -> Self {
        let known = Known { versions: [0; 2], until: f64::NEG_INFINITY };
        Self { groups, allowed, contact: None, bodies: Vec::new(), touching: Vec::new(), known, apart: None }
    }

    pub fn touches(&self) -> bool {
        !self.touching.is_empty()
    }

    /// Seconds from now in which the groups do not come into contact as both move now: `asked` or more, or as long as it
    /// takes to come so near that they could. The pair does not touch; `number` tells it apart.
    pub fn clear_for(
        &mut self,
        groups: &mut [Group],
        number: usize,
        plant: &Plant,
        memory: &mut Memory,
        asked: f64,
    ) -> f64 {
        let [a, b] = self.groups;
        if a != b {
            let [first, second] = [a, b].map(|group| groups[group].outer(plant, memory));
            if first.is_apart(&second) {
                return f64::INFINITY;
            }
            let [first, second] = [a, b].map(|group| groups[group].boxes(plant, memory));
            if first.whole.is_apart(&second.whole) {
                return f64::INFINITY;
            }
        }
        let rest = ![a, b].into_iter().any(|group| groups[group].moves());
        [a, b].into_iter().for_each(|group| groups[group].catch_up(plant));
        let question = Question::of(groups, number, [a, b], plant);
        if let Some(question) = question
            && is_free(groups, [a, b], plant, memory, question)
        {
            return f64::INFINITY;
        }
        // All that moves is asked about together with what stands, or what stands alone.
        let clear_standing = [0, 1].map(|side| {
            let question =
                (a != b).then(|| Question::of_standing(groups, number, [a, b], side, plant)).flatten();
            question.is_some_and(|question| is_free(groups, [a, b], plant, memory, question))
        });
        let ends = [a, b].map(|group| groups[group].rests_after());
        let seconds = if rest { asked } else { ends.into_iter().fold(AHEAD, f64::min).max(asked) };
        let all_clear = if rest { f64::INFINITY } else { seconds };
        let laws = [a, b].map(|group| if rest { None } else { groups[group].law(plant) });
        let motions = match laws {
            [Some(a), Some(b)] => Some(a.and(b).with(number as u64).near(seconds)),
            _ => None,
        };
        self.forget_paths();
        if let Some(clear) = motions.and_then(|motions| memory.clear(motions)) {
            return clear;
        }
        let mut times = vec![(HALVINGS, [0.0, seconds])];
        while let Some((halvings, [from, to])) = times.pop() {
            let outer = [0, 1].map(|side| {
                let all = groups[[a, b][side]].outer_between([from, to], plant, memory);
                all.map(|all| if clear_standing[side] { all.without_standing() } else { all })
            });
            if let [Some(first), Some(second)] = &outer
                && a != b
                && first.is_apart(second)
            {
                continue;
            }
            let swept = [0, 1].map(|side| {
                let all = groups[[a, b][side]].boxes_between([from, to], plant, memory);
                if clear_standing[side] { all.without_standing() } else { all }
            });
            let [first, second] = &swept;
            if a != b && first.is_apart(second) {
                continue;
            }
            let middle = from + (to - from) / 2.0;
            if a != b && !rest && halvings > 0 {
                times.extend([[middle, to], [from, middle]].map(|times| (halvings - 1, times)));
                continue;
            }
            let swept = (a != b).then_some([first, second]);
            let contact = if rest { FREE } else { FREE + TOLERANCE };
            let touch = self.look(&mut Span { groups, plant, from, to, contact, apart: FREE, swept });
            // When they come into contact is found scan by scan.
            self.touching.clear();
            if let Some(touch) = touch {
                self.forget_paths();
                if let Some(motions) = motions {
                    memory.note_clear(motions, touch.time);
                }
                return touch.time;
            }
        }
        self.forget_paths();
        if a != b && !rest {
            self.know_apart(groups, plant, seconds);
        }
        if let Some(motions) = motions {
            memory.note_clear(motions, all_clear);
        }
        if let Some(question) = question.filter(|_| rest) {
            note_free(memory, question);
        }
        all_clear
    }

    /// For so many seconds from now no two bodies come into contact.
    fn know_apart(&mut self, groups: &[Group], plant: &Plant, seconds: f64) {
        let apart = self.apart.get_or_insert_default();
        apart.until = plant.now_ms() as f64 / 1000.0 + seconds;
        for (versions, group) in apart.versions.iter_mut().zip(self.groups) {
            versions.clear();
            versions.extend(versions_of(&groups[group]));
        }
    }

    /// Of both groups for each body whether it moves as it did when it was last known of all that they stay apart; none if
    /// that is not known up to the end of the span.
    fn apart_as_before(&self, span: &Span) -> Option<[Vec<bool>; 2]> {
        let apart = self.apart.as_ref().filter(|_| span.swept.is_some())?;
        if apart.until - span.plant.now_ms() as f64 / 1000.0 + AT_ONCE < span.to {
            return None;
        }
        let as_before = |side: usize| {
            let known = apart.versions[side].iter().map(Some).chain(std::iter::repeat(None));
            let versions = versions_of(&span.groups[self.groups[side]]);
            versions.zip(known).map(|(version, known)| known == Some(&version)).collect()
        };
        Some([0, 1].map(as_before))
    }

    /// A group does not go on as it did when it was looked at, or may not.
    pub fn forget_paths(&mut self) {
        let known = self.bodies.iter_mut().flatten().filter(|clear| clear.is_finite());
        known.for_each(|clear| *clear = f64::NEG_INFINITY);
    }

    /// Another body stands at this number of a group, or none any more.
    pub fn expect(&mut self, group: usize, body: usize) {
        let [a, b] = self.groups;
        if group == a
            && let Some(row) = self.bodies.get_mut(body)
        {
            row.fill(f64::NEG_INFINITY);
        }
        if group == b {
            self.bodies.iter_mut().filter_map(|row| row.get_mut(body)).for_each(|c| *c = f64::NEG_INFINITY);
        }
        self.touching.retain(|Touching { bodies: [i, j], .. }| {
            !(group == a && *i == body || group == b && *j == body)
        });
    }

    /// Contacts of a body that goes on as another one: what lies on it has changed.
    pub fn touching_of(&self, group: usize, body: usize) -> Vec<Touching> {
        let [a, b] = self.groups;
        let is_its = |Touching { bodies: [i, j], .. }: &&Touching| {
            group == a && *i == body || group == b && *j == body
        };
        self.touching.iter().filter(is_its).cloned().collect()
    }

    /// They last if that other body is in contact too.
    pub fn go_on(&mut self, touching: Vec<Touching>, group: usize, [from, to]: [usize; 2]) {
        let groups = self.groups;
        let go_on = touching.into_iter().map(|Touching { mut bodies, .. }| {
            for side in 0..2 {
                if groups[side] == group && bodies[side] == from {
                    bodies[side] = to;
                }
            }
            Touching { bodies, until: f64::NEG_INFINITY }
        });
        self.touching.extend(go_on);
    }

    /// Looks at all bodies that may have come into contact in this span; the first contact of the pair, if
    /// none of its bodies was in contact before.
    pub fn look(&mut self, span: &mut Span) -> Option<Touch> {
        let [a, b] = self.groups;
        let counts = [a, b].map(|group| span.groups[group].bodies.len());
        self.bodies.resize(counts[0], Vec::new());
        self.bodies.iter_mut().for_each(|row| row.resize(counts[1], f64::NEG_INFINITY));
        let touched = !self.touching.is_empty();
        self.touching.retain_mut(|touching| span.still_touch([a, b], touching));
        let mut first: Option<Touch> = None;
        let paths = [a, b].map(|group| span.groups[group].paths_to(span.to));
        let as_before = self.apart_as_before(span);
        for i in 0..counts[0] {
            let from = if a == b { i + 1 } else { 0 };
            for j in from..counts[1] {
                let two = [(a, i), (b, j)];
                let (Some(of_a), Some(of_b)) = (paths[0][i], paths[1][j]) else { continue };
                let paths = of_a + of_b;
                if as_before.as_ref().is_some_and(|[of_a, of_b]| of_a[i] && of_b[j]) {
                    debug_assert!(span.stay_apart(two), "two bodies meet that were known to stay apart");
                    continue;
                }
                if self.touching.iter().any(|touching| touching.bodies == [i, j]) {
                    continue;
                }
                let clear = &mut self.bodies[i][j];
                if *clear == f64::NEG_INFINITY && !can_meet(span.groups, two, span.plant) {
                    *clear = f64::INFINITY;
                }
                if paths > *clear && !span.may_meet([i, j]) {
                    *clear = paths;
                }
                if paths > *clear {
                    match span.search(two) {
                        Search::Clear(further) => *clear = paths + further,
                        Search::Meet(touch) => {
                            let until = paths + SKIN;
                            self.touching.push(Touching { bodies: [i, j], until });
                            if first.as_ref().is_none_or(|first| touch.time < first.time) {
                                first = Some(touch);
                            }
                        }
                    }
                }
            }
        }
        first.filter(|_| !touched)
    }
}

impl Span<'_> {
    fn body(&self, (group, body): (usize, usize)) -> Option<&Body> {
        self.groups[group].bodies[body].as_ref()
    }

    /// Whether the boxes of a body of the first group and of one of the second meet.
    fn may_meet(&self, [i, j]: [usize; 2]) -> bool {
        self.swept.is_none_or(|[a, b]| !a.bodies[i].is_apart(&b.bodies[j]))
    }

    /// Whether two bodies do not come into contact.
    fn stay_apart(&mut self, two: Two) -> bool {
        let (groups, contact) = (&mut *self.groups, TOLERANCE);
        let mut exact = Span { groups, contact, apart: TOLERANCE, swept: None, ..*self };
        !can_meet(exact.groups, two, exact.plant) || matches!(exact.search(two), Search::Clear(_))
    }

    /// Metres that both bodies together go at most between two times.
    fn travel(&self, two: Two, from: f64, to: f64) -> f64 {
        let of = |one: (usize, usize)| {
            self.body(one).map_or(0.0, |body| self.groups[one.0].path_between(body, from, to))
        };
        of(two[0]) + of(two[1])
    }

    /// A time after this one in which both together go no farther than `distance`; `left` is what they go to the end.
    fn longest_step(&self, two: Two, time: f64, distance: f64, left: f64) -> f64 {
        let mut step = self.to - time;
        let mut travel = left;
        while travel > distance && step > SHORTEST_STEP {
            step = (step * 0.99 * distance / travel).max(SHORTEST_STEP);
            travel = self.travel(two, time, time + step);
        }
        step
    }

    /// Advances by as much as the distance allows, until the span is over or there is none.
    fn search(&mut self, two: Two) -> Search {
        let mut time = self.from;
        loop {
            let left = self.travel(two, time, self.to);
            let apart = self.apart(two, time, left + FAR);
            let distance = match apart {
                Apart::AtLeast(distance) => distance,
                Apart::Exactly(gap, _) => gap.distance,
            };
            if let Apart::Exactly(gap, pieces) = apart
                && is_within(distance, self.contact)
            {
                return Search::Meet(self.touch(two, time, &gap, pieces));
            }
            let free = distance - self.apart;
            if free >= left {
                return Search::Clear(free - left);
            }
            // In one scan always alike, so that a contact is found at the same time whatever was looked at before.
            let step = if self.contact > TOLERANCE { free } else { distance };
            time += self.longest_step(two, time, step, left);
        }
    }

    fn touch(&self, two: Two, time: f64, gap: &Gap, pieces: [usize; 2]) -> Touch {
        let part = |i: usize| {
            let piece = self.body(two[i]).and_then(|body| body.pieces.get(pieces[i]));
            piece.map_or_else(String::new, |piece| piece.name.clone())
        };
        let [a, b] = gap.points;
        Touch { time, place: a + (b - a).scaled(0.5), parts: [part(0), part(1)] }
    }

    /// They are not apart before they have gone as far as they could be in one another.
    fn still_touch(&mut self, groups: [usize; 2], touching: &mut Touching) -> bool {
        let two = [0, 1].map(|i| (groups[i], touching.bodies[i]));
        let of = |(group, body): (usize, usize)| self.groups[group].path_to(body, self.to);
        let (Some(of_a), Some(of_b)) = (of(two[0]), of(two[1])) else { return false };
        let paths = of_a + of_b;
        if paths <= touching.until {
            return true;
        }
        match self.apart(two, self.from, FAR) {
            Apart::AtLeast(_) => false,
            Apart::Exactly(gap, _) => {
                touching.until = paths + SKIN - gap.distance;
                is_within(gap.distance, SKIN)
            }
        }
    }

    /// At a time of the span; looked at closely only if it may be less than `far`.
    fn apart(&mut self, two: Two, time: f64, far: f64) -> Apart {
        let frames = two.map(|(group, body)| {
            let anchor = self.groups[group].bodies[body].as_ref().map_or(Anchor::World, |b| b.anchor);
            self.groups[group].frame(anchor, self.plant, time)
        });
        let [Some(a), Some(b)] = two.map(|one| self.body(one)) else { return Apart::AtLeast(f64::INFINITY) };
        let least = a.ball.within(&frames[0]).gap(&b.ball.within(&frames[1]));
        if least >= far {
            return Apart::AtLeast(least);
        }
        let second: Vec<Placed> = b.pieces.iter().map(|piece| piece.within(&frames[1])).collect();
        let mut nearest: Option<(Gap, [usize; 2])> = None;
        let mut farther = f64::INFINITY;
        for (i, piece) in a.pieces.iter().enumerate() {
            let placed = piece.within(&frames[0]);
            for (j, other) in second.iter().enumerate() {
                let relevant = nearest.map_or(far, |(gap, _)| gap.distance);
                let least = placed.apart_at_least(other, relevant);
                if least >= relevant {
                    farther = farther.min(least);
                    continue;
                }
                let gap = placed.gap(other);
                if nearest.is_none_or(|(nearest, _)| gap.distance < nearest.distance || gap.distance.is_nan())
                {
                    nearest = Some((gap, [i, j]));
                }
            }
        }
        match nearest {
            Some((gap, pieces)) if is_within(gap.distance, farther) => Apart::Exactly(gap, pieces),
            _ => Apart::AtLeast(farther),
        }
    }
}

/// Of the bodies, by their numbers; 0 where there is none.
fn versions_of(group: &Group) -> impl Iterator<Item = u64> {
    group.bodies.iter().map(|body| body.as_ref().map_or(0, |body| body.version))
}

/// What is no number counts as a contact.
fn is_within(distance: f64, limit: f64) -> bool {
    distance <= limit || distance.is_nan()
}
