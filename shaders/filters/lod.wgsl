// Shows a simplified version of the meshes: so coarse that `ratio` of their triangles are left, borders where they were. More
// are left where fewer would be off by 5 % of a mesh's size; `check` says how many where it is much more. Of several lenses
// the highest that acts decides, and 1 is the whole mesh again: a focus in a coarse context. What `show` brings in is
// simplified by filters after it and lenses above. No gap opens at a lens's boundary: there the whole mesh fills in where
// the simplified one does not reach.
