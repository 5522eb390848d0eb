#include "kernel/io/ply/layout.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "kernel/io/stream/percent.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

// Properties that together are one attribute.
struct Group {
    std::string_view attribute;
    std::array<std::string_view, 4> properties;
    Index width;
    bool of_faces;
};

// If several match, the first wins; the first of a name and width is the one that is written.
constexpr std::array<Group, 10> kGroups{
    {{"normal", {"nx", "ny", "nz"}, 3, true},
     {"color", {"red", "green", "blue", "alpha"}, 4, true},
     {"color", {"red", "green", "blue"}, 3, true},
     {"color", {"r", "g", "b", "a"}, 4, true},
     {"color", {"r", "g", "b"}, 3, true},
     {"color", {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"}, 4, true},
     {"color", {"diffuse_red", "diffuse_green", "diffuse_blue"}, 3, true},
     {"uv", {"s", "t"}, 2, false},
     {"uv", {"u", "v"}, 2, false},
     {"uv", {"texture_u", "texture_v"}, 2, false}}};
constexpr std::string_view kU = "texture_u", kV = "texture_v";
constexpr std::string_view kCornerUv = "texcoord", kCornerPrefix = "corner_";

bool fits(const Group& group, Domain domain) {
    return domain == Domain::vertex || group.of_faces;
}

// "2" of "uv2" for the stem "uv", empty if `name` is not the stem and a number from 2.
std::string_view set_number(std::string_view name, std::string_view stem) {
    if (!name.starts_with(stem)) return {};
    const std::string_view digits = name.substr(stem.size());
    const bool is_number = !digits.empty() && digits.size() < 4 && digits[0] != '0' &&
                           digits != "1" &&
                           digits.find_first_not_of("0123456789") == std::string_view::npos;
    return is_number ? digits : std::string_view();
}

bool has_meaning(std::string_view property) {
    const auto is_in = [&](const Group& group) {
        const auto end = group.properties.begin() + group.width;
        return std::find(group.properties.begin(), end, property) != end;
    };
    constexpr std::array<std::string_view, 5> kOthers{"x", "y", "z", "vertex_indices",
                                                      "vertex_index"};
    return std::any_of(kGroups.begin(), kGroups.end(), is_in) ||
           std::find(kOthers.begin(), kOthers.end(), property) != kOthers.end() ||
           !set_number(property, kU).empty() || !set_number(property, kV).empty();
}

bool ends_with_number(std::string_view name) {
    const std::size_t last = name.find_last_not_of("0123456789");
    return last != std::string_view::npos && last + 1 < name.size() && name[last] == '_';
}

// Encodes the character at `at`, if it is not yet.
void shield(std::string& name, std::size_t at) {
    if (name[at] == '%') return;
    name.replace(at, 1, percent_encoded_byte(name[at]));
}

}  // namespace

PlyLayout::PlyLayout(const PlyHeader& header, const PlyElement& element, Domain domain)
    : header_(header),
      element_(element),
      domain_(domain),
      slots_(element.properties.size()),
      targets_(element.properties.size()) {
    add_groups();
    add_texture_coordinate_sets();
    add_named();
}

void PlyLayout::add_group(PlyRole role, std::string_view name,
                          const std::vector<Index>& properties) {
    const auto width = count_of(properties);
    const bool complete = std::all_of(properties.begin(), properties.end(),
                                      [&](Index p) { return is_free_number(p); });
    if (!complete || has(role, name)) return;
    if (is_ply_color(name, width) && !have_one_type(properties)) return;
    add(role, std::string(name), properties);
}

void PlyLayout::add_groups() {
    if (domain_ == Domain::vertex) {
        add_group(PlyRole::position, "position",
                  {element_.find("x"), element_.find("y"), element_.find("z")});
    }
    for (const Group& group : kGroups) {
        if (!fits(group, domain_)) continue;
        std::vector<Index> properties;
        for (Index k = 0; k < group.width; ++k) {
            properties.push_back(element_.find(group.properties[k]));
        }
        add_group(PlyRole::attribute, group.attribute, properties);
    }
}

void PlyLayout::add_texture_coordinate_sets() {
    if (domain_ != Domain::vertex) return;
    const auto count = count_of(element_.properties);
    for (Index p = 0; p < count; ++p) {
        const std::string number(set_number(element_.properties[p].name, kU));
        if (number.empty()) continue;
        add_group(PlyRole::attribute, "uv" + number, {p, element_.find(std::string(kV) + number)});
    }
}

void PlyLayout::add_named() {
    const auto count = count_of(element_.properties);
    for (Index p = 0; p < count; ++p) {
        if (!is_free_number(p)) continue;
        std::string name = element_.properties[p].name;
        PlyRole role = PlyRole::attribute;
        std::vector<Index> properties{p};
        if (is_region(p)) {
            role = PlyRole::region;
            name.erase(0, kPlyRegionPrefix.size());
        } else if (is_labels(p)) {
            role = PlyRole::labels;
        } else if (std::vector<Index> numbered = numbered_from(p); numbered.size() > 1) {
            properties = std::move(numbered);
            name.resize(name.size() - 2);
        }
        name = percent_decoded(name);
        if (!has(role, name)) add(role, std::move(name), properties);
    }
}

bool PlyLayout::is_region(Index property) const {
    const PlyProperty& p = element_.properties[property];
    return domain_ == Domain::vertex && p.type == ScalarType::uint8 &&
           p.name.size() > kPlyRegionPrefix.size() && p.name.starts_with(kPlyRegionPrefix);
}

bool PlyLayout::is_labels(Index property) const {
    const PlyProperty& p = element_.properties[property];
    if (domain_ != Domain::face || !is_integer(p.type)) return false;
    const std::string kind = percent_decoded(p.name);
    return header_.label_names.contains(kind) && percent_encoded(kind) == p.name;
}

// Consecutive properties <name>_0, <name>_1, ... of one type, from property `first` on.
std::vector<Index> PlyLayout::numbered_from(Index first) const {
    const std::string& name = element_.properties[first].name;
    if (name.size() < 3 || !name.ends_with("_0")) return {};
    const std::string stem = name.substr(0, name.size() - 1);
    const auto count = count_of(element_.properties);
    std::vector<Index> properties;
    for (Index p = first; p < count && is_free_number(p); ++p) {
        if (element_.properties[p].name != stem + std::to_string(p - first)) break;
        if (element_.properties[p].type != element_.properties[first].type) break;
        properties.push_back(p);
    }
    return properties;
}

void PlyLayout::add(PlyRole role, std::string name, const std::vector<Index>& properties) {
    const auto width = count_of(properties);
    for (Index k = 0; k < width; ++k) {
        targets_[properties[k]] = {count_of(columns_), k};
    }
    const ScalarType type = element_.properties[properties[0]].type;
    columns_.push_back({role, {std::move(name), domain_, width, type, {}}});
}

bool PlyLayout::has(PlyRole role, std::string_view name) const {
    return std::any_of(columns_.begin(), columns_.end(), [&](const PlyColumn& c) {
        return c.role == role && c.attribute.name == name;
    });
}

bool PlyLayout::is_free_number(Index property) const {
    return property != kNoIndex && !element_.properties[property].is_list &&
           targets_[property].column == kNoIndex;
}

bool PlyLayout::have_one_type(const std::vector<Index>& properties) const {
    return std::all_of(properties.begin(), properties.end(), [&](Index p) {
        return element_.properties[p].type == element_.properties[properties[0]].type;
    });
}

void PlyLayout::allocate(std::size_t rows) {
    if (rows == 0) return;
    for (PlyColumn& column : columns_) {
        column.attribute.values.resize(rows * column.attribute.width);
    }
    for (std::size_t p = 0; p < slots_.size(); ++p) {
        if (targets_[p].column == kNoIndex) continue;
        Attribute& attribute = columns_[targets_[p].column].attribute;
        const bool scaled = is_ply_color(attribute.name, attribute.width);
        slots_[p].out = attribute.values.data() + targets_[p].component;
        slots_[p].stride = attribute.width;
        slots_[p].divisor = scaled ? color_divisor(attribute.type) : 1.0;
    }
}

bool PlyLayout::attach_list(std::string_view name, std::vector<double>& list) {
    const Index property = element_.find(name);
    if (property == kNoIndex || !element_.properties[property].is_list) return false;
    if (slots_[property].list) return false;
    slots_[property].list = &list;
    return true;
}

std::vector<PlyColumn> PlyLayout::take_columns() {
    for (PlyColumn& column : columns_) {
        Attribute& attribute = column.attribute;
        attribute.values.resize(element_.count * attribute.width);
    }
    return std::move(columns_);
}

std::vector<std::string> PlyLayout::unplaced() const {
    std::vector<std::string> names;
    for (std::size_t p = 0; p < slots_.size(); ++p) {
        if (targets_[p].column != kNoIndex || slots_[p].list) continue;
        names.push_back(element_.properties[p].name);
    }
    return names;
}

std::vector<std::string> ply_property_names(const std::string& attribute, Index width,
                                            Domain domain, bool shielded) {
    if (!shielded) {
        for (const Group& group : kGroups) {
            if (group.attribute != attribute || group.width != width || !fits(group, domain)) {
                continue;
            }
            return {group.properties.begin(), group.properties.begin() + width};
        }
        const std::string number(set_number(attribute, "uv"));
        if (!number.empty() && width == 2 && domain == Domain::vertex) {
            return {std::string(kU) + number, std::string(kV) + number};
        }
    }
    std::string name = percent_encoded(attribute);
    if (width == 1 && ends_with_number(name)) shield(name, name.size() - 1);
    const bool means_another = name.starts_with(kPlyRegionPrefix) || has_meaning(name);
    if (shielded || means_another) shield(name, 0);
    if (width == 1) return {name};
    std::vector<std::string> names;
    for (Index k = 0; k < width; ++k) names.push_back(name + "_" + std::to_string(k));
    return names;
}

std::optional<Attribute> ply_corner_attribute(const PlyProperty& list) {
    std::string_view name = list.name;
    if (name == kCornerUv) return Attribute{"uv", Domain::corner, 2, list.type, {}};
    const std::string number(set_number(name, kCornerUv));
    if (!number.empty()) return Attribute{"uv" + number, Domain::corner, 2, list.type, {}};
    if (!name.starts_with(kCornerPrefix)) return std::nullopt;
    name.remove_prefix(kCornerPrefix.size());
    Index width = 0;
    const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), width);
    name.remove_prefix(stop - name.data());
    const bool is_valid = error == std::errc() && width >= 1 && width <= kPlyLargestCornerWidth &&
                          name.size() > 1 && name[0] == '_';
    if (!is_valid) return std::nullopt;
    return Attribute{percent_decoded(name.substr(1)), Domain::corner, width, list.type, {}};
}

std::string ply_list_name(const Attribute& corner_attribute) {
    const std::string& name = corner_attribute.name;
    const std::string_view number = set_number(name, "uv");
    if (corner_attribute.width == 2 && (name == "uv" || !number.empty())) {
        return std::string(kCornerUv) + std::string(number);
    }
    return std::string(kCornerPrefix) + std::to_string(corner_attribute.width) + "_" +
           percent_encoded(name);
}

bool is_ply_color(std::string_view attribute, Index width) {
    const bool is_named = attribute == "color" || !set_number(attribute, "color").empty();
    return is_named && (width == 3 || width == 4);
}

}  // namespace lissom
