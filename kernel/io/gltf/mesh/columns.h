/// Attributes of vertices while a mesh is put together of parts that do not all have the same;
/// private to kernel/io.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// Collects attributes of vertices block by block. Values missing in a block are NaN.
class AttributeColumns {
  public:
    /// Adds values of an attribute for the vertices from `first` on, which are not before those
    /// that were given to it last. The larger of different widths counts: a color gets an alpha of
    /// 1, and others NaN.
    void add(const std::string& name, Index width, ScalarType type, std::size_t first,
             std::span<const double> values);
    /// Numbers that `finish` will hold.
    std::size_t number_count(std::size_t vertex_count) const { return vertex_count * width_; }
    /// Adds all attributes of `vertex_count` vertices.
    void finish(AttributeSet& attributes, std::size_t vertex_count);

  private:
    std::vector<Attribute> columns_;
    std::unordered_map<std::string, std::size_t> number_of_;
    /// Numbers of all attributes at one vertex.
    std::size_t width_ = 0;
};

/// `values` of `from` numbers each with `to` numbers, the new ones being `fill`.
std::vector<double> widened(std::span<const double> values, Index from, Index to, double fill);

}  // namespace lissom
