// Warnings that all maps give in one way: what they say.
#include "quality/shared_warnings.h"

#include <gtest/gtest.h>

namespace koebe {

TEST(SharedWarnings, what_makes_a_map_not_one_to_one_is_listed)
{
    std::vector<Warning> warnings;
    warn_not_one_to_one({1, 4}, {4}, {"", "2 circles meet", "1 loop crosses itself"}, warnings);
    warn_not_one_to_one({4}, {4}, {"2 circles meet", ""}, warnings);
    EXPECT_EQ(warnings.at(0).sentence,
              "no one-to-one map was found: 1 face flipped; 2 circles meet; 1 loop crosses itself");
    EXPECT_EQ(warnings.at(0).elements, std::vector<Index>{1});
    EXPECT_EQ(warnings.at(1).sentence, "no one-to-one map was found: 2 circles meet");
}

}  // namespace koebe
