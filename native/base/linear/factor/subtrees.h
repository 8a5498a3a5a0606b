// Cuts an elimination tree into subtrees for several threads. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/supernodes.h"

#include <functional>
#include <vector>

namespace koebe::detail {

/// Cuts chosen supernodes of a factor into subtrees without a common supernode, and the top above them. The chosen
/// supernodes include the parent of each. Any number of threads gives the same subtrees.
class Subtrees {
public:
    Subtrees() = default;
    /// @param chosen per supernode
    Subtrees(const Supernodes& l, const std::vector<char>& chosen);

    /// Work on some supernodes in ascending order, so each comes after its children.
    using Work = std::function<void(const std::vector<Index>& supernodes)>;

    /// Calls work for each subtree, side by side (each_beside), and then for the top.
    void upward(const Work& work) const;
    /// Calls work for the top, and then for each subtree, side by side. To visit parents first, work goes backwards.
    void downward(const Work& work) const;

private:
    void each_subtree(const Work& work) const;

    std::vector<std::vector<Index>> subtrees_;
    std::vector<Index> top_;
};

}  // namespace koebe::detail
