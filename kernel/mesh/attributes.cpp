#include "kernel/mesh/attributes.h"

#include <algorithm>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {

Index FaceLabels::add(std::string_view label) {
    const auto found = std::find(names.begin(), names.end(), label);
    if (found != names.end()) return static_cast<Index>(found - names.begin());
    names.emplace_back(label);
    return static_cast<Index>(names.size()) - 1;
}

Attribute* AttributeSet::find(std::string_view name) {
    const auto found = std::find_if(attributes_.begin(), attributes_.end(),
                                    [&](const Attribute& a) { return a.name == name; });
    return found == attributes_.end() ? nullptr : &*found;
}

const Attribute* AttributeSet::find(std::string_view name) const {
    return const_cast<AttributeSet*>(this)->find(name);
}

Attribute& AttributeSet::add(Attribute attribute) {
    if (attribute.name.empty() || attribute.width < 1) {
        throw Error(ErrorCode::invalid_argument,
                    "an attribute needs a name and a width of at least 1");
    }
    if (Attribute* existing = find(attribute.name)) {
        *existing = std::move(attribute);
        return *existing;
    }
    attributes_.push_back(std::move(attribute));
    return attributes_.back();
}

bool AttributeSet::remove(std::string_view name) {
    return std::erase_if(attributes_, [&](const Attribute& a) { return a.name == name; }) > 0;
}

std::size_t AttributeSet::memory_bytes() const {
    std::size_t bytes = 0;
    for (const Attribute& a : attributes_) bytes += a.values.size() * sizeof(double);
    for (const auto& [kind, labels] : labels_) bytes += labels.of_face.size() * sizeof(Index);
    return bytes;
}

}  // namespace lissom
