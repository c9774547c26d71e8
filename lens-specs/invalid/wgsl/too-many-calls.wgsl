fn level0(x: f32) -> f32 {
    return x * 0.5;
}

fn level1(x: f32) -> f32 {
    return level0(x) + level0(x) + level0(x) + level0(x);
}

fn level2(x: f32) -> f32 {
    return level1(x) + level1(x) + level1(x) + level1(x);
}

fn level3(x: f32) -> f32 {
    return level2(x) + level2(x) + level2(x) + level2(x);
}

fn level4(x: f32) -> f32 {
    return level3(x) + level3(x) + level3(x) + level3(x);
}

fn level5(x: f32) -> f32 {
    return level4(x) + level4(x) + level4(x) + level4(x);
}

fn level6(x: f32) -> f32 {
    return level5(x) + level5(x) + level5(x) + level5(x);
}

fn level7(x: f32) -> f32 {
    return level6(x) + level6(x) + level6(x) + level6(x);
}

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return vec3f(level7(c.x));
}
