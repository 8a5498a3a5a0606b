// Counts and limits the cost of turning flipped faces back.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <unordered_set>

namespace koebe {

/// The unit is a Newton step for one face, so that the search ends at the same place on every machine.
class RepairEffort {
public:
    /// Allows the cost of 30 steps of the whole surface, and in addition `small`, or the cost of 2,000 steps if this is
    /// less.
    /// @param faces of the surface
    explicit RepairEffort(Eigen::Index faces, std::size_t small = 100000);

    std::size_t most() const { return most_; }
    std::size_t spent() const { return spent_; }
    std::size_t left() const { return most_ - spent_; }
    /// Limits the total spent so far and from now on.
    void set_limit(std::size_t limit) { limit_ = limit; }

    /// From now on allows as much as at the start.
    void renew();

    /// Number of Newton steps allowed for so many faces; 0 if they are too few to be of use.
    int affordable(Eigen::Index faces) const;
    bool exhausted() const { return affordable(0) == 0; }
    void spend(Eigen::Index faces, int steps);

    /// Whether this problem has failed before; it would fail again.
    bool has_failed(std::uint64_t problem) const { return failed_.contains(problem); }
    void note_failure(std::uint64_t problem) { failed_.insert(problem); }

private:
    std::size_t all_, most_, limit_, spent_ = 0;
    std::unordered_set<std::uint64_t> failed_;
};

}  // namespace koebe
