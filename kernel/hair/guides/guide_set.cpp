#include "kernel/hair/guides/guide_set.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/rotation.h"
#include "kernel/hair/guides/strand_clusters.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr Index kSetGrain = 256;
constexpr int kCandidates = 6;
constexpr Index kMaxSetPoints = 256;
constexpr Index kLeastGuides = 3;
constexpr double kMaxDetail = 32767.0;

// Offsets of a strand's points from its root, one coordinate after the other.
using Offsets = Eigen::VectorXd;

void require_set(const GuideSetOptions& options) {
    require(options.of != GuideChoice::count || options.count >= kLeastGuides,
            "strands are sums of three guides: ask for at least 3");
    require(options.points >= 2 && options.points <= kMaxSetPoints, "guides have 2 to 256 points");
}

void require_strands(const Strands& strands) {
    Index long_ones = 0;
    for (Index s = 0; s < strands.size() && long_ones < kLeastGuides; ++s) {
        long_ones += length(strands.strand(s)) > 0.0 ? 1 : 0;
    }
    require(long_ones == kLeastGuides, "strands are sums of three guides, but only " +
                                           std::to_string(long_ones) +
                                           " of them have a length: use them as they are");
}

Index lock_count(const Strands& strands) {
    std::set<std::pair<Index, std::uint32_t>> locks;
    const std::vector<std::uint32_t>& ids = strands.guides().ids;
    for (Index s = 0; s < count_of(ids); ++s) {
        if (ids[at(s)] != kNoGuide) locks.insert({strands.group(s), ids[at(s)]});
    }
    return count_of(locks);
}

ClusterOptions clusters_of(const Strands& strands, const GuideSetOptions& options) {
    ClusterOptions clusters;
    clusters.shape = options.shape;
    clusters.count = options.count;
    if (options.of == GuideChoice::groups) {
        require(!strands.groups().empty(),
                "the strands have no groups; give 'count', or name groups first");
        clusters.count = 1;
    }
    if (options.of == GuideChoice::locks) {
        clusters.count = lock_count(strands);
        clusters.unit = ClusterUnit::lock;
        require(clusters.count > 0,
                "the strands follow no guides; give 'count', or use strands:guides first");
    }
    return clusters;
}

// Without memory from the heap.
using FewProducts = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
using FewNumbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

// Coefficients c >= 0 with the least |sum c_i a_i - b|^2, of the products of the vectors.
struct Fit {
    std::array<double, 3> coefficients{};
    double error = 0.0;
};

Fit fit_of(const Eigen::Matrix3d& products, const Vec3& with_target, double target,
           unsigned chosen) {
    std::array<int, 3> places{};
    int n = 0;
    for (int i = 0; i < 3; ++i) {
        if (chosen >> i & 1u) places[at(n++)] = i;
    }
    FewProducts a(n, n);
    FewNumbers b(n);
    for (int i = 0; i < n; ++i) {
        b[i] = with_target[places[at(i)]];
        for (int j = 0; j < n; ++j) a(i, j) = products(places[at(i)], places[at(j)]);
    }
    const FewNumbers x = a.ldlt().solve(b);
    Fit fit;
    fit.error = std::numeric_limits<double>::infinity();
    if (!x.allFinite() || x.minCoeff() < 0.0) return fit;
    fit.error = target - 2.0 * b.dot(x) + x.dot(a * x);
    for (int i = 0; i < n; ++i) fit.coefficients[at(places[at(i)])] = x[i];
    return fit;
}

// The best of all choices of vectors that have no negative coefficient.
Fit best_fit(const Eigen::Matrix3d& products, const Vec3& with_target, double target) {
    Fit best;
    best.error = target;
    for (unsigned chosen = 1; chosen < 8; ++chosen) {
        const Fit fit = fit_of(products, with_target, target, chosen);
        if (fit.error < best.error) best = fit;
    }
    return best;
}

class GuideFitter {
  public:
    GuideFitter(const Strands& strands, const GuideSetOptions& options, const Context& context)
        : strands_(strands), options_(options), context_(context) {}

    GuideSet run() {
        const ClusterOptions clusters = clusters_of(strands_, options_);
        set_.points = options_.points;
        set_.strands = cluster_strands(strands_, clusters, context_).medoids;
        name_groups();
        measure();
        fit();
        add_details();
        return std::move(set_);
    }

  private:
    void name_groups() {
        if (strands_.groups().empty()) return;
        set_.group_names = strands_.group_names();
        for (const Index s : set_.strands) set_.groups.push_back(strands_.group(s));
    }

    void measure() {
        const Strands even = resample(strands_, {.count = options_.points}, context_);
        offsets_.resize(at(strands_.size()));
        for (Index s = 0; s < even.size(); ++s) {
            offsets_[at(s)] = Offsets::Zero(3 * options_.points);
            const StrandView strand = even.strand(s);
            for (Index k = 0; k < index_of(strand.cols()); ++k) {
                offsets_[at(s)].segment<3>(3 * k) = point_of(strand, k) - point_of(strand, 0);
            }
        }
        for (const Index s : set_.strands) {
            guides_of_group_[strands_.group(s)].push_back(count_of(set_.curves) / set_.points);
            const StrandView strand = even.strand(s);
            for (Index k = 0; k < set_.points; ++k) set_.curves.emplace_back(strand.col(k));
        }
    }

    void fit() {
        set_.guided.resize(at(strands_.size()));
        context_.parallel_for(0, strands_.size(), kSetGrain, [&](Index begin, Index end) {
            for (Index s = begin; s < end; ++s) set_.guided[at(s)] = fitted(s);
        });
    }

    const Offsets& guide(Index g) const { return offsets_[at(set_.strands[at(g)])]; }

    // Guides of the strand's group, the most alike first.
    std::vector<Index> candidates(Index s) const {
        const auto own = guides_of_group_.find(strands_.group(s));
        if (own == guides_of_group_.end()) return {0};
        std::vector<std::pair<double, Index>> order;
        for (const Index g : own->second) {
            const Index other = set_.strands[at(g)];
            const double roots = (strands_.root(s) - strands_.root(other)).squaredNorm();
            const double shapes = (offsets_[at(s)] - guide(g)).squaredNorm() / set_.points;
            order.emplace_back(roots + options_.shape * shapes, g);
        }
        const auto count = std::min<std::size_t>(kCandidates, order.size());
        std::partial_sort(order.begin(), order.begin() + std::ptrdiff_t(count), order.end());
        std::vector<Index> list;
        for (std::size_t i = 0; i < count; ++i) list.push_back(order[i].second);
        return list;
    }

    GuidedStrand fitted(Index s) const {
        GuidedStrand made;
        made.root = strands_.root(s);
        made.id = strands_.id(s);
        made.width = strands_.widths().at(s, strands_.first_point(s)) * strands_.widths().factor(0);
        const std::vector<Index> list = candidates(s);
        const int n = static_cast<int>(list.size());
        Eigen::MatrixXd products(n, n);
        Eigen::VectorXd with_target(n);
        for (int i = 0; i < n; ++i) {
            with_target[i] = guide(list[at(i)]).dot(offsets_[at(s)]);
            for (int j = 0; j <= i; ++j) {
                products(i, j) = products(j, i) = guide(list[at(i)]).dot(guide(list[at(j)]));
            }
        }
        choose(list, products, with_target, offsets_[at(s)].squaredNorm(), made);
        return made;
    }

    // The best three of the candidates.
    static void choose(const std::vector<Index>& list, const Eigen::MatrixXd& products,
                       const Eigen::VectorXd& with_target, double target, GuidedStrand& made) {
        const int n = static_cast<int>(list.size());
        double least = std::numeric_limits<double>::infinity();
        for (int a = 0; a < n; ++a) {
            for (int b = std::min(a + 1, n - 1); b < n; ++b) {
                for (int c = std::min(b + 1, n - 1); c < n; ++c) {
                    const std::array<int, 3> trio{a, b, c};
                    Eigen::Matrix3d part;
                    Vec3 with;
                    for (int i = 0; i < 3; ++i) {
                        with[i] = with_target[trio[at(i)]];
                        for (int j = 0; j < 3; ++j) part(i, j) = products(trio[at(i)], trio[at(j)]);
                    }
                    const Fit fit = best_fit(part, with, target);
                    if (fit.error >= least) continue;
                    least = fit.error;
                    set_weights(list, trio, fit, made);
                }
            }
        }
    }

    static void set_weights(const std::vector<Index>& list, const std::array<int, 3>& trio,
                            const Fit& fit, GuidedStrand& made) {
        std::array<int, 3> order{0, 1, 2};
        const auto& c = fit.coefficients;
        std::stable_sort(order.begin(), order.end(),
                         [&](int x, int y) { return c[at(x)] > c[at(y)]; });
        const double sum = c[0] + c[1] + c[2];
        made.length = static_cast<float>(sum);
        for (std::size_t i = 0; i < 3; ++i) {
            const int k = order[i];
            made.guides[i] = static_cast<std::uint32_t>(list[at(trio[at(k)])]);
            const double weight = sum > 0.0 ? c[at(k)] / sum : (i == 0 ? 1.0 : 0.0);
            made.weights[i] = static_cast<float>(weight);
        }
    }

    void add_details() {
        const std::vector<Eigen::Vector3f> made =
            rebuild_strands(set_, {.details = false}, context_);
        std::vector<Eigen::Vector3f> off(made.size());
        float largest = 0.0f;
        double squares = 0.0;
        for (std::size_t i = 0; i < made.size(); ++i) {
            const auto s = i / at(set_.points), k = i % at(set_.points);
            off[i] = set_.guided[s].root - made[i] +
                     offsets_[s].segment<3>(3 * index_of(k)).cast<float>();
            largest = std::max(largest, off[i].cwiseAbs().maxCoeff());
            squares += off[i].cast<double>().squaredNorm();
            const double distance = off[i].cast<double>().norm();
            if (set_.error.strand == kNoIndex || distance > set_.error.max) {
                set_.error.max = distance;
                set_.error.strand = index_of(s);
            }
        }
        set_.error.rms = std::sqrt(squares / std::max<std::size_t>(made.size(), 1));
        set_.detail_step = largest / static_cast<float>(kMaxDetail);
        set_.details.reserve(3 * off.size());
        for (const Eigen::Vector3f& p : off) {
            for (const float x : p) {
                const float steps = largest > 0.0f ? x / set_.detail_step : 0.0f;
                set_.details.push_back(static_cast<std::int16_t>(std::lround(steps)));
            }
        }
    }

    const Strands& strands_;
    const GuideSetOptions& options_;
    const Context& context_;
    std::vector<Offsets> offsets_;
    std::map<Index, std::vector<Index>> guides_of_group_;
    GuideSet set_;
};

Eigen::Vector3f detail_of(const GuideSet& set, std::size_t point) {
    Eigen::Vector3f detail;
    for (Index c = 0; c < 3; ++c) detail[c] = set.detail_step * set.details[3 * point + at(c)];
    return detail;
}

// The direction of a guide at a point, from the one before to the one after; may be zero.
Vec3 tangent_at(std::span<const Eigen::Vector3f> curves, std::size_t point, std::size_t points) {
    const std::size_t k = point % points;
    const std::size_t from = k > 0 ? point - 1 : point, to = k + 1 < points ? point + 1 : point;
    return (curves[to] - curves[from]).cast<double>();
}

// The least rotation of each point of the guides from rest.
std::vector<Eigen::Matrix3f> turns_of(const GuideSet& set,
                                      std::span<const Eigen::Vector3f> curves) {
    std::vector<Eigen::Matrix3f> turns(curves.size(), Eigen::Matrix3f::Identity());
    for (std::size_t p = 0; p < curves.size(); ++p) {
        const Vec3 rest = tangent_at(set.curves, p, at(set.points));
        const Vec3 moved = tangent_at(curves, p, at(set.points));
        if (rest.squaredNorm() == 0.0 || moved.squaredNorm() == 0.0) continue;
        turns[p] = min_rotation(rest, moved).toRotationMatrix().cast<float>();
    }
    return turns;
}

}  // namespace

GuideSet make_guide_set(const Strands& strands, const GuideSetOptions& options,
                        const Context& context) {
    require_set(options);
    require_strands(strands);
    const MemoryCharge charge = context.charge(
        at(strands.size()) * at(options.points) * 3 * sizeof(double), "the shapes of strands");
    return GuideFitter(strands, options, context).run();
}

std::vector<Eigen::Vector3f> rebuild_strands(const GuideSet& set, const RebuildOptions& options,
                                             const Context& context) {
    const std::span<const Eigen::Vector3f> rest = set.curves;
    const std::span<const Eigen::Vector3f> curves = options.curves.empty() ? rest : options.curves;
    require(curves.size() == rest.size(), "guides have another number of points");
    const std::size_t points = at(set.points);
    std::vector<Eigen::Matrix3f> turns;
    if (options.details && !options.curves.empty()) turns = turns_of(set, curves);
    std::vector<Eigen::Vector3f> made(set.guided.size() * points);
    context.parallel_for(0, count_of(set.guided), kSetGrain, [&](Index begin, Index end) {
        for (std::size_t s = at(begin); s < at(end); ++s) {
            const GuidedStrand& strand = set.guided[s];
            Eigen::Vector3f root = strand.root;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t first = strand.guides[i] * points;
                root += strand.weights[i] * (curves[first] - rest[first]);
            }
            for (std::size_t k = 0; k < points; ++k) {
                Eigen::Vector3f p = root;
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::size_t first = strand.guides[i] * points;
                    p += strand.length * strand.weights[i] * (curves[first + k] - curves[first]);
                }
                if (options.details) {
                    const Eigen::Vector3f detail = detail_of(set, s * points + k);
                    p += turns.empty() ? detail : turns[strand.guides[0] * points + k] * detail;
                }
                made[s * points + k] = p;
            }
        }
    });
    return made;
}

}  // namespace lissom
