//! Kernels octave by octave, in wave number and in distance, of any law whatever at the surface.

mod bands;
mod octave;
mod stretch;

use crate::integrand::Integrand;
use crate::origin::Origin;
use crate::table::Table;
use bands::Bands;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};
use slipzone_api::{KernelRequest, KernelStrategy, KernelTable, LayerResponse, Refusal};

/// The Fourier integral on octaves of wave numbers, for distances octave by octave.
///
/// `k(t) = int_0^inf W(s) w(s/S) sin(st) ds`, and with a cosine for the even kernels, with the window `w(x) = erfc(3 ln
/// x)/2`. At a distance `t` no more of `W` is felt than up to `s = 900/t`, if it is faded out smoothly: `S = 128/t`
/// leaves 1e-14. So the nearer, the more octaves, and each is an interpolant of a few nodes whose transform is exact
/// (spherical Bessel functions). Nothing is asked of the law's derivatives at the surface: a power of the depth that is
/// no whole number makes kernels like `t^(p-1)` at the origin, and these are piecewise polynomials on octaves of `t` as
/// well.
///
/// Nearest to the origin, where the law begins with a known power of the depth below 1, the kernels are series in that
/// power of the distance, which go on where wave numbers end. Else `S` stays what it is there: past it, contacts feel
/// nothing. A density that is as singular as a contact's may be has a spectrum like `1/sqrt(s)`, so that what is left
/// out is `W(S)/S` over the contact's width, and `W(S)` at its edge.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Octaves {}

slipzone_api::register!(Kernel, "octaves", "Fourier integral on octaves of wave numbers, kernels on octaves of distance: any law at the surface",
    example: "type = \"octaves\"",
    parameters: [],
    source: "docs/plugins.md");

#[typetag::serde(name = "octaves")]
impl KernelStrategy for Octaves {
    fn serves(&self, response: &dyn LayerResponse) -> Result<(), Refusal> {
        crate::depth(response).map(|_| ())
    }

    fn tabulate(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Box<dyn KernelTable>, Refusal> {
        let depth = crate::depth(response)?;
        let extent = response.extent().unwrap_or(depth);
        let length = if response.breaks() { depth } else { response.thickness().unwrap_or(depth) };
        let integrands: Vec<Integrand> = request.components.iter().map(|c| Integrand::new(*c, response)).collect();
        let mut in_vain = None;
        if let Some(power) = response.broken_power().filter(|power| *power < 1.0)
            && let Some(stretch) = stretch::of(&integrands, response, (power, length), request.accuracy)?
        {
            let mut bands = Bands::new(&integrands, response, extent, request, Some(stretch.waves()))?;
            bands.evaluations += stretch.tried;
            let faded = bands.faded(stretch.ends.0);
            let transforms_at = |t: f64, out: &mut [Complex64]| faded.at(t, out);
            let origin = Origin::new(&integrands, transforms_at, stretch.ends, power);
            if origin.is_within(request.accuracy) {
                return Ok(told(&integrands, &bands, Some(origin), request, length));
            }
            in_vain = Some((bands, origin));
        }
        let mut bands = Bands::new(&integrands, response, extent, request, None)?;
        if let Some((mut others, origin)) = in_vain {
            if origin.felt() < bands.edge_error {
                others.evaluations += bands.evaluations;
                return Ok(told(&integrands, &others, Some(origin), request, length));
            }
            bands.evaluations += others.evaluations;
        }
        Ok(told(&integrands, &bands, None, request, length))
    }

    fn refined(&self, _level: u32) -> Box<dyn KernelStrategy> {
        Box::new(self.clone())
    }

    fn is_pinned(&self) -> bool {
        false
    }
}

/// The table of what the bands make, and of what is next to the origin.
fn told(
    integrands: &[Integrand],
    bands: &Bands,
    origin: Option<Origin>,
    request: &KernelRequest,
    length: f64,
) -> Box<dyn KernelTable> {
    let (pieces, error) = octave::tabulated(integrands, bands, origin.as_ref(), request);
    let error = error + bands.error + origin.as_ref().map_or(0.0, |origin| origin.error);
    let lengths = (length, pieces.ends.first().copied());
    let table = Table::new(request.components, pieces, request.reach, lengths, error, bands.evaluations)
        .missing_at_edges(origin.as_ref().map_or(bands.edge_error, |origin| origin.edge_error));
    Box::new(match origin {
        Some(origin) => table.beginning_with(origin),
        None => table,
    })
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
