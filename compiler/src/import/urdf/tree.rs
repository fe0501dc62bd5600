//! Links and joints are one tree: every link but the root has one parent.

use super::read::Robot;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

#[derive(Debug)]
pub struct Tree {
    /// Of each link the joint that carries it; none for the root.
    pub above: Vec<Option<usize>>,
    /// Of each link the joints that it carries.
    pub below: Vec<Vec<usize>>,
    pub root: usize,
}

pub fn check(robot: &Robot) -> Result<Tree, Vec<Diagnostic>> {
    let mut found = Vec::new();
    let mut above: Vec<Option<usize>> = vec![None; robot.links.len()];
    let mut below = vec![Vec::new(); robot.links.len()];
    let span = |joint: usize| robot.joints[joint].name.span;
    for (index, joint) in robot.joints.iter().enumerate() {
        let child = &robot.links[joint.child].name.value;
        match above[joint.child] {
            Some(first) => found.push(
                Diagnostic::new("E1105", joint.name.span, format!("{child} is the child of two joints"))
                    .other(span(first), "the first one")
                    .help("remove one of the joints: the links of a robot are a tree"),
            ),
            None => {
                above[joint.child] = Some(index);
                below[joint.parent].push(index);
            }
        }
    }
    let roots: Vec<usize> = (0..robot.links.len()).filter(|link| above[*link].is_none()).collect();
    found.extend(circle(robot, &above, span));
    match roots[..] {
        [root] if found.is_empty() => return Ok(Tree { above, below, root }),
        [first, second, ..] => {
            let [first, second] = [first, second].map(|link| &robot.links[link].name);
            let message = format!("{} and {} both have no joint above them", first.value, second.value);
            found.push(
                Diagnostic::new("E1105", second.span, message)
                    .other(first.span, "the first root")
                    .help("join them, or remove one: the links of a robot are a tree"),
            );
        }
        _ => {}
    }
    Err(found)
}

/// A link that carries itself.
fn circle(robot: &Robot, above: &[Option<usize>], span: impl Fn(usize) -> Span) -> Option<Diagnostic> {
    // From which link the way up has passed each link first.
    let mut passed: Vec<Option<usize>> = vec![None; above.len()];
    for start in 0..above.len() {
        let mut link = start;
        while passed[link].is_none() {
            passed[link] = Some(start);
            match above[link] {
                Some(joint) => link = robot.joints[joint].parent,
                None => break,
            }
        }
        let Some(joint) = above[link].filter(|_| passed[link] == Some(start)) else { continue };
        let name = &robot.links[link].name.value;
        return Some(
            Diagnostic::new("E1105", span(joint), format!("the joints are a circle: {name} carries itself"))
                .help("remove one of the joints of the circle: the links of a robot are a tree"),
        );
    }
    None
}
