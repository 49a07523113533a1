//! A layer followed as precisely as is asked.

use crate::layered::Layered;
use crate::precision::{FULL, ROUGH, ROUGHNESS};
use slipzone_api::{Base, Elastic, LayerModel, LayerResponse, Refusal, SurfaceFlexibility};
use std::sync::{Arc, OnceLock};

/// Two responses of one layer, of which the precise one is made when first asked for.
#[derive(Debug)]
pub(crate) struct ByNeed {
    layer: Arc<LayerModel>,
    method: &'static str,
    rough: Layered,
    full: OnceLock<Result<Layered, Refusal>>,
}

impl ByNeed {
    /// Refuses a law that varies too fast.
    pub(crate) fn new(layer: Arc<LayerModel>, method: &'static str) -> Result<Self, Refusal> {
        let rough = Layered::new(Arc::clone(&layer), &ROUGH, method)?;
        Ok(Self { layer, method, rough, full: OnceLock::new() })
    }

    fn full(&self) -> Result<&Layered, Refusal> {
        let full = self.full.get_or_init(|| Layered::new(Arc::clone(&self.layer), &FULL, self.method));
        full.as_ref().map_err(Refusal::clone)
    }
}

impl LayerResponse for ByNeed {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        self.full()?.surface(s)
    }

    fn surface_into(&self, wave_numbers: &[f64], out: &mut [SurfaceFlexibility]) -> Result<(), Refusal> {
        self.full()?.surface_into(wave_numbers, out)
    }

    fn elastic(&self) -> Elastic {
        self.layer.elastic
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        self.full().map_or_else(|_| self.rough.tail(terms), |full| full.tail(terms))
    }

    fn pole(&self) -> f64 {
        if self.layer.base != Base::Frictionless {
            return 0.0;
        }
        self.full().map_or_else(|_| self.rough.pole(), LayerResponse::pole)
    }

    fn against_datum(&self) -> Option<Box<dyn LayerResponse>> {
        self.layer.datum?;
        self.full().ok()?.against_datum()
    }

    /// The same however precisely it is followed: what there is to be seen does not depend on how well one looks.
    fn depth(&self) -> Option<f64> {
        self.rough.depth()
    }

    fn thickness(&self) -> Option<f64> {
        self.rough.thickness()
    }

    fn is_homogeneous(&self) -> bool {
        self.rough.is_homogeneous()
    }

    fn breaks(&self) -> bool {
        self.rough.breaks()
    }

    fn broken_power(&self) -> Option<f64> {
        self.rough.broken_power()
    }

    fn roughly(&self, accuracy: f64) -> Option<&dyn LayerResponse> {
        (accuracy >= ROUGHNESS).then_some(&self.rough as &dyn LayerResponse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{distance, on, substrate};
    use proptest::prelude::*;
    use slipzone_api::{Moduli, ModulusLaw, Plane, Poisson, Solid};
    use std::f64::consts::TAU;

    /// A law of some curvature everywhere, `nu` included: its numbers are between -1 and 1.
    #[derive(Clone, Debug)]
    struct Wavy {
        slope: f64,
        wave: (f64, f64),
        step: (f64, f64),
        poisson: f64,
    }

    impl ModulusLaw for Wavy {
        fn modulus(&self, y: f64) -> f64 {
            let (size, phase) = self.wave;
            let (rise, centre) = self.step;
            (3.0 * self.slope * y + size * (TAU * (y + phase)).sin() + rise * (6.0 * (y - 0.5 - 0.4 * centre)).tanh())
                .exp()
        }

        fn poisson(&self, y: f64) -> Option<f64> {
            Some(0.25 + 0.249 * self.poisson * (3.0 * y).cos())
        }
    }

    fn laws() -> impl Strategy<Value = Wavy> {
        let one = || -1.0..1.0_f64;
        (one(), (one(), one()), (one(), one()), one()).prop_map(|(slope, wave, step, poisson)| Wavy {
            slope,
            wave,
            step,
            poisson,
        })
    }

    fn of(law: &Wavy, base: Base) -> ByNeed {
        let solid = Solid { plane: Plane::Strain, poisson: Poisson::new(0.3).unwrap(), moduli: Moduli::Shear };
        let layer = Arc::new(LayerModel::new(Box::new(law.clone()), solid, Base::Rigid));
        ByNeed::new(on(layer, base), "compliance").unwrap()
    }

    const BASES: usize = 3;

    fn base(which: usize) -> Base {
        [Base::Rigid, Base::Frictionless, substrate(2.0, 0.1)][which]
    }

    proptest! {
        #[test]
        fn what_was_asked_for_is_kept(law in laws(), which in 0..BASES, decade in -3.0..2.5_f64) {
            let response = of(&law, base(which));
            let rough = response.roughly(ROUGHNESS).unwrap();
            // A few together, and by themselves.
            let s: [f64; 6] = std::array::from_fn(|i| 10.0_f64.powf(decade + 0.06 * i as f64));
            let mut together = [SurfaceFlexibility::default(); 6];
            rough.surface_into(&s, &mut together).unwrap();
            for (s, together) in s.into_iter().zip(together) {
                let exact = response.surface(s).unwrap();
                for found in [together, rough.surface(s).unwrap()] {
                    let error = distance(found, exact);
                    prop_assert!(error <= ROUGHNESS, "s = {}: {:e}", s, error);
                }
            }
            let [pole, exact] = [rough.pole(), response.pole()];
            prop_assert!((pole - exact).abs() <= ROUGHNESS * exact, "{} for {}", pole, exact);
        }
    }

    #[test]
    fn who_asked_for_less_before_spoils_nothing() {
        let law = Wavy { slope: 0.7, wave: (0.5, 0.1), step: (0.3, 0.2), poisson: 0.4 };
        let [shared, alone] = [(); 2].map(|()| of(&law, Base::Rigid));
        let s = [0.3, 1.0, 4.0, 30.0];
        let mut rough = [SurfaceFlexibility::default(); 4];
        shared.roughly(1e-6).unwrap().surface_into(&s, &mut rough).unwrap();
        let exact = s.map(|s| alone.surface(s).unwrap());
        for ((s, rough), exact) in s.into_iter().zip(rough).zip(exact) {
            assert_eq!(shared.surface(s).unwrap(), exact);
            assert!(distance(rough, exact) < ROUGHNESS, "s = {s}: {rough:?} for {exact:?}");
        }
        assert!(rough != exact, "{rough:?}");
        assert!(shared.roughly(0.5 * ROUGHNESS).is_none());
    }

    /// How far a law is known to be smooth may be less than all of the layer; there is no break there.
    #[test]
    fn what_is_smooth_has_no_break() {
        let law = Wavy { slope: 0.7, wave: (0.5, 0.1), step: (0.3, 0.2), poisson: 0.4 };
        let response = of(&law, Base::Rigid);
        assert!(response.depth().unwrap() < 1.0 && !response.breaks(), "{:?}", response.depth());
    }
}
