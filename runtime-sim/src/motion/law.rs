//! What tells the rest of a motion apart.

use super::Motion;
use crate::fingerprint::Fingerprint;

impl Motion {
    /// Of its path, and of where on it the motion is at every time from this one on, s.
    pub(crate) fn law(&self, now: f64) -> Fingerprint {
        let phases = self.profile.phases().iter().filter(|phase| phase.duration > 0.0);
        let numbers = phases
            .flat_map(|phase| [phase.duration, phase.place_after(0.0), phase.speed_after(0.0), phase.gain()]);
        let numbers = numbers.chain([self.rest]).map(f64::to_bits);
        numbers.fold(self.path.fingerprint().near(now - self.since), Fingerprint::with)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::arm::{Joints, Limits};

    fn motion(to: [f64; 2], acceleration: f64) -> Motion {
        let [from, velocity] = [[0.0, 1.0], [1.0, 2.0]].map(|values| Joints::new(&values));
        let limits = Limits { velocity, acceleration: Joints::new(&[acceleration, 1.0]) };
        Motion::between(from, Joints::new(&to), &limits, 0.0)
    }

    #[test]
    fn the_law_tells_apart_what_moves_otherwise_from_now_on() {
        let law = motion([4.0, -1.2], 1.0).law(1.5);
        assert_eq!(law, motion([4.0, -1.2], 1.0).begun(40.0).law(41.5));
        let mut held = motion([4.0, -1.2], 1.0);
        held.hold(1.0);
        let earlier = motion([4.0, -1.2], 1.0).law(1.4);
        for other in
            [earlier, held.law(1.5), motion([4.0, -1.2], 0.9).law(1.5), motion([4.0, -1.3], 1.0).law(1.5)]
        {
            assert_ne!(law, other);
        }
    }
}
