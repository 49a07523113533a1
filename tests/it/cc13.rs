//! The studies of `examples/cc13/`: the paper's figures and table, and what its text claims of them.

use serde_json::Value;
use slipzone::api::Files;
use slipzone::study::{Study, sweep};
use std::ops::ControlFlow;
use std::sync::OnceLock;

/// The folder of the studies.
struct Folder;

impl Files for Folder {
    fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        std::fs::read(format!("{}/examples/cc13/{name}", env!("CARGO_MANIFEST_DIR"))).map_err(|error| error.to_string())
    }
}

fn study(name: &str) -> Study {
    let file = format!("{name}.toml");
    let text = String::from_utf8(Folder.read(&file).unwrap_or_else(|e| panic!("{file}: {e}"))).expect("text");
    Study::parse(&file, &text, &Folder).unwrap_or_else(|error| panic!("{error}"))
}

/// The lines of a study's results.
fn solved(study: &Study) -> Vec<Value> {
    let mut records = Vec::new();
    sweep(study, &|_| false, |record| {
        records.push(serde_json::to_value(&record).expect("JSON"));
        ControlFlow::Continue(())
    });
    records.sort_by_key(|record| record["index"].as_u64());
    records
}

/// All studies with their results, each solved once.
fn all() -> &'static [(String, Study, Vec<Value>)] {
    static ALL: OnceLock<Vec<(String, Study, Vec<Value>)>> = OnceLock::new();
    ALL.get_or_init(|| {
        let names = (2..=12).map(|figure| format!("figure{figure}")).chain(["table1", "map"].map(Into::into));
        names
            .map(|name| {
                let study = study(&name);
                let records = solved(&study);
                (name, study, records)
            })
            .collect()
    })
}

#[cfg(feature = "plot")]
fn drawn() -> Vec<(String, String)> {
    let figures = all().iter().flat_map(|(name, study, records)| {
        study.plots.iter().map(move |plot| {
            let svg = slipzone::report::study_svg(study, plot, records.iter().cloned());
            (plot.file.clone(), svg.unwrap_or_else(|error| panic!("{name}: {error}")))
        })
    });
    figures.collect()
}

/// Writes the figures of the document: `SLIPZONE_FIGURES=folder cargo test --test it cc13_to_look_at -- --ignored`.
#[cfg(feature = "plot")]
#[test]
#[ignore = "for the eye"]
fn cc13_to_look_at() {
    let folder = std::path::PathBuf::from(std::env::var("SLIPZONE_FIGURES").expect("a folder"));
    for (file, svg) in drawn() {
        std::fs::write(folder.join(file), svg).expect("a file");
    }
    for (name, study, records) in all() {
        for record in records {
            let mut record = record.clone();
            record.as_object_mut().expect("a table").remove("profile");
            println!("{name} {record}");
        }
        let _ = study;
    }
}
