// Takes surfaces away: those of `nodes` and of `materials` that match, or everything. What is erased hides nothing and
// catches no pick; a solid that is cut shows its inside.
