//! Contacts on layers that are thin enough to be told in closed form.

use super::Solver;
use crate::engine::assemble;
use crate::engine::solution::{Solution, Status};
use crate::engine::stand_in::{self, thin};
use crate::plan::Plan;
use crate::scene::Model;
use crate::scene::check::bounded;
use slipzone_api::Refusal;

impl Solver {
    /// The contact on a layer that is thin enough to be told in closed form, or that the scene wants to be taken for
    /// one.
    pub(super) fn in_closed_form(&self) -> Option<Solution> {
        let solver = &self.chosen.scene.solver;
        if solver.model == Some(Model::Thin) {
            let refused =
                |refusal: Refusal| Solution::refused(&self.chosen.scene, self.chosen.plan.clone(), refusal.to_string());
            return Some(self.thin().unwrap_or_else(refused));
        }
        let is_open = self.chosen.is_open && solver.model.is_none() && self.stand_in.is_none();
        let serves = || {
            thin::obstacle(&self.problem, self.chosen.scene.path.is_some()).is_none()
                && thin::may_serve(&self.problem, stand_in::SHARE * solver.tolerance.get())
        };
        if !is_open || solver.forbid.contains(&Model::Thin) || !serves() {
            return None;
        }
        self.thin().ok().filter(|solution| solution.status == Status::Converged)
    }

    /// The contact by the model `thin`, which nothing keeps from being asked, see [`thin::obstacle`].
    fn thin(&self) -> Result<Solution, Refusal> {
        let Self { chosen, problem, layer, .. } = self;
        bounded(chosen.scene.load)?;
        let (numbers, errors) = thin::told(problem, layer.response())?;
        let worst = errors.worst().map_or(0.0, |(_, error)| error);
        let judgement = if worst <= chosen.scene.solver.tolerance.get() {
            (Status::Converged, None)
        } else {
            let reason =
                format!("the model `thin` is good to {worst:.0e} here; leave out `solver.model`, or ask for less");
            (Status::NotConverged, Some(reason))
        };
        let reason = format!(
            "thin: each point of the surface sinks by its own pressure alone (Winkler), edges shifted, to within {worst:.0e}; no kernel \
             and no system is needed"
        );
        let plan = Plan {
            model: Model::Thin,
            bound: Some(worst),
            flexibility_evaluations: thin::EVALUATIONS,
            reasons: vec![reason.into()],
            ..chosen.plan.clone()
        };
        assemble::in_closed_form(&chosen.scene, plan, problem, (&numbers, &errors), judgement)
    }
}
