//! The pairs of parameters, from what is known to break methods of this kind.

use super::{Axis, Map, Subject};

/// Values that run over many decades.
const THICKNESSES: &[f64] = &[1e-3, 1e-2, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 1e2, 1e3, 1e4, 1e6];
/// With friction: a stick zone on a layer a thousandth of the contact takes systems by the thousand.
const RUBBED: &[f64] = &[0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 1e2, 1e3, 1e4, 1e6];
const RATIOS: &[f64] = &[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0, 2.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6];
const FRICTIONS: &[f64] = &[1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 2.0, 5.0, 10.0];
const POISSONS: &[f64] =
    &[-0.99, -0.9, -0.5, -0.2, 0.0, 0.2, 0.3, 0.4, 0.45, 0.49, 0.499, 0.4999, 0.499_999, 0.499_999_999, 0.5];
const GRADIENTS: &[f64] = &[
    -10.0, -3.0, -1.0, -0.1, -1e-2, -1e-4, -1e-6, -1e-8, -1e-10, -1e-12, -1e-14, -1e-16, 1e-16, 1e-14, 1e-12, 1e-10,
    1e-8, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 3.0, 10.0,
];
const WAVES: &[f64] = &[1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 1e2, 3e2, 1e3, 1e4, 1e6];
const UNITS: &[f64] = &[1e-40, 1e-30, 1e-20, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e12, 1e20, 1e30, 1e40];
const EXPONENTS: &[f64] = &[1.0, 1.01, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 10.0, 20.0, 40.0, 64.0];

const THICKNESS: Axis = Axis { name: "thickness h/b", values: THICKNESSES };
const POISSON: Axis = Axis { name: "Poisson's ratio", values: POISSONS };
const FRICTION: Axis = Axis { name: "friction", values: FRICTIONS };
const WAVE: Axis = Axis { name: "wave number s h", values: WAVES };

/// All maps.
pub const ALL: &[Map] = &[
    Map {
        name: "wave-gradient",
        about: "flexibilities as the gradient vanishes, from both sides, and where exponentials overflow",
        x: WAVE,
        y: Axis { name: "gradient gamma h", values: GRADIENTS },
        subject: Subject::Flexibility(|wave, gradient| (wave, layer(1.0, 0.3, gradient.exp()))),
    },
    Map {
        name: "wave-poisson",
        about: "flexibilities of auxetic, incompressible and nearly incompressible layers",
        x: WAVE,
        y: POISSON,
        subject: Subject::Flexibility(|wave, poisson| (wave, layer(1.0, poisson, 8.0))),
    },
    Map {
        name: "thickness-ratio",
        about: "a flat punch without friction on layers from thin to thick, from soft skins to stiff ones",
        x: THICKNESS,
        y: Axis { name: "modulus at the base over that at the surface", values: RATIOS },
        subject: Subject::Contact(|thickness, ratio| flat(&layer(thickness, 0.3, ratio), None)),
    },
    Map {
        name: "thickness-poisson",
        about: "a cylinder of given contact on layers that cannot give way but sideways",
        x: THICKNESS,
        y: POISSON,
        subject: Subject::Contact(|thickness, poisson| {
            contact(&layer(thickness, poisson, 8.0), "type = \"cylinder\"\nradius = 10.0", None, "half_width = 1.0")
        }),
    },
    Map {
        name: "gradient-thickness",
        about: "a flat punch with friction as the gradient vanishes, from both sides",
        x: Axis { name: "gradient gamma h", values: GRADIENTS },
        y: Axis { name: "thickness h/b", values: &[0.3, 1.0, 3.0, 10.0, 100.0] },
        subject: Subject::Contact(|gradient, thickness| flat(&layer(thickness, 0.3, gradient.exp()), Some(0.3))),
    },
    Map {
        name: "thickness-friction",
        about: "a flat punch from almost all slip (a -> 0) to almost all stick (a -> b)",
        x: Axis { values: RUBBED, ..THICKNESS },
        y: FRICTION,
        subject: Subject::Contact(|thickness, friction| flat(&layer(thickness, 0.3, 8.0), Some(friction))),
    },
    Map {
        name: "slip-direction",
        about: "a flat punch with friction where the direction of slip turns: outward on thin layers that are hard to compress",
        x: Axis { name: "thickness h/b", values: &[0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0] },
        y: POISSON,
        subject: Subject::Contact(|thickness, poisson| flat(&layer(thickness, poisson, 1.0), Some(0.3))),
    },
    Map {
        name: "friction-poisson",
        about: "a flat punch with friction as the coupling vanishes with Poisson's ratio",
        x: FRICTION,
        y: POISSON,
        subject: Subject::Contact(|friction, poisson| flat(&layer(5.0, poisson, 8.0), Some(friction))),
    },
    Map {
        name: "shape",
        about: "punches |x|^m under a given force, from a wedge to all but flat",
        x: Axis { name: "exponent m", values: EXPONENTS },
        y: Axis { name: "thickness", values: &[0.1, 0.3, 1.0, 3.0, 10.0, 100.0] },
        subject: Subject::Contact(|exponent, thickness| {
            let punch = format!("type = \"power\"\ncoefficient = 0.1\nexponent = {exponent:?}");
            contact(&layer(thickness, 0.3, 8.0), &punch, None, "force = 0.1")
        }),
    },
    Map {
        name: "units",
        about: "a flat punch with friction in tiny and huge units of length and stress",
        x: Axis { name: "unit of length", values: UNITS },
        y: Axis { name: "unit of stress", values: UNITS },
        subject: Subject::Contact(|length, stress| {
            let layer = format!(
                "thickness = {:e}\npoisson = 0.3\ngrading = {{ type = \"exponential\", surface = {stress:e}, base = {:e} }}",
                5.0 * length,
                8.0 * stress
            );
            let punch = format!("type = \"flat\"\nhalf_width = {length:e}");
            contact(&layer, &punch, Some(0.3), &format!("force = {:e}", length * stress))
        }),
    },
];

/// Lines of `[layer]`: bonded to a rigid base, of modulus 1 at the surface.
fn layer(thickness: f64, poisson: f64, ratio: f64) -> String {
    format!(
        "thickness = {thickness:e}\npoisson = {poisson:?}\ngrading = {{ type = \"exponential\", surface = 1.0, base = {ratio:e} }}"
    )
}

fn flat(layer: &str, friction: Option<f64>) -> String {
    contact(layer, "type = \"flat\"\nhalf_width = 1.0", friction, "force = 1.0")
}

fn contact(layer: &str, punch: &str, friction: Option<f64>, load: &str) -> String {
    let friction = friction
        .map_or_else(String::new, |friction| format!("[friction]\ntype = \"goodman\"\ncoefficient = {friction:?}\n"));
    format!("format = 1\n[layer]\n{layer}\n[punch]\n{punch}\n{friction}[load]\n{load}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_corner_of_every_map_is_a_scene() {
        crate::link_plugins();
        for map in ALL {
            let ends = |axis: Axis| [axis.values[0], axis.values[axis.values.len() - 1]];
            for (x, y) in ends(map.x).into_iter().flat_map(|x| ends(map.y).map(|y| (x, y))) {
                let text = match map.subject {
                    Subject::Contact(scene) => scene(x, y),
                    Subject::Flexibility(layer) => flat(&layer(x, y).1, None),
                };
                let parsed = crate::scene::parse(map.name, &text);
                assert!(parsed.is_ok(), "{}: {:?}", map.name, parsed.err());
            }
            assert!(map.x.values.is_sorted() && map.y.values.is_sorted(), "{}", map.name);
        }
    }
}
