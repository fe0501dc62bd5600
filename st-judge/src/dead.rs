//! What a text need not hold: variables that nobody reads.

use crate::check::Checked;
use crate::finding::Finding;
use crate::view::{ExpressionKind, Section, StatementKind, Unit, each_part, each_statement, expressions};
use std::collections::HashSet;

/// A variable is read where its value is used for anything but its own next
/// value; an output also by whoever calls the block.
pub fn dead(checked: &Checked) -> Vec<Finding> {
    let mut findings = Vec::new();
    let outside = members(checked);
    for unit in &checked.text.units {
        let read = read(unit);
        for variable in &unit.variables {
            let (name, key) = (&variable.name.text, variable.name.key());
            match variable.section {
                Section::Local | Section::Input if !read.contains(&key) => {
                    findings.push(Finding::new("unread", variable.span, format!("nobody reads `{name}`")));
                }
                Section::Output if !read.contains(&key) && !outside.contains(&key) => {
                    findings.push(Finding::new(
                        "unread",
                        variable.span,
                        format!("nobody reads the output `{name}`"),
                    ));
                }
                Section::External if !read.contains(&key) && !written(unit).contains(&key) => {
                    findings.push(Finding::new("unused", variable.span, format!("`{name}` is not used")));
                }
                _ => {}
            }
        }
    }
    findings
}

/// Global variables that no unit reads.
pub fn unread_globals(checked: &Checked) -> Vec<String> {
    let read: HashSet<String> = checked.text.units.iter().flat_map(read).collect();
    let globals = checked.text.configurations.iter().flat_map(|c| &c.globals);
    let unread = globals.filter(|global| !read.contains(&global.name.key()));
    unread.map(|global| global.name.text.clone()).collect()
}

/// Names of all outputs that are read from an instance.
fn members(checked: &Checked) -> HashSet<String> {
    let mut members = HashSet::new();
    for unit in &checked.text.units {
        each_statement(&unit.body, &mut |statement| {
            for expression in expressions(statement) {
                each_part(expression, &mut |part| {
                    if let ExpressionKind::Member { member, .. } = &part.kind {
                        members.insert(member.key());
                    }
                });
            }
        });
    }
    members
}

/// Variables that are read, or called.
fn read(unit: &Unit) -> HashSet<String> {
    let mut read = HashSet::new();
    each_statement(&unit.body, &mut |statement| {
        if let StatementKind::Call(call) = &statement.kind {
            read.insert(call.name.key());
        }
        let (target, whole) = match &statement.kind {
            StatementKind::Assign { target, .. } => match &target.kind {
                ExpressionKind::Index { array, .. } => (Some(&**array), None),
                ExpressionKind::Name(name) => (Some(target), Some(name.key())),
                _ => (Some(target), None),
            },
            _ => (None, None),
        };
        for expression in expressions(statement) {
            each_part(expression, &mut |part| {
                if let ExpressionKind::Name(name) = &part.kind
                    && !target.is_some_and(|target| std::ptr::eq(target, part))
                    && whole != Some(name.key())
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_dead_is_found() {
        let source = "PROGRAM Run\nVAR_EXTERNAL g : DINT; h : DINT; END_VAR\nVAR a : DINT; b : DINT; END_VAR\n\
            WHILE TRUE DO\na := a + b;\nEXIT;\nEND_WHILE;\ng := 1;\nEND_PROGRAM\nCONFIGURATION Conf\n\
            VAR_GLOBAL g : DINT; h : DINT; END_VAR\nRESOURCE Res ON PLC\nTASK Cyclic(INTERVAL := T#10ms, PRIORITY := 0);\n\
            PROGRAM Inst WITH Cyclic : Run;\nEND_RESOURCE\nEND_CONFIGURATION\n";
        let found: Vec<_> = dead(&crate::judge(source).unwrap()).iter().map(|f| f.located(source)).collect();
        assert_eq!(found, ["2:24: unused: `h` is not used", "3:5: unread: nobody reads `a`",]);
    }

    #[test]
    fn outputs_and_globals_are_read_elsewhere() {
        let source = "FUNCTION_BLOCK Count\nVAR_OUTPUT n : DINT; m : DINT; END_VAR\nm := 1;\nn := 1;\nEND_FUNCTION_BLOCK\n\
            PROGRAM Run\nVAR_EXTERNAL g : DINT; h : DINT; END_VAR\nVAR c : Count; END_VAR\nc();\ng := c.n + h;\nEND_PROGRAM\n\
            CONFIGURATION Conf\nVAR_GLOBAL g : DINT; h : DINT; END_VAR\nRESOURCE Res ON PLC\n\
            TASK Cyclic(INTERVAL := T#10ms, PRIORITY := 0);\nPROGRAM Inst WITH Cyclic : Run;\nEND_RESOURCE\nEND_CONFIGURATION\n";
        let checked = crate::judge(source).unwrap();
        let found: Vec<_> = dead(&checked).iter().map(|f| f.located(source)).collect();
        assert_eq!(found, ["2:22: unread: nobody reads the output `m`"]);
        assert_eq!(unread_globals(&checked), ["g"]);
    }
}
