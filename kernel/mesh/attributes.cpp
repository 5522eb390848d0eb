#include "kernel/mesh/attributes.h"

#include <algorithm>
#include <string>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// "uv", "uv2", "uv17", ...: the name of a set and its number, which the first does not write.
bool is_set(std::string_view name, std::string_view base) {
    if (!name.starts_with(base)) return false;
    const std::string_view number = name.substr(base.size());
    return std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Attributes are found by comparing names, and files that have more are made to take long.
constexpr std::size_t kMostAttributes = 16384;

constexpr const char* kPurpose = "attributes of a mesh";

// Bytes that a text takes beside its object: short ones lie in it.
std::size_t bytes_of(const std::string& text) {
    constexpr std::size_t kShort = 15;
    return text.size() > kShort ? text.size() + 1 : 0;
}

std::size_t bytes_of(const Attribute& attribute) {
    return attribute.values.size() * sizeof(double) + bytes_of(attribute.name);
}

std::size_t bytes_of(const FaceLabels& labels) {
    std::size_t bytes = labels.of_face.size() * sizeof(Index);
    for (const std::string& name : labels.names) bytes += bytes_of(name);
    return bytes;
}

AttributeRole role_in_morph(std::string_view name) {
    const std::string_view part = name.substr(name.rfind('.') + 1);
    if (part == "position") return AttributeRole::morph_position;
    if (part == "normal") return AttributeRole::morph_normal;
    return part == "tangent" ? AttributeRole::morph_tangent : AttributeRole::value;
}

}  // namespace

AttributeRole role_of(const Attribute& attribute) {
    const std::string_view name = attribute.name;
    const Index width = attribute.width;
    if (width == 2 && is_set(name, "uv")) return AttributeRole::texture_coordinates;
    if ((width == 3 || width == 4) && is_set(name, "color")) return AttributeRole::color;
    if (width == 3 && (name == "normal" || name == "face_normal")) return AttributeRole::normal;
    if (width == 4 && name == "tangent") return AttributeRole::tangent;
    if (width == 3 && name.starts_with("morph.")) return role_in_morph(name);
    if (width % 4 != 0) return AttributeRole::value;
    if (name == "joints") return AttributeRole::joints;
    return name == "weights" ? AttributeRole::weights : AttributeRole::value;
}

Index FaceLabels::add(std::string_view label) {
    const auto found = std::find(names.begin(), names.end(), label);
    if (found != names.end()) return index_of(found - names.begin());
    names.emplace_back(label);
    return count_of(names) - 1;
}

// Another set may have been changed since it was counted.
AttributeSet::AttributeSet(const AttributeSet& other) : hold_(other.hold_.account(), kPurpose) {
    hold_.resize(other.memory_bytes());
    attributes_ = other.attributes_;
    labels_ = other.labels_;
}

AttributeSet& AttributeSet::operator=(const AttributeSet& other) {
    if (this == &other) return *this;
    AttributeSet copy;
    copy.count_on(hold_.account() ? hold_.account() : other.hold_.account());
    copy.hold_.resize(other.memory_bytes());
    copy.attributes_ = other.attributes_;
    copy.labels_ = other.labels_;
    swap(copy);
    return *this;
}

// NOLINTNEXTLINE(performance-noexcept-move-constructor)
AttributeSet& AttributeSet::operator=(AttributeSet&& other) {
    if (hold_.account()) other.count_on(hold_.account());
    swap(other);
    return *this;
}

void AttributeSet::swap(AttributeSet& other) noexcept {
    std::swap(hold_, other.hold_);
    attributes_.swap(other.attributes_);
    labels_.swap(other.labels_);
}

void AttributeSet::count_on(std::shared_ptr<MemoryAccount> account) {
    if (account == hold_.account()) return recount();
    MemoryHold next(std::move(account), kPurpose);
    next.resize(memory_bytes());
    hold_ = std::move(next);
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
    Attribute* existing = find(attribute.name);
    if (!existing && attributes_.size() >= kMostAttributes) {
        throw Error(ErrorCode::invalid_argument, "a mesh has at most " +
                                                     std::to_string(kMostAttributes) +
                                                     " attributes; remove those that nothing uses");
    }
    const std::size_t replaced = existing ? bytes_of(*existing) : 0;
    hold_.resize(memory_bytes() - replaced + bytes_of(attribute));
    if (existing) {
        *existing = std::move(attribute);
        return *existing;
    }
    attributes_.push_back(std::move(attribute));
    return attributes_.back();
}

bool AttributeSet::remove(std::string_view name) {
    const bool found =
        std::erase_if(attributes_, [&](const Attribute& a) { return a.name == name; }) > 0;
    if (found) recount();
    return found;
}

std::size_t AttributeSet::memory_bytes() const {
    std::size_t bytes = 0;
    for (const Attribute& a : attributes_) bytes += bytes_of(a);
    for (const auto& [kind, labels] : labels_) bytes += bytes_of(labels);
    return bytes;
}

}  // namespace lissom
