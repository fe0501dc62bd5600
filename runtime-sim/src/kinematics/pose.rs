//! Positions with directions.

use crate::point::Point;

/// A frame: the columns of `rotation` are its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    pub rotation: [[f64; 3]; 3],
    pub position: Point,
}

impl Pose {
    pub const IDENTITY: Self = Self {
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        position: Point::new(0.0, 0.0, 0.0),
    };

    /// A frame at `position` turned by `angle` radians about the vertical.
    pub fn turned(position: Point, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self { rotation: [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]], position }
    }

    /// One link of a chain by Denavit and Hartenberg: turn about z, shift along z and the new x, then turn about x.
    /// `twist` is the sine and cosine of the last turn.
    pub fn link(angle: f64, shift_z: f64, shift_x: f64, twist: (f64, f64)) -> Self {
        let (s, c) = libm::sincos(angle);
        let (st, ct) = twist;
        Self {
            rotation: [[c, -s * ct, s * st], [s, c * ct, -c * st], [0.0, st, ct]],
            position: Point::new(shift_x * c, shift_x * s, shift_z),
        }
    }

    /// Axis 0, 1 or 2 of the frame.
    pub fn axis(&self, i: usize) -> Point {
        Point::new(self.rotation[0][i], self.rotation[1][i], self.rotation[2][i])
    }

    /// A direction given in this frame, in the frame this one is given in.
    pub fn direction(&self, inner: Point) -> Point {
        let along = |row: &[f64; 3]| row[0] * inner.x + row[1] * inner.y + row[2] * inner.z;
        let [x, y, z] = &self.rotation;
        Point::new(along(x), along(y), along(z))
    }

    /// A point given in this frame, in the frame this one is given in.
    pub fn point(&self, inner: Point) -> Point {
        self.position + self.direction(inner)
    }

    /// The frame that this one is given in, seen from this one.
    pub fn inverse(&self) -> Self {
        let r = &self.rotation;
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| r[j][i]));
        let turned = Self { rotation, position: Point::default() };
        Self { position: turned.direction(self.position).scaled(-1.0), ..turned }
    }

    /// `inner`, given in this frame, in the frame this one is given in.
    pub fn then(&self, inner: &Pose) -> Self {
        let r = &self.rotation;
        let mut rotation = [[0.0; 3]; 3];
        for (row, target) in r.iter().zip(&mut rotation) {
            for (column, value) in target.iter_mut().enumerate() {
                *value = (0..3).map(|k| row[k] * inner.rotation[k][column]).sum();
            }
        }
        Self { rotation, position: self.point(inner.position) }
    }
}
