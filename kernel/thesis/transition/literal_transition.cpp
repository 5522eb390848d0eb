#include "kernel/thesis/transition/literal_transition.h"

#include <memory>
#include <utility>

#include "kernel/thesis/transition/thesis_merge.h"
#include "kernel/thesis/transition/thesis_overlap.h"

namespace lissom {
namespace {

class LiteralTransition final : public OverlapTransition {
  public:
    OpenedForOverlap open(const Mesh& target, std::span<const std::vector<Index>> loops,
                          double width, const Context& context) const override {
        return open_for_overlap(target, loops, width, context);
    }

    Index cut_from(const OverlapTarget& whole, const std::vector<Index>& loop,
                   Index start) const override {
        return cut_end(whole.mesh, target_band_loop(whole.mesh, loop, start), whole.width, {});
    }

    std::shared_ptr<OverlapMerge> begin(const OverlapTarget& whole, const Mesh& opened,
                                        const Mesh& source, std::vector<OverlapJoin> joins,
                                        double weight, const Context& context) const override {
        return std::make_shared<ThesisMerge>(whole, opened, source, std::move(joins), weight,
                                             context);
    }
};

}  // namespace

const OverlapTransition& literal_transition() {
    static const LiteralTransition transition;
    return transition;
}

}  // namespace lissom
