#include "kernel/mesh/measure/orientation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

#include "kernel/mesh/directed_edges.h"

namespace lissom {
namespace {

// The corner on the other side of each edge with exactly two faces.
struct Neighbors {
    std::vector<Index> partner;
    // Whether the two run in opposite directions, as they should.
    std::vector<char> agrees;
    bool all_agree = true;

    Neighbors(std::span<const Vec3> positions, const CornerFaces& work)
        : partner(work.faces.vertices.size(), kNoIndex), agrees(partner.size(), 1) {
        const DirectedEdges edges(count_of(positions), work.faces);
        edges.for_each_edge([&](std::span<const Index> corners) {
            if (corners.size() != 2) return;
            const bool agree = edges.ascending(corners[0]) != edges.ascending(corners[1]);
            for (int k = 0; k < 2; ++k) {
                partner[corners[k]] = corners[1 - k];
                agrees[corners[k]] = agree ? 1 : 0;
            }
            all_agree = all_agree && agree;
        });
    }
};

class Orienter {
  public:
    Orienter(std::span<const Vec3> positions, const CornerFaces& work, const Neighbors& neighbors)
        : positions_(positions),
          work_(work),
          neighbors_(neighbors),
          flipped_(work.faces.size(), 0),
          visited_(flipped_.size(), 0) {}

    // One flag a face.
    std::vector<char> run() {
        for (Index f = 0; f < work_.faces.size(); ++f) {
            if (visited_[f]) continue;
            spread(f);
            if (conflicts_ == 0) continue;
            if (is_one_sided()) {
                for (const Index g : piece_) flipped_[g] = 0;
            } else if (should_invert()) {
                for (const Index g : piece_) flipped_[g] = !flipped_[g];
            }
        }
        return std::move(flipped_);
    }

  private:
    // Visits the piece of the surface around `seed`, turning faces over to agree with the first.
    void spread(Index seed) {
        piece_.assign(1, seed);
        visited_[seed] = 1;
        closed_ = true;
        conflicts_ = 0;
        for (std::size_t i = 0; i < piece_.size(); ++i) {
            const Index f = piece_[i];
            for (Index c = work_.faces.offsets[f]; c < work_.faces.offsets[f + 1]; ++c) {
                const Index other = neighbors_.partner[c];
                if (other == kNoIndex) {
                    closed_ = false;
                    continue;
                }
                conflicts_ += neighbors_.agrees[c] ? 0 : 1;
                const Index g = work_.face_of_corner[other];
                if (visited_[g]) continue;
                visited_[g] = 1;
                flipped_[g] = neighbors_.agrees[c] ? flipped_[f] : !flipped_[f];
                piece_.push_back(g);
            }
        }
    }

    // Whether turning faces over leaves at least as many edges in conflict as there were.
    bool is_one_sided() const {
        std::size_t left = 0;
        for (const Index f : piece_) {
            for (Index c = work_.faces.offsets[f]; c < work_.faces.offsets[f + 1]; ++c) {
                const Index other = neighbors_.partner[c];
                if (other == kNoIndex) continue;
                const bool turned = flipped_[f] != flipped_[work_.face_of_corner[other]];
                left += (neighbors_.agrees[c] != 0) == turned ? 1 : 0;
            }
        }
        return left >= conflicts_;
    }

    bool should_invert() const {
        double kept = 0.0, turned = 0.0, volume = 0.0;
        const Vec3 origin = positions_[work_.faces[piece_[0]][0]];
        for (const Index f : piece_) {
            const Vec3 area = vector_area(positions_, work_.faces[f]);
            (flipped_[f] ? turned : kept) += area.norm();
            const double cone = area.dot(positions_[work_.faces[f][0]] - origin) / 3.0;
            volume += flipped_[f] ? -cone : cone;
        }
        const double size = std::pow(kept + turned, 1.5);
        if (closed_ && std::abs(volume) > 1e-9 * size) return volume < 0.0;
        return turned > kept;
    }

    std::span<const Vec3> positions_;
    const CornerFaces& work_;
    const Neighbors& neighbors_;
    std::vector<char> flipped_, visited_;
    std::vector<Index> piece_;
    bool closed_ = true;
    // Corners of the piece whose edges both faces run along in the same direction.
    std::size_t conflicts_ = 0;
};

}  // namespace

Vec3 vector_area(std::span<const Vec3> positions, std::span<const Index> face) {
    Vec3 sum = Vec3::Zero();
    const Vec3& origin = positions[face[0]];
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        const Vec3 a = positions[face[k]] - origin, b = positions[face[k + 1]] - origin;
        sum += 0.5 * a.cross(b);
    }
    return sum;
}

void orient_faces(std::span<const Vec3> positions, CornerFaces& work, Report& report) {
    const Neighbors neighbors(positions, work);
    if (neighbors.all_agree) return;
    const std::vector<char> flipped = Orienter(positions, work, neighbors).run();
    CornerFaces turned;
    std::vector<Index> corners, changed;
    for (Index f = 0; f < work.faces.size(); ++f) {
        corners.clear();
        for (Index c = work.faces.offsets[f]; c < work.faces.offsets[f + 1]; ++c)
            corners.push_back(c);
        if (flipped[f]) {
            std::reverse(corners.begin() + 1, corners.end());
            changed.push_back(work.face_source[f]);
        }
        turned.add(work, f, corners);
    }
    const std::size_t count = changed.size();
    if (count > 0) {
        report.add(
            {FindingKind::faces_flipped, ElementKind::face, true, count, std::move(changed), {}});
    }
    work = std::move(turned);
}

}  // namespace lissom
