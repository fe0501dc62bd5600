//! Statements.

use super::super::code::{Arm, BlockCall, Body, BranchInfo, Case, Numbered, Step};
use super::{Compiler, Scope};
use crate::literal;
use crate::types::Type;
use crate::view::{Branch, Call, Clause, Expression, ExpressionKind, Section, Statement, StatementKind};

impl Compiler<'_> {
    pub(super) fn body(&mut self, scope: &Scope, body: &[Statement]) -> Body {
        body.iter().map(|statement| self.statement(scope, statement)).collect()
    }

    fn statement(&mut self, scope: &Scope, statement: &Statement) -> Numbered {
        let number = self.code.statements.len();
        self.code.statements.push(statement.span);
        let step = match &statement.kind {
            StatementKind::Assign { target, value } => {
                Step::Store(self.cell(scope, target), self.any(scope, value))
            }
            StatementKind::Call(call) => Step::Call(self.block_call(scope, call)),
            StatementKind::If { branches, otherwise } => {
                let arms = branches.iter().map(|branch| self.arm(scope, branch)).collect();
                Step::If(arms, self.body(scope, otherwise.as_deref().unwrap_or(&[])))
            }
            StatementKind::Case { subject, clauses, otherwise } => {
                Step::Case(Box::new(self.case(scope, subject, clauses, otherwise.as_deref().unwrap_or(&[]))))
            }
            StatementKind::While { condition, body } => {
                Step::While(self.truth(scope, condition), self.body(scope, body), statement.span.start)
            }
            StatementKind::Exit => Step::Exit,
            StatementKind::Return => Step::Return,
            StatementKind::Other => unreachable!("the check refuses it"),
        };
        Numbered { number, step }
    }

    fn arm(&mut self, scope: &Scope, branch: &Branch) -> Arm {
        let number = self.code.conditions.len();
        self.code.conditions.push(branch.condition.span);
        let condition = self.truth(scope, &branch.condition);
        Arm { number, condition, body: self.body(scope, &branch.body) }
    }

    fn case(
        &mut self,
        scope: &Scope,
        subject: &Expression,
        clauses: &[Clause],
        otherwise: &[Statement],
    ) -> Case {
        let subject_code = self.whole(scope, subject);
        let mut labels = Vec::new();
        let mut arms = Vec::new();
        for clause in clauses {
            let mut texts = Vec::new();
            for label in &clause.labels {
                let ExpressionKind::Int(text) = &label.kind else { unreachable!("the check wants literals") };
                labels.push((literal::int(text).expect("checked"), arms.len()));
                texts.push(text.as_str());
            }
            let branch = self.branch(scope, texts.join(", "), clause.span.start);
            arms.push((branch, self.body(scope, &clause.body)));
        }
        let at = otherwise.first().map_or(subject.span.start, |s| s.span.start);
        let branch = self.branch(scope, "ELSE".into(), at);
        arms.push((branch, self.body(scope, otherwise)));
        labels.sort_unstable();
        Case { subject: subject_code, labels, arms }
    }

    fn branch(&mut self, scope: &Scope, label: String, at: usize) -> usize {
        self.code.branches.push(BranchInfo { unit: scope.unit.name.text.clone(), label, at });
        self.code.branches.len() - 1
    }

    fn block_call(&mut self, scope: &Scope, call: &Call) -> BlockCall {
        let spot = scope.spot(&call.name);
        let Type::Block(block) = &spot.ty else { unreachable!("the check wants an instance") };
        let frame = self.layouts.unit(block);
        let mut inputs = Vec::new();
        let mut copied_back = Vec::new();
        for argument in &call.arguments {
            let name = argument.name.as_ref().expect("the check wants names");
            let input = &frame.variables[&name.key()];
            if input.section == Section::InOut {
                let ExpressionKind::Name(outside) = &argument.value.kind else {
                    unreachable!("the check wants a variable")
                };
                let words = match input.ty {
                    Type::Array(_, upper) => upper + 1,
                    _ => 1,
                };
                copied_back.push((input.offset, scope.spot(outside).slot(), words));
            }
            inputs.push((input.offset, self.any(scope, &argument.value)));
        }
        BlockCall { unit: self.numbers[block], instance: spot.slot(), inputs, copied_back }
    }
}
