//! Positions with directions.

use crate::point::Point;

/// Below this cosine of the pitch, roll and yaw are taken to turn about the same axis.
const LEVEL: f64 = 1e-9;

/// A frame: the columns of `rotation` are its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    pub rotation: [[f64; 3]; 3],
    pub position: Point,
}

/// The turn about x at the end of a link by Denavit and Hartenberg.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Twist {
    None,
    /// By 90 degrees.
    Quarter,
    /// By -90 degrees.
    Back,
}

impl Pose {
    pub const IDENTITY: Self = Self {
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        position: Point::new(0.0, 0.0, 0.0),
    };

    /// A frame at `position` turned by `angle` radians about the vertical.
    #[inline]
    pub fn turned(position: Point, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self { rotation: [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]], position }
    }

    /// One link of a chain by Denavit and Hartenberg behind this frame: turn about z, shift along z and the new x, then
    /// turn about x.
    #[inline]
    pub fn behind_link(&self, angle: f64, shift_z: f64, shift_x: f64, twist: Twist) -> Self {
        let (s, c) = libm::sincos(angle);
        let turned = |&[x, y, z]: &[f64; 3]| {
            let [ahead, aside] = [x * c + y * s, y * c - x * s];
            match twist {
                Twist::None => [ahead, aside, z],
                Twist::Quarter => [ahead, z, -aside],
                Twist::Back => [ahead, -z, aside],
            }
        };
        let [x, y, z] = &self.rotation;
        let position = self.point(Point::new(shift_x * c, shift_x * s, shift_z));
        Self { rotation: [turned(x), turned(y), turned(z)], position }
    }

    /// Axis 0, 1 or 2 of the frame.
    #[inline]
    pub fn axis(&self, i: usize) -> Point {
        Point::new(self.rotation[0][i], self.rotation[1][i], self.rotation[2][i])
    }

    /// A direction given in this frame, in the frame this one is given in.
    #[inline]
    pub fn direction(&self, inner: Point) -> Point {
        let along = |row: &[f64; 3]| row[0] * inner.x + row[1] * inner.y + row[2] * inner.z;
        let [x, y, z] = &self.rotation;
        Point::new(along(x), along(y), along(z))
    }

    /// A point given in this frame, in the frame this one is given in.
    #[inline]
    pub fn point(&self, inner: Point) -> Point {
        self.position + self.direction(inner)
    }

    /// A point given in the frame that this one is given in, in this frame.
    #[inline]
    pub fn seen(&self, outer: Point) -> Point {
        let offset = outer - self.position;
        Point::new(offset.dot(self.axis(0)), offset.dot(self.axis(1)), offset.dot(self.axis(2)))
    }

    /// The frame that this one is given in, seen from this one.
    #[inline]
    pub fn inverse(&self) -> Self {
        let r = &self.rotation;
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| r[j][i]));
        let turned = Self { rotation, position: Point::default() };
        Self { position: turned.direction(self.position).scaled(-1.0), ..turned }
    }

    /// This frame as `other` sees it, if both are given in the same one.
    pub fn seen_from(&self, other: &Pose) -> Self {
        let turn = Pose { position: Point::default(), ..other.inverse() };
        turn.then(&Pose { position: self.position - other.position, ..*self })
    }

    /// Angles in rad by which the outer frame turns into this one: about its x, then about its y, then about its z.
    /// Where x points up or down, the last is 0.
    pub fn roll_pitch_yaw(&self) -> [f64; 3] {
        let r = &self.rotation;
        let level = (r[0][0] * r[0][0] + r[1][0] * r[1][0]).sqrt();
        let pitch = libm::atan2(-r[2][0], level);
        if level < LEVEL {
            let side = if pitch > 0.0 { 1.0 } else { -1.0 };
            return [libm::atan2(side * r[0][1], r[1][1]), pitch, 0.0];
        }
        [libm::atan2(r[2][1], r[2][2]), pitch, libm::atan2(r[1][0], r[0][0])]
    }

    /// `inner`, given in this frame, in the frame this one is given in.
    #[inline]
    pub fn then(&self, inner: &Pose) -> Self {
        let [first, second, third] = &inner.rotation;
        let turned = |row: &[f64; 3]| {
            let column = |i: usize| row[0] * first[i] + row[1] * second[i] + row[2] * third[i];
            [column(0), column(1), column(2)]
        };
        let [x, y, z] = &self.rotation;
        Self { rotation: [turned(x), turned(y), turned(z)], position: self.point(inner.position) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn about_x(angle: f64) -> Pose {
        let (sin, cos) = libm::sincos(angle);
        Pose { rotation: [[1.0, 0.0, 0.0], [0.0, cos, -sin], [0.0, sin, cos]], ..Pose::IDENTITY }
    }

    fn about_y(angle: f64) -> Pose {
        let quarter = |side: f64| Pose::turned(Point::default(), side * FRAC_PI_2);
        quarter(1.0).then(&about_x(angle)).then(&quarter(-1.0))
    }

    fn assert_same(got: &Pose, expected: &Pose) {
        let d = got.position - expected.position;
        assert!(d.x.abs() < 1e-12 && d.y.abs() < 1e-12 && d.z.abs() < 1e-12, "{got:?} {expected:?}");
        for (a, b) in got.rotation.iter().flatten().zip(expected.rotation.iter().flatten()) {
            assert!((a - b).abs() < 1e-9, "{got:?} {expected:?}");
        }
    }

    #[test]
    fn angles_and_frames_lead_back() {
        let mut random = Random::new(5);
        for i in 0..1000 {
            let pitch = match i % 4 {
                0 => FRAC_PI_2,
                1 => -FRAC_PI_2,
                _ => random.between(-PI, PI),
            };
            let mut angle = || random.between(-PI, PI);
            let at = Point::new(angle(), angle(), angle());
            let pose = Pose::turned(at, angle()).then(&about_y(pitch)).then(&about_x(angle()));
            let [roll, pitch, yaw] = pose.roll_pitch_yaw();
            let again = Pose::turned(at, yaw).then(&about_y(pitch)).then(&about_x(roll));
            assert_same(&again, &pose);
            let other = Pose::turned(Point::new(angle(), angle(), angle()), angle()).then(&about_x(angle()));
            let seen = pose.seen(pose.point(at)) - at;
            assert!(seen.length() < 1e-12, "{seen:?}");
            assert_same(&other.then(&pose.seen_from(&other)), &pose);
        }
    }

    #[test]
    fn a_link_is_a_turn_a_shift_and_a_turn() {
        let mut random = Random::new(6);
        for twist in [(Twist::None, 0.0), (Twist::Quarter, FRAC_PI_2), (Twist::Back, -FRAC_PI_2)] {
            let mut angle = || random.between(-PI, PI);
            let before = Pose::turned(Point::new(angle(), angle(), angle()), angle()).then(&about_y(angle()));
            let [turn, along_z, along_x] = [angle(), angle(), angle()];
            let shift = Pose { position: Point::new(along_x, 0.0, along_z), ..Pose::IDENTITY };
            let link = Pose::turned(Point::default(), turn).then(&shift).then(&about_x(twist.1));
            assert_same(&before.behind_link(turn, along_z, along_x, twist.0), &before.then(&link));
        }
    }
}
