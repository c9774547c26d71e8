// Enlarges what is inside by `factor` about `center`, a point in the shape's space (the lens's own centre unless given).
// Below 1 it is a miniature of what lies around. Lenses below are magnified with what they act on; what is shown ends at the
// lens's boundary. So `center` belongs on what is looked at: of a surface that passes it by, as the ground below the middle of
// a ball, the part that would be seen at the lens's rim is carried out of the lens, and the rim shows what lies behind. A flat
// lens without `center` enlarges what is seen through it, about the line from the eye through its middle; depths stay, and it
// has no such rim.
