//! Accessors as vectors of numbers: every offset checked before a byte is read.
//!
//! The reader of the `gltf` crate trusts counts and offsets, and panics or reads less than announced when they lie.

use gltf::json::accessor::{Accessor, ComponentType};
use gltf::json::validation::Checked;

use super::file::File;
use crate::catalog::error::ModelFault;

/// Most elements of one accessor: three corners for each of the most triangles.
const MAX_ELEMENTS: u64 = 60_000_000;

impl File {
    /// Elements of `N` components as floats, integers normalised where the accessor says so.
    pub fn floats<const N: usize>(&self, accessor: usize) -> Result<Vec<[f32; N]>, ModelFault> {
        self.elements(accessor, |_| true, float)
    }

    /// Elements of `N` unsigned integers.
    pub fn integers<const N: usize>(&self, accessor: usize) -> Result<Vec<[u32; N]>, ModelFault> {
        let unsigned = |kind| matches!(kind, ComponentType::U8 | ComponentType::U16 | ComponentType::U32);
        self.elements(accessor, unsigned, |bytes, kind, _| integer(bytes, kind))
    }

    /// How many elements an accessor announces.
    pub fn count(&self, accessor: usize) -> Result<u64, ModelFault> {
        Ok(self.accessor(accessor)?.count.0)
    }

    fn accessor(&self, number: usize) -> Result<&Accessor, ModelFault> {
        self.root.accessors.get(number).ok_or_else(|| ModelFault::broken(place(number), "it does not exist"))
    }

    fn elements<T: Copy + Default, const N: usize>(
        &self,
        number: usize,
        takes: impl Fn(ComponentType) -> bool,
        component: impl Fn(&[u8], ComponentType, bool) -> T,
    ) -> Result<Vec<[T; N]>, ModelFault> {
        let accessor = self.accessor(number)?;
        let broken = |problem: String| ModelFault::broken(place(number), problem);
        let kind = match (accessor.component_type, accessor.type_) {
            (Checked::Valid(kind), Checked::Valid(shape)) if takes(kind.0) && shape.multiplicity() == N => kind.0,
            _ => return Err(broken(format!("not the kind of numbers expected ({N} a piece)"))),
        };
        if accessor.count.0 > MAX_ELEMENTS {
            return Err(ModelFault::TooLarge { what: "vertices", count: accessor.count.0, limit: MAX_ELEMENTS });
        }
        let size = kind.size();
        let decode = |element: &[u8]| -> [T; N] {
            std::array::from_fn(|k| component(&element[k * size..(k + 1) * size], kind, accessor.normalized))
        };
        let count = accessor.count.0 as usize;
        let mut values = match accessor.buffer_view {
            Some(view) => {
                let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
                let span = Span { view: view.value(), offset, count, size: size * N };
                self.slices(span).map_err(broken)?.map(decode).collect()
            }
            None if accessor.sparse.is_some() => vec![[T::default(); N]; count],
            None => return Err(self.without_data(number)),
        };
        if let Some(sparse) = &accessor.sparse {
            let Checked::Valid(index_kind) = sparse.indices.component_type else {
                return Err(broken("sparse indices of an unknown kind".into()));
            };
            let index_kind = index_kind.0;
            if sparse.count.0 > accessor.count.0 {
                return Err(broken(format!("{} sparse values for {count} elements", sparse.count.0)));
            }
            let replaced = sparse.count.0 as usize;
            let indices = Span {
                view: sparse.indices.buffer_view.value(),
                offset: sparse.indices.byte_offset.0,
                count: replaced,
                size: index_kind.size(),
            };
            let news = Span {
                view: sparse.values.buffer_view.value(),
                offset: sparse.values.byte_offset.0,
                count: replaced,
                size: size * N,
            };
            for (index, new) in self.slices(indices).map_err(broken)?.zip(self.slices(news).map_err(broken)?) {
                let index = integer(index, index_kind) as usize;
                let value = values.get_mut(index).ok_or_else(|| broken(format!("sparse index {index} of {count}")))?;
                *value = decode(new);
            }
        }
        Ok(values)
    }

    /// An accessor without data is compressed by an extension, or a mistake.
    fn without_data(&self, number: usize) -> ModelFault {
        match self.root.extensions_used.iter().find(|name| name.ends_with("_compression")) {
            Some(name) => ModelFault::Extension(name.clone()),
            None => ModelFault::broken(place(number), "it has no data"),
        }
    }

    /// The bytes of each element of a span, once the whole of it is known to lie inside view and buffer.
    fn slices(&self, span: Span) -> Result<impl Iterator<Item = &[u8]>, String> {
        let view = self.root.buffer_views.get(span.view).ok_or_else(|| format!("no bufferViews[{}]", span.view))?;
        let buffer = self.buffers.get(view.buffer.value()).ok_or_else(|| format!("no buffers[{}]", view.buffer))?;
        let start = usize::try_from(view.byte_offset.map_or(0, |offset| offset.0)).ok();
        let length = usize::try_from(view.byte_length.0).ok();
        let bytes = start
            .zip(length)
            .and_then(|(start, length)| buffer.get(start..start.checked_add(length)?))
            .ok_or_else(|| format!("bufferViews[{}] ends beyond its buffer", span.view))?;
        let stride = view.byte_stride.map_or(0, |stride| stride.0).max(span.size);
        let used = span.count.checked_sub(1).map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(span.size));
        let bytes = usize::try_from(span.offset)
            .ok()
            .zip(used)
            .and_then(|(offset, used)| bytes.get(offset..offset.checked_add(used)?))
            .ok_or_else(|| format!("it ends beyond bufferViews[{}]", span.view))?;
        // The last element may be shorter than the stride, which is why these are no exact chunks.
        Ok((0..span.count).map(move |k| &bytes[k * stride..k * stride + span.size]))
    }
}

#[derive(Clone, Copy)]
struct Span {
    view: usize,
    offset: u64,
    count: usize,
    /// Bytes of one element.
    size: usize,
}

fn place(accessor: usize) -> String {
    format!("accessors[{accessor}]")
}

fn float(bytes: &[u8], kind: ComponentType, normalized: bool) -> f32 {
    let (value, full) = match kind {
        ComponentType::F32 => return f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
        ComponentType::I8 => (f32::from(bytes[0] as i8), 127.0),
        ComponentType::U8 => (f32::from(bytes[0]), 255.0),
        ComponentType::I16 => (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])), 32_767.0),
        ComponentType::U16 => (f32::from(u16::from_le_bytes([bytes[0], bytes[1]])), 65_535.0),
        ComponentType::U32 => (integer(bytes, kind) as f32, u32::MAX as f32),
    };
    if normalized { (value / full).max(-1.0) } else { value }
}

fn integer(bytes: &[u8], kind: ComponentType) -> u32 {
    match kind {
        ComponentType::U8 | ComponentType::I8 => u32::from(bytes[0]),
        ComponentType::U16 | ComponentType::I16 => u32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
        ComponentType::U32 | ComponentType::F32 => u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
    }
}
