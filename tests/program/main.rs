//! The program as a user calls it: what it writes, what it says, and how it ends.

mod call;
mod check;
mod explain;
mod init;
mod legend;
mod model;
mod names;
mod outputs;
mod pick;
mod render;
mod set;
mod streams;
mod texts;
mod usage;
mod views;
