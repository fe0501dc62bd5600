//! CONFIGURATION: global variables, resources, tasks and programs.

use super::{Reader, children, of_kind};
use crate::parse::span;
use crate::view::{Assignment, Configuration, Resource, Section, Task};
use tree_sitter::Node;

impl Reader<'_> {
    pub(super) fn configuration(&mut self, node: Node) -> Configuration {
        let globals = self.sections(node);
        for variable in globals.iter().filter(|v| v.section != Section::Global) {
            let finding =
                crate::finding::Finding::new("core", variable.span, "a CONFIGURATION has VAR_GLOBAL only");
            self.findings.push(finding);
        }
        Configuration {
            name: self.name_of(node, "name"),
            globals,
            resources: of_kind(node, "resource_declaration").into_iter().map(|n| self.resource(n)).collect(),
            span: span(node),
        }
    }

    fn resource(&mut self, node: Node) -> Resource {
        if !self.sections(node).is_empty() {
            self.outside(node, "variables of a RESOURCE");
        }
        Resource {
            name: self.name_of(node, "name"),
            tasks: of_kind(node, "task_declaration").into_iter().map(|n| self.task(n)).collect(),
            programs: of_kind(node, "program_assignment").into_iter().map(|n| self.program(n)).collect(),
            span: span(node),
        }
    }

    fn task(&mut self, node: Node) -> Task {
        let settings = of_kind(node, "task_parameter");
        let settings =
            settings.into_iter().map(|n| (self.name_of(n, "name"), self.field(n, "value"))).collect();
        Task { name: self.name_of(node, "name"), settings, span: span(node) }
    }

    fn program(&mut self, node: Node) -> Assignment {
        if children(node).iter().any(|n| n.kind() == "argument_list") {
            self.outside(node, "arguments of a PROGRAM");
        }
        Assignment {
            name: self.name_of(node, "name"),
            task: node.child_by_field_name("task").map(|n| self.name(n)),
            program: self.name_of(node, "program_type"),
            span: span(node),
        }
    }
}
