//! What of a device can be told before there is a machine: values that are the same for all, and expressions that are
//! wrong for any.

use super::evaluate::{Environment, Found, Heights, Values, Wrong};
use super::program::{Program, Setting as Given, Symbol};
use super::{Constant, Form, Parameter};
use crate::diagnostic::Diagnostic;
use crate::spec::ast;
use runtime_sim::frame::Frame;
use runtime_sim::part::{Part, Settings};
use runtime_sim::point::{Axis, Point};
use runtime_sim::value::Value;
use std::cell::Cell;
use std::sync::Arc;

/// Works out settings and parts that are the same for all machines.
pub fn settle(program: &mut Program) {
    let environment = nothing(program);
    let known: Vec<Vec<Option<Value>>> = program
        .parts
        .iter()
        .map(|part| {
            let value = |given: &Given| {
                let setting = part.schema.setting(&given.name.value)?;
                environment.setting(part, setting, given).ok()
            };
            part.settings.iter().map(value).collect()
        })
        .collect();
    for (part, known) in program.parts.iter_mut().zip(known) {
        part.settings.iter_mut().zip(known).for_each(|(given, known)| given.known = known);
        let settled = |given: &Given| {
            let setting = part.schema.setting(&given.name.value)?;
            Some((setting.name, given.known.clone()?))
        };
        let settings: Option<Vec<_>> = part.settings.iter().map(settled).collect();
        let made = settings
            .and_then(|settings| Part::new(&part.name.value, part.schema.name, Settings::new(settings)).ok());
        part.known = made.map(Arc::new);
    }
}

/// The value of an expression in which nothing of a machine stands.
pub fn known(program: &Program, expr: &ast::Expr) -> Result<Found, Wrong> {
    nothing(program).found(0, expr)
}

/// In which nothing of a machine stands.
pub fn nothing(program: &Program) -> Environment<'_> {
    let values = Values::OfMachine;
    let left = Cell::default();
    Environment { program, pose: None, arguments: &[], heights: None, index: None, values, left }
}

/// A scenario may have so many kinds.
const KINDS: usize = 64;

/// Expressions that are wrong whatever the layout says.
pub fn wrong(
    program: &Program,
    parameters: &[Parameter],
    constants: &[(Constant, &ast::Expr)],
) -> Vec<Diagnostic> {
    let arguments: Vec<Value> = parameters.iter().map(|parameter| sample(&parameter.form)).collect();
    let environment = Environment {
        program,
        pose: Some(Frame::new(Point::new(0.5, 0.25, 1.0), 0.0)),
        arguments: &arguments,
        heights: Some(&[Heights { top: 0.1, grasp: 0.1 }; KINDS]),
        index: None,
        values: Values::Sample,
        left: Cell::default(),
    };
    let mut found = wrong_definitions(&environment.with_index(Some(0)));
    for part in &program.parts {
        for given in part.settings.iter().filter(|given| given.known.is_none()) {
            let Some(setting) = part.schema.setting(&given.name.value) else { continue };
            match nothing(program).setting(part, setting, given) {
                // It was worked out, and does not fit.
                Err(diagnostic) if diagnostic.code == "E0704" => found.push(*diagnostic),
                _ => found.extend(environment.setting(part, setting, given).err().map(|wrong| *wrong)),
            }
        }
    }
    for (constant, expr) in constants {
        match environment.value(0, expr) {
            Err(diagnostic) => found.push(*diagnostic),
            Ok(value) if constant.takes(&value) => {}
            Ok(_) => found.push(
                Diagnostic::new(
                    "E0709",
                    expr.span,
                    format!("`{}` has another type than this", constant.name),
                )
                .help("give the constant the type of its value, or correct the value"),
            ),
        }
    }
    for require in &program.requires {
        match environment.value(0, &require.condition) {
            Ok(Value::Truth(_)) => {}
            Ok(_) => found.push(*super::evaluate::wrong(
                require.condition.span,
                "this is not a condition: it is neither true nor false",
            )),
            Err(diagnostic) => found.push(*diagnostic),
        }
        for part in &require.text {
            if let ast::TextPart::Value(expr) = part {
                found.extend(environment.value(0, expr).err().map(|wrong| *wrong));
            }
        }
    }
    for place in &program.places {
        let environment = environment.with_index(place.extent.as_ref().map(|_| 0));
        if let Some(toward) = &place.toward {
            match environment.value(0, toward) {
                Ok(Value::Point(_)) => {}
                Ok(_) => found.push(
                    Diagnostic::new(
                        "E0709",
                        toward.span,
                        "a tool points in a direction: a point from the origin",
                    )
                    .help("write for example `toward point(1, 0, 0)`"),
                ),
                Err(diagnostic) => found.push(*diagnostic),
            }
        }
        for (expr, _) in &place.points {
            match environment.value(0, expr) {
                Ok(Value::Point(_)) => {}
                Ok(Value::List(points)) if points.iter().all(|p| matches!(p, Value::Point(_))) => {}
                Ok(_) => found.push(
                    Diagnostic::new("E0709", expr.span, "items change hands at a point or at points")
                        .help("write a point or a list of points"),
                ),
                Err(diagnostic) => found.push(*diagnostic),
            }
        }
    }
    found
}

/// Definitions that are wrong, whether or not something uses them.
fn wrong_definitions(environment: &Environment) -> Vec<Diagnostic> {
    let scopes = environment.program.scopes.iter().enumerate();
    let defined = scopes.flat_map(|(scope, of)| of.names.values().map(move |symbol| (scope, symbol)));
    let defined = defined.filter_map(|(scope, symbol)| match symbol {
        Symbol::Define(expr) => Some((scope, expr)),
        _ => None,
    });
    let wrong = defined.filter_map(|(scope, expr)| environment.found(scope, expr).err());
    wrong.map(|wrong| *wrong).collect()
}

fn sample(form: &Form) -> Value {
    let point = |x: f64| Value::Point(Point::new(x, 1.0, 0.0));
    match form {
        Form::Axis => Value::Axis(Axis::X),
        Form::Range => Value::List(vec![Value::Number(-3.0), Value::Number(4.0)]),
        Form::Real => Value::Number(1.0),
        Form::Time => Value::Number(1000.0),
        Form::Point => point(1.0),
        Form::Routes => {
            let numbers =
                |all: &[f64]| Value::List(all.iter().map(|number| Value::Number(*number)).collect());
            let nodes = Value::List(vec![point(0.0), point(1.0)]);
            Value::List(vec![nodes, numbers(&[0.0, 1.0, 1.0, 0.0]), numbers(&[1.0, 1.0])])
        }
        Form::Node => Value::Number(0.0),
        Form::Points(elements) => Value::List((0..elements.len()).map(|i| point(i as f64)).collect()),
    }
}
