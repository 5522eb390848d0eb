#include "kernel/merge/paste/search/free_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kernel/merge/paste/placement/plane_line.h"
#include "kernel/merge/paste/search/winding_graph.h"

namespace lissom {
namespace {

constexpr int kBandRings = 4;
// Loops are sought that cost less than this many times the one that is known: that one is found
// again, with other rounding.
constexpr double kKnownLimit = 1.0 + 1e-9;
// Points of a smoothed loop, over the mean edge of the band.
constexpr double kSampling = 0.8;
// Width of the filter 2 X - (I + a L)^-1 X, which takes teeth away and hardly shrinks.
constexpr double kFilterWidth = 4.0;
constexpr int kFilterReach = 42;
constexpr int kFilterRounds = 2;
// An outline is smoothed as often, and drawn inward by the least of these parts of its mean edge
// that leaves it in the ring.
constexpr int kOutlineRounds = 4;
constexpr double kInward[] = {0.25, 0.5, 0.75, 1.0, 1.5, 2.0};

std::vector<Triangle> ring_triangles(const PasteChart& chart, const PasteRegions& regions) {
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < chart.map.face.size(); ++t) {
        if (std::binary_search(regions.ring.begin(), regions.ring.end(), chart.map.face[t])) {
            triangles.push_back(chart.map.triangles[t]);
        }
    }
    return triangles;
}

// The middle of the largest triangle that closes the feature's hole.
Vec2 middle_of_fill(const Parameterization& map) {
    Vec2 middle = Vec2::Zero();
    double greatest = -1.0;
    for (const Triangle& t : map.fill_triangles()) {
        const Vec2 &a = map.uv[at(t[0])], &b = map.uv[at(t[1])], &c = map.uv[at(t[2])];
        const Vec2 u = b - a, v = c - a;
        const double area = u.x() * v.y() - u.y() * v.x();
        if (area <= greatest) continue;
        greatest = area;
        middle = (a + b + c) / 3.0;
    }
    return middle;
}

RingEdge edge_between(const RingPoint& a, const RingPoint& b) {
    RingEdge edge;
    edge.from = a.position;
    edge.edge = b.position - a.position;
    edge.image_from = a.image.position;
    edge.image = b.image.position - a.image.position;
    edge.source_normal = (a.normal + b.normal).normalized();
    edge.target_normal = (a.image.normal + b.image.normal).normalized();
    edge.relief = 0.5 * (a.image.relief + b.image.relief);
    edge.inside = a.image.inside && b.image.inside;
    return edge;
}

// Vertices and middles of edges in a band of the ring, and ways between them in its triangles.
class BandGraph {
  public:
    BandGraph(const RingSurface& surface, std::span<const Index> loop) : surface_(surface) {
        find_band(loop);
        add_points();
        for (const Triangle& t : band_) add_ways(t);
        first_side_way_ = ways_.size();
        for (const auto& [a, b] : sides_) {
            const Index middle = middle_of(a, b);
            add_way(node_[at(a)], middle);
            add_way(middle, node_[at(b)]);
        }
    }

    const std::vector<RingPoint>& points() const { return points_; }
    std::vector<RingEdge> edges() const {
        std::vector<RingEdge> edges;
        edges.reserve(ways_.size());
        for (const WindingEdge& way : ways_) {
            edges.push_back(edge_between(points_[at(way.a)], points_[at(way.b)]));
        }
        return edges;
    }

    /// Mean length of the band's edges in the plane.
    double mean_side() const {
        const std::vector<Vec2>& uv = surface_.map().source().map.uv;
        double sum = 0.0;
        for (const auto& [a, b] : sides_) sum += (uv[at(a)] - uv[at(b)]).norm();
        return sum / static_cast<double>(sides_.size());
    }

    /// The cheapest loop, `known` being one of edges. Every loop around the ring crosses the ray
    /// that the winding is counted by.
    std::vector<Index> cheapest(std::span<const double> cost, std::span<const Index> known,
                                const Context& context) const {
        std::vector<Index> starts;
        for (const WindingEdge& way : ways_) {
            if (way.turns != 0) starts.push_back(way.turns > 0 ? way.a : way.b);
        }
        std::sort(starts.begin(), starts.end());
        starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
        const WindingGraph graph(count_of(points_), ways_);
        WindingSearch search(graph, cost);
        WindingLoop best;
        best.cost = kKnownLimit * cost_of(known, cost);
        search.bound(starts, best.cost);
        std::stable_sort(starts.begin(), starts.end(), [&](Index a, Index b) {
            return search.min_through(a) < search.min_through(b);
        });
        for (const Index start : starts) {
            context.checkpoint();
            if (!(search.min_through(start) < best.cost)) break;
            WindingLoop loop = search.through(start, {}, best.cost);
            if (!loop.vertices.empty()) best = std::move(loop);
        }
        return best.vertices;
    }

  private:
    double cost_of(std::span<const Index> loop, std::span<const double> cost) const {
        const PasteChart& chart = surface_.map().source();
        double sum = 0.0;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Index middle =
                middle_of(chart.place_of(loop[k]), chart.place_of(loop[(k + 1) % loop.size()]));
            const std::size_t way = first_side_way_ + 2 * at(middle - first_middle_);
            sum += cost[way] + cost[way + 1];
        }
        return sum;
    }

    void find_band(std::span<const Index> loop) {
        const PasteChart& chart = surface_.map().source();
        std::vector<int> ring(chart.map.vertex.size(), kBandRings + 1);
        for (const Index v : loop) ring[at(chart.place_of(v))] = 0;
        std::vector<char> taken(surface_.ring().triangles.size(), 0);
        for (int k = 0; k < kBandRings; ++k) {
            for (std::size_t i = 0; i < taken.size(); ++i) {
                const Triangle& t = surface_.ring().triangles[i];
                if (taken[i] ||
                    std::none_of(t.begin(), t.end(), [&](Index p) { return ring[at(p)] <= k; })) {
                    continue;
                }
                taken[i] = 1;
                band_.push_back(t);
                for (const Index p : t) ring[at(p)] = std::min(ring[at(p)], k + 1);
            }
        }
    }

    void add_points() {
        node_.assign(surface_.map().source().map.vertex.size(), kNoIndex);
        for (const Triangle& t : band_) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (node_[at(t[k])] == kNoIndex) {
                    node_[at(t[k])] = count_of(points_);
                    points_.push_back(surface_.point(t, Vec3::Unit(static_cast<Eigen::Index>(k))));
                }
                sides_.push_back(std::minmax(t[k], t[(k + 1) % 3]));
            }
        }
        std::sort(sides_.begin(), sides_.end());
        sides_.erase(std::unique(sides_.begin(), sides_.end()), sides_.end());
        first_middle_ = count_of(points_);
        for (const auto& [a, b] : sides_) {
            points_.push_back(surface_.point({a, b, a}, {0.5, 0.5, 0.0}));
        }
    }

    Index middle_of(Index a, Index b) const {
        const std::pair<Index, Index> side = std::minmax(a, b);
        const auto found = std::lower_bound(sides_.begin(), sides_.end(), side);
        return first_middle_ + index_of(found - sides_.begin());
    }

    void add_ways(const Triangle& t) {
        std::array<Index, 3> middle{};
        for (std::size_t k = 0; k < 3; ++k) middle[k] = middle_of(t[k], t[(k + 1) % 3]);
        for (std::size_t k = 0; k < 3; ++k) {
            add_way(middle[k], middle[(k + 1) % 3]);
            add_way(node_[at(t[k])], middle[(k + 1) % 3]);
        }
    }

    void add_way(Index a, Index b) {
        const Vec2 p = points_[at(a)].uv - surface_.ring().middle,
                   q = points_[at(b)].uv - surface_.ring().middle;
        int turns = 0;
        if ((p.y() <= 0.0) != (q.y() <= 0.0) &&
            p.x() + p.y() / (p.y() - q.y()) * (q.x() - p.x()) > 0.0) {
            turns = q.y() > p.y() ? 1 : -1;
        }
        ways_.push_back({a, b, turns});
    }

    const RingSurface& surface_;
    std::vector<Triangle> band_;
    std::vector<RingPoint> points_;
    std::vector<Index> node_;
    std::vector<std::pair<Index, Index>> sides_;
    Index first_middle_ = 0;
    std::vector<WindingEdge> ways_;
    // Two ways along each of `sides_` in turn.
    std::size_t first_side_way_ = 0;
};

std::vector<Vec2> places_of(std::span<const RingPoint> points) {
    std::vector<Vec2> places;
    for (const RingPoint& point : points) places.push_back(point.uv);
    return places;
}

// Points of a closed line about `step` apart.
std::vector<Vec2> resampled(std::span<const Vec2> line, double step) {
    const std::size_t n = line.size();
    double length = 0.0;
    for (std::size_t k = 0; k < n; ++k) length += (line[(k + 1) % n] - line[k]).norm();
    const auto count = static_cast<std::size_t>(std::max(8.0, std::round(length / step)));
    std::vector<Vec2> points;
    double passed = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 &a = line[k], &b = line[(k + 1) % n];
        const double side = (b - a).norm();
        while (points.size() < count) {
            const double wanted =
                length * static_cast<double>(points.size()) / static_cast<double>(count);
            if (wanted > passed + side) break;
            points.push_back(side > 0.0 ? Vec2(a + (wanted - passed) / side * (b - a)) : a);
        }
        passed += side;
    }
    return points;
}

// (I + a L)^-1 X around a closed line: weights that fall off by r a step.
std::vector<Vec2> blurred(const std::vector<Vec2>& line) {
    const double root = std::sqrt(1.0 + 4.0 * kFilterWidth);
    const double r = (1.0 + 2.0 * kFilterWidth - root) / (2.0 * kFilterWidth);
    const auto n = static_cast<std::ptrdiff_t>(line.size());
    std::vector<Vec2> result;
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        Vec2 sum = line[at(k)];
        double weight = 1.0, all = 1.0;
        for (std::ptrdiff_t step = 1; step <= kFilterReach; ++step) {
            weight *= r;
            sum += weight * (line[at((k + step) % n)] + line[at((k + n - step % n) % n)]);
            all += 2.0 * weight;
        }
        result.push_back(sum / all);
    }
    return result;
}

// Blurred twice and the second taken from twice the first, so that a line hardly shrinks.
std::vector<Vec2> filtered(const std::vector<Vec2>& line) {
    const std::vector<Vec2> once = blurred(line), twice = blurred(once);
    std::vector<Vec2> result;
    for (std::size_t k = 0; k < line.size(); ++k) result.push_back(2.0 * once[k] - twice[k]);
    return result;
}

// The points of a line, those that leave the ring or the target's region replaced by the same ones
// of `within`. Nothing if these leave it too.
std::optional<std::vector<RingPoint>> clamped(const RingSurface& surface,
                                              std::span<const Vec2> line,
                                              std::span<const Vec2> within) {
    std::vector<RingPoint> points;
    for (std::size_t k = 0; k < line.size(); ++k) {
        std::optional<RingPoint> point = surface.locate(line[k]);
        if (!point || !point->image.inside) point = surface.locate(within[k]);
        if (!point || !point->image.inside) return std::nullopt;
        points.push_back(*point);
    }
    return points;
}

// A line that runs counter-clockwise, by a distance to its left.
std::vector<Vec2> drawn_inward(const std::vector<Vec2>& line, double distance) {
    const std::size_t n = line.size();
    std::vector<Vec2> drawn;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 along = (line[(k + 1) % n] - line[(k + n - 1) % n]).stableNormalized();
        drawn.push_back(line[k] + distance * Vec2(-along.y(), along.x()));
    }
    return drawn;
}

// The points of a line, if all of them lie in the ring and on the target's region.
std::optional<std::vector<RingPoint>> located(const RingSurface& surface,
                                              std::span<const Vec2> line) {
    std::vector<RingPoint> points;
    for (const Vec2& place : line) {
        const std::optional<RingPoint> point = surface.locate(place);
        if (!point || !point->image.inside) return std::nullopt;
        points.push_back(*point);
    }
    return points;
}

bool is_simple(std::span<const RingPoint> points) {
    std::vector<Vec2> images;
    for (const RingPoint& point : points) images.push_back(point.image.uv);
    return !crosses_itself(places_of(points)) && !crosses_itself(images);
}

// The energy of a line, its similarity improved from one that is near.
FreeLoop judged(std::vector<RingPoint> points, const PasteLoop& from,
                const EnergyOptions& options) {
    std::vector<RingEdge> edges;
    std::vector<Index> all;
    for (std::size_t k = 0; k < points.size(); ++k) {
        edges.push_back(edge_between(points[k], points[(k + 1) % points.size()]));
        all.push_back(index_of(k));
    }
    PasteEnergy energy(std::move(edges), options);
    energy.fix_weights(from.first_scale);
    FreeLoop loop;
    loop.similarity = energy.improved(all, from.similarity);
    loop.energy = energy.energy(all, loop.similarity);
    loop.misfit = energy.misfit(all, loop.similarity);
    loop.points = std::move(points);
    return loop;
}

}  // namespace

RingTriangles::RingTriangles(const PasteChart& chart, const PasteRegions& regions)
    : triangles(ring_triangles(chart, regions)),
      grid(chart.map.uv, triangles),
      middle(middle_of_fill(chart.map)) {}

// Until the point is finished the place of its image is the sum of those of the vertices. A point
// that is a vertex has the image of that.
void RingSurface::add(Index place, double weight, RingPoint& point) const {
    const Index v = map_.source().map.vertex[at(place)];
    point.position += weight * map_.source_mesh().position(v);
    point.normal += weight * map_.source_normals()[at(v)];
    point.uv += weight * map_.source().map.uv[at(place)];
    point.image.uv += weight * images_[at(place)].uv;
    point.image.inside = point.image.inside && images_[at(place)].inside;
}

void RingSurface::finish(RingPoint& point, Index only) const {
    point.normal.normalize();
    if (only != kNoIndex) {
        point.image = images_[at(only)];
        return;
    }
    const bool inside = point.image.inside;
    point.image = inside ? map_.on_target(point.image.uv).value_or(ImagePoint{}) : ImagePoint{};
}

RingPoint RingSurface::point(const Triangle& places, const Vec3& weights) const {
    RingPoint point;
    point.image.inside = true;
    Index only = kNoIndex;
    for (int k = 0; k < 3; ++k) {
        if (weights[k] != 0.0) add(places[at(k)], weights[k], point);
        if (weights[k] == 1.0) only = places[at(k)];
    }
    finish(point, only);
    return point;
}

RingPoint RingSurface::blend(std::span<const ElementMap::Source> vertices) const {
    RingPoint point;
    point.image.inside = true;
    Index only = kNoIndex;
    for (const ElementMap::Source& source : vertices) {
        const Index place = map_.source().place_of(source.element);
        if (place == kNoIndex) return {};
        add(place, source.weight, point);
        if (source.weight == 1.0) only = place;
    }
    finish(point, only);
    return point;
}

std::optional<RingPoint> RingSurface::locate(const Vec2& uv) const {
    const std::optional<UvPoint> found = ring_.grid.locate(uv);
    if (!found) return std::nullopt;
    RingPoint result = point(ring_.triangles[at(found->triangle)], found->barycentric);
    // Not rounded: a line that is carried stays the one that it was.
    result.uv = uv;
    return result;
}

std::optional<FreeLoop> free_loop(const RingSurface& surface, const PasteLoop& from,
                                  const EnergyOptions& options, const Context& context) {
    const BandGraph graph(surface, from.vertices);
    PasteEnergy energy(graph.edges(), options);
    energy.fix_weights(from.first_scale);
    std::vector<Vec2> line;
    for (const Index v : graph.cheapest(energy.costs(from.similarity), from.vertices, context)) {
        line.push_back(graph.points()[at(v)].uv);
    }
    if (line.size() < 3) return std::nullopt;
    const std::vector<Vec2> even = resampled(line, kSampling * graph.mean_side());
    std::vector<Vec2> smooth = even;
    for (int round = 0; round < kFilterRounds; ++round) smooth = filtered(smooth);
    for (const std::vector<Vec2>& wanted : {smooth, even}) {
        std::optional<std::vector<RingPoint>> points = clamped(surface, wanted, even);
        if (!points || !is_simple(*points)) continue;
        FreeLoop loop = judged(std::move(*points), from, options);
        if (loop.energy <= from.energy) return loop;
    }
    return std::nullopt;
}

std::optional<FreeLoop> outline_loop(const RingSurface& surface, const PasteLoop& outline,
                                     Outline which, const EnergyOptions& options) {
    const PasteChart& chart = surface.map().source();
    std::vector<Vec2> corners;
    double side = 0.0;
    for (const Index v : outline.vertices) corners.push_back(chart.map.uv[at(chart.place_of(v))]);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        side += (corners[(k + 1) % corners.size()] - corners[k]).norm();
    }
    side /= static_cast<double>(corners.size());
    const std::vector<Vec2> even = resampled(corners, kSampling * side);
    std::vector<Vec2> smooth = even;
    for (int round = 0; round < kOutlineRounds; ++round) smooth = filtered(smooth);
    const double toward = which == Outline::outer ? side : -side;
    for (const double inward : kInward) {
        std::optional<std::vector<RingPoint>> points =
            located(surface, drawn_inward(smooth, inward * toward));
        if (!points || !is_simple(*points)) continue;
        return judged(std::move(*points), outline, options);
    }
    return std::nullopt;
}

std::optional<FreeLoop> carried_loop(const RingSurface& surface, const FreeLoop& line,
                                     const PasteLoop& from, const EnergyOptions& options) {
    const std::vector<Vec2> places = places_of(line.points);
    std::optional<std::vector<RingPoint>> points = clamped(surface, places, places);
    if (!points || !is_simple(*points)) return std::nullopt;
    return judged(std::move(*points), from, options);
}

}  // namespace lissom
