// Lengths and viewports of an SVG (W3C, SVG 1.1, 7).
#pragma once

#include "svg/svg_words.h"

#include <optional>
#include <string>
#include <string_view>

namespace koebe::detail {

struct Size {
    double width = 100.0, height = 100.0;
};

struct ViewBox {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/// A length in pixels; no value for what is none. @param whole what percentages are of
std::optional<double> pixels_of(std::string_view text, double whole);

std::optional<ViewBox> view_box_of(const SvgNode& node);

/// Exact: 17 digits.
std::string number_text(double number);

/// The transform from the coordinates inside an element to its viewport, with the viewport's place (SVG 1.1, 7.8).
std::string viewport_transform(const ViewBox& box, std::string_view ratio, const ViewBox& port);

/// The attribute of a shape with this length in percent of the viewport, in pixels; no value for another attribute.
std::optional<double> percentage_of(std::string_view name, std::string_view value, const Size& size);

}  // namespace koebe::detail
