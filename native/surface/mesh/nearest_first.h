// Visits the nodes of any graph in the order of their distances from a set of nodes (Dijkstra 1959).
#pragma once

#include "core/types.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace koebe {

/// The caller reaches the first nodes at distance 0, then takes the nearest node until there is none, and reaches its
/// neighbours from it. Of equally near nodes the lowest comes first.
class NearestFirst {
public:
    explicit NearestFirst(Index count) : distance_(static_cast<std::size_t>(count), infinite) {}

    /// @return whether the node was not known to be as near
    bool reach(Index node, double distance)
    {
        if (!(distance < distance_[node])) return false;
        if (distance_[node] == infinite) reached_.push_back(node);
        distance_[node] = distance;
        queue_.emplace(distance, node);
        return true;
    }

    /// Takes the nearest node that was not taken yet. @return -1: all that can be reached were taken
    Index take()
    {
        while (!queue_.empty()) {
            const auto [distance, node] = queue_.top();
            queue_.pop();
            if (!(distance > distance_[node])) return node;
        }
        return -1;
    }

    /// Forgets all nodes, at the cost of those that were reached.
    void reset()
    {
        for (const Index node : reached_) distance_[node] = infinite;
        reached_.clear();
        queue_ = {};
    }

    /// (count) infinite for nodes that were not reached.
    const std::vector<double>& distance() const { return distance_; }

private:
    static constexpr double infinite = std::numeric_limits<double>::infinity();
    using Entry = std::pair<double, Index>;

    std::vector<double> distance_;
    std::vector<Index> reached_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace koebe
