#include "kernel/mesh/render/tangent_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "kernel/core/index.h"

namespace lissom {
namespace {

constexpr std::size_t next(std::size_t k) {
    return k < 2 ? k + 1 : 0;
}
constexpr std::size_t previous(std::size_t k) {
    return k > 0 ? k - 1 : 2;
}

bool is_not_zero(double value) {
    return std::abs(value) > std::numeric_limits<float>::min();
}

Vec3 unit_if_long(const Vec3& v) {
    const double length = v.norm();
    return is_not_zero(length) ? Vec3(v / length) : v;
}

Vec3 unit_in_plane(const Vec3& v, const Vec3& normal) {
    return unit_if_long(v - normal.dot(v) * normal);
}

// First-order derivatives of position by texture coordinates on one triangle.
struct TriangleSpace {
    Vec3 along_s = Vec3::Zero(), along_t = Vec3::Zero();
    bool keeps_orientation = false;
    // Its texture coordinates have no area: it joins any group.
    bool joins_any = true;
    // Two of its corners lie at one place.
    bool degenerate = false;
    std::array<Index, 3> neighbor{kNoIndex, kNoIndex, kNoIndex};
    std::array<Index, 3> group{kNoIndex, kNoIndex, kNoIndex};
};

struct TangentGroup {
    Index vertex = kNoIndex;
    bool keeps_orientation = false;
    std::vector<Index> triangles;
};

class TangentSpaces {
  public:
    explicit TangentSpaces(const TangentInput& input)
        : in_(input), spaces_(input.triangles.size()), tangents_(3 * input.triangles.size()) {
        weld();
        for (std::size_t f = 0; f < spaces_.size(); ++f) measure(f);
        find_neighbors();
        for (std::size_t f = 0; f < spaces_.size(); ++f) begin_groups(f);
    }

    std::vector<Tangent> tangents() {
        for (const TangentGroup& group : groups_) fill(group);
        fill_degenerate();
        return std::move(tangents_);
    }

  private:
    using Key = std::array<double, 8>;

    Key key_of(Index v) const {
        const Vec3 &p = in_.positions[at(v)], &n = in_.normals[at(v)];
        const Vec2& uv = in_.uvs[at(v)];
        // Adding zero makes one zero of both.
        return {p[0] + 0.0, p[1] + 0.0, p[2] + 0.0,  n[0] + 0.0,
                n[1] + 0.0, n[2] + 0.0, uv[0] + 0.0, uv[1] + 0.0};
    }

    // One number for all vertices with equal values.
    void weld() {
        std::vector<Index> order(in_.positions.size());
        std::iota(order.begin(), order.end(), 0);
        std::vector<Key> keys;
        for (const Index v : order) keys.push_back(key_of(v));
        std::stable_sort(order.begin(), order.end(),
                         [&](Index a, Index b) { return keys[at(a)] < keys[at(b)]; });
        welded_.resize(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            const bool same = i > 0 && keys[at(order[i])] == keys[at(order[i - 1])];
            welded_[at(order[i])] = same ? welded_[at(order[i - 1])] : order[i];
        }
    }

    Index vertex(std::size_t f, std::size_t k) const { return welded_[at(in_.triangles[f][k])]; }
    const Vec3& position(std::size_t f, std::size_t k) const {
        return in_.positions[at(vertex(f, k))];
    }
    const Vec2& uv(std::size_t f, std::size_t k) const { return in_.uvs[at(vertex(f, k))]; }

    void measure(std::size_t f) {
        TriangleSpace& own = spaces_[f];
        const Vec3 &a = position(f, 0), &b = position(f, 1), &c = position(f, 2);
        own.degenerate = a == b || b == c || c == a;
        const Vec2 s = uv(f, 1) - uv(f, 0), t = uv(f, 2) - uv(f, 0);
        const double area = s[0] * t[1] - s[1] * t[0];
        own.keeps_orientation = area > 0.0;
        if (!is_not_zero(area)) return;
        const double sign = own.keeps_orientation ? 1.0 : -1.0;
        const Vec3 along_s = t[1] * (b - a) - s[1] * (c - a);
        const Vec3 along_t = s[0] * (c - a) - t[0] * (b - a);
        const double size_s = along_s.norm(), size_t_ = along_t.norm();
        if (is_not_zero(size_s)) own.along_s = sign / size_s * along_s;
        if (is_not_zero(size_t_)) own.along_t = sign / size_t_ * along_t;
        own.joins_any = !is_not_zero(size_s / area) || !is_not_zero(size_t_ / area);
    }

    void find_neighbors() {
        std::unordered_map<std::uint64_t, Index> open;
        for (std::size_t f = 0; f < spaces_.size(); ++f) {
            if (spaces_[f].degenerate) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = vertex(f, k), b = vertex(f, next(k));
                const auto found = open.find(pair_key(b, a));
                if (found == open.end()) {
                    open.emplace(pair_key(a, b), index_of(3 * f + k));
                    continue;
                }
                const std::size_t other = at(found->second);
                spaces_[f].neighbor[k] = index_of(other / 3);
                spaces_[other / 3].neighbor[other % 3] = index_of(f);
                open.erase(found);
            }
        }
    }

    void begin_groups(std::size_t f) {
        if (spaces_[f].joins_any || spaces_[f].degenerate) return;
        for (std::size_t k = 0; k < 3; ++k) {
            if (spaces_[f].group[k] != kNoIndex) continue;
            groups_.push_back({vertex(f, k), spaces_[f].keeps_orientation, {}});
            grow(f);
        }
    }

    // Adds the triangles around the vertex of the last group, over edges they share.
    void grow(std::size_t first) {
        TangentGroup& group = groups_.back();
        std::vector<Index> waiting{index_of(first)};
        while (!waiting.empty()) {
            const std::size_t f = at(waiting.back());
            waiting.pop_back();
            const std::size_t k = corner_at(f, group.vertex);
            TriangleSpace& own = spaces_[f];
            if (k == 3 || own.group[k] != kNoIndex) continue;
            const bool is_free = std::all_of(own.group.begin(), own.group.end(),
                                             [](Index g) { return g == kNoIndex; });
            if (own.joins_any && is_free) own.keeps_orientation = group.keeps_orientation;
            if (own.keeps_orientation != group.keeps_orientation) continue;
            own.group[k] = index_of(groups_.size() - 1);
            group.triangles.push_back(index_of(f));
            // The left neighbour comes first.
            for (const Index side : {own.neighbor[previous(k)], own.neighbor[k]}) {
                if (side != kNoIndex) waiting.push_back(side);
            }
        }
    }

    std::size_t corner_at(std::size_t f, Index v) const {
        for (std::size_t k = 0; k < 3; ++k) {
            if (vertex(f, k) == v) return k;
        }
        return 3;
    }

    // Whether the tangents of two triangles of a group are averaged: all but opposite ones.
    bool agree(std::size_t a, std::size_t b, const Vec3& normal) const {
        const TriangleSpace &one = spaces_[a], &two = spaces_[b];
        if (a == b || one.joins_any || two.joins_any) return true;
        const auto cosine = [&](const Vec3& u, const Vec3& v) {
            return unit_in_plane(u, normal).dot(unit_in_plane(v, normal));
        };
        return cosine(one.along_s, two.along_s) > -1.0 && cosine(one.along_t, two.along_t) > -1.0;
    }

    double angle_at(std::size_t f, std::size_t k, const Vec3& normal) const {
        const Vec3 a = unit_in_plane(position(f, previous(k)) - position(f, k), normal);
        const Vec3 b = unit_in_plane(position(f, next(k)) - position(f, k), normal);
        return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
    }

    Vec3 mean_direction(const TangentGroup& group, const std::vector<Index>& members) const {
        const Vec3& normal = in_.normals[at(group.vertex)];
        Vec3 sum = Vec3::Zero();
        for (const Index member : members) {
            const std::size_t f = at(member);
            if (spaces_[f].joins_any) continue;
            sum += angle_at(f, corner_at(f, group.vertex), normal) *
                   unit_in_plane(spaces_[f].along_s, normal);
        }
        return unit_if_long(sum);
    }

    void fill(const TangentGroup& group) {
        const Vec3& normal = in_.normals[at(group.vertex)];
        std::vector<Index> members, last;
        Vec3 direction = Vec3::UnitX();
        for (const Index f : group.triangles) {
            members.clear();
            for (const Index other : group.triangles) {
                if (agree(at(f), at(other), normal)) members.push_back(other);
            }
            if (members != last) direction = mean_direction(group, members);
            last = members;
            tangents_[3 * at(f) + corner_at(at(f), group.vertex)] = {
                direction, group.keeps_orientation ? 1.0 : -1.0};
        }
    }

    // Triangles without extent take over what others have at the same vertex.
    void fill_degenerate() {
        std::unordered_map<Index, std::size_t> known;
        for (std::size_t f = spaces_.size(); f-- > 0;) {
            if (spaces_[f].degenerate) continue;
            for (std::size_t k = 3; k-- > 0;) known[vertex(f, k)] = 3 * f + k;
        }
        for (std::size_t f = 0; f < spaces_.size(); ++f) {
            if (!spaces_[f].degenerate) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto found = known.find(vertex(f, k));
                if (found != known.end()) tangents_[3 * f + k] = tangents_[found->second];
            }
        }
    }

    const TangentInput& in_;
    std::vector<Index> welded_;
    std::vector<TriangleSpace> spaces_;
    std::vector<TangentGroup> groups_;
    std::vector<Tangent> tangents_;
};

}  // namespace

std::vector<Tangent> corner_tangents(const TangentInput& input) {
    return TangentSpaces(input).tangents();
}

}  // namespace lissom
