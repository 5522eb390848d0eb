#include "kernel/mesh/derive.h"
#include "kernel/core/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace lissom {
namespace {

// Numbers that count or name something have no meaning between their values.
bool is_discrete(const Attribute& attribute) {
    const bool real =
        attribute.type == ScalarType::float32 || attribute.type == ScalarType::float64;
    const AttributeRole role = role_of(attribute);
    return role == AttributeRole::joints || (!real && role == AttributeRole::value);
}

bool is_of_morph(AttributeRole role) {
    return role == AttributeRole::morph_position || role == AttributeRole::morph_normal ||
           role == AttributeRole::morph_tangent;
}

// `counts_missing`: an element without a value counts as zero if another one has a value.
double blend(const Attribute& attribute, std::span<const ElementMap::Source> sources, Index k,
             bool counts_missing) {
    double sum = 0.0, weight = 0.0;
    for (const ElementMap::Source& s : sources) {
        const double value = attribute.at(s.element)[k];
        if (std::isnan(value)) continue;
        sum += s.weight * value;
        weight += s.weight;
    }
    // An unchanged weight is not divided by, so that copies stay equal to the bit.
    if (weight == 1.0 || (counts_missing && weight > 0.0)) return sum;
    return weight > 0.0 ? sum / weight : kNone;
}

void normalize(std::span<double> values) {
    double square = 0.0;
    for (const double x : values) square += x * x;
    if (!(square > 0.0)) return;
    for (double& x : values) x /= std::sqrt(square);
}

Attribute carried(const Attribute& old, const ElementMap& map) {
    Attribute result{old.name, old.domain, old.width, old.type, {}};
    result.values.assign(at(map.size()) * old.width, kNone);
    const bool discrete = is_discrete(old);
    const AttributeRole role = role_of(old);
    for (Index i = 0; i < map.size(); ++i) {
        const std::span<const ElementMap::Source> sources = map[i];
        if (sources.empty()) continue;
        const std::span<double> to = result.at(i);
        if (discrete || sources.size() == 1) {
            const std::span<const double> from = old.at(map.main_source(i));
            std::copy(from.begin(), from.end(), to.begin());
            continue;
        }
        for (Index k = 0; k < old.width; ++k) to[k] = blend(old, sources, k, is_of_morph(role));
        if (role == AttributeRole::normal) normalize(to);
        if (role == AttributeRole::tangent) {
            normalize(to.first(3));
            to[3] = old.at(map.main_source(i))[3];
        }
    }
    return result;
}

// The joints that move one vertex and their weights, gathered from several vertices.
class Influences {
  public:
    void gather(const Attribute& joints, const Attribute& weights,
                std::span<const ElementMap::Source> sources) {
        weight_of_joint_.clear();
        for (const ElementMap::Source& s : sources) {
            for (Index k = 0; k < joints.width; ++k) {
                const double weight = weights.at(s.element)[k];
                if (weight > 0.0) weight_of_joint_[joints.at(s.element)[k]] += s.weight * weight;
            }
        }
    }

    // The strongest that there is room for, with weights that sum to 1.
    void write(std::span<double> joints, std::span<double> weights) {
        std::vector<std::pair<double, double>> order;
        for (const auto& [joint, weight] : weight_of_joint_) order.emplace_back(-weight, joint);
        std::sort(order.begin(), order.end());
        order.resize(std::min(order.size(), joints.size()));
        double sum = 0.0;
        for (const auto& [weight, joint] : order) sum -= weight;
        std::fill(joints.begin(), joints.end(), 0.0);
        std::fill(weights.begin(), weights.end(), 0.0);
        for (std::size_t k = 0; k < order.size(); ++k) {
            joints[k] = order[k].second;
            weights[k] = -order[k].first / sum;
        }
    }

  private:
    std::map<double, double> weight_of_joint_;
};

// A vertex between others is moved by the joints of all of them.
void blend_skin(const Mesh& source, const ElementMap& vertices, Mesh& target) {
    const Attribute* joints = source.attributes().find("joints");
    const Attribute* weights = source.attributes().find("weights");
    const bool is_skin = joints && weights && joints->width == weights->width &&
                         joints->domain == Domain::vertex && weights->domain == Domain::vertex;
    if (!is_skin) return;
    Attribute& new_joints = *target.attributes().find("joints");
    Attribute& new_weights = *target.attributes().find("weights");
    Influences influences;
    for (Index v = 0; v < vertices.size(); ++v) {
        if (vertices[v].size() < 2) continue;
        influences.gather(*joints, *weights, vertices[v]);
        influences.write(new_joints.at(v), new_weights.at(v));
    }
}

void carry_attributes(const Mesh& source, const MeshMap& map, Mesh& target,
                      const Context& context) {
    for (const Attribute& attribute : source.attributes().all()) {
        context.checkpoint();
        const ElementMap& elements = attribute.domain == Domain::vertex   ? map.vertices
                                     : attribute.domain == Domain::corner ? map.corners
                                                                          : map.faces;
        target.attributes().add(carried(attribute, elements));
    }
    blend_skin(source, map.vertices, target);
}

void carry_labels(const Mesh& source, const ElementMap& faces, Mesh& target) {
    for (const auto& [kind, old] : source.attributes().labels()) {
        FaceLabels labels{old.names, {}};
        labels.of_face.reserve(faces.size());
        for (Index f = 0; f < faces.size(); ++f) {
            const Index from = faces.main_source(f);
            labels.of_face.push_back(from == kNoIndex ? kNoIndex : old.of_face[from]);
        }
        target.attributes().labels().emplace(kind, std::move(labels));
        target.attributes().recount();
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
    map.reserve(count);
    for (Index i = 0; i < count; ++i) map.add_copy(i);
    return map;
}

ElementMap ElementMap::copies(std::span<const Index> sources) {
    ElementMap map;
    map.reserve(count_of(sources));
    for (const Index source : sources) {
        if (source == kNoIndex) {
            map.add_new();
        } else {
            map.add_copy(source);
        }
    }
    return map;
}

void ElementMap::reserve(Index elements) {
    begin_.reserve(at(elements) + 1);
    sources_.reserve(at(elements));
}

void ElementMap::add_new() {
    begin_.push_back(sources_.size());
}

void ElementMap::add_copy(Index source) {
    sources_.push_back({source, 1.0});
    begin_.push_back(sources_.size());
}

void ElementMap::add_mean(std::span<const Index> sources) {
    const double weight = 1.0 / sources.size();
    for (const Index source : sources) sources_.push_back({source, weight});
    begin_.push_back(sources_.size());
}

void ElementMap::add_blend(std::span<const Source> sources) {
    if (sources.size() == 1) return add_copy(sources.front().element);
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
    return blend_points(source.positions(), vertices);
}

std::vector<Vec3> blend_points(std::span<const Vec3> points, const ElementMap& vertices) {
    std::vector<Vec3> result;
    result.reserve(vertices.size());
    for (Index v = 0; v < vertices.size(); ++v) {
        const std::span<const ElementMap::Source> sources = vertices[v];
        if (sources.size() == 1) {
            result.push_back(points[at(sources[0].element)]);
            continue;
        }
        Vec3 sum = Vec3::Zero();
        for (const auto& [element, weight] : sources) sum += weight * points[at(element)];
        result.push_back(sum);
    }
    return result;
}

Mesh derive(const Mesh& source, std::vector<Vec3> positions, FaceList faces, const MeshMap& map,
            const Context& context) {
    require_complete_attributes(source);
    require_size(map.vertices, count_of(positions), "vertices");
    require_size(map.corners, count_of(faces.vertices), "corners");
    require_size(map.faces, faces.size(), "faces");
    Mesh result(std::move(positions), std::move(faces), context);
    carry(source, map, result, context);
    return result;
}

void carry(const Mesh& source, const MeshMap& map, Mesh& target, const Context& context) {
    require_complete_attributes(source);
    require_size(map.vertices, target.vertex_count(), "vertices");
    require_size(map.corners, target.topology().corner_count(), "corners");
    require_size(map.faces, target.face_count(), "faces");
    carry_attributes(source, map, target, context);
    carry_labels(source, map.faces, target);
    carry_regions(source, map.vertices, target);
    target.material_libraries() = source.material_libraries();
    target.set_asset(source.asset());
}

}  // namespace lissom
