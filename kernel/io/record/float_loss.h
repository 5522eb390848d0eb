/// Loss of a surface by the 32-bit numbers of a file; private to kernel/io and not installed.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/geometry.h"

namespace lissom {

/// Returns the point as the file holds it.
Vec3 rounded_to_float(const Vec3& p);

/// Returns the origin that lets 32-bit numbers hold most points of `box`: its middle, which is a
/// 32-bit number itself; zero if the box is no farther from the origin than it is large.
Vec3 near_origin(const Box& box);

/// Finds the faces that rounding makes flat or turns over.
class FloatLoss {
  public:
    /// Looks at the polygon of a face in the coordinates that will be rounded.
    void look_at(Index face, std::span<const Vec3> points);
    /// Reports the loss: nothing, a warning for few faces, or an error for more than one in a
    /// thousand. `origin_moves`: the origin of the file can be moved to the surface and was not.
    /// Errors: unsupported naming the faces.
    void require_small(std::string_view format, bool origin_moves, const Context& context) const;

  private:
    std::size_t face_count_ = 0;
    Elements lost_{ElementKind::face, 0, {}};
    Box box_;
    std::vector<Vec3> rounded_;
};

/// Throws if rounding puts vertices that are apart at one place, because this joins vertices in a
/// format without indices. `corners` are the vertices that are written, in any order. Errors:
/// unsupported naming vertices.
void require_distinct_floats(std::span<const Vec3> positions, std::span<const Index> corners,
                             std::string_view format, bool origin_moves);

}  // namespace lissom
