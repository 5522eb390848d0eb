#include "kernel/merge/loop/band_spike.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// Widths of the band that is searched for tips, and of a tip, in radii of the seam.
constexpr double kSpikeBand = 0.5, kSpikeTip = 0.15;
// Vertices that may be the middle of a tip, at most about.
constexpr std::size_t kSpikeMiddles = 2000;

// Angle missing to a full turn around a vertex, in radians; 0 at a boundary.
double angle_defect(const Mesh& mesh, Index v) {
    const Topology& topology = mesh.topology();
    if (topology.is_boundary(v)) return 0.0;
    double sum = 0.0;
    for (const Index f : topology.faces_around(v)) {
        const std::span<const Index> face = topology.face(f);
        const auto place =
            static_cast<std::size_t>(std::find(face.begin(), face.end(), v) - face.begin());
        const Vec3 next = mesh.position(face[(place + 1) % face.size()]) - mesh.position(v);
        const Vec3 last =
            mesh.position(face[(place + face.size() - 1) % face.size()]) - mesh.position(v);
        sum += angle_between(next, last);
    }
    return 2.0 * kPi - sum;
}

struct Defect {
    Vec3 place = Vec3::Zero();
    double angle = 0.0;
};

// The defects of a band, in cells as wide as a tip.
class Defects {
  public:
    explicit Defects(double width) : width_(width) {}

    void add(const Defect& defect) { cells_[cell_of(defect.place)].push_back(defect); }

    double around(const Vec3& place) const {
        const Cell middle = cell_of(place);
        double sum = 0.0;
        for (int k = 0; k < 27; ++k) {
            const Cell cell{middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1,
                            middle[2] + k / 9 - 1};
            const auto found = cells_.find(cell);
            if (found == cells_.end()) continue;
            for (const Defect& defect : found->second) {
                if ((defect.place - place).norm() <= width_) sum += defect.angle;
            }
        }
        return sum;
    }

  private:
    using Cell = std::array<long, 3>;

    Cell cell_of(const Vec3& place) const {
        return {std::lround(place.x() / width_), std::lround(place.y() / width_),
                std::lround(place.z() / width_)};
    }

    double width_ = 0.0;
    std::map<Cell, std::vector<Defect>> cells_;
};

}  // namespace

double band_spike(const Mesh& mesh, std::span<const double> distance, double radius) {
    if (!(radius > 0.0)) return 0.0;
    Defects defects(kSpikeTip * radius);
    std::vector<Index> middles;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!(distance[at(v)] <= (kSpikeBand + kSpikeTip) * radius)) continue;
        defects.add({mesh.position(v), angle_defect(mesh, v)});
        if (distance[at(v)] <= kSpikeBand * radius) middles.push_back(v);
    }
    const std::size_t step = std::max<std::size_t>(1, middles.size() / kSpikeMiddles);
    double greatest = 0.0;
    for (std::size_t k = 0; k < middles.size(); k += step) {
        greatest = std::max(greatest, defects.around(mesh.position(middles[k])));
    }
    return greatest;
}

}  // namespace lissom
