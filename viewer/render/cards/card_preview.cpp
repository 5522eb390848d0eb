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

struct MeanTexel {
    Vec3 color = Vec3::Zero();
    double alpha = 0.0;
};

// The mean over a rectangle of texture coordinates; colours count by their alpha.
MeanTexel mean_over(const Image& image, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
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
            weights += weight;
        }
    }
    mean.color /= weights;
    mean.alpha /= (x1 - x0 + 1.0) * (y1 - y0 + 1.0);
    return mean;
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

    void add_cap() {
        const auto count = count_of(cards_.cap.positions);
        if (count == 0) return;
        const CardSlot& slot = cards_.slots.back();
        const Vec3 color = mean_over(atlas_.color, slot.low, slot.high).color;
        const auto first = count_of(positions_);
        for (Index v = 0; v < count; ++v) positions_.push_back(surface_.position(first_ + v));
        for (const Triangle& t : cards_.cap.triangles) {
            double cover = 0.0;
            for (const Index v : t) cover += cards_.cap.cover[at(v)] / 3.0;
            if (cover < options_.cutoff) continue;
            faces_.add({first + t[0], first + t[1], first + t[2]});
            add_color(color * light(first_ + t[0]));
        }
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
        const CardSlot& slot = cards_.slots[at(card.slot)];
        const Eigen::Vector2d size = slot.high - slot.low;
        const Eigen::Vector2d low(slot.low.x() + u0 * size.x(), slot.high.y() - v1 * size.y());
        const Eigen::Vector2d high(slot.low.x() + u1 * size.x(), slot.high.y() - v0 * size.y());
        const MeanTexel texel = mean_over(atlas_.color, low, high);
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

}  // namespace

Mesh card_preview(const HairCards& cards, const Mesh& surface, const CardAtlas& atlas,
                  const CardPreviewOptions& options, const Context& context) {
    require(options.across >= 2 && options.across <= 256, "a preview has 2 to 256 faces across");
    PreviewMaker maker(cards, surface, atlas, options);
    for (std::size_t c = 0; c < cards.cards.size(); ++c) maker.add_card(c);
    maker.add_cap();
    return maker.finish(context);
}

}  // namespace lissom
