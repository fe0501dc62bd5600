//! Values of parameters: from the layout, the command line, the type's default, or the device.

use super::role::Line;
use super::setting::{Setting, key_of_device};
use crate::diagnostic::{Diagnostic, MOST, collect, suggestion};
use crate::ir::{Extent, Parameter, ParameterSource, Scalar, Type, Value};
use crate::layout::json::{self, Json};
use std::collections::HashSet;

impl Line<'_> {
    /// Fixes all parameters of all robots; what is wrong is reported and stands as its type's first value.
    pub fn parameters(&mut self, settings: &[Setting]) {
        let of_types: Vec<Vec<Parameter>> =
            self.model.automata.iter().map(|a| a.parameters.clone()).collect();
        for robot in 0..self.robots.len() {
            self.unknown_parameters(robot);
            let parameters = of_types[self.automaton_id(robot).0].iter();
            let values = parameters.map(|p| self.parameter(robot, p, settings)).collect();
            self.values.push(values);
        }
    }

    fn unknown_parameters(&mut self, robot: usize) {
        if self.robots[robot].object.parameters.is_empty() {
            return;
        }
        let known: Vec<String> = (self.automaton(robot).parameters.iter())
            .filter(|p| p.is_settable())
            .map(|p| p.name.clone())
            .collect();
        let all: HashSet<&str> = known.iter().map(String::as_str).collect();
        for (name, _) in &self.robots[robot].object.parameters {
            if !all.contains(name.value.as_str()) && self.diagnostics.len() < MOST {
                let device = &self.automaton(robot).device;
                let is_key = device.parameters.iter().any(|parameter| parameter.name == name.value);
                let help = match suggestion(&name.value, known.iter().map(String::as_str)) {
                    _ if is_key => key_of_device(&name.value, &device.name),
                    Some(near) => format!("is \"{near}\" meant?"),
                    None if known.is_empty() => "its automaton has no parameters: remove it".into(),
                    None => format!("its parameters are {}", known.join(", ")),
                };
                let message =
                    format!("`{}` has no parameter \"{}\"", self.robots[robot].automaton, name.value);
                collect(&mut self.diagnostics, Diagnostic::new("E0501", name.span, message).help(help));
            }
        }
    }

    fn parameter(&mut self, robot: usize, parameter: &Parameter, settings: &[Setting]) -> Vec<Value> {
        let size = self.model.elements(parameter.ty.extent);
        let set = settings
            .iter()
            .rev()
            .find(|s| s.parameter == parameter.name && s.applies_to(self.robots[robot].object));
        let in_layout = self.robots[robot].object.parameters.iter().find(|(n, _)| n.value == parameter.name);
        let json = set.map(|s| s.value.clone()).or_else(|| in_layout.map(|(_, json)| json.clone()));
        match (json, &parameter.source) {
            (_, ParameterSource::Device) => self.constant(robot, parameter),
            (Some(json), _) => self.decode(&json, parameter.ty, &parameter.name),
            (None, ParameterSource::Scenario) => self.ordered(parameter),
            (None, ParameterSource::Layout(Some(value))) => vec![*value; size],
            (None, ParameterSource::Layout(None)) => {
                let object = &self.robots[robot].object;
                collect(
                    &mut self.diagnostics,
                    Diagnostic::new(
                        "E0502",
                        object.name.span,
                        format!(
                            "`{}` does not set the parameter `{}`, which has no default",
                            object.name.value, parameter.name
                        ),
                    )
                    .other(parameter.place, "declared here, without a default")
                    .help(format!("add \"parameters\": {{\"{}\": ...}} to it", parameter.name)),
                );
                vec![first(parameter.ty.scalar); size]
            }
        }
    }

    /// The parts of each kind that all orders of the scenario ask for.
    fn ordered(&mut self, parameter: &Parameter) -> Vec<Value> {
        let Scalar::Int { lo, hi } = parameter.ty.scalar else { return Vec::new() };
        let Some(ordered) = &self.ordered else {
            let message = format!(
                "the orders have no end, but `{}` is the number of parts that they ask for",
                parameter.name
            );
            collect(
                &mut self.diagnostics,
                Diagnostic::new("E0503", parameter.place, message)
                    .other(self.orders_place, "the orders are here")
                    .help("set the parameter, or give the orders a number"),
            );
            return vec![Value::Int(lo); self.kinds.len()];
        };
        let counts: Vec<i32> = ordered.iter().map(|n| i32::try_from(*n).unwrap_or(i32::MAX)).collect();
        let beyond: Vec<String> = (counts.iter().zip(&self.kinds))
            .filter(|(count, _)| !(lo..=hi).contains(*count))
            .map(|(count, (kind, _))| format!("{count} {kind}"))
            .collect();
        if !beyond.is_empty() {
            let beyond = beyond.join(", ");
            let message =
                format!("the orders ask for {beyond}, and `{}` goes from {lo} to {hi}", parameter.name);
            collect(
                &mut self.diagnostics,
                Diagnostic::new("E0503", parameter.place, message)
                    .other(self.orders_place, "the orders are here")
                    .help("widen the bounds of the parameter, or set it"),
            );
        }
        counts.into_iter().map(|count| Value::Int(count.clamp(lo, hi))).collect()
    }

    fn constant(&self, robot: usize, parameter: &Parameter) -> Vec<Value> {
        let constants = &self.robots[robot].placed.device.constants;
        let constant = constants.iter().position(|constant| constant.name == parameter.name);
        let words: &[f64] = constant.map_or(&[], |constant| &self.constants[robot][constant]);
        match parameter.ty.scalar {
            Scalar::Point => words.chunks_exact(3).map(|p| Value::Point([p[0], p[1], p[2]])).collect(),
            Scalar::Bool => words.iter().map(|w| Value::Bool(*w != 0.0)).collect(),
            Scalar::Int { .. } => words.iter().map(|w| Value::Int(*w as i32)).collect(),
            _ => words.iter().map(|w| Value::Real(*w)).collect(),
        }
    }

    fn decode(&mut self, json: &Json, ty: Type, name: &str) -> Vec<Value> {
        let size = self.model.elements(ty.extent);
        let wrong = vec![first(ty.scalar); size];
        match (ty.extent, &json.value) {
            (Extent::One, _) => vec![self.scalar(json, ty.scalar, name)],
            (_, json::Value::List(list)) if list.len() == size => {
                list.iter().map(|element| self.scalar(element, ty.scalar, name)).collect()
            }
            (Extent::By(id), json::Value::Object(members)) => {
                let names = self.model.enums[id.0].members.clone();
                let mut values = wrong.clone();
                for member in members {
                    match names.iter().position(|n| *n == member.key.value) {
                        Some(ordinal) => values[ordinal] = self.scalar(&member.value, ty.scalar, name),
                        None => collect(
                            &mut self.diagnostics,
                            Diagnostic::new(
                                "E0503",
                                member.key.span,
                                format!("there is no \"{}\"", member.key.value),
                            )
                            .help(format!("its elements are {}", names.join(", "))),
                        ),
                    }
                }
                for name_of in names.iter().filter(|n| !members.iter().any(|m| m.key.value == **n)) {
                    collect(
                        &mut self.diagnostics,
                        Diagnostic::new(
                            "E0503",
                            json.span,
                            format!("`{name}` has no value for \"{name_of}\""),
                        )
                        .help("give every element a value"),
                    );
                }
                values
            }
            _ => {
                let shape = match ty.extent {
                    Extent::By(id) => {
                        format!("an object with the keys {}", self.model.enums[id.0].members.join(", "))
                    }
                    _ => format!("a list of {size} values"),
                };
                collect(
                    &mut self.diagnostics,
                    Diagnostic::new("E0503", json.span, format!("`{name}` is an array"))
                        .help(format!("write {shape}")),
                );
                wrong
            }
        }
    }

    fn scalar(&mut self, json: &Json, ty: Scalar, name: &str) -> Value {
        let value = match (ty, &json.value) {
            (Scalar::Bool, json::Value::Bool(b)) => Some(Value::Bool(*b)),
            (Scalar::Real, json::Value::Number(n)) => Some(Value::Real(*n)),
            (Scalar::Int { lo, hi }, json::Value::Number(n))
                if n.fract() == 0.0 && *n >= f64::from(lo) && *n <= f64::from(hi) =>
            {
                Some(Value::Int(*n as i32))
            }
            (Scalar::Time, json::Value::Number(n)) => milliseconds(*n * 1000.0).map(Value::Int),
            (Scalar::Point, json::Value::List(list)) => match list.as_slice() {
                [x, y, z] => {
                    number(x).zip(number(y)).zip(number(z)).map(|((x, y), z)| Value::Point([x, y, z]))
                }
                _ => None,
            },
            (Scalar::Enum(id), json::Value::Text(text)) => {
                self.model.enums[id.0].members.iter().position(|m| m == text).map(|o| Value::Int(o as i32))
            }
            (Scalar::Ref(id), json::Value::Text(text)) => {
                let row = self.members[id.0].iter().position(|m| self.robots[*m].object.name.value == *text);
                row.map(|row| Value::Int(row as i32))
            }
            _ => None,
        };
        value.unwrap_or_else(|| {
            let wanted = match ty {
                Scalar::Bool => "true or false".into(),
                Scalar::Int { lo, hi } => format!("a whole number from {lo} to {hi}"),
                Scalar::Real => "a number".into(),
                Scalar::Time => "a number of seconds, whole in milliseconds".into(),
                Scalar::Point => "a point: a list of three numbers".into(),
                Scalar::Enum(id) => format!("one of {}", self.model.enums[id.0].members.join(", ")),
                Scalar::Ref(id) => {
                    let members =
                        self.members[id.0].iter().map(|m| self.robots[*m].object.name.value.as_str());
                    format!("one of {}", members.collect::<Vec<_>>().join(", "))
                }
            };
            collect(
                &mut self.diagnostics,
                Diagnostic::new("E0503", json.span, format!("this is not a value for `{name}`"))
                    .help(format!("write {wanted}")),
            );
            first(ty)
        })
    }
}

fn number(json: &Json) -> Option<f64> {
    match json.value {
        json::Value::Number(n) => Some(n),
        _ => None,
    }
}

fn milliseconds(value: f64) -> Option<i32> {
    let whole = value.round();
    ((value - whole).abs() < 1e-6 && (0.0..=f64::from(i32::MAX)).contains(&whole)).then_some(whole as i32)
}

fn first(ty: Scalar) -> Value {
    match ty {
        Scalar::Bool => Value::Bool(false),
        Scalar::Int { lo, .. } => Value::Int(lo),
        Scalar::Time | Scalar::Enum(_) | Scalar::Ref(_) => Value::Int(0),
        Scalar::Real => Value::Real(0.0),
        Scalar::Point => Value::Point([0.0; 3]),
    }
}
