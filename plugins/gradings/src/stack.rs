//! Layers on top of each other.

mod law;

use crate::own_poisson::OwnPoisson;
use crate::thickness;
use law::Law;
use serde::{Deserialize, Serialize};
use slipzone_api::{
    Family, Fault, Files, Grading, ModulusLaw, Parameter, Poisson, Positive, Refusal, Setting, Sublayer, Values,
};

/// Sublayers, each with a grading of its own, bonded to each other. The layer is as thick as all of them.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stack {
    /// The sublayers, top first: 1 to 10000 of them.
    pub layers: Vec<Piece>,
}

/// A sublayer.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Piece {
    /// Thickness in the user's unit.
    pub thickness: Positive,
    /// Poisson's ratio wherever the grading names none; left out, that of the layer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson: Option<Poisson>,
    /// The modulus over the sublayer's own depth: the surface is its top, the base its bottom.
    pub grading: Box<dyn Grading>,
}

slipzone_api::register!(Grading, "stack", "sublayers on top of each other, each with a grading of its own",
    also: ["layers", "layered", "multilayer", "laminate", "piecewise", "plies"],
    example: "type = \"stack\"\nlayers = [\n  { thickness = 0.5, poisson = 0.25, grading = { type = \"homogeneous\", modulus = 2.0 } },\n  \
              { thickness = 1.5, grading = { type = \"exponential\", surface = 1.0, base = 3.0 } },\n]",
    parameters: [
        ("layers", "[{ thickness (length), poisson (left out: the layer's), grading }, ...], top first, 1 to 10000 of them", true, [], List(&Values::Table(SUBLAYER), 1, MOST)),
    ],
    source: "docs/plugins.md");

/// Keys of a sublayer.
const SUBLAYER: &[Parameter] = &[
    Parameter::required("thickness", "that of the sublayer (length)", Values::Positive),
    Parameter::optional(
        "poisson",
        "Poisson's ratio where the grading names none; left out, the layer's",
        Values::Poisson,
    ),
    Parameter::required("grading", "modulus over the sublayer's own depth", Values::Plugin(Family::Grading)),
];

/// The most sublayers.
const MOST: usize = 10_000;

/// Largest relative difference between two thicknesses that are meant to be the same: roundings of decimals.
const SAME: f64 = 1e-9;

#[typetag::serde(name = "stack")]
impl Grading for Stack {
    fn read(&mut self, files: &dyn Files) -> Result<(), Fault> {
        self.count()?;
        for (index, piece) in self.layers.iter_mut().enumerate() {
            let path = |key: &str| vec!["layers".to_owned(), index.to_string(), key.to_owned()];
            piece.grading.read(files).map_err(|mut fault| {
                fault.path.splice(0..0, path("grading"));
                fault
            })?;
            let own = piece.grading.thickness().map_or(piece.thickness.get(), Positive::get);
            if !same(own, piece.thickness.get()) {
                let fault = Fault { path: path("thickness"), ..Fault::default() };
                return Err(Fault { message: "a sublayer thicker or thinner than what is in it".into(), ..fault }
                    .found(format!("{}", piece.thickness.get()))
                    .expected(format!("{own}, the sum of the thicknesses in the stack that it holds")));
            }
        }
        Ok(())
    }

    fn thickness(&self) -> Option<Positive> {
        Positive::new(self.layers.iter().map(|piece| piece.thickness.get()).sum()).ok()
    }

    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        let unusable = |why: String| Refusal::Unusable { plugin: "stack", why };
        self.count().map_err(|fault| unusable(fault.to_string()))?;
        let given = thickness::of(setting, "a stack")?;
        let whole: f64 = self.layers.iter().map(|piece| piece.thickness.get()).sum();
        if !same(whole, given) {
            return Err(unusable(format!("the sublayers are {whole} thick, the layer that they are to fill {given}")));
        }
        let mut sublayers = self.layers.iter().enumerate().map(|(index, piece)| {
            let law = piece.law(setting).map_err(|refusal| match refusal {
                Refusal::Unusable { plugin, why } => {
                    Refusal::Unusable { plugin, why: format!("in sublayer {} from the top: {why}", index + 1) }
                }
                other => other,
            })?;
            Ok(Sublayer { thickness: piece.thickness.get() / whole, law })
        });
        if self.layers.len() == 1
            && let Some(only) = sublayers.next()
        {
            return only.map(|only: Sublayer| only.law);
        }
        Ok(Box::new(Law::new(sublayers.collect::<Result<_, Refusal>>()?)))
    }
}

impl Stack {
    /// That there are neither too few nor too many.
    fn count(&self) -> Result<(), Fault> {
        match self.layers.len() {
            0 => Err(Fault::new(&["layers"], "a stack of nothing").found("no sublayer").expected(
                "at least one, such as { thickness = 1.0, grading = { type = \"homogeneous\", modulus = 1.0 } }",
            )),
            count if count > MOST => Err(Fault::new(&["layers"], "too many sublayers")
                .found(format!("{count}"))
                .expected(format!("at most {MOST}"))
                .hint("a modulus that varies in so many small steps is a `table` or a `formula`")),
            _ => Ok(()),
        }
    }
}

impl Piece {
    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        let law = self.grading.law(&Setting { thickness: Some(self.thickness), ..*setting })?;
        Ok(match self.poisson {
            Some(poisson) => Box::new(OwnPoisson::new(law, poisson)),
            None => law,
        })
    }
}

fn same(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() <= SAME
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
