#include "kernel/mesh/repair/face_cleaning.h"

#include <utility>

#include "kernel/mesh/directed_edges.h"

namespace lissom {
namespace {

// Splits one face into simple ones: walks along it and closes a loop each time a vertex comes
// again.
class FaceSplitter {
  public:
    explicit FaceSplitter(Index vertex_count) : depth_of_vertex_(vertex_count, kNoIndex) {}

    bool repeats = false, pinched = false;
    /// The simple faces, as lists of corners.
    std::vector<std::vector<Index>> loops;

    void split(const CornerFaces& work, Index f) {
        repeats = pinched = false;
        loops.clear();
        walk_.clear();
        const std::vector<Index>& vertices = work.faces.vertices;
        for (Index c = work.faces.offsets[f]; c < work.faces.offsets[f + 1]; ++c) {
            const Index depth = depth_of_vertex_[vertices[c]];
            if (depth != kNoIndex) close_loop(vertices, depth);
            depth_of_vertex_[vertices[c]] = count_of(walk_);
            walk_.push_back(c);
        }
        for (const Index c : walk_) depth_of_vertex_[vertices[c]] = kNoIndex;
        if (walk_.size() > 2) loops.insert(loops.begin(), walk_);
        // A walk of one or two corners beside loops is a repeat across the face's end.
        if (walk_.size() < 3 && !loops.empty()) repeats = true;
        pinched = loops.size() > 1;
    }

  private:
    // The walk since `depth` is a loop; its vertices may come again, all but the first.
    void close_loop(const std::vector<Index>& vertices, Index depth) {
        const std::vector<Index> loop(walk_.begin() + depth, walk_.end());
        for (const Index c : loop) depth_of_vertex_[vertices[c]] = kNoIndex;
        walk_.resize(depth);
        if (loop.size() > 2) {
            loops.push_back(loop);
        } else {
            repeats = true;
        }
    }

    std::vector<Index> depth_of_vertex_, walk_;
};

bool is_simple(const CornerFaces& work, Index f, std::vector<Index>& last_face) {
    const std::span<const Index> face = work.faces[f];
    bool simple = face.size() > 2;
    for (const Index v : face) {
        simple = simple && last_face[v] != f;
        last_face[v] = f;
    }
    return simple;
}

Finding about_faces(FindingKind kind, std::vector<Index> faces) {
    const std::size_t count = faces.size();
    return {kind, ElementKind::face, true, count, std::move(faces), {}};
}

void add_if_any(Report& report, FindingKind kind, std::vector<Index> faces) {
    if (!faces.empty()) report.add(about_faces(kind, std::move(faces)));
}

Index largest_vertex(const FaceList& faces) {
    const auto largest = std::max_element(faces.vertices.begin(), faces.vertices.end());
    return largest == faces.vertices.end() ? kNoIndex : *largest;
}

std::vector<Index> corners_of(const CornerFaces& work, Index f) {
    std::vector<Index> corners;
    for (Index c = work.faces.offsets[f]; c < work.faces.offsets[f + 1]; ++c) corners.push_back(c);
    return corners;
}

}  // namespace

void clean_faces(CornerFaces& work, Report& report) {
    const Index vertex_count = largest_vertex(work.faces) + 1;
    std::vector<Index> last_face(vertex_count, kNoIndex), unclean;
    for (Index f = 0; f < work.faces.size(); ++f) {
        if (!is_simple(work, f, last_face)) unclean.push_back(f);
    }
    if (unclean.empty()) return;

    CornerFaces clean;
    FaceSplitter splitter(vertex_count);
    std::vector<Index> repeated, pinched, collapsed;
    auto next_unclean = unclean.begin();
    for (Index f = 0; f < work.faces.size(); ++f) {
        if (next_unclean == unclean.end() || *next_unclean != f) {
            clean.add(work, f, corners_of(work, f));
            continue;
        }
        ++next_unclean;
        splitter.split(work, f);
        for (const std::vector<Index>& loop : splitter.loops) clean.add(work, f, loop);
        if (splitter.loops.empty()) {
            collapsed.push_back(f);
        } else if (splitter.pinched) {
            pinched.push_back(f);
        } else {
            repeated.push_back(f);
        }
    }
    work = std::move(clean);
    add_if_any(report, FindingKind::corners_repeated, std::move(repeated));
    add_if_any(report, FindingKind::faces_collapsed, std::move(collapsed));
    add_if_any(report, FindingKind::faces_pinched, std::move(pinched));
}

namespace {

// Finds the faces that are there too often.
class DuplicateSearch {
  public:
    DuplicateSearch(Index vertex_count, const CornerFaces& work)
        : edges_(vertex_count, work.faces),
          cycles_(work.faces),
          faces_(work.faces),
          face_of_corner_(work.face_of_corner),
          at_edge_(work.faces.vertices.size()),
          drop_(work.faces.size(), 0) {
        edges_.for_each_edge([&](std::span<const Index> corners) {
            for (const Index c : corners) at_edge_[c] = corners;
        });
    }

    // One flag a face.
    std::vector<char> run() {
        edges_.for_each_edge([&](std::span<const Index> corners) { drop_flap(corners); });
        edges_.for_each_edge([&](std::span<const Index> corners) { drop_copies(corners); });
        edges_.for_each_edge([&](std::span<const Index> corners) { drop_reversed(corners); });
        return std::move(drop_);
    }

  private:
    // Two equal faces that are each other's only neighbours enclose nothing. If they hang on a
    // surface that is complete without them, both go.
    void drop_flap(std::span<const Index> corners) {
        if (corners.size() != 2) return;
        const Index f = face_of_corner_[corners[0]], g = face_of_corner_[corners[1]];
        if (f == g || drop_[f] || cycles_.compare(f, g) == Likeness::none) return;
        bool hangs = false;
        for (Index c = faces_.offsets[f]; c < faces_.offsets[f + 1]; ++c) {
            const std::span<const Index> here = at_edge_[c];
            if (here.size() == 2) continue;
            if (here.size() != 4 || !complete_without(here, f, g)) return;
            hangs = true;
        }
        if (hangs) drop_[f] = drop_[g] = 1;
    }

    bool complete_without(std::span<const Index> corners, Index f, Index g) {
        std::vector<Index> others;
        for (const Index c : corners) {
            if (face_of_corner_[c] != f && face_of_corner_[c] != g)
                others.push_back(face_of_corner_[c]);
        }
        return others.size() == 2 && cycles_.compare(others[0], others[1]) == Likeness::none;
    }

    void drop_copies(std::span<const Index> corners) {
        const bool regular =
            corners.size() == 2 && edges_.ascending(corners[0]) != edges_.ascending(corners[1]);
        if (corners.size() == 1 || regular) return;
        FaceCycles::Seen seen;
        for (const Index c : corners) {
            const Index f = face_of_corner_[c];
            if (!drop_[f] && cycles_.is_copy(f, seen)) drop_[f] = 1;
        }
    }

    // A face that is there once more in reverse, with a neighbour at every edge beside the two.
    void drop_reversed(std::span<const Index> corners) {
        if (corners.size() != 3) return;
        for (int i = 0; i < 3; ++i) {
            const Index f = face_of_corner_[corners[i]], g = face_of_corner_[corners[(i + 1) % 3]];
            if (drop_[f] || drop_[g] || cycles_.compare(f, g) != Likeness::reversed) continue;
            bool surplus = true;
            for (Index c = faces_.offsets[f]; c < faces_.offsets[f + 1]; ++c)
                surplus = surplus && at_edge_[c].size() == 3;
            if (surplus) drop_[std::max(f, g)] = 1;
        }
    }

    DirectedEdges edges_;
    FaceCycles cycles_;
    const FaceList& faces_;
    const std::vector<Index>& face_of_corner_;
    // The corners along the edge of each corner.
    std::vector<std::span<const Index>> at_edge_;
    std::vector<char> drop_;
};

}  // namespace

void drop_duplicates(Index vertex_count, CornerFaces& work, Report& report) {
    const std::vector<char> drop = DuplicateSearch(vertex_count, work).run();
    std::vector<Index> dropped;
    CornerFaces kept;
    for (Index f = 0; f < work.faces.size(); ++f) {
        if (drop[f]) {
            dropped.push_back(work.face_source[f]);
        } else {
            kept.add(work, f, corners_of(work, f));
        }
    }
    if (dropped.empty()) return;
    add_if_any(report, FindingKind::faces_duplicate, std::move(dropped));
    work = std::move(kept);
}

}  // namespace lissom
