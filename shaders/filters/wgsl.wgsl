// A filter of your own: a WGSL file with `fn filter_surface`, `fn filter_color` or both. `params` are the values of its
// `Params` struct.
