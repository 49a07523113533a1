//! `cargo test` tries a few inputs, `cargo bolero test scene` many.

#[test]
fn scene() {
    bolero::check!().for_each(slipzone_fuzz::scene);
}
