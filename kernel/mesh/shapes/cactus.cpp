#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "kernel/mesh/shapes/shape_checks.h"
#include "kernel/mesh/shapes/shapes.h"

// The cactus is woven from grids of quads whose columns follow the ribs: a tube for the trunk with
// two square holes, and a tube for each arm that starts at the edge of a hole; square patches close
// the tips and the foot. Vertices near joints and in patches are then evened out on the smooth
// union of the tubes, and last the ribs and thorns are pressed into the surface by column and row.
namespace lissom {
namespace {

// Proportions, as fractions of the height.
constexpr double kTrunkRadius = 0.095;
constexpr double kArmRadius = 0.64 * kTrunkRadius;
constexpr double kBevel = 0.35 * kTrunkRadius;
constexpr double kBlend = 0.45 * kTrunkRadius;

// Latitude on the rounded tips between the last ring and the square patch.
constexpr double kPatchLatitude = 62.0 * kPi / 180.0;
constexpr int kRelaxSteps = 60;

// Quads may be this much longer than wide before there are too few vertices for the ribs.
constexpr double kMaximumStretch = 5.0;

double smoothstep(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// A tube with a rounded end around a plane curve: a straight piece, a quarter circle, a straight
// piece. The trunk is a straight piece only. Everything is in units of the cactus's height.
struct Limb {
    Vec3 start, along,
        turned;  // the first straight piece runs along `along`, the last along `turned`
    Vec3 right;  // normal of the curve's plane; right x up = tangent
    double straight = 0.0, bend = 0.0, length = 0.0;
    double radius = 0.0, waist = 0.0;  // thickness at the end, and how much less of it at the start

    struct Frame {
        Vec3 center, tangent, up;
    };

    Frame frame(double s) const {
        const double turn = bend > 0.0 ? std::clamp((s - straight) / bend, 0.0, 0.5 * kPi) : 0.0;
        const Vec3 tangent = std::cos(turn) * along + std::sin(turn) * turned;
        Vec3 center = start + std::min(s, straight) * along;
        if (s > straight) {
            center += bend * (std::sin(turn) * along + (1.0 - std::cos(turn)) * turned);
            center += std::max(0.0, s - straight - 0.5 * kPi * bend) * turned;
        }
        return {center, tangent, tangent.cross(right)};
    }

    double radius_at(double s) const {
        const double left = 1.0 - std::clamp(s / length, 0.0, 1.0);
        return radius * (1.0 - waist * left * left);
    }

    // Parameter of the nearest point of the curve.
    double nearest(const Vec3& p) const {
        const Vec3 d = p - start;
        if (bend == 0.0) return std::clamp(d.dot(along), 0.0, length);
        const double x = d.dot(along) - straight, y = d.dot(turned) - bend;
        // The arc's center is (0, 0), its quadrant x > 0, y < 0.
        if (x <= 0.0 && y <= 0.0) return std::clamp(x + straight, 0.0, straight);
        if (y >= 0.0) return std::min(length, straight + 0.5 * kPi * bend + y);
        return straight + bend * std::atan2(x, -y);
    }

    // A point of the tube at angle `phi`; beyond the length it goes over the rounded end.
    Vec3 point(double s, double phi) const {
        const Frame f = frame(std::min(s, length));
        const Vec3 out = std::cos(phi) * right + std::sin(phi) * f.up;
        const double r = radius_at(s);
        const double latitude = s > length ? (s - length) / r : 0.0;
        return f.center + r * (std::cos(latitude) * out + std::sin(latitude) * f.tangent);
    }

    struct Distance {
        double value;
        Vec3 gradient;
    };

    Distance distance(const Vec3& p) const {
        const double s = nearest(p);
        const Vec3 away = p - frame(s).center;
        const double length_away = away.norm();
        const Vec3 gradient = length_away > 0.0 ? Vec3(away / length_away) : right;
        return {length_away - radius_at(s), gradient};
    }
};

// Polynomial smooth minimum of two distance fields.
Limb::Distance blend(const Limb::Distance& a, const Limb::Distance& b) {
    const double t = std::clamp(0.5 + 0.5 * (b.value - a.value) / kBlend, 0.0, 1.0);
    return {b.value + t * (a.value - b.value) - kBlend * t * (1.0 - t),
            b.gradient + t * (a.gradient - b.gradient)};
}

Limb trunk_limb() {
    Limb trunk;
    trunk.start = Vec3::Zero();
    trunk.along = Vec3::UnitY();
    trunk.turned = Vec3::Zero();
    trunk.right = Vec3::UnitX();
    trunk.straight = trunk.length = 1.0 - kTrunkRadius;
    trunk.radius = kTrunkRadius;
    trunk.waist = 0.16;
    return trunk;
}

// `side` is 1 for the arm at +x, -1 for the other.
Limb arm_limb(double side, double attach, double reach, double top) {
    Limb arm;
    arm.start = Vec3(0.0, attach, 0.0);
    arm.along = Vec3(side, 0.0, 0.0);
    arm.turned = Vec3::UnitY();
    arm.right = Vec3(0.0, 0.0, -side);
    arm.bend = 0.105;
    arm.straight = reach - arm.bend;
    arm.radius = kArmRadius;
    arm.waist = 0.22;
    arm.length = arm.straight + 0.5 * kPi * arm.bend + (top - kArmRadius - attach - arm.bend);
    return arm;
}

const std::array<Limb, 3>& limbs() {
    static const std::array<Limb, 3> all{trunk_limb(), arm_limb(-1.0, 0.37, 0.265, 0.74),
                                         arm_limb(1.0, 0.48, 0.245, 0.89)};
    return all;
}

Limb::Distance surface(const Vec3& p) {
    return blend(blend(limbs()[0].distance(p), limbs()[1].distance(p)), limbs()[2].distance(p));
}

// How many rows and columns everything has, for a spacing of rows.
struct Layout {
    Index ribs = 0, arm_ribs = 0;
    Index per_rib = 0;     // columns from one ridge to the next, even
    double spacing = 0.0;  // between rows
    Index hole_width = 0, hole_height = 0;

    Index columns(std::size_t limb) const { return (limb == 0 ? ribs : arm_ribs) * per_rib; }
    double column_width() const { return 2.0 * kPi * kTrunkRadius / columns(0); }
    Index rows(double length) const {
        return std::max<Index>(2, index_of(std::lround(length / spacing)));
    }
    Index bevel_rows() const { return rows(0.5 * kPi * kBevel); }
    // First row of a limb's tube as a parameter, and the number of steps to its straight end.
    double first(std::size_t limb) const {
        return limb == 0 ? kBevel : kTrunkRadius + 0.5 * kBlend;
    }
    Index wall_rows(std::size_t limb) const { return rows(limbs()[limb].length - first(limb)); }
    Index tip_rows(std::size_t limb) const { return rows(limbs()[limb].radius * kPatchLatitude); }
    double row_step(std::size_t limb) const {
        return (limbs()[limb].length - first(limb)) / wall_rows(limb);
    }

    // Rows of rings in a tube, without those of the bevel.
    Index rings(std::size_t limb) const { return wall_rows(limb) + tip_rows(limb) + 1; }
    Index patch_vertices(std::size_t limb) const {
        const Index across = columns(limb) / 4, up = columns(limb) / 2 - across;
        return (across - 1) * (up - 1);
    }
    Index hole_row(std::size_t limb) const {
        const double middle = (limbs()[limb].start.y() - first(0)) / row_step(0);
        return index_of(std::lround(middle - 0.5 * hole_height));
    }

    Index vertex_count() const {
        const Index holes = 2 * (hole_width - 1) * (hole_height - 1);
        Index count = columns(0) * (rings(0) + bevel_rows()) + 2 * patch_vertices(0) - holes;
        for (const std::size_t arm : {1, 2}) {
            count += columns(arm) * rings(arm) + patch_vertices(arm);
        }
        return count;
    }
};

Layout layout_with(const CactusOptions& options, Index per_rib, double spacing) {
    Layout layout;
    layout.ribs = options.ribs == 0 ? 12 : options.ribs;
    layout.arm_ribs = std::max<Index>(4, (2 * layout.ribs + 1) / 3);
    layout.per_rib = per_rib;
    layout.spacing = spacing;
    // A hole has as many edges around it as an arm has columns, and is about square.
    const Index half = layout.columns(1) / 2;
    const double share = spacing / (spacing + layout.column_width());
    const auto width = 2 * index_of(std::lround(0.5 * half * share));
    layout.hole_width = std::clamp<Index>(width, 2, 2 * ((half - 2) / 2));
    layout.hole_height = half - layout.hole_width;
    return layout;
}

// The row spacing that comes nearest to the wanted number of vertices.
Layout layout_with(const CactusOptions& options, Index per_rib) {
    double fine = 1e-4, coarse = 0.08;
    for (int i = 0; i < 60; ++i) {
        const double middle = std::sqrt(fine * coarse);
        const bool too_many =
            layout_with(options, per_rib, middle).vertex_count() > options.vertices;
        (too_many ? fine : coarse) = middle;
    }
    return layout_with(options, per_rib, coarse);
}

// Returns the layout with the number of columns that makes the quads most nearly square.
Layout choose_layout(const CactusOptions& options) {
    std::optional<Layout> best;
    double best_stretch = std::log(kMaximumStretch);
    for (Index per_rib = 2; per_rib <= 200; per_rib += 2) {
        const Layout layout = layout_with(options, per_rib);
        const double off = std::abs(layout.vertex_count() - options.vertices);
        const double stretch = std::abs(std::log(layout.spacing / layout.column_width()));
        if (off > 0.1 * options.vertices || stretch >= best_stretch) continue;
        best = layout;
        best_stretch = stretch;
    }
    if (best) return *best;
    throw Error(ErrorCode::invalid_argument,
                std::to_string(options.vertices) + " vertices are too few for " +
                    std::to_string(options.ribs) + " ribs; use more vertices or fewer ribs");
}

class CactusBuilder {
  public:
    CactusBuilder(const CactusOptions& options, const Context& context)
        : options_(options), context_(context), layout_(choose_layout(options)) {}

    Mesh build() {
        Progress progress(context_, "cactus");
        add_trunk();
        add_arm(1);
        add_arm(2);
        std::vector<Vec3> positions(vertices_.size());
        for (std::size_t v = 0; v < vertices_.size(); ++v) positions[v] = vertices_[v].position;
        Mesh mesh(std::move(positions), std::move(faces_), context_);
        progress.update(0.3);
        relax(mesh);
        progress.update(0.9);
        name_regions(mesh);
        press_details(mesh);
        return mesh;
    }

  private:
    // Position of a vertex: on a limb's tube, or in a patch (column kNoIndex).
    struct Vertex {
        Vec3 position;
        std::size_t limb = 0;
        Index column = kNoIndex;
        double along = 0.0;
        bool foot = false, relaxed = false;
    };

    Index add_vertex(const Vertex& vertex) {
        vertices_.push_back(vertex);
        return count_of(vertices_) - 1;
    }

    std::vector<Index> add_ring(std::size_t limb, double s) {
        const Index n = layout_.columns(limb);
        std::vector<Index> ring;
        for (Index c = 0; c < n; ++c) {
            ring.push_back(add_vertex({limbs()[limb].point(s, angle(limb, c)), limb, c, s}));
        }
        return ring;
    }

    double angle(std::size_t limb, Index column) const {
        return 2.0 * kPi * (column + phase(limb)) / layout_.columns(limb);
    }

    // An arm's column 0 starts at the middle of the right side of its hole, or just above it.
    double phase(std::size_t limb) const {
        return limb != 0 && layout_.hole_height % 2 != 0 ? 0.5 : 0.0;
    }

    // Rings of the rest of a tube: the straight wall after its first ring, and the rounded tip.
    void add_rows(std::size_t limb, std::vector<std::vector<Index>>& rings) {
        const double first = layout_.first(limb), step = layout_.row_step(limb);
        for (Index j = 1; j <= layout_.wall_rows(limb); ++j) {
            rings.push_back(add_ring(limb, first + j * step));
        }
        const double tip = limbs()[limb].radius * kPatchLatitude;
        for (Index j = 1; j <= layout_.tip_rows(limb); ++j) {
            rings.push_back(
                add_ring(limb, limbs()[limb].length + tip * j / layout_.tip_rows(limb)));
        }
    }

    void add_band(const std::vector<Index>& below, const std::vector<Index>& above, Index column) {
        const std::size_t c = column, next = (c + 1) % below.size();
        faces_.add({below[c], below[next], above[next], above[c]});
    }

    void add_trunk() {
        std::vector<std::vector<Index>> rings;
        const Index bevel = layout_.bevel_rows();
        for (Index j = 0; j <= bevel; ++j) rings.push_back(add_bevel_ring(0.5 * kPi * j / bevel));
        add_rows(0, rings);
        const Index n = layout_.columns(0);
        for (std::size_t j = 0; j + 1 < rings.size(); ++j) {
            const Index row = index_of(j) - bevel;
            for (Index c = 0; c < n; ++c) {
                if (!in_hole(1, c, row) && !in_hole(2, c, row)) add_band(rings[j], rings[j + 1], c);
            }
        }
        for (const std::size_t arm : {1, 2}) holes_[arm] = hole_outline(arm, rings);
        add_patch(rings.back(), 0, false);
        add_patch({rings.front().rbegin(), rings.front().rend()}, 0, true);
        drop_hidden();
    }

    // A ring of the rounded foot; angle 0 is on the ground, pi / 2 at the wall.
    std::vector<Index> add_bevel_ring(double at) {
        const double radius = limbs()[0].radius_at(kBevel) - kBevel * (1.0 - std::sin(at));
        const double y = kBevel * (1.0 - std::cos(at));
        std::vector<Index> ring;
        for (Index c = 0; c < layout_.columns(0); ++c) {
            const double phi = angle(0, c);
            const Vec3 p(radius * std::cos(phi), y, -radius * std::sin(phi));
            ring.push_back(add_vertex({p, 0, c, y, true}));
        }
        return ring;
    }

    // Left column of an arm's hole.
    Index hole_column(std::size_t arm) const {
        const Index n = layout_.columns(0), middle = arm == 2 ? 0 : n / 2;
        return (middle - layout_.hole_width / 2 + n) % n;
    }

    bool in_hole(std::size_t arm, Index column, Index row) const {
        const Index n = layout_.columns(0), from_left = (column - hole_column(arm) + n) % n;
        const Index from_bottom = row - layout_.hole_row(arm);
        return from_left < layout_.hole_width && from_bottom >= 0 &&
               from_bottom < layout_.hole_height;
    }

    // The vertices around a hole, counter-clockwise seen from outside, from the middle of its right
    // side.
    std::vector<Index> hole_outline(std::size_t arm,
                                    const std::vector<std::vector<Index>>& rings) const {
        const Index n = layout_.columns(0), w = layout_.hole_width, h = layout_.hole_height;
        const Index left = hole_column(arm), bottom = layout_.hole_row(arm) + layout_.bevel_rows();
        const auto at = [&](Index column, Index row) {
            return rings[bottom + row][(left + column) % n];
        };
        std::vector<Index> outline;
        for (Index i = 0; i < w; ++i) outline.push_back(at(i, 0));
        for (Index j = 0; j < h; ++j) outline.push_back(at(w, j));
        for (Index i = w; i > 0; --i) outline.push_back(at(i, h));
        for (Index j = h; j > 0; --j) outline.push_back(at(0, j));
        std::rotate(outline.begin(), outline.begin() + w + (h + 1) / 2, outline.end());
        return outline;
    }

    void add_arm(std::size_t arm) {
        std::vector<std::vector<Index>> rings{holes_[arm], add_ring(arm, layout_.first(arm))};
        add_rows(arm, rings);
        for (std::size_t j = 0; j + 1 < rings.size(); ++j) {
            for (Index c = 0; c < layout_.columns(arm); ++c) add_band(rings[j], rings[j + 1], c);
        }
        add_patch(rings.back(), arm, false);
    }

    // Closes a ring, counter-clockwise seen from outside, by a square of quads.
    void add_patch(std::vector<Index> ring, std::size_t limb, bool foot) {
        const auto n = count_of(ring), w = n / 4, h = n / 2 - w;
        std::rotate(ring.begin(), ring.begin() + n - (h + 1) / 2 - w + n % 2, ring.end());
        std::vector<std::vector<Index>> grid(at(h) + 1, std::vector<Index>(at(w) + 1));
        for (Index i = 0; i < n; ++i) {
            if (i < w) {
                grid[0][i] = ring[i];
            } else if (i < w + h) {
                grid[i - w][w] = ring[i];
            } else if (i < 2 * w + h) {
                grid[h][2 * w + h - i] = ring[i];
            } else {
                grid[n - i][0] = ring[i];
            }
        }
        for (Index j = 1; j < h; ++j) {
            for (Index i = 1; i < w; ++i) {
                Vertex vertex{coons(grid, i, j), limb};
                vertex.foot = foot;
                vertex.relaxed = true;
                grid[j][i] = add_vertex(vertex);
            }
        }
        for (Index j = 0; j < h; ++j) {
            for (Index i = 0; i < w; ++i) {
                faces_.add({grid[j][i], grid[j][i + 1], grid[j + 1][i + 1], grid[j + 1][i]});
            }
        }
    }

    // Coons's interpolation of the outline of a grid.
    Vec3 coons(const std::vector<std::vector<Index>>& grid, Index i, Index j) const {
        const auto h = count_of(grid) - 1, w = count_of(grid[0]) - 1;
        const double u = static_cast<double>(i) / w, v = static_cast<double>(j) / h;
        const auto p = [&](Index column, Index row) {
            return vertices_[grid[row][column]].position;
        };
        const Vec3 sides = (1 - u) * p(0, j) + u * p(w, j) + (1 - v) * p(i, 0) + v * p(i, h);
        const Vec3 corners =
            (1 - u) * ((1 - v) * p(0, 0) + v * p(0, h)) + u * ((1 - v) * p(w, 0) + v * p(w, h));
        return sides - corners;
    }

    // Vertices of the trunk inside the holes have no faces: they go, and the others close up.
    void drop_hidden() {
        std::vector<char> used(vertices_.size(), 0);
        for (const Index v : faces_.vertices) used[v] = 1;
        std::vector<Index> renumbered(vertices_.size(), kNoIndex);
        Index count = 0;
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            if (!used[v]) continue;
            vertices_[count] = vertices_[v];
            renumbered[v] = count++;
        }
        vertices_.resize(count);
        for (Index& v : faces_.vertices) v = renumbered[v];
        for (auto& hole : holes_) {
            for (Index& v : hole) v = renumbered[v];
        }
    }

    // Evens out the vertices of patches and around joints, on the smooth surface.
    void relax(Mesh& mesh) {
        const std::vector<Index> moving = relaxed_vertices(mesh);
        const std::span<Vec3> positions = mesh.edit_positions();
        std::vector<Vec3> next(moving.size());
        for (int step = 0; step < kRelaxSteps; ++step) {
            context_.checkpoint();
            for (std::size_t i = 0; i < moving.size(); ++i) {
                const std::span<const Index> ring = mesh.topology().neighbors(moving[i]);
                Vec3 mean = Vec3::Zero();
                for (const Index n : ring) mean += positions[n] / count_of(ring);
                next[i] = on_surface(positions[moving[i]] + 0.7 * (mean - positions[moving[i]]),
                                     vertices_[moving[i]].foot);
            }
            for (std::size_t i = 0; i < moving.size(); ++i) positions[moving[i]] = next[i];
        }
    }

    static Vec3 on_surface(Vec3 p, bool foot) {
        for (int i = 0; i < 3 && !foot; ++i) {
            const auto [value, gradient] = surface(p);
            p -= value * gradient / gradient.squaredNorm();
        }
        return p;
    }

    std::vector<Index> relaxed_vertices(const Mesh& mesh) const {
        std::vector<Index> joints, patches;
        for (const auto& hole : holes_) joints.insert(joints.end(), hole.begin(), hole.end());
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            if (vertices_[v].relaxed) patches.push_back(index_of(v));
        }
        const auto rings = index_of(std::lround(1.6 * kBlend / layout_.spacing)) + 1;
        const Region around_joints = Region(mesh.shared_topology(), joints).grown(rings);
        Region region(mesh.shared_topology(), patches);
        // The rings next to a tip's patch give way to its corners; the foot's edge stays round.
        const Region near_patches = region.grown(std::max<Index>(4, rings / 2));
        std::vector<Index> result;
        const Region either = around_joints.united(near_patches);
        for (const Index v : either.vertices()) {
            if (vertices_[v].relaxed || !vertices_[v].foot) result.push_back(v);
        }
        return result;
    }

    void name_regions(Mesh& mesh) const {
        std::array<std::vector<Index>, 6> found;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            const Vec3& p = mesh.position(v);
            const std::size_t limb = vertices_[v].limb;
            if (p.y() <= 0.05) found[0].push_back(v);
            if (limb == 0 && p.y() >= 1.0 - 1.5 * kTrunkRadius) found[1].push_back(v);
            if (limb == 0) continue;
            const Limb& arm = limbs()[limb];
            const double top = arm.frame(arm.length).center.y() + arm.radius;
            if (p.y() >= arm.start.y() + arm.bend) found[1 + limb].push_back(v);
            if (p.y() >= top - 1.5 * kArmRadius) found[3 + limb].push_back(v);
        }
        constexpr std::array<const char*, 6> names{"base",      "tip",      "left_arm",
                                                   "right_arm", "left_tip", "right_tip"};
        for (std::size_t i = 0; i < names.size(); ++i) {
            mesh.set_region(names[i], Region(mesh.shared_topology(), std::move(found[i])));
        }
    }

    void press_details(Mesh& mesh) const {
        for (Vec3& p : mesh.edit_positions()) {
            const std::size_t v = &p - mesh.positions().data();
            const double depth = detail(vertices_[v], p);
            if (depth != 0.0) p += depth * surface(p).gradient.normalized();
            p *= options_.height;
        }
    }

    // Displacement along the normal by ribs and thorns. Both fade out at the foot, the tips and
    // joints.
    double detail(const Vertex& vertex, const Vec3& p) const {
        if (vertex.column == kNoIndex) return 0.0;
        const Limb& limb = limbs()[vertex.limb];
        const double radius = limb.radius_at(vertex.along);
        double fade = smoothstep(0.0, kPatchLatitude * limb.radius,
                                 limb.length + kPatchLatitude * limb.radius - vertex.along);
        if (vertex.limb == 0) {
            fade *= smoothstep(0.3 * kBevel, kBevel + 0.3 * kTrunkRadius, vertex.along);
            const double arms =
                std::min(limbs()[1].distance(p).value, limbs()[2].distance(p).value);
            fade *= smoothstep(0.3 * kBlend, 1.3 * kBlend, arms);
        } else {
            fade *= smoothstep(0.3 * kBlend, 1.3 * kBlend, limbs()[0].distance(p).value);
        }
        if (options_.ribs == 0) return 0.0;
        return fade *
               (thorn(vertex) * radius - groove(vertex.column) * options_.rib_depth * radius);
    }

    // 0 on the rounded ridges, 1 in the sharp grooves.
    double groove(Index column) const {
        const double u = static_cast<double>(column % layout_.per_rib) / layout_.per_rib;
        return 1.0 - std::abs(std::cos(kPi * u));
    }

    // Bumps on the ridges, every second rib shifted by half their distance.
    double thorn(const Vertex& vertex) const {
        const double step = layout_.row_step(vertex.limb);
        const double half = step * std::max(1.0, std::round(0.2 * kTrunkRadius / step));
        const Index rib = (vertex.column + layout_.per_rib / 2) / layout_.per_rib;
        const double shifted = vertex.along - layout_.first(vertex.limb) + (rib % 2) * half;
        const double along = std::remainder(shifted, 2.0 * half);
        const double width = 2.0 * kPi * limbs()[vertex.limb].radius / layout_.columns(vertex.limb);
        const double across = width * (vertex.column - rib * layout_.per_rib);
        const double size = std::max(0.6 * std::min(step, width), 0.07 * kTrunkRadius);
        return options_.thorns * std::exp(-(along * along + across * across) / (size * size));
    }

    const CactusOptions& options_;
    const Context& context_;
    Layout layout_;
    std::vector<Vertex> vertices_;
    FaceList faces_;
    std::array<std::vector<Index>, 3> holes_;
};

void require_between(double value, double least, double most, const char* option) {
    if (value >= least && value <= most) return;
    throw Error(ErrorCode::invalid_argument, std::string(option) + " must lie between " +
                                                 std::to_string(least) + " and " +
                                                 std::to_string(most));
}

}  // namespace

Mesh make_cactus(const CactusOptions& options, const Context& context) {
    require_length(options.height, "height");
    require_between(options.vertices, 2000, 1000000, "vertices");
    if (options.ribs != 0) require_between(options.ribs, 4, 40, "ribs");
    require_between(options.rib_depth, 0.0, 0.3, "rib_depth");
    require_between(options.thorns, 0.0, 0.2, "thorns");
    return CactusBuilder(options, context).build();
}

}  // namespace lissom
