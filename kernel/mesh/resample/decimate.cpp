#include "kernel/mesh/resample/decimate.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/resample/attribute_quadrics.h"
#include "kernel/mesh/resample/feature_lines.h"
#include "kernel/mesh/resample/quadric.h"
#include "kernel/mesh/resample/triangle_editor.h"

namespace lissom {
namespace {

constexpr std::size_t kBytesPerDecimatedFace = 600;
// Lines count more than the planes of their faces, so that they keep their shape.
constexpr double kLineWeight = 3.0;
// Pulls a new vertex to the middle of its edge where planes leave its place open.
constexpr double kPullToMiddle = 1e-3;
// Short edges first where all errors are zero.
constexpr double kLengthWeight = 1e-6;
constexpr int kCollapsesPerCheck = 256;

struct Collapse {
    TriangleEditor::Edge edge;
    Vec3 position = Vec3::Zero();
    bool moves = false;
    double cost = kNone, squared_error = 0.0;
};

struct Waiting {
    double cost;
    Index a, b;
    std::uint32_t stamp_a, stamp_b;
    bool operator<(const Waiting& other) const {
        return std::tie(other.cost, other.a, other.b) < std::tie(cost, a, b);
    }
};

class Decimation {
  public:
    Decimation(const Mesh& mesh, const DecimateOptions& options)
        : mesh_(mesh),
          options_(options),
          editor_(mesh, feature_lines(mesh, options.crease)),
          center_(center_of(mesh)),
          attributes_(mesh, editor_, options.attributes * size_of(mesh), center_),
          quadrics_(at(mesh.vertex_count())),
          stamps_(at(mesh.vertex_count()), 0) {
        for (const TriangleEditor::Face& face : editor_.faces()) add_face(face);
        hold_vertices();
    }

    void run(const Context& context) {
        Progress progress(context, "decimate");
        const Index wanted = options_.faces.value_or(0), first = editor_.face_count();
        const double all = std::max(1, first - wanted);
        bool changed = true;
        // Collapses that were refused may be possible once their surroundings have changed.
        while (changed && editor_.face_count() > wanted) {
            queue_all(context);
            changed = false;
            for (int n = 1; !queue_.empty() && editor_.face_count() > wanted; ++n) {
                if (n % kCollapsesPerCheck == 0) {
                    progress.update((first - editor_.face_count()) / all);
                }
                context.checkpoint();
                const Waiting next = queue_.top();
                queue_.pop();
                if (stamps_[at(next.a)] != next.stamp_a || stamps_[at(next.b)] != next.stamp_b) {
                    continue;
                }
                changed = collapse(best(next.a, next.b), context) || changed;
            }
        }
    }

    DecimateResult result(const Context& context) const {
        TriangleEditor::Result made =
            editor_.result(mesh_, SurfaceSamples(mesh_, editor_.charts(), context), context);
        return {std::move(made.mesh), std::move(made.map), std::sqrt(greatest_error_)};
    }

  private:
    static double size_of(const Mesh& mesh) {
        return mesh.face_count() == 0 ? 0.0 : surface_radius(mesh);
    }

    static Vec3 center_of(const Mesh& mesh) {
        Box box;
        for (const Vec3& p : mesh.positions()) box.extend(p);
        return box.empty() ? Vec3::Zero() : box.center();
    }

    // Quadrics are sums around the centre: far from the origin they would lose their digits.
    Vec3 local(Index v) const { return editor_.position(v) - center_; }

    void add_face(const TriangleEditor::Face& face) {
        const Triangle& v = face.vertices;
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = local(v[k]);
        const Vec3 area = (p[1] - p[0]).cross(p[2] - p[0]);
        const double twice = area.norm();
        if (!(twice > 0.0)) return;
        const Vec3 normal = area / twice;
        for (const Index u : v) quadrics_[at(u)].add_plane(normal, p[0], twice / 6.0);
        for (std::size_t k = 0; k < 3; ++k) {
            if (face.lines[k]) add_line(v[k], v[(k + 1) % 3], normal);
        }
    }

    // The plane through a line, upright on its face. Its weight does not count in means.
    void add_line(Index a, Index b, const Vec3& normal) {
        const Vec3 along = local(b) - local(a);
        const double square = along.squaredNorm();
        if (!(square > 0.0)) return;
        const Vec3 across = along.cross(normal) / std::sqrt(square);
        for (const Index v : {a, b}) {
            Quadric plane;
            plane.add_plane(across, local(a), kLineWeight * square / 3.0);
            plane.weight = 0.0;
            quadrics_[at(v)] += plane;
        }
    }

    void hold_vertices() {
        if (options_.region) editor_.hold_outside(*options_.region);
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            if (options_.keep_borders && mesh_.topology().is_boundary(v)) editor_.hold(v);
        }
    }

    void queue_all(const Context& context) {
        for (const TriangleEditor::Face& face : editor_.faces()) {
            context.checkpoint();
            if (!face.alive()) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = face.vertices[k], b = face.vertices[(k + 1) % 3];
                // A border edge has one face; others are seen from both.
                if (a < b || editor_.edge(a, b).right == kNoIndex) queue(a, b);
            }
        }
    }

    void queue(Index a, Index b) {
        const Collapse found = best(a, b);
        if (std::isnan(found.cost) || is_too_coarse(found)) return;
        queue_.push({found.cost, a, b, stamps_[at(a)], stamps_[at(b)]});
    }

    bool is_too_coarse(const Collapse& collapse) const {
        return options_.error && collapse.squared_error > *options_.error * *options_.error;
    }

    Collapse best(Index a, Index b) const {
        const TriangleEditor::Edge edge = editor_.edge(a, b);
        if (editor_.is_inner(a) && editor_.is_inner(b)) return meeting(edge);
        const Collapse first = onto(edge);
        const Collapse second = onto({edge.b, edge.a, edge.right, edge.left, edge.on_line});
        return std::isnan(second.cost) || first.cost <= second.cost ? first : second;
    }

    Collapse finished(Collapse collapse, double error, const Quadric& quadric) const {
        const TriangleEditor::Edge& edge = collapse.edge;
        const double length = (editor_.position(edge.a) - editor_.position(edge.b)).squaredNorm();
        error = std::max(error, 0.0);
        collapse.squared_error = quadric.weight > 0.0 ? error / quadric.weight : 0.0;
        collapse.cost = error + kLengthWeight * quadric.weight * length;
        return collapse;
    }

    // Both vertices are free: they meet where the error is least.
    Collapse meeting(const TriangleEditor::Edge& edge) const {
        Quadric quadric = quadrics_[at(edge.a)];
        quadric += quadrics_[at(edge.b)];
        const Vec3 a = local(edge.a), b = local(edge.b);
        const Vec3 middle = 0.5 * (a + b);
        const double pull = kPullToMiddle * quadric.a.trace();
        const Mat3 matrix = quadric.a + pull * Mat3::Identity();
        Vec3 place = matrix.ldlt().solve(pull * middle - quadric.b);
        const double reach = (a - b).squaredNorm();
        if (!place.allFinite() || (place - middle).squaredNorm() > reach) place = middle;
        Collapse collapse{edge, place + center_, true};
        const Index f = edge.left != kNoIndex ? edge.left : edge.right;
        const double error =
            quadric.at(place) +
            attributes_.best(sector(f, edge.a), sector(f, edge.b), collapse.position);
        return finished(collapse, error, quadric);
    }

    // `edge.b` comes to `edge.a`; no cost if it must not.
    Collapse onto(const TriangleEditor::Edge& edge) const {
        Collapse collapse{edge, editor_.position(edge.a), false};
        const bool may = editor_.is_inner(edge.b) || (editor_.is_on_line(edge.b) && edge.on_line);
        if (!may) return collapse;
        Quadric quadric = quadrics_[at(edge.a)];
        quadric += quadrics_[at(edge.b)];
        double error = quadric.at(local(edge.a));
        for (const Index f : sides(edge)) {
            if (f == kNoIndex) continue;
            error += attributes_.kept(sector(f, edge.a), sector(f, edge.b), collapse.position);
        }
        return finished(collapse, error, quadric);
    }

    // Faces whose sectors merge: both on a line, else one of them, as their sectors are the same.
    static std::array<Index, 2> sides(const TriangleEditor::Edge& edge) {
        if (edge.on_line) return {edge.left, edge.right};
        return {edge.left != kNoIndex ? edge.left : edge.right, kNoIndex};
    }

    Index sector(Index face, Index v) const {
        const TriangleEditor::Face& of = editor_.faces()[at(face)];
        return of.sectors[at(TriangleEditor::place_of(of, v))];
    }

    bool collapse(const Collapse& collapse, const Context& context) {
        const TriangleEditor::Edge& edge = collapse.edge;
        if (std::isnan(collapse.cost) || !editor_.can_collapse(edge)) return false;
        if (editor_.turns_faces(edge.b, edge.a, collapse.position)) return false;
        if (collapse.moves && editor_.turns_faces(edge.a, edge.b, collapse.position)) return false;
        for (const Index f : sides(edge)) {
            if (f == kNoIndex) continue;
            if (collapse.moves) {
                attributes_.merge_at(sector(f, edge.a), sector(f, edge.b), collapse.position);
            } else {
                attributes_.merge(sector(f, edge.a), sector(f, edge.b));
            }
        }
        quadrics_[at(edge.a)] += quadrics_[at(edge.b)];
        greatest_error_ = std::max(greatest_error_, collapse.squared_error);
        editor_.collapse(edge);
        if (collapse.moves) editor_.move(edge.a, collapse.position);
        ++stamps_[at(edge.a)];
        ++stamps_[at(edge.b)];
        editor_.neighbors(edge.a, ring_);
        for (const Index u : ring_) {
            context.checkpoint();
            queue(edge.a, u);
        }
        return true;
    }

    const Mesh& mesh_;
    const DecimateOptions& options_;
    TriangleEditor editor_;
    Vec3 center_;
    AttributeQuadrics attributes_;
    std::vector<Quadric> quadrics_;
    std::vector<std::uint32_t> stamps_;
    std::priority_queue<Waiting> queue_;
    std::vector<Index> ring_;
    double greatest_error_ = 0.0;
};

void require_decimation(const Mesh& mesh, const DecimateOptions& options) {
    require(options.faces || options.error,
            "decimation has no limit; give a number of faces or an error");
    require(options.faces.value_or(1) >= 1,
            "a surface has at least one face; ask for 1 for as few as its lines allow");
    const double error = options.error.value_or(0.0);
    require(error >= 0.0, "the error of decimation must be a length of at least 0");
    require(options.crease >= 0.0, "the angle of creases must be at least 0");
    require(options.attributes >= 0.0 && std::isfinite(options.attributes),
            "the weight of attributes must be a number of at least 0");
    if (options.region) require_same_topology(mesh, options.region->topology(), "the region");
}

}  // namespace

DecimateResult decimate(const Mesh& mesh, const DecimateOptions& options, const Context& context) {
    require_decimation(mesh, options);
    require_complete_attributes(mesh);
    const auto charge =
        context.charge(at(mesh.face_count()) * kBytesPerDecimatedFace, "decimation");
    Mesh triangles = mesh;
    triangulate(triangles, context);
    DecimateOptions of_triangles = options;
    if (options.region) {
        of_triangles.region =
            Region(triangles.shared_topology(), std::vector(options.region->vertices()));
    }
    Decimation decimation(triangles, of_triangles);
    context.checkpoint();
    decimation.run(context);
    return decimation.result(context);
}

}  // namespace lissom
