//! Identities that tie numbers together which are computed by different routes.

use crate::engine::Solution;
use crate::verify::Case;
use crate::verify::check::{Within, worst};
use crate::verify::contact::{A0, Contact, claimed, layer, number};
use slipzone_api::double_exponential::nodes;
use std::f64::consts::PI;

/// Where integrals over the contact end, in half-widths from the edge: an abscissa nearer has lost its distance.
const END: f64 = 1e-8;

pub(super) fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    for ratio in [0.125, 1.0, 8.0] {
        all.push(equilibrium(ratio));
        all.push(energy(ratio));
        all.push(stiffness(ratio));
        all.push(reciprocity(ratio));
        all.push(coulomb(ratio));
    }
    all.extend([path(), ways_to_load(), frozen()]);
    all
}

/// Abscissae and weights over the contact but for its ends.
fn grid() -> (Vec<f64>, Vec<f64>) {
    let length = 2.0 * (1.0 - END);
    let from_middle = |node: &slipzone_api::double_exponential::Node| {
        if node.from_lower < node.to_upper { node.from_lower - 0.5 * length } else { 0.5 * length - node.to_upper }
    };
    nodes(length, 60).iter().map(|node| (from_middle(node), node.weight)).unzip()
}

/// `int p g dx`, the ends by the edge factor `f`: `p = f/sqrt(1 - x^2)` there.
fn integral(solution: &Solution, weights: &[f64], f: f64, g: impl Fn(f64) -> f64) -> Result<f64, String> {
    let profile = &solution.profile;
    let mut sum = 2.0 * f * (1.0 - END).acos() * g(1.0);
    for ((x, p), w) in profile.x.iter().zip(&profile.pressure).zip(weights) {
        sum += w * p.ok_or_else(|| format!("no pressure at x = {x}"))? * g(*x);
    }
    Ok(sum)
}

const ENDS: &str = "the solver's own tolerance, 1e-10, and 1e-11 of the ends beyond 1 - 1e-8, taken by the edge factor";

/// The pressure carries the force.
fn equilibrium(ratio: f64) -> Case {
    Case::new(format!("equilibrium, mu1/mu3 = {ratio}"), move |sheet| {
        let (x, weights) = grid();
        for (punch, contact) in [("flat", flat(5.0, ratio)), ("cylinder", flat(5.0, ratio).cylinder())] {
            let solution = contact.at(&x).solve()?;
            let f = solution.edge.ratio.unwrap_or(0.0);
            let carried = integral(&solution, &weights, f, |_| 1.0)?;
            let name = format!("mu1/mu3 = {ratio}, {punch}: int p dx = P");
            sheet.relative(&name, carried, number(&solution, "load.force")?, Within::new(1e-9, ENDS), "equilibrium");
        }
        Ok(())
    })
}

fn flat(h: f64, ratio: f64) -> Contact {
    Contact::flat(layer(h, ratio, 0.3))
}

/// Rate of change of `of(b)` with the half-width at `b = 1`, on the layer of thickness 5.
///
/// Two central differences, extrapolated: what is left is `step^4/30` times a fifth derivative of order one, 2e-12
/// here, and the rounding of `of` over the step, 1e-11.
fn rate(of: impl Fn(f64) -> Result<f64, String>) -> Result<f64, String> {
    let step = 3e-3;
    let central = |step: f64| -> Result<f64, String> { Ok((of(1.0 + step)? - of(1.0 - step)?) / (2.0 * step)) };
    Ok((4.0 * central(0.5 * step)? - central(step)?) / 3.0)
}

/// A contact `b` on a layer `h` is a contact 1 on a layer `h/b`.
fn at_width(b: f64, ratio: f64) -> Contact {
    flat(5.0 / b, ratio).to(1e-11)
}

const DIFFERENCE: &str = "differences over 3e-3 of depths known to 1e-11 and better";

/// `dD/db = -pi A0 f^2/b`: the indentation knows nothing of how the edge factor was computed.
fn energy(ratio: f64) -> Case {
    Case::new(format!("energy release, mu1/mu3 = {ratio}"), move |sheet| {
        let rate = rate(|b| number(&at_width(b, ratio).solve()?, "load.indentation"))?;
        let f = number(&at_width(1.0, ratio).solve()?, "edge.ratio")?;
        let name = format!("mu1/mu3 = {ratio}: dD/db = -pi A0 f^2/b");
        let within = Within::new(1e-9, DIFFERENCE);
        sheet.relative(&name, rate, -PI * A0 * f * f, within, "energy release, docs/theory.md section 4");
        Ok(())
    })
}

/// `ddelta/dP` of a cylinder is the depth per force of the flat punch as wide.
fn stiffness(ratio: f64) -> Case {
    Case::new(format!("stiffness, mu1/mu3 = {ratio}"), move |sheet| {
        // Force and depth of radius 1 at half-width b are b^2 times those at half-width 1.
        let scaled =
            |path: &'static str| move |b: f64| Ok(b * b * number(&at_width(b, ratio).cylinder().solve()?, path)?);
        let (depth, force) = (rate(scaled("load.indentation"))?, rate(scaled("load.force"))?);
        let expected = number(&at_width(1.0, ratio).solve()?, "load.indentation")?;
        let name = format!("mu1/mu3 = {ratio}: ddelta/dP of a cylinder is that of the flat punch");
        let within = Within::new(1e-9, DIFFERENCE);
        sheet.relative(&name, depth / force, expected, within, "docs/theory.md section 4");
        Ok(())
    })
}

/// Height of a punch.
type Height = fn(f64) -> f64;

/// `delta = P D + int p_flat g dx`.
fn reciprocity(ratio: f64) -> Case {
    Case::new(format!("reciprocity, mu1/mu3 = {ratio}"), move |sheet| {
        let (x, weights) = grid();
        let flat = flat(2.0, ratio).at(&x).solve()?;
        let f = number(&flat, "edge.ratio")?;
        // Height of a cylinder of radius 1, and of a quartic, whose contacts are solved as they are.
        let punches: [(&str, &str, Height); 2] = [
            ("cylinder", "type = \"cylinder\"\nradius = 1.0", |x| 0.5 * x * x),
            ("power 4", "type = \"power\"\ncoefficient = 0.2\nexponent = 4.0", |x| 0.2 * x.powi(4)),
        ];
        for (name, punch, height) in punches {
            let round = Contact::flat(layer(2.0, ratio, 0.3)).under(punch).solve()?;
            let force = number(&round, "load.force")?;
            let expected = force * number(&flat, "load.indentation")? + integral(&flat, &weights, f, height)?;
            let name = format!("mu1/mu3 = {ratio}, {name}: delta = P D + int p_flat g dx");
            sheet.relative(
                &name,
                number(&round, "load.indentation")?,
                expected,
                Within::new(1e-9, ENDS),
                "reciprocity",
            );
        }
        Ok(())
    })
}

/// `|q| <= eta p` everywhere, `q = eta p` where it slips.
fn coulomb(ratio: f64) -> Case {
    Case::new(format!("Coulomb, mu1/mu3 = {ratio}"), move |sheet| {
        let eta = 0.3;
        let x: Vec<f64> = (1..100).map(|i| 0.01 * f64::from(i)).collect();
        for (punch, contact) in [("flat", flat(5.0, ratio)), ("cylinder", flat(5.0, ratio).cylinder())] {
            let solution = contact.rubbing(eta).at(&x).to(1e-8).solve()?;
            let a = number(&solution, "stick.ratio")?;
            let shear = solution.profile.shear.as_ref().ok_or("there is no shear")?;
            let mut largest = f64::NEG_INFINITY;
            let mut slipping = Vec::new();
            for ((x, q), p) in x.iter().zip(shear).zip(&solution.profile.pressure) {
                let (q, p) = (q.ok_or("no shear")?, p.ok_or("no pressure")?);
                largest = largest.max(q.abs() / (eta * p));
                if *x > a {
                    slipping.push(q / (eta * p) - 1.0);
                }
            }
            let name = |what: &str| format!("mu1/mu3 = {ratio}, {punch}: {what}");
            let why = "the solver's own tolerance, 1e-8, of both tractions, which meet at the stick zone's end";
            sheet.at_most(&name("largest |q|/(eta p)"), largest, 1.0, Within::new(1e-7, why), "Coulomb's law");
            let slips = name(&format!("q = eta p at {} points that slip", slipping.len()));
            sheet.error(
                &slips,
                worst(slipping),
                Within::new(1e-8, "the solver's own tolerance: both tractions are interpolated"),
                "Coulomb's law",
            );
        }
        Ok(())
    })
}

/// The last point of a loading path is the single load, and the contact grows with the force.
fn path() -> Case {
    Case::new("loading path", |sheet| {
        let contact = Contact::flat(layer(5.0, 8.0, 0.3)).cylinder().rubbing(0.3).to(1e-8);
        let curve = contact.clone().loaded("until = { force = 0.5, points = 12 }").solve()?;
        let alone = contact.loaded("force = 0.5").solve()?;
        let path = curve.path.as_ref().ok_or("there is no path")?;
        let last = path.half_width.last().copied().flatten().ok_or("the last load has no half-width")?;
        let within = || Within::new(0.0, "bit for bit");
        let source = "docs/formats.md";
        sheet.relative("path, last point: half-width", last, number(&alone, "load.half_width")?, within(), source);
        for (p, expected) in crate::verify::contact::numbers(&alone) {
            sheet.relative(&format!("path, the result itself: {p}"), number(&curve, p)?, expected, within(), source);
        }
        for (name, of) in [("half-width", Some(&path.half_width)), ("indentation", path.indentation.as_ref())] {
            let of: Vec<f64> = of.ok_or("the path is incomplete")?.iter().flatten().copied().collect();
            // Of 12 loads in equal steps: the contact grows, and less and less.
            let least = of.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
            let complete = if of.len() == 12 { -least } else { f64::NAN };
            let within = Within::new(0.0, "strictly");
            sheet.at_most(
                &format!("path: {name} grows with the force, smallest step, negative"),
                complete,
                0.0,
                within,
                "contact law",
            );
        }
        // P is convex in delta: the contact stiffens as it widens.
        let depth: Vec<f64> = path.indentation.iter().flatten().flatten().copied().collect();
        let bend = depth.windows(3).map(|d| d[2] - 2.0 * d[1] + d[0]).fold(f64::NEG_INFINITY, f64::max);
        sheet.at_most(
            "path: the contact stiffens, largest second difference",
            bend,
            0.0,
            Within::new(0.0, "strictly"),
            "contact law",
        );
        Ok(())
    })
}

/// Force, half-width and indentation of one contact, each given in turn.
fn ways_to_load() -> Case {
    Case::new("three ways to load", |sheet| {
        for ratio in [1.0, 8.0] {
            let contact = flat(5.0, ratio).cylinder();
            let by_width = contact.solve()?;
            for path in ["load.force", "load.indentation"] {
                let key = path.trim_start_matches("load.");
                let other = contact.clone().loaded(format!("{key} = {:?}", number(&by_width, path)?)).solve()?;
                let name = format!("mu1/mu3 = {ratio}: half-width from the {key} that half-width 1 gives");
                let errors = claimed(&by_width, path) + claimed(&other, "load.half_width");
                let within =
                    Within::new((3.0 * errors + 1e-12).min(2e-10), "three times what both claim, and rounding");
                sheet.relative(&name, number(&other, "load.half_width")?, 1.0, within, "the inverse");
            }
            let by_force = flat(5.0, ratio).solve()?;
            let depth = number(&by_force, "load.indentation")?;
            let by_depth = flat(5.0, ratio).loaded(format!("indentation = {depth:?}")).solve()?;
            let name = format!("mu1/mu3 = {ratio}, flat: force from the indentation that force 1 gives");
            let errors = claimed(&by_force, "load.indentation") + claimed(&by_depth, "load.force");
            let within = Within::new(errors, "what both claim");
            sheet.relative(&name, number(&by_depth, "load.force")?, 1.0, within, "the inverse");
        }
        Ok(())
    })
}

/// What is frozen in the stick zone stays while the load goes on.
fn frozen() -> Case {
    Case::new("frozen strain", |sheet| {
        let strain = |b: f64| -> Result<Vec<f64>, String> {
            let x = [0.06, 0.12, 0.2].map(|x| x / b);
            let contact = flat(2.0, 8.0).cylinder().loaded(format!("half_width = {b:?}")).rubbing(0.3).to(1e-8);
            let solution = contact.strained_at(&x).solve()?;
            let strain = solution.profile.strain.ok_or("there is no strain")?;
            strain.into_iter().map(|strain| strain.ok_or_else(|| "a point has slipped".to_owned())).collect()
        };
        let (less, more) = (strain(0.6)?, strain(1.0)?);
        let largest = worst(more.iter().copied());
        let errors = less.iter().zip(&more).map(|(less, more)| (less - more) / largest);
        let why = "two solutions, each to 1e-8 of the tractions, and a principal value that makes a few of them";
        let name = "cylinder, mu1/mu3 = 8: strain left at b = 0.6 and at b = 1, worst of 3 points";
        sheet.error(name, worst(errors), Within::new(3e-7, why), "what sticks does not move");
        Ok(())
    })
}
