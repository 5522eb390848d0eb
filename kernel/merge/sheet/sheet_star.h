/// Angles of some triangles of a sheet, by which changes are judged; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/sheet/sheet_triangles.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// Dihedral angles (radians) that a change may make even if there was none as great: across seams,
/// and elsewhere.
struct SheetLimits {
    double seam = 0.0, other = 0.0;

    bool operator==(const SheetLimits&) const = default;
};

/// The greatest dihedral angles and the smallest angle of some triangles.
struct SheetStar {
    double seam = 0.0, other = 0.0, angle = kPi;
};

/// Returns whether a change keeps to the limits, or makes nothing worse. Triangles whose smallest
/// angle is above `good_angle` may become thinner, down to that.
bool is_allowed(const SheetStar& before, const SheetStar& after, const SheetLimits& limits,
                double good_angle);

/// Measures triangles and their edges, each once.
class StarMeter {
  public:
    explicit StarMeter(SheetTriangles& sheet) : sheet_(sheet) {}

    /// Returns the angles of triangles that are there.
    SheetStar of(std::span<const Index> faces);
    /// Returns those of new triangles in place of others; vertex `moved`, which only these have,
    /// lies at `to`.
    SheetStar with(std::span<const Triangle> triangles, std::span<const Index> instead_of,
                   Index moved = kNoIndex, const Vec3& to = Vec3::Zero());

  private:
    // A triangle that is there or would be.
    struct Facet {
        Triangle corners;
        Vec3 normal;
        double angle;
    };
    SheetStar measured(std::span<const Index> instead_of) const;

    SheetTriangles& sheet_;
    std::vector<Facet> facets_;
};

}  // namespace lissom
