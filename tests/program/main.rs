//! The program as a user calls it: what it writes, what it says, and how it ends.

mod call;
mod check;
mod explain;
mod pick;
mod render;
mod texts;
mod usage;
mod views;
