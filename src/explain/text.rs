//! The account as text, with the lines of the spec.

use std::fmt::{self, Display, Formatter};

use super::{Coverage, Explanation, actor, lenses};
use crate::frame::InFront;
use crate::plan::{Account, Plan, Reasons, Region};
use crate::spec::Spec;

impl Account {
    /// The account as text, with the lines of the spec.
    pub fn text(&self, spec: &Spec, plan: &Plan) -> String {
        Explanation::new(spec, plan, self).to_string()
    }

    /// One paragraph a pair, or nothing.
    pub fn undecided_text(&self) -> String {
        self.undecided
            .iter()
            .map(|u| {
                format!("undecided: only the order of the file puts {} below {}: {}\n", u.below, u.above, u.remedy)
            })
            .collect()
    }
}

impl Display for Explanation<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.write_order(f)?;
        match &self.coverage {
            Some(coverage) => self.write_table(coverage, f)?,
            None => self.write_regions(f)?,
        }
        f.write_str(&self.account.undecided_text())?;
        self.plan.warnings.iter().try_for_each(|warning| writeln!(f, "warning: {warning}"))
    }
}

impl Explanation<'_> {
    fn write_order(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { spec, plan, account, .. } = self;
        writeln!(f, "order, lowest first")?;
        for (rank, lens) in plan.lenses.iter().enumerate() {
            let place = spec.source.spot(spec.lenses[lens.index].name.span.start);
            let filters: Vec<&str> = lens.filter_names().collect();
            write!(f, "  {}. {} ({place}): {}", rank + 1, lens.name, filters.join(", "))?;
            if lens.overrides {
                write!(f, "; overrides all below")?;
            } else if !lens.hides.is_empty() {
                write!(f, "; hides {}", plan.names(lens.hides).join(", "))?;
            }
            writeln!(f)?;
            if rank > 0 {
                writeln!(f, "       above {}: {}", plan.lenses[rank - 1].name, account.order[rank - 1])?;
            }
            if let Some(coverage) = &self.coverage {
                writeln!(f, "       in view: {}", in_view_text(coverage, rank))?;
            }
        }
        if plan.lenses.is_empty() {
            writeln!(f, "  no lens is enabled")?;
        }
        Ok(())
    }

    fn write_regions(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "regions that occur: {}", self.count())?;
        let reasons = Reasons::new(self.spec, self.plan);
        for (_, region) in &self.regions {
            writeln!(f, "  {}", lenses(self.plan, region))?;
            self.write_actors(region, &reasons, "      ", f)?;
        }
        self.write_rest("  ", f)
    }

    /// How many regions occur, as far as is known.
    fn count(&self) -> String {
        let count = self.regions.len() + self.untold;
        if self.account.ended.is_some() { format!("at least {count}") } else { count.to_string() }
    }

    /// What is not listed.
    fn write_rest(&self, indent: &str, f: &mut Formatter<'_>) -> fmt::Result {
        if self.untold > 0 {
            let where_not = if self.coverage.is_some() { ", none of them in view" } else { "" };
            writeln!(f, "{indent}and {} more{where_not}", self.untold)?;
        }
        self.account.ended.map_or(Ok(()), |ended| writeln!(f, "{indent}{ended}"))
    }

    /// The regions with their numbers and their shares of a picture, in columns.
    fn write_table(&self, coverage: &Coverage, f: &mut Formatter<'_>) -> fmt::Result {
        let [width, height] = coverage.size;
        let by = &coverage.backend;
        writeln!(f, "regions that occur: {}; shares of the picture's {width} x {height} pixels ({by})", self.count())?;
        writeln!(f, "  id        share  lenses")?;
        let reasons = Reasons::new(self.spec, self.plan);
        for (id, region) in &self.regions {
            let through = match coverage.seen_through(region) {
                0 => String::new(),
                pixels => format!("; seen through in {}", share_text(coverage, pixels)),
            };
            let share = match coverage.pixels(region) {
                0 if !through.is_empty() => "-".into(),
                pixels => share_text(coverage, pixels),
            };
            writeln!(f, "{id:>4}  {share:>11}  {}{through}", lenses(self.plan, region))?;
            self.write_actors(region, &reasons, "                   ", f)?;
        }
        for (id, pixels, what) in
            [("0", coverage.pixels(&Region::PLAIN), "outside all lenses"), ("-", coverage.nothing, "nothing is there")]
        {
            writeln!(f, "{id:>4}  {:>11}  {what}", share_text(coverage, pixels))?;
        }
        self.write_rest("                   ", f)
    }

    /// The stack of a region, who is hidden, and why.
    fn write_actors(&self, region: &Region, reasons: &Reasons, indent: &str, f: &mut Formatter<'_>) -> fmt::Result {
        let acting = |rank: usize| {
            let filters: Vec<&str> = self.plan.filter_names(rank).collect();
            format!("{} ({})", actor(self.plan, rank), filters.join(", "))
        };
        let stack: Vec<String> = region.stack.iter().map(acting).collect();
        writeln!(f, "{indent}stack: {}", stack.join(" < "))?;
        f.write_str(&reasons.lines(region, indent))
    }
}

/// What a lens does in a picture, in shares of its pixels.
fn in_view_text(coverage: &Coverage, rank: usize) -> String {
    let InFront { removes, seen_through, .. } = &coverage.in_front;
    let parts = [
        ("acts on what is visible in", coverage.acts(rank)),
        ("on what is seen through in", seen_through[rank]),
        ("takes something away in", removes[rank]),
    ];
    let parts: Vec<String> = parts
        .into_iter()
        .filter(|(_, pixels)| *pixels > 0)
        .map(|(what, pixels)| format!("{what} {}", share_text(coverage, pixels)))
        .collect();
    if parts.is_empty() { "it does nothing".into() } else { parts.join(", ") }
}

fn share_text(coverage: &Coverage, pixels: u64) -> String {
    match coverage.percent(pixels) {
        _ if pixels == 0 => "not in view".into(),
        percent if percent < 0.005 => "< 0.01 %".into(),
        percent => format!("{percent:.2} %"),
    }
}
