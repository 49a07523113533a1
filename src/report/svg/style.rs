//! How the members of a family are told apart: by colour, by dashes, and by the shape of their marks.

use super::canvas::stroked;
use kuva::render::color::Color;
use kuva::render::render::{PathData, Primitive};

/// A curve's look. No two members of a family share colour and dashes, and neighbours differ in both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    pub(super) color: &'static str,
    /// Lengths of dashes and gaps, px.
    pub(super) dashes: &'static str,
    pub(super) width: f64,
    /// Which of the shapes.
    mark: usize,
    filled: bool,
}

const COLORS: [&str; 6] = ["#1f4e8c", "#b5401c", "#3d7a3d", "#7a4a9c", "#8a6d00", "#222222"];
const DASHES: [&str; 6] = ["none", "9 4", "2.5 3", "10 3 2.5 3", "16 4", "9 3 2 3 2 3"];
/// Of lines across the figure.
const LEVELS: [&str; 3] = ["5 4", "1.5 3", "7 3 1.5 3"];
/// The shape of a mark that says that something contradicts what it marks.
const CROSS: usize = usize::MAX;
/// Radius of a mark, px.
const MARK: f64 = 4.0;

impl Style {
    pub(super) const fn line(color: &'static str, width: f64, dashes: &'static str) -> Self {
        Self { color, dashes, width, mark: 0, filled: false }
    }

    /// Of a member, by its places in the axes of its family, each among so many: of two axes one has the colours, the
    /// other the dashes, where these do for all members.
    pub(super) fn of(member: usize, places: &[(usize, usize)]) -> Self {
        let (color, dashes) = match places {
            [(one, ones), (other, others)] if *ones <= COLORS.len() && *others <= DASHES.len() => (*one, *other),
            // The second round has other dashes with the same colours.
            _ => (member % COLORS.len(), (member + member / COLORS.len() * 3) % DASHES.len()),
        };
        Self { color: COLORS[color], dashes: DASHES[dashes], width: 2.2, mark: member, filled: false }
    }

    /// Of a line across the figure.
    pub(super) fn level(index: usize) -> Self {
        Self::line("#222222", 1.3, LEVELS[index % LEVELS.len()])
    }

    /// Of numbers from elsewhere.
    pub(super) fn points(index: usize) -> Self {
        Self { color: "#222222", dashes: "none", width: 1.4, mark: index, filled: true }
    }

    /// Of what none betters with less.
    pub(super) fn frontier() -> Self {
        Self { color: "#111111", dashes: "none", width: 5.5, mark: 0, filled: true }
    }

    /// The same with marks in its colour.
    pub(super) fn with_filled_marks(self) -> Self {
        Self { filled: true, ..self }
    }

    /// The same with white marks.
    pub(super) fn with_open_marks(self) -> Self {
        Self { filled: false, ..self }
    }

    /// The same with marks that are crosses.
    pub(super) fn crossed(self) -> Self {
        Self { mark: CROSS, ..self }
    }

    /// The same with a line of that width, px.
    pub(super) fn with_width(self, width: f64) -> Self {
        Self { width, ..self }
    }

    /// A mark of the curve at a place on the canvas.
    pub(super) fn mark(&self, x: f64, y: f64) -> Primitive {
        if self.mark == CROSS {
            let place = |(dx, dy): (f64, f64)| format!("{:.2} {:.2}", x + MARK * dx, y + MARK * dy);
            let stroke = |from, to| format!("M{}L{}", place(from), place(to));
            let both = stroke((-1.0, -1.0), (1.0, 1.0)) + &stroke((-1.0, 1.0), (1.0, -1.0));
            return stroked(both, self.color, 1.7);
        }
        let corners: &[(f64, f64)] = match self.mark % 5 {
            0 => {
                let fill = Color::from(if self.filled { self.color } else { "#ffffff" });
                let (stroke, stroke_width) = (Some(Color::from(self.color)), Some(1.5));
                return Primitive::Circle { cx: x, cy: y, r: MARK, fill, fill_opacity: None, stroke, stroke_width };
            }
            1 => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
            2 => &[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)],
            3 => &[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)],
            _ => &[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)],
        };
        let place = |(dx, dy): &(f64, f64)| format!("{:.2} {:.2}", x + MARK * dx, y + MARK * dy);
        let d = format!("M{}Z", corners.iter().map(place).collect::<Vec<_>>().join("L"));
        Primitive::Path(Box::new(PathData {
            d,
            fill: Some(Color::from(if self.filled { self.color } else { "#ffffff" })),
            stroke: Color::from(self.color),
            stroke_width: 1.5,
            opacity: None,
            stroke_dasharray: None,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn no_two_of_twelve_look_the_same() {
        let looks =
            |style: fn(usize) -> Style| (0..12).map(style).map(|s| (s.color, s.dashes)).collect::<BTreeSet<_>>();
        for style in [
            |i| Style::of(i, &[]),
            |i| Style::of(i, &[(i, 12)]),
            |i| Style::of(i, &[(i / 4, 3), (i % 4, 4)]),
            |i| Style::of(i, &[(0, 1), (i, 12)]),
            |i| Style::of(i, &[(i, 12), (0, 1)]),
        ] {
            assert_eq!(looks(style).len(), 12);
        }
    }
}
