/// The limit below which a face has no direction; private to the kernel.
#pragma once

namespace lissom {

/// A face is flat if its area is at most this fraction of its longest edge squared.
constexpr double kFlatFace = 1e-14;

}  // namespace lissom
