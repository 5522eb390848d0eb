#include "kernel/io/record/color_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/core/geometry.h"
#include "kernel/io/record/mesh_data.h"

namespace lissom {
namespace {}  // namespace

void ColorReader::set(std::size_t element, std::span<const double> values) {
    values_.resize(4 * element, kNone);
    values_.insert(values_.end(), values.begin(), values.end());
    values_.resize(4 * element + 4, kNone);
    has_alpha_ = has_alpha_ || values.size() > 3;
    for (const double value : values) {
        are_bytes_ = are_bytes_ && value >= 0.0 && value <= 255.0 && value == std::floor(value);
        largest_ = std::max(largest_, value);
    }
}

void ColorReader::finish(AttributeSet& attributes, Domain domain, std::size_t element_count) {
    if (values_.empty()) return;
    values_.resize(4 * element_count, kNone);
    const bool bytes = are_bytes_ && largest_ > 1.0;
    const double scale = bytes ? 255.0 : 1.0;
    Attribute color{
        "color", domain, has_alpha_ ? 4 : 3, bytes ? ScalarType::uint8 : ScalarType::float32, {}};
    color.values.reserve(element_count * color.width);
    for (std::size_t i = 0; i < values_.size(); i += 4) {
        for (std::size_t k = 0; k < 3; ++k) color.values.push_back(values_[i + k] / scale);
        if (!has_alpha_) continue;
        const bool opaque = std::isnan(values_[i + 3]) && !std::isnan(values_[i]);
        color.values.push_back(opaque ? 1.0 : values_[i + 3] / scale);
    }
    add_without_clash(attributes, std::move(color));
}

}  // namespace lissom
