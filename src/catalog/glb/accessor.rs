//! Accessors as vectors of numbers: every offset checked before a byte is read.

use super::file::File;
use super::schema::{Accessor, Sparse};
use crate::catalog::error::ModelFault;

/// Most elements of one accessor: three corners for each of the most triangles.
const MAX_ELEMENTS: u64 = 60_000_000;

impl File<'_> {
    /// Elements of `N` components as floats, integers normalised where the accessor says so.
    pub fn floats<const N: usize>(&self, accessor: u32) -> Result<Vec<[f32; N]>, ModelFault> {
        self.elements(accessor, u64::MAX, |_| true, float)
    }

    /// As [`File::floats`], but no more than so many.
    pub fn first_floats<const N: usize>(&self, accessor: u32, most: u64) -> Result<Vec<[f32; N]>, ModelFault> {
        self.elements(accessor, most, |_| true, float)
    }

    /// Elements of `N` unsigned integers.
    pub fn integers<const N: usize>(&self, accessor: u32) -> Result<Vec<[u32; N]>, ModelFault> {
        self.first_integers(accessor, u64::MAX)
    }

    /// As [`File::integers`], but no more than so many.
    pub fn first_integers<const N: usize>(&self, accessor: u32, most: u64) -> Result<Vec<[u32; N]>, ModelFault> {
        let unsigned = |kind| matches!(kind, Component::U8 | Component::U16 | Component::U32);
        self.elements(accessor, most, unsigned, |bytes, kind, _| integer(bytes, kind))
    }

    /// How many elements an accessor announces, if one model may have so many.
    pub fn count(&self, accessor: u32) -> Result<u64, ModelFault> {
        let count = self.accessor(accessor)?.count;
        if count > MAX_ELEMENTS {
            let what = format!("elements in {}", place(accessor));
            return Err(ModelFault::TooLarge { what, count, limit: MAX_ELEMENTS });
        }
        Ok(count)
    }

    /// Whether an accessor has no data, so that all its elements are 0.
    pub fn is_zero(&self, accessor: u32) -> bool {
        self.accessor(accessor).is_ok_and(|accessor| accessor.buffer_view.is_none() && accessor.sparse.is_none())
    }

    /// Whether integers of an accessor stand for fractions.
    pub fn is_normalized(&self, accessor: u32) -> bool {
        self.accessor(accessor).is_ok_and(|accessor| accessor.normalized)
    }

    fn accessor(&self, number: u32) -> Result<&Accessor<'_>, ModelFault> {
        self.root.accessors.get(number as usize).ok_or_else(|| ModelFault::broken(place(number), "it does not exist"))
    }

    fn elements<T: Copy + Default, const N: usize>(
        &self,
        number: u32,
        most: u64,
        takes: impl Fn(Component) -> bool,
        component: impl Fn(&[u8], Component, bool) -> T,
    ) -> Result<Vec<[T; N]>, ModelFault> {
        let accessor = self.accessor(number)?;
        let kind = Component::of(accessor.component_type).filter(|kind| takes(*kind) && width(&accessor.shape.0) == N);
        let Some(kind) = kind else {
            let problem = format!("{} of component type {}", accessor.shape.0, accessor.component_type);
            return Err(ModelFault::broken(place(number), format!("{problem} is not what belongs there")));
        };
        let count = self.count(number)?.min(most) as usize;
        self.spend_numbers((count * N) as u64)?;
        let size = kind.size();
        let decode = |element: &[u8]| -> [T; N] {
            std::array::from_fn(|k| component(&element[k * size..(k + 1) * size], kind, accessor.normalized))
        };
        let mut values = match accessor.buffer_view {
            Some(view) => {
                let span = Span { view, offset: accessor.byte_offset, count, size: size * N };
                self.slices(number, span)?.map(decode).collect()
            }
            // Without data all is 0, says the specification.
            None => vec![[T::default(); N]; count],
        };
        if let Some(sparse) = &accessor.sparse {
            self.replace(number, sparse, size, &mut values, decode)?;
        }
        Ok(values)
    }

    /// Puts the elements of a sparse accessor that differ from the others in place; `size` of a component in bytes.
    fn replace<T, const N: usize>(
        &self,
        number: u32,
        sparse: &Sparse,
        size: usize,
        values: &mut [[T; N]],
        decode: impl Fn(&[u8]) -> [T; N],
    ) -> Result<(), ModelFault> {
        let broken = |problem: String| ModelFault::broken(place(number), problem);
        let kind = Component::of(sparse.indices.component_type)
            .filter(|kind| matches!(kind, Component::U8 | Component::U16 | Component::U32))
            .ok_or_else(|| broken("its sparse indices are of an unknown kind".into()))?;
        let all = self.accessor(number)?.count;
        if sparse.count > all {
            return Err(broken(format!("{} sparse values for {all} elements", sparse.count)));
        }
        let count = sparse.count as usize;
        self.spend_numbers((count * (N + 1)) as u64)?;
        let (indices, news) = (&sparse.indices, &sparse.values);
        let at = Span { view: indices.buffer_view, offset: indices.byte_offset, count, size: kind.size() };
        let new = Span { view: news.buffer_view, offset: news.byte_offset, count, size: size * N };
        for (index, new) in self.slices(number, at)?.zip(self.slices(number, new)?) {
            let index = integer(index, kind);
            if u64::from(index) >= all {
                return Err(broken(format!("sparse index {index} of {all} elements")));
            }
            if let Some(value) = values.get_mut(index as usize) {
                *value = decode(new);
            }
        }
        Ok(())
    }

    /// The bytes of each element of a span, once the whole of it is known to lie inside view and buffer.
    fn slices(&self, number: u32, span: Span) -> Result<impl Iterator<Item = &[u8]>, ModelFault> {
        let view = self.view(span.view)?;
        let broken = |problem: String| ModelFault::broken(place(number), problem);
        let stride = match view.stride.filter(|stride| *stride > 0).map(usize::try_from) {
            None => span.size,
            Some(Ok(stride)) if stride >= span.size => stride,
            Some(_) => {
                return Err(broken(format!("its elements are longer than the stride of bufferViews[{}]", span.view)));
            }
        };
        let used = span.count.checked_sub(1).map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(span.size));
        let bytes = usize::try_from(span.offset)
            .ok()
            .zip(used)
            .and_then(|(offset, used)| view.bytes.get(offset..offset.checked_add(used)?))
            .ok_or_else(|| broken(format!("it ends beyond bufferViews[{}] ({} bytes)", span.view, view.bytes.len())))?;
        // The last element may be shorter than the stride, which is why these are no exact chunks.
        Ok((0..span.count).map(move |k| &bytes[k * stride..k * stride + span.size]))
    }
}

#[derive(Clone, Copy)]
struct Span {
    view: u32,
    offset: u64,
    count: usize,
    /// Bytes of one element.
    size: usize,
}

fn place(accessor: u32) -> String {
    format!("accessors[{accessor}]")
}

/// The kinds of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(code: u32) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }
}

/// Components of an element; 0 for an unknown shape.
fn width(shape: &str) -> usize {
    match shape {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => 0,
    }
}

fn float(bytes: &[u8], kind: Component, normalized: bool) -> f32 {
    let (value, full) = match kind {
        Component::F32 => return f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
        Component::I8 => (f32::from(bytes[0] as i8), 127.0),
        Component::U8 => (f32::from(bytes[0]), 255.0),
        Component::I16 => (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])), 32_767.0),
        Component::U16 => (f32::from(u16::from_le_bytes([bytes[0], bytes[1]])), 65_535.0),
        Component::U32 => (integer(bytes, kind) as f32, u32::MAX as f32),
    };
    if normalized { (value / full).max(-1.0) } else { value }
}

fn integer(bytes: &[u8], kind: Component) -> u32 {
    match kind {
        Component::U8 | Component::I8 => u32::from(bytes[0]),
        Component::U16 | Component::I16 => u32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
        Component::U32 | Component::F32 => u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
    }
}
