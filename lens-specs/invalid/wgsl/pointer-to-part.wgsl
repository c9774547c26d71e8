fn double(x: ptr<function, f32>) {
    *x *= 2.0;
}

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    var values = array(c.x, c.y);
    double(&values[1]);
    return vec3f(values[0], values[1], c.z);
}
