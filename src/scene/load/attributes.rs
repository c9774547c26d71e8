//! Vertex attributes of one primitive, made whole: as many as positions, finite, unit where they must be.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3, Vec4};
use gltf::json::accessor::Type;
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation::Checked;

use super::File;
use super::accessor::Accessor;
use super::warnings::Warnings;
use crate::InputError;

/// Reads the attributes of one primitive.
pub struct Attributes<'f> {
    file: &'f File<'f>,
    json: &'f Primitive,
    /// How messages name the primitive.
    place: &'f str,
}

impl<'f> Attributes<'f> {
    pub fn new(file: &'f File<'f>, json: &'f Primitive, place: &'f str) -> Self {
        Self { file, json, place }
    }

    fn accessor(&self, semantic: Semantic) -> Option<Result<Accessor<'f>, InputError>> {
        let owner = format!("{}, {}", self.place, semantic.to_string());
        let index = self.json.attributes.get(&Checked::Valid(semantic))?;
        Some(Accessor::new(self.file, index.value(), &owner))
    }

    /// Positions must be finite: no picture could be made of the others.
    pub fn positions(&self) -> Result<Vec<Vec3>, InputError> {
        let accessor =
            self.accessor(Semantic::Positions).unwrap_or_else(|| Err(self.file.error(self.place, "no POSITION")))?;
        let positions: Vec<Vec3> = accessor.floats::<3>(false)?.into_iter().map(Vec3::from).collect();
        match positions.iter().position(|p| !p.is_finite()) {
            Some(at) => Err(accessor.error(format!("vertex {at} is at {}, expected finite numbers", positions[at]))),
            None => Ok(positions),
        }
    }

    /// Any other attribute, as long as `count`, with what is not finite set to zero.
    fn read<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
        count: usize,
        normalize: bool,
        warnings: &mut Warnings,
    ) -> Result<Vec<[f32; N]>, InputError> {
        if accessor.count() != count as u64 {
            return Err(accessor.error(format!("{} elements, expected {count} as of POSITION", accessor.count())));
        }
        let mut values = accessor.floats::<N>(normalize)?;
        let mut bad = 0;
        for value in values.iter_mut().filter(|v| !v.iter().all(|c| c.is_finite())) {
            *value = [0.0; N];
            bad += 1;
        }
        if bad > 0 {
            warnings.add_count(self.place, bad, "attribute value", "not finite, taken as zero");
        }
        Ok(values)
    }

    fn optional<const N: usize>(
        &self,
        semantic: Semantic,
        count: usize,
        warnings: &mut Warnings,
    ) -> Result<Option<Vec<[f32; N]>>, InputError> {
        let Some(accessor) = self.accessor(semantic) else { return Ok(None) };
        self.read(&accessor?, count, false, warnings).map(Some)
    }

    /// Unit normals; those of zero length become the mean of their triangles' normals.
    pub fn normals(
        &self,
        positions: &[Vec3],
        triangles: &[[u32; 3]],
        warnings: &mut Warnings,
    ) -> Result<Option<Vec<Vec3>>, InputError> {
        let Some(values) = self.optional::<3>(Semantic::Normals, positions.len(), warnings)? else { return Ok(None) };
        let mut normals: Vec<Vec3> = values.into_iter().map(|n| Vec3::from(n).normalize_or_zero()).collect();
        let broken = normals.iter().filter(|n| **n == Vec3::ZERO).count();
        if broken > 0 {
            repair_normals(&mut normals, positions, triangles);
            warnings.add_count(self.place, broken, "normal", "of zero length rebuilt");
        }
        Ok(Some(normals))
    }

    /// Tangents of unit length; glTF gives them no meaning without normals.
    pub fn tangents(&self, normals: Option<&[Vec3]>, warnings: &mut Warnings) -> Result<Option<Vec<Vec4>>, InputError> {
        let Some(normals) = normals else { return Ok(None) };
        let values = self.optional::<4>(Semantic::Tangents, normals.len(), warnings)?;
        let unit = |([x, y, z, w], normal): ([f32; 4], &Vec3)| {
            let along = Vec3::new(x, y, z).try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
            along.extend(if w < 0.0 { -1.0 } else { 1.0 })
        };
        Ok(values.map(|values| values.into_iter().zip(normals).map(unit).collect()))
    }

    pub fn uv(&self, set: u32, count: usize, warnings: &mut Warnings) -> Result<Option<Vec<Vec2>>, InputError> {
        let values = self.optional::<2>(Semantic::TexCoords(set), count, warnings)?;
        Ok(values.map(|values| values.into_iter().map(Vec2::from).collect()))
    }

    /// Integer colours are always fractions of 1, and RGB ones are opaque.
    pub fn colors(&self, count: usize, warnings: &mut Warnings) -> Result<Option<Vec<Vec4>>, InputError> {
        let Some(accessor) = self.accessor(Semantic::Colors(0)) else { return Ok(None) };
        let accessor = accessor?;
        let colors = if accessor.kind == Type::Vec3 {
            let values = self.read::<3>(&accessor, count, true, warnings)?;
            values.into_iter().map(|c| Vec3::from(c).extend(1.0)).collect()
        } else {
            let values = self.read::<4>(&accessor, count, true, warnings)?;
            values.into_iter().map(Vec4::from).collect()
        };
        Ok(Some(colors))
    }
}

impl Attributes<'_> {
    /// The attributes of the file's own, whose names begin with `_`: one number each, the length of those with several.
    pub fn values(&self, count: usize, warnings: &mut Warnings) -> Result<BTreeMap<String, Vec<f32>>, InputError> {
        let mut all = BTreeMap::new();
        for semantic in self.json.attributes.keys() {
            let Checked::Valid(semantic @ Semantic::Extras(_)) = semantic else { continue };
            let Some(accessor) = self.accessor(semantic.clone()) else { continue };
            let accessor = accessor?;
            let values = match accessor.kind {
                Type::Scalar => self.read::<1>(&accessor, count, false, warnings)?.into_flattened(),
                Type::Vec2 => lengths(self.read::<2>(&accessor, count, false, warnings)?),
                Type::Vec3 => lengths(self.read::<3>(&accessor, count, false, warnings)?),
                Type::Vec4 => lengths(self.read::<4>(&accessor, count, false, warnings)?),
                _ => {
                    warnings.add(self.place, format!("attribute {} is a matrix, left out", semantic.to_string()));
                    continue;
                }
            };
            all.insert(semantic.to_string(), values);
        }
        Ok(all)
    }
}

fn lengths<const N: usize>(values: Vec<[f32; N]>) -> Vec<f32> {
    values.into_iter().map(|parts| parts.iter().map(|x| x * x).sum::<f32>().sqrt()).collect()
}

/// Area-weighted mean of the adjoining triangles; a vertex without any area points along +z.
fn repair_normals(normals: &mut [Vec3], positions: &[Vec3], triangles: &[[u32; 3]]) {
    let mut sums = vec![glam::DVec3::ZERO; normals.len()];
    for corners in triangles {
        let [a, b, c] = corners.map(|i| positions[i as usize].as_dvec3());
        let area = (b - a).cross(c - a);
        corners.iter().for_each(|i| sums[*i as usize] += area);
    }
    for (normal, sum) in normals.iter_mut().zip(sums).filter(|(n, _)| **n == Vec3::ZERO) {
        *normal = sum.try_normalize().map_or(Vec3::Z, |n| n.as_vec3());
    }
}
