//! `cargo fuzz run table`, as docs/random-scenes.md has it.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| slipzone_fuzz::table(bytes));
