//! Ratios between contenders, held against what they should be.

use std::fmt;

use serde_json::{Value, json};

use super::Measured;

/// What a ratio should be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bar {
    AtMost(f64),
    AtLeast(f64),
}

/// A ratio between the frames of two contenders, by their names.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    pub name: String,
    pub of: String,
    pub to: String,
    /// Where there is none, the ratio is only told.
    pub bar: Option<Bar>,
}

/// A case and what came out.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    pub case: Case,
    pub ratio: f64,
}

impl Bar {
    pub fn is_met(self, ratio: f64) -> bool {
        match self {
            Bar::AtMost(most) => ratio <= most,
            Bar::AtLeast(least) => ratio >= least,
        }
    }
}

impl fmt::Display for Bar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Bar::AtMost(most) => write!(f, "at most {most:.2}"),
            Bar::AtLeast(least) => write!(f, "at least {least:.2}"),
        }
    }
}

impl Verdict {
    /// `None` where a contender of the case was not measured.
    pub fn new(case: &Case, measured: &[Measured]) -> Option<Self> {
        let find = |name: &str| measured.iter().find(|m| m.name == name);
        Some(Self { case: case.clone(), ratio: find(&case.of)?.ratio_to(find(&case.to)?) })
    }

    fn outcome(&self) -> &'static str {
        match self.case.bar.map(|bar| bar.is_met(self.ratio)) {
            None => "",
            Some(true) => "met",
            Some(false) => "missed",
        }
    }
}

/// Two tables in Markdown: the ratios, then what frames took.
pub fn text(verdicts: &[Verdict], measured: &[Measured]) -> String {
    let mut text = String::from("| case | ratio | bar | |\n|---|---|---|---|\n");
    for verdict in verdicts {
        let bar = verdict.case.bar.map(|bar| bar.to_string()).unwrap_or_default();
        text += &format!("| {} | {:.2} | {bar} | {} |\n", verdict.case.name, verdict.ratio, verdict.outcome());
    }
    text += "\n| frames | median ms |\n|---|---|\n";
    for m in measured {
        text += &format!("| {} | {:.1} |\n", m.name, 1e3 * m.median());
    }
    text
}

/// The same, with every single frame.
pub fn json(verdicts: &[Verdict], measured: &[Measured]) -> Value {
    let case = |verdict: &Verdict| {
        let (at_most, at_least) = match verdict.case.bar {
            None => (None, None),
            Some(Bar::AtMost(most)) => (Some(most), None),
            Some(Bar::AtLeast(least)) => (None, Some(least)),
        };
        json!({
            "case": verdict.case.name,
            "of": verdict.case.of,
            "to": verdict.case.to,
            "ratio": verdict.ratio,
            "at_most": at_most,
            "at_least": at_least,
            "met": verdict.case.bar.map(|bar| bar.is_met(verdict.ratio)),
        })
    };
    let frames = |m: &Measured| {
        let stages: serde_json::Map<String, Value> =
            m.stages().into_iter().map(|(name, seconds)| (name.to_string(), json!(seconds))).collect();
        let rounds: Vec<f64> = m.samples.iter().map(|sample| sample.seconds).collect();
        json!({ "name": m.name, "seconds": m.median(), "stages": stages, "rounds": rounds })
    };
    json!({
        "cases": verdicts.iter().map(case).collect::<Vec<_>>(),
        "frames": measured.iter().map(frames).collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Sample;

    fn measured(name: &str, seconds: f64) -> Measured {
        Measured { name: name.into(), samples: vec![Sample::from(seconds)] }
    }

    fn case(of: &str, to: &str, bar: Option<Bar>) -> Case {
        Case { name: format!("{of} by {to}"), of: of.into(), to: to.into(), bar }
    }

    #[test]
    fn ratios_are_held_against_their_bars() {
        let frames = [measured("plain", 2.0), measured("lens", 2.5)];
        let cases = [
            case("lens", "plain", Some(Bar::AtMost(1.2))),
            case("lens", "plain", Some(Bar::AtLeast(1.25))),
            case("plain", "lens", None),
        ];
        let verdicts: Vec<Verdict> = cases.iter().filter_map(|case| Verdict::new(case, &frames)).collect();
        let text = text(&verdicts, &frames);
        for line in [
            "| lens by plain | 1.25 | at most 1.20 | missed |",
            "| lens by plain | 1.25 | at least 1.25 | met |",
            "| plain by lens | 0.80 |  |  |",
            "| lens | 2500.0 |",
        ] {
            assert!(text.lines().any(|l| l == line), "{line}: {text}");
        }
        let json = json(&verdicts, &frames);
        assert_eq!(json["cases"][0]["met"], false);
        assert_eq!(json["cases"][2]["met"], Value::Null);
        assert_eq!(json["frames"][1]["rounds"], json!([2.5]));
    }

    #[test]
    fn a_case_without_its_contenders_has_no_verdict() {
        assert_eq!(Verdict::new(&case("lens", "plain", None), &[measured("lens", 1.0)]), None);
    }
}
