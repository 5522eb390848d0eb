#include "kernel/mesh/shapes/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "kernel/mesh/shapes/shape_checks.h"

namespace lissom {
namespace {

using Lattice = std::array<Index, 3>;

void set_region(Mesh& mesh, const char* name, std::vector<Index> vertices) {
    mesh.set_region(name, Region(mesh.shared_topology(), std::move(vertices)));
}

// The surface of a block of nx * ny * nz cells as quads; each vertex has whole coordinates.
class LatticeBox {
  public:
    explicit LatticeBox(const Lattice& segments) : n_(segments) {
        for (int axis = 0; axis < 3; ++axis) {
            add_side(axis, 0);
            add_side(axis, n_[axis]);
        }
    }

    // Maps each vertex by position(coordinates scaled to [-1, 1]).
    template <typename Position>
    Mesh mesh(const Position& position, const Context& context) const {
        std::vector<Vec3> positions;
        positions.reserve(vertices_.size());
        for (const Lattice& v : vertices_) {
            positions.push_back(position(Vec3(scaled(v, 0), scaled(v, 1), scaled(v, 2))));
        }
        return {std::move(positions), faces_, context};
    }

    std::vector<Index> side(int axis, bool far) const {
        std::vector<Index> result;
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            if (vertices_[i][axis] == (far ? n_[axis] : 0)) result.push_back(index_of(i));
        }
        return result;
    }

  private:
    double scaled(const Lattice& v, int axis) const {
        return static_cast<double>(2 * std::int64_t{v[axis]} - n_[axis]) / n_[axis];
    }

    Index vertex(const Lattice& v) {
        const auto nx = static_cast<std::uint64_t>(n_[0]) + 1,
                   ny = static_cast<std::uint64_t>(n_[1]) + 1;
        const std::uint64_t key = v[0] + nx * (v[1] + ny * v[2]);
        const auto [found, added] = ids_.try_emplace(key, count_of(vertices_));
        if (added) vertices_.push_back(v);
        return found->second;
    }

    void add_side(int axis, Index level) {
        // The other two axes, so that u x v points outward.
        const bool far = level != 0;
        const int u = (axis + (far ? 1 : 2)) % 3, v = (axis + (far ? 2 : 1)) % 3;
        for (Index j = 0; j < n_[v]; ++j) {
            for (Index i = 0; i < n_[u]; ++i) {
                const auto at = [&](Index a, Index b) {
                    Lattice point{};
                    point[axis] = level;
                    point[u] = a;
                    point[v] = b;
                    return vertex(point);
                };
                const Index p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), s = at(i, j + 1);
                faces_.add({p, q, r, s});
            }
        }
    }

    Lattice n_;
    std::vector<Lattice> vertices_;
    std::unordered_map<std::uint64_t, Index> ids_;
    FaceList faces_;
};

Mesh box_mesh(const LatticeBox& box, const Vec3& size, const Context& context) {
    return box.mesh([&](const Vec3& p) { return Vec3(0.5 * size.cwiseProduct(p)); }, context);
}

// Charges the memory for building a shape of `faces` faces, positions and numbers by keys among it.
// Errors: as require_countable; memory_limit.
MemoryCharge room_for(std::int64_t faces, const Context& context) {
    constexpr std::size_t kBytesPerFace = 128;
    require_countable(faces);
    return context.charge(static_cast<std::size_t>(faces) * kBytesPerFace, "a generated mesh");
}

MemoryCharge room_for_box(const Lattice& n, const Context& context) {
    const std::int64_t x = n[0], y = n[1], z = n[2];
    // The products below must not overflow either.
    const std::int64_t largest = std::max({x, y, z});
    require_countable(largest);
    return room_for(2 * (x * y + y * z + z * x), context);
}

// A vertex of a divided icosahedron, by its weights at the corners of a face: (corner, weight)
// pairs with weights above 0, corners ascending. Neighbouring faces name their common vertices
// alike.
using IcosahedronKey = std::array<Index, 6>;

IcosahedronKey icosahedron_key(std::array<std::pair<Index, Index>, 3> weights) {
    std::sort(weights.begin(), weights.end());
    IcosahedronKey key;
    key.fill(kNoIndex);
    std::size_t size = 0;
    for (const auto& [corner, weight] : weights) {
        if (weight == 0) continue;
        key[size++] = corner;
        key[size++] = weight;
    }
    return key;
}

const std::array<Vec3, 12>& icosahedron_corners() {
    static const std::array<Vec3, 12> corners = [] {
        const double g = 0.5 * (1.0 + std::sqrt(5.0));
        std::array<Vec3, 12> c{Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0),
                               Vec3(0, -1, g), Vec3(0, 1, g), Vec3(0, -1, -g), Vec3(0, 1, -g),
                               Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)};
        for (Vec3& p : c) p.normalize();
        return c;
    }();
    return corners;
}

constexpr std::array<std::array<Index, 3>, 20> kIcosahedronFaces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

Mesh icosahedron_sphere(double radius, Index n, const Context& context) {
    std::map<IcosahedronKey, Index> ids;
    std::vector<Vec3> positions;
    FaceList faces;
    for (const auto& corners : kIcosahedronFaces) {
        const auto vertex = [&](Index i, Index j) {
            const std::array<std::pair<Index, Index>, 3> weights{
                {{corners[0], n - i - j}, {corners[1], i}, {corners[2], j}}};
            const IcosahedronKey key = icosahedron_key(weights);
            const auto [found, added] = ids.try_emplace(key, count_of(positions));
            if (added) {
                // Summed in the order of the key, so that the position does not depend on the face.
                Vec3 sum = Vec3::Zero();
                for (std::size_t k = 0; k < key.size() && key[k] != kNoIndex; k += 2) {
                    sum += key[k + 1] * icosahedron_corners()[key[k]];
                }
                positions.push_back(radius * sum.normalized());
            }
            return found->second;
        };
        for (Index j = 0; j < n; ++j) {
            for (Index i = 0; i + j < n; ++i) {
                faces.add({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
                if (i + j + 1 < n) {
                    faces.add({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
                }
            }
        }
    }
    return {std::move(positions), std::move(faces), context};
}

// Angle i of n, counted against the clock around y seen from above.
Vec3 on_circle(Index i, Index n, double radius, double y) {
    const double angle = 2.0 * kPi * i / n;
    return {radius * std::cos(angle), y, -radius * std::sin(angle)};
}

// A cylinder as rings of vertices from the bottom's middle over the wall to the top's middle.
class CylinderBuilder {
  public:
    explicit CylinderBuilder(const CylinderOptions& options) : o_(options) {
        const double half = 0.5 * o_.height;
        if (o_.caps) {
            add_middle(-half);
            for (Index r = 1; r < o_.cap_rings; ++r) add_ring(o_.radius * r / o_.cap_rings, -half);
        }
        wall_ = ring_count_;
        for (Index r = 0; r <= o_.rings; ++r) {
            add_ring(o_.radius, (2.0 * r - o_.rings) / o_.rings * half);
        }
        if (o_.caps) {
            for (Index r = o_.cap_rings - 1; r > 0; --r) {
                add_ring(o_.radius * r / o_.cap_rings, half);
            }
            add_middle(half);
        }
        for (Index r = 0; r + 1 < ring_count_; ++r) add_band(r);
        if (o_.caps) add_fans();
    }

    Mesh mesh(const Context& context) const {
        Mesh result(positions_, faces_, context);
        const auto count = count_of(positions_);
        set_region(result, "bottom", range(0, at(wall_ + 1, 0)));
        set_region(result, "top", range(at(wall_ + o_.rings, 0), count));
        if (o_.caps) {
            set_region(result, "caps",
                       result.find_region("bottom")->united(*result.find_region("top")).vertices());
        }
        return result;
    }

  private:
    void add_middle(double y) { positions_.emplace_back(0.0, y, 0.0); }
    void add_ring(double radius, double y) {
        for (Index i = 0; i < o_.segments; ++i) {
            positions_.push_back(on_circle(i, o_.segments, radius, y));
        }
        ++ring_count_;
    }
    // Vertex i of ring r.
    Index at(Index r, Index i) const {
        return (o_.caps ? 1 : 0) + r * o_.segments + i % o_.segments;
    }
    void add_band(Index r) {
        for (Index i = 0; i < o_.segments; ++i) {
            faces_.add({at(r, i), at(r, i + 1), at(r + 1, i + 1), at(r + 1, i)});
        }
    }
    void add_fans() {
        const auto last = count_of(positions_) - 1;
        for (Index i = 0; i < o_.segments; ++i) {
            faces_.add({0, at(0, i + 1), at(0, i)});
            faces_.add({last, at(ring_count_ - 1, i), at(ring_count_ - 1, i + 1)});
        }
    }
    static std::vector<Index> range(Index begin, Index end) {
        std::vector<Index> result;
        for (Index v = begin; v < end; ++v) result.push_back(v);
        return result;
    }

    CylinderOptions o_;
    std::vector<Vec3> positions_;
    FaceList faces_;
    Index ring_count_ = 0, wall_ = 0;
};

}  // namespace

Mesh make_box(const BoxOptions& options, const Context& context) {
    for (int k = 0; k < 3; ++k) {
        require_length(options.size[k], "size");
        require_at_least(options.segments[k], 1, "segments");
    }
    const MemoryCharge room = room_for_box(options.segments, context);
    const LatticeBox box(options.segments);
    Mesh mesh = box_mesh(box, options.size, context);
    constexpr std::array<std::array<const char*, 2>, 3> names{
        {{"left", "right"}, {"bottom", "top"}, {"back", "front"}}};
    for (int axis = 0; axis < 3; ++axis) {
        set_region(mesh, names[axis][0], box.side(axis, false));
        set_region(mesh, names[axis][1], box.side(axis, true));
    }
    return mesh;
}

Mesh make_bar(const BarOptions& options, const Context& context) {
    require_length(options.width, "width");
    require_length(options.length, "length");
    require_at_least(options.across, 1, "across");
    require_at_least(options.along, 1, "along");
    const Lattice segments{options.across, options.along, options.across};
    const MemoryCharge room = room_for_box(segments, context);
    const LatticeBox box(segments);
    Mesh mesh = box_mesh(box, Vec3(options.width, options.length, options.width), context);
    set_region(mesh, "bottom", box.side(1, false));
    set_region(mesh, "top", box.side(1, true));
    return mesh;
}

Mesh make_sphere(const SphereOptions& options, const Context& context) {
    require_length(options.radius, "radius");
    require_at_least(options.segments, 1, "segments");
    const std::int64_t n = options.segments;
    require_countable(n);
    if (options.kind == SphereKind::triangles) {
        const MemoryCharge room = room_for(20 * n * n, context);
        return icosahedron_sphere(options.radius, options.segments, context);
    }
    const MemoryCharge room = room_for(6 * n * n, context);
    const LatticeBox box({options.segments, options.segments, options.segments});
    const auto place = [&](const Vec3& p) {
        const Vec3 warped = (0.25 * kPi * p).array().tan().matrix();
        return Vec3(options.radius * warped.normalized());
    };
    return box.mesh(place, context);
}

Mesh make_cylinder(const CylinderOptions& options, const Context& context) {
    require_length(options.radius, "radius");
    require_length(options.height, "height");
    require_at_least(options.segments, 3, "segments");
    require_at_least(options.rings, 1, "rings");
    require_at_least(options.cap_rings, 1, "cap_rings");
    const std::int64_t rings = std::int64_t{options.rings} + 2 * std::int64_t{options.cap_rings};
    const MemoryCharge room = room_for(options.segments * rings, context);
    return CylinderBuilder(options).mesh(context);
}

Mesh make_grid(const GridOptions& options, const Context& context) {
    const auto [nx, nz] = options.segments;
    require_length(options.size.x(), "size");
    require_length(options.size.y(), "size");
    require_at_least(nx, 1, "segments");
    require_at_least(nz, 1, "segments");
    const MemoryCharge room = room_for(std::int64_t{nx} * nz, context);
    std::vector<Vec3> positions;
    std::vector<Index> border;
    for (Index j = 0; j <= nz; ++j) {
        for (Index i = 0; i <= nx; ++i) {
            if (i == 0 || j == 0 || i == nx || j == nz) {
                border.push_back(count_of(positions));
            }
            positions.emplace_back((2.0 * i - nx) / nx * 0.5 * options.size.x(), 0.0,
                                   (2.0 * j - nz) / nz * 0.5 * options.size.y());
        }
    }
    FaceList faces;
    for (Index j = 0; j < nz; ++j) {
        for (Index i = 0; i < nx; ++i) {
            const Index at = j * (nx + 1) + i;
            faces.add({at, at + nx + 1, at + nx + 2, at + 1});
        }
    }
    Mesh mesh(std::move(positions), std::move(faces), context);
    set_region(mesh, "border", std::move(border));
    return mesh;
}

Mesh make_torus(const TorusOptions& options, const Context& context) {
    require_length(options.radius, "radius");
    require_length(options.tube_radius, "tube_radius");
    require_at_least(options.segments, 3, "segments");
    require_at_least(options.tube_segments, 3, "tube_segments");
    const MemoryCharge room =
        room_for(std::int64_t{options.segments} * options.tube_segments, context);
    if (options.tube_radius >= options.radius) {
        throw Error(ErrorCode::invalid_argument,
                    "a torus needs a tube_radius smaller than its radius");
    }
    const Index n = options.segments, m = options.tube_segments;
    std::vector<Vec3> positions;
    FaceList faces;
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < m; ++j) {
            const double angle = 2.0 * kPi * j / m;
            const double from_axis = options.radius + options.tube_radius * std::cos(angle);
            positions.push_back(on_circle(i, n, from_axis, options.tube_radius * std::sin(angle)));
            const Index next_i = (i + 1) % n, next_j = (j + 1) % m;
            faces.add({i * m + j, next_i * m + j, next_i * m + next_j, i * m + next_j});
        }
    }
    return {std::move(positions), std::move(faces), context};
}

}  // namespace lissom
