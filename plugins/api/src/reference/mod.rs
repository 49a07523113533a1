//! Closed forms of the field, tested against themselves before anything is tested against them.
