//! The contact kernels `k(t)`.

use crate::scene::example::least;
use crate::verify::Case;
use crate::verify::check::{Within, worst};
use crate::verify::contact::{Contact, layer, members};
use crate::verify::layers::compliance;
use slipzone_api::reference::homogeneous_layer::bonded;
use slipzone_api::{Component, Elastic, Family, KernelRequest, KernelTable, LayerResponse, Plane};
use std::f64::consts::PI;

/// Distances in units of the thickness, within the reach asked for.
const T: [f64; 8] = [1e-6, 1e-3, 0.05, 0.3, 0.8, 1.0, 1.7, 2.0];

const COMPONENTS: [(Component, &str); 4] = [
    (Component::Depth, "depth"),
    (Component::NormalSlope, "normal slope"),
    (Component::ShearStrain, "shear strain"),
    (Component::Coupling, "coupling"),
];

/// Layers whose kernels several strategies build, lines of `[layer]`.
fn layers() -> [(&'static str, String); 5] {
    [
        ("homogeneous", layer(1.0, 1.0, 0.3)),
        ("mu1/mu3 = 8", layer(1.0, 8.0, 0.3)),
        ("mu1/mu3 = 1/8", layer(1.0, 0.125, 0.45)),
        ("sliding, mu1/mu3 = 3", format!("base = {{ type = \"frictionless\" }}\n{}", layer(1.0, 3.0, 0.2))),
        (
            "stack",
            "poisson = 0.3\ngrading = { type = \"stack\", layers = [\
             { thickness = 0.4, grading = { type = \"homogeneous\", modulus = 1.0 } }, \
             { thickness = 0.6, grading = { type = \"exponential\", surface = 3.0, base = 1.0 } }] }"
                .into(),
        ),
    ]
}

pub(super) fn cases() -> Vec<Case> {
    let mut all = vec![by_quadrature(), jump(), cut_off()];
    for table in ["{ type = \"split\", cutoff = 30.0, terms = 12 }", "{ type = \"split\", cutoff = 50.0, terms = 6 }"] {
        all.push(against(table.into(), 0));
    }
    all.extend(members(Family::Kernel).filter(|info| info.name != "split").map(|info| against(least(info, None), 3)));
    all.push(moments());
    all
}

/// Distances at which two strategies are compared: an odd kernel jumps at the origin and the even one has a logarithm
/// there, which a cut integral smears.
const APART: usize = 2;

/// Each strategy against the one that proves its error.
fn against(table: String, level: u32) -> Case {
    Case::new(format!("split against {table}"), move |sheet| {
        for (name, layer) in layers() {
            let response = compliance(&layer)?;
            let own = tabulate(&*response, "{ type = \"split\" }", 0)?;
            let [other, twin] = [level, level + 1].map(|level| tabulate(&*response, &table, level));
            let (other, twin) = (other?, twin?);
            for (component, what) in COMPONENTS {
                let [own, by, twin] = [&own, &other, &twin].map(|table| values(&**table, component));
                let difference = |a: &[f64], b: &[f64]| worst(a.iter().zip(b).map(|(a, b)| a - b).skip(APART));
                let unit = worst(own.iter().copied()).max(1e-3);
                let (claimed, why) = if other.error().is_some() {
                    (1e-9, "both are proved to 1e-10; beyond t = h/20")
                } else {
                    let own_word = 2.0 * difference(&by, &twin) / unit;
                    (own_word.min(1e-3) + 1e-9, "twice what a twin twice as fine differs by; beyond t = h/20")
                };
                let name = format!("kernel of {what}, {name}: split against {table}");
                sheet.error(&name, difference(&own, &by) / unit, Within::new(claimed, why), "another strategy");
            }
        }
        Ok(())
    })
}

/// The first terms of the kernels against all of them, over what they say that they leave out.
fn moments() -> Case {
    Case::new("moments", |sheet| {
        let response = compliance(&layer(1.0, 1.0, 0.3))?;
        for reach in [0.01, 0.2] {
            let narrow = |table: &str| tabulate_up_to(reach, &*response, table, 0);
            let (own, first) = (narrow("{ type = \"split\" }")?, narrow("{ type = \"moments\" }")?);
            let claimed = first.error().ok_or("moments bound their error")?;
            for (component, what) in COMPONENTS {
                let scale = if component == Component::Depth { 1.0 } else { reach };
                let distances = T.map(|t| 0.5 * reach * t);
                let [own, first] = [&own, &first].map(|table| values_at(&distances, &**table, component));
                let over = own.iter().zip(&first).map(|(own, first)| scale * (own - first) / claimed);
                let name =
                    format!("kernel of {what}, homogeneous: split against moments up to {reach}, over their bound");
                let within = Within::new(0.0, "the next moments, and what sums over 24 wave numbers are good to");
                sheet.at_most(&name, worst(over), 1.0, within, "docs/planner.md");
            }
        }
        Ok(())
    })
}

/// What is left of a Fourier integral that is cut at `S`, the leading term beyond in closed form, is
/// `c_2 int_S^inf sin(st)/s^2 ds` and less: at most `2 |c_2|/(S^2 t)`; one power more in the depth's.
fn cut_off() -> Case {
    Case::new("cut integral", |sheet| {
        for (name, layer) in layers() {
            let response = compliance(&layer)?;
            let depth = response.depth().ok_or("the layer has no depth")?;
            let second = response.tail(2).get(1).copied().unwrap_or_default();
            let own = tabulate(&*response, "{ type = \"split\" }", 0)?;
            let cut = tabulate(&*response, "{ type = \"truncated\", cutoff = 320.0 }", 0)?;
            let cutoff = 320.0 / depth;
            for (component, what) in COMPONENTS {
                let (term, power) = match component {
                    Component::Depth => (second.vv, 3),
                    Component::NormalSlope => (second.vv, 2),
                    Component::ShearStrain => (second.uu, 2),
                    Component::Coupling => (second.uv, 2),
                };
                let [own, cut] = [&own, &cut].map(|table| values(&**table, component));
                let over = own.iter().zip(&cut).zip(T).skip(APART).map(|((own, cut), t)| {
                    // A tenth for all further terms; what both tables are accurate to.
                    (own - cut) / (2.2 * term.abs() / (cutoff.powi(power) * t) + 1e-9)
                });
                let name =
                    format!("kernel of {what}, {name}: split against the integral cut at {cutoff}, over its bound");
                let within = Within::new(0.0, "2.2 |c_2|/(S^2 t), or S^3 in the depth, and 1e-9 of the tables");
                sheet.at_most(&name, worst(over), 1.0, within, "second mean value theorem");
            }
        }
        Ok(())
    })
}

fn tabulate(response: &dyn LayerResponse, table: &str, level: u32) -> Result<Box<dyn KernelTable>, String> {
    tabulate_up_to(2.0, response, table, level)
}

fn tabulate_up_to(
    reach: f64,
    response: &dyn LayerResponse,
    table: &str,
    level: u32,
) -> Result<Box<dyn KernelTable>, String> {
    let scene = Contact::flat(layer(1.0, 1.0, 0.3)).by(Family::Kernel, table).scene()?;
    let strategy = scene.solver.kernel.ok_or("the scene names a kernel")?;
    let components = COMPONENTS.map(|(component, _)| component);
    let request = KernelRequest { reach, components: &components, accuracy: 1e-11 };
    let strategy = if strategy.is_pinned() { strategy } else { strategy.refined(level) };
    strategy.tabulate(response, &request).map_err(|refusal| refusal.to_string())
}

fn values(table: &dyn KernelTable, component: Component) -> Vec<f64> {
    values_at(&T, table, component)
}

fn values_at(distances: &[f64], table: &dyn KernelTable, component: Component) -> Vec<f64> {
    let mut out = vec![0.0; distances.len()];
    table.values_into(component, distances, &mut out);
    out
}

/// The Fourier integral of the homogeneous layer's closed form, by panels of Gauss's rule.
fn by_quadrature() -> Case {
    Case::new("kernels by quadrature", |sheet| {
        let elastic = Elastic::of(Plane::Strain, 0.3);
        let beta = 2.0 / 7.0;
        let rule = bilby::GaussLegendre::new(20).map_err(|error| format!("{error}"))?;
        let table = tabulate(&*compliance(&layer(1.0, 1.0, 0.3))?, "{ type = \"split\" }", 0)?;
        let distances = &T[1..];
        for (component, name) in &COMPONENTS[1..] {
            let exact = distances.iter().map(|&t| {
                // M decays like s^2 exp(-2s): 1e-31 at s = 40.
                (0..80)
                    .map(|i| 0.5 * f64::from(i))
                    .map(|lower| {
                        rule.rule().integrate(lower, lower + 0.5, |s: f64| {
                            let f = bonded(elastic, s);
                            match component {
                                Component::NormalSlope => (f.vv - 1.0) * (s * t).sin(),
                                Component::ShearStrain => (f.uu - 1.0) * (s * t).sin(),
                                _ => (f.uv + beta) * (s * t).cos(),
                            }
                        })
                    })
                    .sum::<f64>()
            });
            let errors: Vec<f64> =
                distances.iter().zip(exact).map(|(&t, exact)| table.parts(*component, t).value(t) - exact).collect();
            let name = format!(
                "kernel of {name}, homogeneous: split against Gauss's rule, worst of {} distances",
                errors.len()
            );
            let within = Within::new(1e-10, "the accuracy asked for, 1e-11, times the reach and a rounding of the sum");
            sheet.error(&name, worst(errors), within, "integral of (kappa sinh 2w - 2w)/D and its like over 80 panels");
        }
        Ok(())
    })
}

/// `k_vv(0+) = (pi/2) c_1`, `c_1` the coefficient of `1/s`: printed with three digits in the theory for one layer.
fn jump() -> Case {
    Case::new("jump of a kernel", |sheet| {
        let response = compliance(&layer(5.0, 8.0, 0.3))?;
        let table = tabulate(&*response, "{ type = \"split\" }", 0)?;
        let parts = table.parts(Component::NormalSlope, 0.0);
        let source = "0.793/b at h = 5 b, mu1/mu3 = 8, docs/theory.md section 3";
        // In units of 1/h.
        let within = Within::new(5e-4 / 0.793, "half a unit of the last digit printed");
        sheet.relative("k_vv(0+) b", parts.sign / 5.0, 0.793, within, source);
        // Order by order from the Riccati equation: c_1 is linear in gamma.
        let slope = response.tail(1).first().copied().unwrap_or_default().vv;
        let within = Within::new(1e-13, "rounding");
        sheet.relative(
            "k_vv(0+) is the transform of c_1/s",
            parts.sign,
            PI / 2.0 * slope,
            within,
            "int sin(st)/s ds = pi/2",
        );
        // The depth's logarithm: G/A0 = -log t + ... whatever the layer.
        let log = table.parts(Component::Depth, 0.0).log;
        sheet.relative("logarithm of the depth's kernel", log, -1.0, Within::new(1e-13, "rounding"), "Flamant: -log t");
        Ok(())
    })
}
