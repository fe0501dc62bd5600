//! Attributes of objects in CODESYS and TwinCAT: pragmas in the text, additional data in XML.

use std::fmt::Write;

pub struct Attribute {
    pub name: &'static str,
    pub value: &'static str,
}

/// A member is always written with its type, so that it is never taken for a variable of its name.
pub const OF_ENUMERATIONS: &[Attribute] =
    &[Attribute { name: "qualified_only", value: "" }, Attribute { name: "strict", value: "" }];

/// What a symbol configuration exports, for OPC UA among others: to be read, never to be written.
pub const OF_WHAT_IS_SHOWN: &[Attribute] = &[Attribute { name: "symbol", value: "read" }];

/// A line for each.
pub fn pragmas(attributes: &[Attribute]) -> String {
    attributes.iter().fold(String::new(), |mut text, Attribute { name, value }| {
        let _ = match value.is_empty() {
            true => writeln!(text, "{{attribute '{name}'}}"),
            false => writeln!(text, "{{attribute '{name}' := '{value}'}}"),
        };
        text
    })
}

/// As CODESYS exports them.
pub fn additional_data(attributes: &[Attribute], indent: usize) -> String {
    if attributes.is_empty() {
        return String::new();
    }
    let space = " ".repeat(indent);
    let mut text = format!(
        "{space}<addData>\n\
         {space}  <data name=\"http://www.3s-software.com/plcopenxml/attributes\" handleUnknown=\"implementation\">\n\
         {space}    <Attributes>\n"
    );
    for Attribute { name, value } in attributes {
        let _ = writeln!(text, "{space}      <Attribute Name=\"{name}\" Value=\"{value}\"/>");
    }
    text + &format!("{space}    </Attributes>\n{space}  </data>\n{space}</addData>\n")
}
