//! Constants of SCL as the portable core has them.

use super::token::Token;
use super::wrong;
use crate::finding::Finding;
use std::borrow::Cow;

/// A number or a truth without its type. A real number needs one: without it TIA Portal may take it as one of 32 bits.
/// One for which the core has no literal is a product there.
pub fn literal<'a>(token: Token<'a>) -> Result<Cow<'a, str>, Finding> {
    let text = token.text;
    let is_whole = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    match text.strip_prefix("LREAL#") {
        Some(real) if real.contains('.') => Ok(real_number(real)),
        None if ["TRUE", "FALSE", "-"].contains(&text) || is_whole(text) => Ok(text.into()),
        _ => Err(wrong(token, "no literal of 64 bits, and no name of this block")),
    }
}

fn real_number(text: &str) -> Cow<'_, str> {
    let power = 100.0_f64.exp2();
    let mut rest: f64 = text.parse().unwrap_or_default();
    let mut factors = Vec::new();
    while rest.is_finite() && rest.abs() > 1.0e38 {
        rest /= power;
        factors.push(power);
    }
    while rest != 0.0 && rest.abs() < 1.0e-37 {
        rest *= power;
        factors.push(power.recip());
    }
    if factors.is_empty() {
        return text.into();
    }
    factors.insert(0, rest);
    factors.into_iter().map(with_point).collect::<Vec<_>>().join(" * ").into()
}

fn with_point(value: f64) -> String {
    let text = format!("{value:E}");
    let (digits, power) = text.split_once('E').unwrap_or((&text, "0"));
    let point = if digits.contains('.') { "" } else { ".0" };
    format!("{digits}{point}E{power}")
}
