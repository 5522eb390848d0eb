#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/cards/cap_cover.h"
#include "kernel/hair/cards/card_slots.h"
#include "kernel/hair/cards/hair_cards.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/repair/repair.h"
#include "kernel/mesh/resample/decimate.h"

namespace lissom {
namespace {

// Vertices of less cover have no cap.
constexpr double kLeastCover = 0.05;
// Cover from which on the cap shows.
constexpr double kHalfCover = 0.5;
// Repeats of the slot around the head.
constexpr double kRepeats = 6.0;
// Weight of `cover` in decimation, so that the edge of the hair stays where it is.
constexpr double kCoverWeight = 0.02;

// Faces with roots or with a vertex that roots cover.
std::vector<char> hairy_faces(const Strands& strands, const Mesh& head,
                              const std::vector<double>& cover) {
    std::vector<char> hairy(at(head.face_count()), 0);
    for (const Index face : strands.roots().faces) {
        if (face >= 0 && face < head.face_count()) hairy[at(face)] = 1;
    }
    require(std::find(hairy.begin(), hairy.end(), 1) != hairy.end(),
            "no strand is rooted on a face of this head");
    for (Index f = 0; f < head.face_count(); ++f) {
        const auto corners = head.topology().face(f);
        hairy[at(f)] = hairy[at(f)] || std::any_of(corners.begin(), corners.end(), [&](Index v) {
                           return cover[at(v)] > kLeastCover;
                       });
    }
    return hairy;
}

// For each vertex, the edges of triangles that begin there and have none on the other side.
std::vector<Index> border_edges(const std::vector<Triangle>& triangles, Index vertices) {
    std::set<std::pair<Index, Index>> edges;
    for (const Triangle& t : triangles) {
        for (std::size_t c = 0; c < 3; ++c) edges.insert({t[c], t[(c + 1) % 3]});
    }
    std::vector<Index> counts(at(vertices), 0);
    for (const auto& edge : edges) {
        if (!edges.contains({edge.second, edge.first})) ++counts[at(edge.first)];
    }
    return counts;
}

// Drops triangles at vertices that are all that parts of the cap share, until there are none.
void drop_pinches(std::vector<Triangle>& triangles, Index vertices) {
    for (;;) {
        const std::vector<Index> counts = border_edges(triangles, vertices);
        const auto dropped = std::erase_if(triangles, [&](const Triangle& t) {
            return std::any_of(t.begin(), t.end(), [&](Index v) { return counts[at(v)] > 1; });
        });
        if (dropped == 0) return;
    }
}

std::vector<Vec3> triangle_normals(const Mesh& head, const Triangulation& triangles) {
    std::vector<Vec3> normals(at(head.vertex_count()), Vec3::Zero());
    for (const Triangle& t : triangles.triangles) {
        const Vec3 a = head.position(t[0]);
        const Vec3 normal = (head.position(t[1]) - a).cross(head.position(t[2]) - a);
        for (const Index v : t) normals[at(v)] += normal;
    }
    for (Vec3& normal : normals) {
        normal = normal.norm() > 0.0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitY());
    }
    return normals;
}

// Across: back and forth around the head, so that the slot has no seam. Down: from the top.
Eigen::Vector2d cap_place(const Vec3& p, const Box& box) {
    const Vec3 d = p - box.center();
    const double turn = kRepeats * std::atan2(d.x(), d.z()) / (2.0 * kPi);
    const double height = std::max(box.max.y() - box.min.y(), 1e-9);
    return {std::abs(2.0 * (turn - std::floor(turn)) - 1.0), (box.max.y() - p.y()) / height};
}

Index densest_slot(const HairCards& cards) {
    Index best = 0;
    double most = -1.0;
    for (Index i = 0; i < count_of(cards.slots); ++i) {
        const Card& card = cards.cards[at(cards.slots[at(i)].card)];
        double width = 0.0;
        for (const CardSection& section : card.sections) width += section.half_width;
        const double dense = static_cast<double>(card.strands.size()) / std::max(width, 1e-9);
        if (dense <= most) continue;
        most = dense;
        best = i;
    }
    return best;
}

// The faces of the head that hair grows on, as a mesh of their own in metres over the skin, with
// an attribute "cover".
Mesh hairy_skin(const Strands& strands, const Mesh& head, const CardCapOptions& options,
                const Context& context) {
    const std::vector<double> covers = cover_of_roots(strands, head, options.unit, context);
    const std::vector<char> hairy = hairy_faces(strands, head, covers);
    const Triangulation all = triangulate_faces(head.topology(), head.positions());
    const std::vector<Vec3> normals = triangle_normals(head, all);
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
        if (hairy[at(all.face[t])]) triangles.push_back(all.triangles[t]);
    }
    drop_pinches(triangles, head.vertex_count());
    require(!triangles.empty(), "the faces that strands are rooted on touch at vertices alone");
    const std::vector<Index> border = border_edges(triangles, head.vertex_count());
    std::vector<Index> number(at(head.vertex_count()), kNoIndex);
    std::vector<Vec3> positions;
    FaceList faces;
    Attribute cover;
    cover.name = "cover";
    for (const Triangle& t : triangles) {
        for (const Index v : t) {
            if (number[at(v)] != kNoIndex) continue;
            number[at(v)] = count_of(positions);
            positions.push_back(options.unit * head.position(v) + options.offset * normals[at(v)]);
            cover.values.push_back(border[at(v)] == 0 ? covers[at(v)] : 0.0);
        }
        faces.add({number[at(t[0])], number[at(t[1])], number[at(t[2])]});
    }
    Mesh skin(std::move(positions), std::move(faces), context);
    skin.attributes().add(std::move(cover));
    return skin;
}

// The cap of few triangles that `skin` is decimated to.
CardCap cap_of(const Mesh& skin, const CardCapOptions& options, const Context& context) {
    const Mesh mesh =
        decimate(skin,
                 {.faces = options.triangles, .error = options.error, .attributes = kCoverWeight},
                 context)
            .mesh;
    CardCap cap;
    cap.positions.assign(mesh.positions().begin(), mesh.positions().end());
    cap.normals = triangle_normals(mesh, triangulate_faces(mesh.topology(), mesh.positions()));
    const Attribute& cover = *mesh.attributes().find("cover");
    Box box;
    for (const Vec3& p : cap.positions) box.extend(p);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        cap.cover.push_back(cover.at(v)[0]);
        cap.places.push_back(cap_place(mesh.position(v), box));
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.topology().face(f);
        cap.triangles.push_back({corners[0], corners[1], corners[2]});
    }
    return cap;
}

// Cuts the part of a triangle off whose cover is less than a half.
class CapCutter {
  public:
    explicit CapCutter(const CardCap& cap) : cap_(cap), number_(cap.positions.size(), kNoIndex) {}

    Mesh cut(const Context& context) {
        for (const Triangle& t : cap_.triangles) add(t);
        Soup soup;
        soup.positions = std::move(positions_);
        soup.faces = std::move(faces_);
        // Where the edge is cut off, faces may touch at vertices alone.
        return repair(std::move(soup), {.weld = Weld::none}, context);
    }

  private:
    void add(const Triangle& t) {
        std::vector<Index> face;
        for (std::size_t c = 0; c < 3; ++c) {
            const Index a = t[c], b = t[(c + 1) % 3];
            if (is_in(a)) face.push_back(corner(a));
            if (is_in(a) != is_in(b)) face.push_back(crossing(std::min(a, b), std::max(a, b)));
        }
        for (std::size_t c = 2; c < face.size(); ++c) faces_.add({face[0], face[c - 1], face[c]});
    }

    bool is_in(Index v) const { return cap_.cover[at(v)] >= kHalfCover; }

    Index put(const Vec3& p) {
        positions_.push_back(p);
        return count_of(positions_) - 1;
    }
    Index corner(Index v) {
        if (number_[at(v)] == kNoIndex) number_[at(v)] = put(cap_.positions[at(v)]);
        return number_[at(v)];
    }
    Index crossing(Index a, Index b) {
        const auto [place, is_new] = crossings_.try_emplace({a, b}, kNoIndex);
        if (is_new) {
            const double here = cap_.cover[at(a)] - kHalfCover,
                         there = cap_.cover[at(b)] - kHalfCover;
            const Vec3 &p = cap_.positions[at(a)], &q = cap_.positions[at(b)];
            place->second = put(p + here / (here - there) * (q - p));
        }
        return place->second;
    }

    const CardCap& cap_;
    std::vector<Index> number_;
    std::map<std::pair<Index, Index>, Index> crossings_;
    std::vector<Vec3> positions_;
    FaceList faces_;
};

}  // namespace

CardCap make_cap(const Strands& strands, const Mesh& head, const CardCapOptions& options,
                 const Context& context) {
    require(strands.roots().faces.size() == at(strands.size()),
            "the strands have no roots on the head; use strands:attach, or cap = false");
    return cap_of(hairy_skin(strands, head, options, context), options, context);
}

Mesh cut_cap(const CardCap& cap, const Context& context) {
    return CapCutter(cap).cut(context);
}

void add_cap(HairCards& cards, const Strands& strands, const Mesh& head,
             const CardCapOptions& options, const Context& context) {
    require(!cards.slots.empty(), "a cap needs cards, whose picture it shows");
    cards.cap = make_cap(strands, head, options, context);
    CardSlot slot = cards.slots[at(densest_slot(cards))];
    slot.is_solid = true;
    cards.slots.push_back(slot);
    place_slots(cards.slots);
}

}  // namespace lissom
