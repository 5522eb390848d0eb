#include "kernel/io/gltf/mesh/values.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "kernel/core/error.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

constexpr double kLargest = std::numeric_limits<float>::max();

double narrowed(double value) {
    return static_cast<float>(value);
}

bool is_good(std::span<const double> values) {
    return std::all_of(values.begin(), values.end(),
                       [](double x) { return std::abs(x) <= kLargest; });
}

// Some direction across `normal`.
Vec3 across(const Vec3& normal) {
    Index least = 0;
    normal.cwiseAbs().minCoeff(&least);
    return normal.cross(Vec3::Unit(least)).normalized();
}

void put(const Vec3& v, std::span<double> to) {
    std::copy_n(v.data(), 3, to.begin());
}

}  // namespace

WrittenNumbers PoolValues::positions() const {
    WrittenNumbers numbers{3, ScalarType::float32, false, {}};
    numbers.values.reserve(3 * pool_.size());
    Elements beyond{ElementKind::vertex, 0, {}};
    for (std::size_t i = 0; i < pool_.size(); ++i) {
        const Vec3 p = to_node_.position(mesh_.position(pool_.vertices[i]));
        if (!is_good({p.data(), 3})) beyond.add(pool_.vertices[i]);
        for (const double x : p) numbers.values.push_back(narrowed(x));
    }
    if (beyond.count == 0) return numbers;
    const std::string names = describe(beyond);
    throw Error(ErrorCode::not_finite,
                names + " lie beyond the range of the 32-bit numbers of glTF; scale the mesh down",
                std::move(beyond));
}

// Returns the normal of the surface around the vertex, in the frame of the node.
Vec3 PoolValues::any_normal(std::size_t i) const {
    const Topology& topology = mesh_.topology();
    Vec3 sum = Vec3::Zero();
    for (const Index f : topology.faces_around(pool_.vertices[i])) {
        const auto face = topology.face(f);
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            const Vec3& origin = mesh_.position(face[0]);
            sum += (mesh_.position(face[k]) - origin).cross(mesh_.position(face[k + 1]) - origin);
        }
    }
    to_node_.turn_normal({sum.data(), 3});
    return sum.allFinite() ? sum : Vec3::UnitZ();
}

Vec3 PoolValues::normal_at(std::size_t i) const {
    const Attribute* normals = mesh_.attributes().find("normal");
    const bool has = normals && normals->domain != Domain::face && normals->width == 3 &&
                     pool_.corners[i] != kNoIndex && is_good(pool_.value(*normals, i));
    if (!has) return any_normal(i);
    const std::span<const double> value = pool_.value(*normals, i);
    Vec3 normal(value[0], value[1], value[2]);
    to_node_.turn_normal({normal.data(), 3});
    return normal.allFinite() ? normal : any_normal(i);
}

WrittenNumbers PoolValues::attribute(const WrittenAttribute& written) const {
    WrittenNumbers numbers{written.attribute->width, written.type, written.normalized, {}};
    const std::size_t width = numbers.width;
    const GltfSemantic semantic = written.name.semantic;
    const double scale = numbers.normalized ? range_of(numbers.type).max : 1.0;
    std::vector<double> value(width);
    numbers.values.reserve(width * pool_.size());
    for (std::size_t i = 0; i < pool_.size(); ++i) {
        const std::span<const double> from = pool_.value(*written.attribute, i);
        const bool good = is_good(from);
        std::fill(value.begin(), value.end(), semantic == GltfSemantic::color ? 1.0 : 0.0);
        if (good) std::copy(from.begin(), from.end(), value.begin());
        if (semantic == GltfSemantic::uv && good) value[1] = 1.0 - value[1];
        if (semantic == GltfSemantic::normal) put(normal_at(i), value);
        if (semantic == GltfSemantic::tangent) {
            if (good) to_node_.turn_tangent(value);
            if (!good || !is_good(value)) put(across(normal_at(i)), value);
            value[3] = value[3] < 0.0 ? -1.0 : 1.0;
        }
        if (semantic == GltfSemantic::color) {
            for (double& x : value) x = std::clamp(x, 0.0, 1.0) * scale;
        }
        for (const double x : value) {
            numbers.values.push_back(numbers.type == ScalarType::float32 ? narrowed(x)
                                                                         : std::round(x));
        }
    }
    return numbers;
}

WrittenNumbers PoolValues::morph(const WrittenMorph& morph) const {
    WrittenNumbers numbers = zeros(3);
    for (std::size_t i = 0; i < pool_.size(); ++i) {
        const std::span<const double> from = pool_.value(*morph.attribute, i);
        if (!is_good(from)) continue;
        const std::span<double> to(numbers.values.data() + 3 * i, 3);
        std::copy(from.begin(), from.end(), to.begin());
        to_node_.turn_delta(morph.name.semantic, to);
        for (double& x : to) x = narrowed(x);
    }
    return numbers;
}

WrittenNumbers PoolValues::zeros(Index width) const {
    WrittenNumbers numbers{width, ScalarType::float32, false, {}};
    numbers.values.assign(width * pool_.size(), 0.0);
    return numbers;
}

std::vector<PoolValues::JointSet> PoolValues::joint_sets(const WrittenAttributes& attributes,
                                                         std::size_t joint_count) const {
    const auto set_count = at(attributes.joints->width) / 4;
    const bool are_bytes = attributes.joints->type == ScalarType::uint8;
    const ScalarType type = are_bytes ? ScalarType::uint8 : ScalarType::uint16;
    const double largest = joint_count > 0 ? joint_count - 1.0 : range_of(type).max;
    std::vector<JointSet> sets(set_count, {{4, type, false, {}}, zeros(4)});
    for (JointSet& set : sets) set.joints.values.assign(4 * pool_.size(), 0.0);
    for (std::size_t i = 0; i < pool_.size(); ++i) {
        const std::span<const double> joints = pool_.value(*attributes.joints, i);
        const std::span<const double> weights = pool_.value(*attributes.weights, i);
        double sum = 0.0;
        std::map<double, std::size_t> place_of;
        for (std::size_t k = 0; k < joints.size(); ++k) {
            const double weight = weights[k];
            const bool counts =
                weight > 0.0 && weight <= kLargest && joints[k] >= 0.0 && joints[k] <= largest;
            if (!counts) continue;
            const std::size_t place = place_of.emplace(joints[k], k).first->second;
            sets[place / 4].joints.values[4 * i + place % 4] = std::round(joints[k]);
            sets[place / 4].weights.values[4 * i + place % 4] += weight;
            sum += weight;
        }
        if (sum == 0.0) sets[0].weights.values[4 * i] = sum = 1.0;
        for (JointSet& set : sets) {
            for (std::size_t k = 0; k < 4; ++k) {
                double& weight = set.weights.values[4 * i + k];
                weight = narrowed(weight / sum);
            }
        }
    }
    return sets;
}

}  // namespace lissom
