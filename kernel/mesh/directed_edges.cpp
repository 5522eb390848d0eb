#include "kernel/mesh/directed_edges.h"

namespace lissom {

DirectedEdges::DirectedEdges(Index vertex_count, const FaceList& faces)
    : begin_(static_cast<std::size_t>(vertex_count) + 1, 0),
      corner_(faces.vertices.size()),
      next_(faces.vertices.size()),
      face_(faces.vertices.size()),
      vertices_(faces.vertices) {
    for (Index f = 0; f < faces.size(); ++f) {
        const Index first = faces.offsets[f], end = faces.offsets[f + 1];
        for (Index c = first; c < end; ++c) {
            next_[c] = vertices_[c + 1 < end ? c + 1 : first];
            face_[c] = f;
            ++begin_[std::min(vertices_[c], next_[c]) + 1];
        }
    }
    for (std::size_t v = 0; v + 1 < begin_.size(); ++v) begin_[v + 1] += begin_[v];
    std::vector<Index> fill(begin_.begin(), begin_.end() - 1);
    for (Index c = 0; c < static_cast<Index>(next_.size()); ++c) {
        corner_[fill[std::min(vertices_[c], next_[c])]++] = c;
    }
    for (Index v = 0; v < vertex_count; ++v) {
        std::sort(corner_.begin() + begin_[v], corner_.begin() + begin_[v + 1],
                  [&](Index a, Index b) {
                      const Index high_a = high(a), high_b = high(b);
                      return high_a != high_b ? high_a < high_b : a < b;
                  });
    }
}

Index FaceCycles::first(Index f) const {
    const std::span<const Index> face = faces_[f];
    return static_cast<Index>(std::min_element(face.begin(), face.end()) - face.begin());
}

std::uint64_t FaceCycles::key(Index f) {
    if (key_[f] != 0) return key_[f];
    const std::span<const Index> face = faces_[f];
    const auto start = static_cast<std::size_t>(first(f));
    std::uint64_t hash = face.size();
    for (std::size_t k = 0; k < face.size(); ++k) {
        hash = (hash ^ static_cast<std::uint64_t>(face[(start + k) % face.size()])) *
               0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return key_[f] = hash | 1;
}

bool FaceCycles::is_copy(Index f, Seen& seen) {
    const auto [begin, end] = seen.equal_range(key(f));
    for (auto same_key = begin; same_key != end; ++same_key) {
        if (equal(f, same_key->second)) return true;
    }
    seen.emplace(key(f), f);
    return false;
}

bool FaceCycles::equal(Index f, Index g) {
    if (faces_[f].size() != faces_[g].size()) return false;
    const auto n = static_cast<Index>(faces_[f].size());
    const Index at_f = first(f), at_g = first(g);
    for (Index k = 0; k < n; ++k) {
        if (faces_[f][(at_f + k) % n] != faces_[g][(at_g + k) % n]) return false;
    }
    return true;
}

}  // namespace lissom
