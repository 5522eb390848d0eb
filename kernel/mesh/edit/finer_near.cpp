#include "kernel/mesh/edit/finer_near.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "kernel/mesh/edit/polygon_splitter.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// The face on the left of a directed edge, or kNoIndex.
Index face_left_of_edge(const Topology& topology, Index from, Index to) {
    for (const Index f : topology.faces_around(from)) {
        const std::span<const Index> face = topology.face(f);
        const auto k = std::find(face.begin(), face.end(), from) - face.begin();
        if (face[at(k + 1) % face.size()] == to) return f;
    }
    return kNoIndex;
}

double squared_distance_to_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
    const Vec3 along = b - a;
    const double square = along.squaredNorm();
    const double t = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
    return (a + t * along - p).squaredNorm();
}

double squared_distance_to_triangle(const std::array<Vec3, 3>& corners, const Vec3& p) {
    const auto& [a, b, c] = corners;
    const Vec3 n = (b - a).cross(c - a);
    const double square = n.squaredNorm();
    const auto inside = [&](const Vec3& from, const Vec3& to) {
        return (to - from).cross(p - from).dot(n) >= 0.0;
    };
    if (square > 0.0 && inside(a, b) && inside(b, c) && inside(c, a)) {
        const double height = n.dot(p - a);
        return height * height / square;
    }
    return std::min({squared_distance_to_segment(a, b, p), squared_distance_to_segment(b, c, p),
                     squared_distance_to_segment(c, a, p)});
}

bool touches(const std::array<Vec3, 3>& corners, const FinePlace& place) {
    return squared_distance_to_triangle(corners, place.point) <= place.radius * place.radius;
}

bool face_touches(const Mesh& mesh, Index f, const FinePlace& place) {
    const Index faces[] = {f};
    const Triangulation parts = triangulate_faces(mesh.topology(), mesh.positions(), faces);
    return std::any_of(parts.triangles.begin(), parts.triangles.end(), [&](const Triangle& t) {
        return touches({mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2])}, place);
    });
}

bool has_longer_edge(const Mesh& mesh, Index f, double length) {
    const std::span<const Index> face = mesh.topology().face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
        const Vec3 side = mesh.position(face[(k + 1) % face.size()]) - mesh.position(face[k]);
        if (side.squaredNorm() > length * length) return true;
    }
    return false;
}

using Key = std::uint64_t;

Key halved_key(Index a, Index b) {
    return static_cast<Key>(static_cast<std::uint32_t>(a)) << 32 | static_cast<std::uint32_t>(b);
}

// A triangle of a face: its vertices, and their weights of three corners of the face.
struct Part {
    Index face = kNoIndex;
    Triangle vertices{}, corners{};
    std::array<Vec3, 3> weights{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    bool alive = true;
};

// Bisects triangles; those of the mesh are taken in when an edge of theirs is halved.
class Bisection {
  public:
    explicit Bisection(const Mesh& mesh)
        : mesh_(mesh), positions_(mesh.positions().begin(), mesh.positions().end()) {
        for (Index v = 0; v < mesh.vertex_count(); ++v) map_.vertices.add_copy(v);
    }

    // Triangles in place of the polygons among the faces.
    void take_in(std::span<const Index> faces) {
        std::vector<Index> polygons;
        for (const Index f : faces) {
            const bool polygon = mesh_.topology().face(f).size() > 3;
            if (!polygon) {
                take_in_triangle(f);
            } else if (taken_.insert(f).second) {
                polygons.push_back(f);
            }
        }
        std::sort(polygons.begin(), polygons.end());
        const PolygonSplitter splitter(mesh_.topology(), mesh_.positions(), polygons);
        for (std::size_t n = 0; n < polygons.size(); ++n) {
            for (const Triangle& local : splitter.triangles(n)) add_part(polygons[n], local);
        }
    }

    void halve_edges_at(const FinePlace& place, std::span<const Index> faces,
                        const Context& context) {
        place_ = &place;
        near_.clear();
        for (const Index f : faces) near_.insert(f);
        for (const Index f : faces) {
            for (const Index part : parts_of_[f]) {
                if (parts_[at(part)].alive) queue_long_edges(part);
            }
        }
        while (!waiting_.empty()) {
            context.checkpoint();
            const auto [length, a, b] = waiting_.top();
            waiting_.pop();
            if (part_at(a, b) != kNoIndex || part_at(b, a) != kNoIndex) halve(a, b);
        }
    }

    FinerMesh made(const Context& context) {
        FaceList faces;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (taken_.contains(f)) {
                add_parts(f, faces);
            } else {
                add_polygon(f, faces);
            }
        }
        FinerMesh finer{derive(mesh_, std::move(positions_), std::move(faces), map_, context), {}};
        finer.map = std::move(map_);
        return finer;
    }

  private:
    // Length, then the vertices, the smaller one first.
    using Edge = std::tuple<double, Index, Index>;
    struct Shorter {
        bool operator()(const Edge& a, const Edge& b) const {
            if (std::get<0>(a) != std::get<0>(b)) return std::get<0>(a) < std::get<0>(b);
            return std::tie(std::get<1>(a), std::get<2>(a)) >
                   std::tie(std::get<1>(b), std::get<2>(b));
        }
    };

    Edge edge(Index a, Index b) const {
        return {(positions_[at(a)] - positions_[at(b)]).squaredNorm(), std::min(a, b),
                std::max(a, b)};
    }

    void take_in_triangle(Index f) {
        if (taken_.insert(f).second) add_part(f, {0, 1, 2});
    }

    void add_part(Index f, const Triangle& local) {
        const std::span<const Index> face = mesh_.topology().face(f);
        Part part;
        part.face = f;
        for (std::size_t k = 0; k < 3; ++k) {
            part.vertices[k] = face[at(local[k])];
            part.corners[k] = mesh_.topology().first_corner(f) + local[k];
        }
        register_part(std::move(part));
    }

    Index register_part(Part part) {
        const Index number = count_of(parts_);
        for (std::size_t k = 0; k < 3; ++k) {
            part_at_[halved_key(part.vertices[k], part.vertices[(k + 1) % 3])] = number;
        }
        parts_of_[part.face].push_back(number);
        parts_.push_back(std::move(part));
        return number;
    }

    // The triangle on the left of an edge. Nothing on the left of an open one, and of one that
    // belongs to a polygon that stays.
    Index part_at(Index a, Index b) {
        const auto found = part_at_.find(halved_key(a, b));
        if (found != part_at_.end()) return found->second;
        const Index old = mesh_.vertex_count();
        if (a >= old || b >= old) return kNoIndex;
        const Index f = face_left_of_edge(mesh_.topology(), a, b);
        if (f == kNoIndex || taken_.contains(f) || mesh_.topology().face(f).size() > 3) {
            return kNoIndex;
        }
        take_in_triangle(f);
        return part_at_.at(halved_key(a, b));
    }

    Edge longest_edge(Index part) const {
        const Triangle& v = parts_[at(part)].vertices;
        return std::max({edge(v[0], v[1]), edge(v[1], v[2]), edge(v[2], v[0])}, Shorter{});
    }

    void queue_long_edges(Index part) {
        const Part& of = parts_[at(part)];
        if (!near_.contains(of.face)) return;
        const Triangle& v = of.vertices;
        if (!touches({positions_[at(v[0])], positions_[at(v[1])], positions_[at(v[2])]}, *place_)) {
            return;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Edge side = edge(v[k], v[(k + 1) % 3]);
            if (std::get<0>(side) > place_->length * place_->length) waiting_.push(side);
        }
    }

    // Halves an edge, after any longer ones in the adjacent triangles.
    void halve(Index a, Index b) {
        std::vector<Edge> edges{edge(a, b)};
        while (!edges.empty()) {
            const auto [length, from, to] = edges.back();
            const Index left = part_at(from, to), right = part_at(to, from);
            if (left == kNoIndex && right == kNoIndex) {
                edges.pop_back();
                continue;
            }
            std::optional<Edge> longer;
            for (const Index part : {left, right}) {
                if (part == kNoIndex || longer) continue;
                const Edge longest = longest_edge(part);
                if (Shorter{}(edges.back(), longest)) longer = longest;
            }
            if (longer) {
                edges.push_back(*longer);
                continue;
            }
            edges.pop_back();
            bisect(from, to, left, right);
        }
    }

    void bisect(Index a, Index b, Index left, Index right) {
        const Index middle = count_of(positions_);
        positions_.push_back(0.5 * (positions_[at(a)] + positions_[at(b)]));
        add_mean_vertex(a, b);
        middle_[halved_key(std::min(a, b), std::max(a, b))] = middle;
        for (const auto& [part, from, to] : {std::tuple(left, a, b), std::tuple(right, b, a)}) {
            if (part != kNoIndex) bisect_part(part, from, to, middle);
        }
    }

    void add_mean_vertex(Index a, Index b) {
        std::vector<ElementMap::Source> sources;
        for (const Index v : {a, b}) {
            for (const ElementMap::Source& source : map_.vertices[v]) {
                const auto same = std::find_if(sources.begin(), sources.end(), [&](const auto& s) {
                    return s.element == source.element;
                });
                if (same == sources.end()) {
                    sources.push_back({source.element, 0.5 * source.weight});
                } else {
                    same->weight += 0.5 * source.weight;
                }
            }
        }
        map_.vertices.add_blend(sources);
    }

    void bisect_part(Index number, Index from, Index to, Index middle) {
        Part& part = parts_[at(number)];
        part.alive = false;
        for (std::size_t k = 0; k < 3; ++k) {
            part_at_.erase(halved_key(part.vertices[k], part.vertices[(k + 1) % 3]));
        }
        const std::size_t k = index_in(part.vertices, from), next = index_in(part.vertices, to);
        const Vec3 weights = 0.5 * (part.weights[k] + part.weights[next]);
        Part first = part, second = part;
        first.alive = second.alive = true;
        first.vertices[next] = second.vertices[k] = middle;
        first.weights[next] = second.weights[k] = weights;
        for (Part& half : {std::ref(first), std::ref(second)}) {
            queue_long_edges(register_part(std::move(half)));
        }
    }

    static std::size_t index_in(const Triangle& vertices, Index v) {
        return static_cast<std::size_t>(std::find(vertices.begin(), vertices.end(), v) -
                                        vertices.begin());
    }

    void add_parts(Index f, FaceList& faces) {
        for (const Index number : parts_of_.at(f)) {
            const Part& part = parts_[at(number)];
            if (!part.alive) continue;
            faces.add(part.vertices);
            map_.faces.add_copy(f);
            for (const Vec3& weights : part.weights) add_corner(part.corners, weights);
        }
    }

    void add_corner(const Triangle& corners, const Vec3& weights) {
        std::vector<ElementMap::Source> sources;
        for (int k = 0; k < 3; ++k) {
            if (weights[k] > 0.0) sources.push_back({corners[at(k)], weights[k]});
        }
        map_.corners.add_blend(sources);
    }

    // A face that stays takes in the vertices on its edges.
    void add_polygon(Index f, FaceList& faces) {
        const std::span<const Index> face = mesh_.topology().face(f);
        const Index first = mesh_.topology().first_corner(f), n = count_of(face);
        std::vector<Index> vertices;
        for (Index k = 0; k < n; ++k) {
            const Index c = first + k, d = first + (k + 1) % n;
            vertices.push_back(face[at(k)]);
            map_.corners.add_copy(c);
            add_vertices_between(face[at(k)], face[at((k + 1) % n)], {c, d}, {1.0, 0.0}, vertices);
        }
        faces.add(vertices);
        map_.faces.add_copy(f);
    }

    // `shares` are the parts of the first corner at both ends.
    void add_vertices_between(Index a, Index b, const std::array<Index, 2>& corners,
                              const std::array<double, 2>& shares, std::vector<Index>& vertices) {
        const auto found = middle_.find(halved_key(std::min(a, b), std::max(a, b)));
        if (found == middle_.end()) return;
        const double share = 0.5 * (shares[0] + shares[1]);
        add_vertices_between(a, found->second, corners, {shares[0], share}, vertices);
        vertices.push_back(found->second);
        map_.corners.add_blend(std::array{ElementMap::Source{corners[0], share},
                                          ElementMap::Source{corners[1], 1.0 - share}});
        add_vertices_between(found->second, b, corners, {share, shares[1]}, vertices);
    }

    const Mesh& mesh_;
    std::vector<Vec3> positions_;
    MeshMap map_;
    std::vector<Part> parts_;
    std::unordered_map<Index, std::vector<Index>> parts_of_;
    std::unordered_map<Key, Index> part_at_, middle_;
    std::unordered_set<Index> taken_, near_;
    std::priority_queue<Edge, std::vector<Edge>, Shorter> waiting_;
    const FinePlace* place_ = nullptr;
};

}  // namespace

std::vector<Index> faces_touching(const Mesh& mesh, const FinePlace& place) {
    const Topology& topology = mesh.topology();
    std::unordered_set<Index> seen{place.face};
    std::vector<Index> reached{place.face};
    for (std::size_t i = 0; i < reached.size(); ++i) {
        const std::span<const Index> face = topology.face(reached[i]);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index f = face_left_of_edge(topology, face[(k + 1) % face.size()], face[k]);
            if (f == kNoIndex || !seen.insert(f).second) continue;
            if (face_touches(mesh, f, place)) reached.push_back(f);
        }
    }
    return reached;
}

std::optional<FinerMesh> finer_near(const Mesh& mesh, std::span<const FinePlace> places,
                                    const Context& context) {
    std::vector<std::vector<Index>> faces;
    std::vector<const FinePlace*> coarse;
    for (const FinePlace& place : places) {
        context.checkpoint();
        std::vector<Index> near = faces_touching(mesh, place);
        if (std::none_of(near.begin(), near.end(),
                         [&](Index f) { return has_longer_edge(mesh, f, place.coarse); })) {
            continue;
        }
        faces.push_back(std::move(near));
        coarse.push_back(&place);
    }
    if (coarse.empty()) return std::nullopt;
    Bisection bisection(mesh);
    // All polygons at once: their diagonals are chosen together.
    std::vector<Index> all;
    for (const std::vector<Index>& near : faces) all.insert(all.end(), near.begin(), near.end());
    bisection.take_in(all);
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        bisection.halve_edges_at(*coarse[i], faces[i], context);
    }
    return bisection.made(context);
}

}  // namespace lissom
