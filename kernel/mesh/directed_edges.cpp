#include "kernel/mesh/directed_edges.h"

namespace lissom {

DirectedEdges::DirectedEdges(Index vertex_count, const FaceList& faces)
    : begin_(at(vertex_count) + 1, 0),
      corner_(faces.vertices.size()),
      next_(faces.vertices.size()),
      vertices_(faces.vertices) {
    for (Index f = 0; f < faces.size(); ++f) {
        const Index first = faces.offsets[f], end = faces.offsets[f + 1];
        for (Index c = first; c < end; ++c) {
            next_[c] = vertices_[c + 1 < end ? c + 1 : first];
            ++begin_[std::min(vertices_[c], next_[c]) + 1];
        }
    }
    for (std::size_t v = 0; v + 1 < begin_.size(); ++v) begin_[v + 1] += begin_[v];
    std::vector<Index> fill(begin_.begin(), begin_.end() - 1);
    for (Index c = 0; c < count_of(next_); ++c) {
        corner_[fill[std::min(vertices_[c], next_[c])]++] = c;
    }
    std::vector<std::uint64_t> keys;
    for (Index v = 0; v < vertex_count; ++v) sort_by_high(begin_[v], begin_[v + 1], keys);
}

// By the higher vertex, then by the corner; both in one number are sorted fastest.
void DirectedEdges::sort_by_high(Index begin, Index end, std::vector<std::uint64_t>& keys) {
    if (end - begin < 2) return;
    keys.clear();
    for (Index i = begin; i < end; ++i) {
        const auto c = static_cast<std::uint32_t>(corner_[i]);
        keys.push_back(static_cast<std::uint64_t>(high(corner_[i])) << 32 | c);
    }
    std::sort(keys.begin(), keys.end());
    for (const std::uint64_t key : keys) {
        corner_[begin++] = index_of(key & 0xffffffffu);
    }
}

namespace {

// Returns the corner of the smallest vertex; faces are compared from there.
Index start_of(std::span<const Index> face) {
    return index_of(std::min_element(face.begin(), face.end()) - face.begin());
}

// The k-th vertex from `start` on, in the order of the face or against it.
Index vertex_at(std::span<const Index> face, Index start, Index k, bool backward) {
    const auto n = count_of(face);
    return face[backward ? (start + n - k) % n : (start + k) % n];
}

bool same_order(std::span<const Index> f, std::span<const Index> g, bool backward) {
    const Index at_f = start_of(f), at_g = start_of(g);
    for (Index k = 0; k < count_of(f); ++k) {
        if (vertex_at(f, at_f, k, false) != vertex_at(g, at_g, k, backward)) return false;
    }
    return true;
}

}  // namespace

std::uint64_t FaceCycles::key(Index f) {
    if (key_[f] != 0) return key_[f];
    const std::span<const Index> face = faces_[f];
    const Index start = start_of(face);
    const bool backward = vertex_at(face, start, 1, true) < vertex_at(face, start, 1, false);
    std::uint64_t hash = face.size();
    for (Index k = 0; k < count_of(face); ++k) {
        hash = (hash ^ static_cast<std::uint64_t>(vertex_at(face, start, k, backward))) *
               0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return key_[f] = hash | 1;
}

Likeness FaceCycles::compare(Index f, Index g) {
    if (faces_[f].size() != faces_[g].size() || key(f) != key(g)) return Likeness::none;
    if (same_order(faces_[f], faces_[g], false)) return Likeness::same;
    return same_order(faces_[f], faces_[g], true) ? Likeness::reversed : Likeness::none;
}

bool FaceCycles::is_copy(Index f, Seen& seen) {
    const auto [begin, end] = seen.equal_range(key(f));
    for (auto same_key = begin; same_key != end; ++same_key) {
        if (compare(f, same_key->second) == Likeness::same) return true;
    }
    seen.emplace(key(f), f);
    return false;
}

}  // namespace lissom
