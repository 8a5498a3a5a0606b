/* zig has this header of glibc 2.32 for older ones too, where it does nothing but fail; CGAL includes what is there. */
#pragma once

static const char __libc_single_threaded = 0; /* there may be threads */
