#include "parts/packing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

/// Equal boxes in their order, on every system.
template <class Rectangle, class Compare>
void stable_sort(Rectangle* rectangles, std::size_t count, std::size_t, Compare compare)
{
    std::stable_sort(rectangles, rectangles + count,
                     [&](const Rectangle& a, const Rectangle& b) { return compare(&a, &b) < 0; });
}

}  // namespace

#define STBRP_STATIC
#define STBRP_SORT stable_sort
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb/stb_rect_pack.h>

namespace koebe {
namespace {

constexpr std::size_t many = 1000;  // boxes: fewer widths are tried

constexpr double narrowest = 1e-4;  // strip, over the tallest box: heights are within an int
constexpr int grid = 1 << 14;       // of a strip's width: squares of it are within an int, as the library needs

/// Packs into a strip of that width; returns the height.
double pack_strip(const std::vector<Box>& boxes, double width, double gap, std::vector<std::array<double, 2>>& corners)
{
    const double unit = width / grid;
    std::vector<stbrp_rect> rectangles(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        rectangles[i].id = static_cast<int>(i);
        rectangles[i].w = std::min(grid, static_cast<int>(std::ceil((boxes[i].width + gap) / unit)));
        rectangles[i].h = static_cast<int>(std::ceil((boxes[i].height + gap) / unit));
    }
    stbrp_context context;
    std::vector<stbrp_node> nodes(grid);
    stbrp_init_target(&context, grid, std::numeric_limits<int>::max(), nodes.data(), grid);
    stbrp_pack_rects(&context, rectangles.data(), static_cast<int>(rectangles.size()));
    double height = 0.0;
    for (const stbrp_rect& rectangle : rectangles) {
        corners[rectangle.id] = {unit * rectangle.x, unit * rectangle.y};
        height = std::max(height, unit * (rectangle.y + rectangle.h));
    }
    return height;
}

}  // namespace

PackedBoxes pack_boxes(const std::vector<Box>& boxes, double margin)
{
    PackedBoxes best;
    best.corners.resize(boxes.size());
    best.side = std::numeric_limits<double>::infinity();
    double area = 0.0, widest = 0.0, tallest = 0.0;
    for (const Box& box : boxes) {
        area += box.width * box.height;
        widest = std::max(widest, box.width);
        tallest = std::max(tallest, box.height);
    }
    const double least = std::max({std::sqrt(area), widest, narrowest * tallest});
    const double factor = boxes.size() > many ? 1.1 : 1.02;
    for (double width = least; width < 2.5 * least; width *= factor) {
        const double gap = margin * width;
        std::vector<std::array<double, 2>> corners(boxes.size());
        const double strip = std::max(width, widest + gap);
        const double height = pack_strip(boxes, strip, gap, corners);
        const double side = std::max(strip, height) + gap;
        if (!(side < best.side)) continue;
        best.side = side;
        best.corners = std::move(corners);
        for (auto& corner : best.corners)
            for (double& x : corner) x += gap;
    }
    return best;
}

}  // namespace koebe
