//! Depth intervals of lens volumes by independent routes, and the layers they cut a ray into.

mod agreement;
mod camera;
mod edges;
mod facets;
mod layers;
#[path = "../support/random.rs"]
mod random;
mod rects;
mod routes;
mod solid;
