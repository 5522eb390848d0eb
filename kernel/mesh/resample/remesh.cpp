#include "kernel/mesh/resample/remesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/short_number.h"
#include "kernel/mesh/resample/edge_lengths.h"
#include "kernel/mesh/resample/feature_lines.h"
#include "kernel/mesh/resample/surface_samples.h"
#include "kernel/mesh/resample/triangle_editor.h"

namespace lissom {
namespace {

constexpr std::size_t kBytesPerRemeshedFace = 700;
// About 14 GB.
constexpr double kMostFaces = 2e7;
// Area of an even triangle with edges of length 1.
constexpr double kFaceArea = 0.433;
// Edges beyond these parts of their length are split and collapsed.
constexpr double kTooLong = 4.0 / 3.0, kTooShort = 4.0 / 5.0;
// A line is thinned out if it leaves its place by less than this part of an edge.
constexpr double kLineError = 0.1;
// Cosine of the angle between two faces whose common edge is flipped.
constexpr double kFlipCosine = 0.8;
// Shortest edge that adapts, as a part of the longest.
constexpr double kShortestPart = 0.125;

class Remeshing {
  public:
    Remeshing(const Mesh& mesh, const RemeshOptions& options, std::vector<double> lengths,
              const Context& context)
        : mesh_(mesh),
          context_(context),
          old_lengths_(std::move(lengths)),
          lengths_(old_lengths_),
          editor_(mesh, feature_lines(mesh, options.crease)),
          samples_(mesh, editor_.charts(), context),
          changes_(at(mesh.face_count()), 1) {
        if (options.region) {
            editor_.hold_outside(*options.region);
            changes_.assign(changes_.size(), 0);
            for (const Index f : options.region->faces()) changes_[at(f)] = 1;
        }
        hold_corners(options.crease);
    }

    void round() {
        split_long();
        collapse_short();
        flip_edges();
        relax();
    }

    RemeshResult result() const {
        TriangleEditor::Result made = editor_.result(mesh_, samples_, context_);
        return {std::move(made.mesh), std::move(made.map)};
    }

  private:
    // Vertices at which a line turns by more than the angle of creases.
    void hold_corners(double crease) {
        if (crease >= kPi) return;
        const double cosine = std::cos(crease);
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            if (!editor_.is_on_line(v)) continue;
            const auto [a, b] = along_line(v);
            const Vec3 before = editor_.position(v) - editor_.position(a),
                       after = editor_.position(b) - editor_.position(v);
            if (before.dot(after) < cosine * before.norm() * after.norm()) editor_.hold(v);
        }
    }

    // The neighbours of a vertex along its line.
    std::pair<Index, Index> along_line(Index v) const {
        std::vector<Index> ring, found;
        editor_.neighbors(v, ring);
        for (const Index u : ring) {
            if (editor_.edge(v, u).on_line) found.push_back(u);
        }
        return {found.front(), found.back()};
    }

    bool may_change(const TriangleEditor::Edge& edge) const {
        for (const Index f : {edge.left, edge.right}) {
            if (f != kNoIndex && !changes_[at(editor_.faces()[at(f)].origin)]) return false;
        }
        return true;
    }

    static bool exists(const TriangleEditor::Edge& edge) {
        return edge.left != kNoIndex || edge.right != kNoIndex;
    }

    std::vector<std::pair<Index, Index>> edges() const {
        std::vector<std::pair<Index, Index>> result;
        for (const TriangleEditor::Face& face : editor_.faces()) {
            if (!face.alive()) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = face.vertices[k], b = face.vertices[(k + 1) % 3];
                if (a < b || editor_.edge(a, b).right == kNoIndex) result.emplace_back(a, b);
            }
        }
        return result;
    }

    // Length of an edge over the length that it should have.
    double relative_length(Index a, Index b) const {
        return (editor_.position(a) - editor_.position(b)).norm() /
               std::min(lengths_[at(a)], lengths_[at(b)]);
    }

    // The longest first: medians of thin triangles would make more of them.
    void split_long() {
        std::priority_queue<std::tuple<double, Index, Index>> waiting;
        const auto add = [&](Index a, Index b) {
            const double length = relative_length(a, b);
            if (length > kTooLong) waiting.emplace(length, a, b);
        };
        blocked_.clear();
        for (const auto& [a, b] : edges()) add(a, b);
        while (!waiting.empty()) {
            context_.checkpoint();
            const auto [length, a, b] = waiting.top();
            waiting.pop();
            const TriangleEditor::Edge edge = editor_.edge(a, b);
            if (!exists(edge)) continue;
            if (!may_change(edge) || is_blocked(edge)) {
                blocked_.emplace(std::min(a, b), std::max(a, b));
                continue;
            }
            std::vector<Index> around{a, b};
            for (const Index f : {edge.left, edge.right}) {
                if (f != kNoIndex) around.push_back(editor_.opposite(f, edge));
            }
            const Index middle = editor_.split(edge);
            lengths_.push_back(0.5 * (lengths_[at(a)] + lengths_[at(b)]));
            for (const Index v : around) add(middle, v);
        }
    }

    // Beside a longer edge that stays, halving the others would never end. The longer ones come
    // first.
    bool is_blocked(const TriangleEditor::Edge& edge) const {
        const double length = squared_length(edge);
        for (const Index f : {edge.left, edge.right}) {
            if (f == kNoIndex) continue;
            const Triangle& v = editor_.faces()[at(f)].vertices;
            for (std::size_t k = 0; k < 3; ++k) {
                const TriangleEditor::Edge side = editor_.edge(v[k], v[(k + 1) % 3]);
                const auto ends = std::minmax(side.a, side.b);
                if (squared_length(side) > length && blocked_.contains(ends)) return true;
            }
        }
        return false;
    }

    double squared_length(const TriangleEditor::Edge& edge) const {
        return (editor_.position(edge.a) - editor_.position(edge.b)).squaredNorm();
    }

    void collapse_short() {
        for (const auto& [a, b] : edges()) {
            context_.checkpoint();
            const TriangleEditor::Edge edge = editor_.edge(a, b);
            if (!exists(edge) || !may_change(edge) || relative_length(a, b) >= kTooShort) continue;
            if (!collapse(edge)) {
                collapse({edge.b, edge.a, edge.right, edge.left, edge.on_line});
            }
        }
    }

    bool collapse(const TriangleEditor::Edge& edge) {
        if (!editor_.can_collapse(edge)) return false;
        const bool both = editor_.is_inner(edge.a) && editor_.is_inner(edge.b);
        const Vec3 &a = editor_.position(edge.a), &b = editor_.position(edge.b);
        const Vec3 place = both ? Vec3(0.5 * (a + b)) : a;
        if (makes_long_edges(edge.b, edge.a, place) || editor_.turns_faces(edge.b, edge.a, place)) {
            return false;
        }
        if (both && (makes_long_edges(edge.a, edge.b, place) ||
                     editor_.turns_faces(edge.a, edge.b, place))) {
            return false;
        }
        if (editor_.is_on_line(edge.b) && leaves_line(edge)) return false;
        editor_.collapse(edge);
        if (both) editor_.move(edge.a, place);
        return true;
    }

    bool makes_long_edges(Index v, Index other, const Vec3& place) {
        editor_.neighbors(v, ring_);
        return std::any_of(ring_.begin(), ring_.end(), [&](Index u) {
            const double length = std::min(lengths_[at(u)], lengths_[at(v)]);
            return u != other && (editor_.position(u) - place).norm() > kTooLong * length;
        });
    }

    // The line would go straight past `edge.b`.
    bool leaves_line(const TriangleEditor::Edge& edge) const {
        const auto [u, w] = along_line(edge.b);
        const Vec3 &from = editor_.position(edge.a), &to = editor_.position(u == edge.a ? w : u);
        const Vec3 along = to - from, off = editor_.position(edge.b) - from;
        const double square = along.squaredNorm();
        if (!(square > 0.0)) return true;
        const double t = std::clamp(off.dot(along) / square, 0.0, 1.0);
        return (off - t * along).norm() > kLineError * lengths_[at(edge.b)];
    }

    void flip_edges() {
        for (const auto& [a, b] : edges()) {
            context_.checkpoint();
            const TriangleEditor::Edge edge = editor_.edge(a, b);
            if (!exists(edge) || !may_change(edge) || !editor_.can_flip(edge)) continue;
            const Index c = editor_.opposite(edge.left, edge),
                        d = editor_.opposite(edge.right, edge);
            const int before = misfit(a, 0) + misfit(b, 0) + misfit(c, 0) + misfit(d, 0);
            const int after = misfit(a, -1) + misfit(b, -1) + misfit(c, 1) + misfit(d, 1);
            if (after < before && stays_flat(edge, c, d)) editor_.flip(edge);
        }
    }

    // Squared difference of the number of edges from 6, or 4 on a border.
    int misfit(Index v, int more) {
        editor_.neighbors(v, ring_);
        const bool open = editor_.fan(v).size() < ring_.size();
        const int difference = count_of(ring_) + more - (open ? 4 : 6);
        return difference * difference;
    }

    bool stays_flat(const TriangleEditor::Edge& edge, Index c, Index d) const {
        const auto normal = [&](Index u, Index v, Index w) {
            const Vec3& p = editor_.position(u);
            return Vec3((editor_.position(v) - p).cross(editor_.position(w) - p).normalized());
        };
        const Vec3 n = normal(edge.a, edge.b, c) + normal(edge.b, edge.a, d);
        const double least = kFlipCosine * n.norm();
        return n.dot(normal(c, d, edge.b)) > least && n.dot(normal(d, c, edge.a)) > least;
    }

    // To the mean of the faces around, by area over wanted area, and back onto the surface.
    void relax() {
        for (Index v = 0; v < count_of(editor_.positions()); ++v) {
            context_.checkpoint();
            if (!editor_.is_inner(v) || editor_.fan(v).empty()) continue;
            const Vec3 place = relaxed(v);
            const Index origin = editor_.faces()[at(editor_.fan(v).front())].origin;
            const SurfaceSamples::Sample sample = samples_.nearest(origin, place);
            if (editor_.turns_faces(v, kNoIndex, sample.position)) continue;
            editor_.move(v, sample.position);
            double length = 0.0;
            for (const ElementMap::Source& s : sample.vertices) {
                length += s.weight * old_lengths_[at(s.element)];
            }
            lengths_[at(v)] = length;
        }
    }

    Vec3 relaxed(Index v) const {
        const Vec3& here = editor_.position(v);
        Vec3 sum = Vec3::Zero(), normal = Vec3::Zero();
        double weights = 0.0;
        for (const Index f : editor_.fan(v)) {
            const Triangle& t = editor_.faces()[at(f)].vertices;
            const Vec3 &a = editor_.position(t[0]), &b = editor_.position(t[1]),
                       &c = editor_.position(t[2]);
            const Vec3 area = (b - a).cross(c - a);
            const double length =
                (lengths_[at(t[0])] + lengths_[at(t[1])] + lengths_[at(t[2])]) / 3.0;
            const double weight = area.norm() / (length * length);
            sum += weight * (a + b + c) / 3.0;
            weights += weight;
            normal += area;
        }
        if (!(weights > 0.0) || !(normal.squaredNorm() > 0.0)) return here;
        normal.normalize();
        const Vec3 step = sum / weights - here;
        return here + step - normal.dot(step) * normal;
    }

    const Mesh& mesh_;
    const Context& context_;
    std::vector<double> old_lengths_, lengths_;
    TriangleEditor editor_;
    SurfaceSamples samples_;
    // Whether each old face may change.
    std::vector<char> changes_;
    std::vector<Index> ring_;
    // Long edges that stay, the lower vertex first.
    std::set<std::pair<Index, Index>> blocked_;
};

EdgeLengths wanted_lengths(const Mesh& mesh, const RemeshOptions& options) {
    EdgeLengths wanted;
    wanted.longest = options.edge.value_or(mesh.face_count() > 0 ? mean_edge_length(mesh) : 1.0);
    wanted.shortest = options.shortest.value_or(kShortestPart * wanted.longest);
    wanted.error = options.error.value_or(0.0);
    const auto is_length = [](double x) { return x > 0.0 && std::isfinite(x); };
    require(is_length(wanted.longest), "the length of edges must be above 0");
    require(is_length(wanted.shortest) && wanted.shortest <= wanted.longest,
            "the shortest edge must be above 0 and no longer than the edges");
    require(!options.error || is_length(*options.error), "the error must be a length above 0");
    require(options.iterations >= 0, "the number of rounds is negative");
    require(options.crease >= 0.0, "the angle of creases must be at least 0");
    if (options.region) require_same_topology(mesh, options.region->topology(), "the region");
    return wanted;
}

void require_edges_within(const Mesh& mesh, const EdgeLengths& wanted) {
    if (mesh.face_count() == 0) return;
    const double size = bounds(mesh).diagonal();
    const double length = wanted.error > 0.0 ? wanted.shortest : wanted.longest;
    require(length <= size, "edges of " + short_number(length) + " are longer than the mesh (" +
                                short_number(size) + "); lengths are in the units of the mesh");
}

// Faces of the wanted size instead of a triangle, roughly; as many as edges for a thin one.
double expected_in(const Mesh& mesh, Index f, const std::vector<double>& lengths) {
    const std::span<const Index> v = mesh.topology().face(f);
    double length = 0.0, side = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        length += lengths[at(v[k])] / 3.0;
        side = std::max(side, (mesh.position(v[(k + 1) % 3]) - mesh.position(v[k])).norm());
    }
    const Vec3 across = (mesh.position(v[1]) - mesh.position(v[0]))
                            .cross(mesh.position(v[2]) - mesh.position(v[0]));
    const double area = 0.5 * across.norm();
    return std::max({1.0, area / kFaceArea / length / length, side / length});
}

double expected_faces(const Mesh& mesh, const std::optional<Region>& region,
                      const std::vector<double>& lengths) {
    std::vector<char> changes(at(mesh.face_count()), region ? 0 : 1);
    if (region) {
        for (const Index f : region->faces()) changes[at(f)] = 1;
    }
    double sum = 0.0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        sum += changes[at(f)] ? expected_in(mesh, f, lengths) : 1.0;
    }
    return sum;
}

void require_few_faces(double expected, const Mesh& mesh, const EdgeLengths& wanted) {
    const double most = std::max<double>(kMostFaces, 2.0 * mesh.face_count());
    if (expected <= most) return;
    const bool adapts = wanted.error > 0.0;
    std::string text = "edges so short would make about " + short_number(expected) +
                       " faces, and at most " + short_number(most) + " are made: use a greater " +
                       (adapts ? "error or a longer shortest edge" : "length");
    const double longer = (adapts ? wanted.shortest : wanted.longest) * std::sqrt(expected / most);
    if (std::isfinite(longer)) text += ", as " + short_number(1.05 * longer);
    throw Error(ErrorCode::out_of_range, text);
}

}  // namespace

RemeshResult remesh(const Mesh& mesh, const RemeshOptions& options, const Context& context) {
    const EdgeLengths wanted = wanted_lengths(mesh, options);
    require_complete_attributes(mesh);
    require_edges_within(mesh, wanted);
    Progress progress(context, "remesh");
    Mesh triangles = mesh;
    triangulate(triangles, context);
    RemeshOptions of_triangles = options;
    if (options.region) {
        of_triangles.region =
            Region(triangles.shared_topology(), std::vector(options.region->vertices()));
    }
    std::vector<double> lengths = edge_lengths(triangles, wanted);
    const double expected = expected_faces(triangles, of_triangles.region, lengths);
    require_few_faces(expected, triangles, wanted);
    const auto charge =
        context.charge(static_cast<std::size_t>(expected) * kBytesPerRemeshedFace, "remeshing");
    Remeshing remeshing(triangles, of_triangles, std::move(lengths), context);
    for (Index i = 0; i < options.iterations; ++i) {
        progress.update(i, options.iterations);
        remeshing.round();
    }
    return remeshing.result();
}

}  // namespace lissom
