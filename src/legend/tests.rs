use super::axis::{Unit, exact, number, ticks};
use super::*;
use crate::scene::{Model, Scene};
use crate::spec::Spec;

/// A plan with these filters in one lens; no model is needed for ranges that are given.
fn plan(filters: &str, size: [u32; 2]) -> Plan {
    let text = format!(
        "[scene]\nfile = 'none.glb'\n[camera]\neye = [0, 0, 9]\ntarget = [0, 0, 0]\n[image]\nsize = {size:?}\n[[lens]]\n\
         name = 'a'\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nfilters = [{filters}]\n"
    );
    let spec = Spec::parse(&text, "a test", "".as_ref()).expect("a spec");
    let mut scene = Scene::new(vec![Model::default()], Vec::new());
    scene.prepare_filters(&spec).expect("no files");
    Plan::new(&spec, &scene).expect("a plan")
}

fn drawn(plan: &Plan) -> Frame {
    let size = plan.view.size;
    let mut frame = Frame { size, pixels: vec![[250, 250, 250, 255]; (size[0] * size[1]) as usize], aovs: None };
    draw(plan, &mut frame);
    frame
}

/// The colours of a row that are of a bar: from its left to its right end, neither ground nor picture.
fn bar(plan: &Plan) -> Vec<[u8; 4]> {
    let frame = drawn(plan);
    let [width, height] = frame.size;
    // Above the numbers, of the height of a line.
    let letters = Type::of(frame.size);
    let y = height as i32 - letters.letter[1] - letters.letter[1] * 2 / 3 - letters.letter[1] * 3 / 2 - 5;
    let row = &frame.pixels[(y * width as i32) as usize..][..width as usize];
    let left = letters.letter[1] + letters.letter[1] * 2 / 3;
    row[left as usize..][..(26 * letters.letter[0]) as usize].to_vec()
}

#[test]
fn numbers_are_round_and_fit() {
    let texts = |ends, unit, room| ticks(ends, unit, room).into_iter().map(|tick| tick.text).collect::<Vec<_>>();
    assert_eq!(texts([0.0, 1.0], Unit::Plain, 40), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    assert_eq!(texts([0.0, 1.0], Unit::Plain, 16), ["0.0", "0.5", "1.0"]);
    assert_eq!(texts([0.0, 180.0], Unit::Degrees, 40), ["0°", "45°", "90°", "135°", "180°"]);
    assert_eq!(texts([4_649_000.25, 4_649_000.75], Unit::Plain, 26).len(), 2);
    assert_eq!(texts([-2e-9, 3e-9], Unit::Plain, 40)[0], "-2e-9");
    assert_eq!(texts([5.0, 5.0], Unit::Plain, 40), ["5.000"]);
    for tick in ticks([-3.0, 9.0], Unit::Plain, 40) {
        let value: f64 = tick.text.parse().expect("a number");
        assert!((tick.at - (value + 3.0) / 12.0).abs() < 1e-9, "{tick:?}");
    }
    assert_eq!([0.25, 5.0, 1.0 / 3.0, 2e-6, 1e9].map(exact), ["0.25", "5", "0.333333", "2e-6", "1e9"]);
    assert_eq!(number(-0.0, 0.5, Unit::Plain), "0.0");
}

#[test]
fn values_rise_from_left_to_right() {
    let size = [640, 360];
    let ahead = bar(&plan("{ height = { range = [0, 10] } }", size));
    let viridis = crate::color_map::colors("viridis").expect("a map");
    assert_eq!((ahead.first(), ahead.last()), (viridis.first(), viridis.last()));
    let backwards = bar(&plan("{ height = { range = [10, 0] } }", size));
    assert_eq!(backwards.iter().rev().copied().collect::<Vec<_>>(), ahead);
    assert_eq!(bar(&plan("{ height = { range = [0, 10], colormap = 'viridis-r' } }", size)), backwards);
    // 0 degrees is level: the high end of the range.
    let slope = bar(&plan("{ normals = { colormap = 'viridis', range = [0, 1] } }", size));
    assert_eq!((slope.first(), slope.last()), (viridis.last(), viridis.first()));
}

#[test]
fn a_legend_leaves_the_middle_free() {
    let filters =
        "{ height = { range = [0, 10] } }, { depth = { range = [0, 10] } }, { contours = { spacing = 2 } }, 'normals'";
    for size in [[1280, 720], [640, 360], [3840, 2160], [200, 160], [60, 40], [1, 1]] {
        let plan = plan(filters, size);
        let frame = drawn(&plan);
        let rows = frame.pixels.chunks(size[0] as usize);
        let clear = rows.take_while(|row| row.iter().all(|pixel| *pixel == [250, 250, 250, 255])).count();
        assert!(clear * 2 >= size[1] as usize, "{size:?}: only {clear} rows are free");
        let left_out = left_out(&plan);
        assert!(left_out == 0 || size[0] < 300, "{size:?}: {left_out}");
        assert_eq!(left_out == 4, clear == size[1] as usize, "{size:?}");
    }
}

#[test]
fn what_several_lenses_show_alike_is_told_once() {
    let twice = plan("{ height = { range = [0, 10] } }, { height = { range = [0, 10] } }", [640, 360]);
    assert_eq!(block::blocks(&twice).len(), 1);
    let other = plan("{ height = { range = [0, 10] } }, { height = { range = [0, 9] } }", [640, 360]);
    assert_eq!(block::blocks(&other).len(), 2);
}
