// Shows a simplified version of the meshes: so coarse that `ratio` of their triangles are left.
