#include "kernel/merge/piece/put_back.h"

#include <algorithm>
#include <utility>

#include "kernel/merge/piece/face_set.h"
#include "kernel/merge/piece/spliced.h"
#include "kernel/mesh/edit/joined_content.h"
#include "kernel/mesh/query/box_tree.h"

namespace lissom {
namespace {

// Steps at a seam read elements this many rings beside those that they change.
constexpr Index kUntouchedRings = 3;

Box box_of(const Mesh& mesh, Index face) {
    Box box;
    for (const Index v : mesh.topology().face(face)) box.extend(mesh.position(v));
    return box;
}

bool overlap(const Box& a, const Box& b) {
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

void add_rings(FaceSet& set, std::span<const Index> faces, Index rings) {
    const Topology& topology = set.topology();
    std::vector<Index> front(faces.begin(), faces.end());
    for (Index ring = 0; ring < rings; ++ring) {
        std::vector<Index> next;
        for (const Index f : front) {
            for (const Index v : topology.face(f)) {
                for (const Index g : topology.faces_around(v)) {
                    if (set.contains(g)) continue;
                    set.add(g);
                    next.push_back(g);
                }
            }
        }
        front = std::move(next);
    }
}

// Adds faces that work around the given ones may run into.
void add_near_in_space(const Mesh& mesh, std::span<const Index> faces, FaceSet& set) {
    std::vector<Box> boxes;
    for (const Index f : faces) {
        const Box box = box_of(mesh, f);
        const Vec3 margin = Vec3::Constant(0.5 * box.diagonal());
        boxes.push_back({box.min - margin, box.max + margin});
    }
    const BoxTree tree(boxes);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (set.contains(f)) continue;
        const Box box = box_of(mesh, f);
        bool near = false;
        tree.visit([&](const Box& other) { return !near && overlap(box, other); },
                   [&](Index item) { near = near || overlap(box, boxes[at(item)]); });
        if (near) set.add(f);
    }
}

// The vertices at which the piece was taken out, and those within some rings of them.
std::vector<char> near_rim(const Mesh& whole, const MeshPart& piece) {
    const Topology& topology = piece.mesh.topology();
    std::vector<char> near(at(piece.mesh.vertex_count()), 0);
    std::vector<Index> front;
    const auto reach = [&](Index v) {
        if (near[at(v)]) return;
        near[at(v)] = 1;
        front.push_back(v);
    };
    for (Index v = 0; v < piece.mesh.vertex_count(); ++v) {
        const auto all = whole.topology().faces_around(piece.vertex_map[at(v)]);
        if (topology.faces_around(v).size() < all.size()) reach(v);
    }
    for (Index ring = 0; ring < kUntouchedRings; ++ring) {
        const std::vector<Index> last = std::exchange(front, {});
        for (const Index v : last) {
            for (const Index n : topology.neighbors(v)) reach(n);
        }
    }
    return near;
}

// The element of the work in the place of each of the piece; kNoIndex if there is none or more than
// one.
std::vector<Index> only_in_place(std::span<const Index> place, Index count) {
    std::vector<Index> found(at(count), kNoIndex);
    std::vector<char> taken(at(count), 0);
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] == kNoIndex) continue;
        found[at(place[i])] = taken[at(place[i])] ? kNoIndex : index_of(i);
        taken[at(place[i])] = 1;
    }
    return found;
}

// The order of elements that put_back describes. `in_piece` tells for each of the whole its number
// in the piece, or kNoIndex.
std::vector<Index> order_of(std::span<const Index> in_piece, Index end,
                            std::span<const Index> place, Index first_source) {
    // In the order of the places, which is that of the work but for elements without a place.
    std::vector<std::pair<Index, Index>> placed;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] != kNoIndex) placed.emplace_back(place[i], index_of(i));
    }
    std::stable_sort(placed.begin(), placed.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto whole = count_of(in_piece);
    std::vector<Index> order;
    order.reserve(in_piece.size() + place.size());
    const auto add_unplaced = [&](Index from, Index to) {
        for (Index i = from; i < to; ++i) {
            if (place[at(i)] == kNoIndex) order.push_back(whole + i);
        }
    };
    auto next = placed.begin();
    for (Index element = 0; element <= whole; ++element) {
        if (element == end) add_unplaced(0, first_source);
        if (element == whole) break;
        const Index piece = in_piece[at(element)];
        if (piece == kNoIndex) {
            order.push_back(element);
            continue;
        }
        for (; next != placed.end() && next->first == piece; ++next) {
            order.push_back(whole + next->second);
        }
    }
    add_unplaced(first_source, count_of(place));
    return order;
}

std::vector<Index> inverse(std::span<const Index> part_to_whole, Index whole) {
    std::vector<Index> place(at(whole), kNoIndex);
    for (std::size_t i = 0; i < part_to_whole.size(); ++i) {
        place[at(part_to_whole[i])] = index_of(i);
    }
    return place;
}

}  // namespace

Mesh unconnected(const Mesh& target, const Mesh& source, const Context& context) {
    Mesh both = target, other = source;
    split_charts(both);
    split_charts(other);
    append_with(both, other, AbsentValues::none, context);
    return both;
}

std::optional<MeshPart> piece_around(const Mesh& mesh, std::span<const Index> faces, Index rings,
                                     const Context& context) {
    FaceSet set(mesh.topology(), faces);
    add_rings(set, faces, rings);
    if (2 * set.size() > mesh.face_count()) return std::nullopt;
    add_near_in_space(mesh, set.faces(), set);
    set.grow_at_bow_ties(nullptr);
    if (2 * set.size() > mesh.face_count()) return std::nullopt;
    return extract_faces(mesh, set.faces(), context);
}

bool keeps_rim(const Mesh& whole, const MeshPart& piece, const PieceWork& work) {
    const std::vector<char> near = near_rim(whole, piece);
    const std::vector<Index> vertex = only_in_place(work.place.vertices, piece.mesh.vertex_count());
    const std::vector<Index> face = only_in_place(work.place.faces, piece.mesh.face_count());
    const auto stays = [&](Index v) {
        const Index now = vertex[at(v)];
        return now != kNoIndex && work.mesh.position(now) == piece.mesh.position(v);
    };
    for (Index f = 0; f < piece.mesh.face_count(); ++f) {
        const std::span<const Index> old = piece.mesh.topology().face(f);
        if (std::none_of(old.begin(), old.end(), [&](Index v) { return near[at(v)] != 0; })) {
            continue;
        }
        if (face[at(f)] == kNoIndex) return false;
        const std::span<const Index> now = work.mesh.topology().face(face[at(f)]);
        if (now.size() != old.size()) return false;
        for (std::size_t k = 0; k < old.size(); ++k) {
            if (work.place.vertices[at(now[k])] != old[k]) return false;
            if (near[at(old[k])] && !stays(old[k])) return false;
        }
    }
    return true;
}

std::vector<Index> PutBack::numbers_of_work(Index whole_count, Index work_count) const {
    std::vector<Index> number(at(work_count), kNoIndex);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (vertices[i] >= whole_count) number[at(vertices[i] - whole_count)] = index_of(i);
    }
    return number;
}

PutBack put_back(const Mesh& whole, const TargetCounts& target, const MeshPart& piece,
                 const PieceWork& work, const Context& context) {
    PutBack result;
    const Index vertices = whole.vertex_count(), faces = whole.face_count();
    result.vertices = order_of(inverse(piece.vertex_map, vertices), target.vertices,
                               work.place.vertices, work.first_source_vertex);
    result.faces = order_of(inverse(piece.face_map, faces), target.faces, work.place.faces,
                            work.first_source_face);
    std::vector<Index> number(at(vertices + work.mesh.vertex_count()), kNoIndex);
    for (std::size_t i = 0; i < result.vertices.size(); ++i) {
        number[at(result.vertices[i])] = index_of(i);
    }
    // Vertices of the piece are those of the work.
    for (std::size_t i = 0; i < work.place.vertices.size(); ++i) {
        const Index place = work.place.vertices[i];
        if (place != kNoIndex) {
            number[at(piece.vertex_map[at(place)])] = number[at(vertices + index_of(i))];
        }
    }
    result.mesh =
        spliced(whole, work.mesh, {result.vertices, result.faces, std::move(number)}, context);
    result.first_source_vertex =
        index_of(std::find_if(result.vertices.begin(), result.vertices.end(),
                              [&](Index v) {
                                  return v < vertices ? v >= target.vertices
                                                      : v - vertices >= work.first_source_vertex;
                              }) -
                 result.vertices.begin());
    return result;
}

MeshMap put_back_map(const PutBack& made, const Topology& whole, const MeshMap* whole_map,
                     const Mesh& work, const MeshMap& work_map) {
    MeshMap map;
    map.vertices.reserve(count_of(made.vertices));
    map.faces.reserve(count_of(made.faces));
    map.corners.reserve(made.mesh.topology().corner_count());
    const auto add = [](ElementMap& to, const ElementMap* of_whole, Index element) {
        if (of_whole) {
            to.add_blend((*of_whole)[element]);
        } else {
            to.add_copy(element);
        }
    };
    for (const Index v : made.vertices) {
        if (v < whole.vertex_count()) {
            add(map.vertices, whole_map ? &whole_map->vertices : nullptr, v);
        } else {
            map.vertices.add_blend(work_map.vertices[v - whole.vertex_count()]);
        }
    }
    for (const Index f : made.faces) {
        const bool of_whole = f < whole.face_count();
        const Index g = of_whole ? f : f - whole.face_count();
        const Topology& topology = of_whole ? whole : work.topology();
        for (Index c = topology.first_corner(g); c < topology.first_corner(g + 1); ++c) {
            if (of_whole) {
                add(map.corners, whole_map ? &whole_map->corners : nullptr, c);
            } else {
                map.corners.add_blend(work_map.corners[c]);
            }
        }
        if (of_whole) {
            add(map.faces, whole_map ? &whole_map->faces : nullptr, g);
        } else {
            map.faces.add_blend(work_map.faces[g]);
        }
    }
    return map;
}

}  // namespace lissom
