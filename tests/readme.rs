//! What the README shows is true: its spec is valid, and the files it names are there.

use std::path::Path;

use lenspeel::plan::{Account, Plan};
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;

fn readme() -> String {
    std::fs::read_to_string("README.md").expect("the README is there")
}

#[test]
fn the_example_spec_is_good_and_decided() {
    let readme = readme();
    let spec =
        readme.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("the README has a spec");
    let spec = Spec::parse(spec, "README.md", Path::new("lens-specs")).expect("the README's spec parses");
    let scene = Scene::open(&spec).expect("the README's models open");
    let plan = Plan::new(&spec, &scene).expect("the README's spec is valid");
    let account = Account::new(&spec, &plan);
    assert_eq!(plan.warnings, Vec::<String>::new());
    assert_eq!(account.undecided, []);
    let overlap = account.regions.iter().any(|region| region.set.len() > 1);
    assert!(overlap, "the README's lenses overlap");
}

#[test]
fn every_file_that_the_readme_names_is_there() {
    let readme = readme();
    let links: Vec<&str> = readme.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert!(links.len() >= 5, "the README shows pictures");
    for link in links {
        assert!(Path::new(link).exists(), "{link} is missing");
    }
}
