//! What the README and the page of published lenses show is true: the spec is valid, and the files they name are there.

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

/// What a page's links and pictures name.
fn links(page: &str) -> Vec<&str> {
    page.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect()
}

#[test]
fn every_file_that_the_readme_names_is_there() {
    let readme = readme();
    let links = links(&readme);
    assert!(links.len() >= 5, "the README shows pictures");
    for link in links {
        let file = link.split('#').next().unwrap_or_default();
        assert!(Path::new(file).exists(), "{link} is missing");
    }
}

#[test]
fn the_page_of_published_lenses_shows_each_of_them() {
    let folder = Path::new("lens-specs/published");
    let page = std::fs::read_to_string(folder.join("README.md")).expect("the page is there");
    let mut named = links(&page);
    named.sort_unstable();
    let entries = std::fs::read_dir(folder).expect("the folder is there");
    let files = entries.map(|entry| entry.expect("a readable folder").file_name().to_string_lossy().into_owned());
    let mut there: Vec<String> = files.filter(|file| file != "README.md").collect();
    there.sort_unstable();
    assert_eq!(named, there, "each spec and each picture once");
}
