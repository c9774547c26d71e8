//! Measuring frames against each other on a machine that may be busy: every round draws each contender once, in
//! turn, so that a drift of the machine's speed touches all of them, and only ratios within a round count.

mod table;

pub use table::{Bar, Case, Verdict, json, text};

/// Something that draws frames.
pub struct Contender<'a, E> {
    pub name: String,
    draw: Box<dyn FnMut() -> Result<Sample, E> + 'a>,
}

/// One frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sample {
    /// Of the whole frame.
    pub seconds: f64,
    /// Of its stages, where they are told apart; every frame of a contender has the same ones.
    pub stages: Vec<(&'static str, f64)>,
}

/// What a contender's frames took, one a round.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Measured {
    pub name: String,
    pub samples: Vec<Sample>,
}

impl<'a, E> Contender<'a, E> {
    /// `draw` draws one frame, waits for it, and says how long it took.
    pub fn new(name: impl Into<String>, draw: impl FnMut() -> Result<Sample, E> + 'a) -> Self {
        Self { name: name.into(), draw: Box::new(draw) }
    }
}

impl From<f64> for Sample {
    fn from(seconds: f64) -> Self {
        Self { seconds, stages: Vec::new() }
    }
}

/// Draws every contender once a round, each round beginning with another one, and one round more before all others
/// that does not count: it compiles pipelines and fills caches. `progress` is told each round that is done, that one
/// as 0.
pub fn interleaved<E>(
    contenders: &mut [Contender<'_, E>],
    rounds: usize,
    mut progress: impl FnMut(usize),
) -> Result<Vec<Measured>, E> {
    let empty = |contender: &Contender<'_, E>| Measured { name: contender.name.clone(), samples: Vec::new() };
    let mut measured: Vec<Measured> = contenders.iter().map(empty).collect();
    let count = contenders.len();
    for round in 0..=rounds {
        for place in 0..count {
            let turn = (place + round) % count;
            let sample = (contenders[turn].draw)()?;
            if round > 0 {
                measured[turn].samples.push(sample);
            }
        }
        progress(round);
    }
    Ok(measured)
}

impl Measured {
    /// Median seconds of a frame.
    pub fn median(&self) -> f64 {
        median(self.samples.iter().map(|sample| sample.seconds))
    }

    /// Median seconds of each stage.
    pub fn stages(&self) -> Vec<(&'static str, f64)> {
        let names = self.samples.first().map_or(&[][..], |sample| &sample.stages);
        let of = |stage: usize| median(self.samples.iter().map(|sample| sample.stages[stage].1));
        names.iter().enumerate().map(|(stage, (name, _))| (*name, of(stage))).collect()
    }

    /// Median over the rounds of this one's seconds by another's.
    pub fn ratio_to(&self, other: &Measured) -> f64 {
        median(self.samples.iter().zip(&other.samples).map(|(a, b)| a.seconds / b.seconds))
    }
}

/// The middle value, or the mean of the two in the middle; NaN of none.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    match (sorted.len(), sorted.len() / 2) {
        (0, _) => f64::NAN,
        (count, middle) if count % 2 == 1 => sorted[middle],
        (_, middle) => 0.5 * (sorted[middle - 1] + sorted[middle]),
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::convert::Infallible;

    use super::*;

    fn measured(name: &str, seconds: &[f64]) -> Measured {
        Measured { name: name.into(), samples: seconds.iter().map(|s| Sample::from(*s)).collect() }
    }

    #[test]
    fn every_round_draws_all_and_begins_with_another_one() {
        let order = RefCell::new(String::new());
        let contender = |name: &'static str| {
            let order = &order;
            Contender::<Infallible>::new(name, move || {
                order.borrow_mut().push_str(name);
                Ok(Sample::from(order.borrow().len() as f64))
            })
        };
        let mut contenders = ["a", "b", "c"].map(contender);
        let mut rounds = Vec::new();
        let Ok(measured) = interleaved(&mut contenders, 3, |round| rounds.push(round));
        assert_eq!(*order.borrow(), "abcbcacababc");
        assert_eq!(rounds, [0, 1, 2, 3]);
        let seconds = |m: &Measured| m.samples.iter().map(|s| s.seconds).collect::<Vec<_>>();
        assert_eq!(
            measured.iter().map(seconds).collect::<Vec<_>>(),
            [[6.0, 8.0, 10.0], [4.0, 9.0, 11.0], [5.0, 7.0, 12.0]]
        );
    }

    #[test]
    fn the_first_failure_ends_the_run() {
        let mut contenders = [Contender::new("a", || Err::<Sample, _>("no frame"))];
        assert_eq!(interleaved(&mut contenders, 2, |_| ()), Err("no frame"));
    }

    #[test]
    fn ratios_are_taken_within_rounds() {
        // The machine became three times slower after the first round.
        let (a, b) = (measured("a", &[2.0, 6.0, 6.0]), measured("b", &[1.0, 3.0, 3.3]));
        assert_eq!((a.ratio_to(&b), a.median()), (2.0, 6.0));
        assert_eq!(measured("c", &[4.0, 1.0]).median(), 2.5);
    }

    #[test]
    fn stages_have_medians_of_their_own() {
        let sample = |draw, finish| Sample { seconds: draw + finish, stages: vec![("draw", draw), ("finish", finish)] };
        let m = Measured { name: "m".into(), samples: vec![sample(1.0, 9.0), sample(2.0, 7.0), sample(8.0, 8.0)] };
        assert_eq!(m.stages(), [("draw", 2.0), ("finish", 8.0)]);
    }
}
