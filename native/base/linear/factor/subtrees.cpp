#include "linear/factor/subtrees.h"

#include "execution/thread_share.h"

#include <algorithm>
#include <functional>

namespace koebe::detail {
namespace {

constexpr double largest_share = 0.1;    // share of a subtree in the whole work
constexpr double worth_sharing = 4.0e6;  // less work takes less time than the start of a thread

}  // namespace

/// Cuts a subtree that is too large: its root goes to the top. Work is counted in multiplications.
Subtrees::Subtrees(const Supernodes& l, const std::vector<char>& chosen)
{
    const Index count = l.count();
    std::vector<double> work(count, 0.0);
    double all = 0.0;
    for (Index s = 0; s < count; ++s) {
        if (!chosen[s]) continue;
        const double own = static_cast<double>(l.width(s)) * l.height(s) * l.height(s);
        all += own;
        work[s] += own;
        if (l.parent(s) != s) work[l.parent(s)] += work[s];
    }
    std::vector<Index> subtree(count, -1);  // of each supernode; -1: the top
    for (Index s = count; s-- > 0;) {
        if (!chosen[s]) continue;
        const Index parent = l.parent(s);
        if (parent != s && subtree[parent] >= 0) {
            subtree[s] = subtree[parent];
        } else if (all >= worth_sharing && work[s] <= largest_share * all) {
            subtree[s] = static_cast<Index>(subtrees_.size());
            subtrees_.emplace_back();
        }
    }
    for (Index s = 0; s < count; ++s)
        if (chosen[s]) (subtree[s] >= 0 ? subtrees_[subtree[s]] : top_).push_back(s);
    // Start with the longest work; put the subtrees with least work together.
    std::ranges::stable_sort(subtrees_, std::greater<>(),
                             [&](const std::vector<Index>& one) { return work[one.back()]; });
    constexpr std::size_t most = 64;
    while (subtrees_.size() > most) {
        subtrees_[most - 1].insert(subtrees_[most - 1].end(), subtrees_.back().begin(), subtrees_.back().end());
        subtrees_.pop_back();
    }
    if (subtrees_.size() == most) std::ranges::sort(subtrees_.back());
}

void Subtrees::each_subtree(const Work& work) const
{
    if (subtrees_.empty()) return;
    each_beside(subtrees_.size(), [&](std::size_t i) { work(subtrees_[i]); });
}

void Subtrees::upward(const Work& work) const
{
    each_subtree(work);
    work(top_);
}

void Subtrees::downward(const Work& work) const
{
    work(top_);
    each_subtree(work);
}

}  // namespace koebe::detail
