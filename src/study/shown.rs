//! The names in a figure's description, found among the axes of its study and the numbers of a result.

mod fault;
mod marks;
mod only;

use super::axis::{Axis, Values};
use super::plot::{OneOrMore, Over, Plot, PlotKind};
use super::{Cell, Study};
use crate::scene::{Asked, overlap};
#[cfg(feature = "plot")]
pub(crate) use fault::in_one_line;
use fault::{missing, wrong};
use marks::{file_name, marks};
use slipzone_api::{Fault, nearest};

/// The largest of the errors, which a figure may show like the numbers.
const ERROR: &str = "error.estimate";

/// Numbers that a figure may show, by their paths in a record.
pub(crate) fn numbers() -> impl Iterator<Item = &'static str> {
    Asked::NUMBERS.into_iter().chain([ERROR])
}

/// What the study's question is answered with.
pub(crate) const FOUND: &str = "found.value";
const TRACTIONS: [&str; 2] = ["pressure", "shear"];

/// Most curves that can be told apart in a panel.
const MOST_CURVES: u64 = 12;
/// Most panels of a figure.
const MOST_PANELS: u64 = 6;
/// Most numbers side by side.
pub(crate) const MOST_NUMBERS: usize = 4;

/// A field along an axis: the places of both in their lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) axis: usize,
    pub(crate) column: usize,
}

/// Where a figure takes its numbers from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// What changes from scene to scene.
    Field(Place),
    /// A number of the result, by its path; of tractions one of them.
    Number(&'static str),
}

/// Abscissa, ordinates and the number over both.
type Sources = (Option<Source>, Vec<Source>, Option<Source>);

/// A figure whose names are found.
#[cfg_attr(not(feature = "plot"), allow(dead_code))] // what is drawn of it
#[derive(Clone, Debug)]
pub(crate) struct Shown {
    /// The abscissa; `x/b` under tractions.
    pub(crate) x: Option<Source>,
    pub(crate) y: Vec<Source>,
    pub(crate) z: Option<Source>,
    /// Axes whose values have a curve each.
    pub(crate) family: Vec<Place>,
    /// The axis whose values have a panel each.
    pub(crate) panels: Option<Place>,
    /// Whether curves follow values drawn at random: then they are points.
    pub(crate) is_cloud: bool,
    /// Steps that are shown, where they are not all.
    pub(crate) only: Vec<(Place, Vec<u64>)>,
}

impl Study {
    /// What a figure of the study shows.
    pub(crate) fn shown(&self, plot: &Plot) -> Result<Shown, Fault> {
        file_name(&plot.file)?;
        marks(plot)?;
        let only = self.only(plot)?;
        let panels = plot.panels.as_deref().map(|name| self.place(&["panels"], name)).transpose()?;
        let (x, y, z) = self.sources(plot)?;
        self.one_ordinate(plot, &y)?;
        let mut shown = Shown { x, y, z, family: Vec::new(), panels, is_cloud: false, only };
        shown.family = match &plot.family {
            Some(_) if plot.kind == PlotKind::Map => {
                return Err(wrong(&["family"], "a map has no family", "`panels`, or `only` one scene for each cell"));
            }
            Some(names) => {
                let one = |(index, name): (usize, &String)| self.place(&["family", &index.to_string()], name);
                names.names().iter().enumerate().map(one).collect::<Result<_, _>>()?
            }
            None => self.family(plot, &shown),
        };
        self.each_axis_once(plot, &mut shown)?;
        self.few(&shown, plot)?;
        Ok(shown)
    }

    /// The steps of an axis that a figure shows, some of them left out where they are more than so many.
    #[cfg(feature = "plot")]
    pub(crate) fn shown_steps(&self, shown: &Shown, axis: usize, most: u64) -> Vec<u64> {
        let stride = self.shown_count(shown, axis).div_ceil(most).max(1);
        let stride = usize::try_from(stride).unwrap_or(usize::MAX);
        match shown.only.iter().find(|only| only.0.axis == axis) {
            Some((_, listed)) => listed.iter().copied().step_by(stride).collect(),
            None => (0..self.axes[axis].count).step_by(stride).collect(),
        }
    }

    fn shown_count(&self, shown: &Shown, axis: usize) -> u64 {
        shown.only.iter().find(|only| only.0.axis == axis).map_or(self.axes[axis].count, |only| only.1.len() as u64)
    }

    /// A name of the ordinate, and numbers from elsewhere, belong to one.
    fn one_ordinate(&self, plot: &Plot, y: &[Source]) -> Result<(), Fault> {
        let is_dry = self.scene.friction.is_none() && self.columns().all(|column| column.path[0] != "friction");
        // Without friction there is no shear to be drawn.
        if y.len() < 2 || plot.kind == PlotKind::Tractions && is_dry {
            return Ok(());
        }
        for (key, is_given) in [("y_label", plot.y_label.is_some()), ("points", !plot.points.is_empty())] {
            if is_given {
                let message = format!("`{key}` beside several ordinates: whose would it be?");
                return Err(wrong(&[key], message, format!("no `{key}`, or a figure for each `y`")));
            }
        }
        Ok(())
    }

    /// What a figure takes its numbers from.
    fn sources(&self, plot: &Plot) -> Result<Sources, Fault> {
        let names = plot.y.as_ref().map_or(&[][..], OneOrMore::names);
        if names.len() > MOST_NUMBERS {
            let fault = wrong(&["y"], "too many numbers in one figure", format!("at most {MOST_NUMBERS}"));
            return Err(fault
                .found(format!("{} of them", names.len()))
                .hint("give the others a [[plots]] of their own"));
        }
        if plot.kind != PlotKind::Map && plot.z.is_some() {
            return Err(wrong(&["z"], "only a map has a `z`", "`kind = \"map\"`, or no `z`"));
        }
        if plot.kind == PlotKind::Tractions {
            return self.tractions(plot, names);
        }
        let Some(x) = &plot.x else {
            return Err(missing("x", "the abscissa: an axis, or a number of the result"));
        };
        if names.is_empty() {
            return Err(missing("y", "the ordinate: a number of the result, of a map an axis"));
        }
        if plot.kind == PlotKind::Map {
            return self.map(plot, x, names);
        }
        let y = ordinates(names, |path, name| self.source(path, name))?;
        Ok((Some(self.source(&["x"], x)?), y, None))
    }

    /// [`Self::sources`] of tractions along the contact.
    fn tractions(&self, plot: &Plot, names: &[String]) -> Result<Sources, Fault> {
        if plot.x.is_some() {
            return Err(wrong(&["x"], "tractions are drawn over x/b", "no `x`"));
        }
        let mean = (plot.over == Over::Mean).then_some("pressure.mean");
        for needed in ["profile", "load.half_width"].into_iter().chain(mean) {
            self.is_asked_for(&["kind"], needed)?;
        }
        let traction = |path: &[&str], name: &str| match TRACTIONS.into_iter().find(|known| *known == name) {
            Some(known) => Ok(Source::Number(known)),
            None => Err(wrong(path, "not a traction", "`pressure`, `shear`").found(format!("`{name}`"))),
        };
        let y = if names.is_empty() { TRACTIONS.map(Source::Number).into() } else { ordinates(names, traction)? };
        Ok((None, y, None))
    }

    /// [`Self::sources`] of a number over two axes.
    fn map(&self, plot: &Plot, x: &str, names: &[String]) -> Result<Sources, Fault> {
        let [y] = names else {
            return Err(wrong(&["y"], "a map has one second axis", "the name of one axis"));
        };
        let Some(z) = &plot.z else {
            return Err(missing("z", "the number that the map shows, such as `stick.ratio`"));
        };
        let (x, y) = (self.along_map("x", x)?, self.along_map("y", y)?);
        if x.axis == y.axis {
            return Err(wrong(&["y"], "a map needs two axes", "an axis other than that of `x`"));
        }
        for (key, place) in [("x", x), ("y", y)] {
            if self.axes[place.axis].is_drawn() {
                return Err(wrong(&[key], "a map is drawn over a grid", "an axis that is not `random`"));
            }
        }
        Ok((Some(Source::Field(x)), vec![Source::Field(y)], Some(self.source(&["z"], z)?)))
    }

    /// Numbers that a figure of this study may show.
    fn numbers(&self) -> impl Iterator<Item = &'static str> {
        numbers().chain(self.find.is_some().then_some(FOUND))
    }

    /// A field by its path or label, or a number of the result.
    fn source(&self, path: &[&str], name: &str) -> Result<Source, Fault> {
        let number = self.numbers().find(|number| *number == name);
        match number {
            // A label that hides a number of the result would be taken for it.
            Some(number) if self.field(name).is_none() => {
                if number != ERROR && number != FOUND {
                    self.is_asked_for(path, number)?;
                }
                Ok(Source::Number(number))
            }
            _ => self.numbers_along(path, name).map(Source::Field),
        }
    }

    /// What a figure needs of the results is among them, which is to be told before anything is solved.
    fn is_asked_for(&self, path: &[&str], number: &str) -> Result<(), Fault> {
        let quantities = ["output", "quantities"];
        if self.asks(number) || self.columns().any(|column| overlap(&column.path, &quantities)) {
            return Ok(());
        }
        let message = format!("the figure needs `{number}`, which the scene does not ask for");
        let fault = wrong(path, message, "what is among them").found("`output.quantities` without it");
        Err(fault.hint(format!("add `{number}` to `quantities` of the scene, or leave that key out")))
    }

    fn field(&self, name: &str) -> Option<Place> {
        let columns = self.axes.iter().enumerate().flat_map(|(axis, list)| {
            list.columns.iter().enumerate().map(move |(column, c)| (Place { axis, column }, c))
        });
        let mut named = columns.filter(|(_, column)| column.label == name || column.field == name);
        named.next().map(|(place, _)| place)
    }

    fn place(&self, path: &[&str], name: &str) -> Result<Place, Fault> {
        self.field(name).ok_or_else(|| self.unknown(path, name, &[]))
    }

    /// A field along a side of a map.
    fn along_map(&self, key: &str, name: &str) -> Result<Place, Fault> {
        if self.field(name).is_some() {
            return self.numbers_along(&[key], name);
        }
        let fault = self.unknown(&[key], name, &[]);
        let is_number = self.numbers().any(|number| number == name);
        Err(if is_number {
            fault.hint(format!("a number of the result is what the map shows: z = \"{name}\""))
        } else {
            fault
        })
    }

    /// A field whose values are numbers.
    fn numbers_along(&self, path: &[&str], name: &str) -> Result<Place, Fault> {
        let place = self.field(name).ok_or_else(|| self.unknown(path, name, &numbers().collect::<Vec<_>>()))?;
        let Values::Listed(listed) = &self.axes[place.axis].columns[place.column].values else { return Ok(place) };
        match listed.iter().find_map(|(_, cell)| if let Cell::Text(text) = cell { Some(text) } else { None }) {
            None => Ok(place),
            Some(text) => Err(wrong(path, format!("the values of `{name}` are not numbers"), "an axis of numbers")
                .found(format!("`{text}`"))
                .hint("values with `names` make a family or panels")),
        }
    }

    fn unknown(&self, path: &[&str], name: &str, numbers: &[&str]) -> Fault {
        let labels: Vec<&str> = self.columns().map(|column| column.label.as_str()).collect();
        let fields = self.columns().map(|column| column.field.as_str());
        let known: Vec<&str> = labels.iter().copied().chain(fields).chain(numbers.iter().copied()).collect();
        let axes: Vec<String> = labels.iter().map(|label| format!("`{label}`")).collect();
        let axes = if axes.is_empty() { "an axis of the study (it has none)".into() } else { axes.join(", ") };
        let expected =
            if numbers.is_empty() { axes } else { format!("{axes}, or a number of the result such as `stick.ratio`") };
        let what = if numbers.is_empty() { "no such axis" } else { "no such axis and no such number of the result" };
        let fault = wrong(path, what, expected).found(format!("`{name}`"));
        match nearest(name, &known) {
            Some(near) => fault.hint(format!("did you mean `{near}`?")),
            None => fault,
        }
    }

    /// All axes that are neither drawn nor shown otherwise.
    fn family(&self, plot: &Plot, shown: &Shown) -> Vec<Place> {
        if plot.kind == PlotKind::Map {
            return Vec::new();
        }
        let taken = shown.taken();
        let mut family: Vec<usize> = (0..self.axes.len())
            .filter(|axis| !taken.contains(axis) && !self.axes[*axis].is_drawn() && self.shown_count(shown, *axis) > 1)
            .collect();
        let follows_an_axis = shown.x.iter().chain(&shown.y).any(|source| matches!(source, Source::Field(_)));
        if plot.kind == PlotKind::Curves && !follows_an_axis && !self.axes.iter().any(Axis::is_drawn) {
            family.pop();
        }
        family.into_iter().map(|axis| Place { axis, column: 0 }).collect()
    }

    /// No axis is shown in two ways, and none is left that would put several scenes on one place.
    fn each_axis_once(&self, plot: &Plot, shown: &mut Shown) -> Result<(), Fault> {
        let all: Vec<usize> = shown.taken().into_iter().chain(shown.family.iter().map(|place| place.axis)).collect();
        if let Some(twice) = (1..all.len()).find(|i| all[..*i].contains(&all[*i])) {
            let name = &self.axes[all[twice]].columns[0].label;
            let key = if plot.family.is_some() { "family" } else { "panels" };
            let fault = wrong(&[key], "an axis is shown in two ways", "each axis once");
            return Err(fault.found(format!("`{name}`")));
        }
        let left: Vec<usize> =
            (0..self.axes.len()).filter(|axis| !all.contains(axis) && self.shown_count(shown, *axis) > 1).collect();
        shown.is_cloud = plot.kind == PlotKind::Curves
            && all.iter().chain(&left).any(|a| self.axes[*a].is_drawn() && !shown.family.iter().any(|f| f.axis == *a));
        let follows_an_axis = matches!(shown.x, Some(Source::Field(_))) || plot.kind != PlotKind::Curves;
        let allowed = match plot.kind {
            PlotKind::Curves if shown.is_cloud => usize::MAX,
            PlotKind::Curves if !follows_an_axis && !shown.y.iter().any(|y| matches!(y, Source::Field(_))) => 1,
            _ => 0,
        };
        if left.len() > allowed {
            let names: Vec<&str> = left.iter().map(|axis| self.axes[*axis].columns[0].label.as_str()).collect();
            let ways = if plot.kind == PlotKind::Map { "`panels` or `only`" } else { "`family`, `panels` or `only`" };
            let fault = wrong(&["kind"], "several scenes for each place of the figure", format!("it in {ways}"));
            return Err(fault.found(format!("nothing that tells values of `{}` apart", names.join("`, `"))));
        }
        Ok(())
    }

    /// Not more curves and panels than can be told apart.
    fn few(&self, shown: &Shown, plot: &Plot) -> Result<(), Fault> {
        let counts = shown.family.iter().map(|place| self.shown_count(shown, place.axis));
        let curves = counts.fold(1_u64, u64::saturating_mul);
        if curves > MOST_CURVES {
            let key = if plot.family.is_some() { "family" } else { "kind" };
            let fault = wrong(&[key], "too many curves to be told apart", format!("at most {MOST_CURVES}"));
            let hint = "show some of them with `only`, or a number over two axes with `kind = \"map\"`";
            return Err(fault.found(format!("{curves} curves")).hint(hint));
        }
        let panels = shown.panels.map_or(1, |place| self.shown_count(shown, place.axis));
        if panels > MOST_PANELS {
            let fault = wrong(&["panels"], "too many panels in one figure", format!("at most {MOST_PANELS}"));
            return Err(fault.found(format!("{panels} panels")).hint("show some of them with `only`"));
        }
        Ok(())
    }
}

/// Where each ordinate is taken from.
fn ordinates(names: &[String], source: impl Fn(&[&str], &str) -> Result<Source, Fault>) -> Result<Vec<Source>, Fault> {
    names.iter().enumerate().map(|(index, name)| source(&["y", &index.to_string()], name)).collect()
}

impl Axis {
    /// Whether its values are drawn at random.
    fn is_drawn(&self) -> bool {
        self.columns.iter().any(|column| matches!(column.values, Values::Drawn { .. }))
    }
}

impl Shown {
    /// Axes that are shown along the figure's own, or as panels.
    fn taken(&self) -> Vec<usize> {
        let along = self.x.iter().chain(&self.y).filter_map(|source| match source {
            Source::Field(place) => Some(place.axis),
            Source::Number(_) => None,
        });
        along.chain(self.panels.map(|place| place.axis)).collect()
    }
}
