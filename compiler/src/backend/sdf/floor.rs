//! The floor of the world.

use super::lane;
use super::number;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::line::{Line, Obstacle};
use runtime_sim::machine::Machine;
use runtime_sim::point::Point;
use runtime_sim::solid::{Link, Shape, Solid};

/// Beyond the outermost machine, m.
const BORDER: f64 = 5.0;

/// A rectangle, as SDF writes it.
pub struct Floor {
    pub pose: String,
    pub size: String,
}

impl Floor {
    /// Under every machine and every obstacle, as they stand at the start, and where vehicles go.
    pub fn of(line: &Line) -> Self {
        let places: Vec<Point> = line
            .machines
            .iter()
            .flat_map(of_machine)
            .chain(line.obstacles.iter().flat_map(of_obstacle))
            .collect();
        let extent = |coordinate: fn(&Point) -> f64| {
            let values = places.iter().map(coordinate);
            let (low, high) =
                values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
            if low > high { (0.0, 2.0 * BORDER) } else { ((low + high) / 2.0, high - low + 2.0 * BORDER) }
        };
        let ((x, length), (y, width)) = (extent(|p| p.x), extent(|p| p.y));
        let middle = Pose { position: Point::new(x, y, 0.0), ..Pose::IDENTITY };
        Self { pose: number::pose(&middle), size: number::list(&[length, width]) }
    }
}

fn of_machine(machine: &Machine) -> Vec<Point> {
    let mut solids = machine.solids();
    solids.extend(lane::surfaces(machine));
    let at_start = |link: Link| match link {
        Link::World => Some(Pose::IDENTITY),
        Link::Route => machine.start().map(|start| start.pose()),
        Link::Carriage(part) => machine.parts[part].strokes().map(|strokes| strokes.begin().pose()),
        Link::Joint(_) => None,
    };
    let solids = solids.iter().filter_map(|solid| Some((solid, at_start(solid.link)?)));
    let corners = solids.flat_map(|(solid, frame)| corners(solid).map(|corner| frame.point(corner)));
    corners.chain(machine.turning_points()).collect()
}

/// One without a box takes no room, but is somewhere.
fn of_obstacle(obstacle: &Obstacle) -> Vec<Point> {
    obstacle.solid().map_or_else(|| vec![obstacle.pose], |solid| corners(&solid).to_vec())
}

/// Of a box around a solid.
fn corners(solid: &Solid) -> [Point; 8] {
    let half = match solid.shape {
        Shape::Box { size } => size.scaled(0.5),
        Shape::Capsule { length, radius } => Point::new(radius, radius, length / 2.0 + radius),
    };
    std::array::from_fn(|number| {
        let side = |axis: usize| if number >> axis & 1 == 1 { 1.0 } else { -1.0 };
        solid.pose.point(Point::new(side(0) * half.x, side(1) * half.y, side(2) * half.z))
    })
}
