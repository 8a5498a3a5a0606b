// Memory for the dense kernels, asked for where a refusal can be an error.
#pragma once

#include "core/api.h"

namespace koebe {

/// A working buffer of OpenBLAS for the thread that computes, for the object's lifetime.
///
/// OpenBLAS takes 128 MB of addresses for each thread that is in it, keeps them for later calls, and where the system
/// gives none it asks again for ever. So a buffer for each thread with such objects is taken before a kernel needs it.
/// @throws std::bad_alloc
class KOEBE_API KernelBuffer {
public:
    KernelBuffer();
    ~KernelBuffer();
    KernelBuffer(const KernelBuffer&) = delete;
    KernelBuffer& operator=(const KernelBuffer&) = delete;
};

}  // namespace koebe
