//! `slipzone schema`: the scene file described for editors.

use super::{Failure, Outcome, print};

pub(super) fn run() -> Result<Outcome, Failure> {
    print::result(&format!("{:#}", crate::scene::schema()))?;
    Ok(Outcome::Done)
}
