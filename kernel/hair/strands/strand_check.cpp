#include "kernel/hair/strands/strand_check.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <unordered_map>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_measures.h"

namespace lissom {
namespace {

constexpr Index kDepthGrain = 64;
// Diagonal of the box around the roots of a head of hair, in metres.
constexpr double kLeastHead = 0.02, kMostHead = 0.8;
// Fewer roots than this show neither unit nor axis.
constexpr Index kManyRoots = 100;
// Cosine within which the middle of the roots shows an axis, and part of the radius by which roots
// may lie off a sphere that shows it.
constexpr double kAxisCosine = 0.8, kRoundness = 0.2;
// A guide reaches a strand that is longer by this part and by this many metres.
constexpr double kGuideReachPart = 0.1, kGuideReach = 0.005;

// A text with numbers.
template <typename... Numbers>
std::string text(const char* form, Numbers... numbers) {
    std::array<char, 256> buffer{};
    std::snprintf(buffer.data(), buffer.size(), form, numbers...);
    return buffer.data();
}

class StrandChecker {
  public:
    StrandChecker(const Strands& strands, const StrandCheckOptions& options, const Context& context)
        : strands_(strands),
          options_(options),
          context_(context),
          limits_(limits_of(options.target)) {
        finite_.resize(at(strands.size()));
        for (Index s = 0; s < strands.size(); ++s) {
            finite_[at(s)] = strands.strand(s).allFinite() ? 1 : 0;
        }
    }

    std::vector<StrandCheckFinding> run() {
        check_shapes();
        check_points();
        check_groups();
        check_attributes();
        if (options_.distance) check_head();
        check_roots();
        check_size();
        check_axis();
        check_guides();
        check_cards();
        return std::move(findings_);
    }

  private:
    template <typename Test>
    std::vector<Index> strands_where(const Test& test) const {
        std::vector<Index> list;
        for (Index s = 0; s < strands_.size(); ++s) {
            if (finite_[at(s)] && test(s)) list.push_back(s);
        }
        return list;
    }

    // Nothing if no strand has the fault.
    void tell(StrandFault fault, std::vector<Index> list, std::string message,
              bool is_warning = false) {
        if (list.empty()) return;
        const Index count = count_of(list);
        findings_.push_back({fault, is_warning, std::move(list), count, std::move(message)});
    }

    void tell_all(StrandFault fault, Index count, std::string message, bool is_warning) {
        findings_.push_back({fault, is_warning, {}, count, std::move(message)});
    }

    void check_shapes() {
        std::vector<Index> broken;
        for (Index s = 0; s < strands_.size(); ++s) {
            if (!finite_[at(s)]) broken.push_back(s);
        }
        tell(StrandFault::not_finite, std::move(broken), "coordinates are NaN or infinite");
        tell(StrandFault::no_length,
             strands_where([&](Index s) { return length(strands_.strand(s)) == 0.0; }),
             "strands have no length");
    }

    void check_points() {
        // Unity spreads points anew when it loads strands.
        const bool resamples = options_.target == StrandTarget::unity;
        tell(StrandFault::few_points, strands_where([&](Index s) {
                 return strands_.point_count(s) > 1 && strands_.point_count(s) < limits_.min_points;
             }),
             text("strands need at least %d points", limits_.min_points), resamples);
        tell(StrandFault::many_points,
             strands_where([&](Index s) { return strands_.point_count(s) > limits_.max_points; }),
             text("strands have more than %d points", limits_.max_points), resamples);
    }

    void check_groups() {
        const std::size_t names = strands_.group_names().size();
        std::vector<Index> strands(names + 1, 0), points(names + 1, 0);
        const auto place = [&](Index s) {
            return strands_.group(s) == kNoIndex ? names : at(strands_.group(s));
        };
        for (Index s = 0; s < strands_.size(); ++s) {
            ++strands[place(s)];
            points[place(s)] += strands_.point_count(s);
        }
        const auto is_large = [&](Index s) {
            return strands[place(s)] > limits_.max_strands ||
                   points[place(s)] > limits_.max_points_of_group;
        };
        tell(StrandFault::large_group, strands_where(is_large),
             text("a group has more than %d strands or %d points", limits_.max_strands,
                  limits_.max_points_of_group));
    }

    void check_attributes() {
        const auto has_no_width = [&](Index s) {
            for (Index k = 0; k < strands_.point_count(s); ++k) {
                const float width = strands_.widths().at(s, strands_.first_point(s) + k);
                if (!(width > 0.0f) || !std::isfinite(width)) return true;
            }
            return false;
        };
        tell(StrandFault::no_widths, strands_where(has_no_width),
             "widths are zero, negative or not finite");
        if (strands_.roots().uvs.empty() && !strands_.empty()) {
            tell_all(StrandFault::no_root_uvs, strands_.size(), "roots have no texture coordinates",
                     true);
        }
    }

    void check_head() {
        std::vector<char> off(at(strands_.size()), 0), inside(at(strands_.size()), 0);
        context_.parallel_for(0, strands_.size(), kDepthGrain, [&](Index begin, Index end) {
            for (Index s = begin; s < end; ++s) {
                if (!finite_[at(s)]) continue;
                const StrandView strand = strands_.strand(s);
                off[at(s)] =
                    std::abs(options_.distance(point_of(strand, 0))) > options_.root_distance;
                for (Index k = 1; k < index_of(strand.cols()) && !inside[at(s)]; ++k) {
                    inside[at(s)] = options_.distance(point_of(strand, k)) < -options_.depth;
                }
            }
        });
        tell(StrandFault::off_head, strands_where([&](Index s) { return off[at(s)] != 0; }),
             text("roots are more than %.3g mm off the head", 1e3 * options_.root_distance));
        tell(StrandFault::inside_head, strands_where([&](Index s) { return inside[at(s)] != 0; }),
             text("points are more than %.3g mm inside the head", 1e3 * options_.depth));
    }

    void check_roots() {
        const auto key = [&](Index s) {
            const Eigen::Vector3f root = strands_.root(s);
            return std::array<float, 3>{root.x(), root.y(), root.z()};
        };
        std::vector<Index> order = strands_where([](Index) { return true; });
        std::stable_sort(order.begin(), order.end(),
                         [&](Index a, Index b) { return key(a) < key(b); });
        std::vector<Index> doubles;
        for (std::size_t i = 1; i < order.size(); ++i) {
            if (key(order[i]) == key(order[i - 1])) doubles.push_back(order[i]);
        }
        std::sort(doubles.begin(), doubles.end());
        tell(StrandFault::duplicate_roots, std::move(doubles),
             "strands have the root of another one", true);
    }

    void check_size() {
        Box box;
        Index roots = 0;
        for (const Index s : strands_where([](Index) { return true; })) {
            box.extend(strands_.root(s).cast<double>());
            ++roots;
        }
        if (roots < kManyRoots) return;
        const double size = (box.max - box.min).norm();
        if (size >= kLeastHead && size <= kMostHead) return;
        tell_all(StrandFault::wrong_unit, roots,
                 text("the roots span %.3g m; those of a head span about 0.3 m", size), false);
    }

    // The middle of the roots, seen from the centre of the sphere that fits them, is the crown.
    void check_axis() {
        const std::vector<Index> roots = strands_where([](Index) { return true; });
        if (count_of(roots) < kManyRoots) return;
        Vec3 middle = Vec3::Zero();
        for (const Index s : roots) middle += strands_.root(s).cast<double>();
        middle /= static_cast<double>(roots.size());
        Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
        Eigen::Vector4d right = Eigen::Vector4d::Zero();
        for (const Index s : roots) {
            const Vec3 d = strands_.root(s).cast<double>() - middle;
            const Eigen::Vector4d row(2.0 * d.x(), 2.0 * d.y(), 2.0 * d.z(), 1.0);
            normal += row * row.transpose();
            right += d.squaredNorm() * row;
        }
        const Eigen::Vector4d fit = normal.ldlt().solve(right);
        const Vec3 center = fit.head<3>();
        const double radius = std::sqrt(std::max(0.0, fit[3] + center.squaredNorm()));
        double off = 0.0;
        for (const Index s : roots) {
            const double r = (strands_.root(s).cast<double>() - middle - center).norm();
            off += (r - radius) * (r - radius);
        }
        off = std::sqrt(off / static_cast<double>(roots.size()));
        const Vec3 crown = -center.normalized();
        if (!(off < kRoundness * radius) || !crown.allFinite()) return;
        Index axis = 0;
        crown.cwiseAbs().maxCoeff(&axis);
        const bool is_up = axis == 1 && crown.y() > 0.0;
        if (is_up || std::abs(crown[axis]) < kAxisCosine) return;
        tell_all(
            StrandFault::wrong_axis, count_of(roots),
            text("the crown lies towards %s%c; up is y", crown[axis] > 0.0 ? "" : "-", "xyz"[axis]),
            true);
    }

    void check_guides() {
        const StrandGuides& guides = strands_.guides();
        if (guides.ids.empty()) return;
        std::unordered_map<std::uint32_t, Index> strand_of;
        for (Index s = 0; s < strands_.size(); ++s) strand_of[strands_.id(s)] = s;
        const auto follows = [&](Index s) { return guides.ids[at(s)] != kNoGuide; };
        tell(StrandFault::lost_guide, strands_where([&](Index s) {
                 return follows(s) && !strand_of.contains(guides.ids[at(s)]);
             }),
             "the guides of strands are not among them");
        if (guides.arcs.empty()) return;
        const auto is_beyond = [&](Index s) {
            const auto guide = strand_of.find(guides.ids[at(s)]);
            if (!follows(s) || guide == strand_of.end() || guide->second == s) return false;
            const double reach = length(strands_.strand(guide->second));
            return guides.arcs[at(s)] > (1.0 + kGuideReachPart) * reach + kGuideReach;
        };
        tell(StrandFault::short_guide, strands_where(is_beyond),
             "strands reach beyond the end of their guide", true);
    }

    void check_cards() {
        if (!options_.triangles || *options_.triangles <= limits_.max_triangles) return;
        tell_all(StrandFault::many_triangles, *options_.triangles,
                 text("the cards have %d triangles; %d are enough for a head of hair",
                      *options_.triangles, limits_.max_triangles),
                 true);
    }

    const Strands& strands_;
    const StrandCheckOptions& options_;
    const Context& context_;
    StrandLimits limits_;
    // 1 for strands without NaN and infinity: only these are looked at further.
    std::vector<char> finite_;
    std::vector<StrandCheckFinding> findings_;
};

}  // namespace

StrandLimits limits_of(StrandTarget target) {
    constexpr Index kUnlimited = 0x7fffffff;
    switch (target) {
        case StrandTarget::unreal:
            return {2, 255, (1 << 22) - 1, (1 << 24) - 1, 30000};
        case StrandTarget::unity:
            return {3, 128, 64000, 64000 * 128, 30000};
        case StrandTarget::godot:
            return {2, kUnlimited, kUnlimited, kUnlimited, 15000};
        case StrandTarget::film:
            break;
    }
    return {2, kUnlimited, kUnlimited, kUnlimited, kUnlimited};
}

std::vector<StrandCheckFinding> check_strands(const Strands& strands,
                                              const StrandCheckOptions& options,
                                              const Context& context) {
    const auto is_distance = [](double x) { return std::isfinite(x) && x >= 0.0; };
    require(is_distance(options.root_distance) && is_distance(options.depth),
            "distances must be finite and not negative");
    const Progress progress(context, "check strands");
    return StrandChecker(strands, options, context).run();
}

}  // namespace lissom
