#include "kernel/hair/strands/strands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ErrorCode::invalid_argument, message);
}

// Operators look at their limits of time and memory from strand to strand.
void require_short(const std::vector<Index>& offsets) {
    constexpr Index kMostPoints = 100'000;
    Elements longer{ElementKind::strand, 0, {}};
    for (std::size_t s = 1; s < offsets.size(); ++s) {
        if (offsets[s] - offsets[s - 1] > kMostPoints) longer.add(index_of(s - 1));
    }
    if (longer.count == 0) return;
    const std::string names = describe(longer);
    throw Error(ErrorCode::invalid_argument,
                names + " would have more than 100,000 points; resample with fewer",
                std::move(longer));
}

void require_offsets(const std::vector<float>& points, const std::vector<Index>& offsets) {
    constexpr std::size_t kMaximum = std::numeric_limits<Index>::max();
    if (points.size() % 3 != 0) refuse("points need three numbers each");
    if (points.size() / 3 > kMaximum || offsets.size() > kMaximum) {
        refuse("there are more points or strands than can be numbered");
    }
    const auto count = index_of(points.size() / 3);
    if (offsets.empty() || offsets.front() != 0 || offsets.back() != count) {
        refuse("offsets must begin with 0 and end with the number of points, " +
               std::to_string(count));
    }
    const auto stuck = std::adjacent_find(offsets.begin(), offsets.end(), std::greater_equal<>());
    if (stuck == offsets.end()) return require_short(offsets);
    throw Error(ErrorCode::invalid_argument,
                "offsets must grow: every strand has at least one point",
                {ElementKind::strand, 1, {index_of(stuck - offsets.begin())}});
}

void require_length(std::size_t found, Index expected, const char* what) {
    if (found == at(expected)) return;
    refuse("there are " + std::to_string(found) + " " + what + " for " + std::to_string(expected) +
           " elements");
}

template <typename Value>
void require_values(const StrandValues<Value>& values, const Strands& strands, const char* what) {
    const Index expected = values.domain == StrandDomain::all      ? 0
                           : values.domain == StrandDomain::strand ? strands.size()
                                                                   : strands.point_count();
    require_length(values.values.size(), expected, what);
}

template <typename T>
std::size_t bytes_of(const std::vector<T>& list) {
    return list.size() * sizeof(T);
}

template <typename Value>
std::size_t bytes_of(const StrandValues<Value>& values) {
    return bytes_of(values.values);
}

std::size_t bytes_of(const StrandRoots& roots) {
    return bytes_of(roots.faces) + bytes_of(roots.barycentrics) + bytes_of(roots.triangles) +
           bytes_of(roots.uvs);
}

std::size_t bytes_of(const StrandGuides& guides) {
    return bytes_of(guides.ids) + bytes_of(guides.arcs);
}

}  // namespace

float StrandWidths::factor(double t) const {
    if (profile.empty()) return 1.0f;
    const double at = std::clamp(t, 0.0, 1.0) * (profile.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), profile.size() - 1);
    const std::size_t above = std::min(below + 1, profile.size() - 1);
    const double u = at - below;
    return static_cast<float>((1.0 - u) * profile[below] + u * profile[above]);
}

Strands::Strands(std::vector<float> points, std::vector<Index> offsets,
                 std::shared_ptr<MemoryAccount> account)
    : hold_(std::move(account), "strands") {
    require_offsets(points, offsets);
    hold_.resize(bytes_of(points) + bytes_of(offsets));
    points_ = std::move(points);
    offsets_ = std::move(offsets);
}

// Before one list takes the place of another.
template <typename List>
void Strands::count(const List& now, const List& next) {
    hold_.resize(memory_bytes() - bytes_of(now) + bytes_of(next));
}

void Strands::release(std::vector<float>& points, std::vector<Index>& offsets) {
    Strands old;
    std::swap(*this, old);
    points = std::move(old.points_);
    offsets = std::move(old.offsets_);
}

Index Strands::find_group(std::string_view name) const {
    const auto found = std::find(group_names_.begin(), group_names_.end(), name);
    return found == group_names_.end() ? kNoIndex : index_of(found - group_names_.begin());
}

void Strands::set_widths(StrandWidths widths) {
    require_values(widths, *this, "widths");
    count(widths_, widths);
    widths_ = std::move(widths);
}

void Strands::set_roots(StrandRoots roots) {
    if (!roots.faces.empty()) require_length(roots.faces.size(), size(), "root faces");
    require_length(roots.barycentrics.size(), count_of(roots.faces), "barycentric coordinates");
    if (!roots.triangles.empty()) require_length(roots.triangles.size(), size(), "root triangles");
    if (!roots.uvs.empty()) require_length(roots.uvs.size(), size(), "root uvs");
    count(roots_, roots);
    roots_ = std::move(roots);
}

void Strands::set_groups(std::vector<Index> groups, std::vector<std::string> names) {
    if (!groups.empty()) require_length(groups.size(), size(), "groups");
    const auto known = count_of(names);
    for (const Index group : groups) {
        if (group < kNoIndex || group >= known) {
            refuse("group " + std::to_string(group) + " is none of the " + std::to_string(known) +
                   " that have names");
        }
    }
    count(groups_, groups);
    groups_ = std::move(groups);
    group_names_ = std::move(names);
}

void Strands::set_ids(std::vector<std::uint32_t> ids) {
    if (!ids.empty()) require_length(ids.size(), size(), "ids");
    std::size_t number = 0;
    const bool are_numbers =
        std::all_of(ids.begin(), ids.end(), [&](std::uint32_t id) { return id == number++; });
    if (are_numbers) ids.clear();
    count(ids_, ids);
    ids_ = std::move(ids);
}

void Strands::set_guides(StrandGuides guides) {
    if (!guides.ids.empty()) require_length(guides.ids.size(), size(), "guides");
    require_length(guides.arcs.size(), count_of(guides.ids), "arcs of guides");
    for (const float arc : guides.arcs) {
        if (!(arc >= 0.0f) || !std::isfinite(arc)) refuse("arcs of guides must be 0 or more");
    }
    count(guides_, guides);
    guides_ = std::move(guides);
}

void Strands::set_colors(StrandValues<Eigen::Vector3f> colors) {
    require_values(colors, *this, "colours");
    count(colors_, colors);
    colors_ = std::move(colors);
    has_colors_ = true;
}

void Strands::set_transparency(StrandValues<float> transparency) {
    require_values(transparency, *this, "transparencies");
    count(transparency_, transparency);
    transparency_ = std::move(transparency);
}

std::size_t Strands::memory_bytes() const {
    return bytes_of(points_) + bytes_of(offsets_) + bytes_of(widths_) + bytes_of(roots_) +
           bytes_of(groups_) + bytes_of(ids_) + bytes_of(guides_) + bytes_of(colors_) +
           bytes_of(transparency_);
}

void require_strand(const Strands& strands, Index strand) {
    if (strand >= 0 && strand < strands.size()) return;
    throw Error(
        ErrorCode::out_of_range,
        "there is no strand " + std::to_string(strand) + " among " + std::to_string(strands.size()),
        {ElementKind::strand, 1, {strand}});
}

}  // namespace lissom
