//! A small reader of XML: elements, attributes, text, comments, the five entities. Whatever else comes is an error.

/// An element with the line on which it begins.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Element {
    pub name: String,
    pub line: usize,
    pub attributes: Vec<(String, String)>,
    pub children: Vec<Element>,
    /// All text directly within, without the white space around it.
    pub text: String,
}

impl Element {
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(n, _)| n == name).map(|(_, value)| value.as_str())
    }

    pub fn child(&self, name: &str) -> Option<&Element> {
        self.children.iter().find(|c| c.name == name)
    }

    pub fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |c| c.name == name)
    }

    /// The child that bears a name as its attribute.
    pub fn named(&self, element: &str, name: &str) -> Option<&Element> {
        self.children.iter().find(|c| c.name == element && c.attribute("name") == Some(name))
    }
}

/// The outermost element.
pub fn read(text: &str) -> Result<Element, String> {
    let mut reader = Reader { rest: text, whole: text };
    if reader.rest.starts_with("<?xml") {
        reader.after("?>")?;
    }
    reader.space_and_comments()?;
    let root = reader.element()?;
    reader.space_and_comments()?;
    if reader.rest.is_empty() { Ok(root) } else { Err(reader.error("text behind the outermost element")) }
}

struct Reader<'a> {
    rest: &'a str,
    whole: &'a str,
}

impl<'a> Reader<'a> {
    fn line(&self) -> usize {
        let read = &self.whole[..self.whole.len() - self.rest.len()];
        read.matches('\n').count() + 1
    }

    fn error(&self, what: &str) -> String {
        format!("line {}: {what}", self.line())
    }

    fn take(&mut self, sign: &str) -> bool {
        match self.rest.strip_prefix(sign) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn expect(&mut self, sign: &str) -> Result<(), String> {
        if self.take(sign) { Ok(()) } else { Err(self.error(&format!("`{sign}` expected"))) }
    }

    /// What stands before `sign`; goes on behind it.
    fn after(&mut self, sign: &str) -> Result<&'a str, String> {
        let (before, rest) = self.rest.split_once(sign).ok_or_else(|| self.error(&format!("no `{sign}`")))?;
        self.rest = rest;
        Ok(before)
    }

    fn space(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn comment(&mut self) -> Result<bool, String> {
        if !self.take("<!--") {
            return Ok(false);
        }
        let text = self.after("-->")?;
        if text.contains("--") { Err(self.error("`--` in a comment")) } else { Ok(true) }
    }

    fn space_and_comments(&mut self) -> Result<(), String> {
        self.space();
        while self.comment()? {
            self.space();
        }
        Ok(())
    }

    fn name(&mut self) -> Result<String, String> {
        let end = self.rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(self.rest.len());
        let (name, rest) = self.rest.split_at(end);
        if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
            return Err(self.error("a name expected"));
        }
        self.rest = rest;
        Ok(name.into())
    }

    fn element(&mut self) -> Result<Element, String> {
        let line = self.line();
        self.expect("<")?;
        let mut element = Element { name: self.name()?, line, ..Element::default() };
        loop {
            let before = self.rest.len();
            self.space();
            if self.take("/>") {
                return Ok(element);
            }
            if self.take(">") {
                break;
            }
            if self.rest.len() == before {
                return Err(self.error("white space expected before an attribute"));
            }
            let name = self.name()?;
            self.expect("=\"")?;
            let value = self.after("\"")?;
            if element.attribute(&name).is_some() {
                return Err(self.error(&format!("the attribute {name} stands twice")));
            }
            let value = self.plain(value)?;
            element.attributes.push((name, value));
        }
        let mut text = String::new();
        loop {
            let end = self.rest.find('<').ok_or_else(|| self.error("an element without an end"))?;
            let (before, rest) = self.rest.split_at(end);
            text += &self.plain(before)?;
            self.rest = rest;
            if self.take("</") {
                let name = self.name()?;
                if name != element.name {
                    return Err(self.error(&format!("</{name}> ends <{}>", element.name)));
                }
                self.expect(">")?;
                element.text = text.trim().into();
                return Ok(element);
            }
            if !self.comment()? {
                element.children.push(self.element()?);
            }
        }
    }

    fn plain(&self, text: &str) -> Result<String, String> {
        let mut plain = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('&') {
            let (entity, after) = after.split_once(';').ok_or_else(|| self.error("`&` without `;`"))?;
            plain += before;
            plain += match entity {
                "lt" => "<",
                "gt" => ">",
                "amp" => "&",
                "quot" => "\"",
                "apos" => "'",
                _ => return Err(self.error(&format!("unknown entity &{entity};"))),
            };
            rest = after;
        }
        if rest.contains('<') {
            return Err(self.error("`<` in a value"));
        }
        Ok(plain + rest)
    }
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn elements_attributes_and_text() {
        let root = read("<?xml version=\"1.0\"?>\n<!-- x -->\n<a b=\"1 &lt; 2\">t\n <c/><!-- y --><c d=\"\">&amp;</c></a>\n").unwrap();
        assert_eq!((root.name.as_str(), root.text.as_str(), root.line), ("a", "t", 3));
        assert_eq!(root.attribute("b"), Some("1 < 2"));
        let texts: Vec<_> = root.all("c").map(|c| (c.line, c.text.as_str())).collect();
        assert_eq!(texts, [(4, ""), (4, "&")]);
    }

    #[test]
    fn what_is_no_xml_is_refused() {
        let wrong = [
            "",
            "<a>",
            "<a></b>",
            "<a/><b/>",
            "<a b=1/>",
            "<a b=\"1\"c=\"2\"/>",
            "<a b=\"\" b=\"\"/>",
            "<a>&x;</a>",
            "<!-- -- --><a/>",
            "<1/>",
            "<a>< /a>",
        ];
        for text in wrong {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
