#include "kernel/hair/growth/growth_roots.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "kernel/core/error.h"
#include "kernel/hair/follow/strand_roots.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

constexpr Index kRootGrain = 4096;
// Cells of the order of growth along each side of the box around the roots.
constexpr int kCellBits = 10;

Elements element_of(std::size_t root) {
    return {ElementKind::row, 1, {index_of(root)}};
}

void require_roots(const Mesh& head, std::span<const Root> roots) {
    const Index faces = head.face_count(), vertices = head.vertex_count();
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const Root& root = roots[i];
        const auto [low, high] = std::minmax_element(root.triangle.begin(), root.triangle.end());
        if (root.face < 0 || root.face >= faces || *low < 0 || *high >= vertices) {
            throw Error(ErrorCode::invalid_argument,
                        "a root lies on no face of this head; make roots for the mesh that hair "
                        "grows on",
                        element_of(i));
        }
        if (!root.position.allFinite() || !root.normal.allFinite() ||
            !root.barycentric.allFinite()) {
            throw Error(ErrorCode::not_finite, "a root has coordinates that are not finite",
                        element_of(i));
        }
    }
}

// Bits of x with two zeros between each.
std::uint64_t spread_bits(std::uint64_t x) {
    std::uint64_t result = 0;
    for (int bit = 0; bit < kCellBits; ++bit) result |= ((x >> bit) & 1u) << (3 * bit);
    return result;
}

// Place of a point on a curve through the cells of a box that visits neighbours together (Morton
// 1966).
std::uint64_t morton_code(const Vec3& point, const Box& box) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double extent = std::max(box.max[axis] - box.min[axis], 1e-300);
        const double cell = (point[axis] - box.min[axis]) / extent * ((1 << kCellBits) - 1);
        code |= spread_bits(static_cast<std::uint64_t>(std::max(cell, 0.0))) << axis;
    }
    return code;
}

}  // namespace

GrowthRoots::GrowthRoots(const Mesh& head, std::span<const Root> roots, const Context& context)
    : head_vertices_(head.vertex_count()) {
    require_roots(head, roots);
    constexpr std::size_t kBytes = sizeof(Vec3) + 3 * sizeof(Eigen::Vector3f) + sizeof(Triangle) +
                                   sizeof(StrandChance) + 2 * sizeof(Index) + sizeof(float);
    charge_ = context.charge(roots.size() * kBytes, "the roots of hair");
    put_in_order(roots, context);
    strand_roots_ = roots_on(head, roots);
    for (const Index number : numbers_) {
        const Root& root = roots[at(number)];
        positions_.push_back(root.position);
        normals_.push_back(root.normal.cast<float>());
        triangles_.push_back(root.triangle);
        barycentrics_.push_back(root.barycentric.cast<float>());
    }
}

void GrowthRoots::put_in_order(std::span<const Root> roots, const Context& context) {
    Box box;
    for (const Root& root : roots) box.extend(root.position);
    numbers_.resize(roots.size());
    context.parallel_for(0, count_of(roots), kGrowthWave, [&](Index begin, Index end) {
        std::vector<std::pair<std::uint64_t, Index>> order;
        for (Index i = begin; i < end; ++i) {
            order.emplace_back(morton_code(roots[at(i)].position, box), i);
        }
        std::sort(order.begin(), order.end());
        for (Index i = begin; i < end; ++i) numbers_[at(i)] = order[at(i - begin)].second;
    });
}

void GrowthRoots::set_seed(std::uint64_t seed, const Context& context) {
    if (seed_ == seed) return;
    seed_.reset();
    chances_.resize(numbers_.size());
    context.parallel_for(0, size(), kRootGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const auto random = [&](std::uint64_t stream) {
                return signed_random(mixed(seed, number(i), stream));
            };
            chances_[at(i)] = {static_cast<float>(random(0)), static_cast<float>(random(1)),
                               static_cast<float>(random(2)),
                               static_cast<float>(0.5 + 0.5 * random(3))};
        }
    });
    seed_ = seed;
}

double GrowthRoots::mapped(Index i, const std::vector<double>& map) const {
    double factor = 0.0;
    for (int k = 0; k < 3; ++k) {
        factor += barycentrics_[at(i)][k] * map[at(triangles_[at(i)][k])];
    }
    return factor;
}

void GrowthRoots::set_factors(LengthFactors wanted, const Context& context) {
    if (origin_ == wanted) return;
    origin_ = {};
    factors_.clear();
    const ScalpMask mask(wanted.masks, MaskKind::length);
    if (wanted.map.empty() && mask.is_empty()) return;
    std::vector<float> factors(numbers_.size());
    context.parallel_for(0, size(), kRootGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            double factor = wanted.map.empty() ? 1.0 : mapped(i, wanted.map);
            if (!mask.is_empty()) factor *= mask.at(position(i));
            factors[at(i)] = factor;
        }
    });
    factors_ = std::move(factors);
    origin_ = std::move(wanted);
}

}  // namespace lissom
