#include "kernel/hair/operators/strand_bend.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

constexpr std::uint64_t kAngleStream = 41, kBendLengthStream = 42;

void require_center(const std::optional<Vec3>& center, const char* message) {
    require(!center || center->allFinite(), message);
}

Vec3 middle_of_roots(const Strands& strands) {
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    for (Index s = 0; s < strands.size(); ++s) {
        const Vec3 root = strands.root(s).cast<double>();
        if (!root.allFinite()) continue;
        sum += root;
        count += 1.0;
    }
    return count > 0.0 ? Vec3(sum / count) : sum;
}

Vec3 unit_or_zero(const Vec3& v) {
    const double size = v.norm();
    return size > 0.0 ? Vec3(v / size) : Vec3::Zero();
}

// The direction of the first segment that has a length.
Vec3 first_direction(const StrandWork& work) {
    for (Index k = 1; k < work.count(); ++k) {
        if (work.arc(k) > 0.0) return unit_or_zero(work.old_point(k) - work.old_point(0));
    }
    return Vec3::Zero();
}

// Turns the segment before each point about the axis by angle(k).
template <typename Angle>
void turn_segments(StrandWork& work, const Vec3& axis, const Angle& angle) {
    Vec3 before = work.old_point(0), end = before;
    double last = 0.0, c = 1.0, s = 0.0;
    for (Index k = 1; k < work.count(); ++k) {
        const Vec3 here = work.old_point(k), segment = here - before;
        before = here;
        // Often all turn alike.
        const double turns = angle(k) * (0.5 / kPi);
        if (turns != last) {
            c = cosine_of_turns(turns);
            s = sine_of_turns(turns);
            last = turns;
        }
        end += c * segment + s * axis.cross(segment) + (1.0 - c) * axis.dot(segment) * axis;
        work.set_point(k, end);
    }
}

}  // namespace

void straighten(Strands& strands, const StrandOperatorOptions& options, const Context& context) {
    Progress progress(context, "straighten strands");
    const auto change = [&](StrandWork& work) {
        const Vec3 root = work.old_point(0);
        Vec3 along = unit_or_zero(work.old_point(work.count() - 1) - root);
        if (along.isZero()) along = first_direction(work);
        for (Index k = 1; k < work.count(); ++k) work.set_point(k, root + work.arc(k) * along);
        work.blend();
    };
    change_strands(strands, options, change, context);
}

void rotate(Strands& strands, const RotateOptions& options, const Context& context) {
    require(!options.axis || (options.axis->allFinite() && options.axis->norm() > 0.0),
            "the axis of a rotation must be finite and not 0");
    require(std::isfinite(options.angle) && std::isfinite(options.variation),
            "the angle of a rotation and its variation must be finite");
    Progress progress(context, "rotate strands");
    const auto change = [&](StrandWork& work) {
        const Vec3 axis = options.axis ? options.axis->normalized() : first_direction(work);
        const double random = signed_random(mixed(options.seed, work.id(), kAngleStream));
        const double angle = options.angle + options.variation * random;
        turn_segments(work, axis, [&](Index k) { return angle * work.weight(k); });
    };
    change_strands(strands, options, change, context);
}

void roll(Strands& strands, const RollOptions& options, const Context& context) {
    require(options.radius > 0.0 && std::isfinite(options.radius),
            "the radius of a roll must be positive and finite");
    require(options.start >= 0.0 && options.start < 1.0,
            "the start of a roll must be at least 0 and below 1");
    require_center(options.center, "the center of a roll must be finite");
    Progress progress(context, "roll strands");
    const Vec3 center = options.center.value_or(middle_of_roots(strands));
    const auto change = [&](StrandWork& work) {
        const double from = options.start * work.length();
        Index below = 0;
        const Vec3 begin = work.old_at(from, below);
        const Vec3 along = unit_or_zero(work.old_point(below + 1) - work.old_point(below));
        const Vec3 inward = options.outward ? Vec3(begin - center) : Vec3(center - begin);
        const Vec3 axis = unit_or_zero(along.cross(inward));
        turn_segments(work, axis, [&](Index k) {
            const double middle = 0.5 * (work.arc(k) + work.arc(k - 1));
            return std::max(0.0, middle - from) / options.radius * work.weight(k);
        });
    };
    change_strands(strands, options, change, context);
}

void puff(Strands& strands, const PuffOptions& options, const Context& context) {
    require(std::isfinite(options.amount), "the amount of puff must be finite");
    require_center(options.center, "the center of puff must be finite");
    Progress progress(context, "puff strands");
    const Vec3 center = options.center.value_or(middle_of_roots(strands));
    const auto change = [&](StrandWork& work) {
        for (Index k = 1; k < work.count(); ++k) {
            const Vec3 old = work.old_point(k);
            const Vec3 away = old - center;
            const double size = away.norm();
            if (size > 0.0) work.set_point(k, old + (options.amount / size) * away);
        }
        work.blend();
    };
    change_strands(strands, options, change, context);
}

void displace(Strands& strands, const DisplaceOptions& options, const Context& context) {
    require(options.offset.allFinite(), "the offset must be finite");
    require(options.offsets.empty() || count_of(options.offsets) == strands.size(),
            "there are " + std::to_string(options.offsets.size()) + " offsets for " +
                std::to_string(strands.size()) + " strands; give one for each strand");
    for (const Vec3& offset : options.offsets)
        require(offset.allFinite(), "offsets must be finite");
    Progress progress(context, "displace strands");
    const auto change = [&](StrandWork& work) {
        Vec3 offset = options.offset;
        if (!options.offsets.empty()) offset += options.offsets[at(work.strand())];
        for (Index k = 1; k < work.count(); ++k) work.set_point(k, work.old_point(k) + offset);
        work.blend();
    };
    change_strands(strands, options, change, context);
}

void set_length(Strands& strands, const LengthOptions& options, const Context& context) {
    require(!options.length || (*options.length > 0.0 && std::isfinite(*options.length)),
            "the length of strands must be positive and finite");
    require(options.scale > 0.0 && std::isfinite(options.scale),
            "the scale of lengths must be positive and finite");
    require(options.variation >= 0.0 && options.variation < 1.0,
            "the variation of lengths must be at least 0 and below 1");
    Progress progress(context, "set lengths of strands");
    std::vector<double> scales(strands.guides().arcs.empty() ? 0 : at(strands.size()), 1.0);
    const auto change = [&](StrandWork& work) {
        const double random = signed_random(mixed(options.seed, work.id(), kBendLengthStream));
        const double wanted = options.length.value_or(work.length()) * options.scale *
                              (1.0 + options.variation * random);
        const double part = work.weight_at(1.0);
        const double scale = 1.0 + part * (wanted / work.length() - 1.0);
        const Vec3 root = work.old_point(0);
        for (Index k = 1; k < work.count(); ++k) {
            work.set_point(k, root + scale * (work.old_point(k) - root));
        }
        if (!scales.empty()) scales[at(work.strand())] = scale;
    };
    StrandGuides guides = strands.guides();
    change_strands(strands, options, change, context);
    for (std::size_t s = 0; s < scales.size(); ++s) {
        guides.arcs[s] = static_cast<float>(guides.arcs[s] * scales[s]);
    }
    strands.set_guides(std::move(guides));
}

}  // namespace lissom
