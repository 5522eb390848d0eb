#include "kernel/hair/operators/strand_tails.h"

#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {

void carry_on(Strands& strands, const std::vector<CutStrand>& ends,
              const std::function<void(std::size_t, std::vector<Vec3>&)>& tail,
              const Context& context) {
    std::vector<std::vector<Vec3>> tails(ends.size());
    std::vector<MemoryCharge> charges(ends.size());
    context.parallel_for(0, count_of(ends), 64, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            context.checkpoint();
            tail(at(i), tails[at(i)]);
            charges[at(i)] =
                context.charge(tails[at(i)].capacity() * sizeof(Vec3), "tails of strands");
        }
    });
    std::vector<Index> place(at(strands.size()), kNoIndex);
    for (std::size_t i = 0; i < ends.size(); ++i) place[at(ends[i].strand)] = index_of(i);
    const auto find = [&](Index s, std::vector<StrandPlace>& places) {
        const Index i = place[at(s)];
        const Index last = i == kNoIndex ? strands.point_count(s) - 1 : ends[at(i)].last;
        for (Index k = 0; k <= last; ++k) places.push_back({k, 0.0f});
        if (i != kNoIndex) places.insert(places.end(), tails[at(i)].size(), {last, 0.0f});
    };
    Strands made = at_places(strands, find, context);
    Elements bad{ElementKind::strand, 0, {}};
    for (std::size_t i = 0; i < ends.size(); ++i) {
        StrandEdit strand = made.edit_strand(ends[i].strand);
        Index k = ends[i].last;
        for (const Vec3& p : tails[i]) strand.col(++k) = p.cast<float>();
        if (!strand.allFinite()) bad.add(ends[i].strand);
    }
    if (bad.count > 0) {
        const std::string names = describe(bad);
        throw Error(ErrorCode::not_finite, names + " would exceed the range of 32-bit numbers",
                    std::move(bad));
    }
    strands = std::move(made);
}

}  // namespace lissom
