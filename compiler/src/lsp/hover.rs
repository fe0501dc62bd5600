//! What a name is: its declaration, what is known of its value where it stands, and its description.

use super::specs::Specs;
use crate::check::names::{Declaration, What};
use crate::source::Span;

/// As Markdown, and the place of the name. Descriptions are text in it, never markup.
pub fn hover(specs: &Specs, place: Span) -> Option<(String, Span)> {
    let (number, place) = specs.names.at(place)?;
    let declaration = &specs.names.declarations()[number];
    let mut text = format!("```autogen\n{}\n```", signature(specs, declaration).replace('`', "'"));
    if let Some((lo, hi)) = specs.names.bounds(place) {
        text.push_str(&match lo == hi {
            true => format!("\n\nhere {lo}"),
            false => format!("\n\nhere {lo}..{hi}"),
        });
    }
    if !declaration.doc.is_empty() {
        text.push_str("\n\n");
        text.push_str(&escaped(&declaration.doc.join(" ")));
    }
    if let Some(of) = owner(declaration) {
        text.push_str(&format!("\n\n{of}"));
    }
    Some((text, place))
}

/// A declaration on one line, nearly as it is written.
pub fn signature(specs: &Specs, declaration: &Declaration) -> String {
    let Declaration { what, name, owner, ty, .. } = declaration;
    let typed = |word: &str| format!("{word} {name}: {ty}");
    match what {
        What::Enumeration => {
            let all = specs.names.declarations().iter();
            let own = all.filter(|d| d.what == What::Member && d.owner == *name).map(|d| d.name.as_str());
            format!("enum {name} {{ {} }}", own.collect::<Vec<_>>().join(", "))
        }
        What::Member => format!("{owner}.{name}"),
        What::Interface => format!("interface {name}"),
        What::Automaton => format!("automaton {name} {ty}"),
        What::Parameter | What::Key => typed("parameter"),
        What::Cell => typed("shared"),
        What::Role => typed("role"),
        What::Local => typed("local"),
        What::Define if ty.is_empty() => format!("define {name}"),
        What::Define => typed("define"),
        What::DeviceDefine => format!("define {name}"),
        What::State => format!("state {name}"),
        What::Variable => format!("{name}: {ty}"),
        What::Device => format!("device {name}"),
        What::Assembly => format!("assembly {name}"),
        What::Part => format!("part {name} = {ty}"),
        What::Port => typed("port"),
        What::Constant => typed("constant"),
        What::Command => format!("command {name}{ty}"),
        What::Handover => format!("handover {name}"),
        What::Primitive => format!("primitive {name}"),
        What::Setting if ty.is_empty() => format!("setting {name}"),
        What::Setting => format!("setting {name} [{ty}]"),
        What::Wire => format!("{owner}.{name}{ty}"),
    }
}

fn owner(declaration: &Declaration) -> Option<String> {
    let Declaration { what, owner, .. } = declaration;
    (!owner.is_empty() && !matches!(what, What::Member | What::Wire)).then(|| format!("of `{owner}`"))
}

/// Text as Markdown shows it as it is; what stands in pairs of backticks is code.
pub fn escaped(text: &str) -> String {
    let pieces: Vec<&str> = text.split('`').collect();
    if pieces.len().is_multiple_of(2) {
        return plain(text);
    }
    let piece = |(number, piece): (usize, &&str)| match number % 2 {
        0 => plain(piece),
        _ => format!("`{piece}`"),
    };
    pieces.iter().enumerate().map(piece).collect()
}

fn plain(text: &str) -> String {
    let escape = |c: char| match c.is_ascii_punctuation() {
        true => vec!['\\', c],
        false => vec![c],
    };
    text.chars().flat_map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn descriptions_are_no_markup() {
        assert_eq!(escaped("a `b_c` <img> d"), "a `b_c` \\<img\\> d");
        assert_eq!(escaped("one ` [x](y)"), "one \\` \\[x\\]\\(y\\)");
    }
}
