//! Growing contacts under every punch, against closed forms.

use slipzone::api::reference::{Compliance, cylinder, goodman_shear, power, rounded_flat, wedge};
