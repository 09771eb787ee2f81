//! Where a primitive's numbers come from: accessors, or a compressed stream.

use std::rc::Rc;

use glam::Vec3;

use super::draco::{Scale, Stream};
use super::file::File;
use super::schema::{Attributes, Primitive};
use super::triangles::Mode;
use crate::catalog::error::ModelFault;

/// A primitive's numbers.
pub(super) struct Source<'a, 'f> {
    file: &'a File<'f>,
    attributes: &'a Attributes,
    indices: Option<u32>,
    compressed: Option<Compressed<'a>>,
}

/// A stream, and the numbers of attributes within it.
struct Compressed<'a> {
    stream: Rc<Stream>,
    attributes: &'a Attributes,
}

/// One attribute: its accessor, and its number in the stream if it is compressed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attribute {
    accessor: u32,
    id: Option<u32>,
}

impl<'a, 'f> Source<'a, 'f> {
    pub fn of(file: &'a File<'f>, primitive: &'a Primitive) -> Result<Self, ModelFault> {
        let draco = primitive.extensions.as_ref().and_then(|extensions| extensions.draco.as_ref());
        let compressed = match draco {
            Some(draco) => Some(Compressed { stream: file.draco(draco.buffer_view)?, attributes: &draco.attributes }),
            None => None,
        };
        Ok(Self { file, attributes: &primitive.attributes, indices: primitive.indices, compressed })
    }

    pub fn vertex_count(&self) -> Result<u64, ModelFault> {
        if let Some(compressed) = &self.compressed {
            return Ok(compressed.stream.vertex_count());
        }
        self.attributes.position.or(self.attributes.other).map_or(Ok(0), |accessor| self.file.count(accessor))
    }

    pub fn triangle_count(&self, mode: Mode) -> Result<u64, ModelFault> {
        match (&self.compressed, self.indices) {
            (Some(compressed), _) => Ok(compressed.stream.triangle_count()),
            (None, Some(indices)) => Ok(mode.count(self.file.count(indices)?)),
            (None, None) => Ok(mode.count(self.vertex_count()?)),
        }
    }

    /// Whether all positions, or all corners, are known to be one without reading them.
    pub fn is_one_point(&self) -> bool {
        let is_zero = |accessor: Option<u32>| accessor.is_some_and(|accessor| self.file.is_zero(accessor));
        self.compressed.is_none() && (is_zero(self.attributes.position) || is_zero(self.indices))
    }

    /// All positions; `None` if the primitive has none.
    pub fn positions(&self) -> Result<Option<Vec<Vec3>>, ModelFault> {
        let Some(position) = self.attribute(|attributes| attributes.position) else { return Ok(None) };
        Ok(Some(self.floats::<3>(position, u64::MAX)?.into_iter().map(Vec3::from_array).collect()))
    }

    pub fn triangles(&self, mode: Mode) -> Result<Vec<[u32; 3]>, ModelFault> {
        match (&self.compressed, self.indices) {
            (Some(compressed), _) => compressed.stream.triangles(),
            (None, Some(indices)) => {
                Ok(mode.triangles(self.file.integers::<1>(indices)?.into_iter().map(|[index]| index)))
            }
            (None, None) => Ok(mode.triangles(0..self.vertex_count()? as u32)),
        }
    }

    /// Joints and weights that come in pairs.
    pub fn joint_sets(&self) -> impl Iterator<Item = (Attribute, Attribute)> + '_ {
        (0..self.attributes.joints.len()).map_while(|set| {
            self.attribute(move |attributes| attributes.joints[set])
                .zip(self.attribute(move |attributes| attributes.weights[set]))
        })
    }

    /// An attribute as floats, no more than so many elements.
    pub fn floats<const N: usize>(&self, attribute: Attribute, most: u64) -> Result<Vec<[f32; N]>, ModelFault> {
        match (&self.compressed, attribute.id) {
            (Some(compressed), Some(id)) => {
                let normalized = self.file.is_normalized(attribute.accessor);
                compressed.stream.floats(id, if normalized { Scale::Normalized } else { Scale::AsIs })
            }
            _ => self.file.first_floats(attribute.accessor, most),
        }
    }

    /// An attribute as whole numbers, no more than so many elements.
    pub fn integers<const N: usize>(&self, attribute: Attribute, most: u64) -> Result<Vec<[u32; N]>, ModelFault> {
        match (&self.compressed, attribute.id) {
            (Some(compressed), Some(id)) => compressed.stream.integers(id),
            _ => self.file.first_integers(attribute.accessor, most),
        }
    }

    fn attribute(&self, choose: impl Fn(&Attributes) -> Option<u32>) -> Option<Attribute> {
        let id = self.compressed.as_ref().and_then(|compressed| choose(compressed.attributes));
        Some(Attribute { accessor: choose(self.attributes)?, id })
    }
}
