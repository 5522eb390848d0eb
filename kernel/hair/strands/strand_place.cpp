#include "kernel/hair/strands/strand_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kernel/hair/curve/length_text.h"
#include "kernel/hair/follow/strand_roots.h"
#include "kernel/hair/strands/strand_measures.h"

namespace lissom {
namespace {

// Roots that are looked at; they lie all over the scalp.
constexpr std::size_t kLookedAt = 2000;
// Ratio of the distances that may remain between both: else they are of another mesh.
constexpr double kTolerance = 0.02;

// Relative to the size of a mesh: hair is seldom smaller than that of a body's, or larger than a
// head's.
constexpr double kSmallest = 0.05, kLargest = 20.0;

struct UsualUnit {
    double metres;
    const char* name;
};
constexpr std::array<UsualUnit, 6> kUsualUnits = {{{1.0, "metres"},
                                                   {0.3048, "feet"},
                                                   {0.1, "decimetres"},
                                                   {0.0254, "inches"},
                                                   {0.01, "centimetres"},
                                                   {0.001, "millimetres"}}};

double spread(const std::vector<Vec3>& points) {
    Vec3 center = Vec3::Zero();
    for (const Vec3& p : points) center += p;
    center /= points.size();
    double sum = 0.0;
    for (const Vec3& p : points) sum += (p - center).squaredNorm();
    return std::sqrt(sum);
}

// Places on a mesh, and the roots of the strands there.
struct RootedPlaces {
    std::vector<Vec3> places, points;
};

// Those of some strands; nothing if the mesh has not their faces.
std::optional<RootedPlaces> rooted_places(const Strands& strands, const Mesh& mesh) {
    const StrandRoots& roots = strands.roots();
    RootedPlaces rooted;
    const std::size_t stride = std::max(roots.faces.size() / kLookedAt, std::size_t{1});
    for (std::size_t s = 0; s < roots.faces.size(); s += stride) {
        if (roots.faces[s] == kNoIndex) continue;
        const auto place = root_place(roots, index_of(s), mesh);
        const Vec3 point = strands.root(index_of(s)).cast<double>();
        if (!place) return std::nullopt;
        if (!point.allFinite()) continue;
        rooted.places.push_back(*place);
        rooted.points.push_back(point);
    }
    return rooted;
}

}  // namespace

bool may_be_rooted_on(const Strands& strands, const Mesh& mesh) {
    constexpr double kDeformed = 0.1;
    const auto rooted = rooted_places(strands, mesh);
    if (!rooted) return false;
    const std::size_t count = rooted->points.size();
    if (count < 3) return true;
    double both = 0.0, on_mesh = 0.0, of_roots = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const double a = (rooted->places[next] - rooted->places[i]).norm();
        const double b = (rooted->points[next] - rooted->points[i]).norm();
        both += a * b;
        on_mesh += a * a;
        of_roots += b * b;
    }
    // The least sum of squares of b - factor a, as a part of that of b.
    return of_roots == 0.0 ||
           (on_mesh > 0.0 && 1.0 - both * both / (on_mesh * of_roots) < kDeformed * kDeformed);
}

std::optional<double> unit_of_roots(const Strands& strands, const Mesh& mesh) {
    auto rooted = rooted_places(strands, mesh);
    if (!rooted || rooted->places.size() < 2) return std::nullopt;
    auto& [places, points] = *rooted;
    const double unit = spread(points) / spread(places);
    if (!std::isfinite(unit) || unit <= 0.0) return std::nullopt;
    for (Vec3& place : places) place *= unit;
    double off = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        off = std::max(off, (places[i] - points[i]).norm());
    }
    return off < kTolerance * spread(points) ? std::optional(unit) : std::nullopt;
}

std::string doubt_about_unit(const Strands& strands, const Mesh& mesh, double unit) {
    Box box;
    for (const Vec3& p : mesh.positions()) box.extend(p);
    const double hair = bounds(strands).diagonal(), size = box.diagonal();
    const double ratio = hair / (unit * size);
    if (!(hair > 0.0) || !(size > 0.0) || (ratio > kSmallest && ratio < kLargest)) return {};
    const UsualUnit* best = &kUsualUnits.front();
    const auto miss = [&](const UsualUnit& one) {
        return std::abs(std::log(hair / (one.metres * size)));
    };
    for (const UsualUnit& one : kUsualUnits) {
        if (miss(one) < miss(*best)) best = &one;
    }
    return "the strands are " + length_text(hair) + " m large and the mesh " + length_text(size) +
           " units, which count as " + length_text(unit) +
           " m each: hair will hardly be seen on it; "
           "give hair = { unit = " +
           length_text(best->metres) + " } if the mesh is in " + best->name;
}

}  // namespace lissom
