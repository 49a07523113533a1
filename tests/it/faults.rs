//! The faults of `scripts/inject-faults`, which takes too long for a test: that each can still be put in.

use std::collections::HashSet;
use std::fs;
use std::path::Path;

#[test]
fn each_fault_has_one_place() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let script = fs::read_to_string(root.join("scripts/inject-faults")).unwrap();
    let list = script.split("<<'LIST'\n").nth(1).and_then(|rest| rest.split("\nLIST\n").next()).expect("a list");
    let mut names = HashSet::new();
    for line in list.lines() {
        let [name, file, stands, fault] = line.split(" ; ").collect::<Vec<_>>()[..] else {
            panic!("four parts: {line}")
        };
        assert!(names.insert(name), "{name} is there twice");
        let text = fs::read_to_string(root.join(file)).unwrap_or_else(|why| panic!("{name}, {file}: {why}"));
        assert_eq!(text.matches(stands).count(), 1, "{name}: `{stands}` in {file}");
        assert_ne!(stands, fault, "{name}");
    }
    assert!(names.len() > 40, "{} faults", names.len());
}
