//! Many scenes: what one costs among others, and what it leaves behind.

use slipzone::api::NoFiles;
use slipzone::study::{Record, Study, sweep};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Small studies are solved so often that this many scenes are, large ones at least a few times.
const SCENES: u64 = 400;
const FEWEST: u64 = 5;

/// Time and bytes of each scene of studies of many sizes, on one thread.
pub(crate) fn scenes() {
    println!(
        "\nTime of a scene, on one thread, over that of one scene alone; a record's line in a journal; writing it:\n\n\
         | what differs | 2 | 5 | 17 | 65 | 257 | 1025 | bytes of a line | writing over solving |\n\
         |---|---|---|---|---|---|---|---|---|"
    );
    for (name, friction, axis) in [
        (
            "force, no friction",
            false,
            "[[axes]]\nfield = \"load.force\"\nlinear = { from = 1.0, to = 2.0, count = COUNT }",
        ),
        ("force", true, "[[axes]]\nfield = \"load.force\"\nlinear = { from = 1.0, to = 2.0, count = COUNT }"),
        (
            "friction",
            true,
            "[[axes]]\nfield = \"friction.coefficient\"\nlinear = { from = 0.2, to = 0.4, count = COUNT }",
        ),
        ("width", true, "[[axes]]\nfield = \"punch.half_width\"\nlinear = { from = 0.5, to = 1.0, count = COUNT }"),
        (
            "layer, no friction",
            false,
            "[[axes]]\nfield = \"layer.grading.base\"\nlinear = { from = 2.0, to = 8.0, count = COUNT }",
        ),
        ("layer", true, "[[axes]]\nfield = \"layer.grading.base\"\nlinear = { from = 2.0, to = 8.0, count = COUNT }"),
    ] {
        let runs =
            [2, 5, 17, 65, 257, 1025].map(|count| solved(&study(friction, &axis.replace("COUNT", &count.to_string()))));
        let each = |(time, records): &(Duration, Vec<Record>)| time.as_secs_f64() / records.len() as f64;
        let alone = alone(friction);
        let cells: Vec<String> = runs.iter().map(|run| format!("{:.2}", each(run) / alone)).collect();
        let (_, records) = &runs[5];
        let start = Instant::now();
        let bytes: usize =
            records.iter().map(|record| serde_json::to_vec(record).map_or(0, |line| line.len() + 1)).sum();
        let writing = start.elapsed().as_secs_f64() / records.len() as f64;
        println!("| {name} | {} | {} | {:.3} |", cells.join(" | "), bytes / records.len(), writing / each(&runs[5]));
    }
}

/// A study of the standard scene.
fn study(friction: bool, axis: &str) -> Study {
    let friction = if friction { "friction = { type = \"goodman\", coefficient = 0.3 }" } else { "" };
    let text = format!(
        "format = 1\n[scene]\nformat = 1\n\
         layer = {{ thickness = 5.0, poisson = 0.3, grading = {{ type = \"exponential\", surface = 1.0, base = 8.0 }} }}\n\
         punch = {{ type = \"flat\", half_width = 1.0 }}\nload = {{ force = 1.0 }}\n{friction}\n{axis}\n"
    );
    Study::parse("cost_model.toml", &text, &NoFiles).unwrap_or_else(|error| panic!("{error}"))
}

/// Seconds of one scene by itself.
fn alone(friction: bool) -> f64 {
    solved(&study(friction, "")).0.as_secs_f64()
}

/// The records of a study, and how long they took on one thread: the shortest of a few times.
fn solved(study: &Study) -> (Duration, Vec<Record>) {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread");
    let once = || {
        let mut records = Vec::new();
        let start = Instant::now();
        one.install(|| {
            sweep(study, &|_| false, |record| {
                records.push(record);
                ControlFlow::Continue(())
            });
        });
        (start.elapsed(), records)
    };
    let rounds = (SCENES / study.rows()).max(FEWEST);
    (0..rounds).map(|_| once()).min_by_key(|(time, _)| *time).expect("one at least")
}
