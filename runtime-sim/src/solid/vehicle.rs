//! A guided vehicle: base, bumper, column and tray.
//!
//! Sizes from `warehouse_robot_ariac/model.sdf` and `kit_tray_ariac/model.sdf` (ARIAC 2021), whose y
//! lies along the world's -x. Round columns are taken for square.

use super::{Link, Shape, Solid, at, cuboid};
use crate::geometry::{TRAY, TRAY_MIDDLE, TRAY_SURFACE};
use crate::point::Point;

const BASE: Point = Point::new(1.0228, 0.55508, 0.40874);
const BUMPER: Point = Point::new(1.17126, 0.67266, 0.12441);
/// Where both columns stand, their radii and their heights.
const COLUMN_X: f64 = -0.27539;
const COLUMN: (f64, f64) = (0.08652, 0.87476);
const MAST: (f64, f64) = (0.04261, 1.40848);
/// Thickness of the tray's plate; its lips: upper edge over the plate's middle, thickness.
const PLATE: f64 = 0.01;
const LIP_HEIGHT: f64 = 0.0254;
const LIP_THICKNESS: f64 = 0.001;

pub fn solids() -> Vec<Solid> {
    let standing = |name, x: f64, size: Point| Solid {
        name,
        link: Link::Vehicle,
        pose: at(Point::new(x, 0.0, size.z / 2.0)),
        shape: Shape::Box { size },
    };
    let column = |name, (radius, height): (f64, f64)| {
        standing(name, COLUMN_X, Point::new(2.0 * radius, 2.0 * radius, height))
    };
    let plate = TRAY_SURFACE - PLATE / 2.0;
    let (half_x, half_y, half_lip) = (TRAY[0] / 2.0, TRAY[1] / 2.0, LIP_THICKNESS / 2.0);
    let on_tray = |name, (x0, x1): (f64, f64), (y0, y1): (f64, f64), z0: f64, z1: f64| {
        let corner = |x, y, z| TRAY_MIDDLE + Point::new(x, y, z);
        cuboid(name, Link::Vehicle, corner(x0, y0, z0), corner(x1, y1, z1))
    };
    let lip = |name, x, y| on_tray(name, x, y, plate, plate + LIP_HEIGHT);
    let (x_all, y_all) = ((-half_x, half_x), (-half_y, half_y));
    let edge = |middle: f64| (middle - half_lip, middle + half_lip);
    vec![
        standing("base", 0.0, BASE),
        standing("bumper", 0.0, BUMPER),
        column("column", COLUMN),
        column("mast", MAST),
        on_tray("tray", x_all, y_all, TRAY_SURFACE - PLATE, TRAY_SURFACE),
        lip("lower_x_lip", edge(-half_x), y_all),
        lip("upper_x_lip", edge(half_x), y_all),
        lip("lower_y_lip", x_all, edge(-half_y)),
        lip("upper_y_lip", x_all, edge(half_y)),
    ]
}
