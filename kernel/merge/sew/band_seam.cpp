// Seams along the source's loop, with a band of new triangles on the target's side.

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "kernel/merge/sew/seam_band.h"
#include "kernel/merge/sew/seam_loop.h"
#include "kernel/merge/sew/seam_work.h"

namespace lissom {
namespace {

class BandSeam {
  public:
    BandSeam(SeamWork& work, const LoopPair& join) : work_(work), join_(join) {
        const Topology& topology = work.both.topology();
        for (const Index v : join.target) {
            const std::span<const Index> around = topology.faces_around(v);
            band_.insert(around.begin(), around.end());
        }
    }

    void remove_band() {
        find_rim();
        work_.patch.remove(band_);
        // Beside those of the loop, vertices all of whose faces touch it have none left.
        const Topology& topology = work_.both.topology();
        for (const Index f : band_) {
            for (const Index v : topology.face(f)) {
                const std::span<const Index> around = topology.faces_around(v);
                if (std::all_of(around.begin(), around.end(),
                                [&](Index g) { return band_.contains(g); })) {
                    work_.gone.insert(v);
                }
            }
        }
        work_.report.band_removed += count_of(band_);
    }

    void close_gap(const Context& context) {
        std::vector<Vec3> rim, loop, target;
        for (const Index v : join_.target) target.push_back(work_.both.position(v));
        for (const Index v : rim_) rim.push_back(work_.both.position(v));
        for (const LoopPoint& place : join_.on_target) loop.push_back(point_of(target, place));
        for (const BandTriangle& triangle : min_area_band(rim, loop, context)) add(triangle);
        work_.seams.emplace_back();
        for (Index i = 0; i < count_of(loop); ++i) {
            const Index v = loop_vertex(i);
            work_.patch.move(v, loop[i]);
            work_.sources[v] = sources_of(work_, join_, join_.on_target[i], {i, 0.0});
            work_.seams.back().push_back(v);
        }
        // The seam begins at the start of the target's loop.
        const auto first = std::min_element(
            join_.on_target.begin(), join_.on_target.end(), [](const auto& a, const auto& b) {
                return a.segment != b.segment ? a.segment < b.segment : a.t < b.t;
            });
        std::rotate(work_.seams.back().begin(),
                    work_.seams.back().begin() + (first - join_.on_target.begin()),
                    work_.seams.back().end());
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        Elements elements{ElementKind::vertex, 0, {}};
        for (const Index v : join_.target) elements.add(v);
        throw Error(ErrorCode::boundary_conflict,
                    "the band of faces along a loop of the target " + what +
                        "; sew with a conforming seam, or refine the target",
                    elements);
    }

    // The loop that the band leaves, in the direction of the boundary before. Each of its edges has
    // a face of the band on its left and a face that stays on its right.
    void find_rim() {
        const Topology& topology = work_.both.topology();
        for (const Index f : band_) {
            for (const Index v : topology.face(f)) {
                if (work_.gone.contains(v)) fail("overlaps that of another join");
            }
        }
        std::map<Index, std::pair<Index, Index>> next;
        for (const Index f : band_) {
            const std::span<const Index> face = topology.face(f);
            for (std::size_t k = 0; k < face.size(); ++k) {
                const Index a = face[k], b = face[(k + 1) % face.size()];
                const Index beyond = work_.patch.faces().left_of(b, a);
                if (is_on_loop(a) || is_on_loop(b)) continue;
                if (beyond == kNoIndex) fail("reaches another open boundary");
                if (band_.contains(work_.patch.faces().faces()[beyond].origin)) continue;
                if (!next.emplace(b, std::pair(a, f)).second) fail("touches itself");
            }
        }
        if (next.empty()) fail("is all there is");
        Index v = next.begin()->first;
        do {
            rim_.push_back(v);
            const auto step = next.find(v);
            if (step == next.end() || rim_.size() > next.size()) fail("reaches another boundary");
            rim_face_.push_back(step->second.second);
            v = step->second.first;
        } while (v != rim_.front());
        if (rim_.size() != next.size() || rim_.size() < 3) fail("leaves more than one loop");
    }

    bool is_on_loop(Index v) const {
        return std::find(join_.target.begin(), join_.target.end(), v) != join_.target.end();
    }

    Index loop_vertex(Index i) const {
        return work_.first_source_vertex + join_.source[i % count_of(join_.source)];
    }

    // The face of the band along a segment of the target's old loop.
    Index loop_face(Index segment) const {
        const std::size_t next = (at(segment) + 1) % join_.target.size();
        for (const Index f : work_.both.topology().faces_around(join_.target[segment])) {
            const std::span<const Index> face = work_.both.topology().face(f);
            for (std::size_t k = 0; k < face.size(); ++k) {
                if (face[k] == join_.target[segment] &&
                    face[(k + 1) % face.size()] == join_.target[next]) {
                    return f;
                }
            }
        }
        return kNoIndex;
    }

    Index corner_at(Index f, Index v) const {
        const std::span<const Index> face = work_.both.topology().face(f);
        return work_.both.topology().first_corner(f) +
               index_of(std::find(face.begin(), face.end(), v) - face.begin());
    }

    SeamCorner rim_corner(Index i) const {
        const Index k = i % count_of(rim_);
        return {rim_[k], corner_at(rim_face_[k], rim_[k]), kNoIndex, 0.0};
    }

    SeamCorner loop_corner(Index i) const {
        const LoopPoint& place = join_.on_target[i % count_of(join_.source)];
        const Index face = loop_face(place.segment);
        const std::size_t next = (at(place.segment) + 1) % join_.target.size();
        SeamCorner corner{loop_vertex(i), corner_at(face, join_.target[place.segment]), kNoIndex,
                          0.0};
        if (place.t > 0.0) {
            corner.second = corner_at(face, join_.target[next]);
            corner.t = place.t;
        }
        return corner;
    }

    void add(const BandTriangle& triangle) {
        const Index apex = triangle.apex, edge = triangle.edge;
        if (triangle.of_first) {
            work_.patch.add(
                {{rim_corner(edge), loop_corner(apex), rim_corner(edge + 1)}, rim_face_[edge]});
        } else {
            work_.patch.add({{loop_corner(edge), loop_corner(edge + 1), rim_corner(apex)},
                             loop_face(join_.on_target[edge].segment)});
        }
        ++work_.report.band_added;
    }

    SeamWork& work_;
    const LoopPair& join_;
    std::set<Index> band_;
    // The loop that the band leaves, and the face of the band along each of its edges.
    std::vector<Index> rim_, rim_face_;
};

}  // namespace

void sew_band(SeamWork& work, const LoopPair& join, const Context& context) {
    BandSeam seam(work, join);
    seam.remove_band();
    seam.close_gap(context);
}

}  // namespace lissom
