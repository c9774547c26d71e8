// Enlarges what is inside by `factor` about `center`, a point in the shape's space (the lens's own centre unless given).
// Below 1 it is a miniature of what lies around. Lenses below are magnified with what they act on; what is shown ends at the
// lens's boundary.
