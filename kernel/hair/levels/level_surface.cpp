#include "kernel/hair/levels/level_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace lissom {
namespace {

// Corners of a cell by the bits of x, y and z, along the six ways from the first to the last.
constexpr std::array<std::array<int, 4>, 6> kTetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

// Cuts keep this far from nodes, as a part of the edge, so that no triangle has no area.
constexpr double kCutMargin = 0.02;

// Of a vertex in a hash table.
constexpr std::size_t kBytesPerEntry = 40;

class SurfaceCutter {
  public:
    SurfaceCutter(const NodeGrid& grid, const std::vector<float>& values)
        : grid_(grid), values_(values) {}

    void cut_cell(const Eigen::Array3i& cell) {
        std::array<Eigen::Array3i, 8> nodes;
        int above = 0;
        for (int c = 0; c < 8; ++c) {
            nodes[at(c)] = cell + Eigen::Array3i(c & 1, c >> 1 & 1, c >> 2);
            above += is_above(nodes[at(c)]) ? 1 : 0;
        }
        if (above == 0 || above == 8) return;
        for (const auto& tetrahedron : kTetrahedra) {
            cut_tetrahedron({nodes[at(tetrahedron[0])], nodes[at(tetrahedron[1])],
                             nodes[at(tetrahedron[2])], nodes[at(tetrahedron[3])]});
        }
    }

    LevelSurface take() { return std::move(surface_); }

    std::size_t memory_bytes() const {
        return surface_.positions.capacity() * sizeof(Vec3) +
               surface_.triangles.capacity() * sizeof(Triangle) +
               vertices_.size() * kBytesPerEntry + vertices_.bucket_count() * sizeof(void*);
    }

  private:
    using Corners = std::array<Eigen::Array3i, 4>;

    float value(const Eigen::Array3i& node) const { return values_[grid_.place(node)]; }
    bool is_above(const Eigen::Array3i& node) const { return value(node) > 0.0f; }

    void cut_tetrahedron(const Corners& corners) {
        std::vector<Eigen::Array3i> in, out;
        for (const Eigen::Array3i& corner : corners) {
            (is_above(corner) ? in : out).push_back(corner);
        }
        if (in.empty() || out.empty()) return;
        const Vec3 outward = mean_of(out) - mean_of(in);
        if (in.size() == 2) {
            const Index a = cut(in[0], out[0]), b = cut(in[0], out[1]), c = cut(in[1], out[1]),
                        d = cut(in[1], out[0]);
            add(a, b, c, outward);
            add(a, c, d, outward);
        } else if (in.size() == 1) {
            add(cut(in[0], out[0]), cut(in[0], out[1]), cut(in[0], out[2]), outward);
        } else {
            add(cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0]), outward);
        }
    }

    Vec3 mean_of(const std::vector<Eigen::Array3i>& nodes) const {
        Vec3 sum = Vec3::Zero();
        for (const Eigen::Array3i& node : nodes) sum += grid_.position(node);
        return sum / static_cast<double>(nodes.size());
    }

    void add(Index a, Index b, Index c, const Vec3& outward) {
        const std::vector<Vec3>& p = surface_.positions;
        const Vec3 normal = (p[at(b)] - p[at(a)]).cross(p[at(c)] - p[at(a)]);
        if (normal.dot(outward) < 0.0) std::swap(b, c);
        surface_.triangles.push_back({a, b, c});
    }

    // The vertex on an edge.
    Index cut(const Eigen::Array3i& in, const Eigen::Array3i& out) {
        const std::uint64_t a = grid_.place(in), b = grid_.place(out);
        const auto [found, added] = vertices_.try_emplace(std::min(a, b) << 32 | std::max(a, b),
                                                          count_of(surface_.positions));
        if (added) {
            const double from = value(in), to = value(out);
            const double t = std::clamp(from / (from - to), kCutMargin, 1.0 - kCutMargin);
            surface_.positions.push_back((1.0 - t) * grid_.position(in) + t * grid_.position(out));
        }
        return found->second;
    }

    const NodeGrid& grid_;
    const std::vector<float>& values_;
    std::unordered_map<std::uint64_t, Index> vertices_;
    LevelSurface surface_;
};

}  // namespace

double NodeGrid::interpolated(const std::vector<float>& values, const Vec3& point) const {
    const Eigen::Array3d most = (counts - 1).cast<double>();
    const Eigen::Array3d cell = ((point - origin).array() / step).max(0.0).min(most);
    const Eigen::Array3i low = cell.cast<int>().min((counts - 2).max(0));
    const Eigen::Array3d u = cell - low.cast<double>();
    double sum = 0.0;
    for (int c = 0; c < 8; ++c) {
        const Eigen::Array3i bit(c & 1, c >> 1 & 1, c >> 2);
        double weight = 1.0;
        for (int k = 0; k < 3; ++k) weight *= bit[k] != 0 ? u[k] : 1.0 - u[k];
        if (weight > 0.0) sum += weight * values[place((low + bit).min(counts - 1))];
    }
    return sum;
}

LevelSurface level_surface(const NodeGrid& grid, const std::vector<float>& values,
                           const Context& context) {
    Progress progress(context, "surface of hair");
    SurfaceCutter cutter(grid, values);
    MemoryCharge charge;
    for (int z = 0; z + 1 < grid.counts[2]; ++z) {
        progress.update(double(z) / grid.counts[2]);
        for (int y = 0; y + 1 < grid.counts[1]; ++y) {
            if (cutter.memory_bytes() > charge.bytes()) {
                charge = {};
                charge = context.charge(2 * cutter.memory_bytes(), "a surface of hair");
            }
            context.checkpoint();
            for (int x = 0; x + 1 < grid.counts[0]; ++x) cutter.cut_cell({x, y, z});
        }
    }
    return cutter.take();
}

}  // namespace lissom
