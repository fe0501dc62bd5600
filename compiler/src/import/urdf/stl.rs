//! The vertices of a mesh in STL, binary or as text.

use runtime_sim::point::Point;

const HEAD: usize = 80;
const TRIANGLE: usize = 50;

/// In the unit of the file.
pub fn vertices(bytes: &[u8]) -> Result<Vec<Point>, String> {
    let points = match count(bytes) {
        Some(triangles) if bytes.len() == HEAD + 4 + triangles * TRIANGLE => binary(bytes),
        _ if bytes.trim_ascii_start().starts_with(b"solid") => text(bytes)?,
        Some(_) | None => return Err("this is not STL, or it is cut off".into()),
    };
    match points.iter().all(|point| point.is_near()) {
        true if points.is_empty() => Err("it has no triangles".into()),
        true => Ok(points),
        false => Err("a vertex is no number".into()),
    }
}

fn count(bytes: &[u8]) -> Option<usize> {
    let count: [u8; 4] = bytes.get(HEAD..HEAD + 4)?.try_into().ok()?;
    Some(u32::from_le_bytes(count) as usize)
}

/// Each triangle has its normal, three vertices and two bytes more.
fn binary(bytes: &[u8]) -> Vec<Point> {
    let number = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, |four| f64::from(f32::from_le_bytes(four)));
    let triangles = bytes[HEAD + 4..].chunks_exact(TRIANGLE);
    let vertices = triangles.flat_map(|triangle| triangle[12..48].chunks_exact(12));
    vertices.map(|xyz| Point::new(number(&xyz[..4]), number(&xyz[4..8]), number(&xyz[8..]))).collect()
}

fn text(bytes: &[u8]) -> Result<Vec<Point>, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "this is not STL, or it is cut off".to_string())?;
    let lines = text.lines().filter_map(|line| line.trim().strip_prefix("vertex"));
    lines
        .map(|line| {
            let mut numbers = line.split_whitespace().map(|word| word.parse::<f64>());
            match (numbers.next(), numbers.next(), numbers.next(), numbers.next()) {
                (Some(Ok(x)), Some(Ok(y)), Some(Ok(z)), None) => Ok(Point::new(x, y, z)),
                _ => Err("a vertex does not have three numbers".to_string()),
            }
        })
        .collect()
}
