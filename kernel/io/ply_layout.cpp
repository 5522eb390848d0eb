#include "kernel/io/ply_layout.h"

#include <algorithm>
#include <array>
#include <utility>

#include "kernel/io/scalar.h"
#include "kernel/io/text_writer.h"

namespace lissom {
namespace {

// Properties that together are one attribute.
struct Group {
    std::string_view attribute;
    std::array<std::string_view, 4> properties;
    Index width;
    bool of_faces;
};

// Where several match, the first wins; the first of a name and width is the one that is written.
constexpr std::array<Group, 7> kGroups{{{kPlyPosition, {"x", "y", "z"}, 3, false},
                                        {"normal", {"nx", "ny", "nz"}, 3, true},
                                        {"color", {"red", "green", "blue", "alpha"}, 4, true},
                                        {"color", {"red", "green", "blue"}, 3, true},
                                        {"uv", {"s", "t"}, 2, false},
                                        {"uv", {"u", "v"}, 2, false},
                                        {"uv", {"texture_u", "texture_v"}, 2, false}}};

bool fits(const Group& group, Domain domain) {
    return domain == Domain::vertex || group.of_faces;
}

bool is_of_a_group(std::string_view property) {
    return std::any_of(kGroups.begin(), kGroups.end(), [&](const Group& group) {
        const auto end = group.properties.begin() + group.width;
        return std::find(group.properties.begin(), end, property) != end;
    });
}

// Blanks would end a property's name in the header.
std::string property_name(std::string_view name) {
    std::string result = one_line(name);
    std::replace(result.begin(), result.end(), ' ', '_');
    return result;
}

}  // namespace

PlyLayout::PlyLayout(const PlyElement& element, Domain domain)
    : element_(element),
      domain_(domain),
      slots_(element.properties.size()),
      targets_(element.properties.size()) {
    add_groups();
    add_named_attributes();
}

void PlyLayout::add_groups() {
    for (const Group& group : kGroups) {
        if (!fits(group, domain_) || has(group.attribute)) continue;
        std::vector<Index> properties;
        for (Index k = 0; k < group.width; ++k) {
            properties.push_back(element_.find(group.properties[k]));
        }
        const bool complete = std::all_of(properties.begin(), properties.end(),
                                          [&](Index p) { return is_free_number(p); });
        if (!complete) continue;
        if (is_ply_color(group.attribute, group.width) && !have_one_type(properties)) continue;
        add(std::string(group.attribute), properties);
    }
}

void PlyLayout::add_named_attributes() {
    const auto count = static_cast<Index>(element_.properties.size());
    for (Index p = 0; p < count; ++p) {
        if (!is_free_number(p)) continue;
        std::string name = element_.properties[p].name;
        std::vector<Index> properties = numbered_from(p);
        if (properties.size() > 1) {
            name.resize(name.size() - 2);
        } else {
            properties = {p};
        }
        if (!has(name)) add(std::move(name), properties);
    }
}

// Consecutive properties <name>_0, <name>_1, ... of one type, from property `first` on.
std::vector<Index> PlyLayout::numbered_from(Index first) const {
    const std::string& name = element_.properties[first].name;
    if (name.size() < 3 || !name.ends_with("_0")) return {};
    const std::string stem = name.substr(0, name.size() - 1);
    const auto count = static_cast<Index>(element_.properties.size());
    std::vector<Index> properties;
    for (Index p = first; p < count && is_free_number(p); ++p) {
        if (element_.properties[p].name != stem + std::to_string(p - first)) break;
        if (element_.properties[p].type != element_.properties[first].type) break;
        properties.push_back(p);
    }
    return properties;
}

void PlyLayout::add(std::string name, const std::vector<Index>& properties) {
    const auto width = static_cast<Index>(properties.size());
    for (Index k = 0; k < width; ++k) {
        targets_[properties[k]] = {static_cast<Index>(attributes_.size()), k};
    }
    attributes_.push_back(
        {std::move(name), domain_, width, element_.properties[properties[0]].type, {}});
}

bool PlyLayout::has(std::string_view attribute) const {
    return std::any_of(attributes_.begin(), attributes_.end(),
                       [&](const Attribute& a) { return a.name == attribute; });
}

bool PlyLayout::is_free_number(Index property) const {
    return property != kNoIndex && !element_.properties[property].is_list &&
           targets_[property].attribute == kNoIndex;
}

bool PlyLayout::have_one_type(const std::vector<Index>& properties) const {
    return std::all_of(properties.begin(), properties.end(), [&](Index p) {
        return element_.properties[p].type == element_.properties[properties[0]].type;
    });
}

void PlyLayout::allocate(std::size_t rows) {
    if (rows == 0) return;
    for (Attribute& attribute : attributes_) {
        attribute.values.resize(rows * static_cast<std::size_t>(attribute.width));
    }
    for (std::size_t p = 0; p < slots_.size(); ++p) {
        if (targets_[p].attribute == kNoIndex) continue;
        Attribute& attribute = attributes_[targets_[p].attribute];
        const bool scaled = is_ply_color(attribute.name, attribute.width);
        slots_[p].out = attribute.values.data() + targets_[p].component;
        slots_[p].stride = static_cast<std::size_t>(attribute.width);
        slots_[p].divisor = scaled ? color_divisor(attribute.type) : 1.0;
    }
}

const PlyProperty* PlyLayout::attach_list(std::string_view name, std::vector<double>& list) {
    const Index property = element_.find(name);
    if (property == kNoIndex || !element_.properties[property].is_list) return nullptr;
    slots_[property].list = &list;
    return &element_.properties[property];
}

std::vector<Attribute> PlyLayout::take_attributes() {
    for (Attribute& attribute : attributes_) {
        attribute.values.resize(element_.count * static_cast<std::size_t>(attribute.width));
    }
    return std::move(attributes_);
}

std::vector<std::string> PlyLayout::unplaced() const {
    std::vector<std::string> names;
    for (std::size_t p = 0; p < slots_.size(); ++p) {
        if (targets_[p].attribute != kNoIndex || slots_[p].list) continue;
        names.push_back(element_.properties[p].name);
    }
    return names;
}

std::vector<std::string> ply_property_names(const std::string& attribute, Index width,
                                            Domain domain) {
    for (const Group& group : kGroups) {
        if (group.attribute != attribute || group.width != width || !fits(group, domain)) continue;
        return {group.properties.begin(), group.properties.begin() + width};
    }
    const std::string name = property_name(attribute);
    if (width == 1) {
        const bool means_another = is_of_a_group(name) || name == kPlyPosition;
        return means_another ? std::vector<std::string>() : std::vector{name};
    }
    std::vector<std::string> names;
    for (Index k = 0; k < width; ++k) names.push_back(name + "_" + std::to_string(k));
    return names;
}

bool is_ply_color(std::string_view attribute, Index width) {
    return attribute == "color" && (width == 3 || width == 4);
}

}  // namespace lissom
