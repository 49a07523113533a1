//! `cargo test` tries a few inputs, `cargo bolero test study` many.

#[test]
fn study() {
    bolero::check!().for_each(slipzone_fuzz::study);
}
