#include "kernel/hair/dynamics/hair_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/nearest.h"
#include "kernel/core/rotation.h"

namespace lissom {
namespace {

constexpr int kMaxLinks = 8;
// Of memory, for each point of a guide and for each of its links.
constexpr std::size_t kPointBytes = 160, kLinkBytes = 96;

void require_rig(const GuideSet& set, const HairRigOptions& options) {
    require(set.guide_count() > 0 && set.points >= 3, "a rig needs guides of three points or more");
    require(options.reach >= 0.0 && std::isfinite(options.reach), "the reach is 0 or more");
    require(options.links >= 0 && options.links <= kMaxLinks, "a point has 0 to 8 links");
    for (const RigTie& tie : options.ties) {
        require(tie.center.allFinite() && tie.radius > 0.0 && std::isfinite(tie.radius),
                "a tie has a finite center and a radius above 0");
    }
}

Vec3 place_of(const GuideSet& set, Index point) {
    return set.curves[at(point)].cast<double>();
}

void add_chains(const GuideSet& set, HairRig& rig) {
    for (Index g = 0; g < set.guide_count(); ++g) {
        const Index first = g * set.points;
        rig.ids.push_back(set.guided[at(set.strands[at(g)])].id);
        for (Index k = first; k + 1 < first + set.points; ++k) {
            rig.lengths.push_back((set.curves[at(k + 1)] - set.curves[at(k)]).norm());
        }
        const Vec3 along = place_of(set, first + 1) - place_of(set, first);
        const auto frame = along.squaredNorm() > 0.0 ? min_rotation(Vec3::UnitZ(), along)
                                                     : Eigen::Quaterniond::Identity();
        rig.root_frames.push_back(frame.cast<float>());
    }
}

void add_ties(const GuideSet& set, const std::vector<RigTie>& ties, HairRig& rig) {
    for (const RigTie& tie : ties) {
        TiedPoints tied{tie, {}};
        for (Index p = 0; p < count_of(set.curves); ++p) {
            if ((place_of(set, p) - tie.center).norm() <= tie.radius) tied.points.push_back(p);
        }
        require(!tied.points.empty(),
                "the tie '" + tie.name + "' holds no point of a guide; move it, or make it larger");
        rig.ties.push_back(std::move(tied));
    }
}

// Groups of the set that are bound.
std::vector<bool> bound_groups(const GuideSet& set, const std::vector<std::string>& names) {
    std::vector<bool> bound(set.group_names.size(), false);
    for (const std::string& name : names) {
        const auto found = std::find(set.group_names.begin(), set.group_names.end(), name);
        const std::vector<std::string_view> known(set.group_names.begin(), set.group_names.end());
        require(found != set.group_names.end(),
                "the strands have no group '" + name + "'" +
                    (known.empty() ? "; they have no groups" : name_hint(name, known)));
        bound[static_cast<std::size_t>(found - set.group_names.begin())] = true;
    }
    return bound;
}

// Finds the nearest points of other guides by cells as large as the reach.
class LinkFinder {
  public:
    LinkFinder(const GuideSet& set, const HairRigOptions& options)
        : set_(set), options_(options), bound_(bound_groups(set, options.bound)) {
        // Places far out share the last cells.
        if (options.reach > 0.0) {
            for (Index p = 0; p < count_of(set.curves); ++p) {
                cells_[cell_of(place_of(set, p))].push_back(p);
            }
        }
    }

    std::vector<HairLink> run(const Context& context) const {
        std::map<std::pair<Index, Index>, HairLink> links;
        if (cells_.empty() || options_.links == 0) return {};
        for (Index p = 0; p < count_of(set_.curves); ++p) {
            if (p % set_.points == 0) context.checkpoint();
            // Roots and the first points are held by the head.
            if (p % set_.points < 2) continue;
            for (const auto& [distance, q] : nearest(p)) {
                const Index a = std::min(p, q), b = std::max(p, q);
                links[{a, b}] = {a, b, static_cast<float>(distance), is_bound(a, b)};
            }
        }
        std::vector<HairLink> list;
        for (const auto& [key, link] : links) list.push_back(link);
        return list;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const Vec3& place) const {
        Cell cell{};
        for (std::size_t c = 0; c < 3; ++c) {
            const double step = std::floor(place[index_of(c)] / options_.reach);
            cell[c] = static_cast<std::int64_t>(std::clamp(step, -1e15, 1e15));
        }
        return cell;
    }

    Index group_of(Index point) const {
        return set_.groups.empty() ? kNoIndex : set_.groups[at(point / set_.points)];
    }

    bool is_bound(Index a, Index b) const {
        const Index group = group_of(a);
        return group != kNoIndex && group == group_of(b) && bound_[at(group)];
    }

    // The nearest points within the reach, one of each other guide, nearest first.
    std::vector<std::pair<double, Index>> nearest(Index p) const {
        const Vec3 place = place_of(set_, p);
        const Cell middle = cell_of(place);
        std::map<Index, std::pair<double, Index>> of_guide;
        for (std::int64_t i = 0; i < 27; ++i) {
            const Cell cell{middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1,
                            middle[2] + i / 9 - 1};
            const auto found = cells_.find(cell);
            if (found == cells_.end()) continue;
            for (const Index q : found->second) {
                const double distance = (place_of(set_, q) - place).norm();
                const bool is_other = q / set_.points != p / set_.points && q % set_.points >= 2;
                if (!is_other || distance > options_.reach) continue;
                const std::pair<double, Index> mine{distance, q};
                const auto [known, is_new] = of_guide.insert({q / set_.points, mine});
                if (!is_new && mine < known->second) known->second = mine;
            }
        }
        std::vector<std::pair<double, Index>> list;
        for (const auto& [guide, one] : of_guide) list.push_back(one);
        std::sort(list.begin(), list.end());
        list.resize(std::min(list.size(), static_cast<std::size_t>(options_.links)));
        return list;
    }

    const GuideSet& set_;
    const HairRigOptions& options_;
    std::vector<bool> bound_;
    std::map<Cell, std::vector<Index>> cells_;
};

std::vector<float> rebuilt_lengths(const GuideSet& set, const Context& context) {
    const std::vector<Eigen::Vector3f> points = rebuild_strands(set, {}, context);
    std::vector<float> lengths(set.guided.size(), 0.0f);
    for (std::size_t s = 0; s < lengths.size(); ++s) {
        for (std::size_t k = s * at(set.points); k + 1 < (s + 1) * at(set.points); ++k) {
            lengths[s] += (points[k + 1] - points[k]).norm();
        }
    }
    return lengths;
}

void add_capsules(const HairRigOptions& options, HairRig& rig, const Context& context) {
    Box box;
    for (const Eigen::Vector3f& p : rig.curves) box.extend(p.cast<double>());
    BodyCapsules fitted = fit_capsules(options.body, box, options.capsules, context);
    rig.capsules = std::move(fitted.capsules);
    rig.capsule_cover = fitted.covered;
}

}  // namespace

std::size_t HairRig::memory_bytes() const {
    std::size_t bytes = curves.size() * sizeof(Eigen::Vector3f) + ids.size() * 4 +
                        (lengths.size() + strand_lengths.size()) * sizeof(float) +
                        root_frames.size() * sizeof(Eigen::Quaternionf) +
                        links.size() * sizeof(HairLink) + capsules.size() * sizeof(Capsule);
    for (const TiedPoints& tied : ties) {
        bytes += sizeof tied + tied.tie.name.size() + tied.points.size() * sizeof(Index);
    }
    return bytes;
}

HairRig make_hair_rig(const GuideSet& set, const HairRigOptions& options, const Context& context) {
    require_rig(set, options);
    // Entries of maps while links are found, and the lists of the rig.
    const std::size_t each = kPointBytes + kLinkBytes * static_cast<std::size_t>(options.links);
    const MemoryCharge charge = context.charge(set.curves.size() * each, "the rig of hair");
    HairRig rig;
    rig.points = set.points;
    rig.curves = set.curves;
    add_chains(set, rig);
    add_ties(set, options.ties, rig);
    rig.links = LinkFinder(set, options).run(context);
    rig.strand_lengths = rebuilt_lengths(set, context);
    if (options.body) add_capsules(options, rig, context);
    return rig;
}

}  // namespace lissom
