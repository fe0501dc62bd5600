//! One level of operators in a parenthesis.

use super::Checker;
use crate::view::{Binary, Expression, ExpressionKind, Unary};

impl Checker<'_> {
    pub(super) fn operand_of(&mut self, operator: Binary, side: Side, operand: &Expression) {
        let chains =
            matches!(operator, Binary::And | Binary::Or | Binary::Xor | Binary::Add | Binary::Multiply);
        let is_fine = match &operand.kind {
            ExpressionKind::Binary { operator: inner, .. } => {
                chains && side == Side::Left && *inner == operator
            }
            ExpressionKind::Unary { operator: Unary::Not, .. } => {
                matches!(operator, Binary::And | Binary::Or | Binary::Xor)
            }
            ExpressionKind::Unary { operator: Unary::Minus, .. } => false,
            _ => true,
        };
        if !is_fine {
            self.report("parentheses", operand.span, "a second level of operators without parentheses");
        }
    }

    pub(super) fn operand_of_unary(&mut self, operand: &Expression) {
        if matches!(operand.kind, ExpressionKind::Unary { .. } | ExpressionKind::Binary { .. }) {
            self.report("parentheses", operand.span, "a second level of operators without parentheses");
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
}
