// Takes surfaces away: those of `nodes` and of `materials` that match, or everything. What is erased hides nothing and
// catches no pick. A solid that is cut shows its inside or, with `cap`, is closed where the lens ends: in a colour, in
// its own material, or hatched in the cap's plane; an `outline` is drawn around each cap, on it, and where caps of two parts
// meet or a cap turns. Caps are surfaces like others: lit, picked, changed by other lenses.
// Only closed meshes have an inside; `check` names the others. A cap has no edges and no vertices, so wires and points
// leave nothing of it but what they fill.
