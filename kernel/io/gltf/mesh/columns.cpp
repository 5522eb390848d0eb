#include "kernel/io/gltf/mesh/columns.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace lissom {
namespace {

constexpr double kNoColumn = std::numeric_limits<double>::quiet_NaN();

double fill_of(const std::string& name) {
    if (name.starts_with("color")) return 1.0;
    return name == "joints" || name == "weights" ? 0.0 : kNoColumn;
}

}  // namespace

std::vector<double> widened(std::span<const double> values, Index from, Index to, double fill) {
    const std::size_t old_width = from, width = to;
    const std::size_t count = values.size() / old_width;
    std::vector<double> result(count * width, fill);
    for (std::size_t i = 0; i < count; ++i) {
        const auto begin = values.begin() + i * old_width;
        // An element without values stays without.
        if (begin[0] != begin[0]) std::fill_n(result.begin() + i * width, width, kNoColumn);
        std::copy(begin, begin + from, result.begin() + i * width);
    }
    return result;
}

void AttributeColumns::add(const std::string& name, Index width, ScalarType type, std::size_t first,
                           std::span<const double> values) {
    const auto [entry, is_new] = number_of_.emplace(name, columns_.size());
    if (is_new) {
        columns_.push_back({name, Domain::vertex, width, type, {}});
        width_ += at(width);
    }
    Attribute& column = columns_[entry->second];
    if (column.type != type) column.type = ScalarType::float32;
    if (column.width < width) {
        column.values = widened(column.values, column.width, width, fill_of(name));
        width_ += at(width - column.width);
        column.width = width;
    }
    column.values.resize(first * column.width, kNoColumn);
    if (column.width == width) {
        column.values.insert(column.values.end(), values.begin(), values.end());
    } else {
        const auto wide = widened(values, width, column.width, fill_of(name));
        column.values.insert(column.values.end(), wide.begin(), wide.end());
    }
}

void AttributeColumns::finish(AttributeSet& attributes, std::size_t vertex_count) {
    for (Attribute& column : columns_) {
        column.values.resize(vertex_count * column.width, kNoColumn);
        attributes.add(std::move(column));
    }
}

}  // namespace lissom
