/// Values of points as few as tell them; private to kernel/io.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Sets `values` from one value a point: one for all if they are equal, else one a strand if those
/// of each are. `offsets` are those of strands with at least one point each.
template <typename Value>
void take_fewest(const std::vector<Index>& offsets, std::vector<Value> of_points,
                 StrandValues<Value>& values) {
    std::vector<Value> of_strands;
    bool one = true;
    for (std::size_t s = 0; s + 1 < offsets.size(); ++s) {
        const Value& first = of_points[at(offsets[s])];
        for (Index p = offsets[s]; p < offsets[s + 1]; ++p) {
            if (of_points[at(p)] == first) continue;
            values.domain = StrandDomain::point;
            values.values = std::move(of_points);
            return;
        }
        of_strands.push_back(first);
        one = one && first == of_strands.front();
    }
    values.domain = one && !of_strands.empty() ? StrandDomain::all : StrandDomain::strand;
    if (values.domain == StrandDomain::all) {
        values.common = of_strands.front();
        of_strands.clear();
    }
    values.values = std::move(of_strands);
}

}  // namespace lissom
