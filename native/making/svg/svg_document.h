// The elements of an SVG as they are drawn: styles, switches and uses resolved.
#pragma once

#include "svg/svg_words.h"

namespace koebe::detail {

/// Changes a document so that what is left can be drawn element by element:
/// - The properties that rules of <style> or the attribute `style` give an element become its attributes, by the order
///   of the cascade (W3C, CSS 2.2, 6.4.1). Selectors of types, classes, ids, descendants and children are known.
/// - Elements that are not shown go: by display, visibility, opacity 0, or neither fill nor stroke, of their own or a
///   parent's.
/// - Of a <switch> the first child whose conditions hold stays (SVG 1.1, 5.8).
/// - A <use> becomes a group with a copy of its element. A <symbol> in it and an inner <svg> become groups with their
///   place, viewBox and preserveAspectRatio as a transform, cut by their viewport unless they overflow.
/// - A clip path, or a mask of plain white shapes, becomes a <mask> at the end of the group that it cuts; a shape that
///   is cut gets a group. The attributes `clip-path` and `mask` stay where they mean anything else.
/// @throws InputError uses or clip paths that contain themselves, or more than a hundred levels or 200,000 elements
void resolve(SvgDocument& document, SvgNode& root);

}  // namespace koebe::detail
