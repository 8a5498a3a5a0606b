#include "linear/kernel_buffer.h"

#if defined(KOEBE_OWN_KERNELS)  // which ask for what they need, and throw where it is not there

koebe::KernelBuffer::KernelBuffer() = default;
koebe::KernelBuffer::~KernelBuffer() = default;

#else

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

extern "C" {
void* blas_memory_alloc(int processor);  // any free buffer, or a new one
void blas_memory_free(void* buffer);
}

namespace koebe {
namespace {

/// BUFFER_SIZE of OpenBLAS (common_x86_64.h, common_arm64.h) and what it is rounded up by, bytes.
constexpr std::size_t buffer_size = (std::size_t{128} << 20) + (std::size_t{64} << 10);

thread_local int objects_here = 0;

struct Pool {
    std::mutex mutex;
    std::size_t users = 0;       // threads
    std::vector<void*> buffers;  // that OpenBLAS has, as far as known
};

/// Never taken down: a computation may outlive what is.
Pool& pool()
{
    static Pool* const all = new Pool;
    return *all;
}

void require_room()
{
    void* volatile room = std::malloc(buffer_size);  // volatile, or the compiler leaves it out
    if (!room) throw std::bad_alloc();
    std::free(room);
}

class Held {
public:
    explicit Held(std::size_t most) { buffers_.reserve(most); }
    ~Held() { std::ranges::for_each(buffers_, blas_memory_free); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    void* another()
    {
        require_room();
        return buffers_.emplace_back(blas_memory_alloc(0));
    }

private:
    std::vector<void*> buffers_;
};

/// Takes buffers, and gives them back at the end, until there is one that was not known.
void find_another(std::vector<void*>& known)
{
    Held held(known.size() + 1);
    known.reserve(known.size() + 1);
    void* buffer = held.another();
    while (std::ranges::find(known, buffer) != known.end()) buffer = held.another();
    known.push_back(buffer);
}

}  // namespace

KernelBuffer::KernelBuffer()
{
    if (objects_here == 0) {
        const std::scoped_lock lock(pool().mutex);
        if (pool().users == pool().buffers.size()) find_another(pool().buffers);
        ++pool().users;
    }
    ++objects_here;
}

KernelBuffer::~KernelBuffer()
{
    if (--objects_here > 0) return;
    const std::scoped_lock lock(pool().mutex);
    --pool().users;
}

}  // namespace koebe

#endif
