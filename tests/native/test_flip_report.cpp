#include "circle_domain.h"
#include "ear_domain.h"

#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

namespace {

bool says(const UniformizeResult& result, const std::string& text)
{
    for (const Warning& warning : result.warnings)
        if (warning.text().find(text) != std::string::npos) return true;
    return false;
}

}  // namespace

TEST(FlipReport, a_limb_below_resolution_is_named_with_its_place)
{
    const UniformizeResult result = map_flat(make_round_annulus(1e-9, 12, 80));
    EXPECT_FALSE(result.distortion.below_resolution.empty());
    EXPECT_EQ(result.distortion.flipped, result.distortion.below_resolution);
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_TRUE(says(result, "nearest to loop 1, shrank below the resolution of 32-bit UVs"))
        << result.warnings[0].text();
    EXPECT_TRUE(says(result, std::to_string(result.distortion.below_resolution.size()) + " faces of them"))
        << result.warnings[0].text();
}

TEST(FlipReport, a_mesh_without_inner_vertices_is_called_too_coarse)
{
    EXPECT_TRUE(says(map_flat(make_round_annulus(0.5, 12, 1)), "too coarse: 0 vertices inside and 24 on loops"));
    EXPECT_TRUE(map_flat(make_round_annulus(0.5, 12, 3)).warnings.empty());
}
