//! The resolution of lenses into orders and stacks, against a brute-force reading of SEMANTICS sections 3 to 5.

mod case;
mod commuting;
mod cycles;
mod order;
#[path = "../support/random.rs"]
mod random;
mod reasons;
mod resolve;
mod worlds;
