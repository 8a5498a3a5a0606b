#include "svg/svg_viewport.h"

#include "core/counted.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

namespace koebe::detail {

std::optional<double> pixels_of(std::string_view text, double whole)
{
    double number = 0.0;
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || !std::isfinite(number)) return {};
    const std::string_view unit = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
    constexpr std::array<std::pair<std::string_view, double>, 8> units{{{"px", 1.0},
                                                                        {"in", 96.0},
                                                                        {"cm", 96.0 / 2.54},
                                                                        {"mm", 96.0 / 25.4},
                                                                        {"pt", 96.0 / 72.0},
                                                                        {"pc", 16.0},
                                                                        {"em", 16.0},
                                                                        {"ex", 8.0}}};
    if (unit.empty()) return number;
    if (unit == "%") return 0.01 * number * whole;
    const auto found = std::ranges::find(units, unit, &std::pair<std::string_view, double>::first);
    return found == units.end() ? std::nullopt : std::optional(number * found->second);
}

std::optional<ViewBox> view_box_of(const SvgNode& node)
{
    std::vector<double> numbers;
    for (const std::string_view word : words_of(value_of(node, "viewBox"), " ,\t\r\n"))
        if (const auto number = pixels_of(word, 1.0)) numbers.push_back(*number);
    if (numbers.size() != 4 || !(numbers[2] > 0.0 && numbers[3] > 0.0)) return {};
    return ViewBox{numbers[0], numbers[1], numbers[2], numbers[3]};
}

std::string number_text(double number) { return formatted("%.17g", number); }

std::string viewport_transform(const ViewBox& box, std::string_view ratio, const ViewBox& port)
{
    double wide = port.width / box.width, high = port.height / box.height, left = 0.0, low = 0.0;
    if (!ratio.starts_with("none")) {
        const bool slice = ratio.find("slice") != std::string_view::npos;
        const double scale = slice ? std::max(wide, high) : std::min(wide, high);
        wide = high = scale;
        const auto share = [&](std::string_view least, std::string_view most) {
            return ratio.find(least) != std::string_view::npos  ? 0.0
                   : ratio.find(most) != std::string_view::npos ? 1.0
                                                                : 0.5;
        };
        left = share("xMin", "xMax") * (port.width - scale * box.width);
        low = share("YMin", "YMax") * (port.height - scale * box.height);
    }
    return "matrix(" + number_text(wide) + " 0 0 " + number_text(high) + " " +
           number_text(port.x + left - wide * box.x) + " " + number_text(port.y + low - high * box.y) + ")";
}

std::optional<double> percentage_of(std::string_view name, std::string_view value, const Size& size)
{
    if (!value.ends_with('%')) return {};
    if (name == "x" || name == "cx" || name == "rx" || name == "width") return pixels_of(value, size.width);
    if (name == "y" || name == "cy" || name == "ry" || name == "height") return pixels_of(value, size.height);
    if (name == "r") return pixels_of(value, std::hypot(size.width, size.height) / std::sqrt(2.0));
    return {};
}

}  // namespace koebe::detail
