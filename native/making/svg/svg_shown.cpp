#include "svg/svg_shown.h"

#include "svg/svg_viewport.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace koebe::detail {

bool is_cut_by(const SvgNode& node, std::string_view by)
{
    const std::string_view value = value_of(node, by);
    return !value.empty() && value != "none";
}

bool inherit(const SvgNode& node, Shown& shown)
{
    const auto take = [&](std::string_view name, bool& flag, auto off) {
        const std::string_view value = value_of(node, name);
        if (!value.empty() && value != "inherit") flag = !off(value);
    };
    const auto unpainted = [](std::string_view value) { return value == "none" || value == "transparent"; };
    take("visibility", shown.visible, [](std::string_view v) { return v == "hidden" || v == "collapse"; });
    take("fill", shown.filled, unpainted);
    take("fill", shown.coloured, [](std::string_view v) {
        constexpr std::array whites{"white", "#fff", "#ffffff", "#FFF", "#FFFFFF", "rgb(255,255,255)"};
        return std::ranges::find(whites, v) != whites.end();
    });
    take("stroke", shown.stroked, unpainted);
    const auto opacity = [&](std::string_view name) { return pixels_of(value_of(node, name), 1.0).value_or(1.0); };
    const std::string_view filter = value_of(node, "filter");
    if (opacity("opacity") < 1.0 || opacity("fill-opacity") < 1.0 || !(filter.empty() || filter == "none"))
        shown.translucent = true;
    if (shown.role == Role::drawing && (is_cut_by(node, "clip-path") || is_cut_by(node, "mask"))) shown.measured = true;
    if (shown.role != Role::clip && !(opacity("opacity") > 0.0)) shown.opaque = false;
    return value_of(node, "display") != "none" && (shown.opaque || shown.measured);
}

bool conditions_hold(const SvgNode& node)
{
    for (const auto* one = node.first_attribute(); one; one = one->next_attribute()) {
        const std::string_view name(one->local_name(), one->local_name_size());
        const std::string_view value = trimmed({one->value(), one->value_size()});
        if (name == "requiredExtensions") return false;
        if (name != "systemLanguage") continue;
        bool english = false;
        for_each_part(value, ',', [&](std::string_view word) { english = english || word.starts_with("en"); });
        if (!english) return false;
    }
    return true;
}

bool draws_nothing(std::string_view name)
{
    constexpr std::array kept{"defs",   "symbol",        "clipPath",       "mask",           "pattern",
                              "marker", "style",         "linearGradient", "radialGradient", "filter",
                              "font",   "foreignObject", "metadata",       "title",          "desc"};
    return std::ranges::find(kept, name) != kept.end();
}

}  // namespace koebe::detail
