/// Roots of a hairstyle, but for those on bare skin; private to kernel/hair.
#pragma once

#include <functional>
#include <vector>

#include "kernel/hair/scalp/roots.h"

namespace lissom {

/// As make_roots, but for the roots for which `bare(root)` is true, where it is given; the first n
/// of a larger count are those of count n. Errors: as make_roots; region_empty where all skin is
/// bare.
std::vector<Root> roots_but_for(const Mesh& head, const Scalp& scalp, const RootOptions& options,
                                const std::function<bool(const Root&)>& bare,
                                const Context& context);

}  // namespace lissom
