//! Whole and real numbers.

use super::super::TrapKind;
use super::super::code::{Function, Real, Trap, Whole};
use super::Runner;
use crate::view::Binary;

pub(super) fn compare<T: PartialOrd>(operator: Binary, left: T, right: T) -> bool {
    match operator {
        Binary::Equal => left == right,
        Binary::Unequal => left != right,
        Binary::Less => left < right,
        Binary::Greater => left > right,
        Binary::LessOrEqual => left <= right,
        Binary::GreaterOrEqual => left >= right,
        _ => unreachable!("the check wants a comparison"),
    }
}

/// Tests for equality may be made with a NaN, comparisons by order not.
pub(super) fn is_invalid_comparison(operator: Binary, left: f64, right: f64) -> bool {
    !matches!(operator, Binary::Equal | Binary::Unequal) && (left.is_nan() || right.is_nan())
}

fn arithmetic(operator: Binary, left: i32, right: i32) -> Result<i32, TrapKind> {
    let result = match operator {
        Binary::Add => left.checked_add(right),
        Binary::Subtract => left.checked_sub(right),
        Binary::Multiply => left.checked_mul(right),
        Binary::Divide | Binary::Modulo if right == 0 => return Err(TrapKind::DivisionByZero),
        // Towards zero; the remainder has the sign of the left side.
        Binary::Divide => left.checked_div(right),
        Binary::Modulo => left.checked_rem(right),
        _ => unreachable!("the check wants arithmetic"),
    };
    result.ok_or(TrapKind::Overflow)
}

fn function(function: Function, x: f64) -> Result<f64, TrapKind> {
    let outside = match function {
        Function::Sqrt => x < 0.0,
        Function::Ln => x <= 0.0,
        Function::Asin | Function::Acos => x.abs() > 1.0,
        _ => false,
    };
    if outside {
        return Err(TrapKind::Domain);
    }
    Ok(match function {
        Function::Abs => x.abs(),
        Function::Sqrt => x.sqrt(),
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
        Function::Atan => x.atan(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
    })
}

impl Runner<'_> {
    pub(super) fn whole(&mut self, whole: &Whole, base: usize) -> Result<i32, Trap> {
        let overflow = |at: &usize| Trap { kind: TrapKind::Overflow, at: *at };
        Ok(match whole {
            Whole::Constant(value) => *value,
            Whole::Load(cell) => self.load_whole(cell, base)?,
            Whole::Minus(operand, at) => self.whole(operand, base)?.checked_neg().ok_or(overflow(at))?,
            Whole::Binary(operator, both, at) => {
                let (left, right) = self.two(both, base)?;
                arithmetic(*operator, left, right).map_err(|kind| Trap { kind, at: *at })?
            }
            Whole::Abs(operand, at) => self.whole(operand, base)?.checked_abs().ok_or(overflow(at))?,
            Whole::Min(both) => {
                let (left, right) = self.two(both, base)?;
                left.min(right)
            }
            Whole::Max(both) => {
                let (left, right) = self.two(both, base)?;
                left.max(right)
            }
            Whole::Limit(parts) => {
                let low = self.whole(&parts.0, base)?;
                let value = self.whole(&parts.1, base)?;
                value.max(low).min(self.whole(&parts.2, base)?)
            }
            Whole::Select(parts) => {
                let gate = self.truth(&parts.0, base)?;
                let (zero, one) = (self.whole(&parts.1, base)?, self.whole(&parts.2, base)?);
                if gate { one } else { zero }
            }
            Whole::Trunc(operand, at) => {
                let value = self.real(operand, base)?.trunc();
                if !(f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&value) {
                    return Err(overflow(at));
                }
                value as i32
            }
            Whole::Within(operand, (low, high), at) => {
                let value = self.whole(operand, base)?;
                if !(*low..=*high).contains(&value) {
                    return Err(overflow(at));
                }
                value
            }
            Whole::OfTruth(operand) => i32::from(self.truth(operand, base)?),
            Whole::Call(call) => self.call_function(call, base)? as u32 as i32,
        })
    }

    pub(super) fn real(&mut self, real: &Real, base: usize) -> Result<f64, Trap> {
        Ok(match real {
            Real::Constant(value) => *value,
            Real::Load(cell) => f64::from_bits(self.load(cell, base)?),
            Real::Minus(operand) => -self.real(operand, base)?,
            Real::Binary(operator, both, at) => {
                let (left, right) = (self.real(&both.0, base)?, self.real(&both.1, base)?);
                let result = match operator {
                    Binary::Add => left + right,
                    Binary::Subtract => left - right,
                    Binary::Multiply => left * right,
                    Binary::Divide if right == 0.0 => {
                        return Err(Trap { kind: TrapKind::DivisionByZero, at: *at });
                    }
                    Binary::Divide => left / right,
                    _ => unreachable!("the check wants arithmetic"),
                };
                let is_invalid = result.is_nan() && !left.is_nan() && !right.is_nan();
                self.counters.invalid += u64::from(is_invalid);
                result
            }
            Real::Function(name, operand, at) => {
                let value = self.real(operand, base)?;
                function(*name, value).map_err(|kind| Trap { kind, at: *at })?
            }
            Real::Power(both) => self.real(&both.0, base)?.powf(self.real(&both.1, base)?),
            Real::Min(both) => {
                let (left, right) = (self.real(&both.0, base)?, self.real(&both.1, base)?);
                if right < left { right } else { left }
            }
            Real::Max(both) => {
                let (left, right) = (self.real(&both.0, base)?, self.real(&both.1, base)?);
                if right > left { right } else { left }
            }
            Real::Limit(parts) => {
                let low = self.real(&parts.0, base)?;
                let value = self.real(&parts.1, base)?;
                let high = self.real(&parts.2, base)?;
                let value = if value < low { low } else { value };
                if value > high { high } else { value }
            }
            Real::Select(parts) => {
                let gate = self.truth(&parts.0, base)?;
                let (zero, one) = (self.real(&parts.1, base)?, self.real(&parts.2, base)?);
                if gate { one } else { zero }
            }
            Real::OfWhole(operand) => f64::from(self.whole(operand, base)?),
            Real::Call(call) => f64::from_bits(self.call_function(call, base)?),
        })
    }
}
