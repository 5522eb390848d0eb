/// The points of strands that grow in lanes: a list a lane, one strand behind the other; private to
/// kernel/hair. Included as growth_lanes.h is, and compiled for the same processor.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/hair/growth/growth.h"
#include "kernel/hair/growth/growth_lanes.h"
#include "kernel/hair/growth/growth_loops.h"
#include "kernel/hair/growth/lane_strands.h"
#include "kernel/hair/growth/lane_vectors.h"

LISSOM_LANES_BEGIN
namespace lissom::LISSOM_LANES {

class LaneLists {
  public:
    LaneLists(const GrowthRules& rules, StrandBatch& batch) : rules_(rules), batch_(batch) {
        batch_.lists.resize(kLanes);
        for (int k = 0; k < kLanes; ++k) make_room(k);
    }

    // Puts the root of a strand into lane k, which has finished the one before.
    void put_root(int k, const Eigen::Vector3f& at) {
        const Eigen::Vector3f root_point = (rules_.linear * at).eval() + rules_.translation;
        std::copy_n(root_point.data(), 3, ends_[k] - 3);
    }

    // Puts points behind the segments that the strands have; those of lanes that do not take them
    // are overwritten later. Returns the segments with those taken.
    LISSOM_INLINE Ints put_points(const Floats3& to, const Ints& segments, const Ints& take) {
        const Eigen::Matrix3f& m = rules_.linear;
        const Floats x = all(rules_.translation[0]) + all(m(0, 0)) * to.x + all(m(0, 1)) * to.y +
                         all(m(0, 2)) * to.z;
        const Floats y = all(rules_.translation[1]) + all(m(1, 0)) * to.x + all(m(1, 1)) * to.y +
                         all(m(1, 2)) * to.z;
        const Floats z = all(rules_.translation[2]) + all(m(2, 0)) * to.x + all(m(2, 1)) * to.y +
                         all(m(2, 2)) * to.z;
        float rows[4][kLanes];
        store_rows(x, y, z, rows);
        const Ints places = segments + segments + segments;
        for (int k = 0; k < kLanes; ++k) {
            std::memcpy(ends_[k] + places[k], rows[k % 4] + k / 4 * 4, 4 * sizeof(float));
        }
        const Ints taken = segments - take;
        const Ints full = taken > capacity_;
        if (any(full)) enlarge(full);
        return taken;
    }

    // Closes the strand of lane k, that of seed `seed`, and makes room for the next.
    void close(int k, std::size_t seed, Index segments, Index tie, StrandEnd end) {
        const std::size_t lane = k;
        batch_.strands[seed] = {lane, starts_[lane], segments + 1, tie, end};
        starts_[lane] += 3 * at(segments + 1);
        make_room(k);
    }

  private:
    static constexpr std::size_t kFirstBuffer = 64;

    std::vector<float>& list(int k) { return batch_.lists[k]; }

    void enlarge(const Ints& full) {
        for (int k = 0; k < kLanes; ++k) {
            if (!full[k]) continue;
            list(k).resize(2 * list(k).size());
            find_end(k);
        }
    }

    void make_room(int k) {
        const std::size_t needed = starts_[k] + 3 * kFirstBuffer;
        if (list(k).size() < needed) list(k).resize(2 * needed);
        find_end(k);
    }

    void find_end(int k) {
        const std::size_t start = starts_[k];
        ends_[k] = list(k).data() + start + 3;
        capacity_[k] = index_of((list(k).size() - start) / 3) - 3;
    }

    // Segments for which there is room.
    Ints capacity_{};
    const GrowthRules& rules_;
    StrandBatch& batch_;
    // The beginning of each lane's strand in its list, and its continuation after the root.
    std::array<std::size_t, kLanes> starts_{};
    float* ends_[kLanes]{};
};

}  // namespace lissom::LISSOM_LANES
LISSOM_LANES_END
