#include "kernel/hair/style_roots.h"

#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

// More roots are made than wanted by this share, for those that fall on bare skin; then as many
// times more until there are enough.
constexpr double kSpare = 0.02;
constexpr double kMore = 4.0;

}  // namespace

std::vector<Root> roots_but_for(const Mesh& head, const Scalp& scalp, const RootOptions& options,
                                const std::function<bool(const Root&)>& bare,
                                const Context& context) {
    // make_roots refuses what it can't make.
    if (!bare || options.count <= 0 || options.count > kMaximumRoots) {
        return make_roots(head, scalp, options, context);
    }
    const auto wanted = static_cast<std::size_t>(options.count);
    const auto at_most = [](double count) {
        return static_cast<Index>(std::min<double>(count, kMaximumRoots));
    };
    RootOptions more = options;
    more.count = at_most(std::ceil((1.0 + kSpare) * options.count));
    for (;; more.count = at_most(kMore * more.count)) {
        std::vector<Root> roots = make_roots(head, scalp, more, context);
        std::erase_if(roots, bare);
        if (roots.size() >= wanted || more.count >= kMaximumRoots) {
            if (roots.empty()) {
                throw Error(ErrorCode::region_empty,
                            "the gaps of the dividing curves leave no scalp for hair; make them "
                            "narrower");
            }
            roots.resize(std::min(wanted, roots.size()));
            return roots;
        }
    }
}

}  // namespace lissom
