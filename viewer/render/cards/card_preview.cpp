#include "viewer/render/cards/card_preview.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/mesh/repair/repair.h"
#include "viewer/render/draw/image/color.h"

namespace lissom {
namespace {

// Length of a face over its width.
constexpr double kFaceAspect = 3.0;
// Step along a ribbon over its width, and the part of texels below which it ends.
constexpr double kRibbonAspect = 4.0, kLeastShown = 0.05;

struct MeanTexel {
    Vec3 color = Vec3::Zero();
    double alpha = 0.0;
    // Part of the texels whose alpha reaches the cutoff.
    double shown = 0.0;
};

// The mean over a rectangle of texture coordinates; colours count by their alpha.
MeanTexel mean_over(const Image& image, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                    double cutoff) {
    const auto texel = [](double x, int size) {
        return std::clamp(static_cast<int>(std::floor(x * size)), 0, size - 1);
    };
    const int x0 = texel(low.x(), image.width), x1 = texel(high.x(), image.width);
    const int y0 = texel(1.0 - high.y(), image.height), y1 = texel(1.0 - low.y(), image.height);
    MeanTexel mean;
    double weights = 0.0;
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const std::uint8_t* const p = image.pixel(x, y);
            const double weight = p[3] + 1e-3;
            for (int c = 0; c < 3; ++c) mean.color[c] += weight * srgb_to_linear(p[c] / 255.0);
            mean.alpha += p[3] / 255.0;
            mean.shown += p[3] >= 255.0 * cutoff ? 1.0 : 0.0;
            weights += weight;
        }
    }
    mean.color /= weights;
    const double count = (x1 - x0 + 1.0) * (y1 - y0 + 1.0);
    mean.alpha /= count;
    mean.shown /= count;
    return mean;
}

// A part of the slot of a card, u and v from 0 to 1.
MeanTexel mean_on_card(const HairCards& cards, const Card& card, const Image& image,
                       const Eigen::Vector2d& from, const Eigen::Vector2d& to, double cutoff) {
    const CardSlot& slot = cards.slots[at(card.slot)];
    const Eigen::Vector2d size = slot.high - slot.low;
    const Eigen::Vector2d low(slot.low.x() + from.x() * size.x(),
                              slot.high.y() - to.y() * size.y());
    const Eigen::Vector2d high(slot.low.x() + to.x() * size.x(),
                               slot.high.y() - from.y() * size.y());
    return mean_over(image, low, high, cutoff);
}

class PreviewMaker {
  public:
    PreviewMaker(const HairCards& cards, const Mesh& surface, const CardAtlas& atlas,
                 const CardPreviewOptions& options)
        : cards_(cards), surface_(surface), atlas_(atlas), options_(options) {}

    void add_card(std::size_t c) {
        const Card& card = cards_.cards[c];
        double width = 0.0;
        for (const CardSection& section : card.sections) width += 2.0 * section.half_width;
        width /= static_cast<double>(card.sections.size());
        const double face = kFaceAspect * width / options_.across;
        const int along = std::clamp(static_cast<int>(card.length() / face), 8, 2000);
        for (int j = 0; j < along; ++j) {
            for (int i = 0; i < options_.across; ++i) {
                add_face(card, 1.0 * i / options_.across, 1.0 * (i + 1) / options_.across,
                         1.0 * j / along, 1.0 * (j + 1) / along);
            }
        }
        first_ += 2 * index_of(card.sections.size());
    }

    void skip_cards() {
        for (const Card& card : cards_.cards) first_ += 2 * index_of(card.sections.size());
    }

    void add_cap() {
        if (cards_.cap.positions.empty()) return;
        const CardSlot& slot = cards_.slots.back();
        const Vec3 color = mean_over(atlas_.color, slot.low, slot.high, options_.cutoff).color;
        for (const Triangle& t : cards_.cap.triangles) add_cap_part(t, color);
    }

    Mesh finish(const Context& context) {
        Attribute attribute;
        attribute.name = "color";
        attribute.domain = Domain::face;
        attribute.width = 3;
        attribute.values = std::move(colors_);
        Soup soup;
        soup.positions = std::move(positions_);
        soup.faces = std::move(faces_);
        soup.attributes.add(std::move(attribute));
        // Where the edge of a cap is cut off, faces may touch at vertices alone.
        RepairOptions options;
        options.weld = Weld::none;
        return repair(std::move(soup), options, context);
    }

  private:
    // The part of a triangle of the cap whose cover reaches the cutoff.
    void add_cap_part(const Triangle& t, const Vec3& color) {
        const auto first = count_of(positions_);
        double shine = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const Index v = t[c], next = t[(c + 1) % 3];
            const double here = cards_.cap.cover[at(v)] - options_.cutoff;
            const double there = cards_.cap.cover[at(next)] - options_.cutoff;
            const Vec3 p = surface_.position(first_ + v), q = surface_.position(first_ + next);
            shine += light(first_ + v) / 3.0;
            if (here >= 0.0) positions_.push_back(p);
            if ((here >= 0.0) == (there >= 0.0)) continue;
            const double part = here / (here - there);
            if (part > 0.0 && part < 1.0) positions_.push_back(p + part * (q - p));
        }
        std::vector<Index> face;
        for (Index v = first; v < count_of(positions_); ++v) face.push_back(v);
        if (face.size() < 3) {
            positions_.resize(at(first));
            return;
        }
        faces_.add(face);
        add_color(color * shine);
    }

    double light(Index vertex) const {
        const Attribute* const colors = surface_.attributes().find("color");
        return 0.8 + 0.2 * colors->at(vertex)[0];
    }

    void add_color(const Vec3& linear) {
        for (const double x : linear) colors_.push_back(linear_to_srgb(std::clamp(x, 0.0, 1.0)));
    }

    // A point of the surface and the light there, u and v from 0 to 1.
    std::pair<Vec3, double> point_at(const Card& card, double u, double v) const {
        const auto last = static_cast<double>(card.sections.size() - 1);
        const auto k = std::min(static_cast<Index>(v * last), static_cast<Index>(last) - 1);
        const double part = v * last - k;
        const Index a = first_ + 2 * k;
        const auto place = [&](Index left) -> Vec3 {
            const Vec3 p = surface_.position(left), q = surface_.position(left + 1);
            return p + u * (q - p);
        };
        const auto shine = [&](Index left) {
            return light(left) + u * (light(left + 1) - light(left));
        };
        const Vec3 p = place(a), q = place(a + 2);
        return {p + part * (q - p), shine(a) + part * (shine(a + 2) - shine(a))};
    }

    void add_face(const Card& card, double u0, double u1, double v0, double v1) {
        const MeanTexel texel =
            mean_on_card(cards_, card, atlas_.color, {u0, v0}, {u1, v1}, options_.cutoff);
        if (texel.alpha < options_.cutoff) return;
        const auto first = count_of(positions_);
        double shine = 0.0;
        for (const auto& [u, v] : {std::pair(u0, v0), {u0, v1}, {u1, v1}, {u1, v0}}) {
            const auto [point, open] = point_at(card, u, v);
            positions_.push_back(point);
            shine += 0.25 * open;
        }
        add_outward(first, 0.5 * (v0 + v1), card);
        add_color(texel.color * shine);
    }

    // The quad of four new vertices, its front as the normals of the card, which bend from the
    // head.
    void add_outward(Index first, double v, const Card& card) {
        const auto corner = [&](Index i) { return positions_[at(first + i)]; };
        const Vec3 front = (corner(2) - corner(0)).cross(corner(3) - corner(1));
        if (front.dot(normal_of(card, v)) >= 0.0) {
            faces_.add({first, first + 1, first + 2, first + 3});
        } else {
            faces_.add({first + 3, first + 2, first + 1, first});
        }
    }

    // The normal of the surface at the section nearest to v.
    Vec3 normal_of(const Card& card, double v) const {
        const auto last = static_cast<double>(card.sections.size() - 1);
        const auto n =
            surface_.attributes().find("normal")->at(first_ + 2 * index_of(std::lround(v * last)));
        return {n[0], n[1], n[2]};
    }

    const HairCards& cards_;
    const Mesh& surface_;
    const CardAtlas& atlas_;
    const CardPreviewOptions& options_;
    // The first vertex of the card in `surface_`.
    Index first_ = 0;
    std::vector<Vec3> positions_;
    FaceList faces_;
    std::vector<double> colors_;
};

// The parts of cards that show, as ribbons along them.
class RibbonMaker {
  public:
    RibbonMaker(const HairCards& cards, const CardAtlas& atlas, const CardPreviewOptions& options)
        : cards_(cards), atlas_(atlas), options_(options) {}

    void add_card(const Card& card) {
        double width = 0.0;
        for (const CardSection& section : card.sections) width += 2.0 * section.half_width;
        width /= static_cast<double>(card.sections.size());
        const double step = kRibbonAspect * width / options_.across;
        const int along = std::clamp(static_cast<int>(card.length() / step), 8, 64);
        for (int i = 0; i < options_.across; ++i) add_column(card, i, along);
    }

    Strands finish(const Context& context) {
        Strands strands(std::move(points_), std::move(offsets_), context.memory());
        strands.set_widths(std::move(widths_));
        strands.set_colors(std::move(colors_));
        return strands;
    }

  private:
    // Each run of parts that show is a ribbon, from the middle of the first to that of the last.
    void add_column(const Card& card, int column, int along) {
        const double u0 = 1.0 * column / options_.across, u1 = 1.0 * (column + 1) / options_.across;
        for (int j = 0; j < along; ++j) {
            const double v0 = 1.0 * j / along, v1 = 1.0 * (j + 1) / along;
            const MeanTexel texel =
                mean_on_card(cards_, card, atlas_.color, {u0, v0}, {u1, v1}, options_.cutoff);
            if (texel.shown > kLeastShown) {
                add_point(card, u0 + u1 - 1.0, 0.5 * (v0 + v1), texel);
            } else {
                end_ribbon();
            }
        }
        end_ribbon();
    }

    void add_point(const Card& card, double u, double v, const MeanTexel& texel) {
        const auto last = static_cast<double>(card.sections.size() - 1);
        const auto k = static_cast<std::size_t>(std::min(v * last, last - 1.0));
        const double part = v * last - static_cast<double>(k);
        const auto place = [&](const CardSection& s) -> Vec3 {
            return s.center + u * s.half_width * s.across;
        };
        const CardSection &a = card.sections[k], &b = card.sections[k + 1];
        const Vec3 p = place(a) + part * (place(b) - place(a));
        const double half = a.half_width + part * (b.half_width - a.half_width);
        for (const double x : p) points_.push_back(static_cast<float>(x));
        widths_.values.push_back(static_cast<float>(texel.shown * 2.0 * half / options_.across));
        colors_.values.push_back(texel.color.cast<float>());
    }

    // Drops a ribbon of one point.
    void end_ribbon() {
        const auto count = index_of(points_.size() / 3);
        if (count - offsets_.back() > 1) {
            offsets_.push_back(count);
        } else {
            points_.resize(3 * at(offsets_.back()));
            widths_.values.resize(at(offsets_.back()));
            colors_.values.resize(at(offsets_.back()));
        }
    }

    const HairCards& cards_;
    const CardAtlas& atlas_;
    const CardPreviewOptions& options_;
    std::vector<float> points_;
    std::vector<Index> offsets_ = {0};
    StrandWidths widths_ = point_widths();
    StrandValues<Eigen::Vector3f> colors_{Eigen::Vector3f::Zero(), StrandDomain::point};

    static StrandWidths point_widths() {
        StrandWidths widths;
        widths.domain = StrandDomain::point;
        return widths;
    }
};

void require_preview(const CardPreviewOptions& options) {
    require(options.across >= 2 && options.across <= 256, "a preview has 2 to 256 parts across");
}

}  // namespace

Mesh card_preview(const HairCards& cards, const Mesh& surface, const CardAtlas& atlas,
                  const CardPreviewOptions& options, const Context& context) {
    require_preview(options);
    PreviewMaker maker(cards, surface, atlas, options);
    for (std::size_t c = 0; c < cards.cards.size(); ++c) maker.add_card(c);
    maker.add_cap();
    return maker.finish(context);
}

Mesh cap_preview(const HairCards& cards, const Mesh& surface, const CardAtlas& atlas,
                 const CardPreviewOptions& options, const Context& context) {
    PreviewMaker maker(cards, surface, atlas, options);
    maker.skip_cards();
    maker.add_cap();
    return maker.finish(context);
}

Strands card_ribbons(const HairCards& cards, const CardAtlas& atlas,
                     const CardPreviewOptions& options, const Context& context) {
    require_preview(options);
    RibbonMaker maker(cards, atlas, options);
    for (const Card& card : cards.cards) {
        context.checkpoint();
        maker.add_card(card);
    }
    return maker.finish(context);
}

}  // namespace lissom
