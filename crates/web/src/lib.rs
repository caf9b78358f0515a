//! The library of the page in a browser, through plain WebAssembly exports.
//!
//! The page writes the name of a call and a scene into memory from `allocate`, calls `call`, and reads four numbers at the address
//! that it returns: where the JSON is and its bytes, where the numbers are and their count. `release` frees them.

mod answers;

pub use answers::{Answer, answer};

#[cfg(target_arch = "wasm32")]
#[allow(unsafe_code, reason = "memory is shared with the page by pointers")]
mod exports {
    use crate::answer;
    use std::mem::ManuallyDrop;
    use std::slice;

    /// Bytes that the page writes, and hands back with [`call`], which frees them.
    #[unsafe(no_mangle)]
    extern "C" fn allocate(bytes: usize) -> *mut u8 {
        ManuallyDrop::new(vec![0_u8; bytes].into_boxed_slice()).as_mut_ptr()
    }

    /// Answers a call: its name and the scene are the first `named` and all other bytes.
    #[unsafe(no_mangle)]
    extern "C" fn call(
        from: *mut u8,
        bytes: usize,
        named: usize,
        first: usize,
        end: usize,
    ) -> *mut usize {
        // SAFETY: `from` comes from `allocate(bytes)`, and the page does not use it again
        let given = unsafe { Box::from_raw(slice::from_raw_parts_mut(from, bytes)) };
        let (name, scene) = given.split_at(named.min(bytes));
        let [name, scene] = [name, scene].map(String::from_utf8_lossy);
        let found = answer(&name, &scene, first..end);
        let text = ManuallyDrop::new(found.json.to_string().into_bytes().into_boxed_slice());
        let numbers = ManuallyDrop::new(found.numbers.into_boxed_slice());
        let head = [
            text.as_ptr() as usize,
            text.len(),
            numbers.as_ptr() as usize,
            numbers.len(),
        ];
        Box::into_raw(Box::new(head)).cast()
    }

    /// Frees an answer.
    #[unsafe(no_mangle)]
    extern "C" fn release(head: *mut usize) {
        // SAFETY: `head` comes from `call`, whose lists it names
        unsafe {
            let [text, bytes, numbers, count] = *Box::from_raw(head.cast::<[usize; 4]>());
            drop(Box::from_raw(slice::from_raw_parts_mut(
                text as *mut u8,
                bytes,
            )));
            drop(Box::from_raw(slice::from_raw_parts_mut(
                numbers as *mut f64,
                count,
            )));
        }
    }
}
