/// UsdaTransform: the transform operations of one prim (UsdGeomXformable); private to kernel/io.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {

/// Collects the attributes "xformOp:..." of a prim and makes one matrix of them.
class UsdaTransform {
  public:
    /// Keeps the numbers of an operation, for instance of "xformOp:translate:pivot".
    void set_operation(std::string_view name, std::vector<double> numbers);
    /// Marks an operation whose numbers change over time.
    void set_changing(std::string_view name);
    /// Sets the value of "xformOpOrder": the operations, the one that acts last first.
    void set_order(std::vector<std::string> order, FilePlace place);

    /// Returns whether there is any operation.
    bool is_set() const { return !order_.empty(); }
    /// Returns whether the transforms of the prims around this one are ignored.
    bool resets() const;
    /// Returns the map from this prim to the one around it. Operations without a value are the
    /// identity. Errors: file_syntax for a wrong number of values; not_finite; unsupported for
    /// operations that are not known or change over time, and for matrices that cannot be inverted
    /// or are not affine.
    Affine matrix() const;

  private:
    struct Operation {
        std::vector<double> numbers;
        bool changes = false;
    };

    Affine matrix_of(const std::string& entry) const;
    Affine value_of(const std::string& name) const;

    std::map<std::string, Operation, std::less<>> operations_;
    std::vector<std::string> order_;
    FilePlace place_;
};

}  // namespace lissom
