#include "report/parts_svg.h"

#include "packing/tile_packing.h"
#include "report/picture_units.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

/// Frames and UDIM numbers.
std::string tiles_svg(int tiles, int rows)
{
    std::string svg = "<g fill=\"none\" stroke=\"#8a93a6\" stroke-width=\"12\" font-size=\"400\">\n";
    for (int k = 0; k < tiles; ++k) {
        const int row = rows - 1 - k / tiles_in_row;
        const std::string side = pixels(1.0),
                          place = "x=\"" + pixels(k % tiles_in_row) + "\" y=\"" + pixels(row) + "\"";
        svg.append("<rect ").append(place).append(" width=\"").append(side).append("\" height=\"").append(side);
        svg.append("\"/>\n<text ").append(place).append(" dx=\"100\" dy=\"450\" fill=\"#33415c\" stroke=\"none\">");
        svg.append(std::to_string(1001 + k)).append("</text>\n");
    }
    return svg + "</g>\n";
}

}  // namespace

std::string parts_svg(const PlanarPoints& corner_uv, const std::vector<Index>& part, int tiles)
{
    const int columns = std::min(tiles, tiles_in_row), rows = (tiles + tiles_in_row - 1) / tiles_in_row;
    Index count = 0;
    for (const Index p : part) count = std::max(count, p + 1);
    std::vector<std::string> paths(static_cast<std::size_t>(count));
    for (std::size_t f = 0; f < part.size(); ++f) {
        if (part[f] < 0) continue;
        std::string& path = paths[static_cast<std::size_t>(part[f])];
        for (int k = 0; k < 3; ++k) {
            const auto corner = corner_uv.row(3 * static_cast<Eigen::Index>(f) + k);
            path += (k == 0 ? 'M' : 'L') + pixels(corner[0]) + " " + pixels(rows - corner[1]);
        }
        path += "z";
    }
    const std::string width = pixels(columns), height = pixels(rows);
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " + height +
                      "\" width=\"" + std::to_string(1000 * columns) + "\" height=\"" + std::to_string(1000 * rows) +
                      "\">\n<title>" + std::to_string(count) + " parts</title>\n<rect width=\"" + width +
                      "\" height=\"" + height +
                      "\" fill=\"#ffffff\"/>\n"
                      "<g stroke=\"#33415c\" stroke-width=\"3\" stroke-linejoin=\"round\">\n";
    for (std::size_t k = 0; k < paths.size(); ++k) {
        const int hue = static_cast<int>(std::lround(137.508 * static_cast<double>(k))) % 360;  // the golden angle
        svg += "<path fill=\"hsl(" + std::to_string(hue) + ",60%,70%)\" d=\"" + paths[k] + "\"/>\n";
    }
    return svg + "</g>\n" + (tiles > 1 ? tiles_svg(tiles, rows) : "") + "</svg>\n";
}

}  // namespace koebe
