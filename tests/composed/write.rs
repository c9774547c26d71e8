//! The spec of a case as TOML.

use std::fmt::Write;

use glam::DVec3;

use crate::case::{
    Attach, Camera, Cap, Case, Color, Compound, Convex, Displacement, Filter, Lens, Patterns, Projection, Rotation,
    Rule, Shape, When,
};

/// The whole spec; the models lie beside it.
pub fn toml(case: &Case) -> String {
    let mut text = format!("[scene]\nfile = \"{}.glb\"\nhide = {}\n", case.models[0].name, names(&case.hide));
    if case.cull {
        text += "backfaces = \"as-material\"\n";
    }
    if case.models.len() > 1 {
        text += "[scene.alternates]\n";
    }
    for model in &case.models[1..] {
        writeln!(text, "{0} = \"{0}.glb\"", model.name).expect("a string takes text");
    }
    text += &camera(&case.camera);
    let [width, height] = case.camera.size;
    let background = quoted(&color(case.background));
    write!(text, "[image]\nsize = [{width}, {height}]\nsamples = 1\nbackground = {background}\n")
        .expect("a string takes text");
    case.lenses.iter().for_each(|l| text += &lens(case, l));
    case.rules.iter().for_each(|r| text += &rule(case, r));
    text
}

fn camera(camera: &Camera) -> String {
    let Camera { eye, target, up, projection, near, far, .. } = camera;
    let projection = match projection {
        Projection::Perspective(degrees) => format!("fov_y = {degrees}"),
        Projection::Orthographic(height) => format!("orthographic_height = {height}"),
    };
    let plane = |name: &str, depth: &Option<f64>| depth.map_or(String::new(), |depth| format!("{name} = {depth}\n"));
    format!(
        "[camera]\neye = {}\ntarget = {}\nup = {}\n{projection}\n{}{}",
        vector(*eye),
        vector(*target),
        vector(*up),
        plane("near", near),
        plane("far", far)
    )
}

fn lens(case: &Case, lens: &Lens) -> String {
    let attach = match &lens.attach {
        Attach::Scene => quoted("scene"),
        Attach::Camera => quoted("camera"),
        Attach::Node(name) => format!("{{ node = {} }}", quoted(name)),
    };
    let mut text = format!(
        "[[lens]]\nname = {}\nshape = {}\nattach = {attach}\nfilters = {}\n",
        quoted(&lens.name),
        shape(case, &lens.shape),
        filters(case, &lens.filters)
    );
    let defaults = [
        ("enabled", lens.enabled.to_string(), "true"),
        ("translation", vector(lens.translation), "[0, 0, 0]"),
        ("rotation", rotation(lens.rotation), "[0, 0, 0]"),
        ("scale", vector(lens.scale), "[1, 1, 1]"),
        ("over", names(&lens.over), "[]"),
        ("under", names(&lens.under), "[]"),
        ("hides", names(&lens.hides), "[]"),
        ("overlap", quoted(if lens.overrides { "override" } else { "stack" }), "\"stack\""),
        ("priority", lens.priority.to_string(), "0"),
        ("by", quoted(if lens.by_object { "object" } else { "pixel" }), "\"pixel\""),
        ("only", patterns(&lens.only), "{ nodes = [], materials = [] }"),
        ("except", patterns(&lens.except), "{ nodes = [], materials = [] }"),
        ("soft", lens.soft.to_string(), "0"),
        ("glass", lens.glass.to_string(), "true"),
    ];
    for (key, value, default) in defaults {
        if value != default {
            writeln!(text, "{key} = {value}").expect("a string takes text");
        }
    }
    text
}

fn rule(case: &Case, rule: &Rule) -> String {
    format!("[[overlap]]\nwhen = {}\nfilters = {}\n", quoted(&when(&rule.when)), filters(case, &rule.filters))
}

/// With parentheses around every part, so that nothing hangs on what binds closer.
fn when(condition: &When) -> String {
    match condition {
        When::Name(name) => name.clone(),
        When::Not(inner) => format!("!({})", when(inner)),
        When::And(a, b) => format!("({}) & ({})", when(a), when(b)),
        When::Or(a, b) => format!("({}) | ({})", when(a), when(b)),
    }
}

fn shape(case: &Case, s: &Shape) -> String {
    let inner = match s {
        Shape::Sphere { center, radius } => format!("sphere = {{ center = {}, radius = {radius} }}", vector(*center)),
        Shape::Ellipsoid { center, radii, rotation: turn } => format!(
            "ellipsoid = {{ center = {}, radii = {}, rotation = {} }}",
            vector(*center),
            vector(*radii),
            rotation(*turn)
        ),
        Shape::Box { center, size, rotation: turn } => format!(
            "box = {{ center = {}, size = {}, rotation = {} }}",
            vector(*center),
            vector(*size),
            rotation(*turn)
        ),
        Shape::Cylinder { from, to, radius } => {
            format!("cylinder = {{ from = {}, to = {}, radius = {radius} }}", vector(*from), vector(*to))
        }
        Shape::Cone { from, to, from_radius, to_radius } => format!(
            "cone = {{ from = {}, to = {}, from_radius = {from_radius}, to_radius = {to_radius} }}",
            vector(*from),
            vector(*to)
        ),
        Shape::Capsule { from, to, radius } => {
            format!("capsule = {{ from = {}, to = {}, radius = {radius} }}", vector(*from), vector(*to))
        }
        Shape::Polytope(planes) => {
            let planes = planes.iter().map(|[x, y, z, d]| format!("[{x}, {y}, {z}, {d}]"));
            format!("polytope = {{ planes = {} }}", list(planes))
        }
        Shape::Hull(points) => format!("hull = {{ points = {} }}", list(points.iter().map(|p| vector(*p)))),
        Shape::Plane { point, normal, thickness } => {
            let (point, normal) = (vector(*point), vector(*normal));
            match thickness {
                None => format!("halfspace = {{ point = {point}, normal = {normal} }}"),
                Some(t) => format!("slab = {{ point = {point}, normal = {normal}, thickness = {t} }}"),
            }
        }
        Shape::Flat { corners, depth } => {
            let depth = depth.map_or(String::new(), |depth| format!(", depth = {depth}"));
            format!("flat = {{ corners = {}{depth} }}", list(corners.iter().map(|p| vector(*p))))
        }
        Shape::Mesh { solid, node, convex } => {
            let solid = &case.solids[*solid];
            let node = node.map_or(String::new(), |node| format!(", node = {}", quoted(&solid.nodes[node].name)));
            let convex = match convex {
                Convex::AsItIs => "",
                Convex::Hull => ", convex = \"hull\"",
                Convex::Decompose => ", convex = \"decompose\"",
            };
            format!("mesh = {{ file = \"{}.glb\"{node}{convex} }}", solid.name)
        }
        Shape::Compound(kind, parts) => {
            let key = match kind {
                Compound::Union => "union",
                Compound::Intersection => "intersection",
                Compound::Difference => "difference",
            };
            format!("{key} = {}", list(parts.iter().map(|part| shape(case, part))))
        }
    };
    format!("{{ {inner} }}")
}

fn filters(case: &Case, filters: &[Filter]) -> String {
    list(filters.iter().map(|f| filter(case, f)))
}

fn filter(case: &Case, f: &Filter) -> String {
    let paint = |c: &Color| quoted(&color(*c));
    let inner = match f {
        Filter::Unlit(None) => return quoted("unlit"),
        Filter::Normals => return quoted("normals"),
        Filter::Unlit(Some(c)) => format!("unlit = {{ color = {} }}", paint(c)),
        Filter::Opacity(value) => format!("opacity = {{ value = {value} }}"),
        Filter::Tint(c, amount) => format!("tint = {{ color = {}, amount = {amount} }}", paint(c)),
        Filter::Grayscale(amount) => format!("grayscale = {{ amount = {amount} }}"),
        Filter::Invert(amount) => format!("invert = {{ amount = {amount} }}"),
        Filter::Material(c) => format!("material = {{ color = {} }}", paint(c)),
        Filter::Wireframe { width, color, filled } => {
            let color = color.as_ref().map_or(String::new(), |c| format!(", color = {}", paint(c)));
            format!("wireframe = {{ width = {width}, fill = {}{color} }}", if *filled { 1 } else { 0 })
        }
        Filter::Erase(Patterns { nodes, materials }, cap) => {
            let cap = match cap {
                None => String::new(),
                Some(Cap::Own) => ", cap = \"own\"".into(),
                Some(Cap::Color(c)) => format!(", cap = {}", paint(c)),
                Some(Cap::Hatch(c)) => format!(", cap = {}", quoted(&format!("hatch {}", color(*c)))),
            };
            format!("erase = {{ nodes = {}, materials = {}{cap} }}", names(nodes), names(materials))
        }
        Filter::ShowAlternate(model) => format!("show = {{ alternate = \"{}\" }}", case.models[*model].name),
        Filter::ShowNodes(nodes) => format!("show = {{ nodes = {} }}", names(nodes)),
        Filter::Magnify { factor, center } => {
            let center = center.map_or(String::new(), |center| format!(", center = {}", vector(center)));
            format!("magnify = {{ factor = {factor}{center} }}")
        }
        Filter::Displace { nodes, by } => {
            let by = match by {
                Displacement::Offset(offset) => format!("offset = {}", vector(*offset)),
                Displacement::Explode(factor) => format!("explode = {factor}"),
            };
            let nodes = if nodes.is_empty() { String::new() } else { format!("nodes = {}, ", names(nodes)) };
            format!("displace = {{ {nodes}{by} }}")
        }
    };
    format!("{{ {inner} }}")
}

fn patterns(patterns: &Patterns) -> String {
    format!("{{ nodes = {}, materials = {} }}", names(&patterns.nodes), names(&patterns.materials))
}

fn names(items: &[String]) -> String {
    list(items.iter().map(|name| quoted(name)))
}

fn list(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(", "))
}

fn quoted(text: &str) -> String {
    format!("\"{text}\"")
}

fn color([r, g, b, a]: Color) -> String {
    format!("#{r:02x}{g:02x}{b:02x}{a:02x}")
}

fn vector(v: DVec3) -> String {
    format!("[{}, {}, {}]", v.x, v.y, v.z)
}

fn rotation(rotation: Rotation) -> String {
    match rotation {
        Rotation::Euler([x, y, z]) => format!("[{x}, {y}, {z}]"),
        Rotation::Quaternion([x, y, z, w]) => format!("[{x}, {y}, {z}, {w}]"),
    }
}
