// What a map promises, looked at without the library's own check (pipeline/final_check.h).
#pragma once

#include "surface_facts.h"

#include "pipeline/result.h"

#include <stdexcept>
#include <string>

namespace koebe::fuzz {

/// A finding.
class PromiseBroken : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

inline void require(bool kept, const std::string& promise)
{
    if (!kept) throw PromiseBroken(promise);
}

/// In any case: what the report says of flips and loops is so. If it says converged: finite, in the closed disk,
/// circles positive, inside and apart, loops on them and simple, no face flipped that could be drawn.
/// @throws PromiseBroken
void check_map(const Soup& soup, const SurfaceFacts& facts, const UniformizeResult& result);

}  // namespace koebe::fuzz
