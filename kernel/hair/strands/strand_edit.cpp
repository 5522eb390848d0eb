#include "kernel/hair/strands/strand_edit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/memory_hold.h"
#include "kernel/core/roots.h"
#include "kernel/hair/strands/strand_measures.h"

namespace lissom {
namespace {

template <typename T>
std::vector<T> chosen(const std::vector<T>& values, std::span<const Index> list) {
    std::vector<T> result;
    if (values.empty()) return result;
    result.reserve(list.size());
    for (const Index s : list) result.push_back(values[at(s)]);
    return result;
}

template <typename Values>
void choose_values(Values& values, const Strands& strands, std::span<const Index> list) {
    if (values.domain == StrandDomain::strand) values.values = chosen(values.values, list);
    if (values.domain != StrandDomain::point) return;
    decltype(values.values) result;
    for (const Index s : list) {
        const auto first = values.values.begin() + strands.first_point(s);
        result.insert(result.end(), first, first + strands.point_count(s));
    }
    values.values = std::move(result);
}

std::vector<std::uint32_t> all_ids(const Strands& strands) {
    std::vector<std::uint32_t> ids;
    ids.reserve(at(strands.size()));
    for (Index s = 0; s < strands.size(); ++s) ids.push_back(strands.id(s));
    return ids;
}

// Copies the values of all but the points from the strands of `list` to `result`.
void choose_data(const Strands& strands, std::span<const Index> list, Strands& result) {
    StrandWidths widths = strands.widths();
    choose_values(widths, strands, list);
    result.set_widths(std::move(widths));
    StrandValues<float> transparency = strands.transparency();
    choose_values(transparency, strands, list);
    result.set_transparency(std::move(transparency));
    if (strands.colors()) {
        StrandValues<Eigen::Vector3f> colors = *strands.colors();
        choose_values(colors, strands, list);
        result.set_colors(std::move(colors));
    }
    result.set_roots({chosen(strands.roots().faces, list),
                      chosen(strands.roots().barycentrics, list), chosen(strands.roots().uvs, list),
                      chosen(strands.roots().triangles, list)});
    result.set_groups(chosen(strands.groups(), list), strands.group_names());
    result.set_ids(chosen(all_ids(strands), list));
    result.set_guides({chosen(strands.guides().ids, list), chosen(strands.guides().arcs, list)});
    result.set_comment(strands.comment());
}

// One list of values for the strands of both; `fill` makes those of a side that has none.
template <typename T>
std::vector<T> joined(const std::vector<T>& a, Index a_count, const std::vector<T>& b,
                      Index b_count, const T& fill) {
    if (a.empty() && b.empty()) return {};
    std::vector<T> result = a.empty() ? std::vector<T>(at(a_count), fill) : a;
    result.insert(result.end(), b.begin(), b.end());
    result.resize(at(a_count + b_count), fill);
    return result;
}

template <typename Value>
std::vector<Value> in_domain(const StrandValues<Value>& values, const Strands& strands,
                             StrandDomain domain) {
    std::vector<Value> result;
    for (Index s = 0; s < strands.size(); ++s) {
        const Index first = strands.first_point(s);
        const Index count = domain == StrandDomain::point ? strands.point_count(s) : 1;
        for (Index k = 0; k < count; ++k) result.push_back(values.at(s, first + k));
    }
    return result;
}

template <typename Value>
StrandValues<Value> joined(const StrandValues<Value>& a, const Strands& a_strands,
                           const StrandValues<Value>& b, const Strands& b_strands) {
    StrandValues<Value> result{a.common, std::max(a.domain, b.domain)};
    if (a_strands.empty()) result.common = b.common;
    const bool same = a.common == b.common || a_strands.empty() || b_strands.empty();
    if (result.domain == StrandDomain::all && same) return result;
    result.domain = std::max(result.domain, StrandDomain::strand);
    result.values = in_domain(a, a_strands, result.domain);
    const std::vector<Value> rest = in_domain(b, b_strands, result.domain);
    result.values.insert(result.values.end(), rest.begin(), rest.end());
    return result;
}

// Widths at the points with the profile in them.
StrandValues<float> without_profile(const Strands& strands) {
    StrandValues<float> widths{strands.widths().common, StrandDomain::point};
    std::vector<float> one;
    for (Index s = 0; s < strands.size(); ++s) {
        widths_of(strands, s, one);
        widths.values.insert(widths.values.end(), one.begin(), one.end());
    }
    return widths;
}

StrandWidths joined_widths(const Strands& a, const Strands& b) {
    StrandWidths result;
    const bool same_profile = a.widths().profile == b.widths().profile || a.empty();
    if (same_profile) result.profile = b.widths().profile;
    static_cast<StrandValues<float>&>(result) =
        same_profile ? joined<float>(a.widths(), a, b.widths(), b)
                     : joined<float>(without_profile(a), a, without_profile(b), b);
    return result;
}

std::vector<std::uint32_t> joined_ids(const Strands& a, const Strands& b) {
    std::vector<std::uint32_t> ids = all_ids(a);
    const std::vector<std::uint32_t> others = all_ids(b);
    const std::unordered_set<std::uint32_t> taken(ids.begin(), ids.end());
    std::uint32_t next = 0;
    for (const std::uint32_t id : ids) next = std::max(next, id + 1);
    for (const std::uint32_t id : others) next = std::max(next, id + 1);
    for (const std::uint32_t id : others) ids.push_back(taken.contains(id) ? next++ : id);
    return ids;
}

// Guides of both; those of `b` by the ids that its strands have now.
void join_guides(const Strands& a, const Strands& b, Strands& result) {
    std::unordered_map<std::uint32_t, std::uint32_t> renamed;
    for (Index s = 0; s < b.size(); ++s) renamed.emplace(b.id(s), result.id(a.size() + s));
    std::vector<std::uint32_t> ids = b.guides().ids;
    for (std::uint32_t& id : ids) {
        const auto found = renamed.find(id);
        id = found == renamed.end() ? kNoGuide : found->second;
    }
    result.set_guides({joined(a.guides().ids, a.size(), ids, b.size(), kNoGuide),
                       joined(a.guides().arcs, a.size(), b.guides().arcs, b.size(), 0.0f)});
}

void join_groups(const Strands& a, const Strands& b, Strands& result) {
    std::vector<std::string> names = a.group_names();
    std::unordered_map<std::string, Index> places;
    for (std::size_t i = 0; i < names.size(); ++i) places.emplace(names[i], index_of(i));
    std::vector<Index> place;
    for (const std::string& name : b.group_names()) {
        const auto [found, added] = places.emplace(name, count_of(names));
        if (added) names.push_back(name);
        place.push_back(found->second);
    }
    std::vector<Index> groups = b.groups();
    for (Index& group : groups) group = group == kNoIndex ? kNoIndex : place[at(group)];
    result.set_groups(joined(a.groups(), a.size(), groups, b.size(), kNoIndex), std::move(names));
}

void join_colors(const Strands& a, const Strands& b, Strands& result) {
    if (!a.colors() && !b.colors()) return;
    const StrandValues<Eigen::Vector3f> black{Eigen::Vector3f::Zero()};
    result.set_colors(joined<Eigen::Vector3f>(a.colors() ? *a.colors() : black, a,
                                              b.colors() ? *b.colors() : black, b));
}

Strands joined_points(const Strands& a, const Strands& b) {
    constexpr std::size_t kMaximum = std::numeric_limits<Index>::max();
    if (at(a.point_count()) + at(b.point_count()) > kMaximum) {
        throw Error(ErrorCode::invalid_argument,
                    "together there would be more points than can be numbered");
    }
    const auto account = a.account() ? a.account() : b.account();
    MemoryHold hold(account, "strands");
    hold.resize(a.points().size_bytes() + b.points().size_bytes());
    std::vector<float> points(a.points().begin(), a.points().end());
    points.insert(points.end(), b.points().begin(), b.points().end());
    std::vector<Index> offsets(a.offsets().begin(), a.offsets().end());
    for (const Index offset : b.offsets().subspan(1)) offsets.push_back(a.point_count() + offset);
    hold.resize(0);
    return {std::move(points), std::move(offsets), account};
}

double scale_of(const Affine& map) {
    const double scale = cube_root(std::abs(map.linear.determinant()));
    if (map.is_finite() && scale > 0.0 && std::isfinite(scale)) return scale;
    throw Error(
        ErrorCode::singular_transform,
        "the transform flattens the strands or is not finite; scale by factors other than zero");
}

void scale_widths(Strands& strands, double scale) {
    StrandWidths widths = strands.widths();
    widths.common = widths.common * scale;
    for (float& width : widths.values) width = static_cast<float>(width * scale);
    strands.set_widths(std::move(widths));
    StrandGuides guides = strands.guides();
    for (float& arc : guides.arcs) arc = static_cast<float>(arc * scale);
    strands.set_guides(std::move(guides));
}

void require_finite_edit(const Strands& strands, const std::vector<float>& points) {
    Elements beyond{ElementKind::strand, 0, {}};
    for (Index s = 0; s < strands.size(); ++s) {
        const StrandView moved(points.data() + 3 * at(strands.first_point(s)), 3,
                               strands.point_count(s));
        if (!moved.allFinite() && strands.strand(s).allFinite()) beyond.add(s);
    }
    if (beyond.count == 0) return;
    const std::string names = describe(beyond);
    throw Error(ErrorCode::not_finite, names + " would exceed the range of 32-bit numbers",
                std::move(beyond));
}

}  // namespace

Strands select(const Strands& strands, std::span<const Index> list) {
    std::vector<Index> offsets = {0};
    std::vector<float> points;
    std::size_t total = 0;
    for (const Index s : list) {
        require_strand(strands, s);
        total += at(strands.point_count(s));
        offsets.push_back(index_of(total));
    }
    if (total > at(std::numeric_limits<Index>::max())) {
        throw Error(ErrorCode::invalid_argument, "the list has more points than can be numbered");
    }
    // Strands count their lists once they have them.
    MemoryHold hold(strands.account(), "strands");
    hold.resize(3 * sizeof(float) * total);
    points.reserve(3 * total);
    for (const Index s : list) {
        const StrandView strand = strands.strand(s);
        points.insert(points.end(), strand.data(), strand.data() + strand.size());
    }
    hold.resize(0);
    Strands result(std::move(points), std::move(offsets), strands.account());
    choose_data(strands, list, result);
    return result;
}

Strands select(const Strands& strands, const std::function<bool(Index)>& choose) {
    std::vector<Index> list;
    for (Index s = 0; s < strands.size(); ++s) {
        if (choose(s)) list.push_back(s);
    }
    return select(strands, list);
}

Strands select_group(const Strands& strands, std::string_view group) {
    const Index wanted = strands.find_group(group);
    if (wanted == kNoIndex) {
        throw Error(ErrorCode::out_of_range,
                    "the strands have no group called '" + std::string(group) + "'");
    }
    return select(strands, [&](Index s) { return strands.group(s) == wanted; });
}

Strands prefix(const Strands& strands, Index count) {
    if (count < 0) throw Error(ErrorCode::out_of_range, "the number of strands is negative");
    std::vector<Index> list(at(std::min(count, strands.size())));
    std::iota(list.begin(), list.end(), 0);
    return select(strands, list);
}

void append(Strands& strands, const Strands& other) {
    Strands result = joined_points(strands, other);
    const Index a = strands.size(), b = other.size();
    const StrandRoots &x = strands.roots(), &y = other.roots();
    const Eigen::Vector3f none = Eigen::Vector3f::Zero();
    const Eigen::Vector2f no_uv = Eigen::Vector2f::Zero();
    const Triangle nowhere{kNoIndex, kNoIndex, kNoIndex};
    result.set_roots({joined(x.faces, a, y.faces, b, kNoIndex),
                      joined(x.barycentrics, a, y.barycentrics, b, none),
                      joined(x.uvs, a, y.uvs, b, no_uv),
                      joined(x.triangles, a, y.triangles, b, nowhere)});
    result.set_widths(joined_widths(strands, other));
    result.set_transparency(
        joined<float>(strands.transparency(), strands, other.transparency(), other));
    join_colors(strands, other, result);
    join_groups(strands, other, result);
    result.set_ids(joined_ids(strands, other));
    join_guides(strands, other, result);
    result.set_comment(strands.comment());
    strands = std::move(result);
}

void transform(Strands& strands, const Affine& map, const Context& context) {
    const double scale = scale_of(map);
    const MemoryCharge charge =
        context.charge(strands.points().size_bytes(), "transforming strands");
    std::vector<float> moved(strands.points().size());
    context.parallel_for(0, strands.size(), 256, [&](Index begin, Index end) {
        const std::size_t last = 3 * at(strands.offsets()[at(end)]);
        for (std::size_t i = 3 * at(strands.first_point(begin)); i < last; i += 3) {
            const float* const p = strands.points().data() + i;
            const Vec3 q = map(Vec3(p[0], p[1], p[2]));
            for (std::size_t k = 0; k < 3; ++k) moved[i + k] = static_cast<float>(q[Index(k)]);
        }
    });
    require_finite_edit(strands, moved);
    std::copy(moved.begin(), moved.end(), strands.edit_points().begin());
    if (scale != 1.0) scale_widths(strands, scale);
}

}  // namespace lissom
