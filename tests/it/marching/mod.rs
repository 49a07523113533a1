//! Friction under growing contacts by brute force: the loading history in small steps, stick and slip decided cell by
//! cell by Coulomb's law alone.
//!
//! Slow, of few digits, and ignorant of the theorem that makes the program fast (a punch is a stack of flat punches):
//! that is what it is for. It shares the kernels of the layers and nothing else.

mod coulomb;
mod dense;
mod edge;
mod march;
mod pressure;
mod scenes;
mod surface;
mod truth;
mod verdict;
