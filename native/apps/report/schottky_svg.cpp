#include "report/schottky_svg.h"

#include "schottky/group_word.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace koebe {
namespace {

constexpr double disk_size = 10000.0;    // picture units per radius
constexpr std::size_t longest_word = 3;  // of copies whose circles are drawn
constexpr std::size_t most_circles = 5000;
constexpr double least_radius = 2e-4;  // of circles large enough to be seen

std::string place_of(double t) { return std::to_string(std::lround(disk_size * t)); }

std::string circle_element(const Circle& circle)
{
    return "<circle cx=\"" + place_of(circle.center.real()) + "\" cy=\"" + place_of(-circle.center.imag()) + "\" r=\"" +
           place_of(circle.radius) + "\"/>\n";
}

/// Images of the handles' circles by longer and longer words, as long as they are large enough to be seen.
std::string circles_of_copies(const SchottkyResult& result)
{
    std::vector<LinearFractional> generators;
    for (const SchottkyHandle& handle : result.handles) generators.push_back(handle.generator);
    struct Copy {
        GroupWord word;
        Circle circle;
        int last;  // the letter that leads back
    };
    std::vector<Copy> copies;
    std::string elements;
    for (std::size_t j = 0; j < generators.size(); ++j) {
        const int letter = static_cast<int>(j) + 1;
        copies.push_back({{}, result.handles[j].circles[0], letter});
        copies.push_back({{}, result.handles[j].circles[1], -letter});
    }
    // Circle c of the domain bounds the copy beyond it; a word in front moves both.
    for (std::size_t i = 0; i < copies.size() && copies.size() < most_circles; ++i) {
        const Copy copy = copies[i];
        if (copy.word.size() == longest_word) continue;
        for (std::size_t j = 0; j < generators.size(); ++j)
            for (const int letter : {static_cast<int>(j) + 1, -static_cast<int>(j) - 1}) {
                // Its first circle lies inside the generator's second one, and so on: only circles inside are new.
                if (!copy.word.empty() && copy.word.front() == -letter) continue;
                if (copy.word.empty() && copy.last == letter) continue;
                GroupWord word = copy.word;
                word.insert(word.begin(), letter);
                const Circle circle = applied({letter}, generators, copy.circle);
                if (circle.radius > least_radius && circle.radius < 2.0) copies.push_back({word, circle, copy.last});
            }
    }
    for (const Copy& copy : copies)
        if (!copy.word.empty()) elements += circle_element(copy.circle);
    return elements;
}

}  // namespace

std::string schottky_svg(const SchottkyResult& result)
{
    std::string faces;
    for (Eigen::Index c = 0; c < result.uv.rows(); ++c) {
        faces += c % 3 == 0 ? 'M' : 'L';
        faces += place_of(2.0 * result.uv(c, 0) - 1.0) + " " + place_of(1.0 - 2.0 * result.uv(c, 1));
        if (c % 3 == 2) faces += "z";
    }
    const double width = std::clamp(600.0 / std::sqrt(static_cast<double>(result.face_count) + 1.0), 2.0, 40.0);
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-10500 -10500 21000 21000\" width=\"1000\">\n"
        "<title>a fundamental domain and the circles of its copies</title>\n"
        "<rect x=\"-10500\" y=\"-10500\" width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        "<path fill=\"#a9c3e8\" stroke=\"#33415c\" stroke-linejoin=\"round\" stroke-width=\"" +
        std::to_string(std::lround(width)) + "\" d=\"" + faces +
        "\"/>\n<g fill=\"none\" stroke=\"#d08a4a\" stroke-width=\"12\">\n" + circles_of_copies(result) +
        "</g>\n<g fill=\"none\" stroke=\"#8a3b12\" stroke-width=\"40\">\n";
    for (const SchottkyHandle& handle : result.handles)
        for (const Circle& circle : handle.circles) svg += circle_element(circle);
    svg += "</g>\n<g fill=\"none\" stroke=\"#1d5c2f\" stroke-width=\"40\">\n";
    for (const SchottkyHole& hole : result.holes) svg += circle_element(hole.circle);
    return svg + "</g>\n</svg>\n";
}

}  // namespace koebe
