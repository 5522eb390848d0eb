/// ColorReader: colours of vertices or faces in text without a declared form; private to kernel/io.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/mesh/attributes.h"

namespace lissom {

/// Collects colours of three or four numbers. They are bytes if all are whole numbers up to 255 and
/// one is above 1, and else fractions.
class ColorReader {
  public:
    /// The colour of `element`, which is not below those set before.
    void set(std::size_t element, std::span<const double> values);
    /// Adds attribute "color" if any element has a colour: NaN for elements without one, and opaque
    /// ones without a fourth number.
    void finish(AttributeSet& attributes, Domain domain, std::size_t element_count);

  private:
    // Four numbers an element, up to the last with a colour.
    std::vector<double> values_;
    bool has_alpha_ = false, are_bytes_ = true;
    double largest_ = 0.0;
};

}  // namespace lissom
