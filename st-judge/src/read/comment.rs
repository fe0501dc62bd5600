//! Comments: `(* *)` only, not one in another.

use super::{Reader, children};
use tree_sitter::Node;

impl Reader<'_> {
    pub(super) fn comments(&mut self, node: Node) {
        if node.kind() == "comment" {
            let text = self.text(node);
            if text.starts_with("//") {
                self.report("comment", node, "a comment with `//`");
            } else if text[2..].contains("(*") {
                self.report("comment", node, "a comment in a comment");
            }
        }
        children(node).into_iter().for_each(|child| self.comments(child));
    }
}
