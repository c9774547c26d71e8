//! Vertices in an order by which a fragment can tell its triangle.

/// A primitive's vertices, copied so that its t-th triangle starts at the t-th of them and no other triangle does. A
/// `flat` value of a triangle's first corner, the one that Vulkan, Metal and D3D12 take for it, then names the triangle.
///
/// That costs some memory (a closed mesh has about two triangles a vertex), needs no feature of the adapter, and on a
/// software one spares the assembly of every triangle that the builtin `primitive_index` asks for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Provoking {
    /// Of which vertex each is a copy.
    pub sources: Vec<u32>,
    /// Corners of the triangles, in their old order.
    pub triangles: Vec<[u32; 3]>,
}

impl Provoking {
    /// `vertices`: how many there are.
    pub fn new(vertices: usize, triangles: &[[u32; 3]]) -> Self {
        const NO_COPY: u32 = u32::MAX;
        let mut sources: Vec<u32> = triangles.iter().map(|corners| corners[0]).collect();
        let mut copies = vec![NO_COPY; vertices];
        for (copy, source) in sources.iter().enumerate().rev() {
            copies[*source as usize] = copy as u32;
        }
        for corner in triangles.iter().flat_map(|corners| &corners[1..]) {
            if copies[*corner as usize] == NO_COPY {
                copies[*corner as usize] = sources.len() as u32;
                sources.push(*corner);
            }
        }
        // Of several copies the latest: vertices that have just been transformed are still at hand.
        let renumbered = (0u32..).zip(triangles).map(|(number, corners)| {
            copies[corners[0] as usize] = number;
            [number, copies[corners[1] as usize], copies[corners[2] as usize]]
        });
        let triangles = renumbered.collect();
        Self { sources, triangles }
    }

    /// An attribute of the old vertices, for the new ones.
    pub fn copied<T: Copy>(&self, values: &[T]) -> Vec<T> {
        self.sources.iter().map(|source| values[*source as usize]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan around vertex 0, a strip that runs back, and a triangle without an area.
    const TRIANGLES: [[u32; 3]; 6] = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [3, 2, 5], [5, 2, 1], [4, 4, 0]];

    #[test]
    fn each_triangle_starts_at_its_own_vertex_and_keeps_its_corners() {
        let new = Provoking::new(7, &TRIANGLES);
        for (number, (corners, old)) in new.triangles.iter().zip(&TRIANGLES).enumerate() {
            assert_eq!(corners[0] as usize, number);
            assert_eq!(corners.map(|c| new.sources[c as usize]), *old);
        }
    }

    #[test]
    fn only_vertices_at_which_no_triangle_starts_are_added() {
        let new = Provoking::new(7, &TRIANGLES);
        // Triangles start at 0, 3, 4 and 5; vertex 6 is not used at all.
        assert_eq!(new.sources[TRIANGLES.len()..], [1, 2]);
        assert_eq!(new.copied(&[0.0, 1.5, 2.5, 3.0, 4.0, 5.0, 6.0])[TRIANGLES.len()..], [1.5, 2.5]);
    }
}
