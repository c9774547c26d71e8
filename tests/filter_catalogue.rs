//! The filter catalogue against the reader: what it promises is what the reader takes.

use std::path::Path;

use lenspeel::appearance::FILTERS as FILES;
use lenspeel::cli::{filter_text, filters_markdown, filters_text};
use lenspeel::spec::catalogue::{FILTERS, FilterRow, Param, ParamDefault, ParamKind};
use lenspeel::spec::{Filter, Spec};

/// The filter that a lens with this `filters` entry has, or why it has none.
fn read(entry: &str) -> Result<Filter, String> {
    let text = format!(
        "[scene]\nfile = \"a.glb\"\n[scene.alternates]\nbones = \"b.glb\"\n[[lens]]\nname = \"a\"\n\
         shape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nfilters = [{entry}]\n"
    );
    let spec = Spec::parse(&text, "spec.toml", Path::new("")).map_err(|error| error.to_string())?;
    Ok(spec.lenses[0].filters[0].value.clone())
}

/// The parameter's default as the file would write it, if it is a value.
fn written_default(param: &Param) -> Option<String> {
    match param.default {
        ParamDefault::Number(value) => Some(value.to_string()),
        ParamDefault::Color(text) | ParamDefault::Text(text) => Some(format!("\"{text}\"")),
        ParamDefault::Bool(value) => Some(value.to_string()),
        ParamDefault::Meaning(_) | ParamDefault::Required => None,
    }
}

/// A value that the parameter takes.
fn example(param: &Param) -> String {
    written_default(param).unwrap_or_else(|| match param.kind {
        ParamKind::Number(range) => {
            let inside = [0.5, 2.0].into_iter().find(|x| range.contains(*x));
            inside.unwrap_or_else(|| panic!("{}: give an example that is {range}", param.name)).to_string()
        }
        ParamKind::Integer(min, _) => min.to_string(),
        ParamKind::NumberOrPair(_) => "[1, 2]".to_owned(),
        ParamKind::Interval => "[0, 1]".to_owned(),
        ParamKind::Vector => "[1, 2, 3]".to_owned(),
        ParamKind::Color => "\"orange\"".to_owned(),
        ParamKind::Bool => "true".to_owned(),
        ParamKind::Text => "\"bones\"".to_owned(),
        ParamKind::File => "\"map.png\"".to_owned(),
        ParamKind::Choice(words) => format!("\"{}\"", words[0]),
        ParamKind::ColorMap => "\"magma-r\"".to_owned(),
        ParamKind::Patterns => "[\"Bolt*\"]".to_owned(),
        ParamKind::Outline => "{ width = 2, color = \"orange\" }".to_owned(),
        ParamKind::Cap => "\"hatch\"".to_owned(),
        ParamKind::FreeTable => "{ anything = 1 }".to_owned(),
    })
}

fn table(row: &FilterRow, params: &[&Param], write: impl Fn(&Param) -> Option<String>) -> String {
    let pairs: Vec<String> =
        params.iter().filter_map(|param| Some(format!("{} = {}", param.name, write(param)?))).collect();
    format!("{{ {} = {{ {} }} }}", row.name, pairs.join(", "))
}

/// Parameters, all of which may be written together.
fn usable(row: &FilterRow) -> Vec<&'static Param> {
    row.params.iter().collect()
}

#[test]
fn filters_read_as_bare_names_and_as_tables_of_their_defaults() {
    for row in FILTERS.iter().filter(|row| row.stands_alone()) {
        let bare = read(&format!("\"{}\"", row.name)).unwrap_or_else(|error| panic!("{}: {error}", row.name));
        let written = read(&table(row, &usable(row), written_default)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(bare, written, "{}: the written defaults differ from those left out", row.name);
        let empty = read(&format!("{{ {} = {{}} }}", row.name)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(bare, empty, "{}", row.name);
    }
}

#[test]
fn filters_read_with_every_parameter() {
    for row in FILTERS {
        let entry = table(row, &usable(row), |param| Some(example(param)));
        read(&entry).unwrap_or_else(|error| panic!("{entry}: {error}"));
    }
}

#[test]
fn numbers_out_of_range_are_refused() {
    for row in FILTERS {
        for param in row.params {
            let ParamKind::Number(range) = param.kind else { continue };
            for outside in [range.min.map(|min| min - 1.0), range.max.map(|max| max + 1.0), Some(f64::NAN)] {
                let Some(value) = outside else { continue };
                let entry = table(row, &[param], |_| Some(value.to_string().to_lowercase()));
                let error = read(&entry).expect_err(&entry);
                assert!(error.contains(&format!("`{}` must be", param.name)), "{entry}: {error}");
            }
        }
    }
}

#[test]
fn names_are_unique() {
    for (i, row) in FILTERS.iter().enumerate() {
        assert!(FILTERS[..i].iter().all(|other| other.name != row.name), "{} is listed twice", row.name);
        for (j, param) in row.params.iter().enumerate() {
            assert!(row.params[..j].iter().all(|other| other.name != param.name), "{}.{}", row.name, param.name);
        }
    }
}

#[test]
fn the_listing_is_as_recorded() {
    insta::assert_snapshot!(filters_text());
}

/// The page beside the pictures. `LENSPEEL_UPDATE_GOLDENS=1` writes it.
#[test]
fn the_page_of_filters_is_up_to_date_and_its_pictures_are_there() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("lens-specs/filters/README.md");
    let page = filters_markdown();
    if std::env::var_os("LENSPEEL_UPDATE_GOLDENS").is_some_and(|value| value == "1") {
        std::fs::write(&path, &page).expect("a writable folder");
    }
    let written = std::fs::read_to_string(&path).expect("the page is part of the project");
    assert!(written == page, "write it with LENSPEEL_UPDATE_GOLDENS=1 cargo test --test filter_catalogue");
    let links = page.split("](").skip(1).filter_map(|part| part.split(')').next());
    for picture in links.filter(|link| !link.starts_with('#')) {
        assert!(path.with_file_name("").join(picture).is_file(), "{picture}");
    }
}

#[test]
fn every_filter_has_a_file_that_documents_it() {
    for row in FILTERS {
        let file =
            FILES.iter().find(|file| file.name == row.name).unwrap_or_else(|| panic!("{} has no file", row.name));
        assert!(file.text.len() > 40 && file.text.ends_with('.'), "{}: {}", row.name, file.text);
        let text = filter_text(row.name).expect("it is a filter");
        assert!(text.contains(row.help) && text.contains(file.text), "{text}");
    }
    assert_eq!(FILES.len(), FILTERS.len(), "and no file stands for none");
}
