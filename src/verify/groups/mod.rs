//! The checks, one file per group.

mod asymptotes;
mod flexibility;
mod friction;
mod gradings;
mod half_plane;
mod honesty;
mod identities;
mod kernels;
mod limits;
mod methods;
mod paper;
mod punches;
mod tables;

use super::Group;

/// All groups, in the order of the report.
pub(super) const ALL: &[Group] = &[
    Group {
        name: "half-plane",
        about: "pressures and forces on a half-plane against closed forms",
        cases: half_plane::cases,
    },
    Group {
        name: "friction",
        about: "stick zones, shear and frozen strain on a half-plane against closed forms",
        cases: friction::cases,
    },
    Group {
        name: "flexibility",
        about: "surface flexibilities against closed forms, limits, an independent program, and each other",
        cases: flexibility::cases,
    },
    Group {
        name: "kernels",
        about: "contact kernels against an integral of a closed form, and each strategy against another",
        cases: kernels::cases,
    },
    Group {
        name: "methods",
        about: "whole contacts, each quadrature, kernel and flexibility against another",
        cases: methods::cases,
    },
    Group { name: "gradings", about: "gradings that can imitate each other", cases: gradings::cases },
    Group { name: "punches", about: "punches that can imitate each other", cases: punches::cases },
    Group {
        name: "limits",
        about: "vanishing gradients, equal substrates, thick layers and their order, units",
        cases: limits::cases,
    },
    Group {
        name: "asymptotes",
        about: "very small and very large friction, very short and very long waves",
        cases: asymptotes::cases,
    },
    Group {
        name: "identities",
        about: "equilibrium, energy release, reciprocity, Coulomb's limit, loading paths",
        cases: identities::cases,
    },
    Group {
        name: "tables",
        about: "tables of other programs, and whether the claimed errors cover the true ones",
        cases: tables::cases,
    },
    Group { name: "paper", about: "Table 1 of Chen and Chen (2013): converged and as printed", cases: paper::cases },
    Group { name: "honesty", about: "what cannot be right is refused or flagged", cases: honesty::cases },
];
