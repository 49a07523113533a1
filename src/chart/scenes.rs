//! The scenes that are charted. They do not change: charts of different versions shall be comparable.

use crate::scene::{Scene, SceneError, parse};

/// A scene of the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Charted {
    /// Its name, unique.
    pub name: &'static str,
    /// What is hard about it.
    pub about: &'static str,
    /// Its file, without `[solver]` and `[output]`.
    pub text: &'static str,
}

impl Charted {
    /// The scene, with more lines at its end.
    pub(super) fn parsed(&self, more: &str) -> Result<Scene, SceneError> {
        parse(self.name, &format!("{}\n{more}", self.text))
    }
}

/// The scene of a file.
macro_rules! charted {
    ($name:literal, $about:literal) => {
        Charted { name: $name, about: $about, text: include_str!(concat!("scenes/", $name, ".toml")) }
    };
}

/// All of them, the easiest first.
pub const ALL: &[Charted] = &[
    charted!("easy", "a flat punch with friction on a layer five half-widths thick, eight times as stiff at its base"),
    charted!("smooth-edge", "a cylinder without friction: the pressure vanishes at an edge that is looked for"),
    charted!("growing", "a cylinder with friction: the stick zone remembers how the contact grew"),
    charted!("kink", "a wedge: the pressure is unbounded in the middle"),
    charted!("strong-gradient", "a base ten thousand times as stiff as the surface"),
    charted!("jump", "a stiff coating on a soft layer: the modulus jumps at a depth"),
    charted!("thin", "a layer a fifth of the half-width thick: the kernel outruns every node"),
    charted!("thick", "a layer a thousand half-widths thick: all but a half-plane"),
    charted!("near-incompressible", "a thin layer of Poisson's ratio 0.4999: it cannot give way but sideways"),
    charted!("tiny-friction", "friction of 0.02: little sticks"),
    charted!("huge-friction", "friction of 1: next to nothing slips"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::{Status, solve};

    #[test]
    fn every_scene_is_solved_by_the_methods_that_the_program_chooses() {
        crate::link_plugins();
        for scene in ALL {
            let solution = solve(&scene.parsed("").expect("a scene"));
            assert_eq!(solution.status, Status::Converged, "{}: {:?}", scene.name, solution.reason);
        }
    }
}
