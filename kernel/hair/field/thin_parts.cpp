#include "kernel/hair/field/thin_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// Places on the surface are at most so far apart, in steps of the grid.
constexpr double kPlaceSpacing = 0.2;
// Along a side of a triangle at most: one as large as the grid has no need of more.
constexpr int kMaxPlaces = 2000;
constexpr std::size_t kTrianglesPerCheckpoint = 4096;

// Lowers the values at the corners of cells.
class ThinPartCorrection {
  public:
    ThinPartCorrection(const DistanceGrid& distances)
        : layout_(distances.layout()),
          box_(layout_.box()),
          trusted_(kTrustedDistance * layout_.step),
          values_(distances.values().begin(), distances.values().end()) {}

    void place(const Vec3& p) {
        if (!((p.array() >= box_.min.array()).all() && (p.array() <= box_.max.array()).all())) {
            return;
        }
        std::array<Index, 8> corners{};
        std::array<double, 8> weights{};
        find_cell(p, corners, weights);
        double value = 0.0, squares = 0.0;
        for (std::size_t c = 0; c < 8; ++c) {
            value += weights[c] * values_[corners[c]];
            squares += weights[c] * weights[c];
        }
        if (!(value > trusted_)) return;
        for (std::size_t c = 0; c < 8; ++c) {
            values_[corners[c]] -= static_cast<float>(weights[c] * (value - trusted_) / squares);
        }
    }

    void triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        const double parts = std::ceil(longest / (kPlaceSpacing * layout_.step));
        const int count = static_cast<int>(std::clamp(parts, 1.0, double{kMaxPlaces}));
        for (int i = 0; i <= count; ++i) {
            for (int j = 0; i + j <= count; ++j) {
                place(a + static_cast<double>(i) / count * (b - a) +
                      static_cast<double>(j) / count * (c - a));
            }
        }
    }

    std::vector<float> take() { return std::move(values_); }

  private:
    void find_cell(const Vec3& p, std::array<Index, 8>& corners,
                   std::array<double, 8>& weights) const {
        const Vec3 at = (p - layout_.origin) / layout_.step;
        std::array<Index, 3> cell{};
        Vec3 t;
        for (int axis = 0; axis < 3; ++axis) {
            cell[axis] = std::clamp(static_cast<Index>(at[axis]), 0, layout_.counts[axis] - 2);
            t[axis] = std::clamp(at[axis] - cell[axis], 0.0, 1.0);
        }
        for (int c = 0; c < 8; ++c) {
            const std::array<int, 3> up{c & 1, (c >> 1) & 1, c >> 2};
            corners[c] = layout_.index(cell[0] + up[0], cell[1] + up[1], cell[2] + up[2]);
            double weight = 1.0;
            for (int axis = 0; axis < 3; ++axis) weight *= up[axis] ? t[axis] : 1.0 - t[axis];
            weights[c] = weight;
        }
    }

    GridLayout layout_;
    Box box_;
    double trusted_;
    std::vector<float> values_;
};

}  // namespace

std::vector<float> collision_distances(const DistanceGrid& distances, const Mesh& head,
                                       const Context& context) {
    const auto positions = head.positions();
    const std::vector<Triangle> triangles = triangulate_faces(head.topology(), positions).triangles;
    ThinPartCorrection lowering(distances);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (t % kTrianglesPerCheckpoint == 0) context.checkpoint();
        const auto& [a, b, c] = triangles[t];
        lowering.triangle(positions[a], positions[b], positions[c]);
    }
    return lowering.take();
}

}  // namespace lissom
