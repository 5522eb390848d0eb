#include "kernel/io/record/finite_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

std::size_t drop_infinite_values(Attribute& attribute) {
    const auto is_infinite = [](double x) { return std::isinf(x); };
    if (std::none_of(attribute.values.begin(), attribute.values.end(), is_infinite)) return 0;
    std::size_t count = 0;
    for (Index i = 0; i < attribute.size(); ++i) {
        const std::span<double> values = attribute.at(i);
        if (std::none_of(values.begin(), values.end(), is_infinite)) continue;
        std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
        ++count;
    }
    return count;
}

}  // namespace

void drop_infinite_values(AttributeSet& attributes, Report& report) {
    for (Attribute& attribute : attributes.all()) {
        const std::size_t count = drop_infinite_values(attribute);
        if (count > 0) report.add(FindingKind::values_not_finite, count, in_quotes(attribute.name));
    }
}

}  // namespace lissom
