//! Distances of segments and boxes beside those of an independent library.

use parry3d_f64::math::{Matrix, Pose, Rotation, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::{Cuboid, Segment, Shape};
use runtime_sim::collision::distance::{Block, Gap, block_block, segment_block, segment_segment};
use runtime_sim::point::Point;
use runtime_sim::random::Random;

const PAIRS: usize = 100_000;
/// Of the library's iteration, m: bodies are a few metres large.
const TOLERANCE: f64 = 1e-6;

/// Draws shapes of which many touch, are parallel, contain one another, or have no extent.
struct Draw(Random);

impl Draw {
    fn one_in(&mut self, n: u32) -> bool {
        self.0.up_to(n - 1) == 0
    }

    /// Within one metre; every third time on a coarse grid.
    fn coordinate(&mut self) -> f64 {
        if self.one_in(3) {
            f64::from(self.0.up_to(8)) / 4.0 - 1.0
        } else {
            f64::from(self.0.up_to(2_000_000)) / 1e6 - 1.0
        }
    }

    fn point(&mut self) -> Point {
        Point::new(self.coordinate(), self.coordinate(), self.coordinate())
    }

    /// Half of a length: a thin sheet now and then.
    fn half(&mut self) -> f64 {
        if self.one_in(8) { 0.0 } else { self.coordinate().abs() }
    }

    fn rotation(&mut self) -> Rotation {
        if self.one_in(3) {
            return Rotation::IDENTITY;
        }
        let axis = Vector::new(self.coordinate(), self.coordinate(), self.coordinate());
        match axis.try_normalize() {
            Some(axis) => Rotation::from_axis_angle(axis, 3.0 * self.coordinate()),
            None => Rotation::IDENTITY,
        }
    }

    fn block(&mut self) -> Block {
        let rotation = self.rotation();
        let axes = [Vector::X, Vector::Y, Vector::Z].map(|axis| {
            let v = rotation * axis;
            Point::new(v.x, v.y, v.z)
        });
        Block { middle: self.point(), axes, half: [self.half(), self.half(), self.half()] }
    }

    /// A point now and then, or one that lies along the last segment.
    fn segment(&mut self, along: Option<[Point; 2]>) -> [Point; 2] {
        let a = self.point();
        match along {
            _ if self.one_in(8) => [a, a],
            Some([from, to]) if self.one_in(3) => [a, a + (to - from)],
            // Through the same point.
            Some([from, _]) if self.one_in(4) => [a, from + (from - a)],
            Some([from, to]) if self.one_in(4) => {
                let b = self.point();
                [from + (b - to), to + (to - b)]
            }
            _ => [a, self.point()],
        }
    }
}

fn vector(p: Point) -> Vector {
    Vector::new(p.x, p.y, p.z)
}

#[derive(Clone, Debug)]
enum Core {
    Segment([Point; 2]),
    Block(Block),
}

impl Core {
    fn gap(&self, other: &Core) -> Gap {
        match (self, other) {
            (Core::Segment(a), Core::Segment(b)) => segment_segment(*a, *b),
            (Core::Segment(a), Core::Block(b)) => segment_block(*a, b),
            (Core::Block(a), Core::Segment(b)) => segment_block(*b, a).turned(),
            (Core::Block(a), Core::Block(b)) => block_block(a, b),
        }
    }

    fn shape(&self) -> (Pose, Box<dyn Shape>) {
        match self {
            Core::Segment([a, b]) => (Pose::IDENTITY, Box::new(Segment::new(vector(*a), vector(*b)))),
            Core::Block(block) => {
                let [x, y, z] = block.axes.map(vector);
                let rotation = Rotation::from_mat3(&Matrix::from_cols(x, y, z));
                let cuboid = Cuboid::new(Vector::from_array(block.half));
                (Pose::from_parts(vector(block.middle), rotation), Box::new(cuboid))
            }
        }
    }

    /// The least and the greatest coordinate along a direction.
    fn extent(&self, along: Vector) -> [f64; 2] {
        match self {
            Core::Segment(ends) => {
                let [a, b] = ends.map(|end| along.dot(vector(end)));
                [a.min(b), a.max(b)]
            }
            Core::Block(block) => {
                let middle = along.dot(vector(block.middle));
                let half: f64 = block
                    .axes
                    .iter()
                    .zip(block.half)
                    .map(|(axis, h)| h * along.dot(vector(*axis)).abs())
                    .sum();
                [middle - half, middle + half]
            }
        }
    }

    /// How far a point is from lying in the shape, along any axis at most.
    fn outside(&self, point: Point) -> f64 {
        let p = vector(point);
        match self {
            Core::Segment([a, b]) => {
                let (a, b) = (vector(*a), vector(*b));
                let t = if a == b {
                    0.0
                } else {
                    ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0)
                };
                (p - a - t * (b - a)).length()
            }
            Core::Block(block) => {
                let offset = p - vector(block.middle);
                let beyond = |(axis, half): (&Point, f64)| offset.dot(vector(*axis)).abs() - half;
                block.axes.iter().zip(block.half).map(beyond).fold(0.0, f64::max)
            }
        }
    }
}

/// Asserts that the gap is right, from the gap alone: its points lie in the shapes, so that the distance is no
/// shorter than said; and all of one shape is so far from all of the other along its direction.
fn prove(a: &Core, b: &Core, gap: &Gap) {
    let [p, q] = gap.points;
    assert!(a.outside(p) < 1e-12 && b.outside(q) < 1e-12, "{gap:?} is not of {a:?} and {b:?}");
    let offset = vector(q) - vector(p);
    assert!((offset.length() - gap.distance).abs() < 1e-12);
    // A direction shorter than that is rounding.
    if gap.distance > 1e-7 {
        let direction = offset / offset.length();
        let apart = b.extent(direction)[0] - a.extent(direction)[1];
        assert!((apart - gap.distance).abs() < 1e-8, "{gap:?}, but {apart} between {a:?} and {b:?}");
    }
}

struct Compared {
    meeting: usize,
    apart: usize,
    /// Pairs for which the library's iteration ended too early.
    further: usize,
}

/// Holds `PAIRS` pairs against the library and against the proof.
fn compare(mut draw: impl FnMut(&mut Draw) -> [Core; 2]) -> Compared {
    let mut random = Draw(Random::new(11));
    let mut compared = Compared { meeting: 0, apart: 0, further: 0 };
    let mut worst = 0.0_f64;
    for _ in 0..PAIRS {
        let [a, b] = draw(&mut random);
        let found = a.gap(&b);
        prove(&a, &b, &found);
        let ((pose_a, shape_a), (pose_b, shape_b)) = (a.shape(), b.shape());
        let wanted =
            query::distance(&pose_a, &*shape_a, &pose_b, &*shape_b).expect("shapes that it knows").distance;
        // What is proved to be nearer is right.
        let is_further = found.distance > 1e-7 && wanted > found.distance + TOLERANCE;
        compared.further += usize::from(is_further);
        if !is_further {
            let difference = (found.distance - wanted).abs();
            assert!(difference <= TOLERANCE, "{found:?}, but {wanted} between {a:?} and {b:?}");
            worst = worst.max(difference);
        }
        if found.distance == 0.0 { compared.meeting += 1 } else { compared.apart += 1 }
    }
    let Compared { meeting, apart, further } = compared;
    println!(
        "{meeting} meet, {apart} are apart, worst difference {worst:e} m, {further} times the library ended too early"
    );
    compared
}

#[test]
fn segments() {
    let compared = compare(|draw| {
        let a = draw.segment(None);
        [Core::Segment(a), Core::Segment(draw.segment(Some(a)))]
    });
    assert!(compared.meeting > 1000 && compared.apart > 1000 && compared.further == 0);
}

#[test]
fn segments_and_boxes() {
    let compared = compare(|draw| {
        let block = draw.block();
        let along = [block.middle, block.middle + block.axes[0]];
        [Core::Segment(draw.segment(Some(along))), Core::Block(block)]
    });
    assert!(compared.meeting > 1000 && compared.apart > 1000 && compared.further == 0);
}

#[test]
fn boxes() {
    let compared = compare(|draw| [Core::Block(draw.block()), Core::Block(draw.block())]);
    assert!(compared.meeting > 1000 && compared.apart > 1000);
    assert!(compared.further < PAIRS / 100, "the library shows too little");
}

#[test]
fn a_coordinate_that_is_no_number_is_never_a_distance() {
    let block = |x: f64| Block {
        middle: Point::new(x, 3.0, 0.0),
        axes: [Point::new(1.0, 0.0, 0.0), Point::new(0.0, 1.0, 0.0), Point::new(0.0, 0.0, 1.0)],
        half: [0.5; 3],
    };
    let segment = |x: f64| [Point::new(x, 0.0, 0.0), Point::new(1.0, 0.0, 0.0)];
    assert!(segment_segment(segment(f64::NAN), segment(5.0)).distance.is_nan());
    assert!(segment_segment(segment(5.0), segment(f64::NAN)).distance.is_nan());
    assert!(segment_block(segment(f64::NAN), &block(0.0)).distance.is_nan());
    assert!(segment_block(segment(0.0), &block(f64::NAN)).distance.is_nan());
    assert!(block_block(&block(0.0), &block(f64::NAN)).distance.is_nan());
    assert!(block_block(&block(f64::NAN), &block(0.0)).distance.is_nan());
    assert!((segment_block(segment(0.0), &block(0.0)).distance - 2.5).abs() < 1e-12);
}
