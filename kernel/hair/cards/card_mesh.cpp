#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/cards/card_light.h"
#include "kernel/hair/cards/hair_cards.h"

namespace lissom {
namespace {

constexpr Index kLightGrain = 64;

// Metres.
constexpr double kNormalStep = 2e-3;

// The vertices of all cards and of the cap.
struct CardArrays {
    std::vector<Vec3> positions;
    FaceList faces;
    std::vector<double> uvs, normals, tangents, colors, marks;

    void add(const Vec3& p, const Eigen::Vector2d& uv, const Vec3& normal, const Vec3& tangent) {
        positions.push_back(p);
        for (const double x : uv) uvs.push_back(x);
        for (const double x : normal) normals.push_back(x);
        for (const double x : tangent) tangents.push_back(x);
        tangents.push_back(1.0);
    }
    void color(double along, double id, double cover) {
        for (const double x : {1.0, 1.0, 1.0, cover}) colors.push_back(x);
        for (const double x : {1.0, along, id}) marks.push_back(x);
    }
};

Vec3 course_at(const Card& card, std::size_t k) {
    const std::size_t last = card.sections.size() - 1;
    const Vec3 along =
        card.sections[std::min(k + 1, last)].center - card.sections[k == 0 ? 0 : k - 1].center;
    return along.norm() > 0.0 ? Vec3(along.normalized()) : Vec3(-Vec3::UnitY());
}

// A number from 0 to 1 that differs much between neighbours (the golden ratio's multiples).
double number_of_card(std::size_t card) {
    return std::fmod(0.6180339887498949 * static_cast<double>(card) + 0.5, 1.0);
}

void add_card(const HairCards& cards, std::size_t c, const CardOptions& options, const Vec3& middle,
              CardArrays& arrays) {
    const Card& card = cards.cards[c];
    const CardSlot& slot = cards.slots[at(card.slot)];
    const Eigen::Vector2d size = slot.high - slot.low;
    const auto first = count_of(arrays.positions);
    const std::size_t n = card.sections.size();
    for (std::size_t k = 0; k < n; ++k) {
        const CardSection& section = card.sections[k];
        const double v = static_cast<double>(k) / static_cast<double>(n - 1);
        const Vec3 along = course_at(card, k);
        for (const double u : {-1.0, 1.0}) {
            const Vec3 p = section.center + u * section.half_width * section.across;
            const Vec3 away = away_from_head(options.distance, middle, p, kNormalStep);
            Vec3 normal = (1.0 - options.bend) * section.out + options.bend * away;
            normal -= 0.5 * normal.dot(along) * along;
            const Eigen::Vector2d uv(slot.low.x() + 0.5 * (u + 1.0) * size.x(),
                                     slot.high.y() - v * size.y());
            normal = normal.norm() > 0.0 ? Vec3(normal.normalized()) : section.out;
            arrays.add(p, uv, normal, along);
            arrays.color(v, number_of_card(c), 1.0);
        }
    }
    for (Index k = 0; k + 1 < index_of(n); ++k) {
        const Index a = first + 2 * k;
        arrays.faces.add({a, a + 2, a + 1});
        arrays.faces.add({a + 1, a + 2, a + 3});
    }
}

void add_cap_to(const HairCards& cards, CardArrays& arrays) {
    const CardCap& cap = cards.cap;
    if (cap.positions.empty()) return;
    const CardSlot& slot = cards.slots.back();
    const Eigen::Vector2d size = slot.high - slot.low;
    const auto first = count_of(arrays.positions);
    for (std::size_t v = 0; v < cap.positions.size(); ++v) {
        const Vec3& normal = cap.normals[v];
        Vec3 down = -Vec3::UnitY() + normal.y() * normal;
        down = down.norm() > 1e-6 ? Vec3(down.normalized()) : Vec3(Vec3::UnitZ());
        const Eigen::Vector2d uv(slot.low.x() + cap.places[v].x() * size.x(),
                                 slot.high.y() - cap.places[v].y() * size.y());
        arrays.add(cap.positions[v], uv, normal, down);
        arrays.color(0.0, 1.0, cap.cover[v]);
    }
    for (const Triangle& t : cap.triangles) {
        arrays.faces.add({first + t[0], first + t[1], first + t[2]});
    }
}

Attribute values_of(const std::string& name, Index width, std::vector<double> values) {
    Attribute attribute;
    attribute.name = name;
    attribute.width = width;
    attribute.values = std::move(values);
    return attribute;
}

void add_light(const Strands& strands, const Context& context, CardArrays& arrays) {
    const HairDensity density(strands);
    context.parallel_for(0, count_of(arrays.positions), kLightGrain, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            const double open = density.openness(arrays.positions[at(v)]);
            for (std::size_t c = 0; c < 3; ++c) arrays.colors[4 * at(v) + c] = open;
            arrays.marks[3 * at(v)] = open;
        }
    });
}

}  // namespace

Mesh card_mesh(const HairCards& cards, const Strands& strands, const CardOptions& options,
               const Context& context) {
    CardArrays arrays;
    Vec3 middle = Vec3::Zero();
    for (const Card& card : cards.cards) middle += card.sections.front().center;
    middle /= static_cast<double>(std::max<std::size_t>(cards.cards.size(), 1));
    for (std::size_t c = 0; c < cards.cards.size(); ++c) {
        add_card(cards, c, options, middle, arrays);
    }
    add_cap_to(cards, arrays);
    add_light(strands, context, arrays);
    const Index faces = arrays.faces.size();
    Mesh mesh(std::move(arrays.positions), std::move(arrays.faces), context);
    mesh.attributes().add(values_of("uv", 2, std::move(arrays.uvs)));
    mesh.attributes().add(values_of("normal", 3, std::move(arrays.normals)));
    mesh.attributes().add(values_of("tangent", 4, std::move(arrays.tangents)));
    mesh.attributes().add(values_of("color", 4, std::move(arrays.colors)));
    mesh.attributes().add(values_of("color2", 3, std::move(arrays.marks)));
    FaceLabels labels;
    labels.of_face.assign(at(faces), labels.add("hair"));
    mesh.attributes().labels()["material"] = std::move(labels);
    return mesh;
}

}  // namespace lissom
