#include "kernel/merge/paste/erase/patch_values.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "kernel/merge/loop/face_angles.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/morph_maps.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

// Differences of corner values that are none.
constexpr double kSameValue = 1e-9;

// The patch as a graph: its vertices, those of the rim first.
class PatchGraph {
  public:
    PatchGraph(const Mesh& mesh, Index first_vertex, Index first_face)
        : mesh_(mesh), first_face_(first_face) {
        for (Index f = first_face; f < mesh.face_count(); ++f) {
            for (const Index v : mesh.topology().face(f)) vertices_.push_back(v);
        }
        std::sort(vertices_.begin(), vertices_.end());
        vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
        const auto inner = std::lower_bound(vertices_.begin(), vertices_.end(), first_vertex);
        rim_count_ = index_of(inner - vertices_.begin());
        find_edges();
    }

    const std::vector<Index>& vertices() const { return vertices_; }
    Index rim_count() const { return rim_count_; }
    Index place_of(Index vertex) const {
        return index_of(std::lower_bound(vertices_.begin(), vertices_.end(), vertex) -
                        vertices_.begin());
    }
    const std::vector<std::pair<Index, Index>>& edges() const { return edges_; }
    /// The rim in order, by places.
    std::vector<Index> rim() const;

  private:
    void find_edges() {
        for (Index f = first_face_; f < mesh_.face_count(); ++f) {
            const std::span<const Index> face = mesh_.topology().face(f);
            for (std::size_t k = 0; k < face.size(); ++k) {
                edges_.push_back(
                    std::minmax(place_of(face[k]), place_of(face[(k + 1) % face.size()])));
            }
        }
        std::sort(edges_.begin(), edges_.end());
        edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    }

    const Mesh& mesh_;
    Index first_face_;
    Index rim_count_ = 0;
    std::vector<Index> vertices_;
    std::vector<std::pair<Index, Index>> edges_;
};

std::vector<Index> PatchGraph::rim() const {
    std::map<Index, Index> next;
    for (Index f = first_face_; f < mesh_.face_count(); ++f) {
        const std::span<const Index> face = mesh_.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            const Index other = face_left_of(mesh_.topology(), b, a);
            if (other != kNoIndex && other < first_face_) next[place_of(a)] = place_of(b);
        }
    }
    std::vector<Index> loop;
    if (next.empty()) return loop;
    for (Index p = next.begin()->first; loop.size() < next.size(); p = next.at(p)) {
        loop.push_back(p);
        if (!next.contains(next.at(p))) break;
    }
    return loop;
}

// Values at the places of a patch: nothing at a place without one.
using PatchRows = std::vector<std::optional<std::vector<double>>>;

void fill_harmonically(const PatchGraph& graph, Index width, PatchRows& values,
                       const Context& context) {
    std::vector<Index> unknown(values.size(), kNoIndex);
    Index count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!values[i]) unknown[i] = count++;
    }
    if (count == 0 || at(count) == values.size()) return;
    std::vector<Triplet> entries;
    std::vector<double> right(at(width) * at(count), 0.0);
    const auto add = [&](Index row, Index column) {
        const Index i = unknown[at(row)], j = unknown[at(column)];
        if (i == kNoIndex) return;
        entries.push_back({i, i, 1.0});
        if (j != kNoIndex) {
            if (j < i) entries.push_back({i, j, -1.0});
            return;
        }
        for (Index k = 0; k < width; ++k) right[at(k * count + i)] += (*values[at(column)])[at(k)];
    };
    for (const auto& [a, b] : graph.edges()) {
        add(a, b);
        add(b, a);
    }
    const SymmetricMatrix matrix = symmetric_from_triplets(count, entries);
    SparseSystem system;
    system.analyze(matrix, context);
    system.factor(matrix, context);
    system.solve(right, right, width);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (unknown[i] == kNoIndex) continue;
        values[i].emplace();
        for (Index k = 0; k < width; ++k) values[i]->push_back(right[at(k * count + unknown[i])]);
    }
}

bool has_values(std::span<const double> values) {
    return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

// The value that all corners around a rim vertex outside the patch agree on.
std::optional<std::vector<double>> agreed_value(const Mesh& mesh, const Attribute& attribute,
                                                Index vertex, Index first_face) {
    std::optional<std::vector<double>> found;
    for (const Index f : mesh.topology().faces_around(vertex)) {
        if (f >= first_face) continue;
        const std::span<const Index> face = mesh.topology().face(f);
        const auto k = index_of(std::find(face.begin(), face.end(), vertex) - face.begin());
        const auto value = attribute.at(mesh.topology().first_corner(f) + k);
        if (!has_values(value)) return std::nullopt;
        if (!found) {
            found.emplace(value.begin(), value.end());
            continue;
        }
        for (std::size_t i = 0; i < value.size(); ++i) {
            if (std::abs(value[i] - (*found)[i]) > kSameValue) return std::nullopt;
        }
    }
    return found;
}

// Keeps only the longest stretch of the rim that has values, if not all of it does.
void keep_longest_stretch(const std::vector<Index>& rim, PatchRows& values) {
    const std::size_t n = rim.size();
    std::size_t best = 0, length = 0;
    for (std::size_t start = 0; start < n; ++start) {
        std::size_t run = 0;
        while (run < n && values[at(rim[(start + run) % n])]) ++run;
        if (run > length) {
            length = run;
            best = start;
        }
    }
    if (length == n) return;
    for (std::size_t k = length; k < n; ++k) values[at(rim[(best + k) % n])].reset();
}

void continue_vertices(const PatchGraph& graph, Attribute& attribute, const Context& context) {
    PatchRows values(graph.vertices().size());
    for (Index i = 0; i < graph.rim_count(); ++i) {
        const auto value = std::as_const(attribute).at(graph.vertices()[at(i)]);
        if (has_values(value)) values[at(i)].emplace(value.begin(), value.end());
    }
    fill_harmonically(graph, attribute.width, values, context);
    for (std::size_t i = at(graph.rim_count()); i < values.size(); ++i) {
        if (values[i]) {
            std::copy(values[i]->begin(), values[i]->end(),
                      attribute.at(graph.vertices()[i]).begin());
        }
    }
}

void continue_corners(const Mesh& mesh, const PatchGraph& graph, Attribute& attribute,
                      Index first_face, const Context& context) {
    PatchRows values(graph.vertices().size());
    for (Index i = 0; i < graph.rim_count(); ++i) {
        values[at(i)] = agreed_value(mesh, attribute, graph.vertices()[at(i)], first_face);
    }
    keep_longest_stretch(graph.rim(), values);
    fill_harmonically(graph, attribute.width, values, context);
    for (Index f = first_face; f < mesh.face_count(); ++f) {
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const auto& value = values[at(graph.place_of(face[k]))];
            if (!value) continue;
            std::copy(value->begin(), value->end(),
                      attribute.at(mesh.topology().first_corner(f) + index_of(k)).begin());
        }
    }
}

// The face outside the patch that is nearest to each of its faces, or kNoIndex.
std::vector<Index> nearest_faces(const Mesh& mesh, Index first_face) {
    const Topology& topology = mesh.topology();
    std::vector<Index> nearest(at(mesh.face_count() - first_face), kNoIndex), queue;
    const auto beside = [&](Index f, const auto& visit) {
        const std::span<const Index> face = topology.face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index g = face_left_of(topology, face[(k + 1) % face.size()], face[k]);
            if (g != kNoIndex) visit(g);
        }
    };
    for (Index f = first_face; f < mesh.face_count(); ++f) {
        beside(f, [&](Index g) {
            if (g >= first_face || nearest[at(f - first_face)] != kNoIndex) return;
            nearest[at(f - first_face)] = g;
            queue.push_back(f);
        });
    }
    for (std::size_t i = 0; i < queue.size(); ++i) {
        beside(queue[i], [&](Index g) {
            if (g < first_face || nearest[at(g - first_face)] != kNoIndex) return;
            nearest[at(g - first_face)] = nearest[at(queue[i] - first_face)];
            queue.push_back(g);
        });
    }
    return nearest;
}

void continue_faces(Mesh& mesh, Index first_face) {
    const std::vector<Index> nearest = nearest_faces(mesh, first_face);
    for (Index f = first_face; f < mesh.face_count(); ++f) {
        const Index from = nearest[at(f - first_face)];
        if (from == kNoIndex) continue;
        for (auto& [kind, labels] : mesh.attributes().labels()) {
            labels.of_face[at(f)] = labels.of_face[at(from)];
        }
        for (Attribute& attribute : mesh.attributes().all()) {
            if (attribute.domain != Domain::face) continue;
            const auto value = std::as_const(attribute).at(from);
            std::copy(value.begin(), value.end(), attribute.at(f).begin());
        }
    }
}

void set_normals(const Mesh& mesh, Attribute& attribute, Index first_vertex, Index first_face) {
    const std::vector<Vec3> of_vertex = vertex_normals(mesh), of_face = face_normals(mesh);
    const auto set = [&](Index element, const Vec3& n) {
        for (int k = 0; k < 3; ++k) attribute.at(element)[static_cast<std::size_t>(k)] = n[k];
    };
    if (attribute.domain == Domain::vertex) {
        for (Index v = first_vertex; v < mesh.vertex_count(); ++v) set(v, of_vertex[at(v)]);
        return;
    }
    for (Index f = first_face; f < mesh.face_count(); ++f) {
        if (attribute.domain == Domain::face) set(f, of_face[at(f)]);
        if (attribute.domain != Domain::corner) continue;
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            set(mesh.topology().first_corner(f) + index_of(k), of_vertex[at(face[k])]);
        }
    }
}

}  // namespace

void continue_values(Mesh& mesh, Index first_vertex, Index first_face, const Context& context) {
    continue_faces(mesh, first_face);
    const PatchGraph graph(mesh, first_vertex, first_face);
    for (Attribute& attribute : mesh.attributes().all()) {
        const AttributeRole role = role_of(attribute);
        // The patch has displacements of morph targets: those that its own shape was made by.
        if (is_morph_position(attribute)) continue;
        if (role == AttributeRole::normal) {
            set_normals(mesh, attribute, first_vertex, first_face);
        } else if (attribute.domain == Domain::corner) {
            continue_corners(mesh, graph, attribute, first_face, context);
        } else if (attribute.domain == Domain::vertex && role != AttributeRole::joints &&
                   role != AttributeRole::weights) {
            continue_vertices(graph, attribute, context);
        }
    }
}

}  // namespace lissom
