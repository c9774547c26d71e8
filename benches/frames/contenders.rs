//! Who draws the frames of the table: this library and the baselines, on one adapter.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Instant;

use lenspeel::bench::{Contender, Sample};
use lenspeel::gpu::{AdapterChoice, Engine, Headless, RenderOptions, Renderer};
use lenspeel::lens::MeshForm;
use lenspeel::plan::Plan;
use lenspeel::scene::{Model, Primitive, Scene};
use lenspeel::spec::{Convex, Shape};

use crate::balls::Ball;
use crate::baselines::{self, Baseline, Host};
use crate::lens_sets::{Lenses, coverage};
use crate::rows::*;
use crate::support;

/// The surface and the devices that draw it.
pub struct Field {
    device: Headless,
    host: Rc<Host>,
    surface: baselines::Surface,
    scene: Scene,
    renderer: RefCell<Renderer>,
    /// With another model as large as the surface, for the x-ray; made when it is asked for.
    deep: std::cell::OnceCell<(Scene, RefCell<Renderer>)>,
    size: [u32; 2],
    left_out: RefCell<Vec<&'static str>>,
}

impl Field {
    pub fn new(adapter: &AdapterChoice, size: [u32; 2]) -> Result<Self, String> {
        let device = Headless::new(adapter).map_err(|error| error.to_string())?;
        let host = Rc::new(Host::new(adapter)?);
        let mut scene = Scene::new(vec![support::surface()], Vec::new());
        for ball in [Ball::Icosahedron, Ball::Finest] {
            add_mesh(&mut scene, ball, size)?;
        }
        let surface = host.surface(&scene);
        let renderer = RefCell::new(device.renderer(&scene).map_err(|error| error.to_string())?);
        Ok(Self {
            device,
            host,
            surface,
            scene,
            renderer,
            deep: Default::default(),
            size,
            left_out: Default::default(),
        })
    }

    /// Why baselines that were asked for are not drawn.
    pub fn left_out(&self) -> Vec<&'static str> {
        self.left_out.borrow().clone()
    }

    /// Who draws what a row calls by this name; `None` where a baseline is left out.
    pub fn contender<'a>(&'a self, name: &str) -> Result<Option<Contender<'a, String>>, String> {
        let (scene, size) = (&self.scene, self.size);
        let lenses = match name {
            MINIMAL | NONE => Lenses::none(),
            SPHERE | DRAGGED | MASK_1 | THREE_PASS => Lenses::one_sphere(),
            OFF_SCREEN => Lenses::off_screen(),
            BOX | CLIP_PLANES => Lenses::one_box(),
            X_RAY => Lenses::x_ray(),
            FINE_MESH => Lenses::mesh(Ball::Finest, scene, size),
            COARSE_MESH => Lenses::mesh(Ball::Icosahedron, scene, size),
            SPHERES | PEEL | MASK_8 | ANALYTIC_SPHERES => Lenses::spheres(),
            HULLS | ANALYTIC_HULLS => Lenses::hulls(),
            BOXES => Lenses::boxes(),
            GROUPS => Lenses::groups(),
            SMALL => Lenses::small(scene, size),
            HEAP => Lenses::heap(scene, size),
            APART => Lenses::apart(),
            _ => return Err(format!("nobody draws `{name}`")),
        };
        let plan = if name == X_RAY { lenses.plan(&self.deep()?.0, size) } else { lenses.plan(scene, size) };
        eprintln!("{name}: lenses over {:.1} % of the picture", 100.0 * coverage(&plan));
        let (host, surface) = (&self.host, &self.surface);
        let baseline = match name {
            MINIMAL => Some(baselines::minimal(host, surface, &plan)),
            MASK_1 | MASK_8 => baselines::mask(host, surface, &plan),
            ANALYTIC_SPHERES | ANALYTIC_HULLS => baselines::analytic(host, surface, &plan),
            THREE_PASS => baselines::three_pass(host, surface, &plan),
            CLIP_PLANES => baselines::clip_planes(host, surface, &plan),
            DRAGGED => return Ok(Some(self.dragged(&lenses))),
            X_RAY => {
                let (scene, renderer) = self.deep()?;
                return Ok(Some(self.drawing(name, Engine::Fused, scene, renderer, plan)));
            }
            PEEL => return self.peel(plan).map(Some),
            _ => return Ok(Some(self.fused(name, plan))),
        };
        match baseline {
            Some(baseline) => self.checked(name, baseline, &plan).map(Some),
            None => {
                self.left_out.borrow_mut().push(match name {
                    CLIP_PLANES => "clipping planes: this adapter has no clip distances",
                    _ => return Err(format!("{name}: the baseline does not know these lenses")),
                });
                Ok(None)
            }
        }
    }

    /// A scene with a second model, shown by x-rays.
    fn deep(&self) -> Result<&(Scene, RefCell<Renderer>), String> {
        if let Some(deep) = self.deep.get() {
            return Ok(deep);
        }
        let mut below = support::surface();
        below.name = "deep.glb".into();
        below.nodes[0].world_from_local.translation.y = -0.2;
        let scene = Scene::new(vec![support::surface(), below], vec!["deep".into()]);
        let renderer = self.device.renderer(&scene).map_err(|error| error.to_string())?;
        Ok(self.deep.get_or_init(|| (scene, RefCell::new(renderer))))
    }

    fn fused(&self, name: &str, plan: Plan) -> Contender<'_, String> {
        self.drawing(name, Engine::Fused, &self.scene, &self.renderer, plan)
    }

    /// The published way, with our own picture to show for it.
    fn peel(&self, plan: Plan) -> Result<Contender<'_, String>, String> {
        let picture = |engine| self.picture(engine, &plan);
        self.compare(PEEL, &picture(Engine::Fused)?, &picture(Engine::Peel)?.pixels)?;
        Ok(self.drawing(PEEL, Engine::Peel, &self.scene, &self.renderer, plan))
    }

    /// Frames of a plan. The first is a whole picture, which makes the room that the others need.
    fn drawing<'a>(
        &'a self,
        name: &str,
        engine: Engine,
        scene: &'a Scene,
        renderer: &'a RefCell<Renderer>,
        plan: Plan,
    ) -> Contender<'a, String> {
        let options = RenderOptions { engine, aovs: false };
        let mut has_room = false;
        Contender::new(name, move || {
            let mut renderer = renderer.borrow_mut();
            if !has_room {
                let picture = self.device.render_with(&mut renderer, scene, &plan, options, &mut None);
                picture.map_err(|error| error.to_string())?;
                has_room = true;
            }
            let cost = self.device.time_frame(&mut renderer, scene, &plan, options, false);
            let cost = cost.map_err(|error| error.to_string())?;
            let stages = vec![("prepare", cost.prepare), ("draw", cost.wall - cost.prepare)];
            Ok(Sample { seconds: cost.wall, stages })
        })
    }

    /// One lens that stands elsewhere in every frame; its frames decide the spec anew, too.
    fn dragged(&self, lenses: &Lenses) -> Contender<'_, String> {
        let mut spec = lenses.spec(self.size);
        let mut step = 0;
        let options = RenderOptions::default();
        Contender::new(DRAGGED, move || {
            step += 1;
            // To and fro, never at the same place in two frames that follow each other.
            spec.lenses[0].translation[0] = 0.01 * f64::from(step % 8);
            let mut renderer = self.renderer.borrow_mut();
            let start = Instant::now();
            let plan = Plan::new(&spec, &self.scene).map_err(|error| error.to_string())?;
            let deciding = start.elapsed().as_secs_f64();
            let cost = self.device.time_frame(&mut renderer, &self.scene, &plan, options, false);
            let cost = cost.map_err(|error| error.to_string())?;
            let stages = vec![("decide", deciding), ("prepare", cost.prepare), ("draw", cost.wall - cost.prepare)];
            Ok(Sample { seconds: deciding + cost.wall, stages })
        })
    }

    /// A baseline whose picture is ours.
    fn checked<'a>(&'a self, name: &str, baseline: Baseline, plan: &Plan) -> Result<Contender<'a, String>, String> {
        baseline.frame()?;
        self.compare(name, &self.picture(Engine::Fused, plan)?, &baseline.pixels()?)?;
        Ok(Contender::new(name, move || baseline.frame().map(Sample::from)))
    }

    fn picture(&self, engine: Engine, plan: &Plan) -> Result<lenspeel::frame::Frame, String> {
        let options = RenderOptions { engine, aovs: false };
        let mut renderer = self.renderer.borrow_mut();
        let picture = self.device.render_with(&mut renderer, &self.scene, plan, options, &mut None);
        picture.map_err(|error| error.to_string())
    }

    fn compare(&self, name: &str, ours: &lenspeel::frame::Frame, theirs: &[[u8; 4]]) -> Result<(), String> {
        let different = baselines::different(ours, theirs);
        let allowed = (baselines::MOST_DIFFERENT * ours.pixels.len() as f64 / 1e6) as usize;
        let message = format!("{name}: {different} of {} pixels differ from ours", ours.pixels.len());
        if different > allowed {
            return Err(format!("{message}, and at most {allowed} may: it does not draw the same picture"));
        }
        eprintln!("{message}");
        Ok(())
    }
}

/// Puts a ball where the specs that name it find it.
fn add_mesh(scene: &mut Scene, ball: Ball, size: [u32; 2]) -> Result<(), String> {
    let (points, triangles) = ball.mesh();
    let positions = points.iter().map(|p| p.as_vec3()).collect();
    let model: Model = support::model(&ball.file(), Primitive { positions, triangles, ..Primitive::default() });
    let spec = Lenses::mesh_of(ball, 1.0).spec(size);
    let Shape::Mesh(shape) = &spec.lenses[0].shape.value else { return Err("the lens is no mesh".into()) };
    let solid = MeshForm::new(&model, None, Convex::Decompose).map_err(|error| error.to_string())?;
    scene.lens_meshes.insert(shape, solid);
    Ok(())
}
