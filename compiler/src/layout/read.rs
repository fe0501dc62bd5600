//! From the text of a layout to its tree.

use super::decode::{Decoder, find, instead, make_identifier, some};
use super::json::{self, Json, Member, Value};
use super::object::is_common;
use super::{Layout, Object, Panel, Part};
use crate::diagnostic::{Diagnostic, sort};
use crate::source::{FileId, Sources, Spanned};
use std::collections::HashSet;
use std::ffi::OsStr;
use std::ops::RangeInclusive;
use std::path::Path;

pub const KEYS: [&str; 9] =
    ["robots", "stationary", "name", "specs", "scenario", "scan_ms", "panel", "routes", "may_touch"];
const SCAN_MS: u32 = 10;
pub const SCANS_MS: RangeInclusive<u32> = 1..=1000;
/// The longest line that is measured has 10,040.
pub const MOST_OBJECTS: usize = 12_000;

/// What could be read, to check it further; with any diagnostic there is no sense in building from it.
pub type Reading = (Option<Layout>, Vec<Diagnostic>);

/// Reads a layout as far as it is right.
pub fn parse(sources: &Sources, file: FileId) -> Reading {
    let source = sources.file(file);
    let (json, diagnostics) = json::parse(&source.text, file);
    let mut decoder = Decoder::new(diagnostics);
    let layout = json.and_then(|json| decoder.layout(&json, &source.name));
    sort(&mut decoder.diagnostics);
    (layout, decoder.diagnostics)
}

impl Decoder {
    fn layout(&mut self, json: &Json, file_name: &str) -> Option<Layout> {
        let members = self.object(json, "a layout")?;
        self.unknown_keys_of_file(members, &KEYS, "a layout", |key| {
            is_common(key).then(|| format!("write \"{key}\" in the object of a machine, in \"robots\""))
        });
        let robots = self.required(members, "robots", json.span, "the layout");
        let mut objects = self.layout_objects(robots, "robots", Part::Robot);
        objects.extend(self.layout_objects(find(members, "stationary"), "stationary", Part::Stationary));
        self.bounded_objects(&objects);
        self.distinct(objects.iter().map(|o| &o.name), "an object");
        self.neighbours(&objects, &names(members));

        let name = find(members, "name").and_then(|j| self.text(j, "name"));
        if let Some(name) = &name {
            self.identifier(name, "a layout");
        }
        let specs = find(members, "specs").and_then(|j| match j.value {
            Value::Text(_) => Some(vec![self.text(j, "specs")?]),
            _ => self.texts(j, "specs"),
        });
        let scenario = find(members, "scenario").and_then(|j| self.text(j, "scenario"));
        specs.iter().flatten().for_each(|path| self.stays_within("specs", path));
        scenario.iter().for_each(|path| self.stays_within("scenario", path));
        let scan_ms = find(members, "scan_ms").and_then(|j| self.whole(j, "scan_ms", SCANS_MS));
        let panel = find(members, "panel").and_then(|j| self.one_of(j, "panel", &Panel::ALL));
        let routes = find(members, "routes").map(|j| self.all_routes(j));
        let may_touch = find(members, "may_touch").map(|j| self.may_touch(j, &names(members)));
        Some(Layout {
            name: name.map_or_else(|| make_identifier(stem(file_name), "layout"), |n| n.value),
            file: json.span.file,
            objects,
            specs: specs.unwrap_or_default(),
            scenario,
            scan_ms: scan_ms.unwrap_or(SCAN_MS),
            panel: panel.unwrap_or_default(),
            routes: routes.unwrap_or_default(),
            may_touch: may_touch.unwrap_or_default(),
        })
    }

    fn bounded_objects(&mut self, objects: &[Object]) {
        if let Some(first) = objects.get(MOST_OBJECTS) {
            let message = format!("a layout has at most {MOST_OBJECTS} robots and stationary objects");
            self.report(
                Diagnostic::new("E0143", first.name.span, message)
                    .label("the first that is too many")
                    .note(format!("there are {}", objects.len()))
                    .help("make several lines of this one"),
            );
        }
    }

    fn layout_objects(&mut self, json: Option<&Json>, key: &str, part: Part) -> Vec<Object> {
        let items = json.and_then(|j| self.list(j, key)).unwrap_or_default();
        items.iter().filter_map(|item| self.layout_object(item, part)).collect()
    }

    fn neighbours(&mut self, objects: &[Object], known: &[&str]) {
        let all: HashSet<&str> = known.iter().copied().collect();
        for object in objects {
            let own = object.name.value.as_str();
            for (key, list) in [("takes_from", &object.takes_from), ("hands_to", &object.hands_to)] {
                for name in list.iter().flat_map(|list| &list.value) {
                    if self.is_full() {
                        return;
                    }
                    if name.value == own || !all.contains(name.value.as_str()) {
                        self.no_neighbour(own, key, name, known);
                    }
                }
            }
        }
    }

    fn no_neighbour(&mut self, own: &str, key: &str, name: &Spanned<String>, known: &[&str]) {
        let others: Vec<&str> = known.iter().copied().filter(|name| *name != own).collect();
        let message = match name.value == *own {
            true => format!("\"{own}\" is in its own {key}"),
            false => format!("{key} of \"{own}\" names \"{}\", which is not in the layout", name.value),
        };
        self.report(
            Diagnostic::new("E0122", name.span, message)
                .note(format!("the layout has: {}", some(known)))
                .help(instead(&name.value, &others)),
        );
    }
}

/// Names of all objects, of those too that have other errors.
fn names(members: &[Member]) -> Vec<&str> {
    let mut names = Vec::new();
    for key in ["robots", "stationary"] {
        let Some(Json { value: Value::List(items), .. }) = find(members, key) else { continue };
        for item in items {
            let Value::Object(members) = &item.value else { continue };
            if let Some(Json { value: Value::Text(name), .. }) = find(members, "name") {
                names.push(name.as_str());
            }
        }
    }
    names
}

fn stem(file_name: &str) -> &str {
    let file = Path::new(file_name).file_name().and_then(OsStr::to_str).unwrap_or(file_name);
    file.rsplit_once('.').map_or(file, |(stem, _)| stem)
}
