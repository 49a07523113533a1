//! Models that stand for a solid: the answer that the planner gives is within tolerance of the full model's.
//!
//! 60 scenes, always the same, unless `SLIPZONE_PLANNER_SCENES` asks for a number of others. With `--nocapture` a table
//! says how often each model was chosen and what work it saved.

use crate::planner::number;
use rayon::prelude::*;
use slipzone::engine::{Solution, Status, solve};
use slipzone::scene::{Asked, Model, Scene};

/// Numbers between 0 and 1, reproducible (splitmix64: G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.roll()
    }

    fn log(&mut self, least: f64, most: f64) -> f64 {
        self.between(least.ln(), most.ln()).exp()
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few
    fn one_of<T: Copy>(&mut self, of: &[T]) -> T {
        of[(self.roll() * of.len() as f64) as usize % of.len()]
    }
}

/// A grading of a layer of that thickness that departs from 1 by a share.
fn grading(dice: &mut Dice, h: f64, share: f64) -> String {
    let end = (share * dice.one_of(&[1.0, -1.0])).exp();
    match dice.one_of(&[0, 1, 2, 3, 4, 5, 6]) {
        0 => "type = \"homogeneous\", modulus = 1.0".into(),
        1 => format!("type = \"exponential\", surface = 1.0, base = {end:?}"),
        2 => format!("type = \"linear\", surface = 1.0, base = {end:?}"),
        3 => format!(
            "type = \"stack\", layers = [{{ thickness = {:?}, grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}, \
             {{ thickness = {:?}, grading = {{ type = \"homogeneous\", modulus = {end:?} }} }}]",
            0.3 * h,
            0.7 * h
        ),
        4 => format!(
            "type = \"sigmoid\", surface = 1.0, base = {end:?}, centre = {:?}, width = {:?}",
            dice.between(0.2, 0.8) * h,
            dice.between(0.05, 0.4) * h
        ),
        5 => format!(
            "type = \"formula\", modulus = \"1 + a*abs(y/h - 0.4) - 0.4*a\", parameters = {{ a = {:?} }}",
            end - 1.0
        ),
        _ => format!(
            "type = \"formula\", modulus = \"1 + a*(y/h)^2\", poisson = \"p + (0.25 - p)*s*y/h\", \
             parameters = {{ a = {:?}, p = {:?}, s = {:?} }}",
            end - 1.0,
            dice.between(0.0, 0.45),
            share.min(1.0)
        ),
    }
}

/// A scene of a contact of about unit half-width, its `[solver]` and `[output]` left out.
fn scene(dice: &mut Dice) -> String {
    let h = dice.log(4.0, 3e4);
    let share = dice.log(1e-4, 3.0);
    let nu = dice.between(0.0, 0.48);
    let base = match dice.one_of(&[0, 1, 2, 3, 4]) {
        0 | 1 => "{ type = \"rigid\" }".into(),
        2 => "{ type = \"frictionless\" }".into(),
        3 => format!(
            "{{ type = \"half-plane\", shear = {:?}, poisson = {:?} }}",
            dice.log(0.05, 20.0),
            dice.between(0.0, 0.45)
        ),
        _ => String::new(),
    };
    let plane = dice.one_of(&["strain", "strain", "stress"]);
    let layer = if base.is_empty() {
        format!(
            "base = {{ type = \"infinite\" }}\ngrading = {{ type = \"exponential\", surface = 1.0, gradient = {:?} }}",
            share / h
        )
    } else {
        format!("thickness = {h:?}\nbase = {base}\ngrading = {{ {} }}", grading(dice, h, share))
    };
    let (punch, grows) = dice.one_of(&[
        ("type = \"flat\"\nhalf_width = 1.0", false),
        ("type = \"flat\"\nhalf_width = 1.0", false),
        ("type = \"cylinder\"\nradius = 1.0", true),
        ("type = \"cylinder\"\nradius = 1.0", true),
        ("type = \"wedge\"\nslope = 0.5", true),
        ("type = \"power\"\ncoefficient = 0.5\nexponent = 4.0", true),
        ("type = \"rounded-flat\"\nhalf_width = 0.45\nradius = 1.0", true),
    ]);
    let load = match (grows, dice.roll() < 0.5) {
        (true, true) => "half_width = 1.0",
        _ => "force = 1.0",
    };
    // A growing contact with friction takes a hundred times as long.
    let rubs = if grows { 0.15 } else { 0.6 };
    let friction = if dice.roll() < rubs {
        format!("[friction]\ntype = \"goodman\"\ncoefficient = {:?}\n", dice.log(0.05, 0.8))
    } else {
        String::new()
    };
    format!(
        "format = 1\n[layer]\npoisson = {nu:?}\nplane = \"{plane}\"\n{layer}\n[punch]\n{punch}\n{friction}[load]\n{load}\n"
    )
}

/// What a half-plane can give.
const ALL_BUT_DEPTH: &str = "quantities = [\"load.force\", \"load.half_width\", \"pressure\", \"edge\", \"stick\"]";

fn parsed(text: &str) -> Scene {
    slipzone::scene::parse("planned.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// How many scenes, and which.
fn asked(count: usize) -> (usize, u64) {
    let wanted = std::env::var("SLIPZONE_PLANNER_SCENES").ok().and_then(|count| count.parse().ok());
    let seed = std::env::var("SLIPZONE_PLANNER_SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(1);
    println!("seed {seed}");
    (wanted.unwrap_or(count), seed)
}

/// Relative differences of the numbers of two solutions, each with what the first says of its error.
fn differences(found: &Solution, exact: &Solution) -> Vec<(&'static str, f64, f64)> {
    let both = |path: &'static str| {
        let (found_here, exact) = (number(found, path)?, number(exact, path)?);
        let error = if exact == 0.0 { found_here.abs() } else { (found_here / exact - 1.0).abs() };
        Some((path, error, *found.error.each.get(path)?))
    };
    Asked::NAMES.into_iter().filter(|name| name.contains('.')).filter_map(both).collect()
}

/// Every model forced on every scene: its true error against the bound that it states.
#[test]
fn bounds_hold() {
    let (count, seed) = asked(60);
    slipzone::link_plugins();
    let all: Vec<(Model, &str, f64, String)> = (0..count)
        .into_par_iter()
        .flat_map_iter(|i| {
            let mut dice = Dice(seed.wrapping_mul(1_000_003).wrapping_add(i as u64));
            let text = scene(&mut dice);
            let mut found = Vec::new();
            for model in [Model::HalfPlane, Model::Homogeneous] {
                let output = if model == Model::HalfPlane { ALL_BUT_DEPTH } else { "points = 2" };
                let end = |solver: &str| format!("{text}[solver]\ntolerance = 1e-8\n{solver}\n[output]\n{output}\n");
                let forced = solve(&parsed(&end(&format!("model = \"{}\"", model.name()))));
                if forced.status == Status::Refused {
                    continue;
                }
                let full = solve(&parsed(&end("model = \"full\"")));
                if full.status != Status::Converged {
                    continue;
                }
                for (path, error, stated) in differences(&forced, &full) {
                    if stated < 1.0 && error > 1e-7 {
                        found.push((model, path, error / stated, text.clone()));
                    }
                }
            }
            found
        })
        .collect();
    for model in [Model::HalfPlane, Model::Homogeneous] {
        for path in Asked::NAMES {
            let of: Vec<_> = all.iter().filter(|one| one.0 == model && one.1 == path).collect();
            if let Some(worst) = of.iter().max_by(|one, other| one.2.total_cmp(&other.2)) {
                println!(
                    "{:12} {path:22} {:5} scenes, error over bound at most {:.3}",
                    model.name(),
                    of.len(),
                    worst.2
                );
                if std::env::var("SLIPZONE_PLANNER_WORST").is_ok() {
                    println!("{}", worst.3);
                }
            }
        }
    }
    let broken = all.iter().find(|one| one.2 > 1.0);
    assert!(broken.is_none(), "{broken:?}");
}
