#include "kernel/hair/style_roots.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/hair/scalp/root_uvs.h"

namespace lissom {
namespace {

// More roots are made than wanted by this share, to replace the ones on bare skin; then as many
// times more until there are enough.
constexpr double kSpare = 0.02;
constexpr double kMore = 4.0;
// Roots are spread evenly: if as many are all on bare skin, all skin is bare.
constexpr Index kEnoughToTell = 20'000;
// Roots between looks whether to stop.
constexpr std::size_t kRootsAPoll = 4096;

// Takes out the roots on bare skin.
void keep_hairy(std::vector<Root>& roots, const std::function<bool(const Root&)>& bare,
                const Context& context) {
    std::size_t seen = 0;
    std::erase_if(roots, [&](const Root& root) {
        if (seen++ % kRootsAPoll == 0) context.checkpoint();
        return bare(root);
    });
}

// Calls `visit` with each dividing curve that leaves bare skin.
template <typename Visit>
void for_gaps(const DerivedStyle& style, const Visit& visit) {
    for (std::size_t c = 0; c < style.ids.size(); ++c) {
        const DerivedCurve& derived = *style.curves[c];
        if (style.inputs.curves[c].curve.enabled && derived.line && derived.gap > 0.0) {
            visit(derived);
        }
    }
}

RootKey key_of(const RootOptions& options, const DerivedStyle& style) {
    RootKey key{options, {}};
    for_gaps(style, [&](const DerivedCurve& one) { key.gaps.push_back({one.course, one.gap}); });
    return key;
}

StyleRoots made_roots(RootKey key, const HeadShapes& head, const DerivedStyle& style,
                      const Context& context) {
    std::function<bool(const Root&)> on_gap;
    if (!key.gaps.empty()) {
        on_gap = [&](const Root& root) {
            const Vec3 p = head.scalp.to_metres(root.position);
            bool bare = false;
            for_gaps(style, [&](const DerivedCurve& one) {
                bare = bare || one.line->skin_distance(p) < 0.5 * one.gap;
            });
            return bare;
        };
    }
    std::vector<Root> roots =
        roots_but_for(head.original, head.scalp, key.options, on_gap, context);
    std::vector<Eigen::Vector2f> uvs = root_uvs(head.original, head.scalp, roots);
    for (Root& root : roots) {
        root.position = head.scalp.to_metres(root.position);
        root.normal = head.scalp.frame().axes.transpose() * root.normal;
    }
    return {std::move(key), std::move(uvs), StrandGrower(head.placed, roots, context)};
}

}  // namespace

void update_roots(std::optional<StyleRoots>& roots, const HeadShapes& head,
                  const RootOptions& options, const DerivedStyle& style, const Context& context) {
    RootKey key = key_of(options, style);
    if (roots && roots->key == key) return;
    // Before the new ones are made: both may not fit into memory.
    roots.reset();
    roots.emplace(made_roots(std::move(key), head, style, context));
}

std::vector<Root> roots_but_for(const Mesh& head, const Scalp& scalp, const RootOptions& options,
                                const std::function<bool(const Root&)>& bare,
                                const Context& context) {
    // make_roots refuses invalid options.
    if (!bare || options.count <= 0 || options.count > kMaximumRoots) {
        return make_roots(head, scalp, options, context);
    }
    const std::size_t wanted = options.count;
    const auto at_most = [](double count) {
        return static_cast<Index>(std::min<double>(count, kMaximumRoots));
    };
    RootOptions more = options;
    more.count = at_most(std::ceil((1.0 + kSpare) * options.count));
    for (;; more.count = at_most(kMore * more.count)) {
        std::vector<Root> roots = make_roots(head, scalp, more, context);
        keep_hairy(roots, bare, context);
        const bool enough = roots.size() >= wanted || more.count >= kMaximumRoots;
        if (enough || (roots.empty() && more.count >= kEnoughToTell)) {
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
