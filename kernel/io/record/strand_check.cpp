#include "kernel/io/record/strand_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>
#include <utility>

#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

// Also false for NaN.
bool is_width(float x) {
    return x > 0.0f && std::isfinite(x);
}

bool repeats(const StrandView& strand, Index k) {
    return k > 0 && strand.col(k) == strand.col(k - 1);
}

Index distinct_points(const StrandView& strand) {
    Index count = 0;
    for (Index k = 0; k < strand.cols(); ++k) count += repeats(strand, k) ? 0 : 1;
    return count;
}

// Replaces numbers that are no widths by the least that is one, or by `none` if there is none.
void replace_bad(std::vector<float>& values, float none) {
    float least = std::numeric_limits<float>::infinity();
    for (const float x : values) least = is_width(x) ? std::min(least, x) : least;
    if (!std::isfinite(least)) least = none;
    for (float& x : values) x = is_width(x) ? x : least;
}

class Checker {
  public:
    Checker(const Strands& strands, const StrandCapacity& capacity,
            const StrandSaveOptions& options, const Context& context)
        : original_(strands), capacity_(capacity), options_(options), context_(context) {}

    CheckedStrands run() {
        check_finite();
        check_points();
        if (capacity_.point_count) check_point_counts();
        if (capacity_.widths) check_widths();
        if (capacity_.groups) check_groups();
        if (capacity_.root_uvs) check_uvs();
        if (options_.distance) check_roots();
        check_capacity();
        return std::move(result_);
    }

  private:
    const Strands& now() const { return result_.changed ? *result_.changed : original_; }
    Strands& edit() {
        if (!result_.changed) result_.changed = original_;
        return *result_.changed;
    }

    // Ids of strands in reports and errors are those before anything was left out.
    Index number_of(Index s) const { return numbers_.empty() ? s : numbers_[std::size_t(s)]; }

    template <typename Choose>
    Elements find(const Choose& choose) const {
        Elements found{ElementKind::strand, 0, {}};
        for (Index s = 0; s < now().size(); ++s) {
            if (choose(s)) found.add(number_of(s));
        }
        return found;
    }

    void add(StrandFindingKind kind, Elements elements, const std::string& message) {
        std::string text = elements.count > 0 ? describe(elements) + message : message;
        result_.report.findings.push_back({kind, std::move(elements), std::move(text)});
    }

    // Records a change of the strands; refused if they may not be changed.
    void mend(StrandFindingKind kind, Elements elements, const std::string& what,
              const std::string& done, ErrorCode code = ErrorCode::invalid_argument) {
        if (options_.mend) return add(kind, std::move(elements), what + "; " + done);
        const std::string names = elements.count > 0 ? describe(elements) : "";
        throw Error(code, names + what, std::move(elements));
    }

    template <typename Keep>
    void keep_strands(const Keep& keep) {
        std::vector<Index> list, numbers;
        for (Index s = 0; s < now().size(); ++s) {
            if (!keep(s)) continue;
            list.push_back(s);
            numbers.push_back(number_of(s));
        }
        result_.changed = select(now(), list);
        numbers_ = std::move(numbers);
    }

    void check_finite() {
        const auto is_finite = [&](Index s) { return now().strand(s).allFinite(); };
        const Elements bad = find([&](Index s) { return !is_finite(s); });
        if (bad.count == 0) return;
        mend(StrandFindingKind::strands_not_finite, bad, ": a coordinate is NaN or infinite",
             "left out", ErrorCode::not_finite);
        keep_strands(is_finite);
    }

    void check_points() {
        const auto is_long = [&](Index s) {
            return distinct_points(now().strand(s)) >= capacity_.min_points;
        };
        const Elements brief = find([&](Index s) { return !is_long(s); });
        if (brief.count > 0) {
            mend(StrandFindingKind::strands_too_short, brief,
                 ": fewer than " + std::to_string(capacity_.min_points) + " different points",
                 "left out");
            keep_strands(is_long);
        }
        const Elements repeated =
            find([&](Index s) { return distinct_points(now().strand(s)) < now().point_count(s); });
        if (repeated.count == 0) return;
        mend(StrandFindingKind::points_repeated, repeated, ": segments without length",
             "their second points were left out");
        const Strands& strands = now();
        result_.changed = at_places(
            strands,
            [&](Index s, std::vector<StrandPlace>& places) {
                const StrandView strand = strands.strand(s);
                for (Index k = 0; k < strand.cols(); ++k) {
                    if (!repeats(strand, k)) places.push_back({k, 0.0f});
                }
            },
            context_);
    }

    void check_point_counts() {
        Index most = 0;
        for (Index s = 0; s < now().size(); ++s) most = std::max(most, now().point_count(s));
        const Index count = capacity_.point_count(most);
        const Elements other = find([&](Index s) { return now().point_count(s) != count; });
        if (other.count == 0) return;
        const std::string number = std::to_string(count);
        mend(StrandFindingKind::points_resampled, other,
             ": the format has " + number + " points in each strand",
             "resampled to " + number + " points");
        result_.changed =
            with_point_counts(now(), std::vector<Index>(at(now().size()), count), context_);
    }

    void check_widths() {
        std::vector<float> widths;
        const Elements bad = find([&](Index s) {
            widths_of(now(), s, widths);
            return !std::all_of(widths.begin(), widths.end(), is_width);
        });
        if (bad.count == 0) return;
        mend(StrandFindingKind::widths_not_positive, bad, ": widths that are not above 0",
             "replaced by the least that is");
        StrandWidths mended = now().widths();
        mended.common = is_width(mended.common) ? mended.common : kHairWidth;
        replace_bad(mended.values, kHairWidth);
        replace_bad(mended.profile, 1.0f);
        edit().set_widths(std::move(mended));
    }

    void check_groups() {
        std::vector<std::string> names = now().group_names();
        std::unordered_set<std::string> taken(names.begin(), names.end()), seen;
        std::size_t changed = 0;
        for (std::size_t g = 0; g < names.size(); ++g) {
            if (!names[g].empty() && seen.insert(names[g]).second) continue;
            std::string name = "group " + std::to_string(g + 1);
            while (taken.contains(name)) name += "'";
            taken.insert(name);
            seen.insert(name);
            names[g] = name;
            ++changed;
        }
        if (changed == 0) return;
        mend(StrandFindingKind::groups_unnamed, {},
             std::to_string(changed) + " groups have no name of their own", "they were given one");
        edit().set_groups(std::vector<Index>(now().groups()), std::move(names));
    }

    void check_uvs() {
        const std::vector<Eigen::Vector2f>& uvs = now().roots().uvs;
        const bool same =
            uvs.size() > 1 &&
            std::all_of(uvs.begin(), uvs.end(), [&](const auto& uv) { return uv == uvs.front(); });
        if (!same) return;
        add(StrandFindingKind::root_uv_constant, {},
            "all strands have the same root uv; hair that is bound by it will look bald");
    }

    void check_roots() {
        const auto away = [&](const Eigen::Vector3f& p) {
            return std::abs(options_.distance(p.cast<double>()));
        };
        const Elements turned = find([&](Index s) {
            const StrandView strand = now().strand(s);
            return away(strand.col(strand.cols() - 1)) < away(strand.col(0));
        });
        if (turned.count == 0) return;
        add(StrandFindingKind::roots_last, turned,
            ": the last point lies nearer to the head than the first, which should be the root");
    }

    bool widths_change() const {
        std::vector<float> widths;
        for (Index s = 0; s < now().size(); ++s) {
            widths_of(now(), s, widths);
            if (std::any_of(widths.begin(), widths.end(),
                            [&](float w) { return w != widths.front(); })) {
                return true;
            }
        }
        return false;
    }

    void check_capacity() {
        const Strands& s = now();
        std::string lost;
        const auto drop = [&](bool there, bool held, const char* name) {
            if (there && !held) lost += (lost.empty() ? "" : ", ") + std::string(name);
        };
        const bool plain_widths = s.widths().domain == StrandDomain::all &&
                                  s.widths().common == kHairWidth && s.widths().profile.empty();
        const bool opaque =
            s.transparency().domain == StrandDomain::all && s.transparency().common == 0.0f;
        drop(!plain_widths, capacity_.widths, "widths");
        drop(capacity_.widths && widths_change(), capacity_.widths_along,
             "widths along strands, whose roots count");
        drop(s.colors() != nullptr, capacity_.colors, "colours");
        const bool beside = !capacity_.transparency_with_colors || s.colors();
        drop(!opaque, capacity_.transparency && beside, "transparency");
        drop(!s.roots().uvs.empty(), capacity_.root_uvs, "root uvs");
        drop(!s.groups().empty(), capacity_.groups, "groups");
        drop(!s.roots().faces.empty(), capacity_.origins, "root faces");
        drop(!original_.ids().empty(), capacity_.origins, "ids");
        drop(!s.guides().ids.empty(), capacity_.origins, "guides");
        if (lost.empty()) return;
        add(StrandFindingKind::content_dropped, {},
            "the format has no place for: " + lost + "; they were left out");
    }

    const Strands& original_;
    const StrandCapacity& capacity_;
    const StrandSaveOptions& options_;
    const Context& context_;
    CheckedStrands result_;
    std::vector<Index> numbers_;
};

}  // namespace

CheckedStrands check_strands(const Strands& strands, const StrandCapacity& capacity,
                             const StrandSaveOptions& options, const Context& context) {
    Progress progress(context, "check strands");
    return Checker(strands, capacity, options, context).run();
}

}  // namespace lissom
