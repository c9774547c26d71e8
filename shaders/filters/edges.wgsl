// Draws lines where what is seen breaks off: silhouettes, where the depth jumps; creases, where the normal turns; and the
// borders between regions of lenses and between the caps of different nodes. `width` in pixels; `threshold` says what
// counts, from 0 (everything) to 1: a crease turns the normal so far that its cosine falls by that much, and a silhouette
// jumps by a tenth of that share of the picture's height. A line lies on the nearer of the two surfaces, within the lens.
