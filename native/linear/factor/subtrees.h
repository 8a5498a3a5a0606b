// An elimination tree cut into parts for several threads. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/supernodes.h"

#include <functional>
#include <vector>

namespace koebe::detail {

/// Some supernodes of a factor, which with each have its parent: subtrees without a common supernode, and the top that
/// they hang on. The same ones for any number of threads.
class Subtrees {
public:
    Subtrees() = default;
    /// @param chosen per supernode
    Subtrees(const Supernodes& l, const std::vector<char>& chosen);

    /// Some supernodes, ascending and so each after its children.
    using Work = std::function<void(const std::vector<Index>& supernodes)>;

    /// Calls work for each subtree, side by side (each_beside), and then for the top.
    void upward(const Work& work) const;
    /// For the top, and then for each subtree, side by side. Whoever goes from parents to children goes backwards.
    void downward(const Work& work) const;

private:
    void each_subtree(const Work& work) const;

    std::vector<std::vector<Index>> subtrees_;
    std::vector<Index> top_;
};

}  // namespace koebe::detail
