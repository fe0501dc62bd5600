use super::*;

const FLOOR: Floor = Floor { middle: Point::new(0.0, 0.0, 0.5), x: [-0.3, 0.3], y: [-0.3, 0.3], yaw: 0.0 };

/// Each 0.4 m long, 0.1 m wide and high, by the middles of their undersides.
fn stack(at: &[(f64, f64)]) -> Stack {
    Stack::new(FLOOR, at.iter().map(|at| block(*at)).enumerate().collect())
}

fn block((x, z): (f64, f64)) -> Block {
    Block::new(Point::new(0.4, 0.1, 0.1), Point::new(x, 0.0, z), 0.0)
}

#[test]
fn an_item_rests_on_the_highest_under_it_or_on_the_floor() {
    let stack = stack(&[(-0.1, 0.5), (-0.1, 0.6), (0.28, 0.5)]);
    for (x, rests) in [
        (0.0, Some((0.7, None))),
        (0.3, Some((0.6, None))),
        // Beyond the floor: with its middle over the lower one, and without.
        (0.4, Some((0.6, None))),
        (0.6, Some((0.6, Some(2)))),
        (0.7, None),
        (-0.4, Some((0.7, Some(1)))),
    ] {
        let rest = stack.rest(&block((x, 1.0)), 1.0).map(|rest| (rest.height, rest.tips_off));
        assert_eq!(rest, rests, "{x}");
    }
    let low = stack.rest(&block((0.0, 0.6)), 0.61).map(|rest| rest.height);
    assert_eq!(low, Some(0.6));
    assert_eq!(
        Stack::new(FLOOR, Vec::new()).rest(&block((0.0, 1.0)), 1.0).map(|rest| rest.height),
        Some(0.5)
    );
}

#[test]
fn what_lies_on_items_that_change_or_go_is_shaken() {
    // 4 on 3 on both 1 and 2; 1 on 0.
    let stack = stack(&[(-0.2, 0.5), (-0.2, 0.6), (0.25, 0.6), (0.0, 0.7), (0.1, 0.8)]);
    assert_eq!(stack.shaken(0, &[]), [1, 3, 4]);
    assert_eq!(stack.shaken(2, &[]), [3, 4]);
    assert_eq!(stack.shaken(1, &[]), [1, 3, 4]);
    assert_eq!(stack.shaken(0, &[1, 3]), [4]);
    assert_eq!(stack.shaken(4, &[3]), [4]);
    assert_eq!([stack.shaken(4, &[2]), stack.shaken(2, &[4])], [vec![3, 4], vec![3]]);
}

#[test]
fn items_beside_one_another_are_not_in_one_another() {
    let stack = stack(&[(0.0, 0.5), (0.4, 0.5), (0.75, 0.5), (0.0, 0.6)]);
    assert_eq!([0, 1, 2, 3].map(|item| stack.is_in(item)), [None, Some(2), Some(1), None]);
}
