//! The keys of a scene, described: what editors and new scenes are told. A new key is one line here.

use super::{Asked, LoadPath};
use slipzone_api::{Family, Kind, Parameter, Values};
use std::ops::RangeInclusive;

/// Coulomb's coefficient, at most.
pub(super) const MOST_FRICTION: f64 = 1e3;

/// What may be asked of the solver.
pub(super) const TOLERANCES: RangeInclusive<f64> = 1e-14..=0.5;

/// How many samples a profile has.
pub(super) const POINTS: RangeInclusive<usize> = 2..=1_000_000;

/// How many samples may be listed.
pub(super) const LISTED: RangeInclusive<usize> = 1..=1_000_000;

/// Where they may be, in half-widths.
pub(super) const ABSCISSAE: RangeInclusive<f64> = -1.0..=1.0;

/// Characters of a label.
pub(super) const LONGEST_LABEL: usize = 200;

/// Every key of a scene, in the order in which scenes are written. What a plugin may hold is in the registry.
pub const KEYS: &[Parameter] = &[
    Parameter::required("format", "version of this file's format", Values::Whole(1, 1)),
    Parameter::optional("title", "one line that names the scene in reports and figures", LABEL),
    Parameter::required("layer", "the elastic solid", Values::Table(LAYER)),
    Parameter::required("punch", "the rigid punch", Values::Plugin(Family::Punch)),
    Parameter::optional("friction", "friction law; left out: frictionless", Values::Choice(FRICTIONS)),
    Parameter::required("load", "how hard the punch is pressed", Values::Table(LOAD)),
    Parameter::optional(
        "solver",
        "how the scene is solved; what is left out, the solver chooses",
        Values::Table(SOLVER),
    ),
    Parameter::optional("output", "what is written", Values::Table(OUTPUT)),
    Parameter::optional("units", "labels of the units; they change no number", Values::Table(UNITS)),
];

const LAYER: &[Parameter] = &[
    Parameter::optional("thickness", "depth of the base (length); none if the base is infinite", Values::Positive),
    Parameter::required(
        "poisson",
        "Poisson's ratio where the grading names none, above -1 and up to 0.5",
        Values::Poisson,
    ),
    Parameter::optional("plane", "plane strain (default) or plane stress", Values::OneOf(&["strain", "stress"])),
    Parameter::optional(
        "moduli",
        "what the grading's moduli are: shear moduli (default) or Young's",
        Values::OneOf(&["shear", "young"]),
    ),
    Parameter::optional("base", "what the layer stands on (default rigid)", Values::Choice(BASES)),
    Parameter::optional("datum", "depth that counts as at rest, where the base fixes none (length)", Values::Positive),
    Parameter::required("grading", "modulus over depth", Values::Plugin(Family::Grading)),
];

const BASES: &[Kind] = &[
    Kind { name: "rigid", summary: "rigid, the layer bonded to it", parameters: &[] },
    Kind { name: "frictionless", summary: "rigid, the layer free to slide on it", parameters: &[] },
    Kind { name: "half-plane", summary: "an elastic half-plane, the layer bonded to it", parameters: SUBSTRATE },
    Kind { name: "infinite", summary: "none: the solid goes on without end", parameters: &[] },
];

const SUBSTRATE: &[Parameter] = &[
    Parameter::required("shear", "its shear modulus (stress)", Values::Positive),
    Parameter::optional("young", "its Young's modulus (stress)", Values::Positive).in_place_of("shear"),
    Parameter::required("poisson", "its Poisson's ratio, above -1 and up to 0.5", Values::Poisson),
];

const FRICTIONS: &[Kind] = &[Kind {
    name: "goodman",
    summary: "Coulomb friction in Goodman's approximation: the shear does not change the pressure",
    parameters: &[
        Parameter::required(
            "coefficient",
            "Coulomb's coefficient (no unit), 1e-100 to 1000",
            Values::UpTo(MOST_FRICTION),
        ),
        Parameter::optional(
            "strain",
            "strain locked in the stick zone: by the loading history (default), or linear, C|x|",
            Values::OneOf(&["history", "linear"]),
        ),
    ],
}];

const LOAD: &[Parameter] = &[
    Parameter::required("force", "force per unit length out of plane (stress times length)", Values::Positive),
    Parameter::optional("half_width", "half-width of a contact that grows (length)", Values::Positive)
        .in_place_of("force"),
    Parameter::optional(
        "indentation",
        "depth of the punch, where the base or a datum defines it (length)",
        Values::Positive,
    )
    .in_place_of("force"),
    Parameter::optional("path", "a loading curve: growing loads of one kind", Values::Table(PATH)).in_place_of("force"),
    Parameter::optional("until", "a loading curve in equal steps up to a load", Values::Table(UNTIL))
        .in_place_of("force"),
];

const LOADS: Values = Values::List(&Values::Positive, *LoadPath::LISTED.start(), *LoadPath::LISTED.end());

const PATH: &[Parameter] = &[
    Parameter::required("force", "forces, each above the one before it (stress times length)", LOADS),
    Parameter::optional("half_width", "half-widths, each above the one before it (length)", LOADS).in_place_of("force"),
    Parameter::optional("indentation", "indentations, each above the one before it (length)", LOADS)
        .in_place_of("force"),
];

/// As many as one of these.
#[allow(clippy::needless_pass_by_value)] // a constant is a value
const fn whole(range: RangeInclusive<usize>) -> Values {
    Values::Whole(*range.start() as u64, *range.end() as u64)
}

const UNTIL: &[Parameter] = &[
    Parameter::required("force", "the last force (stress times length)", Values::Positive),
    Parameter::optional("half_width", "the last half-width (length)", Values::Positive).in_place_of("force"),
    Parameter::optional("indentation", "the last indentation (length)", Values::Positive).in_place_of("force"),
    Parameter::optional("points", "how many loads (default 60)", whole(LoadPath::POINTS)),
];

const SOLVER: &[Parameter] = &[
    Parameter::optional(
        "tolerance",
        "relative error wanted of each number (default 1e-8)",
        Values::Between(*TOLERANCES.start(), *TOLERANCES.end()),
    ),
    Parameter::optional("flexibility", "how the layer's flexibility is computed", Values::Plugin(Family::Flexibility)),
    Parameter::optional("kernel", "how the kernels are computed from it", Values::Plugin(Family::Kernel)),
    Parameter::optional("quadrature", "how the integral equations are discretised", Values::Plugin(Family::Quadrature)),
    Parameter::optional("model", "model to solve, whatever its error: the full solid, or a cheaper one", MODELS),
    Parameter::optional(
        "forbid",
        "models never to be chosen",
        Values::List(&Values::OneOf(&STAND_INS), 0, STAND_INS.len()),
    ),
];

const MODELS: Values = Values::OneOf(&["full", "half-plane", "corrected-half-plane", "homogeneous", "thin"]);

/// The models that may be forbidden: the full one is what is left.
pub(super) const STAND_INS: [&str; 4] = ["half-plane", "corrected-half-plane", "homogeneous", "thin"];

const ABSCISSA: Values = Values::Between(*ABSCISSAE.start(), *ABSCISSAE.end());

const OUTPUT: &[Parameter] = &[
    Parameter::optional(
        "points",
        "samples of pressure and shear, equally spaced over the contact (default 201)",
        whole(POINTS),
    ),
    Parameter::optional(
        "x",
        "the samples themselves, in units of the contact's half-width",
        Values::List(&ABSCISSA, *LISTED.start(), *LISTED.end()),
    )
    .in_place_of("points"),
    Parameter::optional("strain", "also the strain du/dx locked in the stick zone (default false)", Values::Flag),
    Parameter::optional(
        "quantities",
        "groups or numbers of the result that are computed; all when left out",
        Values::List(&Values::OneOf(&Asked::NAMES), 1, Asked::NAMES.len()),
    ),
];

const UNITS: &[Parameter] =
    &[Parameter::optional("length", "unit of length", LABEL), Parameter::optional("stress", "unit of stress", LABEL)];

/// What goes into reports and figures.
const LABEL: Values = Values::Line(LONGEST_LABEL);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Model;

    /// A model that is new is described, too, and may be forbidden.
    #[test]
    fn the_models_described_are_those_there_are() {
        let Values::OneOf(described) = MODELS else { panic!("{MODELS:?}") };
        let sorted = |mut names: Vec<&'static str>| {
            names.sort_unstable();
            names
        };
        assert_eq!(sorted(described.to_vec()), sorted(Model::ALL.map(Model::name).to_vec()));
        assert_eq!(sorted([&STAND_INS[..], &[Model::Full.name()]].concat()), sorted(described.to_vec()));
    }
}
