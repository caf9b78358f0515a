//! The imports between the files of this crate form no cycle: each file can be read after those that it names.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

type Graph = BTreeMap<String, BTreeSet<String>>;

/// Adds the modules below `folder`, each with the modules that its non-test code imports from this crate.
fn read(folder: &Path, parent: &str, graph: &mut Graph) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            read(&path, &stem, graph);
        } else if stem != "lib" {
            let name = match (parent, stem.as_str()) {
                ("", _) => stem,
                (_, "mod") => parent.to_owned(),
                _ => format!("{parent}::{stem}"),
            };
            let text = std::fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]\nmod tests").next().unwrap();
            graph.insert(name, imports(code, parent));
        }
    }
}

/// `use crate::a::...`, `use crate::{a, b::c}` and, of a child, `use super::a::...`.
fn imports(code: &str, parent: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for statement in code.split(';') {
        let Some(start) = statement.find("use ") else {
            continue;
        };
        let path = statement[start + 4..].trim();
        let (prefix, rest) = match (path.strip_prefix("crate::"), path.strip_prefix("super::")) {
            (Some(rest), _) => (String::new(), rest),
            (None, Some(rest)) => (format!("{parent}::"), rest),
            (None, None) => continue,
        };
        for item in rest.trim_matches(['{', '}']).split(',') {
            let module = item.trim().split("::").next().unwrap();
            found.insert(format!("{prefix}{module}"));
        }
    }
    found
}

/// The first cycle met from `name`, as a path of names.
fn cycle(graph: &Graph, name: &str, path: &mut Vec<String>) -> Option<Vec<String>> {
    if let Some(first) = path.iter().position(|n| n == name) {
        return Some(path[first..].to_vec());
    }
    path.push(name.to_owned());
    let found = graph
        .get(name)
        .into_iter()
        .flatten()
        .find_map(|next| cycle(graph, next, path));
    path.pop();
    found
}

#[test]
fn no_file_imports_one_that_imports_it_back() {
    let mut graph = Graph::new();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    read(&source, "", &mut graph);
    let edges: usize = graph
        .values()
        .flatten()
        .filter(|to| graph.contains_key(*to))
        .count();
    println!("{} files, {edges} imports", graph.len());
    assert!(graph.len() > 30 && edges > 100, "the sources were not read");
    for name in graph.keys() {
        assert_eq!(cycle(&graph, name, &mut vec![]), None);
    }
}

/// The test above sees a cycle where there is one.
#[test]
fn a_cycle_is_found() {
    let graph: Graph = [
        ("a", "use crate::b::x;"),
        ("b", "use crate::{c, d};"),
        ("c", "use crate::a;"),
    ]
    .map(|(name, code)| (name.to_owned(), imports(code, "")))
    .into();
    assert!(cycle(&graph, "a", &mut vec![]).is_some());
}
