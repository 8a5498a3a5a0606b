// Random islands, and what is true of packed ones, measured on their outlines.
#pragma once

#include "packing/packing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace koebe::test {

using Rim = std::vector<Complex>;

/// A polygon that is a star round the origin, some of them slivers, some with a hole.
inline Outline random_island(std::mt19937_64& random)
{
    const auto uniform = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    const auto count = static_cast<int>(3 + random() % 40);
    const bool has_hole = random() % 3 == 0;
    const double size = std::exp(uniform(-4.0, 0.0)), flat = random() % 4 == 0 ? uniform(1e-3, 0.1) : uniform(0.3, 1.0);
    const double rough = uniform(0.0, 0.8);
    const Complex turn = std::polar(1.0, uniform(0.0, 6.3)), place(uniform(-9.0, 9.0), uniform(-9.0, 9.0));
    Outline outline;
    outline.points.resize(has_hole ? 2 * count : count, 2);
    outline.loops.resize(has_hole ? 2 : 1);
    for (int i = 0; i < count; ++i) {
        const Complex z = std::polar(size * (1.0 - uniform(0.0, rough)), 2.0 * std::numbers::pi * i / count);
        const Complex at = turn * Complex(z.real(), flat * z.imag());
        for (int k = 0; k < (has_hole ? 2 : 1); ++k) {
            const Complex p = place + (k == 0 ? 1.0 : 0.8) * at;
            outline.points.row(i + k * count) << p.real(), p.imag();
            auto& loop = outline.loops[static_cast<std::size_t>(k)];
            loop.insert(k == 0 ? loop.end() : loop.begin(), static_cast<Index>(i + k * count));
        }
    }
    return outline;
}

inline Outline rectangle(double width, double height, double angle)
{
    Outline outline;
    outline.points.resize(4, 2);
    const Complex turn = std::polar(1.0, angle);
    int i = 0;
    for (const Complex& z : {Complex(0, 0), Complex(width, 0), Complex(width, height), Complex(0, height)}) {
        const Complex p = turn * z;
        outline.points.row(i++) << p.real(), p.imag();
    }
    outline.loops = {{0, 1, 2, 3}};
    return outline;
}

inline double to_segment(const Complex& p, const Complex& a, const Complex& b)
{
    const double length = std::norm(b - a);
    const double t = length > 0.0 ? std::clamp(((p - a) * std::conj(b - a)).real() / length, 0.0, 1.0) : 0.0;
    return std::abs(p - a - t * (b - a));
}

inline bool segments_cross(const Complex& a, const Complex& b, const Complex& c, const Complex& d)
{
    const auto left = [](const Complex& p, const Complex& q, const Complex& r) {
        return (std::conj(q - p) * (r - p)).imag() > 0.0;
    };
    return left(a, b, c) != left(a, b, d) && left(c, d, a) != left(c, d, b);
}

/// Whether an odd number of the rims runs round the point.
inline bool covers(const std::vector<Rim>& rims, const Complex& p)
{
    bool inside = false;
    for (const Rim& rim : rims)
        for (std::size_t i = 0; i < rim.size(); ++i) {
            const Complex a = rim[i], b = rim[(i + 1) % rim.size()];
            if ((a.imag() > p.imag()) == (b.imag() > p.imag())) continue;
            inside ^= a.real() + (p.imag() - a.imag()) / (b.imag() - a.imag()) * (b.real() - a.real()) > p.real();
        }
    return inside;
}

/// The least distance of two islands, 0 if they overlap; twice that to the border counts too.
inline double least_gap(const std::vector<Outline>& outlines, const IslandPacking& packing)
{
    std::vector<std::vector<Rim>> islands;
    std::vector<std::array<double, 4>> boxes;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < outlines.size(); ++k) {
        const PlanarPoints at = place_island(outlines[k].points, packing.places[k], packing.scale);
        const Eigen::RowVector2d low = at.colwise().minCoeff(), high = at.colwise().maxCoeff();
        boxes.push_back({low[0], low[1], high[0], high[1]});
        least = std::min({least, 2.0 * low.minCoeff(), 2.0 * (1.0 - high.maxCoeff())});
        islands.emplace_back();
        for (const VertexLoop& loop : outlines[k].loops) {
            islands.back().emplace_back();
            for (const Index v : loop) islands.back().back().emplace_back(at(v, 0), at(v, 1));
        }
    }
    for (std::size_t k = 0; k < islands.size(); ++k)
        for (std::size_t other = 0; other < k; ++other) {
            const auto& [left, low, right, high] = boxes[k];
            const auto& box = boxes[other];
            if (std::max({left - box[2], box[0] - right, low - box[3], box[1] - high}) > least) continue;
            if (covers(islands[k], islands[other][0][0]) || covers(islands[other], islands[k][0][0])) return 0.0;
            for (const Rim& one : islands[k])
                for (const Rim& two : islands[other])
                    for (std::size_t i = 0; i < one.size(); ++i)
                        for (std::size_t j = 0; j < two.size(); ++j) {
                            const Complex a = one[i], b = one[(i + 1) % one.size()];
                            const Complex c = two[j], d = two[(j + 1) % two.size()];
                            if (segments_cross(a, b, c, d)) return 0.0;
                            least = std::min({least, to_segment(a, c, d), to_segment(c, a, b)});
                        }
        }
    return least;
}

}  // namespace koebe::test
