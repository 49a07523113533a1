#![allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction

use super::*;
use proptest::prelude::*;
use slipzone_api::Place;

/// One file, whatever its name.
struct One(Vec<u8>);

impl Files for One {
    fn read(&self, _name: &str) -> Result<Vec<u8>, String> {
        Ok(self.0.clone())
    }
}

fn file() -> Table {
    Table { source: Source::File("profile.csv".into()), ..Table::points(Vec::new()) }
}

fn of_text(text: &str) -> Result<Profile, Fault> {
    file().understood(&One(text.into()))
}

fn of_points(points: impl IntoIterator<Item = [f64; 2]>) -> Profile {
    let table = Table::points(points.into_iter().collect());
    table.understood(&slipzone_api::NoFiles).unwrap_or_else(|fault| panic!("{fault}"))
}

fn sampled(from: f64, to: f64, count: u32, mut height: impl FnMut(f64) -> f64) -> Vec<[f64; 2]> {
    (0..count).map(|i| from + (to - from) * (f64::from(i) / f64::from(count - 1))).map(|x| [x, height(x)]).collect()
}

/// Repeatable scatter of about unit root mean square: sums of uniform numbers of a linear congruential generator.
fn scatter() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        (0..12).map(|_| uniform()).sum()
    }
}

fn worst_slope(shape: &dyn PunchShape, to: f64, slope: impl Fn(f64) -> f64) -> f64 {
    (1..=200).map(|i| f64::from(i) / 200.0 * to).map(|x| (shape.slope(x) - slope(x)).abs()).fold(0.0, f64::max)
}

#[test]
fn a_clean_parabola_comes_back() {
    for points in [
        sampled(0.0, 4.0, 4, |x| 0.05 * x * x),
        sampled(0.0, 4.0, 50, |x| 3.0 + 0.05 * x * x),
        sampled(-4.0, 4.0, 51, |x| 0.05 * x * x),
        sampled(-4.0, 0.0, 51, |x| 0.05 * x * x),
        sampled(0.0, 4.0, 5000, |x| 0.05 * x * x),
    ] {
        let profile = of_points(points);
        let worst = worst_slope(&profile, 4.0, |x| 0.1 * x);
        // Heights of 3.8 round to 4e-16; the slope of a parabola through them to some times that.
        assert!(worst < 1e-12, "{worst:e}");
        assert!(profile.noise().unwrap() < 1e-14);
        assert_eq!((profile.kinks(), profile.flaw(4.0), profile.reach()), (&[][..], None, Some(4.0)));
    }
}

/// Clean shapes that are no cubic. Slopes of cubic splines are off by `h^3 g''''/24`: with knots h = 1/8 apart and
/// `g''''` up to 3, some 2e-4 at worst.
#[test]
fn clean_smooth_shapes_come_close() {
    type Shape = (fn(f64) -> f64, fn(f64) -> f64);
    let shapes: [Shape; 3] = [
        (|x| 10.0 - (100.0 - x * x).sqrt(), |x| x / (100.0 - x * x).sqrt()),
        (|x| (1.0 + x * x).sqrt() - 1.0, |x| x / (1.0 + x * x).sqrt()),
        (|x| 0.01 * x.powi(4), |x| 0.04 * x.powi(3)),
    ];
    for (height, slope) in shapes {
        let profile = of_points(sampled(0.0, 4.0, 400, height));
        let worst = worst_slope(&profile, 4.0, slope);
        assert!(worst < 1e-4, "{worst:e}");
        assert_eq!(profile.flaw(4.0), None);
    }
}

#[test]
fn noise_is_smoothed_out_and_reported() {
    for noise in [1e-6, 1e-4, 1e-2] {
        let mut scatter = scatter();
        let points = sampled(-4.0, 4.0, 4001, |x| 0.05 * x * x + noise * scatter());
        let profile = of_points(points);
        let found = profile.noise().unwrap();
        assert!((found / noise - 1.0).abs() < 0.05, "{found:e} for {noise:e}");
        // Differences of neighbours would scatter by 700 noise.
        let worst = worst_slope(&profile, 4.0, |x| 0.1 * x);
        assert!(worst < noise, "{worst:e} for {noise:e}");
        assert_eq!(profile.flaw(4.0), None, "{noise}");
        assert!(profile.corners().is_empty());
    }
}

/// How far a curve of more pieces lies elsewhere: far, where the rows beyond the contact decide; hardly, where noise is
/// what is left over.
#[test]
fn a_curve_knows_how_sure_it_is() {
    let of_fourth = |count: u32, last: f64| of_points(sampled(0.0, last, count, |x| 0.02 * x.powi(4)));
    let doubt = |profile: &Profile| profile.doubt(1.0).unwrap();
    // Of `x^4` its height at 1 is off by 29 %.
    let sparse = of_fourth(7, 2.0);
    assert!((sparse.height(1.0) / 0.02 - 1.0).abs() > 0.25 && doubt(&sparse) > 0.25, "{}", doubt(&sparse));
    assert!(doubt(&of_fourth(7, 1.0)) > 0.05);
    let dense = of_fourth(100, 2.0);
    assert!((dense.height(1.0) / 0.02 - 1.0).abs() < 1e-3 && doubt(&dense) < 1e-3, "{}", doubt(&dense));
    let mut scatter = scatter();
    let noisy = of_points(sampled(-2.0, 2.0, 2001, |x| 0.02 * x * x + 1e-3 * scatter()));
    assert!(doubt(&noisy) < 0.05, "{}", doubt(&noisy));
    // Few rows that a parabola goes through are no reason to doubt it.
    assert!(doubt(&of_points(sampled(0.0, 2.0, 5, |x| 0.02 * x * x))) < 1e-10);
}

#[test]
fn a_wedge_keeps_its_corner() {
    let profile = of_points(sampled(0.0, 4.0, 50, |x| 0.1 * x));
    assert_eq!((profile.kinks(), profile.corners()), (&[0.0][..], &[0.0][..]));
    let told = profile.remarks(1.0);
    assert!(told.len() == 1 && told[0].contains("has a corner at x = 0, of slope 1.0e-1 on either side"), "{told:?}");
    assert!(worst_slope(&profile, 4.0, |_| 0.1) < 1e-12);
    let mut scatter = scatter();
    let profile = of_points(sampled(-4.0, 4.0, 1000, |x| 0.1 * x.abs() + 1e-4 * scatter()));
    assert_eq!(profile.corners(), [0.0]);
    assert!(worst_slope(&profile, 4.0, |_| 0.1) < 1e-3);
}

#[test]
fn a_flat_face_is_found() {
    let profile = of_points(sampled(-4.0, 4.0, 401, |x| 0.1 * (x.abs() - 2.0).max(0.0).powi(2)));
    let face = profile.face();
    // To within the pieces, four of them per unit.
    assert!((1.5..=2.0).contains(&face), "{face}");
    assert_eq!((profile.height(face), profile.slope(face)), (0.0, 0.0));
    assert_eq!(of_points(sampled(0.0, 4.0, 50, |x| 0.05 * x * x)).face(), 0.0);
}

/// They had been taken for a flat face as wide as the table, under which nothing bears.
#[test]
fn heights_that_fall_are_no_punch() {
    let hump = "0, 0\n0.5, 0.01125\n1, 0.03\n1.5, 0.01125\n2, -0.12\n";
    let turned = "0, 0\n0.5, -0.0125\n1, -0.05\n1.5, -0.1125\n2, -0.2\n";
    for (text, depth) in [(hump, "0.12"), (turned, "0.2")] {
        let fault = of_text(text).unwrap_err().to_string();
        assert!(fault.contains(&format!("at |x| = 2 is {depth} below")), "{fault}");
    }
    let up_and_down = "0, 0\n0.5, 0.2\n1, 0.25\n1.5, 0.2\n2, 0.0\n";
    assert!(of_text(up_and_down).unwrap_err().to_string().contains("do not grow"));
}

#[test]
fn what_is_neither_convex_nor_symmetric_is_named() {
    for noise in [0.0, 1e-4] {
        let mut scatter = scatter();
        let mut rough = |height: f64| height + noise * scatter();
        let wave = of_points(sampled(0.0, 3.0, 300, |x| rough(1.0 - x.cos())));
        let flaw = wave.flaw(3.0).unwrap();
        assert!(flaw.what.contains("not convex") && (1.5..3.0).contains(&flaw.x), "{flaw:?}");

        let dip = of_points(sampled(0.0, 3.0, 300, |x| rough((x - 0.5).powi(2))));
        let flaw = dip.flaw(3.0).unwrap();
        assert!(flaw.what.contains("not convex") && flaw.x < 0.1, "{flaw:?}");
        assert_eq!(dip.flaw(0.0), dip.flaw(3.0).filter(|flaw| flaw.x <= 0.0));

        let askew = of_points(sampled(-3.0, 3.0, 300, |x| rough(x * x + if x > 2.0 { 0.01 } else { 0.0 })));
        let flaw = askew.flaw(3.0).unwrap();
        assert!(flaw.what.contains("not symmetric") && (1.9..2.3).contains(&flaw.x), "{noise}: {flaw:?}");
        assert_eq!(askew.flaw(1.0), None);

        let off = of_points(sampled(-3.0, 3.0, 300, |x| rough((x - 0.01).powi(2))));
        assert!(off.flaw(3.0).unwrap().what.contains("not symmetric"), "{noise}");
    }
    let sparse = of_points(sampled(0.0, 3.0, 21, |x| 1.0 - x.cos()));
    assert!(sparse.flaw(3.0).unwrap().what.contains("not convex"));
}

/// A lost decimal point bent the curve everywhere, and the scatter that it made hid it.
#[test]
fn a_row_far_off_the_others_is_left_out_and_named() {
    for (noise, tolerated) in [(0.0, 1e-9), (1e-3, 1e-2)] {
        for count in [9, 15, 41, 61, 66, 200, 1001] {
            for (share, off) in [(0.7, 45.0), (0.3, -0.5), (0.7, 0.3), (0.4, 1e6), (0.0, 2.0), (0.5, -1e3)] {
                let (mut scatter, mut places, stray) = (scatter(), 0.., (share * f64::from(count - 1)).round());
                let rows = sampled(0.0, 4.0, count, |x| {
                    let i: u32 = places.next().expect("endless");
                    0.05 * x * x + noise * scatter() + if f64::from(i) == stray { off } else { 0.0 }
                });
                let name = format!("{noise}, {count} rows, {off} at {share}");
                let at = 4.0 * (stray / f64::from(count - 1));
                let Ok(profile) = Table::points(rows).understood(&slipzone_api::NoFiles) else {
                    // Below all others.
                    assert!(off < 0.0, "{name}");
                    continue;
                };
                assert_eq!(
                    profile.flaw(4.0).map(|flaw| (flaw.what.contains("far off"), flaw.x)),
                    Some((true, at)),
                    "{name}"
                );
                let worst = worst_slope(&profile, 4.0, |x| 0.1 * x);
                assert!(worst < tolerated, "{name}: {worst}");
                let remarks = profile.remarks(4.0);
                assert!(remarks[0].starts_with("the row") && remarks[0].contains("left out"), "{name}: {remarks:?}");
            }
        }
    }
    // Several of them, one on the left.
    let spikes = |i: u32| {
        [(30, 0.5), (70, -0.2), (71, -0.2), (140, 1.0)].iter().find(|spike| spike.0 == i).map_or(0.0, |spike| spike.1)
    };
    let mut scatter = scatter();
    let rows = sampled(-3.0, 3.0, 150, |x| 0.05 * x * x + 1e-3 * scatter());
    let spiked = rows.iter().zip(0..).map(|(row, i)| [row[0], row[1] + spikes(i)]);
    let profile = of_points(spiked);
    assert!(profile.remarks(3.0)[0].starts_with("4 rows"), "{:?}", profile.remarks(3.0));
}

/// Noise has no strays, of however few rows, and whichever it is: this is how many of 3,000 tables had one.
#[test]
fn what_only_scatters_is_not_left_out() {
    let mut scatter = scatter();
    let mut strays = 0;
    for table in 0..3000 {
        let count = 5 + table % 60;
        let rows = sampled(-1.0, 3.0, count, |x| 0.05 * x.abs().powf(1.5) + 0.02 * scatter());
        let Ok(profile) = Table::points(rows).understood(&slipzone_api::NoFiles) else { continue };
        strays += usize::from(profile.remarks(0.0).iter().any(|remark| remark.contains("far off")));
    }
    assert!(strays <= 3, "{strays}");
}

#[test]
fn beyond_the_table_there_is_nothing() {
    let profile = of_points(sampled(0.0, 4.0, 50, |x| 0.05 * x * x));
    for x in [4.000_001, -5.0, 1e300, f64::INFINITY, f64::NAN] {
        assert!(profile.height(x).is_nan() && profile.slope(x).is_nan());
    }
    assert!(profile.slope(4.0).is_finite() && profile.height(-4.0).is_finite());
    assert_eq!(profile.flaw(4.1).map(|flaw| flaw.x), Some(4.0));
}

#[test]
fn units_scale() {
    let mut table = Table::points(sampled(0.0, 4.0, 50, |x| 0.05 * x * x));
    table.x_unit = Positive::new(1e-3).unwrap();
    table.height_unit = Positive::new(1e-6).unwrap();
    let shape = table.shape().unwrap();
    assert!((shape.height(2e-3) / 0.2e-6 - 1.0).abs() < 1e-12);
    assert!((shape.slope(2e-3) / 0.2e-3 - 1.0).abs() < 1e-12);
    assert_eq!(shape.reach(), Some(4e-3));
}

#[test]
fn files_are_read_as_programs_write_them() {
    let rows = "0 0\n1 0.05\n2 0.2\n3 0.45\n4 0.8\n";
    let reference = of_text(rows).unwrap();
    for text in [
        rows.replace(' ', ","),
        rows.replace(' ', ", "),
        rows.replace(' ', ";"),
        rows.replace(' ', "\t"),
        rows.replace(' ', " ; "),
        rows.replace(' ', "   "),
        rows.replace('\n', "\r\n"),
        format!("x height\n{rows}"),
        format!("# measured in May\n\n\"x\"; \"height\"\n{}", rows.replace(' ', ";")),
        rows.replace("0.2\n", "0.2 # here\n\n\n"),
        format!("\u{feff}{rows}"),
        rows.replace("0.2", "2e-1").replace("3 ", "+3.0 "),
        rows.replace("1 0.05", "\"1\" \"0.05\""),
        rows.trim_end().to_owned(),
    ] {
        let profile = of_text(&text).unwrap_or_else(|fault| panic!("{fault}\n{text}"));
        assert!((profile.slope(2.5) - reference.slope(2.5)).abs() < 1e-15, "{text}");
    }
}

#[test]
fn commas_within_numbers_are_told_from_those_between() {
    let hint = |rows: &str| of_text(rows).expect_err(rows).hint;
    let decimal = Some("decimals are written with a point");
    for rows in ["0,0 0,0\n0,5 0,001\n", "0 0\n0,5\t0,001\n", "0;0\n0,5;0,001\n"] {
        assert_eq!(hint(rows).as_deref(), decimal, "{rows}");
    }
    for rows in ["0,0,0\n", "0, 0, 0\n", "0, 0\n1, 2, 3\n"] {
        assert_eq!(hint(rows), None, "{rows}");
    }
}

#[test]
fn faults_in_a_file_are_located() {
    let rows = "x, height\n0, 0\n1, 0.05\n2, 0.2\n3, 0.45\n4, 0.8\n";
    let cases = [
        (rows.replace("0.2", "nan"), 4, "height that is not allowed", "`NaN`"),
        (rows.replace("0.2", "inf"), 4, "height that is not allowed", "`inf`"),
        (rows.replace("0.2", "1e200"), 4, "height that is not allowed", "1000"),
        (rows.replace("2, ", "1, "), 4, "x that was there before", "1 after 1"),
        (rows.replace("2, ", "0.5, "), 4, "x that does not ascend", "0.5 after 1"),
        (rows.replace("0.2", "two"), 4, "not a number", "`two`"),
        (rows.replace("0.2", ""), 4, "not a number", "``"),
        (rows.replace("0.2", "0.2, 3"), 4, "not a row of two columns", "3 columns"),
        (rows.replace("2, 0.2", "2"), 4, "not a row of two columns", "1 column"),
        (rows.replace(", ", "; ").replace("0.2", "0,2"), 4, "not a number", "`0,2`"),
        (format!("{rows}x, height\n"), 7, "not a number", "`x`"),
        ("x, height\n0, 0\n1, 1\n".into(), 0, "too few rows", "2 rows"),
        ("x, height\n".into(), 0, "no rows", "0 rows"),
        (String::new(), 0, "no rows", "0 rows"),
        ("-2, 4\n-1, 1\n1, 1\n2, 4\n".into(), 0, "too few rows", "4 rows, 2 of them apart"),
        ("2, 1\n3, 2\n4, 4\n5, 6\n".into(), 0, "no row near the middle", "x from 2 to 5"),
        ("0, 1\n3, 1\n4, 1\n5, 1\n".into(), 0, "all heights are the same", "1 everywhere"),
    ];
    for (text, at, message, found) in cases {
        let fault = of_text(&text).expect_err(message);
        assert!(fault.message.contains(message), "{message}: {fault}");
        assert!(fault.found.as_ref().is_some_and(|words| words.contains(found)), "{message}: {fault}");
        let Place::File { line, name, text, span } = &fault.place else { panic!("{fault}") };
        assert_eq!((*line, name.as_str()), (at, "profile.csv"), "{fault}");
        assert!(text.get(span.clone()).is_some());
        assert_eq!(fault.path, ["file"]);
    }
    let fault = file().understood(&One(b"0 0\n1 \xe9\n".to_vec())).unwrap_err();
    assert!(matches!(fault.place, Place::File { line: 2, .. }), "{fault}");
    let fault = file().understood(&One(b"\xff\xfe0\0".to_vec())).unwrap_err();
    assert!(fault.found.unwrap().contains("UTF-16"));
    let fault = file().understood(&One(vec![b' '; slipzone_api::LARGEST_FILE + 1])).unwrap_err();
    assert!(fault.message.contains("too large"));
    assert!(file().understood(&slipzone_api::NoFiles).unwrap_err().message.contains("cannot read"));
    assert!(file().shape().unwrap_err().to_string().contains("cannot read"));
}

#[test]
fn faults_in_points_are_located() {
    let fault = |points: &[[f64; 2]]| Table::points(points.to_vec()).understood(&slipzone_api::NoFiles).unwrap_err();
    assert_eq!(fault(&[[0.0, 0.0], [1.0, f64::NAN]]).path, ["points", "1", "1"]);
    assert_eq!(fault(&[[0.0, 0.0], [1.0, 1.0], [1.0, 2.0]]).path, ["points", "2", "0"]);
    assert_eq!(fault(&[[0.0, 0.0], [1.0, 1.0]]).path, ["points"]);
    assert_eq!(fault(&[]).path, ["points"]);
}

/// A million rows are read and fitted; one more is refused.
#[test]
fn a_million_rows() {
    use std::fmt::Write;
    let mut scatter = scatter();
    let mut text = String::new();
    for i in 0..1_000_000 {
        let x = f64::from(i) * 1e-6;
        writeln!(text, "{x:.6},{:.9}", 0.05 * x * x + 1e-6 * scatter()).unwrap();
    }
    let profile = of_text(&text).unwrap();
    assert!(worst_slope(&profile, 1.0, |x| 0.1 * x) < 1e-6);
    assert_eq!(profile.flaw(0.999_999), None);
    text.push_str("2,0.2\n");
    let fault = of_text(&text).unwrap_err();
    assert_eq!(fault.message, "too many rows");
    assert!(matches!(fault.place, Place::File { line: 1_000_001, .. }));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever the points are, the shape is convex, starts at 0, and its slope is its height's derivative; or there is
    /// none.
    #[test]
    fn any_points_give_a_convex_shape(heights in prop::collection::vec(-1.0..1.0_f64, 4..80), power in 0.3..3.0_f64) {
        let count = heights.len() as f64;
        let rows = heights.iter().zip(0_u32..).map(|(height, i)| [(f64::from(i) / count).powf(power), *height]);
        let profile = match Table::points(rows.collect()).understood(&slipzone_api::NoFiles) {
            Ok(profile) => profile,
            Err(fault) => {
                prop_assert_eq!(fault.message, "the heights do not grow with |x|");
                return Ok(());
            }
        };
        let reach = profile.reach().unwrap();
        prop_assert_eq!(profile.height(0.0), 0.0);
        let steepest = profile.slope(reach);
        let mut before = 0.0;
        for i in 1..=500 {
            let x = f64::from(i) / 500.0 * reach;
            let slope = profile.slope(x);
            prop_assert!(slope >= before - 1e-9 * steepest, "{} after {} at {}", slope, before, x);
            before = slope;
        }
        prop_assert!(profile.kinks().len() <= 33);
        prop_assert!(profile.noise().unwrap() <= 2.0);
    }
}

/// A contact within the first rows rests on the curve between them, and nobody was told.
#[test]
fn few_rows_under_a_contact_are_told() {
    let parabola = of_points(sampled(0.0, 8.0, 9, |x| x * x));
    // Between rows 1 apart `x^2` lies a quarter below straight lines; half-way to the first row it does first.
    let told = |half_width: f64| parabola.remarks(half_width);
    assert!(
        told(1.5)[0].contains("up to 11 % of its height at the contact's edge, most at x = 0.5"),
        "{:?}",
        told(1.5)
    );
    assert!(told(0.4)[0].contains("by more than its height"), "{:?}", told(0.4));
    assert_eq!((told(2.2).len(), told(2.3).len()), (1, 0), "5 % at sqrt(5)");
    let straight = of_points(sampled(0.0, 8.0, 9, |x| x));
    let remarks = straight.remarks(0.4);
    assert!(remarks.len() == 1 && remarks[0].contains("has a corner"), "{remarks:?}");
    // Where the rows are far from each other, out there.
    let sparse = of_points([0.0, 0.1, 0.2, 0.3, 0.4, 2.4, 4.0, 8.0].map(|x| [x, x * x]));
    assert!(sparse.remarks(0.4).is_empty(), "{:?}", sparse.remarks(0.4));
    let told = sparse.remarks(2.0);
    assert!(told[0].contains("up to 25 % of its height") && told[0].ends_with("x = 1.4"), "{told:?}");
}

/// Exact heights, and those of a drawing: what the fit misses of them was taken for a flaw, as blocks of neighbours had
/// other points on the left than on the right, and bend by themselves.
#[test]
fn clean_tables_of_convex_symmetric_shapes_have_no_flaw() {
    let shapes: [fn(f64) -> f64; 6] = [
        |x| 0.1 * x.abs(),
        |x| 0.02 * x.powi(4),
        |x| 0.05 * (x.abs() - 0.5).max(0.0).powi(2),
        |x| if x.abs() < 0.5 { 0.05 * x * x } else { 0.05 * (x.abs() - 0.25) },
        |x| 0.1 * x.abs().powf(1.5),
        |x| 0.05 * ((2.0 * x).cosh() - 1.0),
    ];
    for (i, shape) in shapes.into_iter().enumerate() {
        for count in [9, 25, 101, 401] {
            let on_both_sides = |place: &dyn Fn(f64) -> f64| -> Vec<f64> {
                (0..count).map(|i| place(2.0 * f64::from(i) / f64::from(count - 1) - 1.0)).collect()
            };
            let shifted = 1.4 / f64::from(count);
            for places in [
                on_both_sides(&|u| 2.0 * u),
                on_both_sides(&|u| 1.0 + u),
                on_both_sides(&|u| 2.0 * u.powi(3)),
                on_both_sides(&|u| 2.0 * u + shifted),
            ] {
                for decimals in [15, 8, 6, 5, 4, 3] {
                    let unit = 10_f64.powi(decimals);
                    let rows: Vec<_> = places.iter().map(|x| [*x, (shape(*x) * unit).round() / unit]).collect();
                    let Ok(profile) = Table::points(rows).understood(&slipzone_api::NoFiles) else { continue };
                    assert_eq!(profile.flaw(1.5), None, "shape {i}, {count} rows, {decimals} decimals: {places:?}");
                }
            }
        }
    }
    // What is off by more than the last decimal is seen through it.
    for off in [|x: f64| (x - 0.01).powi(2), |x: f64| 1.0 - x.cos()] {
        let rows = sampled(-3.0, 3.0, 300, |x| (off(x) * 1e3).round() / 1e3);
        assert!(of_points(rows).flaw(3.0).is_some());
    }
}
