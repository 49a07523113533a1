//! `cargo test` tries a few inputs, `cargo bolero test formula` many.

#[test]
fn formula() {
    bolero::check!().for_each(slipzone_fuzz::formula);
}
