//! `device` and `assembly`: parameters, parts, ports, commands, constants, places.

use super::Parser;
use crate::diagnostic::suggestion;
use crate::source::Spanned;
use crate::spec::ast;
use crate::spec::lexer::{Token, foreign};
use runtime_sim::device::Direction;

/// The words with which the members of a device begin.
const MEMBERS: &[&str] =
    &["parameter", "define", "part", "in", "out", "command", "constant", "handover", "require"];

impl Parser {
    pub(super) fn parse_device(&mut self, doc: Vec<String>) -> Option<ast::Device> {
        let is_assembly = self.at_word("assembly");
        self.next();
        let name = self.expect_name("the device")?;
        let mut device = ast::Device {
            doc,
            name,
            is_assembly,
            parameters: Vec::new(),
            members: Vec::new(),
            requires: Vec::new(),
            ports: Vec::new(),
            commands: Vec::new(),
            constants: Vec::new(),
            handovers: Vec::new(),
        };
        if self.expect_sign("{", "before the body of the device").is_none() {
            self.recover();
            return Some(device);
        }
        loop {
            let doc = self.doc();
            if self.maybe_sign("}") {
                return Some(device);
            }
            if *self.peek() == Token::End || self.at_item() {
                let message = format!("`}}` is missing at the end of the device `{}`", device.name.value);
                self.error("E0205", message, "close the device");
                return Some(device);
            }
            let known = self.word().and_then(|word| MEMBERS.iter().find(|member| **member == word));
            let Some(member) = known.copied() else {
                let found = self.found();
                let near = match self.peek() {
                    Token::Word(word) => foreign::meant_among(word, MEMBERS)
                        .or_else(|| suggestion(word, MEMBERS.iter().copied())),
                    _ => None,
                };
                let help = match near {
                    Some(word) => format!("is `{word}` meant?"),
                    None if self.at_sign(";") => "remove it: one `;` ends a declaration".into(),
                    None => format!("a device has `{}`", MEMBERS.join("`, `")),
                };
                self.error("E0204", format!("{found} is not allowed in a device"), help);
                self.next();
                self.recover_member();
                continue;
            };
            let errors = self.errors;
            if self.device_member(member, doc, &mut device).is_none()
                || self.errors > errors
                || self.expect_sign(";", "at the end of the declaration").is_none()
            {
                self.recover_member();
            }
        }
    }

    fn device_member(&mut self, member: &str, doc: Vec<String>, device: &mut ast::Device) -> Option<()> {
        if member == "require" {
            device.requires.push(self.require()?);
            return Some(());
        }
        self.next();
        match member {
            "parameter" => device.parameters.push(self.device_parameter(doc)?),
            "define" => {
                let name = self.expect_name("the definition")?;
                self.expect_sign("=", "before what the definition means")?;
                let value = self.parse_expr();
                device.members.push(ast::DeviceMember::Define(ast::Define { doc, name, value }));
            }
            "part" => device.members.push(ast::DeviceMember::Part(self.part()?)),
            "in" => device.ports.push(self.port(doc, Direction::Input)?),
            "out" => device.ports.push(self.port(doc, Direction::Output)?),
            "command" => device.commands.push(self.device_command(doc)?),
            "constant" => device.constants.push(self.device_constant(doc)?),
            _ => device.handovers.push(self.place()?),
        }
        Some(())
    }

    /// To the next member on this level, or past a `;` that is followed by one.
    fn recover_member(&mut self) {
        let mut depth = 0_usize;
        loop {
            match self.peek() {
                Token::End => return,
                Token::Sign("{") => depth += 1,
                Token::Sign("}") if depth == 0 => return,
                Token::Sign("}") => depth -= 1,
                Token::Sign(";") if depth == 0 => {
                    self.next();
                    return;
                }
                Token::Word(w) if depth == 0 && MEMBERS.contains(&w.as_str()) && w != "in" => return,
                _ => {}
            }
            self.next();
        }
    }

    fn device_parameter(&mut self, doc: Vec<String>) -> Option<ast::DeviceParameter> {
        let name = self.expect_name("the parameter")?;
        self.expect_sign(":", "before the type")?;
        let ty = self.parse_type()?;
        let mut elements = Vec::new();
        if self.maybe_word("of") {
            elements.push(self.text("what the first element is")?.value);
            while self.maybe_sign(",") {
                elements.push(self.text("what the next element is")?.value);
            }
        }
        let default = match self.maybe_sign(":=") {
            true => Some(self.parse_expr()),
            false => None,
        };
        Some(ast::DeviceParameter { doc, name, ty, elements, default })
    }

    fn text(&mut self, what: &str) -> Option<Spanned<String>> {
        let span = self.span();
        let Token::Text(value) = self.peek().clone() else {
            let found = self.found();
            self.error("E0205", format!("{what} is missing before {found}"), "write a text in quotes");
            return None;
        };
        self.next();
        Some(Spanned { value, span })
    }

    fn part(&mut self) -> Option<ast::Part> {
        let name = self.expect_name("the part")?;
        self.expect_sign("=", "before what the part is")?;
        let kind = self.expect_name("the primitive or assembly")?;
        let is_wrong = self.at_sign("(") || self.at_sign("[");
        if is_wrong {
            let found = self.found();
            self.error(
                "E0205",
                format!("the settings of a part begin with `{{`, not with {found}"),
                "write `{ ... }`",
            );
            self.next();
        } else {
            self.expect_sign("{", "before the settings of the part")?;
        }
        let mut settings = Vec::new();
        let ends =
            |parser: &Self| parser.at_sign("}") || (is_wrong && (parser.at_sign(")") || parser.at_sign("]")));
        while !ends(self) && *self.peek() != Token::End {
            let setting = self.expect_name("the setting")?;
            self.expect_sign(":", "before the value of the setting")?;
            settings.push((setting, self.parse_expr()));
            self.no_unit();
            if !self.maybe_sign(";") {
                break;
            }
        }
        if !(is_wrong && (self.maybe_sign(")") || self.maybe_sign("]"))) {
            self.expect_sign("}", "after the settings of the part")?;
        }
        Some(ast::Part { name, kind, settings })
    }

    /// After a value: lengths and speeds are numbers alone.
    fn no_unit(&mut self) {
        if let Token::Word(unit) = self.peek() {
            let message = format!("`{unit}` is not allowed after a value");
            self.error(
                "E0205",
                message,
                "lengths are in m, speeds in m/s, angles in degrees: remove the unit",
            );
            self.skip_to(&[";", "}"]);
        }
    }

    fn unit(&mut self) -> Option<String> {
        match self.maybe_word("unit") {
            true => Some(self.text("the unit")?.value),
            false => Some(String::new()),
        }
    }

    fn port(&mut self, doc: Vec<String>, direction: Direction) -> Option<ast::Port> {
        let name = self.expect_name("the port")?;
        self.expect_sign(":", "before the type")?;
        let ty = self.parse_type()?;
        let unit = self.unit()?;
        let wire = if self.maybe_sign("=") { Some(self.parse_postfix()) } else { None };
        let stop = if self.maybe_word("stop") { Some(self.parse_expr()) } else { None };
        Some(ast::Port { doc, direction, name, ty, unit, wire, stop })
    }

    fn device_command(&mut self, doc: Vec<String>) -> Option<ast::Command> {
        let span = self.span();
        let Token::Int(value) = *self.peek() else {
            let found = self.found();
            self.error(
                "E0205",
                format!("the number of the command is missing before {found}"),
                "write the number of the command for the output `verb`: `command 1 move(goal) = ...`",
            );
            return None;
        };
        self.next();
        let number = Spanned { value, span };
        let name = self.expect_name("the command")?;
        let arguments = self.names_in_parentheses()?;
        self.expect_sign("=", "before what the command does")?;
        let action = self.parse_postfix();
        let ast::ExprKind::Member(part, action) = action.kind else {
            self.error(
                "E0205",
                "a command asks for an action of a part".into(),
                "write the part, a point and the action: `= arm.joints(goal)`",
            );
            return None;
        };
        let given = self.names_in_parentheses()?;
        let then = if self.maybe_word("then") { Some(self.awaits()?) } else { None };
        Some(ast::Command { doc, number, name, arguments, part: *part, action, given, then })
    }

    fn awaits(&mut self) -> Option<ast::Await> {
        let signal = self.parse_postfix();
        self.expect_word("within", "after the signal that is awaited")?;
        let within = self.parse_expr();
        self.expect_word("else", "after the time")?;
        let error = self.parse_expr();
        Some(ast::Await { signal, within, error })
    }

    fn names_in_parentheses(&mut self) -> Option<Vec<ast::Name>> {
        self.expect_sign("(", "before the arguments")?;
        let mut names = Vec::new();
        while !self.at_sign(")") && *self.peek() != Token::End {
            names.push(self.expect_name("the argument")?);
            if !self.maybe_sign(",") {
                break;
            }
        }
        self.expect_sign(")", "after the arguments")?;
        Some(names)
    }

    fn device_constant(&mut self, doc: Vec<String>) -> Option<ast::Constant> {
        let name = self.expect_name("the constant")?;
        self.expect_sign(":", "before the type")?;
        let ty = self.parse_type()?;
        let unit = self.unit()?;
        self.expect_sign("=", "before the value of the constant")?;
        Some(ast::Constant { doc, name, ty, unit, value: self.parse_expr() })
    }

    fn place(&mut self) -> Option<ast::Place> {
        let name = self.expect_name("the place")?;
        let extent = if self.maybe_sign("[") {
            let extent = self.parse_expr();
            self.expect_sign("]", "after the number of places")?;
            Some(extent)
        } else {
            None
        };
        self.expect_sign("=", "before where items change hands")?;
        let mut points = Vec::new();
        loop {
            let point = self.parse_expr();
            points.push((point, self.text("what the place is called")?));
            if !self.maybe_sign(",") {
                break;
            }
        }
        let toward = if self.maybe_word("toward") { Some(self.parse_expr()) } else { None };
        Some(ast::Place { name, extent, toward, points })
    }
}
