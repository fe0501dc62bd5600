//! libFuzzer on one target, named by the variable AUTOGEN_FUZZ; options and folders are libFuzzer's own.

#![no_main]

use arbitrary::Unstructured;
use autogen_fuzz::{Effort, Target, memory, mutation};
use autogen_tests::generate::Lot;
use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use std::sync::OnceLock;

struct Chosen {
    target: &'static Target,
    words: Vec<String>,
    seeds: Vec<Vec<u8>>,
}

fn chosen() -> &'static Chosen {
    static CHOSEN: OnceLock<Chosen> = OnceLock::new();
    CHOSEN.get_or_init(|| {
        let name = std::env::var("AUTOGEN_FUZZ").expect("AUTOGEN_FUZZ names a target");
        let target = Target::find(&name).unwrap_or_else(|| panic!("there is no target {name}"));
        Chosen { target, words: (target.words)(), seeds: target.seeds() }
    })
}

fuzz_target!(|input: &[u8]| {
    let taken = memory::peak(|| (chosen().target.answer)(input, Effort::Rare));
    assert!(taken <= memory::MOST, "{taken} bytes for {} of input", input.len());
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let chosen = chosen();
    let mut lot = Lot::new(seed.into());
    let made = match lot.below(8) {
        0..3 => return fuzzer_mutate(data, size, max_size),
        3 if lot.one_in(16) => {
            let choices: Vec<u8> = (0..2048).map(|_| lot.below(256) as u8).collect();
            (chosen.target.tree)(&mut Unstructured::new(&choices)).unwrap_or_default().into_bytes()
        }
        _ => {
            let other = lot.pick(&chosen.seeds);
            mutation::mutated(&data[..size], other, &chosen.words, &mut lot)
        }
    };
    let length = made.len().min(max_size);
    data[..length].copy_from_slice(&made[..length]);
    length
});
