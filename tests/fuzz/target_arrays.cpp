#include "array_checks.h"
#include "targets.h"

#include "core/errors.h"

namespace koebe::fuzz {
namespace {

constexpr Limits limits{5, 64};

}  // namespace

void fuzz_arrays(Bytes bytes)
{
    const Program program = run_program(bytes, limits);
    const auto of_surfaces = surface_checks(), of_the_plane = planar_checks();
    const std::size_t number = program.choice % (of_surfaces.size() + of_the_plane.size());
    try {
        (number < of_surfaces.size() ? of_surfaces[number] : of_the_plane[number - of_surfaces.size()])(program);
    } catch (const KoebeError&) {
    }
}

}  // namespace koebe::fuzz
