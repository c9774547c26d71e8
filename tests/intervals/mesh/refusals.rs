//! Meshes that are not what they must be.

use std::f64::consts::PI;

use glam::DVec3;
use lenspeel::lens::MeshForm;
use lenspeel::spec::Convex;

use super::{bowl, cube, model, torus};
use crate::facets::{Triangle, lathe};

fn refusal(triangles: &[Triangle], convex: Convex) -> String {
    MeshForm::new(&model(triangles), None, convex).map(drop).expect_err("this mesh must be refused").to_string()
}

#[test]
fn an_open_mesh_and_one_that_is_not_convex_are_refused() {
    let mut open = cube();
    open.pop();
    for convex in [Convex::AsItStands, Convex::Decompose] {
        assert!(refusal(&open, convex).contains("3 of its 18 edges have an odd number"), "{}", refusal(&open, convex));
    }
    assert!(MeshForm::new(&model(&open), None, Convex::Hull).is_ok(), "a hull needs only the corners");
    for solid in [torus(), bowl()] {
        assert!(refusal(&solid, Convex::AsItStands).contains("is not convex"));
    }
    let apart = |t: Triangle| t.map(|p| p + DVec3::X * 3.0);
    let two: Vec<Triangle> = cube().into_iter().chain(cube().into_iter().map(apart)).collect();
    assert!(refusal(&two, Convex::AsItStands).contains("lies 1 inside its convex hull"), "the inner faces");
    // A roof over one face of the cube, and the same pushed in.
    let capped = |height: f64| -> Vec<Triangle> {
        let [top, rest]: [Vec<Triangle>; 2] =
            [true, false].map(|at_top| cube().into_iter().filter(|t| t.iter().all(|p| p.z == 1.0) == at_top).collect());
        let [a, b, c, d] = [top[0][0], top[0][1], top[0][2], top[1][2]];
        let tip = DVec3::Z * (1.0 + height);
        rest.into_iter().chain([[a, b, tip], [b, c, tip], [c, d, tip], [d, a, tip]]).collect()
    };
    assert!(MeshForm::new(&model(&capped(0.5)), None, Convex::AsItStands).is_ok());
    assert!(MeshForm::new(&model(&capped(-1e-4)), None, Convex::AsItStands).is_ok(), "less than a ten-thousandth");
    assert!(refusal(&capped(-1e-3), Convex::AsItStands).contains("at (0, 0, 0.999) its surface lies 0.001 inside"));
    assert!(refusal(&[], Convex::Hull).contains("no triangles"));
}

/// One of so many faces is told by its own planes: as it stands, with a dent as large as is allowed, and with a larger one.
#[test]
fn a_fine_ball_is_convex_and_a_dented_one_is_not() {
    let profile: Vec<(f64, f64)> = (0..=120)
        .map(|i| {
            let angle = PI * f64::from(i) / 120.0;
            (if i % 120 == 0 { 0.0 } else { angle.sin() }, -angle.cos())
        })
        .collect();
    let ball: Vec<Triangle> = lathe(&profile).into_iter().map(|t| t.map(|p| p.as_vec3().as_dvec3())).collect();
    assert!(ball.len() > 4096, "{} triangles are not many", ball.len());
    let dented = |by: f64| -> Vec<Triangle> {
        let at = ball[ball.len() / 2][0];
        ball.iter().map(|t| t.map(|p| if p == at { p * (1.0 - by) } else { p })).collect()
    };
    for (by, is_convex) in [(0.0, true), (1e-5, true), (2e-3, false)] {
        let found = MeshForm::new(&model(&dented(by)), None, Convex::AsItStands);
        assert_eq!(found.is_ok(), is_convex, "{by}: {:?}", found.err().map(|e| e.to_string()));
    }
}
