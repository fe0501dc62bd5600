//! Kinds of part that the processes of devices name.

use crate::diagnostic::{Diagnostic, MOST, suggestion};
use crate::source::FileId;
use crate::spec::ast::{self, DeviceMember, ExprKind};
use std::collections::BTreeSet;

/// The setting of a process with pairs: a kind, and the kind that it becomes.
const MAKES: &str = "makes";

/// What a kind of the scenario becomes is a kind of the scenario. A pair of a kind that the scenario does not have is for
/// other lines.
pub fn unknown(files: &[(FileId, ast::File)], devices: &BTreeSet<&str>, kinds: &[String]) -> Vec<Diagnostic> {
    // A device of a later file replaces one of the same name of an earlier one.
    let declared = |name: &&str| {
        let mut all = files.iter().rev().flat_map(|(_, file)| &file.devices);
        all.find(|device| device.name.value == *name)
    };
    let members = devices.iter().filter_map(declared).flat_map(|device| &device.members);
    let settings = members.flat_map(|member| match member {
        DeviceMember::Part(part) if part.kind.value == "process" => part.settings.as_slice(),
        _ => &[],
    });
    let pairs = settings.filter(|(name, _)| name.value == MAKES);
    let pairs = pairs.flat_map(|(_, value)| match &value.kind {
        ExprKind::List(elements) => elements.chunks_exact(2),
        _ => [].chunks_exact(2),
    });
    let is_kind = |name: &String| kinds.contains(name);
    let wrong = pairs.filter_map(|pair| match (&pair[0].kind, &pair[1].kind) {
        (ExprKind::Name(from), ExprKind::Name(to)) if is_kind(from) && !is_kind(to) => {
            let help = match suggestion(to, kinds.iter().map(String::as_str)) {
                Some(near) => format!("is `{near}` meant?"),
                None => format!("the kinds are {}", kinds.join(", ")),
            };
            let message = format!("the scenario has no kind `{to}`, which a `{from}` would become");
            Some(Diagnostic::new("E0710", pair[1].span, message).help(help))
        }
        _ => None,
    });
    wrong.take(MOST).collect()
}
