//! Animations of nodes.

use glam::{DVec3, DVec4};
use gltf::json::animation::{self as json, Property as Path};
use gltf::json::validation::Checked;

use super::accessor::{Accessor, most_elements};
use super::warnings::Warnings;
use super::{File, object};
use crate::InputError;
use crate::scene::{Animation, Budget, Channel, Interpolation, Node, Property, Transform};

/// All animations of the file; channels that move no node are left out with a warning.
pub fn load(
    file: &File<'_>,
    nodes: &[Node],
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<Vec<Animation>, InputError> {
    let mut animations = Vec::new();
    for (index, json) in file.root().animations.iter().enumerate() {
        let label = object("animation", index, json.name.as_deref());
        let mut channels = Vec::new();
        for (number, channel) in json.channels.iter().enumerate() {
            let place = format!("{label}, channel {number}");
            budget.take(cost(file, json, channel), || format!("{}: {place}", file.name))?;
            channels.extend(read(file, nodes, channel, &json.samplers[channel.sampler.value()], &place)?);
        }
        let weights = json.channels.len() - channels.len();
        if weights > 0 {
            warnings.add_count(label, weights, "channel", "of weights not played: morph targets are not applied");
        }
        animations.push(Animation { name: json.name.clone().unwrap_or_default(), channels });
    }
    Ok(animations)
}

/// Bytes of a channel's times and values; channels may share accessors.
fn cost(file: &File<'_>, animation: &json::Animation, channel: &json::Channel) -> u64 {
    let sampler = &animation.samplers[channel.sampler.value()];
    let count = |index: usize| most_elements(file.root(), index);
    let (keys, values) = (count(sampler.input.value()), count(sampler.output.value()));
    keys.saturating_mul(16).saturating_add(values.saturating_mul(64))
}

/// One channel; `None` if it is of morph weights.
fn read(
    file: &File<'_>,
    nodes: &[Node],
    channel: &json::Channel,
    sampler: &json::Sampler,
    place: &str,
) -> Result<Option<Channel>, InputError> {
    let property = match channel.target.path {
        Checked::Valid(Path::Translation) => Property::Translation,
        Checked::Valid(Path::Rotation) => Property::Rotation,
        Checked::Valid(Path::Scale) => Property::Scale,
        Checked::Valid(Path::MorphTargetWeights) => return Ok(None),
        Checked::Invalid => {
            return Err(file.error(place, "its target is none of translation, rotation, scale and weights"));
        }
    };
    let interpolation = match sampler.interpolation {
        Checked::Valid(json::Interpolation::Step) => Interpolation::Step,
        Checked::Valid(json::Interpolation::CubicSpline) => Interpolation::CubicSpline,
        // The index check has refused what is invalid.
        Checked::Valid(json::Interpolation::Linear) | Checked::Invalid => Interpolation::Linear,
    };
    let node = channel.target.node.value();
    match nodes.get(node) {
        None => return Err(file.error(place, format!("its target is node {node}, which the file does not have"))),
        Some(Node { rest: Transform::Matrix(_), name, .. }) => {
            let moved = object("node", node, Some(name));
            return Err(file
                .error(place, format!("its target is {moved}, which has a matrix"))
                .help("glTF animates only nodes that have translation, rotation and scale instead"));
        }
        Some(_) => {}
    }
    let times = times(file, sampler.input.value(), place)?;
    let accessor = Accessor::new(file, sampler.output.value(), &format!("{place}, output"))?;
    let expected = times.len().saturating_mul(interpolation.values_per_key());
    if accessor.count() != expected as u64 {
        let (there, keys) = (accessor.count(), super::count_of(times.len(), "key"));
        return Err(accessor.error(format!("{there} elements, expected {expected} for {keys}")));
    }
    let values = values(&accessor, property)?;
    let per_key = interpolation.values_per_key();
    let is_zero = |key: &usize| property == Property::Rotation && values[per_key * key + per_key / 2] == DVec4::ZERO;
    if let Some(key) = (0..times.len()).find(is_zero) {
        return Err(accessor.error(format!("the rotation of key {key} is zero, expected a quaternion")));
    }
    Ok(Some(Channel { node, property, interpolation, times, values }))
}

fn times(file: &File<'_>, input: usize, place: &str) -> Result<Vec<f64>, InputError> {
    let accessor = Accessor::new(file, input, &format!("{place}, input"))?;
    let times: Vec<f64> = accessor.floats::<1>(false)?.into_iter().map(|[time]| f64::from(time)).collect();
    if times.is_empty() {
        return Err(accessor.error("no elements, expected the time of one key or more"));
    }
    if let Some(key) = times.iter().position(|time| !time.is_finite()) {
        return Err(accessor.error(format!("key {key} is at {} s, expected a finite number", times[key])));
    }
    match times.windows(2).position(|pair| pair[1] < pair[0]) {
        Some(key) => {
            let what = format!("key {key} is at {} s and the next at {} s", times[key], times[key + 1]);
            Err(accessor.error(format!("{what}, expected rising times")))
        }
        None => Ok(times),
    }
}

fn values(accessor: &Accessor<'_>, property: Property) -> Result<Vec<DVec4>, InputError> {
    let values: Vec<DVec4> = if property == Property::Rotation {
        // Integer rotations are always fractions of 1.
        accessor.floats::<4>(true)?.into_iter().map(|v| DVec4::from(v.map(f64::from))).collect()
    } else {
        accessor.floats::<3>(false)?.into_iter().map(|v| DVec3::from(v.map(f64::from)).extend(0.0)).collect()
    };
    match values.iter().position(|value| !value.is_finite()) {
        Some(at) => Err(accessor.error(format!("element {at} is {}, expected finite numbers", values[at]))),
        None => Ok(values),
    }
}
