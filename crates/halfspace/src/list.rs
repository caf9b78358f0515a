//! A short list on the stack.

/// Most cuts or singularities that an integrand of this crate has.
pub(crate) const CAPACITY: usize = 64;

/// A list of at most [`CAPACITY`] items that allocates nothing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct List<T> {
    items: [T; CAPACITY],
    length: usize,
}

impl<T: Copy + Default> List<T> {
    pub(crate) fn new() -> Self {
        Self {
            items: [T::default(); CAPACITY],
            length: 0,
        }
    }

    pub(crate) fn clear(&mut self) {
        self.length = 0;
    }

    pub(crate) fn push(&mut self, item: T) {
        debug_assert!(
            self.length < CAPACITY,
            "a landscape holds at most {CAPACITY} points"
        );
        self.items[self.length] = item;
        self.length += 1;
    }

    pub(crate) fn as_mut_slice(&mut self) -> &mut [T] {
        &mut self.items[..self.length]
    }

    pub(crate) fn as_slice(&self) -> &[T] {
        &self.items[..self.length]
    }
}
