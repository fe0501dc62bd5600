//! The pairs of which the layout says that they may touch.

use super::MayTouch;
use super::decode::{Decoder, instead};
use super::json::Json;
use crate::diagnostic::Diagnostic;
use crate::source::{Span, Spanned};
use std::collections::HashMap;

impl Decoder {
    /// `known` are the names of all objects.
    pub(super) fn may_touch(&mut self, json: &Json, known: &[&str]) -> Vec<MayTouch> {
        let items = self.list(json, "may_touch").unwrap_or_default();
        let mut list: Vec<MayTouch> = Vec::new();
        let mut pairs: HashMap<[String; 2], Span> = HashMap::new();
        for item in items {
            let Some(found) = self.pair_that_may_touch(item, known) else { continue };
            let names = |m: &MayTouch| {
                let mut names = m.pair.each_ref().map(|name| name.value.clone());
                names.sort();
                names
            };
            match pairs.get(&names(&found)).copied() {
                Some(first) => {
                    let [a, b] = &found.pair;
                    let message = format!("\"{}\" and \"{}\" may touch twice", a.value, b.value);
                    self.report(
                        Diagnostic::new("E0128", a.span, message)
                            .label("second time")
                            .other(first, "first time")
                            .help("remove one of them; the order of the two names has no effect"),
                    );
                }
                None => {
                    pairs.insert(names(&found), found.pair[0].span);
                    list.push(found);
                }
            }
        }
        list
    }

    fn pair_that_may_touch(&mut self, json: &Json, known: &[&str]) -> Option<MayTouch> {
        let what = "an element of may_touch";
        let members = self.object(json, what)?;
        self.unknown_keys(members, &["pair", "reason"], what);
        let reason = self.required(members, "reason", json.span, what);
        let reason = reason.and_then(|j| self.text(j, "reason")).filter(|reason| self.says_why(reason));
        let pair = self.required(members, "pair", json.span, what);
        let names = pair.and_then(|j| self.exactly(j, "pair", &["one name", "another name"]))?;
        let a = self.text(&names[0], "pair[0]").filter(|name| self.is_known(name, known));
        let b = self.text(&names[1], "pair[1]").filter(|name| self.is_known(name, known));
        let pair = [a?, b?];
        if pair[0].value == pair[1].value {
            let message = format!("\"{}\" occurs twice in one pair", pair[0].value);
            self.report(
                Diagnostic::new("E0128", pair[1].span, message)
                    .note("contact of an arm with itself always ends the run")
                    .help("name the other one"),
            );
            return None;
        }
        Some(MayTouch { pair, reason: reason?.value })
    }

    fn says_why(&mut self, reason: &Spanned<String>) -> bool {
        let says = !reason.value.trim().is_empty();
        if !says {
            self.report(
                Diagnostic::new("E0128", reason.span, "the reason is empty")
                    .note("contact ends a run, unless the layout says why it is harmless")
                    .help("say why the two may touch"),
            );
        }
        says
    }

    fn is_known(&mut self, name: &Spanned<String>, known: &[&str]) -> bool {
        let is_known = known.contains(&name.value.as_str());
        if !is_known {
            let message = format!("may_touch names \"{}\", which is not in the layout", name.value);
            self.report(
                Diagnostic::new("E0122", name.span, message)
                    .note(format!("the layout has: {}", known.join(", ")))
                    .help(instead(&name.value, known)),
            );
        }
        is_known
    }
}
