// What of an SVG is shown, by what its elements say of themselves.
#pragma once

#include "svg/svg_words.h"

#include <string_view>

namespace koebe::detail {

/// What an element is taken for: where it is drawn, or what of it cuts.
enum class Role { drawing, clip, mask };

/// What children inherit.
struct Shown {
    Role role = Role::drawing;
    bool visible = true, filled = true, stroked = false;
    bool opaque = true;                         ///< not in an element of opacity 0
    bool measured = false;                      ///< in an element that is cut, perhaps in units of its bounding box
    bool coloured = true, translucent = false;  ///< what is not plain white in a mask
};

/// Whether a clip path or a mask cuts an element. @param by the attribute
bool is_cut_by(const SvgNode& node, std::string_view by);

/// Takes over what an element says of itself. @return false if neither it nor its children are drawn or measured
bool inherit(const SvgNode& node, Shown& shown);

/// The conditional attributes (SVG 1.1, 5.8). No extension is known, and the language is English.
bool conditions_hold(const SvgNode& node);

/// Whether elements of this name are only used by others, or mean nothing here.
bool draws_nothing(std::string_view name);

}  // namespace koebe::detail
