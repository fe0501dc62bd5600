//! Keys of devices that settings give: they stand in the object as if the layout had them.

use super::setting::{Machine, Setting, machines};
use crate::diagnostic::Diagnostic;
use crate::ir::{Automaton, Model};
use crate::layout::json::Member;
use crate::layout::{Layout, Object};
use crate::source::Spanned;
use std::borrow::Cow;
use std::collections::HashMap;

/// Whether a setting of this name is one of the device's keys: a parameter of the automaton comes first.
pub fn is_key(name: &str, automaton: &Automaton) -> bool {
    let is_parameter = automaton.parameters.iter().any(|p| p.is_settable() && p.name == name);
    !is_parameter && automaton.device.parameters.iter().any(|p| p.name == name)
}

/// The layout with the keys that the settings give; the last of several holds.
pub fn set<'a>(layout: &'a Layout, settings: &[Setting], model: &Model) -> Cow<'a, Layout> {
    let mut with_keys = Cow::Borrowed(layout);
    let concerned = concerned(layout, settings, model);
    if concerned.is_empty() {
        return with_keys;
    }
    let keys: HashMap<&str, Vec<&Setting>> =
        concerned.into_iter().map(|(object, keys)| (object.name.value.as_str(), keys)).collect();
    for object in &mut with_keys.to_mut().objects {
        for setting in keys.get(object.name.value.as_str()).into_iter().flatten() {
            give(object, setting);
        }
    }
    with_keys
}

fn give(object: &mut Object, setting: &Setting) {
    let key = Spanned { value: setting.parameter.clone(), span: setting.span };
    let member = Member { key, value: setting.value.clone() };
    match object.members.iter_mut().find(|present| present.key.value == setting.parameter) {
        Some(present) => *present = member,
        None => object.members.push(member),
    }
}

/// Whether an error is of an object with such keys, so that other values may not have it.
pub fn depends_on_values(found: &Diagnostic, layout: &Layout, settings: &[Setting], model: &Model) -> bool {
    let places = || found.others.iter().map(|(place, _)| *place).chain([found.place]);
    let is_of = |object: &Object| {
        let span = object.span;
        places().any(|place| place.file == span.file && span.start <= place.start && place.end <= span.end)
    };
    settings.iter().any(|setting| setting.span.file == found.place.file)
        || concerned(layout, settings, model).iter().any(|(object, _)| is_of(object))
}

/// Objects with the settings that are keys of their devices.
fn concerned<'a>(
    layout: &'a Layout,
    settings: &'a [Setting],
    model: &'a Model,
) -> Vec<(&'a Object, Vec<&'a Setting>)> {
    if settings.is_empty() {
        return Vec::new();
    }
    let of_machine = |(object, automaton): Machine<'a>| {
        let is_its = |setting: &&Setting| setting.applies_to(object) && is_key(&setting.parameter, automaton);
        let keys: Vec<&Setting> = settings.iter().filter(is_its).collect();
        (!keys.is_empty()).then_some((object, keys))
    };
    machines(layout, model).into_iter().filter_map(of_machine).collect()
}
