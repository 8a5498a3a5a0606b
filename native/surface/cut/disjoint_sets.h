// Disjoint sets of numbers (union-find), on Boost.
#pragma once

#include "core/not_copied.h"
#include "core/numbering.h"
#include "core/types.h"

#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <vector>

namespace koebe {

class DisjointSets : NotCopied {
public:
    explicit DisjointSets(std::size_t count)
        : rank_(count, 0), parent_(numbers_below(count)), sets_(Map(rank_.data()), Map(parent_.data()))
    {
    }

    Index find(Index element) { return sets_.find_set(element); }
    /// Joins two sets. Returns false if the elements were in one set before.
    bool join(Index a, Index b)
    {
        const Index of_a = find(a), of_b = find(b);
        if (of_a == of_b) return false;
        sets_.link(of_a, of_b);
        return true;
    }

private:
    // Plain pointers do not work: their `get` is found only if declared before, which depends on the order of includes.
    using Map = boost::iterator_property_map<Index*, boost::typed_identity_property_map<Index>, Index, Index&>;

    std::vector<Index> rank_, parent_;
    boost::disjoint_sets<Map, Map> sets_;
};

}  // namespace koebe
