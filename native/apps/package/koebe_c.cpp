#include "package/koebe_c.h"

#include "core/error_description.h"
#include "core/errors.h"
#include "exit_code.h"
#include "pipeline/uniformize.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <limits>
#include <string>
#include <string_view>

namespace koebe {
namespace {

static_assert(KOEBE_DONE == int(done) && KOEBE_BROKEN == int(broken) && KOEBE_WRONG_USAGE == int(wrong_usage) &&
              KOEBE_CANNOT_BE_MAPPED == int(cannot_be_mapped) && KOEBE_NOT_CONVERGED == int(not_converged));

/// Copies as much of a text as has room.
void put_message(std::string_view text, char* message, std::size_t size) noexcept
{
    if (message == nullptr || size == 0) return;
    const std::size_t length = std::min(text.size(), size - 1);
    std::memcpy(message, text.data(), length);
    message[length] = '\0';
}

void require_array(const void* array, std::int64_t count, const std::string& name)
{
    if (count < 0 || count > std::numeric_limits<Index>::max())
        throw InputError("the number of " + name + " must be from 0 to 2147483647, not " + std::to_string(count));
    if (array == nullptr && count > 0) throw InputError("there is no array of " + name);
}

UniformizeOptions map_options(const koebe_options& given)
{
    UniformizeOptions options;
    options.even = given.even;
    if (given.threads < 0) throw InputError("the number of threads must not be negative");
    options.threads = given.threads;
    for (const Index vertex : {given.outer_vertex, given.center, given.point})
        if (vertex < -1) throw InputError("vertices are numbered from 0; -1 is no vertex");
    options.outer = given.outer_vertex < 0 ? OuterLoop::automatic : OuterLoop::vertex;
    options.outer_vertex = given.outer_vertex;
    options.center = given.center;
    options.point = given.point;
    return options;
}

koebe_report c_report(const UniformizeResult& map)
{
    const Distortion& distortion = map.distortion;
    return {static_cast<std::int64_t>(map.loops.size()),
            static_cast<std::int64_t>(distortion.flipped.size()),
            static_cast<std::int64_t>(distortion.below_resolution.size()),
            distortion.angle_error_deg.mean,
            distortion.lost_area,
            map.seconds.total};
}

/// A sentence for a map that is not done.
std::string why_not_done(const UniformizeResult& map)
{
    return map.warnings.empty() ? "the iteration did not converge" : map.warnings.back().text();
}

/// @return an ExitCode, for an error that is being handled
int code_of(const ErrorDescription& error)
{
    if (error.name == "InputError") return wrong_usage;
    return error.is_koebe_error || error.name == "MemoryError" ? cannot_be_mapped : broken;
}

}  // namespace
}  // namespace koebe

int koebe_uniformize(const double* vertices, int64_t vertex_count, const int32_t* triangles, int64_t triangle_count,
                     const koebe_options* options, double* uv, koebe_circle* circles, int64_t circle_count,
                     koebe_report* report, char* message, size_t message_size) noexcept
{
    using namespace koebe;
    try {
        require_array(vertices, vertex_count, "vertices");
        require_array(triangles, triangle_count, "triangles");
        require_array(uv, vertex_count, "UVs");
        require_array(circles, circle_count, "circles");
        constexpr koebe_options defaults = KOEBE_DEFAULT_OPTIONS;
        const UniformizeOptions chosen = map_options(options == nullptr ? defaults : *options);
        const Vertices positions = Eigen::Map<const Vertices>(vertices, vertex_count, 3);
        const Triangles faces = Eigen::Map<const Triangles>(triangles, triangle_count, 3);
        ExecutionContext context;
        const UniformizeResult map = uniformize_here(positions, faces, chosen, context);
        const std::string words = map.converged ? "" : why_not_done(map);
        // Nothing can fail from here on.
        Eigen::Map<PlanarPoints>(uv, vertex_count, 2) = map.uv;
        const auto written = static_cast<std::size_t>(circle_count);
        for (std::size_t k = 0; k < std::min(written, map.loops.size()); ++k) {
            const Circle& circle = map.loops[k].circle;
            circles[k] = {circle.center.real(), circle.center.imag(), circle.radius};
        }
        if (report != nullptr) *report = c_report(map);
        put_message(words, message, message_size);
        return map.converged ? done : not_converged;
    } catch (...) {
        try {
            const ErrorDescription error = describe_error(std::current_exception())
                                               .value_or(ErrorDescription{"SolverError", "an error of no known type"});
            put_message(error.name + ": " + error.message, message, message_size);
            return code_of(error);
        } catch (...) {  // no memory even for the message
            put_message("MemoryError", message, message_size);
            return cannot_be_mapped;
        }
    }
}
