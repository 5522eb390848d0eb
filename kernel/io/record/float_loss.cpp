#include "kernel/io/record/float_loss.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "kernel/mesh/value_pool.h"

namespace lissom {
namespace {

// A polygon is flat if its area is below this fraction of its longest edge squared.
constexpr double kFlat = 1e-14;
constexpr std::size_t kFacesPerLoss = 1000;

Vec3 vector_area(std::span<const Vec3> points) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
        sum += (points[k] - points[0]).cross(points[k + 1] - points[0]);
    }
    return 0.5 * sum;
}

bool has_area(std::span<const Vec3> points, const Vec3& area) {
    double longest = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        longest = std::max(longest, (points[k] - points[(k + 1) % points.size()]).squaredNorm());
    }
    return area.norm() > kFlat * longest;
}

bool is_far(const Box& box) {
    return !box.empty() && box.center().cwiseAbs().maxCoeff() > box.diagonal();
}

std::string remedy(const Box& box, bool origin_moves) {
    if (origin_moves && is_far(box)) {
        return "it lies far from the origin for its size; save it with origin = \"auto\", which "
               "moves the origin of the file to it";
    }
    return "save it with 64-bit numbers: as .ply, .obj or a text of .stl";
}

[[noreturn]] void refuse_loss(const std::string& what, const Box& box, bool origin_moves,
                              Elements elements) {
    throw Error(ErrorCode::unsupported, what + ": " + remedy(box, origin_moves),
                std::move(elements));
}

}  // namespace

Vec3 rounded_to_float(const Vec3& p) {
    return p.cast<float>().cast<double>();
}

Vec3 near_origin(const Box& box) {
    return is_far(box) ? rounded_to_float(box.center()) : Vec3(Vec3::Zero());
}

void FloatLoss::look_at(Index face, std::span<const Vec3> points) {
    ++face_count_;
    rounded_.clear();
    for (const Vec3& p : points) {
        box_.extend(p);
        rounded_.push_back(rounded_to_float(p));
    }
    const Vec3 before = vector_area(points), after = vector_area(rounded_);
    if (!has_area(points, before)) return;
    if (!has_area(rounded_, after) || before.dot(after) < 0.0) lost_.add(face);
}

void FloatLoss::require_small(std::string_view format, bool origin_moves,
                              const Context& context) const {
    if (lost_.count == 0) return;
    const std::string what = "the 32-bit numbers of " + std::string(format) +
                             " would flatten or turn over " + describe(lost_) +
                             ", more than one face in a thousand";
    if (lost_.count * kFacesPerLoss > face_count_) refuse_loss(what, box_, origin_moves, lost_);
    context.log(LogLevel::warning,
                "the 32-bit numbers of " + std::string(format) + " have flattened or turned over " +
                    std::to_string(lost_.count) + " of " + std::to_string(face_count_) + " faces");
}

void require_distinct_floats(std::span<const Vec3> positions, std::span<const Index> corners,
                             std::string_view format, bool origin_moves) {
    ValuePool<3> places, rounded;
    // The place that each rounded place was first.
    std::vector<Index> place_of;
    std::vector<char> seen(positions.size(), 0);
    Elements joined{ElementKind::vertex, 0, {}};
    Box box;
    for (const Index v : corners) {
        if (std::exchange(seen[v], 1)) continue;
        const Vec3& p = positions[v];
        const Vec3 r = rounded_to_float(p);
        box.extend(p);
        const Index place = places.add({p.x(), p.y(), p.z()});
        const std::size_t number = rounded.add({r.x(), r.y(), r.z()});
        if (number == place_of.size()) place_of.push_back(place);
        if (place_of[number] != place) joined.add(v);
    }
    if (joined.count == 0) return;
    const std::string what = "the 32-bit numbers of " + std::string(format) + " would join " +
                             describe(joined) + " with others";
    refuse_loss(what, box, origin_moves, std::move(joined));
}

}  // namespace lissom
