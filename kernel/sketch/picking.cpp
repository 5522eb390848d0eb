#include "kernel/sketch/picking.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/mesh/edges.h"
#include "kernel/sketch/cursor_frame.h"
#include "kernel/sketch/visibility.h"

namespace lissom {
namespace {

// Pixels' length that points and lines may lie behind a surface: they are drawn that much nearer.
constexpr double kOverlaySlack = 2.0;
constexpr int kMaxLookedAt = 10000;
// From this many on, testing for occlusion pays.
constexpr int kManyHidden = 16;
// Distances that differ by less are equal: depth then decides.
constexpr double kPixelStep = 1e-6;
constexpr double kSameDistance = 1e-12;

// A point, or the nearest point of a segment, within the radius.
struct Candidate {
    double pixels = 0.0, depth = 0.0;
    Index object = kNoIndex, index = kNoIndex, segment = kNoIndex;
    double along = 0.0;
    Vec3 local = Vec3::Zero();
};

// A triangle that has hidden something, in the world: it often hides the next thing too.
class OccluderCache {
  public:
    OccluderCache(const View& view, const std::array<Vec3, 3>& corners)
        : camera_(view.camera), corner_(corners[0]) {
        frame_ << corners[1] - corners[0], corners[2] - corners[0], Vec3::Zero();
    }

    // Whether it surely hides a point of the world, and more than `slack` in front of it.
    bool hides(const Vec3& point, double slack) const {
        const double depth = camera_.to_camera(point).z();
        const Vec3 way =
            camera_.is_ortho() ? Vec3(-depth * camera_.forward()) : Vec3(camera_.eye() - point);
        Mat3 system = frame_;
        system.col(2) = -way;
        const Vec3 x = system.inverse() * (point - corner_);
        const double inside = std::min({x.x(), x.y(), 1.0 - x.x() - x.y()});
        return inside > kSurely && x.z() < 1.0 - kSurely && x.z() > kSurely &&
               x.z() * way.norm() > slack;
    }

  private:
    static constexpr double kSurely = 1e-3;

    const Camera& camera_;
    Vec3 corner_;
    Mat3 frame_;
};

// The nearest things of one kind, one after the other: boxes and their contents wait in one queue
// by their least distance (Hjaltason and Samet 1999).
class NearestSearch {
  public:
    NearestSearch(const PickScene& scene, const View& view, const Vec2& cursor,
                  const PickOptions& options, PickKind kind);

    std::optional<PickHit> next();

  private:
    struct Entry {
        double step;
        // A node, or a candidate if the node is kNoIndex.
        Index object, node;
        Candidate candidate;

        // Order at equal distance: first nodes, then by depth.
        auto order() const {
            return std::tuple(step, node == kNoIndex, candidate.depth, object, candidate.index,
                              candidate.segment);
        }
        bool operator>(const Entry& other) const { return order() > other.order(); }
    };

    const BoxTree* boxes_of(const PickScene::Object& object) const;
    void offer_boundaries(Index object);
    void offer_node(Index object, Index node);
    void offer_item(Index object, Index item);
    void offer_edge(Index object, Index a, Index b);
    void offer_point(Index object, Index index, const Vec3& point);
    std::optional<Candidate> nearest_on(Index object, const Vec3& a, const Vec3& b) const;
    void offer(const Candidate& candidate);

    bool is_picked(const Candidate& candidate);
    bool is_hidden(const Candidate& candidate);
    bool faces_eye(const Candidate& candidate) const;
    std::pair<Index, Index> edge_of(const Candidate& candidate) const;
    PickHit hit_of(const Candidate& candidate) const;
    void attach_vertex(const Candidate& candidate, PickHit& hit) const;
    void attach_edge(const Candidate& candidate, PickHit& hit) const;
    void attach_face(std::span<const Index> faces, std::span<const Index> vertices,
                     PickHit& hit) const;

    const SpatialTree& surface(Index object) const { return *scene_.object(object).surface; }

    const PickScene& scene_;
    const View& view_;
    const PickOptions& options_;
    PickKind kind_;
    Visibility visibility_;
    std::vector<CursorFrame> frames_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
    std::set<std::pair<Index, Index>> returned_;
    std::tuple<Index, Index, Index> last_{kNoIndex, kNoIndex, kNoIndex};
    int hidden_ = 0;
    std::optional<OccluderCache> occluders_;
};

std::vector<PickHit> pick_faces(const PickScene& scene, const View& view, const Vec2& cursor,
                                const PickOptions& options);

NearestSearch::NearestSearch(const PickScene& scene, const View& view, const Vec2& cursor,
                             const PickOptions& options, PickKind kind)
    : scene_(scene),
      view_(view),
      options_(options),
      kind_(kind),
      visibility_(scene, view, options.back_faces) {
    for (const PickScene::Object& object : scene.objects()) {
        frames_.emplace_back(view, cursor, object);
    }
    for (Index i = 0; i < count_of(frames_); ++i) {
        if (kind == PickKind::boundary) {
            offer_boundaries(i);
        } else if (const BoxTree* boxes = boxes_of(scene.object(i)); boxes && !boxes->empty()) {
            offer_node(i, 0);
        }
    }
}

const BoxTree* NearestSearch::boxes_of(const PickScene::Object& object) const {
    if (kind_ == PickKind::point) return object.points ? &object.points->boxes() : nullptr;
    if (kind_ == PickKind::polyline) return object.lines ? &object.lines->boxes() : nullptr;
    return object.surface ? &object.surface->boxes() : nullptr;
}

void NearestSearch::offer_node(Index object, Index node) {
    const double least =
        frames_[at(object)].min_pixels(boxes_of(scene_.object(object))->node(node).box).norm();
    if (!(least <= options_.radius)) return;
    queue_.push({std::floor(least / kPixelStep), object, node, {}});
}

void NearestSearch::offer(const Candidate& candidate) {
    queue_.push({std::floor(candidate.pixels / kPixelStep), candidate.object, kNoIndex, candidate});
}

void NearestSearch::offer_item(Index object, Index item) {
    const PickScene::Object& from = scene_.object(object);
    if (kind_ == PickKind::point) {
        offer_point(object, item, from.points->points()[at(item)]);
    } else if (kind_ == PickKind::polyline) {
        const PolylineSet& lines = *from.lines;
        const PolylineSet::Segment& segment = lines.segments()[at(item)];
        auto found = nearest_on(object, lines.points()[at(segment.first)],
                                lines.points()[at(segment.second)]);
        if (!found) return;
        found->index = segment.line;
        found->segment = lines.place(segment);
        offer(*found);
    } else {
        const Triangle& triangle = from.surface->triangles()[at(item)];
        for (std::size_t k = 0; k < 3; ++k) {
            if (kind_ == PickKind::vertex) {
                offer_point(object, triangle[k], from.surface->positions()[at(triangle[k])]);
            } else {
                offer_edge(object, triangle[k], triangle[(k + 1) % 3]);
            }
        }
    }
}

// The side of a triangle, unless it divides a polygon. Both of its triangles offer the same, to the
// bit.
void NearestSearch::offer_edge(Index object, Index a, Index b) {
    if (a > b) std::swap(a, b);
    const auto positions = surface(object).positions();
    auto found = nearest_on(object, positions[at(a)], positions[at(b)]);
    if (!found) return;
    found->index = find_edge(surface(object).topology(), a, b);
    if (found->index == kNoIndex) return;
    if (surface(object).topology().edge(found->index).first != a) found->along = 1.0 - found->along;
    found->segment = 0;
    offer(*found);
}

void NearestSearch::offer_boundaries(Index object) {
    if (!scene_.object(object).surface) return;
    const auto positions = surface(object).positions();
    const auto& loops = surface(object).topology().boundary_loops();
    for (std::size_t loop = 0; loop < loops.size(); ++loop) {
        const std::size_t n = loops[loop].size();
        for (std::size_t i = 0; i < n; ++i) {
            auto found = nearest_on(object, positions[at(loops[loop][i])],
                                    positions[at(loops[loop][(i + 1) % n])]);
            if (!found) continue;
            found->index = index_of(loop);
            found->segment = index_of(i);
            offer(*found);
        }
    }
}

void NearestSearch::offer_point(Index object, Index index, const Vec3& point) {
    const CursorFrame& frame = frames_[at(object)];
    const Vec3 from_ray = frame.from_ray(point);
    if (!frame.is_in_front(from_ray.z())) return;
    const double pixels = frame.pixels(from_ray).norm();
    if (!(pixels <= options_.radius)) return;
    offer({pixels, from_ray.z(), object, index, 0, 0.0, point});
}

// Returns the point of a segment that is seen nearest to the cursor, if it is within the radius.
std::optional<Candidate> NearestSearch::nearest_on(Index object, const Vec3& a,
                                                   const Vec3& b) const {
    const CursorFrame& frame = frames_[at(object)];
    const Vec3 ray_a = frame.from_ray(a), ray_b = frame.from_ray(b);
    const double nearest = frame.nearest_depth(std::max(ray_a.z(), ray_b.z()));
    if (!frame.is_in_front(std::max(ray_a.z(), ray_b.z()))) return std::nullopt;
    // The part in front of the camera, from the fraction `from` to `to`.
    double from = 0.0, to = 1.0;
    const double rise = ray_b.z() - ray_a.z();
    if (ray_a.z() < nearest) from = (nearest - ray_a.z()) / rise;
    if (ray_b.z() < nearest) to = (nearest - ray_a.z()) / rise;
    const Vec3 start = ray_a + from * (ray_b - ray_a), end = ray_a + to * (ray_b - ray_a);

    const Vec2 seen = frame.pixels(start), across = frame.pixels(end) - seen;
    const double square = across.squaredNorm();
    const double part = square > 0.0 ? std::clamp(-seen.dot(across) / square, 0.0, 1.0) : 0.0;
    const double pixels = (seen + part * across).norm();
    if (!(pixels <= options_.radius)) return std::nullopt;
    const double inside = frame.weights(Vec2(1.0 - part, part), Vec2(start.z(), end.z())).y();
    Candidate found{.pixels = pixels, .object = object};
    found.along = from + inside * (to - from);
    found.depth = start.z() + inside * (end.z() - start.z());
    found.local = a + found.along * (b - a);
    return found;
}

std::optional<PickHit> NearestSearch::next() {
    while (!queue_.empty() && hidden_ < kMaxLookedAt) {
        const Entry entry = queue_.top();
        queue_.pop();
        if (entry.node != kNoIndex) {
            const BoxTree& boxes = *boxes_of(scene_.object(entry.object));
            const BoxTree::Node& node = boxes.node(entry.node);
            for (const Index item : boxes.items(node)) offer_item(entry.object, item);
            if (node.count > 0) continue;
            offer_node(entry.object, node.first);
            offer_node(entry.object, node.first + 1);
            continue;
        }
        // Several triangles offer the same vertex or edge; a line is returned once.
        const Candidate& found = entry.candidate;
        const std::tuple same(found.object, found.index, found.segment);
        if (last_ == same || returned_.contains({found.object, found.index})) continue;
        last_ = same;
        if (!is_picked(found)) {
            ++hidden_;
            continue;
        }
        returned_.emplace(found.object, found.index);
        return hit_of(found);
    }
    return std::nullopt;
}

bool NearestSearch::is_picked(const Candidate& candidate) {
    const PickScene::Object& object = scene_.object(candidate.object);
    if (object.surface && !options_.back_faces && !faces_eye(candidate)) return false;
    return options_.through || object.on_top || !is_hidden(candidate);
}

bool NearestSearch::is_hidden(const Candidate& candidate) {
    const PickScene::Object& object = scene_.object(candidate.object);
    const double slack = object.surface ? 0.0 : kOverlaySlack * view_.pixel_length(candidate.depth);
    const Vec3 world = object.to_world(candidate.local);
    if (occluders_ && occluders_->hides(world, slack)) return true;
    if (!visibility_.is_hidden(candidate.object, candidate.local, slack)) return false;
    if (hidden_ < kManyHidden) return true;
    const auto first = pick_faces(scene_, view_, view_.project(world).head<2>(),
                                  {.back_faces = options_.back_faces});
    if (first.empty()) return true;
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const PickScene::Object& from = scene_.object(first[0].object);
        corners[k] = from.to_world(from.surface->positions()[at(first[0].triangle[k])]);
    }
    occluders_.emplace(view_, corners);
    return true;
}

// The vertices of an edge, or of a segment of a boundary.
std::pair<Index, Index> NearestSearch::edge_of(const Candidate& candidate) const {
    const Topology& topology = surface(candidate.object).topology();
    if (kind_ == PickKind::edge) return topology.edge(candidate.index);
    const auto& loop = topology.boundary_loops()[at(candidate.index)];
    const std::size_t i = at(candidate.segment);
    return {loop[i], loop[(i + 1) % loop.size()]};
}

bool NearestSearch::faces_eye(const Candidate& candidate) const {
    if (kind_ == PickKind::vertex) {
        return visibility_.vertex_faces_eye(candidate.object, candidate.index);
    }
    const Topology& topology = surface(candidate.object).topology();
    const auto [a, b] = edge_of(candidate);
    const auto [left, right] = faces_at_edge(topology, find_edge(topology, a, b));
    const std::array ends{a, b};
    return visibility_.faces_eye(candidate.object, left, ends) ||
           (right != kNoIndex && visibility_.faces_eye(candidate.object, right, ends));
}

PickHit NearestSearch::hit_of(const Candidate& candidate) const {
    PickHit hit;
    hit.kind = kind_;
    hit.object = candidate.object;
    hit.index = candidate.index;
    hit.position = scene_.object(candidate.object).to_world(candidate.local);
    hit.depth = candidate.depth;
    hit.pixels = candidate.pixels;
    if (kind_ == PickKind::vertex) {
        attach_vertex(candidate, hit);
    } else if (kind_ != PickKind::point) {
        hit.segment = candidate.segment;
        hit.along = candidate.along;
        if (kind_ != PickKind::polyline) attach_edge(candidate, hit);
    }
    return hit;
}

// The angle of a face at its corner `v`.
double corner_angle(const SpatialTree& surface, Index face, Index v) {
    const auto corners = surface.topology().face(face);
    const std::size_t n = corners.size();
    const auto here =
        static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
    const auto side = [&](std::size_t k) {
        return Vec3(surface.positions()[at(corners[k % n])] - surface.positions()[at(v)]);
    };
    const Vec3 a = side(here + 1), b = side(here + n - 1);
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

// A direction of an object's normals in the world.
Vec3 world_normal(const PickScene::Object& object, const Vec3& normal) {
    return (object.to_local.linear.transpose() * normal).normalized();
}

void NearestSearch::attach_vertex(const Candidate& candidate, PickHit& hit) const {
    const SpatialTree& from = surface(candidate.object);
    const auto around = from.topology().faces_around(candidate.index);
    Vec3 normal = Vec3::Zero();
    for (const Index f : around) {
        normal += corner_angle(from, f, candidate.index) * face_vector(from, f).normalized();
    }
    hit.normal = world_normal(scene_.object(candidate.object), normal);
    attach_face(around, std::array{candidate.index}, hit);
    for (int k = 0; k < 3; ++k) hit.barycentric[k] = hit.triangle[at(k)] == candidate.index;
    hit.vertex = candidate.index;
}

void NearestSearch::attach_edge(const Candidate& candidate, PickHit& hit) const {
    const SpatialTree& from = surface(candidate.object);
    const auto [a, b] = edge_of(candidate);
    const auto [left, right] = faces_at_edge(from.topology(), find_edge(from.topology(), a, b));
    const std::array sides{left, right};
    const std::span faces(sides.data(), right == kNoIndex ? 1 : 2);
    Vec3 normal = Vec3::Zero();
    for (const Index f : faces) normal += face_vector(from, f).normalized();
    hit.normal = world_normal(scene_.object(candidate.object), normal);
    attach_face(faces, std::array{a, b}, hit);
    for (int k = 0; k < 3; ++k) {
        if (hit.triangle[at(k)] == a) hit.barycentric[k] = 1.0 - candidate.along;
        if (hit.triangle[at(k)] == b) hit.barycentric[k] = candidate.along;
    }
    hit.vertex = candidate.along > 0.5 ? b : a;
}

// Prefers faces that are turned to the camera, of these the first one, and adds its triangle with
// all the vertices.
void NearestSearch::attach_face(std::span<const Index> faces, std::span<const Index> vertices,
                                PickHit& hit) const {
    const auto rank = [&](Index f) {
        return std::pair(!visibility_.faces_eye(hit.object, f, vertices), f);
    };
    hit.face = *std::min_element(faces.begin(), faces.end(),
                                 [&](Index f, Index g) { return rank(f) < rank(g); });
    hit.triangle = triangles_with(surface(hit.object), hit.face, vertices).front();
}

PickHit face_hit(const PickScene& scene, const View& view, Index object,
                 const SurfacePoint& found) {
    const PickScene::Object& from = scene.object(object);
    PickHit hit;
    hit.object = object;
    hit.index = hit.face = found.face;
    hit.triangle = found.triangle;
    hit.barycentric = found.barycentric;
    hit.vertex = found.vertex;
    hit.position = from.to_world(found.position);
    hit.normal = world_normal(from, found.normal);
    hit.depth = view.camera.to_camera(hit.position).z();
    return hit;
}

// Returns faces along the ray in ascending distance: all of them with `through`, else the first.
std::vector<PickHit> pick_faces(const PickScene& scene, const View& view, const Vec2& cursor,
                                const PickOptions& options) {
    const Ray ray = view.ray(cursor);
    std::vector<std::pair<double, PickHit>> found;
    double limit = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < count_of(scene.objects()); ++i) {
        const PickScene::Object& object = scene.object(i);
        if (!object.surface) continue;
        const Vec3 origin = object.to_local(ray.origin);
        const Vec3 direction = object.to_local.linear * ray.direction;
        const double length = direction.norm();
        const auto keep = [&](const SurfacePoint& point) {
            const double distance = point.distance / length;
            // A hit on the shared edge of two triangles of a face is one hit.
            const bool again = !found.empty() && found.back().second.object == i &&
                               found.back().second.face == point.face &&
                               distance <= found.back().first * (1.0 + kSameDistance);
            if (!again) found.emplace_back(distance, face_hit(scene, view, i, point));
        };
        if (options.through) {
            for (const SurfacePoint& point : object.surface->pick_all(origin, direction)) {
                if (options.back_faces || point.normal.dot(direction) < 0.0) keep(point);
            }
        } else if (const auto point = object.surface->pick(
                       origin, direction,
                       {.limit = limit * length, .back_faces = options.back_faces})) {
            if (point->distance / length >= limit) continue;
            limit = point->distance / length;
            found.clear();
            keep(*point);
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<PickHit> hits;
    for (auto& [distance, hit] : found) hits.push_back(std::move(hit));
    return hits;
}

void require_valid(const View& view, const Vec2& cursor, const PickOptions& options) {
    require(std::isfinite(options.radius) && options.radius >= 0.0,
            "the radius of a pick is a number of pixels and must not be negative");
    require(view.size.width > 0.0 && view.size.height > 0.0 && std::isfinite(view.size.width) &&
                std::isfinite(view.size.height),
            "the picture to pick in must have a width and a height");
    if (!cursor.allFinite()) {
        throw Error(ErrorCode::not_finite, "the cursor's position is NaN or infinite");
    }
}

}  // namespace

std::vector<PickHit> pick_all(const PickScene& scene, const View& view, const Vec2& cursor,
                              const PickOptions& options, std::size_t most) {
    require_valid(view, cursor, options);
    const std::set<PickKind> kinds(options.kinds.begin(), options.kinds.end());
    std::vector<PickHit> hits;
    for (const PickKind kind : kinds) {
        if (hits.size() >= most) break;
        if (kind == PickKind::face) {
            const auto faces = pick_faces(scene, view, cursor, options);
            hits.insert(hits.end(), faces.begin(), faces.end());
            continue;
        }
        NearestSearch search(scene, view, cursor, options, kind);
        while (hits.size() < most) {
            auto hit = search.next();
            if (!hit) break;
            hits.push_back(*std::move(hit));
        }
    }
    hits.resize(std::min(hits.size(), most));
    return hits;
}

std::optional<PickHit> pick(const PickScene& scene, const View& view, const Vec2& cursor,
                            const PickOptions& options) {
    auto hits = pick_all(scene, view, cursor, options, 1);
    if (hits.empty()) return std::nullopt;
    return hits.front();
}

}  // namespace lissom
