// One level of refinement at a boundary: faces that touch it split into four, and those next to
// them as conformity needs (Bank, Sherman and Weiser 1983).
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "kernel/merge/merge_side.h"
#include "kernel/merge/provenance.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// A vertex of a new face: an old corner, or the middle of two.
struct NewCorner {
    Index vertex = kNoIndex;
    Index first = kNoIndex, second = kNoIndex;
};

class Refinement {
  public:
    Refinement(const Mesh& mesh, const std::vector<Index>& loop) : mesh_(mesh) {
        std::vector<char> on_loop(mesh.vertex_count(), 0);
        for (const Index v : loop) on_loop[v] = 1;
        split_.assign(mesh.face_count(), 0);
        for (Index f = 0; f < mesh.face_count(); ++f) {
            for (const Index v : mesh.topology().face(f)) split_[f] |= on_loop[v];
        }
        map_.vertices = ElementMap::identity(mesh.vertex_count());
        for (Index f = 0; f < mesh.face_count(); ++f) {
            if (split_[f]) find_middles(f);
        }
    }

    Mesh refined(MeshMap& map, const Context& context) {
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (split_[f]) {
                split_face(f);
            } else {
                fit_face(f);
            }
        }
        std::vector<Vec3> positions = blend_positions(mesh_, map_.vertices);
        Mesh result = derive(mesh_, std::move(positions), std::move(faces_), map_, context);
        map = std::move(map_);
        return result;
    }

  private:
    std::vector<Triangle> triangles_of(Index f) const {
        const Index face[] = {f};
        return triangulate_faces(mesh_.topology(), mesh_.positions(), face).corners;
    }
    Index vertex_of(Index corner) const { return mesh_.topology().faces().vertices[corner]; }

    void find_middles(Index f) {
        for (const Triangle& corners : triangles_of(f)) {
            for (int k = 0; k < 3; ++k) {
                const Index a = vertex_of(corners[k]), b = vertex_of(corners[(k + 1) % 3]);
                const auto [at, is_new] = middle_.try_emplace(std::minmax(a, b), next_vertex());
                if (is_new) map_.vertices.add_mean(std::array{a, b});
            }
        }
    }
    Index next_vertex() const { return map_.vertices.size(); }

    // The middle between two corners, or nothing if their edge is whole.
    NewCorner middle(Index a, Index b) const {
        const auto at = middle_.find(std::minmax(vertex_of(a), vertex_of(b)));
        return at == middle_.end() ? NewCorner{} : NewCorner{at->second, a, b};
    }
    NewCorner old(Index corner) const { return {vertex_of(corner), corner, kNoIndex}; }

    void add_face(std::span<const NewCorner> corners, Index from) {
        std::vector<Index> face;
        for (const NewCorner& c : corners) {
            face.push_back(c.vertex);
            if (c.second == kNoIndex) {
                map_.corners.add_copy(c.first);
            } else {
                map_.corners.add_mean(std::array{c.first, c.second});
            }
        }
        faces_.add(face);
        map_.faces.add_copy(from);
    }

    void split_face(Index f) {
        for (const Triangle& t : triangles_of(f)) {
            const NewCorner m[] = {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
            for (int k = 0; k < 3; ++k) {
                add_face(std::array{old(t[k]), m[k], m[(k + 2) % 3]}, f);
            }
            add_face(m, f);
        }
    }

    // A face with middles on its edges: a triangle splits towards them, a polygon takes them in.
    void fit_face(Index f) {
        const Index first = mesh_.topology().first_corner(f);
        const auto n = count_of(mesh_.topology().face(f));
        std::vector<NewCorner> around;
        std::vector<Index> places;
        for (Index k = 0; k < n; ++k) {
            around.push_back(old(first + k));
            const NewCorner m = middle(first + k, first + (k + 1) % n);
            if (m.vertex == kNoIndex) continue;
            places.push_back(count_of(around));
            around.push_back(m);
        }
        if (n > 3 || places.empty()) return add_face(around, f);
        const auto size = count_of(around);
        const auto at = [&](Index k) { return around[(places[0] + k) % size]; };
        if (places.size() == 1) {
            add_face(std::array{at(0), at(1), at(2)}, f);
            add_face(std::array{at(0), at(2), at(3)}, f);
        } else if (places.size() == 3) {
            for (Index k = 0; k < 3; ++k) {
                add_face(std::array{at(2 * k), at(2 * k + 1), at((2 * k + 2) % 6)}, f);
            }
            add_face(std::array{at(0), at(2), at(4)}, f);
        } else {
            split_in_three(around, places, f);
        }
    }

    // The corner between the two middles, and the quad that is left along its shorter diagonal.
    void split_in_three(const std::vector<NewCorner>& around, const std::vector<Index>& places,
                        Index f) {
        const bool next = places[1] == places[0] + 2;
        const Index start = next ? places[0] : places[1];
        const auto at = [&](Index k) { return around[(start + k) % 5]; };
        const auto point = [&](const NewCorner& c) -> Vec3 {
            if (c.second == kNoIndex) return mesh_.position(c.vertex);
            return 0.5 * (mesh_.position(vertex_of(c.first)) + mesh_.position(vertex_of(c.second)));
        };
        add_face(std::array{at(0), at(1), at(2)}, f);
        if ((point(at(0)) - point(at(3))).norm() <= (point(at(2)) - point(at(4))).norm()) {
            add_face(std::array{at(0), at(2), at(3)}, f);
            add_face(std::array{at(0), at(3), at(4)}, f);
        } else {
            add_face(std::array{at(0), at(2), at(4)}, f);
            add_face(std::array{at(2), at(3), at(4)}, f);
        }
    }

    const Mesh& mesh_;
    std::vector<char> split_;
    std::map<std::pair<Index, Index>, Index> middle_;
    FaceList faces_;
    MeshMap map_;
};

}  // namespace

void refine_loop(MergeSide& side, std::size_t loop, const Context& context) {
    MeshMap map;
    Mesh refined = Refinement(side.mesh, side.loops[loop]).refined(map, context);
    side.map = composed(map, side.map);
    side.mesh = std::move(refined);
    // Old vertices keep their ids; loops that gained vertices are found by one of them.
    for (std::vector<Index>& changed : side.loops) {
        for (const std::vector<Index>& boundary : side.mesh.topology().boundary_loops()) {
            const auto at = std::find(boundary.begin(), boundary.end(), changed.front());
            if (at == boundary.end()) continue;
            std::vector<Index> found(at, boundary.end());
            found.insert(found.end(), boundary.begin(), at);
            changed = std::move(found);
            break;
        }
    }
}

}  // namespace lissom
