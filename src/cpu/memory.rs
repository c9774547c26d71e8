//! Whether drawing a plan fits into memory.

use super::Error;
use crate::plan::Plan;
use crate::scene::Scene;

/// Bytes a triangle, at the peak of building the hierarchy: measured at 15 million copies of a mesh.
const TRIANGLE_BYTES: u64 = 300;

/// Refuses what would take more memory than the scene's budget leaves. The CPU copies the triangles of each node, and of
/// each place where lenses show it, however many share a mesh.
pub fn check_memory(scene: &Scene, plan: &Plan) -> Result<(), Error> {
    let of_instance = |instance: usize| u64::from(plan.items[plan.instances[instance].item].triangles);
    let shown: u64 = (0..plan.instances.len()).map(of_instance).sum();
    let cut: u64 = plan.bodies.iter().flat_map(|body| &body.members).map(|member| of_instance(member.instance)).sum();
    let triangles = shown + cut;
    let bytes = triangles.saturating_mul(TRIANGLE_BYTES);
    if bytes <= scene.budget.left() {
        return Ok(());
    }
    let stored: usize =
        scene.models.iter().flat_map(|m| &m.meshes).flat_map(|m| &m.primitives).map(|p| p.triangles.len()).sum();
    let what = format!("the picture on the CPU, of {triangles} triangles ({stored} in the files, nodes copy them)");
    Err(Error::TooLarge(scene.budget.refusal(bytes, &what).message))
}
