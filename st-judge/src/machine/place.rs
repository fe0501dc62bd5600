//! Where a scalar stands in memory.

use crate::types::Scalar;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    pub(super) address: usize,
    pub(super) ty: Scalar,
}

impl Place {
    pub fn ty(self) -> Scalar {
        self.ty
    }
}

/// A path as parts and an index: `a.b[2]`.
pub(super) fn split(path: &str) -> Option<(Vec<String>, Option<usize>)> {
    let (names, index) = match path.strip_suffix(']') {
        None => (path, None),
        Some(front) => {
            let (names, index) = front.rsplit_once('[')?;
            (names, Some(index.parse().ok()?))
        }
    };
    Some((names.split('.').map(str::to_ascii_lowercase).collect(), index))
}
