#include "report/tile_svg.h"

#include "report/picture_units.h"

#include <algorithm>

namespace koebe {

std::string tile_svg(const TileResult& result)
{
    // The tile's faces as one path, which the copies use.
    std::string faces;
    for (Eigen::Index c = 0; c < result.uv.rows(); ++c) {
        faces += (c % 3 == 0 ? 'M' : 'L') + pixels(result.uv(c, 0)) + " " + pixels(-result.uv(c, 1));
        if (c % 3 == 2) faces += "z";
    }
    // The view: the tile, with a part of its neighbours around it.
    const Eigen::RowVector2d low = result.uv.colwise().minCoeff(), high = result.uv.colwise().maxCoeff();
    const bool torus = result.periods.size() > 1;
    const double wide = 0.35 * (high[0] - low[0]), tall = (torus ? 0.35 : 0.05) * (high[1] - low[1]);
    const double left = low[0] - wide, top = -high[1] - tall;
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" + pixels(left) + " " + pixels(top) + " " +
                      pixels(high[0] - low[0] + 2.0 * wide) + " " + pixels(high[1] - low[1] + 2.0 * tall) +
                      "\" width=\"1000\">\n<title>a tile and its copies</title>\n<defs><path id=\"tile\" d=\"" + faces +
                      "\"/></defs>\n<rect x=\"" + pixels(left) + "\" y=\"" + pixels(top) +
                      "\" width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
                      "<g stroke=\"#33415c\" stroke-width=\"6\" stroke-linejoin=\"round\">\n";
    // The tile and its images under the periods.
    for (int i = -2; i <= 2; ++i)
        for (int j = torus ? -2 : 0; j <= (torus ? 2 : 0); ++j) {
            double u = i * result.periods[0][0], v = i * result.periods[0][1];
            if (torus) {
                u += j * result.periods[1][0];
                v += j * result.periods[1][1];
            }
            const char* fill = i == 0 && j == 0 ? "#8fb3e0" : (i + j) % 2 == 0 ? "#e6ebf2" : "#f4e3d0";
            svg += "<use href=\"#tile\" x=\"" + pixels(u) + "\" y=\"" + pixels(-v) + "\" fill=\"" + fill + "\"/>\n";
        }
    return svg + "</g>\n</svg>\n";
}

}  // namespace koebe
