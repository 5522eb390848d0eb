#include "kernel/hair/growth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/hair/strand_random.h"

namespace lissom {
namespace {

using Vec3f = Eigen::Vector3f;
using Quad = Eigen::Array4f;

// Roots whose strands are grown by one thread into one list.
constexpr Index kChunk = 1024;

// A strand is pushed out of the head this often a segment, as distances between grid points are
// interpolated.
constexpr int kPushes = 3;

void require_options(const GrowthOptions& o, const Mesh& head) {
    const auto require = [](bool holds, const char* message) {
        if (!holds) throw Error(ErrorCode::invalid_argument, message);
    };
    const auto is_length = [](double x) { return x >= 0.0 && std::isfinite(x); };
    require(is_length(o.length), "the length of hair must be 0 or more");
    require(o.variation >= 0.0 && o.variation <= 1.0, "variation must be from 0 to 1");
    require(o.segment > 0.0 && o.segment <= 10.0, "segment must be above 0 and at most 10 steps");
    require(o.least_speed >= 0.0 && o.least_speed < 1.0, "least_speed must be from 0 to below 1");
    require(o.most_segments >= 1, "most_segments must be at least 1");
    require(is_length(o.lift), "lift must be 0 or more");
    require(is_length(o.clearance) && is_length(o.layer) && is_length(o.ramp),
            "clearance, layer and ramp must be lengths of 0 or more");
    require(o.unit > 0.0 && std::isfinite(o.unit), "unit must be above 0");
    const auto vertices = static_cast<std::size_t>(head.vertex_count());
    require(o.length_map.empty() || o.length_map.size() == vertices,
            "a length map needs one factor for every vertex of the head");
    require(std::all_of(o.length_map.begin(), o.length_map.end(), is_length),
            "factors of a length map must be finite and not negative");
}

// The grid in coordinates of its cells.
class GridReader {
  public:
    explicit GridReader(const HairField& field)
        : values_(field.values().data()),
          nx_(field.layout().counts[0]),
          nxy_(nx_ * field.layout().counts[1]) {
        for (int axis = 0; axis < 3; ++axis) {
            last_[axis] = static_cast<float>(field.layout().counts[axis] - 1);
        }
    }

    bool contains(const Vec3f& at) const {
        return (at.array() >= 0.0f).all() && (at.array() <= last_.array()).all();
    }

    // Vector and distance at a point of the grid; the gradient of the distance a step.
    Quad read(const Vec3f& at, Vec3f* gradient) const {
        const Vec3f floor = at.array().floor().min(last_.array() - 1.0f);
        const Vec3f t = at - floor;
        const auto cell = static_cast<Index>(floor.x()) + nx_ * static_cast<Index>(floor.y()) +
                          nxy_ * static_cast<Index>(floor.z());
        const auto corner = [&](Index offset) {
            return Quad(
                Eigen::Map<const Quad>(values_ + 4 * static_cast<std::size_t>(cell + offset)));
        };
        const auto between = [](const Quad& a, const Quad& b, float s) -> Quad {
            return a + s * (b - a);
        };
        const Quad a = corner(0), b = corner(1), c = corner(nx_), d = corner(nx_ + 1),
                   e = corner(nxy_), f = corner(nxy_ + 1), g = corner(nxy_ + nx_),
                   h = corner(nxy_ + nx_ + 1);
        const Quad ab = between(a, b, t.x()), cd = between(c, d, t.x()), ef = between(e, f, t.x()),
                   gh = between(g, h, t.x());
        const Quad low = between(ab, cd, t.y()), high = between(ef, gh, t.y());
        if (gradient) {
            const float x0 = between(b - a, d - c, t.y())[3], x1 = between(f - e, h - g, t.y())[3];
            *gradient = {x0 + t.z() * (x1 - x0), between(cd - ab, gh - ef, t.z())[3],
                         (high - low)[3]};
        }
        return between(low, high, t.z());
    }

  private:
    const float* values_;
    Index nx_, nxy_;
    Vec3f last_;
};

// Strands in coordinates of the grid's cells, so that a step of the grid is one.
class Grower {
  public:
    Grower(const HairField& field, const GrowthOptions& options)
        : reader_(field), options_(options), layout_(field.layout()) {}

    // Appends the points of the strand of a root to `points`, in metres.
    void grow(const Root& root, Index number, double factor, std::vector<float>& points) const {
        const double step = layout_.step;
        const auto id = static_cast<std::uint64_t>(number);
        const double spread = options_.variation * signed_random(mixed(options_.seed, id, 0));
        const double u = signed_random(mixed(options_.seed, id, 1));
        const auto length = static_cast<float>(options_.length * factor * (1.0 + spread) / step);
        const auto floor = static_cast<float>((options_.clearance + options_.layer * u * u) / step);
        const auto ramp = static_cast<float>(std::max(options_.ramp / step, 1e-6));

        Vec3f at = ((root.position - layout_.origin) / step).cast<float>();
        put(at, points);
        float grown = 0.0f;
        for (Index k = 0; k < options_.most_segments && grown < length; ++k) {
            if (!reader_.contains(at)) return;
            Vec3f v = reader_.read(at, nullptr).head<3>();
            if (k == 0) v = lifted(v, root.normal.cast<float>());
            const float speed = v.norm();
            if (!(speed >= static_cast<float>(options_.least_speed))) return;
            const float most = std::min(static_cast<float>(options_.segment), length - grown);
            Vec3f next = at + v * (speed > 1.0f ? most / speed : most);
            if (options_.avoid) push_out(next, floor * std::min(1.0f, (grown + most) / ramp));
            const float moved = (next - at).norm();
            if (!(moved > 0.0f)) return;
            grown += moved;
            at = next;
            put(at, points);
        }
    }

  private:
    Vec3f lifted(const Vec3f& v, const Vec3f& normal) const {
        const float inward = std::min(0.0f, v.dot(normal));
        return v - inward * normal + static_cast<float>(options_.lift) * normal;
    }

    void push_out(Vec3f& at, float floor) const {
        for (int push = 0; push < kPushes; ++push) {
            if (!reader_.contains(at)) return;
            Vec3f outward;
            const float missing =
                floor - reader_.read(at, &outward)[3] / static_cast<float>(layout_.step);
            if (!(missing > 0.0f)) return;
            const float slope = outward.norm();
            if (!(slope > 0.0f)) return;
            at += missing / slope * outward;
        }
    }

    void put(const Vec3f& at, std::vector<float>& points) const {
        const Vec3 place = options_.unit * (layout_.origin + layout_.step * at.cast<double>());
        for (int d = 0; d < 3; ++d) points.push_back(static_cast<float>(place[d]));
    }

    GridReader reader_;
    const GrowthOptions& options_;
    const GridLayout& layout_;
};

// What one thread has grown.
struct Tuft {
    std::vector<float> points;
    std::vector<Index> ends;
};

double length_factor(const GrowthOptions& options, const Root& root) {
    if (options.length_map.empty()) return 1.0;
    double factor = 0.0;
    for (int k = 0; k < 3; ++k)
        factor += root.barycentric[k] * options.length_map[root.triangle[k]];
    return factor;
}

// Weights of the first three corners of its face, negative where it lies beyond their triangle.
Eigen::Vector3f corner_weights(const Mesh& head, const Root& root) {
    const std::span<const Index> face = head.topology().face(root.face);
    const Vec3 &a = head.position(face[0]), &b = head.position(face[1]),
               &c = head.position(face[2]);
    const Vec3 normal = (b - a).cross(c - a);
    const double area = normal.squaredNorm();
    if (!(area > 0.0)) return Eigen::Vector3f::Constant(1.0f / 3.0f);
    const double at_b = (root.position - a).cross(c - a).dot(normal) / area;
    const double at_c = (b - a).cross(root.position - a).dot(normal) / area;
    return Vec3(1.0 - at_b - at_c, at_b, at_c).cast<float>();
}

StrandRoots roots_of(const Mesh& head, std::span<const Root> roots) {
    StrandRoots result;
    for (const Root& root : roots) {
        result.faces.push_back(root.face);
        result.barycentrics.push_back(corner_weights(head, root));
    }
    return result;
}

}  // namespace

void grow(const Mesh& head, const HairField& field, std::span<const Root> roots,
          const GrowthOptions& options, Strands& strands, const Context& context) {
    std::vector<float> points;
    std::vector<Index> offsets;
    strands.release(points, offsets);
    strands = {};
    require_options(options, head);
    const Grower grower(field, options);
    const auto count = static_cast<Index>(roots.size());
    std::vector<Tuft> tufts(static_cast<std::size_t>((count + kChunk - 1) / kChunk));
    context.parallel_for(0, count, kChunk, [&](Index begin, Index end) {
        Tuft& tuft = tufts[static_cast<std::size_t>(begin / kChunk)];
        for (Index i = begin; i < end; ++i) {
            const Root& root = roots[static_cast<std::size_t>(i)];
            grower.grow(root, i, length_factor(options, root), tuft.points);
            tuft.ends.push_back(static_cast<Index>(tuft.points.size() / 3));
        }
    });

    std::size_t total = 0;
    std::vector<std::size_t> first;
    for (const Tuft& tuft : tufts) {
        first.push_back(total);
        total += tuft.points.size();
    }
    const auto charge = context.charge(total * sizeof(float), "strands");
    points.resize(total);
    offsets.assign(1, 0);
    for (std::size_t t = 0; t < tufts.size(); ++t) {
        for (const Index end : tufts[t].ends) {
            offsets.push_back(static_cast<Index>(first[t] / 3) + end);
        }
    }
    context.parallel_for(0, static_cast<Index>(tufts.size()), 1, [&](Index begin, Index end) {
        for (Index t = begin; t < end; ++t) {
            std::copy(tufts[t].points.begin(), tufts[t].points.end(),
                      points.begin() + static_cast<std::ptrdiff_t>(first[t]));
        }
    });
    strands = Strands(std::move(points), std::move(offsets));
    strands.set_roots(roots_of(head, roots));
}

}  // namespace lissom
