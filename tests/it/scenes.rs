//! Random scenes over the whole scene language, always the same: what must hold of each (docs/random-scenes.md).
//!
//! `cargo run --release --example random_scenes -- 100000 --seed 1` is the long run.

#[allow(dead_code)] // shared with the example, which tells more
#[path = "../../examples/random_scenes/trial/mod.rs"]
mod trial;

use rayon::prelude::*;
use trial::{CHECKS, Tried, draw, shrunk};

const SEED: u64 = 7;
const COUNT: u64 = 2000;
/// How many converge, and how often each check is made and holds, at least: 1,302 and 15 (more friction sticks more) to
/// 92 when this was written.
const CONVERGED: usize = 1200;
const HELD: usize = 10;

#[test]
fn two_thousand_random_scenes_hold() {
    let tried: Vec<Tried> = (0..COUNT).into_par_iter().map(|index| draw(SEED, index).run()).collect();
    if let Some((index, tried)) = (0..COUNT).zip(&tried).find(|(_, tried)| tried.failure.is_some()) {
        let (trial, small) = (draw(SEED, index), shrunk(&draw(SEED, index)));
        panic!(
            "scene {index} of seed {SEED} (cargo run --release --example random_scenes -- 1 --seed {SEED} --only {index}):\n\
             {:?}\n{}\nas small as it gets: {:?}\n{}",
            tried.failure,
            trial.text(),
            small.run().failure,
            small.text()
        );
    }
    // A solver that refuses everything fails nothing.
    let converged = tried.iter().filter(|tried| tried.status == "converged").count();
    println!("{converged} converged");
    assert!(converged >= CONVERGED, "{converged} of {COUNT} scenes converged");
    for (check, ..) in CHECKS {
        let held = tried.iter().filter(|tried| tried.held.contains(&check)).count();
        println!("{check}: {held}");
        assert!(held >= HELD, "`{check}` was made of {held} scenes");
    }
}

/// Every key of a scene, every plugin, every kind and every word of a choice is drawn.
#[test]
fn everything_that_a_scene_may_hold_is_drawn() {
    let drawn: String = (0..COUNT).map(|index| draw(SEED, index).text()).collect();
    for info in slipzone::api::plugins().into_iter().filter(|info| info.krate.starts_with("slipzone-")) {
        assert!(drawn.contains(&format!("type = {:?}", info.name)), "no {} `{}`", info.family.name(), info.name);
        for key in info.parameters {
            assert!(drawn.contains(key.name), "no key `{}` of `{}`", key.name, info.name);
        }
    }
    for key in slipzone::scene::KEYS {
        assert!(drawn.contains(key.name), "no key `{}`", key.name);
        assert_drawn(&drawn, key.values);
    }
}

fn assert_drawn(drawn: &str, values: slipzone::api::Values) {
    use slipzone::api::Values;
    let keys = |keys: &[slipzone::api::Parameter]| {
        for key in keys {
            assert!(drawn.contains(key.name), "no key `{}`", key.name);
            assert_drawn(drawn, key.values);
        }
    };
    match values {
        Values::Table(inner) => keys(inner),
        Values::Choice(kinds) => {
            for kind in kinds {
                assert!(drawn.contains(&format!("type = {:?}", kind.name)), "no `{}`", kind.name);
                keys(kind.parameters);
            }
        }
        Values::OneOf(words) => words.iter().for_each(|word| assert!(drawn.contains(word), "no word `{word}`")),
        Values::List(inner, ..) => assert_drawn(drawn, *inner),
        _ => {}
    }
}
