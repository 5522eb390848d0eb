/// Rows of sparse matrices under construction; private to kernel/deform.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

/// A sparse row that is built by adding to entries in any order, and read in ascending order.
template <typename Value>
class RowAccumulator {
  public:
    /// A row over columns [0, size).
    explicit RowAccumulator(Index size) : value_(at(size)), in_(at(size), 0) {}

    void add(Index column, const Value& value) {
        if (in_[column]) {
            value_[column] += value;
            return;
        }
        in_[column] = 1;
        value_[column] = value;
        columns_.push_back(column);
    }

    /// Calls use(column, value) for every entry, columns ascending, and empties the row.
    template <typename Use>
    void drain(const Use& use) {
        std::sort(columns_.begin(), columns_.end());
        for (const Index c : columns_) {
            in_[c] = 0;
            use(c, value_[c]);
        }
        columns_.clear();
    }

  private:
    std::vector<Value> value_;
    std::vector<char> in_;
    std::vector<Index> columns_;
};

/// Appends compressed rows `part_*` to the compressed rows `begin`, `column`, `value`.
template <typename Value>
void append_rows(std::vector<Index>& begin, std::vector<Index>& column, std::vector<Value>& value,
                 const std::vector<Index>& part_begin, const std::vector<Index>& part_column,
                 const std::vector<Value>& part_value) {
    const auto shift = count_of(column);
    for (std::size_t i = 1; i < part_begin.size(); ++i) begin.push_back(part_begin[i] + shift);
    column.insert(column.end(), part_column.begin(), part_column.end());
    value.insert(value.end(), part_value.begin(), part_value.end());
}

/// Rows of a chunk in assembly: few chunks, as each needs a scratch row of the full width.
inline Index assembly_grain(Index size) {
    return std::max<Index>(1024, (size + 15) / 16);
}

}  // namespace lissom
