// The map of a square, from Rust by the C function. Built where rustc is found.
#![no_std]
#![no_main]

use core::ffi::{c_char, c_int, c_void};

extern "C" {
    fn koebe_uniformize(
        vertices: *const f64, vertex_count: i64, triangles: *const i32, triangle_count: i64, options: *const c_void,
        uv: *mut f64, circles: *mut c_void, circle_count: i64, report: *mut c_void, message: *mut c_char,
        message_size: usize,
    ) -> c_int;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {}
}

#[no_mangle]
pub extern "C" fn main() -> c_int {
    let vertices = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0];
    let triangles = [0, 1, 2, 0, 2, 3];
    let mut uv = [0.0; 8];
    let none = core::ptr::null_mut();
    let status = unsafe {
        koebe_uniformize(
            vertices.as_ptr(), 4, triangles.as_ptr(), 2, none, uv.as_mut_ptr(), none, 0, none, core::ptr::null_mut(), 0,
        )
    };
    let on_circle = |k: usize| {
        let square = uv[2 * k] * uv[2 * k] + uv[2 * k + 1] * uv[2 * k + 1];
        square > 1.0 - 1e-9 && square < 1.0 + 1e-9
    };
    if status == 0 && (0..4).all(on_circle) { 0 } else { 1 }
}
