//! Picking: what is visible at a pixel, read from the maps or found by the code that makes them.

use glam::{DVec3, Vec3};
use serde::Serialize;

use crate::frame::{Aovs, NOTHING};
use crate::output::{Actor, Entry};
use crate::pixel::{Visible, cap_maker};
use crate::plan::{Plan, Region};
use crate::scene::Scene;

/// The visible fragment of a pixel (SEMANTICS 6.4), and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pick {
    /// Into [`Plan::instances`].
    pub instance: u32,
    /// Into the item's triangles; of a cap see [`cap_number`](crate::pixel::cap_number).
    pub triangle: u32,
    /// From the eye along the forward axis, scene units.
    pub depth: f64,
    /// World space.
    pub normal: Vec3,
    pub region: Region,
    /// Where it is shown. World space.
    pub position: DVec3,
    /// Where it stands in the scene; elsewhere than `position` where a lens moves it.
    pub place: DVec3,
}

impl Pick {
    /// What is visible at a pixel (column and row from the top left) of a picture of `plan` with these maps; `None`
    /// where nothing is and outside the picture.
    pub fn from_aovs(plan: &Plan, aovs: &Aovs, pixel: [u32; 2]) -> Option<Self> {
        let at = plan.view.has_pixel(pixel).then(|| (pixel[1] * plan.view.size[0] + pixel[0]) as usize)?;
        Self::from_map(plan, aovs, at, pixel)
    }

    /// The same with the place in the maps given, for maps of a part of the picture.
    pub(crate) fn from_map(plan: &Plan, aovs: &Aovs, at: usize, pixel: [u32; 2]) -> Option<Self> {
        let instance = aovs.instances[at];
        let region = aovs.region(at).filter(|_| instance != NOTHING)?;
        Some(Self::new(plan, pixel, instance, aovs.triangles[at], aovs.depth[at], aovs.normals[at].into(), region))
    }

    /// The visible fragment of a pixel's report.
    pub fn from_visible(plan: &Plan, pixel: [u32; 2], Visible { fragment, normal }: &Visible) -> Self {
        let depth = plan.view.from_eye(f64::from(fragment.depth));
        Self::new(plan, pixel, fragment.instance, fragment.triangle, depth, *normal, fragment.region)
    }

    fn new(
        plan: &Plan,
        pixel: [u32; 2],
        instance: u32,
        triangle: u32,
        depth: f64,
        normal: Vec3,
        region: Region,
    ) -> Self {
        let (position, place) = places(plan, pixel, instance, depth);
        Self { instance, triangle, depth, normal, region, position, place }
    }

    /// With the names that the files and the spec give.
    pub fn named<'a>(&self, scene: &'a Scene, plan: &'a Plan) -> NamedPick<'a> {
        let surface = NamedSurface::new(scene, plan, self.instance, self.triangle, self.region);
        NamedPick { surface, depth: self.depth as f32, position: self.position, place: self.place, normal: self.normal }
    }
}

/// Where the surface that the ray through a pixel's centre meets so far from the eye is shown, and where it stands in the
/// scene.
pub(crate) fn places(plan: &Plan, [x, y]: [u32; 2], instance: u32, depth: f64) -> (DVec3, DVec3) {
    let position = plan.view.ray(f64::from(x) + 0.5, f64::from(y) + 0.5).at(depth - plan.view.anchor.depth);
    (position, plan.instances[instance as usize].place_of(position))
}

/// A [`Pick`] with names, as `lenspeel pick` tells of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NamedPick<'a> {
    #[serde(flatten)]
    pub surface: NamedSurface<'a>,
    pub depth: f32,
    /// Where it is shown, world space.
    pub position: DVec3,
    /// Where it stands in the scene, world space.
    pub place: DVec3,
    /// World space.
    pub normal: Vec3,
}

/// A surface that a ray meets, with names.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NamedSurface<'a> {
    /// The file it comes from.
    pub model: &'a str,
    /// The alternate that the file is; null for the scene.
    pub alternate: Option<&'a str>,
    pub node: Object,
    /// Names from the root to the node itself.
    pub path: Vec<String>,
    /// Of the node's mesh.
    pub primitive: usize,
    /// Null for a cap.
    pub triangle: Option<u32>,
    /// Whose cap it is, where it is one.
    pub cap: Option<Actor>,
    pub material: Object,
    /// The lenses that move it, the highest first.
    pub moved_by: Vec<&'a str>,
    /// The lenses around it, sorted.
    pub lenses: Vec<&'a str>,
    /// What acts on it, lowest first.
    pub stack: Vec<Entry>,
}

/// Something of a glTF file; the name tells the number where the file gives none.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Object {
    pub index: usize,
    pub name: String,
}

impl<'a> NamedSurface<'a> {
    pub fn new(scene: &'a Scene, plan: &'a Plan, instance: u32, triangle: u32, region: Region) -> Self {
        let instance = &plan.instances[instance as usize];
        let item = &plan.items[instance.item];
        let model = &scene.models[item.model];
        let up = std::iter::successors(Some(item.node), |node| model.nodes[*node].parent);
        let mut path: Vec<String> = up.map(|node| model.node_label(node)).collect();
        path.reverse();
        let cap = cap_maker(triangle);
        let material = item.material - scene.material_base[item.model];
        Self {
            model: &model.name,
            alternate: item.model.checked_sub(1).map(|alternate| scene.alternates[alternate].as_str()),
            node: Object { index: item.node, name: model.node_label(item.node) },
            path,
            primitive: item.primitive,
            triangle: cap.is_none().then_some(triangle),
            cap: cap.map(|maker| Actor::of(plan, maker)),
            material: Object { index: material, name: model.material_label(material) },
            moved_by: instance.steps.iter().map(|step| plan.lenses[step.rank].name.as_str()).collect(),
            lenses: plan.names(region.set),
            stack: crate::output::stack(plan, region),
        }
    }
}
