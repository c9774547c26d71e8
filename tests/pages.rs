//! The pages of the format and of its meaning: their lists are what the program prints, their examples are good, and what
//! the code cites is there.

use std::fs;
use std::path::{Path, PathBuf};

use lenspeel::cli::{filters_index, keys_markdown, shapes_markdown, shapes_text};
use lenspeel::plan::{Account, Plan};
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;
use lenspeel::spec::catalogue::SHAPES;

const FORMAT: &str = "lens-specs/README.md";
const MEANING: &str = "lens-specs/SEMANTICS.md";

fn page(path: &str) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// `LENSPEEL_UPDATE_GOLDENS=1` writes the lists anew.
#[test]
fn the_lists_of_the_page_are_what_the_program_prints() {
    let written = page(FORMAT);
    let mut page = written.clone();
    for (command, list) in [
        ("lenspeel schema --markdown", keys_markdown()),
        ("lenspeel shapes --markdown", shapes_markdown()),
        ("lenspeel filters --markdown", filters_index("filters/README.md")),
    ] {
        let head = format!("<!-- {command} -->\n");
        let start = page.find(&head).unwrap_or_else(|| panic!("{FORMAT} has no {head}")) + head.len();
        let end = start + page[start..].find("<!-- end -->").expect("a list ends");
        page.replace_range(start..end, &format!("\n{list}\n"));
    }
    if std::env::var_os("LENSPEEL_UPDATE_GOLDENS").is_some_and(|value| value == "1") {
        fs::write(FORMAT, &page).expect("a writable folder");
        return;
    }
    assert!(written == page, "write it with LENSPEEL_UPDATE_GOLDENS=1 cargo test --test pages");
}

/// Blocks of TOML in a page: the word behind `toml`, the line, and the text.
fn examples(page: &str) -> Vec<(String, usize, String)> {
    let mut found = Vec::new();
    let mut lines = page.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        let Some(word) = line.strip_prefix("```toml") else { continue };
        let text: Vec<&str> = lines.by_ref().map(|(_, line)| line).take_while(|line| *line != "```").collect();
        found.push((word.trim().to_owned(), number + 1, text.join("\n") + "\n"));
    }
    found
}

/// What `check` has to say of a spec.
fn check(text: &str, name: &str, folder: &Path) -> Result<Vec<String>, String> {
    let decide = || {
        let spec = Spec::parse(text, name, folder)?;
        let scene = Scene::open(&spec)?;
        let plan = Plan::new(&spec, &scene)?;
        let undecided = Account::new(&spec, &plan).undecided.into_iter().map(|pair| pair.remedy);
        Ok(plan.warnings.iter().cloned().chain(undecided).collect())
    };
    decide().map_err(|error: lenspeel::InputError| error.to_string())
}

/// Blocks are whole specs; `lens`: a lens, or the keys of one; `refused`: what is refused until it is built.
#[test]
fn every_example_of_the_pages_is_good() {
    const SCENE: &str = "[scene]\nfile = \"models/gearbox.glb\"\n";
    let pages = [FORMAT, MEANING, "lens-specs/filters/README.md", "lens-specs/wgsl/README.md"];
    let mut kinds = Vec::new();
    for path in pages {
        for (word, line, text) in examples(&page(path)) {
            let place = format!("{path}:{line}");
            let whole = match word.as_str() {
                "lens" if text.contains("[[lens]]") => format!("{SCENE}{text}"),
                "lens" => format!("{SCENE}[[lens]]\nname = \"example\"\n{text}"),
                "refused" => format!("{SCENE}{text}"),
                _ => text,
            };
            let found = check(&whole, &place, Path::new("lens-specs"));
            if word == "refused" {
                let error = found.expect_err(&place);
                assert!(error.contains("not built yet"), "{error}");
            } else {
                assert_eq!(found, Ok(Vec::new()), "{place}");
            }
            kinds.push(word);
        }
    }
    for (word, least) in [("", 3), ("lens", 6), ("refused", 1)] {
        assert!(kinds.iter().filter(|kind| *kind == word).count() >= least, "examples that are `{word}`");
    }
}

/// The text of section `n`, or of its point `m`.
fn section(page: &str, section: usize, point: Option<usize>) -> Option<&str> {
    let (_, rest) = page.split_once(&format!("\n## {section} "))?;
    let text = rest.split("\n## ").next()?;
    match point {
        None => Some(text),
        Some(point) => text.split(&format!("\n{point}. ")).nth(1),
    }
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a readable folder").map(|entry| entry.expect("an entry").path()) {
        let is_text = entry.extension().is_some_and(|end| end == "rs" || end == "wgsl" || end == "toml" || end == "md");
        if entry.is_dir() {
            files(&entry, found);
        } else if is_text {
            found.push(entry);
        }
    }
}

/// Numbers as in "section 3", "sections 3 to 5", "6.6" behind a word.
fn cited(text: &str) -> Option<(usize, Option<usize>)> {
    let text = text.trim_start_matches([' ', ',']);
    let text = text.strip_prefix("sections ").or(text.strip_prefix("section ")).unwrap_or(text);
    let number: String = text.chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
    let mut parts = number.trim_end_matches('.').split('.').map(str::parse);
    Some((parts.next()?.ok()?, parts.next().and_then(Result::ok)))
}

#[test]
fn every_section_that_the_project_cites_is_there() {
    let meaning = page(MEANING);
    let mut paths = Vec::new();
    ["src", "shaders", "tests", "benches", "examples", "lens-specs"]
        .iter()
        .for_each(|f| files(Path::new(f), &mut paths));
    let mut count = 0;
    for path in paths {
        let text = fs::read_to_string(&path).unwrap_or_default();
        for (number, point) in text.split("SEMANTICS").skip(1).filter_map(cited) {
            let place = format!("{} cites section {number} {point:?}", path.display());
            assert!(section(&meaning, number, point).is_some(), "{place}, which is not there");
            count += 1;
        }
    }
    assert!(count > 20, "only {count} citations");
    assert!(section(&meaning, 8, None).is_none() && section(&meaning, 2, Some(40)).is_none());
}

/// Files and folders beside a page that its links name.
#[test]
fn every_link_of_the_pages_leads_somewhere() {
    for path in [FORMAT, MEANING] {
        let page = page(path);
        let links: Vec<&str> = page.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
        assert!(!links.is_empty());
        for link in links.into_iter().filter(|link| !link.starts_with("http")) {
            let file = link.split('#').next().unwrap_or_default();
            assert!(Path::new("lens-specs").join(file).exists(), "{path}: {link}");
        }
    }
}

#[test]
fn the_listing_of_shapes_is_as_recorded() {
    insta::assert_snapshot!(shapes_text());
    for row in SHAPES {
        let text = lenspeel::cli::shape_text(row.name).expect("it is a shape");
        assert!(row.keys.iter().all(|key| text.contains(key)), "{text}");
    }
    let error = lenspeel::cli::shape_text("half-space").expect_err("no such shape").to_string();
    assert!(error.contains("did you mean `halfspace`?"), "{error}");
}
