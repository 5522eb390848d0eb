#include "kernel/hair/levels/hair_silhouette.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// Metres around the hair that a level may reach out.
constexpr double kSilhouetteRoom = 0.05;
constexpr int kMostPixels = 2000;
// Optical depth of a pixel that is covered by half.
constexpr double kHalfCovered = 0.6931471805599453;
constexpr double kRaised = kPi / 6.0;

void require_silhouette_options(const Strands& hair, const SilhouetteOptions& options) {
    require(options.views >= 1 && options.views <= 64, "silhouettes need 1 to 64 views");
    require(options.pixel >= 0.0005 && options.pixel <= 0.1,
            "the pixel of silhouettes must be 0.0005 to 0.1 metres");
    Elements bad{ElementKind::strand, 0, {}};
    for (Index s = 0; s < hair.size(); ++s) {
        if (!hair.strand(s).allFinite()) bad.add(s);
    }
    if (bad.count == 0) return;
    const std::string names = describe(bad);
    throw Error(ErrorCode::not_finite, names + ": points are not finite", std::move(bad));
}

// Adds the part `area` of a pixel's area to the four pixels around a place.
void splat(const Eigen::Vector2d& p, float area, const Eigen::Array2i& size,
           std::vector<float>& depth) {
    const Eigen::Array2d corner = p.array() - 0.5;
    const Eigen::Array2i low = corner.floor().cast<int>();
    const Eigen::Array2d u = corner - low.cast<double>();
    for (int c = 0; c < 4; ++c) {
        const Eigen::Array2i pixel = low + Eigen::Array2i(c & 1, c >> 1);
        if ((pixel < 0).any() || (pixel >= size).any()) continue;
        const double weight =
            ((c & 1) != 0 ? u[0] : 1.0 - u[0]) * ((c >> 1) != 0 ? u[1] : 1.0 - u[1]);
        depth[at(pixel[1]) * at(size[0]) + at(pixel[0])] += static_cast<float>(weight) * area;
    }
}

double cross_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

// Marks pixels whose centres lie in a triangle.
void fill_triangle(const std::array<Eigen::Vector2d, 3>& t, const Eigen::Array2i& size,
                   std::vector<char>& covered) {
    const Eigen::Array2d low = t[0].cwiseMin(t[1]).cwiseMin(t[2]).array().max(0.0);
    const Eigen::Array2d high =
        t[0].cwiseMax(t[1]).cwiseMax(t[2]).array().min(size.cast<double>() - 1.0);
    const double area = cross_of(t[1] - t[0], t[2] - t[0]);
    if (area == 0.0 || !((low <= high).all())) return;
    for (int y = static_cast<int>(low[1]); y <= high[1]; ++y) {
        for (int x = static_cast<int>(low[0]); x <= high[0]; ++x) {
            const Eigen::Vector2d p(x + 0.5, y + 0.5);
            bool inside = true;
            for (std::size_t c = 0; c < 3; ++c) {
                inside = inside && cross_of(t[(c + 1) % 3] - t[c], p - t[c]) * area >= 0.0;
            }
            if (inside) covered[at(y) * at(size[0]) + at(x)] = 1;
        }
    }
}

// The place on a card at `v` along and `u` across.
Vec3 place_on(const Card& card, double u, double v) {
    const double along = std::clamp(v, 0.0, 1.0) * static_cast<double>(card.sections.size() - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(along), card.sections.size() - 2);
    const double t = along - static_cast<double>(k);
    const auto edge = [&](const CardSection& s) -> Vec3 {
        return s.center + std::clamp(u, -1.0, 1.0) * s.half_width * s.across;
    };
    return (1.0 - t) * edge(card.sections[k]) + t * edge(card.sections[k + 1]);
}

double mean_width(const Card& card) {
    double sum = 0.0;
    for (const CardSection& section : card.sections) sum += section.half_width;
    return sum / static_cast<double>(card.sections.size());
}

}  // namespace

HairSilhouette::HairSilhouette(const Strands& hair, const SilhouetteOptions& options,
                               const Context& context)
    : pixel_(options.pixel) {
    require_silhouette_options(hair, options);
    Progress progress(context, "silhouettes of hair");
    const Box box = bounds(hair);
    require(!box.empty(), "silhouettes need hair");
    const double reach = 0.5 * (box.max - box.min).norm() + kSilhouetteRoom;
    pixel_ = std::max(pixel_, 2.0 * reach / kMostPixels);
    const int side = 1 + static_cast<int>(2.0 * reach / pixel_);
    for (Index i = 0; i < 2 * options.views; ++i) {
        const double turn = 2.0 * kPi * (i % options.views) / options.views;
        const double raised = i < options.views ? 0.0 : kRaised;
        const Vec3 back(std::sin(turn) * std::cos(raised), std::sin(raised),
                        std::cos(turn) * std::cos(raised));
        View view;
        view.right = Vec3(std::cos(turn), 0.0, -std::sin(turn));
        view.up = back.cross(view.right);
        const Vec3 middle = box.center();
        view.origin = Eigen::Vector2d(view.right.dot(middle), view.up.dot(middle)) -
                      Eigen::Vector2d::Constant(reach);
        view.size = Eigen::Array2i::Constant(side);
        views_.push_back(std::move(view));
    }
    context.parallel_for(0, count_of(views_), 1, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            View& view = views_[at(i)];
            view.covered = covered_by(view, hair, 1.0);
            view.count = at(std::count(view.covered.begin(), view.covered.end(), 1));
        }
    });
    for (const View& view : views_) {
        require(view.count > 0,
                "the hair covers no pixel by half; widen it, or take a larger pixel");
    }
}

Eigen::Vector2d HairSilhouette::pixel_of(const View& view, const Vec3& point) const {
    return (Eigen::Vector2d(view.right.dot(point), view.up.dot(point)) - view.origin) / pixel_;
}

std::vector<char> HairSilhouette::covered_by(const View& view, const Strands& strands,
                                             double widen) const {
    std::vector<float> depth(at(view.size.prod()), 0.0f), widths;
    for (Index s = 0; s < strands.size(); ++s) {
        const StrandView strand = strands.strand(s);
        widths_of(strands, s, widths);
        for (Index k = 0; k + 1 < strand.cols(); ++k) {
            const Eigen::Vector2d a = pixel_of(view, point_of(strand, k)),
                                  b = pixel_of(view, point_of(strand, k + 1));
            const double length = (b - a).norm();
            if (!(length > 0.0) || !(length < 2.0 * kMostPixels)) continue;
            const int pieces = 1 + static_cast<int>(2.0 * length);
            const double width = 0.5 * (widths[at(k)] + widths[at(k + 1)]) * widen / pixel_;
            for (int i = 0; i < pieces; ++i) {
                splat(a + (i + 0.5) / pieces * (b - a), static_cast<float>(width * length / pieces),
                      view.size, depth);
            }
        }
    }
    std::vector<char> covered(depth.size());
    for (std::size_t i = 0; i < depth.size(); ++i) covered[i] = depth[i] > kHalfCovered ? 1 : 0;
    return covered;
}

std::vector<char> HairSilhouette::covered_by(const View& view, const Mesh& mesh) const {
    std::vector<char> covered(at(view.size.prod()), 0);
    for (const Triangle& t : triangulate_faces(mesh.topology(), mesh.positions()).triangles) {
        fill_triangle({pixel_of(view, mesh.position(t[0])), pixel_of(view, mesh.position(t[1])),
                       pixel_of(view, mesh.position(t[2]))},
                      view.size, covered);
    }
    return covered;
}

template <typename Cover>
SilhouetteError HairSilhouette::compare_views(const Cover& cover, const Context& context) const {
    std::vector<double> parts(views_.size());
    context.parallel_for(0, count_of(views_), 1, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const View& view = views_[at(i)];
            const std::vector<char> other = cover(view);
            std::size_t apart = 0;
            for (std::size_t p = 0; p < other.size(); ++p) {
                apart += other[p] != view.covered[p] ? 1 : 0;
            }
            parts[at(i)] = static_cast<double>(apart) / static_cast<double>(view.count);
        }
    });
    SilhouetteError error;
    for (const double part : parts) {
        error.mean += part / static_cast<double>(parts.size());
        error.worst = std::max(error.worst, part);
    }
    return error;
}

SilhouetteError HairSilhouette::compare(const Strands& level, double widen,
                                        const Context& context) const {
    require(widen > 0.0 && std::isfinite(widen), "the factor of widths must be finite and above 0");
    return compare_views([&](const View& view) { return covered_by(view, level, widen); }, context);
}

SilhouetteError HairSilhouette::compare(const Mesh& level, const Context& context) const {
    return compare_views([&](const View& view) { return covered_by(view, level); }, context);
}

SilhouetteError HairSilhouette::compare(const HairCards& cards, const Strands& strands,
                                        const Context& context) const {
    return compare(shown_by(cards, strands, context), 1.0, context);
}

Strands shown_by(const HairCards& cards, const Strands& strands, const Context& context) {
    std::vector<float> points;
    std::vector<Index> offsets = {0};
    StrandWidths widths;
    widths.domain = StrandDomain::point;
    std::vector<float> own;
    for (const Card& card : cards.cards) {
        const Card& shown = cards.cards[at(cards.slots[at(card.slot)].card)];
        const auto widen = static_cast<float>(mean_width(card) / std::max(mean_width(shown), 1e-9));
        for (const Index s : shown.strands) {
            widths_of(strands, s, own);
            const StrandView strand = strands.strand(s);
            for (Index k = 0; k < strand.cols(); ++k) {
                const CardPoint place = place_on_card(shown, point_of(strand, k));
                const Vec3 p = place_on(card, place.u, place.v);
                for (const double x : p) points.push_back(static_cast<float>(x));
                widths.values.push_back(widen * own[at(k)]);
            }
            offsets.push_back(index_of(points.size() / 3));
        }
    }
    Strands result(std::move(points), std::move(offsets), context.memory());
    result.set_widths(std::move(widths));
    return result;
}

}  // namespace lissom
