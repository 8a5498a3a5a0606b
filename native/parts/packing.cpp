#include "parts/packing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace koebe {
namespace {

constexpr std::size_t many = 1000;  // boxes: fewer widths are tried

struct Step {
    double x, width, y;
};

/// Packs into a strip of that width; returns the height.
double pack_strip(const std::vector<Box>& boxes, const std::vector<std::size_t>& order, double width, double gap,
                  std::vector<std::array<double, 2>>& corners)
{
    std::vector<Step> skyline{{0.0, width, 0.0}};
    double height = 0.0;
    for (const std::size_t i : order) {
        const double w = boxes[i].width + gap, h = boxes[i].height + gap;
        double best_y = std::numeric_limits<double>::infinity(), best_x = 0.0;
        for (std::size_t s = 0; s < skyline.size() && skyline[s].x + w <= width * (1.0 + 1e-12); ++s) {
            double y = 0.0;
            for (std::size_t r = s; r < skyline.size() && skyline[r].x < skyline[s].x + w; ++r)
                y = std::max(y, skyline[r].y);
            if (y < best_y) {
                best_y = y;
                best_x = skyline[s].x;
            }
        }
        corners[i] = {best_x, best_y};
        height = std::max(height, best_y + h);
        std::vector<Step> next;
        for (const Step& step : skyline) {
            const double end = step.x + step.width, until = best_x + w;
            if (step.x < best_x) next.push_back({step.x, std::min(end, best_x) - step.x, step.y});
            if (end > until) next.push_back({std::max(step.x, until), end - std::max(step.x, until), step.y});
        }
        next.push_back({best_x, w, best_y + h});
        std::ranges::sort(next, [](const Step& a, const Step& b) { return a.x < b.x; });
        skyline = std::move(next);
    }
    return height;
}

}  // namespace

PackedBoxes pack_boxes(const std::vector<Box>& boxes, double margin)
{
    PackedBoxes best;
    best.corners.resize(boxes.size());
    best.side = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> order(boxes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return boxes[a].height > boxes[b].height; });
    double area = 0.0, widest = 0.0;
    for (const Box& box : boxes) {
        area += box.width * box.height;
        widest = std::max(widest, box.width);
    }
    const double least = std::max(std::sqrt(area), widest);
    const double factor = boxes.size() > many ? 1.1 : 1.02;
    for (double width = least; width < 2.5 * least; width *= factor) {
        const double gap = margin * width;
        std::vector<std::array<double, 2>> corners(boxes.size());
        const double strip = std::max(width, widest + gap);
        const double height = pack_strip(boxes, order, strip, gap, corners);
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
