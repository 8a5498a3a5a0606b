#include "report/parts_svg.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr double picture_size = 10000.0;  // picture units

std::string pixels(double t) { return std::to_string(std::lround(picture_size * std::clamp(t, 0.0, 1.0))); }

}  // namespace

std::string parts_svg(const PlanarPoints& corner_uv, const std::vector<Index>& part)
{
    Index count = 0;
    for (const Index p : part) count = std::max(count, p + 1);
    std::vector<std::string> paths(static_cast<std::size_t>(count));
    for (std::size_t f = 0; f < part.size(); ++f) {
        if (part[f] < 0) continue;
        std::string& path = paths[static_cast<std::size_t>(part[f])];
        for (int k = 0; k < 3; ++k) {
            const auto corner = corner_uv.row(3 * static_cast<Eigen::Index>(f) + k);
            path += (k == 0 ? "M" : "L") + pixels(corner[0]) + " " + pixels(1.0 - corner[1]);
        }
        path += "z";
    }
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 10000 10000\" width=\"1000\" height=\"1000\">\n"
        "<title>" +
        std::to_string(count) +
        " parts</title>\n<rect width=\"10000\" height=\"10000\" fill=\"#ffffff\"/>\n"
        "<g stroke=\"#33415c\" stroke-width=\"3\" stroke-linejoin=\"round\">\n";
    for (std::size_t k = 0; k < paths.size(); ++k) {
        const int hue = static_cast<int>(std::lround(137.508 * static_cast<double>(k))) % 360;  // the golden angle
        svg += "<path fill=\"hsl(" + std::to_string(hue) + ",60%,70%)\" d=\"" + paths[k] + "\"/>\n";
    }
    return svg + "</g>\n</svg>\n";
}

}  // namespace koebe
