#include "execution/memory_limit.h"

#include "core/errors.h"

#if defined(_WIN32)
#include <windows.h>
#elif defined(__EMSCRIPTEN__)
#include <emscripten/heap.h>
#else
#include <sys/resource.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>

namespace koebe {
namespace {

constexpr double worth_asking = 64e6;  // bytes; the question takes some ten microseconds
#if !defined(_WIN32) && !defined(__EMSCRIPTEN__)
constexpr double unknown = std::numeric_limits<double>::infinity();

/// The number after a word in a file of lines like "MemAvailable:  123 kB", in bytes.
double number_after(const char* file, const std::string& word)
{
    std::ifstream stream(file);
    std::string key;
    double number = 0.0;
    for (std::string rest; stream >> key; std::getline(stream, rest))
        if (key == word && stream >> number) return 1024.0 * number;
    return unknown;
}

/// The single number in a file; "max" or a missing file means no limit.
double only_number(const char* file)
{
    double number = 0.0;
    return std::ifstream(file) >> number ? number : unknown;
}
#endif

}  // namespace

#if defined(_WIN32)
double available_memory()
{
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    if (!GlobalMemoryStatusEx(&status)) return std::numeric_limits<double>::infinity();
    return static_cast<double>(status.ullAvailPageFile);  // the memory that can be committed
}
#elif defined(__EMSCRIPTEN__)
double available_memory() { return static_cast<double>(emscripten_get_heap_max() - emscripten_get_heap_size()); }
#else
double available_memory()
{
    double available = number_after("/proc/meminfo", "MemAvailable:");
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        if (const double used = number_after("/proc/self/status", "VmSize:"); used < unknown)
            available = std::min(available, static_cast<double>(limit.rlim_cur) - used);
    if (const double group = only_number("/sys/fs/cgroup/memory.max"); group < unknown)
        if (const double used = only_number("/sys/fs/cgroup/memory.current"); used < unknown)
            available = std::min(available, group - used);
    return std::max(available, 0.0);
}
#endif

void require_memory(double bytes, const char* purpose)
{
    if (bytes < worth_asking) return;
    const double available = available_memory();
    if (bytes <= available) return;
    char text[160];
    std::snprintf(text, sizeof text, "not enough memory for %s: %.2g GB needed at least, %.2g GB free", purpose,
                  1e-9 * bytes, 1e-9 * available);
    throw OutOfMemory(text);
}

double memory_for_faces(std::ptrdiff_t faces)
{
    // The factor's bytes per face grow by a constant each time the surface doubles. Measured: 771 bytes a face at 0.66
    // million, 837 at 2.6 million, 896 at 10.5 million.
    const double count = static_cast<double>(faces);
    return faces < 2 ? 0.0 : count * (200.0 + 31.2 * std::log2(0.5 * count));
}

void require_memory_for_faces(std::ptrdiff_t faces)
{
    require_memory(memory_for_faces(faces), "a mesh of so many faces");
}

}  // namespace koebe
