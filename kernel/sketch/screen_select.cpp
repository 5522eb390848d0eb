#include "kernel/sketch/screen_select.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/sketch/cursor_frame.h"
#include "kernel/sketch/visibility.h"

namespace lissom {
namespace {

// Points that one thread looks at at a time: those of an event of a stroke wake no other.
constexpr Index kVisibilityGrain = 1024;

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

Vec2 nearest_on_segment(const Vec2& a, const Vec2& b, const Vec2& p) {
    const Vec2 along = b - a;
    const double square = along.squaredNorm();
    return a + (square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0) * along;
}

using Corners = std::array<Vec2, 3>;

// Returns whether `p` lies in the triangle, for either orientation.
bool is_inside(const Corners& c, const Vec2& p) {
    const Vec3 turn(cross(c[1] - c[0], p - c[0]), cross(c[2] - c[1], p - c[1]),
                    cross(c[0] - c[2], p - c[2]));
    return turn.minCoeff() >= 0.0 || turn.maxCoeff() <= 0.0;
}

// Barycentric coordinates of a point in a triangle; of one that is seen from the side, on its
// longest edge.
Vec3 barycentric(const Corners& c, const Vec2& p) {
    const Vec3 parts(cross(c[1] - p, c[2] - p), cross(c[2] - p, c[0] - p),
                     cross(c[0] - p, c[1] - p));
    const double area = parts.sum();
    const Vec3 sides((c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm(),
                     (c[1] - c[0]).squaredNorm());
    int opposite = 0;
    const double longest = sides.maxCoeff(&opposite);
    if (std::abs(area) > 1e-12 * longest) return (parts / area).cwiseMax(0.0);
    const std::size_t a = at((opposite + 1) % 3), b = at((opposite + 2) % 3);
    Vec3 result = Vec3::Zero();
    const double t =
        longest > 0.0 ? std::clamp((p - c[a]).dot(c[b] - c[a]) / longest, 0.0, 1.0) : 0.0;
    result[(opposite + 1) % 3] = 1.0 - t;
    result[(opposite + 2) % 3] = t;
    return result;
}

// The point of the segment a-b that is nearest to p-q.
Vec2 nearest_to_segment(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
    const Vec2 along = b - a, other = q - p;
    const double parallel = cross(along, other);
    if (parallel != 0.0) {
        const double s = cross(p - a, other) / parallel, t = cross(p - a, along) / parallel;
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) return a + s * along;
    }
    Vec2 best = a;
    double least = std::numeric_limits<double>::infinity();
    for (const Vec2& on : {nearest_on_segment(a, b, p), nearest_on_segment(a, b, q), a, b}) {
        const double distance = (nearest_on_segment(p, q, on) - on).norm();
        if (distance < least) std::tie(least, best) = std::pair(distance, on);
    }
    return best;
}

// A part of the picture, inside a rectangle.
class Shape {
  public:
    Shape(const Vec2& low, const Vec2& high) : low_(low), high_(high) {}
    virtual ~Shape() = default;

    Vec2 middle() const { return 0.5 * (low_ + high_); }
    Vec2 reach() const { return 0.5 * (high_ - low_); }
    bool contains(const Vec2& p) const {
        const bool in_rectangle =
            (p.array() >= low_.array()).all() && (p.array() <= high_.array()).all();
        return in_rectangle && encloses(p);
    }
    // Returns a point of the triangle inside the shape, if the shape selects triangles it touches.
    virtual std::optional<Vec2> touched(const Corners&) const { return std::nullopt; }

  protected:
    virtual bool encloses(const Vec2&) const { return true; }

  private:
    Vec2 low_, high_;
};

// The disks around a segment.
class Dab : public Shape {
  public:
    Dab(const Vec2& from, const Vec2& to, double radius)
        : Shape(from.cwiseMin(to) - Vec2::Constant(radius),
                from.cwiseMax(to) + Vec2::Constant(radius)),
          from_(from),
          to_(to),
          radius_(radius) {}

    std::optional<Vec2> touched(const Corners& corners) const override {
        if (is_inside(corners, from_)) return from_;
        if (is_inside(corners, to_)) return to_;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 p = nearest_to_segment(corners[k], corners[(k + 1) % 3], from_, to_);
            if (encloses(p)) return p;
        }
        return std::nullopt;
    }

  protected:
    bool encloses(const Vec2& p) const override {
        return (nearest_on_segment(from_, to_, p) - p).squaredNorm() <= radius_ * radius_;
    }

  private:
    Vec2 from_, to_;
    double radius_;
};

// The inside of an outline, by winding number. Its sides are kept by the bands of the picture that
// they cross, so that a point is compared with few of them.
class Lasso : public Shape {
  public:
    explicit Lasso(std::span<const Vec2> outline, const Vec2& low, const Vec2& high)
        : Shape(low, high), outline_(outline.begin(), outline.end()), low_(low.y()) {
        const double height = high.y() - low.y();
        bands_.resize(band_count(height));
        per_pixel_ = height > 0.0 ? static_cast<double>(bands_.size()) / height : 0.0;
        for (std::size_t i = 0; i < outline_.size(); ++i) {
            const double a = outline_[i].y(), b = end(i).y();
            for (std::size_t k = band(std::min(a, b)); k <= band(std::max(a, b)); ++k) {
                bands_[k].push_back(i);
            }
        }
    }

  protected:
    bool encloses(const Vec2& p) const override {
        int winding = 0;
        for (const std::size_t i : bands_[band(p.y())]) {
            const Vec2 &a = outline_[i], &b = end(i);
            if ((a.y() <= p.y()) == (b.y() <= p.y())) continue;
            const bool down = a.y() <= p.y();
            const double side = cross(b - a, p - a);
            if (down ? side > 0.0 : side < 0.0) winding += down ? 1 : -1;
        }
        return winding != 0;
    }

  private:
    // As many as sides of the mean height cross two of.
    std::size_t band_count(double height) const {
        double heights = 0.0;
        for (std::size_t i = 0; i < outline_.size(); ++i) {
            heights += std::abs(end(i).y() - outline_[i].y());
        }
        if (!(heights > 0.0)) return 1;
        const double sides = static_cast<double>(outline_.size());
        return static_cast<std::size_t>(std::clamp(height * sides / heights, 1.0, 1024.0));
    }

    const Vec2& end(std::size_t i) const { return outline_[(i + 1) % outline_.size()]; }
    std::size_t band(double y) const {
        const double place = std::max(0.0, (y - low_) * per_pixel_);
        return std::min(bands_.size() - 1, static_cast<std::size_t>(place));
    }

    std::vector<Vec2> outline_;
    std::vector<std::vector<std::size_t>> bands_;
    double low_, per_pixel_;
};

// A point of a surface that lies in the shape, and the element it selects if it is not hidden.
struct Witness {
    Index element;
    Vec3 local;
};

// The search on one surface. Shapes are tested one after the other; elements selected by one are
// not tested again.
class SurfaceSelection {
  public:
    SurfaceSelection(const PickScene& scene, const View& view, Index object,
                     const SelectOptions& options, const Context& context)
        : scene_(scene),
          view_(view),
          object_(object),
          surface_(*scene.object(object).surface),
          options_(options),
          context_(context),
          visibility_(scene, view, options.back_faces),
          known_(object < count_of(options.known) ? options.known[at(object)] : nullptr),
          done_(at(by_vertex() ? surface_.topology().vertex_count()
                               : surface_.topology().face_count()),
                false) {
        if (!known_) return;
        require(by_vertex(),
                "known vertices can be left out only when selecting vertices, not "
                "faces");
        require(known_->topology() == surface_.shared_topology(),
                "known vertices belong to another mesh, or to an older version of this one",
                ErrorCode::topology_mismatch);
        for (const Index v : known_->vertices()) done_[at(v)] = true;
    }

    void add(const Shape& shape) {
        context_.checkpoint();
        collect(shape);
        keep_visible();
        for (const Witness& witness : witnesses_) {
            if (!by_vertex() && done_[at(witness.element)]) continue;
            found_.push_back(witness.element);
            done_[at(witness.element)] = true;
        }
    }

    Selected result() const;

  private:
    bool by_vertex() const { return options_.kind == SelectKind::vertices; }
    void collect(const Shape& shape);
    void collect_vertices(const Shape& shape, const CursorFrame& frame, const Triangle& triangle);
    void collect_face(const Shape& shape, const CursorFrame& frame, Index item);
    void keep_visible();
    bool is_selected(const Witness& witness) const;

    const PickScene& scene_;
    const View& view_;
    Index object_;
    const SpatialTree& surface_;
    const SelectOptions& options_;
    const Context& context_;
    Visibility visibility_;
    const Region* known_;
    // Elements that need no further test: found or known ones, and hidden vertices.
    std::vector<char> done_;
    // Vertices that this shape was asked for.
    std::vector<char> asked_;
    std::vector<Witness> witnesses_;
    // In the order in which they were found.
    std::vector<Index> found_, unseen_;
};

void SurfaceSelection::collect(const Shape& shape) {
    witnesses_.clear();
    if (by_vertex()) asked_.assign(done_.begin(), done_.end());
    const CursorFrame frame(view_, shape.middle(), scene_.object(object_));
    // A little more than the shape, so that rounding loses nothing.
    const Vec2 reach = shape.reach() + Vec2::Constant(1e-6);
    const auto may_meet = [&](const Box& box) {
        return (frame.min_pixels(box).array() <= reach.array()).all();
    };
    surface_.boxes().visit(may_meet, [&](Index item) {
        // An outline of many sides takes long for each vertex.
        context_.checkpoint();
        if (by_vertex()) {
            collect_vertices(shape, frame, surface_.triangles()[at(item)]);
        } else if (!done_[at(surface_.faces()[at(item)])]) {
            collect_face(shape, frame, item);
        }
    });
}

void SurfaceSelection::collect_vertices(const Shape& shape, const CursorFrame& frame,
                                        const Triangle& triangle) {
    for (const Index v : triangle) {
        if (std::exchange(asked_[at(v)], true)) continue;
        const Vec3& local = surface_.positions()[at(v)];
        const Vec3 from_ray = frame.from_ray(local);
        if (!frame.is_in_front(from_ray.z())) continue;
        if (shape.contains(shape.middle() + frame.pixels(from_ray))) {
            witnesses_.push_back({v, local});
            done_[at(v)] = true;
        }
    }
}

void SurfaceSelection::collect_face(const Shape& shape, const CursorFrame& frame, Index item) {
    const Triangle& triangle = surface_.triangles()[at(item)];
    const Index face = surface_.faces()[at(item)];
    Mat3 corners, from_ray;
    for (int k = 0; k < 3; ++k) {
        corners.col(k) = surface_.positions()[at(triangle[at(k)])];
        from_ray.col(k) = frame.from_ray(corners.col(k));
    }
    const auto seen = [&](const Vec3& p) { return Vec2(shape.middle() + frame.pixels(p)); };
    const Vec3 centroid = from_ray.rowwise().mean();
    if (frame.is_in_front(centroid.z()) && shape.contains(seen(centroid))) {
        witnesses_.push_back({face, corners.rowwise().mean()});
    }
    if (!frame.is_in_front(from_ray.row(2).minCoeff())) return;
    const Corners on_screen{seen(from_ray.col(0)), seen(from_ray.col(1)), seen(from_ray.col(2))};
    if (const auto point = shape.touched(on_screen)) {
        const Vec3 depths = from_ray.row(2);
        const Vec3 weights = frame.weights(barycentric(on_screen, *point), depths);
        witnesses_.push_back({face, corners * weights});
    }
}

bool SurfaceSelection::is_selected(const Witness& witness) const {
    if (!options_.back_faces) {
        const bool faces_eye = by_vertex() ? visibility_.vertex_faces_eye(object_, witness.element)
                                           : visibility_.faces_eye(object_, witness.element);
        if (!faces_eye) return false;
    }
    return options_.through || !visibility_.is_hidden(object_, witness.local);
}

void SurfaceSelection::keep_visible() {
    std::vector<char> kept(witnesses_.size(), false);
    context_.parallel_for(0, count_of(witnesses_), kVisibilityGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) kept[at(i)] = is_selected(witnesses_[at(i)]);
    });
    std::size_t count = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (kept[i]) {
            witnesses_[count++] = witnesses_[i];
        } else if (by_vertex()) {
            unseen_.push_back(witnesses_[i].element);
        }
    }
    witnesses_.resize(count);
}

Selected SurfaceSelection::result() const {
    const auto region = [&](std::vector<Index> ids) {
        std::sort(ids.begin(), ids.end());
        return Region(surface_.shared_topology(), std::move(ids));
    };
    if (by_vertex()) return {object_, region(found_), {}, region(unseen_)};
    std::vector<Index> elements = found_, vertices;
    std::sort(elements.begin(), elements.end());
    for (const Index f : elements) {
        const auto corners = surface_.topology().face(f);
        vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
    return {object_, Region(surface_.shared_topology(), std::move(vertices)), std::move(elements),
            region({})};
}

void require_finite(std::span<const Vec2> pixels) {
    const bool finite =
        std::all_of(pixels.begin(), pixels.end(), [](const Vec2& p) { return p.allFinite(); });
    if (!finite) throw Error(ErrorCode::not_finite, "a position in the picture is NaN or infinite");
}

// Calls add(selection) for every surface of the scene.
template <typename Add>
std::vector<Selected> select(const PickScene& scene, const View& view, const SelectOptions& options,
                             const Context& context, const Add& add) {
    require(view.size.width > 0.0 && view.size.height > 0.0 && std::isfinite(view.size.width) &&
                std::isfinite(view.size.height),
            "the picture to select in must have a width and a height");
    std::vector<Selected> results;
    for (Index i = 0; i < count_of(scene.objects()); ++i) {
        if (!scene.object(i).surface) continue;
        SurfaceSelection selection(scene, view, i, options, context);
        add(selection);
        results.push_back(selection.result());
    }
    return results;
}

}  // namespace

std::vector<Selected> select_rectangle(const PickScene& scene, const View& view, const Vec2& a,
                                       const Vec2& b, const SelectOptions& options,
                                       const Context& context) {
    require_finite(std::array{a, b});
    const Shape rectangle(a.cwiseMin(b), a.cwiseMax(b));
    return select(scene, view, options, context,
                  [&](SurfaceSelection& selection) { selection.add(rectangle); });
}

std::vector<Selected> select_lasso(const PickScene& scene, const View& view,
                                   std::span<const Vec2> outline, const SelectOptions& options,
                                   const Context& context) {
    require_finite(outline);
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec2& p : outline) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return select(scene, view, options, context, [&](SurfaceSelection& selection) {
        if (outline.size() >= 3) selection.add(Lasso(outline, low, high));
    });
}

std::vector<Selected> select_brush(const PickScene& scene, const View& view, const Brush& brush,
                                   const SelectOptions& options, const Context& context) {
    require_finite(brush.stroke);
    require(std::isfinite(brush.radius) && brush.radius >= 0.0,
            "the radius of a brush is a number of pixels and must not be negative");
    const auto& stroke = brush.stroke;
    return select(scene, view, options, context, [&](SurfaceSelection& selection) {
        if (stroke.size() == 1) selection.add(Dab(stroke[0], stroke[0], brush.radius));
        for (std::size_t i = 1; i < stroke.size(); ++i) {
            selection.add(Dab(stroke[i - 1], stroke[i], brush.radius));
        }
    });
}

}  // namespace lissom
