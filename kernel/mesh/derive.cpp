#include "kernel/mesh/derive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace lissom {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Numbers that count or name something have no meaning between their values.
bool is_discrete(const Attribute& attribute) {
    const bool real =
        attribute.type == ScalarType::float32 || attribute.type == ScalarType::float64;
    const bool measure =
        attribute.name == "color" || attribute.name == "normal" || attribute.name == "uv";
    return !real && !measure;
}

double blend(const Attribute& attribute, std::span<const ElementMap::Source> sources, Index k) {
    double sum = 0.0, weight = 0.0;
    for (const ElementMap::Source& s : sources) {
        const double value = attribute.at(s.element)[k];
        if (std::isnan(value)) continue;
        sum += s.weight * value;
        weight += s.weight;
    }
    // An unchanged weight is not divided by, so that copies stay equal to the bit.
    if (weight == 1.0) return sum;
    return weight > 0.0 ? sum / weight : kNone;
}

void normalize(std::span<double> values) {
    double square = 0.0;
    for (const double x : values) square += x * x;
    if (!(square > 0.0)) return;
    for (double& x : values) x /= std::sqrt(square);
}

Attribute carry(const Attribute& old, const ElementMap& map) {
    Attribute result{old.name, old.domain, old.width, old.type, {}};
    result.values.assign(static_cast<std::size_t>(map.size()) * old.width, kNone);
    const bool discrete = is_discrete(old);
    for (Index i = 0; i < map.size(); ++i) {
        const std::span<const ElementMap::Source> sources = map[i];
        if (sources.empty()) continue;
        const std::span<double> to = result.at(i);
        if (discrete || sources.size() == 1) {
            const std::span<const double> from = old.at(map.main_source(i));
            std::copy(from.begin(), from.end(), to.begin());
            continue;
        }
        for (Index k = 0; k < old.width; ++k) to[k] = blend(old, sources, k);
        if (old.name == "normal") normalize(to);
    }
    return result;
}

void carry_attributes(const Mesh& source, const MeshMap& map, Mesh& target,
                      const Context& context) {
    for (const Attribute& attribute : source.attributes().all()) {
        context.checkpoint();
        const ElementMap& elements = attribute.domain == Domain::vertex   ? map.vertices
                                     : attribute.domain == Domain::corner ? map.corners
                                                                          : map.faces;
        target.attributes().add(carry(attribute, elements));
    }
}

void carry_labels(const Mesh& source, const ElementMap& faces, Mesh& target) {
    for (const auto& [kind, old] : source.attributes().labels()) {
        FaceLabels labels{old.names, {}};
        labels.of_face.reserve(static_cast<std::size_t>(faces.size()));
        for (Index f = 0; f < faces.size(); ++f) {
            const Index from = faces.main_source(f);
            labels.of_face.push_back(from == kNoIndex ? kNoIndex : old.of_face[from]);
        }
        target.attributes().labels().emplace(kind, std::move(labels));
    }
}

void carry_regions(const Mesh& source, const ElementMap& vertices, Mesh& target) {
    for (const auto& [name, region] : source.regions()) {
        const std::vector<char> in = region.mask();
        std::vector<Index> kept;
        for (Index v = 0; v < vertices.size(); ++v) {
            const std::span<const ElementMap::Source> sources = vertices[v];
            const bool all = std::all_of(sources.begin(), sources.end(),
                                         [&](const auto& s) { return in[s.element] != 0; });
            if (all && !sources.empty()) kept.push_back(v);
        }
        target.set_region(name, Region(target.shared_topology(), std::move(kept)));
    }
}

void require_size(const ElementMap& map, Index expected, const char* what) {
    if (map.size() == expected) return;
    throw Error(ErrorCode::invalid_argument, "the map of " + std::string(what) + " has " +
                                                 std::to_string(map.size()) + " entries for " +
                                                 std::to_string(expected) + " elements");
}

}  // namespace

ElementMap ElementMap::identity(Index count) {
    ElementMap map;
    map.begin_.reserve(static_cast<std::size_t>(count) + 1);
    map.sources_.reserve(static_cast<std::size_t>(count));
    for (Index i = 0; i < count; ++i) map.add_copy(i);
    return map;
}

ElementMap ElementMap::copies(std::span<const Index> sources) {
    ElementMap map;
    map.begin_.reserve(sources.size() + 1);
    map.sources_.reserve(sources.size());
    for (const Index source : sources) {
        if (source == kNoIndex) {
            map.add_new();
        } else {
            map.add_copy(source);
        }
    }
    return map;
}

void ElementMap::add_new() {
    begin_.push_back(sources_.size());
}

void ElementMap::add_copy(Index source) {
    sources_.push_back({source, 1.0});
    begin_.push_back(sources_.size());
}

void ElementMap::add_mean(std::span<const Index> sources) {
    const double weight = 1.0 / static_cast<double>(sources.size());
    for (const Index source : sources) sources_.push_back({source, weight});
    begin_.push_back(sources_.size());
}

void ElementMap::add_blend(std::span<const Source> sources) {
    double sum = 0.0;
    for (const Source& s : sources) sum += s.weight;
    for (const Source& s : sources) sources_.push_back({s.element, s.weight / sum});
    begin_.push_back(sources_.size());
}

Index ElementMap::main_source(Index element) const {
    const std::span<const Source> sources = (*this)[element];
    const auto heaviest =
        std::max_element(sources.begin(), sources.end(),
                         [](const Source& a, const Source& b) { return a.weight < b.weight; });
    return heaviest == sources.end() ? kNoIndex : heaviest->element;
}

std::vector<Vec3> blend_positions(const Mesh& source, const ElementMap& vertices) {
    std::vector<Vec3> positions;
    positions.reserve(static_cast<std::size_t>(vertices.size()));
    for (Index v = 0; v < vertices.size(); ++v) {
        const std::span<const ElementMap::Source> sources = vertices[v];
        if (sources.size() == 1) {
            positions.push_back(source.position(sources[0].element));
            continue;
        }
        Vec3 sum = Vec3::Zero();
        for (const auto& [element, weight] : sources) sum += weight * source.position(element);
        positions.push_back(sum);
    }
    return positions;
}

Mesh derive(const Mesh& source, std::vector<Vec3> positions, FaceList faces, const MeshMap& map,
            const Context& context) {
    require_complete_attributes(source);
    require_size(map.vertices, static_cast<Index>(positions.size()), "vertices");
    require_size(map.corners, static_cast<Index>(faces.vertices.size()), "corners");
    require_size(map.faces, faces.size(), "faces");
    Mesh result(std::move(positions), std::move(faces), context);
    carry_attributes(source, map, result, context);
    carry_labels(source, map.faces, result);
    carry_regions(source, map.vertices, result);
    result.material_libraries() = source.material_libraries();
    result.set_asset(source.asset());
    return result;
}

}  // namespace lissom
