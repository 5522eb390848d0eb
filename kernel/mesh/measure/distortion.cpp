#include "kernel/mesh/measure/distortion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "kernel/core/geometry.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/same_faces.h"

namespace lissom {
namespace {

void require_same_faces(const Mesh& mesh, const Mesh& rest) {
    if (have_same_faces(mesh, rest)) return;
    throw Error(ErrorCode::topology_mismatch,
                "the two meshes have different faces; compare a mesh with a copy of itself in "
                "another shape");
}

// Returns the ratio of lengths farthest from 1 among the edges at each vertex, as a factor.
std::vector<double> edge_stretch(const Mesh& mesh, const Mesh& rest) {
    std::vector<double> stretch(mesh.vertex_count(), kNone);
    for (Index e = 0; e < mesh.topology().edge_count(); ++e) {
        const auto [a, b] = mesh.topology().edge(e);
        const double before = (rest.position(a) - rest.position(b)).norm();
        if (!(before > 0.0)) continue;
        const double ratio = (mesh.position(a) - mesh.position(b)).norm() / before;
        for (const Index v : {a, b}) {
            const double kept = std::isnan(stretch[v]) ? 0.0 : std::abs(std::log(stretch[v]));
            if (std::isnan(stretch[v]) || std::abs(std::log(ratio)) > kept) stretch[v] = ratio;
        }
    }
    return stretch;
}

std::vector<double> area_ratio(const Mesh& mesh, const Mesh& rest) {
    const std::vector<double> now = face_areas(mesh), before = face_areas(rest);
    std::vector<double> ratio(mesh.vertex_count(), kNone);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        double sum = 0.0, sum_before = 0.0;
        for (const Index f : mesh.topology().faces_around(v)) {
            sum += now[f];
            sum_before += before[f];
        }
        if (sum_before > 0.0) ratio[v] = sum / sum_before;
    }
    return ratio;
}

double angle_at(const Mesh& mesh, std::span<const Index> face, std::size_t k, const Vec3& normal) {
    const std::size_t n = face.size();
    return corner_angle(mesh.position(face[(k + n - 1) % n]), mesh.position(face[k]),
                        mesh.position(face[(k + 1) % n]), normal);
}

std::vector<double> angle_change(const Mesh& mesh, const Mesh& rest, std::span<const Vec3> now,
                                 std::span<const Vec3> before) {
    std::vector<double> change(mesh.vertex_count(), kNone);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (now[f].isZero(0.0) || before[f].isZero(0.0)) continue;
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const double by =
                std::abs(angle_at(mesh, face, k, now[f]) - angle_at(rest, face, k, before[f]));
            change[face[k]] = std::fmax(change[face[k]], by);
        }
    }
    return change;
}

// A face that stood steeply beside its neighbours at rest has flipped only if it turned against
// them by this angle as well.
constexpr double kFlipped = 30.0 * kPi / 180.0;

// Faces around whose areas cancel but for this share look no way, as those beside the end of a bar:
// none can look against them.
constexpr double kCoherent = 0.25;

// Faces around a vertex beyond which they are summed once for all of them.
constexpr std::size_t kSummedFaces = 256;

// How a face lies beside the faces that it shares vertices with, each counting by its area.
struct Facing {
    double angle = 0.0;
    /// How far those look the same way, 0 to 1.
    double coherence = 0.0;
};

class Neighborhood {
  public:
    Neighborhood(const Mesh& mesh, std::span<const Vec3> normals)
        : topology_(mesh.topology()), normals_(normals), area_(face_areas(mesh)) {
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            if (!is_hub(v)) continue;
            Sum& sum = hubs_[v];
            for (const Index g : topology_.faces_around(v)) add(sum, g, 1.0);
        }
    }

    Facing facing(Index f) const {
        Sum sum;
        for (const Index v : topology_.face(f)) {
            if (is_hub(v)) {
                const Sum& hub = hubs_.at(v);
                sum.area += hub.area;
                sum.whole += hub.whole;
                add(sum, f, -1.0);
                continue;
            }
            for (const Index g : topology_.faces_around(v)) {
                if (g != f) add(sum, g, 1.0);
            }
        }
        const double angle =
            std::atan2(sum.area.cross(normals_[at(f)]).norm(), sum.area.dot(normals_[at(f)]));
        return {angle, sum.whole > 0.0 ? sum.area.norm() / sum.whole : 0.0};
    }

  private:
    struct Sum {
        Vec3 area = Vec3::Zero();
        double whole = 0.0;
    };

    bool is_hub(Index v) const { return topology_.faces_around(v).size() > kSummedFaces; }

    void add(Sum& sum, Index face, double times) const {
        sum.area += times * area_[at(face)] * normals_[at(face)];
        sum.whole += times * area_[at(face)];
    }

    std::unordered_map<Index, Sum> hubs_;
    const Topology& topology_;
    std::span<const Vec3> normals_;
    std::vector<double> area_;
};

bool has_flipped(const Facing& now, const Facing& before) {
    return now.angle > 0.5 * kPi && before.angle <= 0.5 * kPi &&
           now.angle - before.angle > kFlipped && before.coherence > kCoherent;
}

}  // namespace

Distortion distortion(const Mesh& mesh, const Mesh& rest, const Context& context) {
    require_same_faces(mesh, rest);
    Progress progress(context, "distortion");
    const std::vector<Vec3> now = face_normals(mesh), before = face_normals(rest);
    Distortion result{edge_stretch(mesh, rest), area_ratio(mesh, rest), {}, {}, {}};
    progress.step(0.5);
    result.angle = angle_change(mesh, rest, now, before);
    std::vector<Index> all(at(mesh.face_count()));
    std::iota(all.begin(), all.end(), 0);
    result.flipped = flipped_faces(mesh, rest, all);
    result.flips.assign(mesh.vertex_count(), 0.0);
    for (const Index f : result.flipped) {
        for (const Index v : mesh.topology().face(f)) result.flips[v] += 1.0;
    }
    return result;
}

std::vector<Index> flipped_faces(const Mesh& mesh, const Mesh& rest, std::span<const Index> faces) {
    require_same_faces(mesh, rest);
    const std::vector<Vec3> now = face_normals(mesh), before = face_normals(rest);
    const Neighborhood around(mesh, now), around_before(rest, before);
    std::vector<Index> flipped;
    std::copy_if(faces.begin(), faces.end(), std::back_inserter(flipped),
                 [&](Index f) { return has_flipped(around.facing(f), around_before.facing(f)); });
    return flipped;
}

}  // namespace lissom
