#include "kernel/mesh/topology_check.h"

#include <algorithm>
#include <string>

#include "kernel/mesh/directed_edges.h"

namespace lissom {

void refuse(ErrorCode code, Elements elements, const std::string& what, const std::string& remedy) {
    const std::string names = describe(elements);
    throw Error(code, what + " " + names + "; " + remedy, std::move(elements));
}

namespace {

void check_each_face(Index vertex_count, const FaceList& faces) {
    Elements bad_index{ElementKind::face, 0, {}};
    Elements too_small{ElementKind::face, 0, {}};
    Elements repeated{ElementKind::face, 0, {}};
    std::vector<Index> last_face(vertex_count, kNoIndex);
    for (Index f = 0; f < faces.size(); ++f) {
        bool in_range = true, twice = false;
        for (const Index v : faces[f]) {
            if (v < 0 || v >= vertex_count) {
                in_range = false;
                continue;
            }
            twice = twice || last_face[v] == f;
            last_face[v] = f;
        }
        if (!in_range) bad_index.add(f);
        if (faces[f].size() < 3) too_small.add(f);
        if (twice) repeated.add(f);
    }
    if (bad_index.count > 0) {
        refuse(ErrorCode::face_index, std::move(bad_index),
               "vertices outside the " + std::to_string(vertex_count) + " of the mesh are used by",
               "correct the indices");
    }
    if (too_small.count > 0) {
        refuse(ErrorCode::face_too_small, std::move(too_small),
               "there are fewer than three vertices in", "remove entries that are no face");
    }
    if (repeated.count > 0) {
        refuse(ErrorCode::repeated_vertex, std::move(repeated), "a vertex is used twice by",
               "remove the repeated entries");
    }
}

struct EdgeDefects {
    Elements duplicates{ElementKind::face, 0, {}};
    Elements nonmanifold{ElementKind::edge, 0, {}};
    Elements inconsistent{ElementKind::edge, 0, {}};

    void refuse_any() {
        if (duplicates.count > 0) {
            refuse(ErrorCode::duplicate_face, std::move(duplicates),
                   "the vertices of an earlier face are repeated by", "remove the copies");
        }
        if (nonmanifold.count > 0) {
            refuse(ErrorCode::nonmanifold_edge, std::move(nonmanifold),
                   "more than two faces meet at", "split the edges or remove the extra faces");
        }
        if (inconsistent.count > 0) {
            refuse(ErrorCode::inconsistent_orientation, std::move(inconsistent),
                   "both faces run in the same direction along", "orient the faces consistently");
        }
    }
};

Index face_of_corner(const FaceList& faces, Index corner) {
    const auto after = std::upper_bound(faces.offsets.begin(), faces.offsets.end(), corner);
    return index_of(after - faces.offsets.begin()) - 1;
}

std::vector<Index> pair_edges(Index vertex_count, const FaceList& faces) {
    const DirectedEdges edges(vertex_count, faces);
    FaceCycles cycles(faces);
    std::vector<Index> twin(faces.vertices.size(), kNoIndex);
    std::vector<char> is_duplicate(faces.size(), 0);
    EdgeDefects defects;
    edges.for_each_edge([&](std::span<const Index> corners) {
        if (corners.size() == 1) return;
        if (corners.size() == 2 && edges.ascending(corners[0]) != edges.ascending(corners[1])) {
            twin[corners[0]] = corners[1];
            twin[corners[1]] = corners[0];
            return;
        }
        std::size_t distinct = corners.size();
        FaceCycles::Seen seen;
        for (const Index corner : corners) {
            const Index f = face_of_corner(faces, corner);
            if (!is_duplicate[f] && !cycles.is_copy(f, seen)) continue;
            if (!is_duplicate[f]) defects.duplicates.add(f);
            is_duplicate[f] = 1;
            --distinct;
        }
        if (distinct > 2) {
            defects.nonmanifold.add_edge(edges.low(corners[0]), edges.high(corners[0]));
        } else if (distinct == corners.size()) {
            defects.inconsistent.add_edge(edges.low(corners[0]), edges.high(corners[0]));
        }
    });
    defects.refuse_any();
    return twin;
}

// Refuses vertices whose corners do not form a single fan.
void check_fans(Index vertex_count, const FaceList& faces, const std::vector<Index>& twin) {
    std::vector<Index> corners_at(vertex_count, 0);
    std::vector<Index> previous(faces.vertices.size());
    std::vector<Index> start(vertex_count, kNoIndex);
    for (Index f = 0; f < faces.size(); ++f) {
        const Index first = faces.offsets[f], end = faces.offsets[f + 1];
        for (Index c = first; c < end; ++c) {
            const Index v = faces.vertices[c];
            previous[c] = c > first ? c - 1 : end - 1;
            ++corners_at[v];
            if (start[v] == kNoIndex || twin[c] == kNoIndex) start[v] = c;
        }
    }
    Elements split{ElementKind::vertex, 0, {}};
    for (Index v = 0; v < vertex_count; ++v) {
        if (start[v] == kNoIndex) continue;
        // Counter-clockwise: the next corner at v is the twin of the edge that enters v.
        Index count = 0;
        for (Index c = start[v]; c != kNoIndex; c = twin[previous[c]]) {
            ++count;
            if (count > corners_at[v]) break;
            if (twin[previous[c]] == start[v]) break;
        }
        if (count != corners_at[v]) split.add(v);
    }
    if (split.count > 0) {
        refuse(ErrorCode::nonmanifold_vertex, std::move(split),
               "separate fans of faces touch at nothing but", "give each fan a vertex of its own");
    }
}

}  // namespace

std::vector<Index> check_and_pair_edges(Index vertex_count, const FaceList& faces,
                                        const Context& context) {
    check_each_face(vertex_count, faces);
    context.checkpoint();
    std::vector<Index> twin = pair_edges(vertex_count, faces);
    context.checkpoint();
    check_fans(vertex_count, faces, twin);
    return twin;
}

}  // namespace lissom
