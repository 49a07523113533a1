//! Random scenes that a cheaper model may stand for, always the same for a seed.

use slipzone::engine::Solution;
use slipzone::scene::Asked;

/// Numbers between 0 and 1, reproducible (splitmix64: G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014).
pub(crate) struct Dice(pub(crate) u64);

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

    pub(crate) fn log(&mut self, least: f64, most: f64) -> f64 {
        self.between(least.ln(), most.ln()).exp()
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few
    pub(crate) fn one_of<T: Copy>(&mut self, of: &[T]) -> T {
        of[(self.roll() * of.len() as f64) as usize % of.len()]
    }
}

/// A grading of a layer of that thickness that departs from 1 by a share.
fn grading(dice: &mut Dice, h: f64, share: f64) -> String {
    let end = (share * dice.one_of(&[1.0, -1.0])).exp();
    match dice.one_of(&[0, 1, 2, 3, 4, 5, 6, 7]) {
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
            "type = \"sigmoid\", above = 1.0, below = {end:?}, centre = {:?}, width = {:?}",
            dice.between(0.2, 0.8) * h,
            dice.between(0.05, 0.4) * h
        ),
        5 => format!(
            "type = \"formula\", modulus = \"exp(a*(abs(y/h - 0.4) - 0.4))\", parameters = {{ a = {:?} }}",
            end.ln()
        ),
        6 => {
            let rows: Vec<String> = (0..6)
                .map(|i| f64::from(i) / 5.0)
                .map(|y| format!("[{:?}, {:?}]", y * h, (end.ln() * if y > 0.0 { dice.roll() } else { 0.0 }).exp()))
                .collect();
            format!("type = \"table\", points = [{}]", rows.join(", "))
        }
        _ => format!(
            "type = \"formula\", modulus = \"1 + a*(y/h)^2\", poisson = \"p + (0.25 - p)*s*y/h\", \
             parameters = {{ a = {:?}, p = {:?}, s = {:?} }}",
            end - 1.0,
            dice.between(0.0, 0.45),
            share.min(1.0)
        ),
    }
}

/// Share of the scenes of contacts wider than their layers are thick.
const WIDE: f64 = 0.1;

/// A scene of a contact of about unit half-width, its `[solver]` and `[output]` left out.
pub(crate) fn scene(dice: &mut Dice) -> String {
    let is_wide = dice.roll() < WIDE;
    let h = if is_wide { dice.log(0.03, 0.2) } else { dice.log(4.0, 3e4) };
    let share = dice.log(1e-4, 3.0);
    let nu = dice.between(0.0, 0.48);
    let base = match if is_wide { dice.one_of(&[0, 2]) } else { dice.one_of(&[0, 1, 2, 3, 4]) } {
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
    let punch = match if is_wide { dice.one_of(&[1, 3, 5]) } else { dice.one_of(&[0, 0, 0, 1, 1, 2, 3, 4, 5]) } {
        0 => "type = \"flat\"\nhalf_width = 1.0".into(),
        1 => "type = \"cylinder\"\nradius = 1.0".into(),
        2 => "type = \"wedge\"\nslope = 0.5".into(),
        3 => format!("type = \"power\"\ncoefficient = 0.5\nexponent = {:?}", dice.log(1.2, 64.0)),
        4 => format!("type = \"rounded-flat\"\nhalf_width = {:?}\nradius = 1.0", dice.between(0.05, 0.95)),
        _ => "type = \"polynomial\"\ncoefficients = [0.3, 0.1]".into(),
    };
    let grows = !punch.contains("\"flat\"");
    let load = match (grows, is_wide || dice.roll() < 0.5) {
        (true, true) => "half_width = 1.0",
        _ => "force = 1.0",
    };
    // A growing contact with friction takes a hundred times as long.
    let rubs = if is_wide {
        0.0
    } else if grows {
        0.03
    } else {
        0.6
    };
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
pub(crate) const ALL_BUT_DEPTH: &str =
    "quantities = [\"load.force\", \"load.half_width\", \"pressure\", \"edge\", \"stick\"]";

/// Relative differences of the numbers of two solutions, each with what the first says of its error.
pub(crate) fn differences(found: &Solution, exact: &Solution) -> Vec<(&'static str, f64, f64)> {
    let both = |path: &'static str| {
        let (here, exact) = (found.number(path)?, exact.number(path)?);
        let error = if exact == 0.0 { here.abs() } else { (here / exact - 1.0).abs() };
        Some((path, error, *found.error.each.get(path)?))
    };
    Asked::NAMES.into_iter().filter(|name| name.contains('.')).filter_map(both).collect()
}
