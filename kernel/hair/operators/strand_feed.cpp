#include "kernel/hair/operators/strand_feed.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kernel/core/error.h"
#include "kernel/hair/operators/braid_spine.h"
#include "kernel/hair/operators/strand_cut.h"
#include "kernel/hair/operators/strand_tails.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

constexpr std::uint64_t kTubeStream = 71, kSectionStream = 72, kRunStream = 73, kTailStream = 74;
// Strands that come within so many reaches join at their nearest point.
constexpr double kFarthest = 2.5;

// In [0, 1).
double feed_random(std::uint64_t seed, std::uint64_t id, std::uint64_t stream) {
    return 0.5 + 0.5 * signed_random(mixed(seed, id, stream));
}

bool is_above_zero(double value) {
    return value > 0.0 && std::isfinite(value);
}
bool is_fraction(double value) {
    return value >= 0.0 && value <= 1.0;
}

void require_feed(const Strands& strands, const FeedBraidOptions& options) {
    require_operator(strands, options);
    require_spine(options.spine, options.across);
    require(is_above_zero(options.radius) && is_above_zero(options.reach) &&
                is_above_zero(options.blend) && is_above_zero(options.step) &&
                is_above_zero(options.min_run) && is_above_zero(options.begin) &&
                is_above_zero(options.end),
            "'radius', 'reach', 'blend', 'run', 'begin', 'end' and 'step' of a feed-in braid must "
            "be positive and finite");
    require(options.max_run >= options.min_run && std::isfinite(options.max_run),
            "the longest run in a braid must not be below the shortest");
    require(options.wide >= 0.0 && options.high >= 0.0 && options.wavelength >= 0.0 &&
                std::isfinite(options.wide + options.high + options.wavelength),
            "'wide', 'high' and 'wavelength' of a feed-in braid must be finite and not negative");
    require(options.joined > 0.0 && options.joined <= 1.0 && is_fraction(options.tail) &&
                is_fraction(options.loose),
            "'joined', 'tail' and 'loose' of a feed-in braid are parts from 0 to 1");
}

// A strand that joins after its point `last`, at an arc of the spine.
struct Joint {
    CutStrand end;
    double arc;
};

// Strands of one point or without length stay as they are.
bool has_length(const StrandView& strand) {
    for (Index k = 1; k < strand.cols(); ++k) {
        if (strand.col(k) != strand.col(0)) return true;
    }
    return false;
}

std::optional<Joint> joint_of(const Strands& strands, Index s, const BraidSpine& spine,
                              const FeedBraidOptions& options) {
    const StrandView strand = strands.strand(s);
    const double most = options.joined * spine.length();
    std::optional<Joint> found;
    double nearest = kFarthest * options.reach;
    for (Index k = 0; k < strand.cols() && nearest >= options.reach; ++k) {
        const BraidSpine::Nearest at = spine.nearest(point_of(strand, k), most);
        if (!(at.distance < nearest)) continue;
        nearest = at.distance;
        found = Joint{{s, k}, at.arc};
    }
    return found;
}

std::vector<Joint> joints_of(const Strands& strands, const BraidSpine& spine,
                             const FeedBraidOptions& options, const Context& context) {
    std::vector<std::optional<Joint>> all(at(strands.size()));
    context.parallel_for(0, strands.size(), 256, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) {
            if (!options.mask.empty() && options.mask[at(s)] < 0.5f) continue;
            context.checkpoint();  // a spine may have many points
            const StrandView strand = strands.strand(s);
            if (strand.allFinite() && has_length(strand))
                all[at(s)] = joint_of(strands, s, spine, options);
        }
    });
    std::vector<Joint> joints;
    for (const std::optional<Joint>& joint : all) {
        if (joint) joints.push_back(*joint);
    }
    return joints;
}

class Feeder {
  public:
    Feeder(const FeedBraidOptions& options, const BraidSpine& spine)
        : options_(options),
          spine_(spine),
          wide_(options.wide > 0.0 ? options.wide : 1.25 * options.radius),
          high_(options.high > 0.0 ? options.high : 0.8 * options.radius),
          wavelength_(options.wavelength > 0.0 ? options.wavelength : 7.0 * options.radius) {}

    void run(const Strands& strands, const Joint& joint, std::vector<Vec3>& points) const {
        const Section section = section_of(strands.id(joint.end.strand));
        const Entry entry = entry_of(strands, joint);
        const double end = end_of(strands.id(joint.end.strand), joint.arc);
        for (double a = options_.step; joint.arc + a < end; a += options_.step) {
            points.push_back(place(joint.arc, a, end, section, entry));
        }
    }

  private:
    // Place of a strand in its tube, and the number of that.
    struct Section {
        int tube;
        double rho, turn;
    };
    // Offset from the spine where a strand joins, and its direction: across, to the viewer, along.
    struct Entry {
        Vec3 offset, direction;
    };

    Section section_of(std::uint32_t id) const {
        const auto random = [&](std::uint64_t stream) {
            return feed_random(options_.seed, id, stream);
        };
        const double u = random(kSectionStream + 100);
        const bool loose = random(kSectionStream + 200) < options_.loose;
        return {std::min(2, static_cast<int>(3.0 * random(kTubeStream))),
                loose ? 1.1 + 0.3 * u : std::sqrt(u), random(kSectionStream)};
    }

    Entry entry_of(const Strands& strands, const Joint& joint) const {
        const StrandView strand = strands.strand(joint.end.strand);
        const Vec3 at = point_of(strand, joint.end.last);
        const Vec3 offset = spine_.local(joint.arc, at - spine_.place(joint.arc, 0.0, 0.0, 0.0));
        if (joint.end.last == 0) return {offset, Vec3::Zero()};
        const Vec3 along = at - point_of(strand, joint.end.last - 1);
        const double size = along.norm();
        return {offset, size > 0.0 ? spine_.local(joint.arc, along / size) : Vec3::Zero()};
    }

    double end_of(std::uint32_t id, double arc) const {
        const double u = feed_random(options_.seed, id, kRunStream);
        if (feed_random(options_.seed, id, kTailStream) < options_.tail) {
            return spine_.length() * (1.0 - 0.06 * u);
        }
        const double run = options_.min_run + u * (options_.max_run - options_.min_run);
        return std::min(spine_.length(), arc + run);
    }

    double size_at(double arc) const {
        const double t = arc / spine_.length();
        return (options_.begin + (1.0 - options_.begin) * smooth_step(0.0, 0.25, t)) *
               (1.0 + (options_.end - 1.0) * smooth_step(0.8, 1.0, t));
    }

    // Across, to the viewer and along, from the spine's point at the arc.
    Vec3 in_tube(double arc, double end, const Section& section) const {
        const double size = size_at(arc), turns = arc / wavelength_ + section.tube / 3.0;
        const double slope = wide_ * size * 2.0 * kPi / wavelength_ * cosine_of_turns(turns);
        const double tilt = std::sqrt(1.0 + slope * slope);
        // Ends shrink into the braid.
        const double hidden = 1.0 - 0.5 * smooth_step(end - 0.02, end, arc);
        const double reach = section.rho * options_.radius * size * hidden;
        const double across = 1.15 * reach * cosine_of_turns(section.turn);
        return {
            wide_ * size * sine_of_turns(turns) + across / tilt,
            high_ * size * sine_of_turns(2.0 * turns) + 0.9 * reach * sine_of_turns(section.turn),
            -across * slope / tilt};
    }

    Vec3 place(double from, double a, double end, const Section& section,
               const Entry& entry) const {
        const double u = std::min(1.0, a / options_.blend), w = smooth_step(0.0, 1.0, u);
        // Leaves in the direction of the strand: a bump that has its slope at the beginning.
        const double bump = options_.blend * u * (1.0 - u) * (1.0 - u);
        Vec3 carried = entry.offset + bump * entry.direction;
        carried.z() -= bump;
        const Vec3 at = carried + w * (in_tube(from + a, end, section) - carried);
        return spine_.place(from + a, at.x(), at.y(), at.z());
    }

    const FeedBraidOptions& options_;
    const BraidSpine& spine_;
    double wide_, high_, wavelength_;
};

void drop_others(Strands& strands, const FeedBraidOptions& options,
                 const std::vector<Joint>& joints) {
    std::vector<char> marks(at(strands.size()), 1);
    for (std::size_t s = 0; s < options.mask.size(); ++s) marks[s] = options.mask[s] >= 0.5f;
    for (const Joint& joint : joints) marks[at(joint.end.strand)] = 0;
    cull(strands, marks);
}

}  // namespace

BraidReport feed_braid(Strands& strands, const FeedBraidOptions& options, const Context& context) {
    require_feed(strands, options);
    Progress progress(context, "braid strands");
    const BraidSpine spine(options.spine, options.across);
    require((spine.length() + options.blend) / options.step < 1e5,
            "the step of a braid is too small for its length");
    const std::vector<Joint> joints = joints_of(strands, spine, options, context);
    require(!joints.empty(), "no strand comes near the spine; move it, or give it more reach");
    const Feeder feeder(options, spine);
    std::vector<CutStrand> ends;
    for (const Joint& joint : joints) ends.push_back(joint.end);
    const BraidReport report{count_of(joints), strands.size() - count_of(joints)};
    carry_on(
        strands, ends,
        [&](std::size_t i, std::vector<Vec3>& points) { feeder.run(strands, joints[i], points); },
        context);
    if (options.drop_others) drop_others(strands, options, joints);
    return report;
}

}  // namespace lissom
