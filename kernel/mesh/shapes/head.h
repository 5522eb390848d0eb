/// A generated head to show hair on.
#pragma once

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A bald, stylised head with neck and shoulders: one closed surface of quads, symmetric in x, that
/// faces +z. The origin lies between the ears; with the default height the unit is the metre and
/// the proportions are those of an adult: the head is 0.155 wide and 0.19 long above the ears. The
/// bust ends in a flat bottom. Regions: "scalp" (above the default hairline, without the ears),
/// "ears", "bottom".
struct HeadOptions {
    /// From the bottom of the bust to the crown.
    double height = 0.4;
    /// Vertices wanted; the result is within 10 %. 3,000 to 500,000; the face gets more of them
    /// than its share.
    Index vertices = 10000;
};

/// Errors: invalid_argument for an option out of range; memory_limit; cancelled.
Mesh make_head(const HeadOptions& options = {}, const Context& context = {});

}  // namespace lissom
