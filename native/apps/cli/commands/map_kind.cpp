#include "cli/commands/map_kind.h"

#include "cli/process/result_line.h"
#include "core/counted.h"

#include <string>
#include <utility>
#include <vector>

namespace koebe::cli {

std::string map_line(const MapRequest& request, const std::string& first_words, const Distortion& distortion,
                     double seconds, bool converged, const std::vector<Warning>& warnings)
{
    std::string line = one_line(request.output) + ": " + first_words + ", angle error " +
                       formatted("%.2f", distortion.angle_error_deg.mean) + " deg, " +
                       std::to_string(distortion.flipped.size()) + " flipped";
    if (const std::size_t tiny = distortion.below_resolution.size(); tiny > 0)
        line += " (" + std::to_string(tiny) + " below resolution)";
    return line + last_words(seconds, converged, warnings);
}

void add_losses(const std::string& file, const std::vector<Warning>& losses, std::vector<Warning>& warnings)
{
    for (Warning loss : losses) {
        loss.sentence = file + loss.sentence;
        warnings.push_back(std::move(loss));
    }
}

}  // namespace koebe::cli
