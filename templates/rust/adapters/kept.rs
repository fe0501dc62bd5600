//! The values to which the controllers of a layout refer.
#![allow(unsafe_code)] // It frees what it has leaked.

/// Values that live as long as the program, unless they are freed.
#[derive(Default)]
pub struct Kept(Vec<Leaked>);

struct Leaked {
    value: *mut (),
    free: unsafe fn(*mut ()),
}

impl Kept {
    pub fn keep<T: 'static>(&mut self, value: T) -> &'static mut T {
        let value = Box::into_raw(Box::new(value));
        self.0.push(Leaked { value: value.cast(), free: free::<T> });
        // SAFETY: it is a box that nothing else refers to, and stays one until `free`, of which the caller
        // promises that nothing uses this reference any more.
        unsafe { &mut *value }
    }

    /// Frees all values.
    ///
    /// # Safety
    /// Nothing that [`Self::keep`] has returned is used any more.
    pub unsafe fn free(self) {
        for Leaked { value, free } in self.0 {
            // SAFETY: `keep` has made the box, of the type of `free`, and it is freed once.
            unsafe { free(value) }
        }
    }
}

/// # Safety
/// `value` is a box of this type that nothing uses any more.
unsafe fn free<T>(value: *mut ()) {
    // SAFETY: as promised.
    drop(unsafe { Box::from_raw(value.cast::<T>()) });
}
