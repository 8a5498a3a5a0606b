#include "flat/common_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace koebe;

namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// By the table of all beginnings, read from its start on: at equal length a's name is left out first.
Pairs by_table(const std::vector<Index>& a, const std::vector<Index>& b)
{
    std::vector longest(a.size() + 1, std::vector<int>(b.size() + 1, 0));
    for (std::size_t i = a.size(); i-- > 0;)
        for (std::size_t j = b.size(); j-- > 0;)
            longest[i][j] = a[i] == b[j] ? longest[i + 1][j + 1] + 1 : std::max(longest[i + 1][j], longest[i][j + 1]);
    Pairs pairs;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();)
        if (a[i] == b[j])
            pairs.emplace_back(i++, j++);
        else
            (longest[i + 1][j] >= longest[i][j + 1] ? i : j) += 1;
    return pairs;
}

}  // namespace

TEST(CommonSequence, IsTheOneOfTheTable)
{
    std::mt19937 random(1);
    for (int round = 0; round < 3000; ++round) {
        const Index names = 1 + static_cast<Index>(random() % 30);
        std::vector<Index> a(random() % 40), b(random() % 40);
        for (std::vector<Index>* list : {&a, &b})
            std::ranges::generate(*list, [&] { return static_cast<Index>(random() % names); });
        EXPECT_EQ(common_sequence(a, b), by_table(a, b)) << round;
    }
}
