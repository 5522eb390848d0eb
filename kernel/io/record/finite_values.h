/// Attribute values that are infinite; private to kernel/io.
#pragma once

#include "kernel/mesh/attributes.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Takes the value (NaN) from the elements of `attributes` that have an infinite one, and adds a
/// finding of kind values_not_finite that names the attributes. NaN is how files say that there is
/// no value, and no finding.
void drop_infinite_values(AttributeSet& attributes, Report& report);

}  // namespace lissom
