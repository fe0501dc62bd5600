//! What a text need not hold: variables that nobody reads, statements that nothing reaches.

use crate::check::Checked;
use crate::finding::Finding;
use crate::view::{
    ExpressionKind, Section, Statement, StatementKind, Unit, bodies, each_part, each_statement, expressions,
};
use std::collections::HashSet;

pub fn dead(checked: &Checked) -> Vec<Finding> {
    let mut findings = Vec::new();
    for unit in &checked.text.units {
        let read = read(unit);
        for variable in &unit.variables {
            let (name, key) = (&variable.name.text, variable.name.key());
            match variable.section {
                Section::Local | Section::Input if !read.contains(&key) => {
                    findings.push(Finding::new("unread", variable.span, format!("nobody reads `{name}`")));
                }
                Section::External if !read.contains(&key) && !written(unit).contains(&key) => {
                    findings.push(Finding::new("unused", variable.span, format!("`{name}` is not used")));
                }
                _ => {}
            }
        }
        unreachable(&unit.body, &mut findings);
    }
    findings
}

/// Variables that are read, or called.
fn read(unit: &Unit) -> HashSet<String> {
    let mut read = HashSet::new();
    each_statement(&unit.body, &mut |statement| {
        if let StatementKind::Call(call) = &statement.kind {
            read.insert(call.name.key());
        }
        for expression in expressions(statement) {
            let target = match &statement.kind {
                StatementKind::Assign { target, .. } => match &target.kind {
                    ExpressionKind::Index { array, .. } => Some(&**array),
                    _ => Some(target),
                },
                _ => None,
            };
            each_part(expression, &mut |part| {
                if let ExpressionKind::Name(name) = &part.kind
                    && !target.is_some_and(|target| std::ptr::eq(target, part))
                {
                    read.insert(name.key());
                }
            });
        }
    });
    read
}

fn written(unit: &Unit) -> HashSet<String> {
    let mut written = HashSet::new();
    each_statement(&unit.body, &mut |statement| {
        if let StatementKind::Assign { target, .. } = &statement.kind {
            each_part(target, &mut |part| {
                if let ExpressionKind::Name(name) = &part.kind {
                    written.insert(name.key());
                }
            });
        }
    });
    written
}

fn unreachable(body: &[Statement], findings: &mut Vec<Finding>) {
    for pair in body.windows(2) {
        if matches!(pair[0].kind, StatementKind::Exit | StatementKind::Return) {
            findings.push(Finding::new("unreachable", pair[1].span, "nothing reaches this statement"));
        }
    }
    for statement in body {
        bodies(statement).into_iter().for_each(|inner| unreachable(inner, findings));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_dead_is_found() {
        let source = "PROGRAM Run\nVAR_EXTERNAL g : DINT; h : DINT; END_VAR\nVAR a : DINT; b : DINT; END_VAR\n\
            WHILE TRUE DO\na := b;\nEXIT;\ng := 1;\nEND_WHILE;\nEND_PROGRAM\nCONFIGURATION Conf\n\
            VAR_GLOBAL g : DINT; h : DINT; END_VAR\nRESOURCE Res ON PLC\nTASK Cyclic(INTERVAL := T#10ms, PRIORITY := 0);\n\
            PROGRAM Inst WITH Cyclic : Run;\nEND_RESOURCE\nEND_CONFIGURATION\n";
        let found: Vec<_> = dead(&crate::judge(source).unwrap()).iter().map(|f| f.located(source)).collect();
        assert_eq!(
            found,
            [
                "2:24: unused: `h` is not used",
                "3:5: unread: nobody reads `a`",
                "7:1: unreachable: nothing reaches this statement"
            ]
        );
    }
}
