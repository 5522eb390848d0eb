#include "kernel/io/morph_baker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/io/gltf/animation.h"
#include "kernel/io/gltf/mesh/names.h"
#include "kernel/io/shape_sums.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// As many as the writer of glTF numbers.
constexpr std::size_t kMaximumTargets = 10000;

// Returns the vertex of a value of an attribute of vertices or corners.
Index vertex_of(const Mesh& mesh, Domain domain, Index element) {
    return domain == Domain::vertex ? element : mesh.topology().faces().vertices[element];
}

// Returns flags for the region and the ring around it, because normals change there too.
std::vector<char> flags_around(const Region& moving) {
    return moving.grown(1).mask();
}

void drop_morphs(Mesh& mesh, const Context& context) {
    std::vector<std::string> names;
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (parse_morph_name(attribute.name).target > 0) names.push_back(attribute.name);
    }
    for (const std::string& name : names) mesh.attributes().remove(name);
    if (names.empty()) return;
    context.log(LogLevel::warning,
                "the morph targets that the mesh had, and their animations, are not baked");
}

// Returns normals or tangents of the mesh in a form that files can hold, or null.
const Attribute* find_directions(const Mesh& mesh, std::string_view name, Index width) {
    const Attribute* found = mesh.attributes().find(name);
    return found && found->domain != Domain::face && found->width == width ? found : nullptr;
}

Vec3 first_three(std::span<const double> value) {
    return {value[0], value[1], value[2]};
}

std::vector<double> flat(const std::vector<Vec3>& points) {
    std::vector<double> numbers;
    for (const Vec3& p : points) numbers.insert(numbers.end(), p.data(), p.data() + 3);
    return numbers;
}

std::size_t hash_of(const std::vector<float>& values) {
    const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                                 values.size() * sizeof(float));
    return std::hash<std::string_view>()(bytes);
}

// Each shape is its own target.
std::vector<std::vector<float>> unit_weights(std::size_t count) {
    std::vector<std::vector<float>> weights(count, std::vector<float>(count, 0.0f));
    for (std::size_t t = 0; t < count; ++t) weights[t][t] = 1.0f;
    return weights;
}

}  // namespace

MorphBaker::MorphBaker(const Mesh& rest, const Region& moving, BakeOptions options, Context context)
    : rest_(rest), options_(std::move(options)), context_(std::move(context)) {
    require_same_topology(rest, moving.topology(), "the region");
    if (rest.face_count() == 0) {
        throw Error(ErrorCode::unsupported, "a mesh without faces cannot be baked");
    }
    if (!is_length(options_.tolerance)) {
        throw Error(ErrorCode::invalid_argument, "the tolerance must be finite and not negative");
    }
    drop_morphs(rest_, context_);
    moves_ = flags_around(moving);
    makes_normals_ = options_.normals && !find_directions(rest_, "normal", 3);
    if (makes_normals_) {
        rest_.attributes().add(
            {"normal", Domain::vertex, 3, ScalarType::float32, flat(vertex_normals(rest_))});
    }
    add_channel("", "position", Domain::vertex, moves_);
    add_directions(moves_);
}

void MorphBaker::add_directions(const std::vector<char>& moves) {
    for (const auto& [name, width] : {std::pair{"normal", 3}, std::pair{"tangent", 4}}) {
        if (const Attribute* found = find_directions(rest_, name, width)) {
            add_channel(name, name, found->domain, moves);
        }
    }
}

void MorphBaker::add_channel(const std::string& attribute, const std::string& suffix, Domain domain,
                             const std::vector<char>& moves) {
    Channel channel{attribute, suffix, domain, {}, {}};
    const Attribute* values = rest_.attributes().find(attribute);
    const Index count = element_count(rest_.topology(), domain);
    for (Index i = 0; i < count; ++i) {
        const Index v = vertex_of(rest_, domain, i);
        if (!moves[v]) continue;
        channel.elements.push_back(i);
        channel.rest.push_back(values ? first_three(values->at(i)) : rest_.position(v));
    }
    channels_.push_back(std::move(channel));
}

void MorphBaker::require_later(double time) const {
    const auto narrow = static_cast<float>(time);
    const bool follows = times_.empty() || narrow > times_.back();
    if (std::isfinite(narrow) && narrow >= 0.0f && follows) return;
    throw Error(ErrorCode::invalid_argument,
                "key " + std::to_string(times_.size() + 1) + " is at " + std::to_string(time) +
                    " s; times must be finite, not negative and ascending");
}

// Returns the differences of all channels, one after another; values that are not finite count as
// zero.
std::vector<float> MorphBaker::differences(const Mesh& shape) const {
    std::vector<float> result;
    const std::vector<Vec3> normals = makes_normals_ ? vertex_normals(shape) : std::vector<Vec3>();
    for (const Channel& channel : channels_) {
        const bool is_made = makes_normals_ && channel.attribute == "normal";
        const Attribute* values =
            channel.attribute.empty() ? nullptr : shape.attributes().find(channel.attribute);
        const bool is_absent =
            !channel.attribute.empty() && !is_made && (!values || values->domain != channel.domain);
        for (std::size_t i = 0; i < channel.elements.size(); ++i) {
            const Index element = channel.elements[i];
            Vec3 now = is_made  ? normals[element]
                       : values ? first_three(values->at(element))
                                : shape.position(element);
            if (is_absent) now = channel.rest[i];
            for (int k = 0; k < 3; ++k) {
                const auto difference = static_cast<float>(now[k] - channel.rest[i][k]);
                result.push_back(std::isfinite(difference) ? difference + 0.0f : 0.0f);
            }
        }
    }
    return result;
}

Index MorphBaker::target_of(std::vector<float> differences) {
    if (std::all_of(differences.begin(), differences.end(), [](float x) { return x == 0.0f; })) {
        return kNoIndex;
    }
    const std::size_t hash = hash_of(differences);
    const auto [first, last] = target_by_hash_.equal_range(hash);
    for (auto it = first; it != last; ++it) {
        if (targets_[it->second] == differences) return it->second;
    }
    if (targets_.size() == kMaximumTargets) {
        throw Error(ErrorCode::invalid_argument, "there are more than " +
                                                     std::to_string(kMaximumTargets) +
                                                     " different shapes; take fewer keys");
    }
    charges_.push_back(context_.charge(differences.size() * sizeof(float), "a baked shape"));
    targets_.push_back(std::move(differences));
    const auto target = count_of(targets_) - 1;
    target_by_hash_.emplace(hash, target);
    return target;
}

void MorphBaker::add(double time, const Mesh& shape) {
    context_.checkpoint();
    require_same_topology(shape, rest_.shared_topology(), "the baker");
    require_later(time);
    key_target_.push_back(target_of(differences(shape)));
    times_.push_back(static_cast<float>(time));
}

// Elements that do not move have no value: objects without any have no targets.
void MorphBaker::write_target(Index target, const std::vector<float>& values, Mesh& mesh) const {
    const std::string prefix = "morph." + std::to_string(target + 1) + ".";
    std::size_t at = 0;
    for (const Channel& channel : channels_) {
        Attribute attribute{prefix + channel.suffix, channel.domain, 3, ScalarType::float32, {}};
        attribute.values.assign(3 * lissom::at(element_count(mesh.topology(), channel.domain)),
                                std::numeric_limits<double>::quiet_NaN());
        for (const Index element : channel.elements) {
            std::copy_n(values.begin() + at, 3, attribute.at(element).begin());
            at += 3;
        }
        mesh.attributes().add(std::move(attribute));
    }
}

// For each key the weights of its shape; none of the rest shape.
std::vector<float> MorphBaker::key_weights(const std::vector<std::vector<float>>& weights) const {
    std::vector<float> result;
    for (const Index shape : key_target_) {
        if (shape == kNoIndex) {
            result.resize(result.size() + weights.front().size(), 0.0f);
        } else {
            result.insert(result.end(), weights[shape].begin(), weights[shape].end());
        }
    }
    return result;
}

Mesh MorphBaker::finish(BakeReport* report) const {
    if (times_.empty()) {
        throw Error(ErrorCode::invalid_argument, "there is no shape to bake; add one");
    }
    ShapeTolerance tolerance;
    tolerance.position_numbers = 3 * channels_.front().elements.size();
    tolerance.position = options_.tolerance;
    const bool reduces = options_.tolerance > 0.0;
    ShapeSums sums;
    if (reduces) {
        sums = sum_shapes(targets_, tolerance, context_);
    } else {
        sums.weights = unit_weights(targets_.size());
    }
    const std::vector<std::vector<float>>& targets = reduces ? sums.parts : targets_;
    Mesh mesh = rest_;
    for (Index t = 0; t < count_of(targets); ++t) write_target(t, targets[t], mesh);
    MorphKeys keys{options_.name,
                   options_.interpolation == KeyInterpolation::step,
                   times_,
                   {},
                   count_of(targets)};
    if (!sums.weights.empty()) keys.weights = key_weights(sums.weights);
    mesh.set_asset(with_morph_animation(mesh, moves_, keys));
    if (report) {
        *report = {key_count(), count_of(targets), sums.max_error, sums.max_direction_error};
    }
    return mesh;
}

}  // namespace lissom
