//! The catalogue of generated models. Everything below is deterministic: fixed seeds and arithmetic that is the
//! same on every platform (see [`det`]).

mod anatomy;
mod bones;
mod crowd;
mod det;
mod erosion;
mod gear;
mod gearbox;
mod glb;
mod gltf_json;
mod hand;
mod loft;
mod mesh;
mod nets;
mod noise;
mod paint;
mod planet;
mod shapes;
mod small;
mod solids;
mod terrain;
mod village;

/// One generated file.
pub struct Generated {
    pub name: &'static str,
    pub bytes: Vec<u8>,
}

/// All generated files, in a fixed order.
pub fn all() -> Vec<Generated> {
    let mut files = vec![
        Generated { name: "planet.glb", bytes: planet::planet() },
        Generated { name: "gearbox.glb", bytes: gearbox::gearbox() },
        Generated { name: "hand.glb", bytes: hand::skin() },
        Generated { name: "hand-bones.glb", bytes: bones::skeleton() },
        Generated { name: "solids.glb", bytes: solids::solids() },
        Generated { name: "crowd.glb", bytes: crowd::crowd() },
    ];
    files.extend(terrain::terrain());
    files.extend(small::all());
    files
}
