//! What the plan draws, read from the picture: the outlines of machines as they stand at the start.

use autogen_tests::xml::{self, Element};
use autogen_tests::{Texts, text};

/// Pixels for a metre.
const SCALE: f64 = 60.0;

/// From the least to the greatest x, and the same of y, m.
type Outline = [[f64; 2]; 2];

/// Everything of a class, by its outline.
fn drawn(picture: &Element, class: &str) -> Vec<Outline> {
    let those = picture.children.iter().filter(|element| element.attribute("class") == Some(class));
    those.filter_map(outline).collect()
}

/// The picture's y points down.
fn outline(element: &Element) -> Option<Outline> {
    let number = |name: &str| element.attribute(name).and_then(|text| text.parse::<f64>().ok());
    let [xs, ys]: [Vec<f64>; 2] = match &element.name[..] {
        "rect" => {
            let [x, y] = [number("x")?, number("y")?];
            [vec![x, x + number("width")?], vec![y, y + number("height")?]]
        }
        "circle" => {
            let r = number("r")?;
            [number("cx")?, number("cy")?].map(|middle| vec![middle - r, middle + r])
        }
        "line" => [vec![number("x1")?, number("x2")?], vec![number("y1")?, number("y2")?]],
        "polygon" => {
            let corners = element.attribute("points")?.split(' ').filter_map(|corner| corner.split_once(','));
            let corners: Vec<[f64; 2]> =
                corners.filter_map(|(x, y)| Some([x.parse().ok()?, y.parse().ok()?])).collect();
            [0, 1].map(|axis| corners.iter().map(|corner| corner[axis]).collect())
        }
        _ => return None,
    };
    let ends = |values: &[f64]| {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        [low, values.iter().copied().fold(f64::NEG_INFINITY, f64::max)].map(|value| value / SCALE)
    };
    let [low, high] = ends(&ys);
    Some([ends(&xs), [-high, -low]])
}

#[test]
fn machines_are_drawn_where_they_stand() {
    let texts = Texts {
        layout: text("tests/fixtures/world/mixed.json"),
        specs: vec![text("tests/fixtures/world/mixed.aut")],
        ..Texts::default()
    };
    let project = texts.project();
    let picture = xml::read(&autogen::backend::plan::svg(&project.plant, &project.edges)).expect("XML");
    for (what, class, expected) in [
        ("the conveyor of the cell", "belt", [[-0.5, 0.5], [3.65, 3.95]]),
        ("the arm of the cell", "arm", [[-0.22, 0.22], [4.78, 5.22]]),
        ("the dock of the vehicle on a track", "station", [[8.0, 9.0], [9.7, 10.3]]),
        ("this vehicle, half a metre behind the corner", "vehicle", [[14.8, 15.2], [10.1, 10.9]]),
        ("its track", "path", [[10.0, 15.0], [10.0, 10.0]]),
        ("the dock of the vehicle on a route", "station", [[18.0, 19.0], [9.7, 10.3]]),
        ("this vehicle", "vehicle", [[19.6, 20.4], [9.8, 10.2]]),
        ("where it goes", "path", [[20.0, 20.0], [10.0, 13.0]]),
        ("the capsule of the pole", "station", [[2.9, 3.1], [-4.1, -3.9]]),
        ("its box", "station", [[2.7, 3.3], [-4.3, -3.7]]),
        ("the rail beside the pose", "rail", [[3.0, 5.0], [-8.0, -8.0]]),
        ("the conveyor on the turntable", "belt", [[9.85, 10.15], [-11.0, -9.0]]),
        ("the conveyor on the lift", "belt", [[12.5, 13.5], [-10.15, -9.85]]),
    ] {
        let all = drawn(&picture, class);
        let is_there = |outline: &Outline| {
            outline.iter().flatten().zip(expected.iter().flatten()).all(|(a, b)| (a - b).abs() < 0.003)
        };
        let found = all.iter().filter(|outline| is_there(outline)).count();
        assert_eq!(found, 1, "{what}: {class} {expected:?} among {all:?}");
    }
}
