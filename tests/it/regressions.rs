//! Scenes that once went wrong.

mod budget;
mod kinks;
mod layers;
mod shapes;
mod stick_zones;
mod tractions;

use slipzone::engine::{Solution, Status, solve};

fn within_three_estimates(found: &Solution, exact: &Solution, paths: &[&str]) {
    assert_eq!((found.status, exact.status), (Status::Converged, Status::Converged));
    for path in paths {
        let error = (found.number(path).unwrap() / exact.number(path).unwrap() - 1.0).abs();
        let claimed = 3.0 * (found.error.each[*path] + exact.error.each[*path]);
        assert!(error <= claimed, "{path} is off by {error:e}, three estimates are {claimed:e}");
    }
}

/// A stack of homogeneous plies: thickness, Poisson's ratio and modulus of each.
fn plies(each: &[(f64, f64, f64)]) -> String {
    let ply = |(thickness, poisson, modulus): &(f64, f64, f64)| {
        format!(
            "{{ thickness = {thickness}, poisson = {poisson}, grading = {{ type = \"homogeneous\", modulus = {modulus} }} }}"
        )
    };
    let each: Vec<_> = each.iter().map(ply).collect();
    format!("grading = {{ type = \"stack\", layers = [{}] }}", each.join(", "))
}

/// A scene of its `layer`, `punch` and further tables.
fn written(layer: &str, punch: &str, load: &str, rest: &str) -> Solution {
    let text = format!(
        "format = 1\nlayer = {{ {layer} }}\npunch = {{ {punch} }}\nload = {{ {load} }}\n{rest}\n[output]\nx = [0.5]\n"
    );
    solve(&slipzone::scene::parse(punch, &text).unwrap_or_else(|why| panic!("{why}")))
}
