#include "kernel/merge/loop/band_quality.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <unordered_set>
#include <utility>

#include "kernel/merge/loop/band_pinch.h"
#include "kernel/merge/loop/band_spike.h"
#include "kernel/merge/loop/crumpled_edges.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/loop/rim_flare.h"
#include "kernel/mesh/query/distances.h"

namespace lissom {
namespace {

// In radii of a seam: the band whose roughness counts, the one whose folds count, and the width of
// the strips that planes are fitted to. Within one radius the roughness of crumpled and of smooth
// bands differs less.
constexpr double kBand = 0.5, kFolds = 1.0, kStrip = 1.0 / 3.0;
// Angle of an edge at which the surface turns back, and of one at which it nearly did before: edges
// of thin parts turn by more or less as these bend, faces that turned over turn by nearly half a
// turn.
constexpr double kBandFolded = 135.0 * kDegree, kNearlyFolded = 105.0 * kDegree;
// Angle of an edge that shows by itself, as a slit, a ridge or a tooth.
constexpr double kSharpEdge = 60.0 * kDegree;
// Edges that turn by less are no creases of a shape but the grain of its surface; those of wrinkles
// turn by more than the second.
constexpr double kGrain = 40.0 * kDegree, kWrinkle = 25.0 * kDegree;
// Points of a seam at which planes are fitted, at most.
constexpr std::size_t kBandPlanes = 48;
// A side is flat that has less volume than this many cubes of the radius: a dome as steep as a
// third of a half sphere.
constexpr double kBandFlat = 0.7;

// Adds up edges by their lengths.
struct EdgeSum {
    double length = 0.0, squares = 0.0, sharp = 0.0, folded = 0.0, nearly_folded = 0.0;
    // Of the edges of the grain; and the length of those that turn like wrinkles or more.
    double grain_length = 0.0, grain_squares = 0.0, wrinkled = 0.0;

    void add(const Mesh& mesh, Index a, Index b) {
        const Index left = face_left_of(mesh.topology(), a, b);
        const Index right = face_left_of(mesh.topology(), b, a);
        if (left == kNoIndex || right == kNoIndex) return;
        const Vec3 n = clear_area_vector(mesh, left), m = clear_area_vector(mesh, right);
        if (!(n.squaredNorm() > 0.0 && m.squaredNorm() > 0.0)) return;
        const double angle = angle_between(n, m);
        const double edge = (mesh.position(b) - mesh.position(a)).norm();
        length += edge;
        squares += edge * angle * angle;
        if (angle < kGrain) {
            grain_length += edge;
            grain_squares += edge * angle * angle;
        }
        if (angle > kWrinkle) wrinkled += edge;
        if (angle > kSharpEdge) sharp += edge;
        if (angle > kBandFolded) folded += edge;
        if (angle > kNearlyFolded) nearly_folded += edge;
    }
    double rms() const { return length > 0.0 ? std::sqrt(squares / length) : 0.0; }
    double grain() const {
        return grain_length > 0.0 ? std::sqrt(grain_squares / grain_length) : 0.0;
    }
};

EdgeSum edges_of(const Mesh& mesh, std::span<const Index> faces,
                 const std::unordered_set<std::uint64_t>& left_out) {
    std::unordered_set<std::uint64_t> seen = left_out;
    EdgeSum sum;
    for (const Index f : faces) {
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            if (seen.insert(edge_key(a, b)).second) sum.add(mesh, std::min(a, b), std::max(a, b));
        }
    }
    return sum;
}

std::vector<Index> all_faces(const BandSide& side) {
    if (!side.faces.empty()) return {side.faces.begin(), side.faces.end()};
    std::vector<Index> faces(at(side.mesh->face_count()));
    for (Index f = 0; f < side.mesh->face_count(); ++f) faces[at(f)] = f;
    return faces;
}

Vec3 middle_of(const Mesh& mesh, std::span<const Index> loop) {
    Vec3 sum = Vec3::Zero();
    double length = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec3 &a = mesh.position(loop[k]), &b = mesh.position(loop[(k + 1) % loop.size()]);
        const double edge = (b - a).norm();
        sum += 0.5 * edge * (a + b);
        length += edge;
    }
    return length > 0.0 ? Vec3(sum / length) : Vec3(mesh.position(loop[0]));
}

double radius_of(const Mesh& mesh, std::span<const Index> loop, const Vec3& middle) {
    double squares = 0.0, length = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec3 &a = mesh.position(loop[k]), &b = mesh.position(loop[(k + 1) % loop.size()]);
        const double edge = (b - a).norm();
        squares += 0.5 * edge * ((a - middle).squaredNorm() + (b - middle).squaredNorm());
        length += edge;
    }
    return length > 0.0 ? std::sqrt(squares / length) : 0.0;
}

// A seam is judged by the angle that this part of its points exceed, so that a single one does not
// decide.
constexpr double kFewPoints = 0.1;

// Angles between planes on either side of points of a seam.
struct Bends {
    double rms = 0.0, greatest = 0.0;
};

Bends bends_between(std::span<const Vec3> first, std::span<const Vec3> second) {
    std::vector<double> angles;
    double squares = 0.0;
    for (std::size_t k = 0; k < std::min(first.size(), second.size()); ++k) {
        if (!(first[k].squaredNorm() > 0.0 && second[k].squaredNorm() > 0.0)) continue;
        const double angle = angle_between(first[k], second[k]);
        angles.push_back(angle);
        squares += angle * angle;
    }
    if (angles.empty()) return {};
    const double count = static_cast<double>(angles.size());
    const auto few = angles.end() - 1 - static_cast<std::ptrdiff_t>(kFewPoints * count);
    std::nth_element(angles.begin(), few, angles.end());
    return {std::sqrt(squares / count), *few};
}

// A shorter part of a seam that turns does not show.
constexpr double kSteepPart = 1.0 / 30.0;

// Angles of edges, and their lengths.
using AngledEdges = std::vector<std::pair<double, double>>;

void add_steep(const Mesh& mesh, Index a, Index b, AngledEdges& edges) {
    edges.emplace_back(edge_dihedral(mesh, a, b), (mesh.position(b) - mesh.position(a)).norm());
}

// The angle that this part of their length exceeds.
double steep_angle(AngledEdges edges) {
    double rest = 0.0;
    for (const auto& [angle, length] : edges) rest += kSteepPart * length;
    std::sort(edges.begin(), edges.end(), std::greater<>());
    for (const auto& [angle, length] : edges) {
        rest -= length;
        if (rest < 0.0) return angle;
    }
    return 0.0;
}

// That of the edges of a closed line.
double steep_line(const Mesh& mesh, std::span<const Index> loop) {
    AngledEdges edges;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        add_steep(mesh, loop[k], loop[(k + 1) % loop.size()], edges);
    }
    return steep_angle(std::move(edges));
}

// One side as it is measured: its loop's size, and how far its faces are from it.
class Side {
  public:
    Side(const BandSide& given, const Context& context)
        : mesh_(*given.mesh), loop_(given.loop), faces_(all_faces(given)) {
        middle_ = middle_of(mesh_, loop_);
        radius_ = radius_of(mesh_, loop_, middle_);
        distance_ = edge_distances(mesh_, loop_, kFolds * radius_, context);
        for (std::size_t k = 0; k < loop_.size(); ++k) {
            seam_.insert(edge_key(loop_[k], loop_[(k + 1) % loop_.size()]));
        }
    }

    const Mesh& mesh() const { return mesh_; }
    std::span<const Index> loop() const { return loop_; }
    const Vec3& middle() const { return middle_; }
    double radius() const { return radius_; }
    MadeRim rim() const { return {mesh_, faces_, loop_, distance_, radius_}; }

    double spike() const { return band_spike(mesh_, distance_, radius_); }

    // Width of the vertices that became thorns or pits, in radii.
    double pinched(std::span<const Vec3> rest) const {
        if (!(radius_ > 0.0)) return 0.0;
        double sum = 0.0;
        for (const Pinch& pinch : pinches({mesh_, rest, distance_, kBand * radius_})) {
            sum += pinch.width;
        }
        return sum / radius_;
    }

    // Sum over the faces with a vertex within that many radii, without the seam's edges.
    EdgeSum edges(double radii) const {
        std::vector<Index> near;
        for (const Index f : faces_) {
            if (nearest(f) <= radii * radius_) near.push_back(f);
        }
        return edges_of(mesh_, near, seam_);
    }

    // Of the edges of the faces that touch the loop.
    double steep_beside() const {
        std::vector<Index> touching;
        for (const Index f : faces_) {
            if (nearest(f) <= 0.0) touching.push_back(f);
        }
        return steep_dihedral(mesh_, touching);
    }

    // Directions of the planes through the faces whose middles lie in the strip from `begin` to
    // `end`, in radii from the loop, and no farther than that from one of its points.
    std::vector<Vec3> planes(double begin, double end) const {
        std::vector<std::pair<Vec3, Vec3>> strip;
        for (const Index f : faces_) {
            const double far = middle_distance(f);
            if (far < begin * radius_ || far > end * radius_) continue;
            strip.emplace_back(center_of(f), area_vector(mesh_, f));
        }
        std::vector<Vec3> result;
        const std::size_t step = std::max<std::size_t>(1, loop_.size() / kBandPlanes);
        for (std::size_t k = 0; k < loop_.size(); k += step) {
            const Vec3& from = mesh_.position(loop_[k]);
            Vec3 sum = Vec3::Zero();
            for (const auto& [center, area] : strip) {
                if ((center - from).norm() <= end * radius_) sum += area;
            }
            result.push_back(sum);
        }
        return result;
    }

    // Between the planes of the strip at the loop and of the one behind it.
    Bends own_bends() const {
        return bends_between(planes(0.0, kStrip), planes(kStrip, 2.0 * kStrip));
    }

    // Between the surface and a point.
    double volume(const Vec3& apex) const {
        double volume = 0.0;
        for (const Index f : faces_) {
            const Vec3 arm = mesh_.position(mesh_.topology().face(f)[0]) - apex;
            volume += arm.dot(area_vector(mesh_, f)) / 6.0;
        }
        return volume;
    }

  private:
    double nearest(Index f) const {
        double least = INFINITY;
        for (const Index v : mesh_.topology().face(f)) least = std::min(least, distance_[at(v)]);
        return least;
    }
    double middle_distance(Index f) const {
        double sum = 0.0;
        for (const Index v : mesh_.topology().face(f)) sum += distance_[at(v)];
        return sum / static_cast<double>(mesh_.topology().face(f).size());
    }
    Vec3 center_of(Index f) const {
        Vec3 sum = Vec3::Zero();
        for (const Index v : mesh_.topology().face(f)) sum += mesh_.position(v);
        return sum / static_cast<double>(mesh_.topology().face(f).size());
    }

    const Mesh& mesh_;
    std::span<const Index> loop_;
    std::vector<Index> faces_;
    std::vector<double> distance_;
    std::unordered_set<std::uint64_t> seam_;
    Vec3 middle_ = Vec3::Zero();
    double radius_ = 0.0;
};

// The edges of both sides.
struct EdgeSums {
    EdgeSum target, source;

    double rms(double source_size) const {
        const double length = target.length + source_size * source.length;
        const double squares = target.squares + source_size * source.squares;
        return length > 0.0 ? std::sqrt(squares / length) : 0.0;
    }
};

void note_roughness(const EdgeSums& made, const EdgeSums& rest, double scale, BandQuality& band) {
    band.roughness = made.rms(1.0);
    band.rest_roughness = rest.rms(scale);
    band.source_roughness = made.source.rms();
    band.rest_source_roughness = rest.source.rms();
    band.target_roughness = made.target.rms();
    band.rest_target_roughness = rest.target.rms();
    band.source_grain = made.source.grain();
    band.rest_source_grain = rest.source.grain();
    band.target_grain = made.target.grain();
    band.rest_target_grain = rest.target.grain();
}

// What the edges of a side gained in such length, in radii.
double gained(const Side& made, const Side& rest, double EdgeSum::*length) {
    if (!(made.radius() > 0.0 && rest.radius() > 0.0)) return 0.0;
    const double now = made.edges(kBand).*length / made.radius();
    return std::max(0.0, now - rest.edges(kBand).*length / rest.radius());
}

// Part of the volume that was kept, for surfaces that are inside out as well.
double volume_kept(double after, double before, double radius) {
    return std::abs(before) > kBandFlat * radius * radius * radius ? after / before : 1.0;
}

}  // namespace

double loop_radius(const Mesh& mesh, std::span<const Index> loop) {
    return radius_of(mesh, loop, middle_of(mesh, loop));
}

double rms_dihedral(const Mesh& mesh, std::span<const Index> faces) {
    return edges_of(mesh, faces, {}).rms();
}

double steep_dihedral(const Mesh& mesh, std::span<const Index> faces) {
    AngledEdges edges;
    std::unordered_set<std::uint64_t> seen;
    for (const Index f : faces) {
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            const bool open = face_left_of(mesh.topology(), b, a) == kNoIndex;
            if (!open && seen.insert(edge_key(a, b)).second) add_steep(mesh, a, b, edges);
        }
    }
    return steep_angle(std::move(edges));
}

BandQuality band_quality(const BandSide& made_target, const BandSide& made_source,
                         const BandSide& target, const BandSide& source, double scale, bool stays,
                         const Context& context) {
    const Side on_target(made_target, context), on_source(made_source, context);
    const Side old_target(target, context), old_source(source, context);
    BandQuality result;
    result.radius = on_target.radius();
    note_roughness({on_target.edges(kBand), on_source.edges(kBand)},
                   {old_target.edges(kBand), old_source.edges(kBand)}, scale, result);
    result.steep = steep_line(*made_target.mesh, made_target.loop);
    result.rest_steep = std::max(old_target.steep_beside(), old_source.steep_beside());
    const Bends across =
        bends_between(on_target.planes(0.0, kStrip), on_source.planes(0.0, kStrip));
    const Bends own[] = {old_target.own_bends(), old_source.own_bends()};
    result.bend = across.rms;
    result.max_bend = across.greatest;
    result.rest_bend = std::max(own[0].rms, own[1].rms);
    result.rest_max_bend = std::max(own[0].greatest, own[1].greatest);
    const auto folds = [](const Side& side, double EdgeSum::*length) {
        return side.radius() > 0.0 ? side.edges(kFolds).*length / side.radius() : 0.0;
    };
    result.folded = folds(on_target, &EdgeSum::folded) + folds(on_source, &EdgeSum::folded);
    result.rest_folded =
        folds(old_target, &EdgeSum::nearly_folded) + folds(old_source, &EdgeSum::nearly_folded);
    result.sharpened = std::max(gained(on_target, old_target, &EdgeSum::sharp),
                                gained(on_source, old_source, &EdgeSum::sharp));
    result.wrinkled = gained(on_source, old_source, &EdgeSum::wrinkled);
    result.spike = on_target.spike();
    result.rest_spike = std::max(old_target.spike(), old_source.spike());
    if (!made_source.rest.empty()) {
        result.crumpled += crumpled_length(on_source.rim(), made_source.rest);
    }
    if (!made_target.rest.empty()) {
        result.crumpled += crumpled_length(on_target.rim(), made_target.rest);
    }
    if (!made_source.rest.empty()) result.pinched = on_source.pinched(made_source.rest);
    if (!made_source.rest.empty() && !made_source.meets_at_crease) {
        const bool inside_out = old_source.volume(old_source.middle()) < 0.0;
        result.flare = rim_flare(on_source.rim(), made_source.rest, inside_out);
    }
    const Vec3& middle = on_target.middle();
    if (!target.is_piece) {
        result.target_volume = volume_kept(on_target.volume(middle),
                                           old_target.volume(old_target.middle()), result.radius);
    }
    const double rest = stays ? old_source.volume(middle)
                              : scale * scale * scale * old_source.volume(old_source.middle());
    result.source_volume = volume_kept(on_source.volume(middle), rest, result.radius);
    return result;
}

}  // namespace lissom
