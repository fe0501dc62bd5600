//! Specifications by choices: those of the generator of the other tests, which the checker accepts.

use arbitrary::{Result, Unstructured};
use autogen_tests::generate::generate;

/// Distinct seeds: a system takes a while to be generated.
const SEEDS: u64 = 4000;

pub fn specification(u: &mut Unstructured) -> Result<String> {
    let seed = u.int_in_range(1..=SEEDS)?;
    Ok(generate(seed, usize::from(u.int_in_range(1..=2_u8)?)).text)
}
