//! `cargo test` tries a few inputs, `cargo bolero test table` many.

#[test]
fn table() {
    bolero::check!().for_each(slipzone_fuzz::table);
}
