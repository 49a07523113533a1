//! A solution as text, JSON, CSV and SVG. Nothing here computes physics.
