//! The command line program.
fn main() {
    slipzone::link_plugins();
    let text = std::fs::read_to_string(std::env::args().nth(1).unwrap()).unwrap();
    let scene: slipzone::scene::Scene = toml::from_str(&text).unwrap();
    let t = std::time::Instant::now();
    let s = slipzone::engine::solve(&scene);
    let dt = t.elapsed();
    let mut s2 = s.clone();
    s2.profile = Default::default();
    println!(
        "{:#?} {:#?} {:#?} {:#?} {:#?} {:?} {:?} {:#?}",
        s.load, s.pressure, s.edge, s.stick, s.error, s.status, s.reason, s.plan
    );
    println!("{dt:?}");
}
