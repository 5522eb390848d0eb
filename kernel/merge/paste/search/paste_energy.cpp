#include "kernel/merge/paste/search/paste_energy.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/core/error.h"
#include "kernel/deform/rotation/polar.h"

namespace lissom {
namespace {

constexpr double kLengthWeight = 0.1;
// The weight of cleared features that a boundary would cut through, beside the misfit.
constexpr double kReliefWeight = 2.0;
// Residuals below this part of a length count as that much, so that weights stay finite.
constexpr double kMinResidual = 1e-3;
constexpr int kReweightings = 4;

Mat3 rotation_of(const Mat3& products) {
    const double size = products.norm();
    return size > 0.0 ? nearest_rotation(products / size) : Mat3(Mat3::Identity());
}

// Products of the ends of a loop's edges, each vertex of it twice, about their means.
Mat3 products_of_points(std::span<const RingEdge> ring, std::span<const Index> edges) {
    std::vector<Vec3> points, images;
    Vec3 middle = Vec3::Zero(), image_middle = Vec3::Zero();
    for (const Index e : edges) {
        const RingEdge& edge = ring[at(e)];
        for (const double t : {0.0, 1.0}) {
            points.emplace_back(edge.from + t * edge.edge);
            images.emplace_back(edge.image_from + t * edge.image);
            middle += points.back();
            image_middle += images.back();
        }
    }
    const auto count = static_cast<double>(points.size());
    Mat3 products = Mat3::Zero();
    for (std::size_t k = 0; k < points.size(); ++k) {
        products += (images[k] - image_middle / count) * (points[k] - middle / count).transpose();
    }
    return products;
}

}  // namespace

std::vector<RingEdge> ring_edges(const PasteMap& map, const LoopSearch& ring,
                                 std::span<const ImagePoint> images) {
    const Mesh& source = map.source_mesh();
    const std::span<const Vec3> normals = map.source_normals();
    std::vector<Index> places(at(source.vertex_count()), kNoIndex);
    const std::vector<Index>& vertex = map.source().map.vertex;
    for (std::size_t k = 0; k < vertex.size(); ++k) places[at(vertex[k])] = index_of(k);
    std::vector<RingEdge> edges;
    edges.reserve(ring.edges().size());
    for (const auto& [a, b] : ring.edges()) {
        RingEdge edge;
        edge.from = source.position(a);
        edge.edge = source.position(b) - source.position(a);
        edge.source_normal = (normals[at(a)] + normals[at(b)]).normalized();
        const ImagePoint& from = images[at(places[at(a)])];
        const ImagePoint& to = images[at(places[at(b)])];
        edge.inside = from.inside && to.inside;
        edge.image_from = from.position;
        edge.image = to.position - from.position;
        edge.target_normal = (from.normal + to.normal).normalized();
        edge.relief = 0.5 * (from.relief + to.relief);
        edges.push_back(edge);
    }
    return edges;
}

std::vector<Index> PasteEnergy::edges_of(const LoopSearch& ring,
                                         std::span<const Index> loop) const {
    std::vector<Index> edges;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Index e = ring.edge_between(loop[k], loop[(k + 1) % loop.size()]);
        if (e == kNoIndex || !edges_[at(e)].inside) return {};
        edges.push_back(e);
    }
    return edges;
}

double PasteEnergy::cost(const RingEdge& edge, const PasteSimilarity& similarity) const {
    const Vec3 turned = similarity.rotation * edge.edge;
    const double length = edge.edge.norm();
    if (options_.thesis) return (similarity.scale * turned - edge.image).norm() * length;
    const double root = std::sqrt(similarity.scale);
    double cost = (root * turned - edge.image / root).norm() + lambda_ * length;
    cost += kReliefWeight * root * length * edge.relief;
    if (mu_ > 0.0) {
        cost +=
            mu_ * length * (similarity.rotation * edge.source_normal - edge.target_normal).norm();
    }
    return cost;
}

std::vector<double> PasteEnergy::costs(const PasteSimilarity& similarity) const {
    std::vector<double> costs;
    costs.reserve(edges_.size());
    for (const RingEdge& edge : edges_) {
        costs.push_back(edge.inside ? cost(edge, similarity)
                                    : std::numeric_limits<double>::infinity());
    }
    return costs;
}

double PasteEnergy::energy(std::span<const Index> edges, const PasteSimilarity& similarity) const {
    double sum = 0.0;
    for (const Index e : edges) sum += cost(edges_[at(e)], similarity);
    return sum;
}

double PasteEnergy::misfit(std::span<const Index> edges, const PasteSimilarity& similarity) const {
    const double root = std::sqrt(similarity.scale);
    double sum = 0.0, length = 0.0;
    for (const Index e : edges) {
        const RingEdge& edge = edges_[at(e)];
        sum += (root * (similarity.rotation * edge.edge) - edge.image / root).norm();
        length += root * edge.edge.norm();
    }
    return length > 0.0 ? sum / length : 0.0;
}

PasteSimilarity PasteEnergy::literal(std::span<const Index> edges) const {
    Mat3 products = Mat3::Zero();
    double from = 0.0, to = 0.0;
    for (const Index e : edges) {
        products += edges_[at(e)].image * edges_[at(e)].edge.transpose();
        from += edges_[at(e)].edge.norm();
        to += edges_[at(e)].image.norm();
    }
    if (options_.thesis) products = products_of_points(edges_, edges);
    return {rotation_of(products), from > 0.0 && to > 0.0 ? to / from : 1.0};
}

PasteSimilarity PasteEnergy::start(std::span<const Index> edges) {
    const PasteSimilarity first = literal(edges);
    fix_weights(options_.first_scale.value_or(first.scale));
    return first;
}

void PasteEnergy::fix_weights(double scale) {
    lambda_ = kLengthWeight * std::sqrt(scale);
    mu_ = options_.normals * std::sqrt(scale);
}

PasteSimilarity PasteEnergy::reweighted(std::span<const Index> edges,
                                        const PasteSimilarity& before) const {
    Mat3 products = Mat3::Zero();
    double from = 0.0, to = 0.0;
    const double root = std::sqrt(before.scale);
    for (const Index e : edges) {
        const RingEdge& edge = edges_[at(e)];
        const double length = edge.edge.norm();
        const double rest = (root * (before.rotation * edge.edge) - edge.image / root).norm();
        const double weight = 1.0 / std::max(rest, kMinResidual * root * length);
        products += weight * edge.image * edge.edge.transpose();
        from += weight * edge.edge.squaredNorm();
        to += weight * edge.image.squaredNorm();
        if (!(mu_ > 0.0)) continue;
        const double turn = (before.rotation * edge.source_normal - edge.target_normal).norm();
        products += mu_ * length / std::max(turn, kMinResidual) * edge.target_normal *
                    edge.source_normal.transpose();
    }
    if (!(from > 0.0 && to > 0.0)) return before;
    return {rotation_of(products), std::sqrt(to / from)};
}

PasteSimilarity PasteEnergy::improved(std::span<const Index> edges,
                                      const PasteSimilarity& before) const {
    if (options_.thesis) return literal(edges);
    PasteSimilarity best = before;
    double least = energy(edges, before);
    for (int step = 0; step < kReweightings; ++step) {
        const PasteSimilarity next = reweighted(edges, best);
        const double found = energy(edges, next);
        if (!(found < least)) break;
        best = next;
        least = found;
    }
    return best;
}

namespace {

// The loop to begin with and its edges.
std::vector<Index> first_loop(const PasteRegions& regions, const PasteEnergy& energy,
                              const LoopSearch& ring, std::span<const Index> start) {
    for (const std::span<const Index> loop :
         {start, std::span<const Index>(regions.outer), std::span<const Index>(regions.inner)}) {
        if (!loop.empty() && !energy.edges_of(ring, loop).empty())
            return {loop.begin(), loop.end()};
    }
    return {};
}

[[noreturn]] void refuse_outside(const PasteRegions& regions, const PasteChart& chart,
                                 std::span<const ImagePoint> images) {
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : regions.inner) {
        if (!images[at(chart.place_of(v))].inside) elements.add(v);
    }
    throw Error(ErrorCode::boundary_conflict,
                "the part does not fit into the target's region: " + describe(elements) +
                    " of its feature's outline lie outside it; move the placement inward, make "
                    "its scale smaller, or mark a larger region",
                elements);
}

}  // namespace

PasteLoop search_boundary(const PasteMap& map, const PasteRegions& regions, const LoopSearch& ring,
                          std::span<const ImagePoint> images, std::span<const Index> start,
                          const EnergyOptions& options, const Context& context) {
    PasteEnergy energy(ring_edges(map, ring, images), options);
    PasteLoop result;
    PasteSearch& report = result.report;
    result.vertices = first_loop(regions, energy, ring, start);
    if (result.vertices.empty()) refuse_outside(regions, map.source(), images);
    std::vector<Index> edges = energy.edges_of(ring, result.vertices);
    result.similarity = energy.start(edges);
    result.first_scale = options.first_scale.value_or(result.similarity.scale);
    const std::vector<Index> outline = energy.edges_of(ring, regions.outer);
    if (!outline.empty()) {
        PasteSimilarity own = energy.start(outline);
        energy.fix_weights(result.first_scale);
        own = energy.improved(outline, own);
        report.outline_energy = energy.energy(outline, own);
        report.outline_misfit = energy.misfit(outline, own);
    }
    PasteLoop best = result;
    const auto note = [&] {
        report.energy.push_back(energy.energy(edges, result.similarity));
        report.misfit.push_back(energy.misfit(edges, result.similarity));
    };
    note();
    double least = report.energy.back();
    best = result;
    report.stop = PasteStop::iterations;
    for (Index k = 0; k < options.iterations; ++k) {
        context.checkpoint();
        result.similarity = energy.improved(edges, result.similarity);
        std::vector<Index> loop =
            ring.cheapest(energy.costs(result.similarity), result.vertices, context);
        if (loop.empty()) break;
        edges = energy.edges_of(ring, loop);
        result.vertices = std::move(loop);
        note();
        const double before = least, now = report.energy.back();
        if (now < least) {
            least = now;
            best.vertices = result.vertices;
            best.similarity = result.similarity;
        }
        if (std::abs(before - now) <= options.tolerance * before) {
            report.stop = PasteStop::converged;
            break;
        }
        if (now > before) {
            report.stop = PasteStop::cycle;
            break;
        }
    }
    best.report = report;
    edges = energy.edges_of(ring, best.vertices);
    best.similarity = energy.improved(edges, best.similarity);
    if (report.outline_energy && energy.energy(edges, best.similarity) > *report.outline_energy) {
        best.vertices = regions.outer;
        best.similarity = energy.improved(outline, best.similarity);
        best.report.kept_outline = true;
        edges = outline;
    }
    best.energy = energy.energy(edges, best.similarity);
    best.misfit = energy.misfit(edges, best.similarity);
    best.report.scale = best.similarity.scale;
    best.report.loop_size = count_of(best.vertices);
    return best;
}

}  // namespace lissom
