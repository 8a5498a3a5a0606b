#include "execution/thread_memory.h"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <new>

#ifdef __GLIBC__

#include <link.h>

/// The argument of __tls_get_addr [Drepper 2013, ELF Handling For Thread-Local Storage, section 3].
struct TlsPlace {
    std::size_t module, offset;
};
extern "C" void* __tls_get_addr(TlsPlace* place);  // NOLINT(clang-diagnostic-reserved-identifier)

namespace koebe::detail {
namespace {

constexpr std::size_t overhead = 64 << 10;  // bytes that the allocator adds

struct Missing {
    std::array<std::size_t, 256> modules;  // no exception may be thrown while a loader's lock is held
    std::size_t count = 0;
    std::size_t bytes = overhead;
};

int note_missing(dl_phdr_info* info, std::size_t, void* data)
{
    auto& missing = *static_cast<Missing*>(data);
    if (info->dlpi_tls_modid == 0 || info->dlpi_tls_data || missing.count == missing.modules.size()) return 0;
    missing.modules[missing.count++] = info->dlpi_tls_modid;
    for (int i = 0; i < info->dlpi_phnum; ++i)
        if (info->dlpi_phdr[i].p_type == PT_TLS) missing.bytes += info->dlpi_phdr[i].p_memsz;
    return 0;
}

}  // namespace

void take_thread_memory()
{
    Missing missing;
    dl_iterate_phdr(note_missing, &missing);
    void* volatile room = std::malloc(missing.bytes);  // volatile keeps the compiler from removing it
    if (!room) throw std::bad_alloc();
    std::free(room);
    for (std::size_t i = 0; i < missing.count; ++i) {
        TlsPlace place{missing.modules[i], 0};
        __tls_get_addr(&place);
    }
}

}  // namespace koebe::detail

#else

void koebe::detail::take_thread_memory() {}

#endif
