#include "viewer/render/draw/shading_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

constexpr Index kNormalGrain = 4096;

// Zero for a vector without length.
Vec3 unit_or_zero(const Vec3& v) {
    const double length = v.norm();
    return length > 0.0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

Vec3 face_normal(std::span<const Index> face, std::span<const Vec3> positions,
                 std::vector<Vec3>& corners) {
    corners.clear();
    for (const Index v : face) corners.push_back(positions[v]);
    return polygon_normal(corners);
}

// One face of the fan around a vertex.
struct FanFace {
    Index corner;
    Vec3 normal;
    double angle;
};

// Walks the fans of one mesh; reuses buffers.
class CornerNormals {
  public:
    CornerNormals(const Topology& topology, std::span<const Vec3> positions,
                  std::span<const Vec3> normals, double crease)
        : topology_(topology),
          positions_(positions),
          normals_(normals),
          crease_cosine_(std::cos(std::clamp(crease, 0.0, kPi))) {}

    // Writes the normals of the corners at `v`.
    void write(Index v, std::vector<Vec3>& result) {
        gather_fan(v);
        const std::size_t count = fan_.size();
        const std::size_t start = first_after_crease(topology_.is_boundary(v));
        for (std::size_t begin = 0; begin < count;) {
            std::size_t end = begin + 1;
            while (end < count && !is_crease(start + end - 1)) ++end;
            write_group(start + begin, start + end, result);
            begin = end;
        }
    }

  private:
    void gather_fan(Index v) {
        fan_.clear();
        for (const Index f : topology_.faces_around(v)) {
            const std::span<const Index> face = topology_.face(f);
            const std::size_t at = std::find(face.begin(), face.end(), v) - face.begin();
            const double angle =
                corner_angle(positions_[face[(at + face.size() - 1) % face.size()]], positions_[v],
                             positions_[face[(at + 1) % face.size()]], normals_[f]);
            fan_.push_back({topology_.first_corner(f) + index_of(at), normals_[f], angle});
        }
    }

    const FanFace& face(std::size_t i) const { return fan_[i % fan_.size()]; }

    // Between the i-th face and the next. A face without area has no side of its own.
    bool is_crease(std::size_t i) const {
        const Vec3 &a = face(i).normal, &b = face(i + 1).normal;
        return !a.isZero(0.0) && !b.isZero(0.0) && a.dot(b) < crease_cosine_;
    }

    // First corner of the walk, chosen so that no group runs over the end.
    std::size_t first_after_crease(bool boundary) const {
        if (boundary) return 0;
        for (std::size_t i = 0; i < fan_.size(); ++i) {
            if (is_crease(i)) return i + 1;
        }
        return 0;
    }

    void write_group(std::size_t begin, std::size_t end, std::vector<Vec3>& result) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = begin; i < end; ++i) sum += face(i).angle * face(i).normal;
        const Vec3 normal = unit_or_zero(sum);
        for (std::size_t i = begin; i < end; ++i) result[face(i).corner] = normal;
    }

    const Topology& topology_;
    std::span<const Vec3> positions_;
    std::span<const Vec3> normals_;
    double crease_cosine_;
    std::vector<FanFace> fan_;
};

}  // namespace

std::vector<Vec3> face_normals(const Topology& topology, std::span<const Vec3> positions,
                               const Context& context) {
    std::vector<Vec3> normals(topology.face_count());
    context.parallel_for(0, topology.face_count(), kNormalGrain, [&](Index begin, Index end) {
        std::vector<Vec3> corners;
        for (Index f = begin; f < end; ++f) {
            normals[f] = face_normal(topology.face(f), positions, corners);
        }
    });
    return normals;
}

std::vector<Vec3> corner_normals(const Topology& topology, std::span<const Vec3> positions,
                                 double crease, const Context& context) {
    const std::vector<Vec3> normals = face_normals(topology, positions, context);
    std::vector<Vec3> result(topology.corner_count());
    context.parallel_for(0, topology.vertex_count(), kNormalGrain, [&](Index begin, Index end) {
        CornerNormals walk(topology, positions, normals, crease);
        for (Index v = begin; v < end; ++v) walk.write(v, result);
    });
    return result;
}

}  // namespace lissom
