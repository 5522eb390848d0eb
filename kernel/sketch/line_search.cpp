#include "kernel/sketch/line_search.h"

#include <array>
#include <cmath>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// The points seen in a square around the pixel lie inside of four planes through the eye; points
// have a bit for each plane that they are outside of.
class SquareCone {
  public:
    SquareCone(const Affine& to_world, const View& view, const Vec2& cursor, double radius) {
        const std::array<Vec2, 4> corners{Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)};
        const Ray middle = view.ray(cursor);
        const Vec3 inside = middle.origin + middle.direction;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Ray a = view.ray(cursor + radius * corners[k]);
            const Ray b = view.ray(cursor + radius * corners[(k + 1) % 4]);
            Vec3 normal = a.direction.cross(b.origin + b.direction - a.origin);
            if (normal.dot(inside - a.origin) < 0.0) normal = -normal;
            normals_[k] = to_world.linear.transpose() * normal;
            distances_[k] = normal.dot(to_world.translation - a.origin);
        }
    }

    unsigned outside(const float* p) const {
        unsigned bits = 0;
        for (unsigned k = 0; k < 4; ++k) {
            const Vec3& n = normals_[k];
            const double side = n.x() * p[0] + n.y() * p[1] + n.z() * p[2] + distances_[k];
            bits |= static_cast<unsigned>(side < 0.0) << k;
        }
        return bits;
    }

  private:
    std::array<Vec3, 4> normals_;
    std::array<double, 4> distances_;
};

// A segment with both ends outside of one plane is not seen in the square. For a line of which
// nothing is seen the run is {line, 0, -1}.
LineRun seen_run(const SquareCone& cone, const float* points, Index count, Index line) {
    LineRun run{line, 0, -1};
    unsigned last = cone.outside(points);
    if (last == 0) run.last = 0;
    bool finite = true;
    for (Index k = 0; k < count; ++k) {
        const float* p = points + 3 * at(k);
        finite = finite && std::isfinite(p[0] + p[1] + p[2]);
        const unsigned next = cone.outside(p);
        if (k > 0 && (last & next) == 0) {
            if (run.last < 0) run.first = k - 1;
            run.last = k;
        }
        last = next;
    }
    return finite ? run : LineRun{line, 0, -1};
}

}  // namespace

std::vector<LineRun> lines_near(std::span<const float> points, std::span<const Index> offsets,
                                const Affine& to_world, const View& view, const Vec2& cursor,
                                double radius, const Context& context) {
    require(radius >= 0.0 && std::isfinite(radius), "the radius must be 0 pixels or more");
    // Rounding, and a radius of 0.
    constexpr double kMargin = 0.5;
    constexpr Index kGrain = 1024;
    const SquareCone cone(to_world, view, cursor, radius + kMargin);
    const Index count = offsets.empty() ? 0 : index_of(offsets.size()) - 1;
    std::vector<LineRun> runs(at(count), LineRun{0, 0, -1});
    context.parallel_for(0, count, kGrain, [&](Index begin, Index end) {
        context.checkpoint();
        for (Index i = begin; i < end; ++i) {
            const Index first = offsets[at(i)], size = offsets[at(i) + 1] - first;
            if (size > 0) runs[at(i)] = seen_run(cone, points.data() + 3 * at(first), size, i);
        }
    });
    std::erase_if(runs, [](const LineRun& run) { return run.last < 0; });
    return runs;
}

}  // namespace lissom
