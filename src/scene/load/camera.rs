//! Cameras of the file.

use gltf::camera::Projection;

use super::{File, object};
use crate::InputError;
use crate::scene::Camera;

pub fn load(file: &File<'_>) -> Result<Vec<Camera>, InputError> {
    file.document.cameras().map(|camera| read(file, &camera)).collect()
}

fn read(file: &File<'_>, camera: &gltf::Camera<'_>) -> Result<Camera, InputError> {
    let bad = |what: &str| Err(file.error(object("camera", camera.index(), camera.name()), what));
    match camera.projection() {
        Projection::Perspective(p) => {
            let (fov_y, near, far) = (f64::from(p.yfov()), f64::from(p.znear()), p.zfar().map(f64::from));
            if !(fov_y > 0.0 && fov_y < std::f64::consts::PI) {
                return bad("its yfov is not between 0 and pi");
            }
            if !(near > 0.0 && near.is_finite()) || far.is_some_and(|far| far.is_nan() || far <= near) {
                return bad("its planes are not 0 < znear < zfar");
            }
            Ok(Camera::Perspective { fov_y, near, far: far.filter(|f| f.is_finite()) })
        }
        Projection::Orthographic(o) => {
            let (half_height, near, far) = (f64::from(o.ymag()).abs(), f64::from(o.znear()), f64::from(o.zfar()));
            if half_height == 0.0 || !half_height.is_finite() {
                return bad("its ymag is zero or not finite");
            }
            if !(near >= 0.0 && near < far && far.is_finite()) {
                return bad("its planes are not 0 <= znear < zfar");
            }
            Ok(Camera::Orthographic { half_height, near, far })
        }
    }
}
