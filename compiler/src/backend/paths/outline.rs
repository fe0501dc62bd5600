//! A line of many points by fewer of them.

/// Points of a drawing, in pixels.
pub type Dot = (f64, f64);

/// The points that are needed to stay within `tolerance` of the line (Ramer, Douglas and Peucker).
pub fn simplified(points: &[Dot], tolerance: f64) -> Vec<Dot> {
    let mut is_needed = vec![false; points.len()];
    let mut open = Vec::new();
    if let Some(last) = points.len().checked_sub(1) {
        (is_needed[0], is_needed[last]) = (true, true);
        open.push((0, last));
    }
    while let Some((first, last)) = open.pop() {
        let far = (first + 1..last)
            .map(|i| (i, distance(points[i], points[first], points[last])))
            .fold((first, 0.0), |far, next| if next.1 > far.1 { next } else { far });
        if far.1 > tolerance {
            is_needed[far.0] = true;
            open.extend([(first, far.0), (far.0, last)]);
        }
    }
    points.iter().zip(is_needed).filter(|(_, needed)| *needed).map(|(point, _)| *point).collect()
}

/// From a point to the line between two others.
fn distance(point: Dot, from: Dot, to: Dot) -> f64 {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let square = dx * dx + dy * dy;
    let along = match square > 0.0 {
        true => (((point.0 - from.0) * dx + (point.1 - from.1) * dy) / square).clamp(0.0, 1.0),
        false => 0.0,
    };
    let (x, y) = (from.0 + along * dx - point.0, from.1 + along * dy - point.1);
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_stay_and_what_lies_between_goes() {
        let corner = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.05), (3.0, 0.0), (3.0, 2.0), (3.0, 4.0)];
        assert_eq!(simplified(&corner, 0.1), [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]);
        assert_eq!(simplified(&corner, 0.03).len(), 4);
        // There and back: the ends alone would not show it.
        let back = [(0.0, 0.0), (5.0, 0.0), (9.0, 0.0), (0.0, 0.0)];
        assert_eq!(simplified(&back, 0.1), [(0.0, 0.0), (9.0, 0.0), (0.0, 0.0)]);
        assert_eq!(simplified(&[], 0.1), []);
        assert_eq!(simplified(&[(1.0, 1.0)], 0.1), [(1.0, 1.0)]);
    }

    #[test]
    fn a_curve_keeps_its_tolerance() {
        let curve: Vec<Dot> =
            (0..=1000).map(|i| (f64::from(i), 100.0 * (f64::from(i) / 100.0).sin())).collect();
        let kept = simplified(&curve, 0.3);
        assert!(kept.len() < 150, "{}", kept.len());
        for point in &curve {
            let off = kept.windows(2).map(|pair| distance(*point, pair[0], pair[1])).fold(9.0, f64::min);
            assert!(off <= 0.3, "{off}");
        }
    }
}
