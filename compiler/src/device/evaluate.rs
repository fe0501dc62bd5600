//! Values of expressions in devices.

use super::operation::{finite, is_finite, joined};
use super::program::{Part, Program, Setting as Given, Symbol};
use super::settle::nothing;
use crate::diagnostic::{Diagnostic, suggestion};
use crate::source::Span;
use crate::spec::ast::{self, ExprKind};
use runtime_sim::frame::Frame;
use runtime_sim::part::{Form, Setting, VERTICAL};
use runtime_sim::point::{Axis, Point};
use runtime_sim::value::Value;
use std::cell::Cell;

/// What an expression may be.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
    Value(Value),
    /// Milliseconds.
    Duration(i64),
    /// Nodes, ends of edges and their speeds.
    Routes(Vec<Value>),
    /// The scope of an assembly.
    Assembly(usize),
}

/// Of a kind of part, over what it lies on, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heights {
    pub top: f64,
    /// Where the tool grips it.
    pub grasp: f64,
}

/// A device for one machine.
pub struct Environment<'a> {
    pub program: &'a Program,
    /// None before there is a machine.
    pub pose: Option<Frame>,
    /// Of each parameter of the device.
    pub arguments: &'a [Value],
    /// Of the kinds, in their order; none before they are known.
    pub heights: Option<&'a [Heights]>,
    /// Behind the name of a place: `index`.
    pub index: Option<usize>,
    pub values: Values,
    /// Expressions that a value may still take.
    pub left: Cell<u32>,
}

/// Whether limits of settings are checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Values {
    OfMachine,
    /// Something of the right type, before there is a machine.
    Sample,
}

const NO_VALUE: &str = "routes are no value: read their nodes, edges and speeds";

type Evaluated = Result<Found, Wrong>;

/// What is wrong with an expression.
pub type Wrong = Box<Diagnostic>;

/// Expressions one in another: definitions may refer to one another.
const DEEPEST: usize = 200;
/// Expressions that one value takes, counted wherever they are used.
const MOST_STEPS: u32 = 20_000;
const TO_ITSELF: &str = "this definition refers to itself";

impl Environment<'_> {
    pub fn with_index(&self, index: Option<usize>) -> Self {
        Self { index, left: Cell::default(), ..*self }
    }

    /// A value in the scope of this number.
    pub fn value(&self, scope: usize, expr: &ast::Expr) -> Result<Value, Wrong> {
        match self.found(scope, expr)? {
            Found::Value(value) => Ok(value),
            Found::Duration(_) => Err(wrong(expr.span, "a time is not allowed here")),
            Found::Routes(_) => Err(wrong(expr.span, NO_VALUE)),
            Found::Assembly(_) => Err(wrong(expr.span, "an assembly is not a value")),
        }
    }

    /// The same where a time may be too.
    pub fn found(&self, scope: usize, expr: &ast::Expr) -> Result<Found, Wrong> {
        self.bounded(expr.span, || self.at(scope, expr, 0))
    }

    /// What a setting of a part is, in the form that the primitive wants.
    pub fn setting(&self, part: &Part, setting: &Setting, given: &Given) -> Result<Value, Wrong> {
        self.bounded(given.value.span, || self.setting_at(part, setting, given, 0))
    }

    fn bounded<T>(&self, place: Span, evaluate: impl FnOnce() -> Result<T, Wrong>) -> Result<T, Wrong> {
        self.left.set(MOST_STEPS);
        let found = evaluate();
        if found.is_err() && self.left.get() == 0 {
            let message = "this takes too long: definitions are used too often in one another";
            return Err(Diagnostic::new("E0710", place, message)
                .note(format!("it takes more than {MOST_STEPS} steps"))
                .help("use fewer definitions in it, or each of them once")
                .into());
        }
        found
    }

    fn setting_at(
        &self,
        part: &Part,
        setting: &Setting,
        given: &Given,
        depth: usize,
    ) -> Result<Value, Wrong> {
        if let Some(known) = &given.known {
            return Ok(known.clone());
        }
        let expr = &given.value;
        if let Some(word) = words(setting.form, expr) {
            return word;
        }
        if let (Form::Times, ExprKind::List(elements)) = (setting.form, &expr.kind) {
            let one = Setting { form: Form::Positive, ..*setting };
            let element = |element: &ast::Expr| {
                let given = Given { name: given.name.clone(), value: element.clone(), known: None };
                self.setting_at(part, &one, &given, depth)
            };
            return elements.iter().map(element).collect::<Result<_, _>>().map(Value::List);
        }
        let found = match self.at(part.scope, expr, depth)? {
            Found::Duration(ms) if setting.unit == "ms" => Value::Number(ms as f64),
            Found::Duration(_) => {
                let unit = if setting.unit.is_empty() { "no time" } else { setting.unit };
                return Err(Diagnostic::new(
                    "E0704",
                    expr.span,
                    format!("`{}` is in {unit}, this is a time", setting.name),
                )
                .help(format!("{}: {}", setting.name, setting.meaning))
                .into());
            }
            Found::Value(Value::Number(_)) if setting.unit == "ms" => {
                return Err(Diagnostic::new("E0704", expr.span, format!("`{}` is a time", setting.name))
                    .help("write the unit after the number, such as `750 ms`")
                    .into());
            }
            Found::Routes(_) => return Err(wrong(expr.span, NO_VALUE)),
            Found::Assembly(_) => return Err(wrong(expr.span, "an assembly is not a value")),
            Found::Value(value) => value,
        };
        match self.fits(setting.form, &found) {
            true => Ok(found),
            false => Err(Diagnostic::new(
                "E0704",
                expr.span,
                format!("`{}` has to be {}", setting.name, described(setting.form)),
            )
            .help(format!("{}: {}", setting.name, setting.meaning))
            .into()),
        }
    }

    /// Before there is a machine: whether what is wrong with these may be right for one. Its steps count here too.
    fn depends_on_machine(&self, scope: usize, of: &[&ast::Expr]) -> bool {
        if self.values != Values::Sample {
            return false;
        }
        let without = nothing(self.program);
        without.left.set(self.left.get());
        let depends = of.iter().any(|expr| without.at(scope, expr, 0).is_err());
        self.left.set(without.left.get());
        depends
    }

    fn fits(&self, form: Form, value: &Value) -> bool {
        let all = |wanted: fn(&Value) -> bool| match value {
            Value::List(values) => values.iter().all(wanted),
            _ => false,
        };
        match (form, value) {
            (Form::Truth, Value::Truth(_))
            | (Form::Number, Value::Number(_))
            | (Form::Point, Value::Point(_))
            | (Form::Frame, Value::Frame(_))
            | (Form::Origin, Value::Point(_) | Value::Frame(_))
            | (Form::Axis | Form::Direction, Value::Axis(_))
            | (Form::Word, Value::Word(_)) => true,
            (Form::Positive | Form::Times, Value::Number(number)) => {
                *number > 0.0 || self.values == Values::Sample
            }
            (Form::Part(primitives), Value::Part { part, .. }) => {
                primitives.contains(&self.program.parts[*part].schema.name)
            }
            (Form::Range, Value::List(ends)) => {
                let is_sample = self.values == Values::Sample;
                matches!(ends[..], [Value::Number(low), Value::Number(high)] if low <= high || is_sample)
            }
            (Form::Points, _) => all(|value| matches!(value, Value::Point(_))),
            (Form::Numbers, _) => all(|value| matches!(value, Value::Number(_))),
            (Form::Words, _) => all(|value| matches!(value, Value::Word(_))),
            _ => false,
        }
    }

    fn at(&self, scope: usize, expr: &ast::Expr, depth: usize) -> Evaluated {
        let left = self.left.get();
        if depth > 2 * DEEPEST || left == 0 {
            return Err(wrong(expr.span, TO_ITSELF));
        }
        self.left.set(left - 1);
        let at = |expr: &ast::Expr| self.at(scope, expr, depth + 1);
        let number = |expr: &ast::Expr| number(at(expr)?, expr.span);
        match &expr.kind {
            ExprKind::Bool(truth) => value(Value::Truth(*truth)),
            ExprKind::Int(int) => value(Value::Number(*int as f64)),
            ExprKind::Real(real) => value(Value::Number(*real)),
            ExprKind::Duration(ms) => Ok(Found::Duration(*ms)),
            ExprKind::Name(name) => self.name(scope, name, expr.span, depth),
            ExprKind::List(elements) => {
                let values: Result<Vec<Value>, _> = elements
                    .iter()
                    .map(|element| match at(element)? {
                        Found::Value(value) => Ok(value),
                        _ => Err(wrong(element.span, "a list holds values")),
                    })
                    .collect();
                value(Value::List(values?))
            }
            ExprKind::Negate(inner) => match at(inner)? {
                Found::Value(Value::Number(number)) => value(Value::Number(-number)),
                _ => Err(wrong(expr.span, "only a number can be negated")),
            },
            ExprKind::Binary(operator, left, right) => {
                let found = match (at(left)?, at(right)?) {
                    (Found::Value(left), Found::Value(right)) => joined(*operator, &left, &right),
                    _ => None,
                };
                let found = found.map(|found| match is_finite(&found) {
                    true => Some(found),
                    false => self.depends_on_machine(scope, &[left, right]).then(|| finite(found)),
                });
                found.flatten().map(Found::Value).ok_or_else(|| {
                    let wrong = *wrong(expr.span, "this operator does not take these values");
                    wrong
                        .note("+ and - are for numbers and points, * and / for two numbers, * also for a frame and a point, a list of points or a frame")
                        .note("a point and a list of points are added element by element; nothing is divided by 0")
                        .into()
                })
            }
            ExprKind::Member(base, member) => self.member(at(base)?, member, depth),
            ExprKind::Index(base, index) => {
                let list = at(base)?;
                let index_value = number(index)?;
                match list {
                    Found::Value(Value::List(values)) => {
                        let element = (index_value.fract() == 0.0 && index_value >= 0.0)
                            .then(|| values.get(index_value as usize))
                            .flatten();
                        let any = || values.first().filter(|_| self.depends_on_machine(scope, &[index]));
                        element.or_else(any).cloned().map(Found::Value).ok_or_else(|| {
                            let wrong = *wrong(index.span, format!("there is no element {index_value}"));
                            wrong.note(format!("the list has {} elements", values.len())).into()
                        })
                    }
                    _ => Err(wrong(base.span, "this is not a list")),
                }
            }
            ExprKind::Call(name, arguments) => {
                let found: Result<Vec<Found>, _> = arguments.iter().map(at).collect();
                call(name, &found?)
            }
            ExprKind::Error => Err(wrong(expr.span, "this could not be read")),
            _ => Err(wrong(expr.span, "this is not allowed in a device")),
        }
    }

    fn name(&self, scope: usize, name: &str, span: Span, depth: usize) -> Evaluated {
        let here = &self.program.scopes[scope];
        match here.names.get(name) {
            Some(Symbol::Parameter(number)) => {
                let argument = self.arguments.get(*number).cloned();
                let argument = argument.ok_or_else(|| unknown(name, span, []))?;
                let is_routes = self.program.routes == Some(*number);
                Ok(match (self.program.times.contains(number), argument) {
                    (true, Value::Number(ms)) => Found::Duration(ms as i64),
                    (_, Value::List(values)) if is_routes => Found::Routes(values),
                    (_, argument) => Found::Value(argument),
                })
            }
            Some(Symbol::Define(expr)) if depth > DEEPEST => Err(wrong(expr.span, TO_ITSELF)),
            Some(Symbol::Define(expr)) => self.at(scope, expr, depth + 1),
            Some(Symbol::Argument(expr)) => self.at(here.parent.unwrap_or(0), expr, depth + 1),
            Some(Symbol::Part(part)) => value(Value::Part { part: *part, frame: 0 }),
            Some(Symbol::Assembly(inner)) => Ok(Found::Assembly(*inner)),
            None => {
                let built_in = match name {
                    "pose" => self.pose.map(|pose| Value::Point(pose.position)),
                    "origin" => self.pose.map(Value::Frame),
                    "kind_heights" => self.of_each_kind(|kind| kind.top),
                    "kind_grasps" => self.of_each_kind(|kind| kind.grasp),
                    "pi" => Some(Value::Number(std::f64::consts::PI)),
                    "index" => self.index.map(|index| Value::Number(index as f64)),
                    _ => None,
                };
                let known = here.names.keys().map(String::as_str);
                built_in.map(Found::Value).ok_or_else(|| unknown(name, span, known))
            }
        }
    }

    fn of_each_kind(&self, height: fn(&Heights) -> f64) -> Option<Value> {
        Some(Value::List(self.heights?.iter().map(|kind| Value::Number(height(kind))).collect()))
    }

    /// A coordinate, a frame or a setting of a part, or what stands in an assembly.
    fn member(&self, base: Found, member: &ast::Name, depth: usize) -> Evaluated {
        match base {
            Found::Value(Value::Point(point)) => match member.value.as_str() {
                "x" => value(Value::Number(point.x)),
                "y" => value(Value::Number(point.y)),
                "z" => value(Value::Number(point.z)),
                _ => Err(wrong(member.span, "a point has x, y and z")),
            },
            Found::Value(Value::Frame(frame)) => match member.value.as_str() {
                "position" => value(Value::Point(frame.position)),
                "yaw" => value(Value::Number(frame.yaw)),
                _ => Err(wrong(member.span, "a frame has position and yaw")),
            },
            Found::Value(Value::Part { part, .. }) => {
                let found = &self.program.parts[part];
                if let Some(frame) = found.schema.frames.iter().position(|frame| *frame == member.value) {
                    return value(Value::Part { part, frame });
                }
                let known = found.schema.setting(&member.value);
                let given = found.settings.iter().find(|given| given.name.value == member.value);
                match (known, given) {
                    (Some(_), Some(given)) if depth > DEEPEST => {
                        Err(wrong(given.value.span, "this setting refers to itself"))
                    }
                    (Some(setting), Some(given)) => {
                        Ok(Found::Value(self.setting_at(found, setting, given, depth + 1)?))
                    }
                    _ => {
                        let names = found.schema.frames.iter().copied();
                        let settings = found.settings.iter().map(|given| given.name.value.as_str());
                        Err(unknown(&member.value, member.span, names.chain(settings)))
                    }
                }
            }
            Found::Routes(values) => {
                let number = ["nodes", "edges", "speeds"].iter().position(|known| *known == member.value);
                let found = number.and_then(|number| values.get(number).cloned());
                found
                    .map(Found::Value)
                    .ok_or_else(|| wrong(member.span, "routes have nodes, edges and speeds"))
            }
            Found::Assembly(scope) => self.name(scope, &member.value, member.span, depth + 1),
            _ => Err(wrong(member.span, "this has no members")),
        }
    }
}

/// A word, a list of words, or an axis of the world, where the setting wants such.
fn words(form: Form, expr: &ast::Expr) -> Option<Result<Value, Wrong>> {
    let word = |expr: &ast::Expr| match &expr.kind {
        ExprKind::Name(name) => Ok(Value::Word(name.clone())),
        _ => {
            let wrong = Diagnostic::new("E0704", expr.span, "a word is expected");
            Err(Wrong::from(wrong.help("write a name, without quotes")))
        }
    };
    match (form, &expr.kind) {
        (Form::Word, _) => Some(word(expr)),
        (Form::Axis | Form::Direction, ExprKind::Name(name)) if name == "x" => Some(Ok(Value::Axis(Axis::X))),
        (Form::Axis | Form::Direction, ExprKind::Name(name)) if name == "y" => Some(Ok(Value::Axis(Axis::Y))),
        (Form::Direction, ExprKind::Name(name)) if name == VERTICAL => Some(Ok(Value::Word(name.clone()))),
        (Form::Words, ExprKind::List(elements)) => {
            Some(elements.iter().map(word).collect::<Result<_, _>>().map(Value::List))
        }
        _ => None,
    }
}

fn described(form: Form) -> String {
    match form {
        Form::Truth => "`true` or `false`".into(),
        Form::Number => "a number".into(),
        Form::Positive => "a number over 0".into(),
        Form::Point => "a point".into(),
        Form::Frame => "a frame".into(),
        Form::Origin => "a point or a frame".into(),
        Form::Axis => "an axis".into(),
        Form::Direction => "an axis: x, y or z".into(),
        Form::Word => "a word".into(),
        Form::Part(primitives) => format!("a part that is a {}", primitives.join(" or a ")),
        Form::Range => "two numbers, the lower one first".into(),
        Form::Points => "a list of points".into(),
        Form::Numbers => "a list of numbers".into(),
        Form::Words => "a list of words".into(),
        Form::Times => "a time over 0, or a list of such".into(),
    }
}

fn value(value: Value) -> Evaluated {
    Ok(Found::Value(value))
}

pub fn wrong(span: Span, message: impl Into<String>) -> Wrong {
    Diagnostic::new("E0710", span, message.into())
        .help("devices are made of numbers, points, axes, lists and parts: see devices.md")
        .into()
}

fn unknown<'a>(name: &str, span: Span, known: impl IntoIterator<Item = &'a str>) -> Wrong {
    let mut known: Vec<&str> = known.into_iter().collect();
    known.sort_unstable();
    let diagnostic = Diagnostic::new("E0710", span, format!("there is no `{name}` here"));
    match suggestion(name, known.iter().copied()) {
        Some(near) => diagnostic.help(format!("is `{near}` meant?")).into(),
        None => diagnostic.help(format!("known are {}", known.join(", "))).into(),
    }
}

fn number(found: Found, span: Span) -> Result<f64, Wrong> {
    match found {
        Found::Value(Value::Number(number)) => Ok(number),
        _ => Err(wrong(span, "a number is expected")),
    }
}

fn call(name: &ast::Name, arguments: &[Found]) -> Evaluated {
    let values: Option<Vec<&Value>> = arguments
        .iter()
        .map(|argument| match argument {
            Found::Value(value) => Some(value),
            _ => None,
        })
        .collect();
    let values = values.unwrap_or_default();
    let found = match (name.value.as_str(), &values[..]) {
        ("point", [Value::Number(x), Value::Number(y), Value::Number(z)]) => {
            Value::Point(Point::new(*x, *y, *z))
        }
        ("frame", [Value::Number(x), Value::Number(y), Value::Number(z), Value::Number(yaw)]) => {
            Value::Frame(Frame::new(Point::new(*x, *y, *z), *yaw))
        }
        ("min", [Value::Number(a), Value::Number(b)]) => Value::Number(a.min(*b)),
        ("max", [Value::Number(a), Value::Number(b)]) => Value::Number(a.max(*b)),
        ("by_axis", [Value::Axis(axis), x, y]) => match axis {
            Axis::X => (*x).clone(),
            Axis::Y => (*y).clone(),
        },
        ("laid", [Value::Axis(axis), Value::Number(along), Value::Number(across), Value::Number(z)]) => {
            Value::Point(match axis {
                Axis::X => Point::new(*along, *across, *z),
                Axis::Y => Point::new(*across, *along, *z),
            })
        }
        (
            "grid",
            [
                Value::Point(first),
                Value::Number(rows),
                Value::Number(row),
                Value::Number(columns),
                Value::Number(column),
            ],
        ) => {
            let count = |number: f64| {
                (number.fract() == 0.0 && (1.0..=64.0).contains(&number)).then_some(number as usize)
            };
            let (Some(rows), Some(columns)) = (count(*rows), count(*columns)) else {
                return Err(wrong(name.span, "a grid has whole numbers of rows and columns, 1 to 64"));
            };
            let slot = |i: usize| {
                let (i, j) = ((i / columns) as f64, (i % columns) as f64);
                Value::Point(Point::new(first.x + row * i, first.y + column * j, first.z))
            };
            Value::List((0..rows * columns).map(slot).collect())
        }
        (known, _) => {
            const FUNCTIONS: [(&str, &str); 7] = [
                ("point", "point(x, y, z)"),
                ("frame", "frame(x, y, z, degrees to the left)"),
                ("min", "min(a, b)"),
                ("max", "max(a, b)"),
                ("by_axis", "by_axis(axis, value for x, value for y)"),
                ("laid", "laid(axis, along the axis, across the axis, z)"),
                (
                    "grid",
                    "grid(first point, rows, distance of rows along x, columns, distance of columns along y)",
                ),
            ];
            let diagnostic =
                Diagnostic::new("E0710", name.span, format!("`{known}` does not take these arguments"));
            return Err(Wrong::from(match FUNCTIONS.iter().find(|(name, _)| *name == known) {
                Some((_, form)) => diagnostic.help(format!("write `{form}`")),
                None => {
                    diagnostic.help(format!("functions are {}", FUNCTIONS.map(|(_, form)| form).join(", ")))
                }
            }));
        }
    };
    value(found)
}
