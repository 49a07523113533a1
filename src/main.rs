//! The command line program.
fn main() {
    slipzone::link_plugins();
    let text = std::fs::read_to_string(std::env::args().nth(1).unwrap()).unwrap();
    let scene: slipzone::scene::Scene = toml::from_str(&text).unwrap();
    for _ in 0..1 {
        let t = std::time::Instant::now();
        let s = slipzone::engine::solve(&scene);
        let dt = t.elapsed();
        println!("{:?} {:?} {:#?} {:?} {:?} {:#?}", s.load, s.stick, s.error.each, s.status, s.reason, s.plan);
        println!("{dt:?}");
    }
}
