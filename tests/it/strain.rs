//! The strain left in the stick zone of a contact that grew under friction.

use crate::sketch::Sketch;
use slipzone::api::reference::goodman_shear::Goodman;
use slipzone::engine::{Solution, Status};
use slipzone::scene;

/// Points of the stick zone and the strain there, `x > 0`.
fn strains(solution: &Solution) -> Vec<(f64, f64)> {
    let profile = &solution.profile;
    let strain = profile.strain.as_ref().expect("asked for");
    profile.x.iter().zip(strain).filter(|(x, _)| **x > 0.0).filter_map(|(x, s)| Some((*x, (*s)?))).collect()
}

const ASKED: &str = "[output]\npoints = 81\nstrain = true";

/// `u' = C|x|`, in closed form.
#[test]
fn a_cylinder_on_a_half_plane_follows_the_closed_form() {
    for (nu, eta) in [(0.3, 0.2374), (0.3, 0.5), (0.2, 0.12)] {
        let solution = Sketch::half_plane(nu).cylinder().rubbing(eta).with(ASKED).solve();
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let beta = (1.0 - 2.0 * nu) / (2.0 - 2.0 * nu);
        let law = Goodman { eta, beta };
        let (a, rate) = (solution.stick.as_ref().unwrap().half_width.unwrap(), law.frozen_strain());
        let strains = strains(&solution);
        assert!(!strains.is_empty() && strains.iter().all(|(x, _)| *x < a), "inside the stick zone alone");
        let worst = strains.iter().map(|(x, s)| (s - rate * x).abs() / (rate * a).abs()).fold(0.0, f64::max);
        println!("nu {nu} eta {eta}: a = {a}, error {worst:.1e} of the strain at a");
        // The scene's tolerance is 1e-8 of the tractions; a principal value makes a few of them.
        assert!(worst < 3e-8, "nu = {nu}, eta = {eta}: {worst:.1e}");
        assert_eq!(solution.profile.strain.as_ref().expect("asked for")[40], Some(0.0), "in the middle");
    }
}

/// What is frozen stays: the strain is the same function of `x` whatever the load that it is seen under.
#[test]
fn it_stays_while_the_load_goes_on() {
    let punches = ["type = \"cylinder\"\nradius = 1.0", "type = \"power\"\nexponent = 3.0\ncoefficient = 0.2"];
    for (h, ratio, punch) in [(5.0, 8.0, 0), (1.0, 8.0, 0), (1.0, 0.125, 0), (1.0, 1.0, 1), (2.0, 8.0, 1)] {
        let at = |b: f64| {
            let x: Vec<f64> = (1..16).map(|i| 0.02 * f64::from(i) / b).collect();
            let text = Sketch::flat(h, ratio, 0.3)
                .cylinder()
                .rubbing(0.3)
                .loaded(&format!("half_width = {b}"))
                .with(&format!("[output]\nx = {x:?}\nstrain = true"))
                .text();
            let scene = scene::parse("frozen.toml", &text.replace(punches[0], punches[punch])).expect("a scene");
            slipzone::engine::solve(&scene)
        };
        slipzone::link_plugins();
        let (less, more) = (at(0.6), at(1.0));
        assert_eq!((less.status, more.status), (Status::Converged, Status::Converged), "{:?}", less.reason);
        // A0 eta p, which the strain is made of.
        let scale = 0.7 * 0.3 * less.pressure.mean.expect("a load");
        let (less, more) = (strains(&less), strains(&more));
        assert!(less.len() > 5 && more.len() >= less.len(), "{} and {} points", less.len(), more.len());
        let apart = less.iter().zip(&more).map(|(l, m)| (l.1 - m.1).abs() / scale).fold(0.0, f64::max);
        println!("h {h} ratio {ratio} {punch}: {apart:.1e} apart; {:?}", less.last());
        // Two solutions, each to the tolerance of 1e-8, and a principal value that makes a few of them.
        assert!(apart < 1e-7, "h = {h}, mu1/mu3 = {ratio}: {apart:.1e} apart");
    }
}

/// Under a face that touched from the start the surface has never slipped within its first stick zone.
#[test]
fn nothing_is_left_where_nothing_slipped() {
    let text = Sketch::flat(5.0, 8.0, 0.3).cylinder().rubbing(0.3).with(ASKED).text();
    let text = text.replace("type = \"cylinder\"", "type = \"rounded-flat\"\nhalf_width = 0.5");
    slipzone::link_plugins();
    let solution = slipzone::engine::solve(&scene::parse("face.toml", &text).expect("a scene"));
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    let strains = strains(&solution);
    let outer = strains.last().expect("a stick zone").1;
    println!("{strains:?}");
    assert!(outer < 0.0 && strains[0].1 == 0.0, "{strains:?}");

    let flat = Sketch::flat(5.0, 8.0, 0.3).rubbing(0.3).with(ASKED).solve();
    let strain = flat.profile.strain.expect("asked for");
    assert!(strain[40] == Some(0.0) && strain[0].is_none() && strain[80].is_none(), "{strain:?}");
    let asked_for_nothing = Sketch::flat(5.0, 8.0, 0.3).rubbing(0.3).solve();
    assert_eq!(asked_for_nothing.profile.strain, None);
    let frictionless = Sketch::flat(5.0, 8.0, 0.3).with(ASKED).solve();
    assert_eq!(frictionless.profile.strain, None);
}
