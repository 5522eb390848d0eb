/// DisjointSets: elements that are joined into sets. Private to kernel/mesh.
#pragma once

#include <numeric>
#include <vector>

#include "kernel/core/index.h"

namespace lissom {

class DisjointSets {
  public:
    explicit DisjointSets(Index count) : parent_(at(count)) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    void join(Index a, Index b) { parent_[at(root(a))] = root(b); }

    /// Returns the number of the set of each element, in the order of their first elements.
    std::vector<Index> numbers() {
        std::vector<Index> result(parent_.size(), kNoIndex), of_root(parent_.size(), kNoIndex);
        Index count = 0;
        for (Index i = 0; i < count_of(parent_); ++i) {
            Index& number = of_root[at(root(i))];
            if (number == kNoIndex) number = count++;
            result[at(i)] = number;
        }
        return result;
    }

  private:
    // Halves the paths on the way.
    Index root(Index i) {
        while (parent_[at(i)] != i) {
            parent_[at(i)] = parent_[at(parent_[at(i)])];
            i = parent_[at(i)];
        }
        return i;
    }

    std::vector<Index> parent_;
};

}  // namespace lissom
