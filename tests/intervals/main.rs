//! Depth intervals of lens volumes by independent routes, and the layers they cut a ray into.

mod agreement;
mod boxes;
mod camera;
mod compound;
mod edges;
mod facets;
mod inside;
mod layers;
mod mesh;
#[path = "../support/random.rs"]
mod random;
mod rects;
mod routes;
mod solid;
mod unbounded;
