/// Meaning of the constraints of style curves (thesis, Figures 4.4 and 4.5). It is the tag of the
/// GridConstraints of style curves.
#pragma once

#include <string_view>

namespace lissom {

enum class ConstraintKind {
    stream,      ///< along a stream curve (blue in Figure 4.5)
    stop,        ///< vanishing beyond the end of a stream curve or spine (red in Figure 4.5)
    parting,     ///< along the Gaussian beside a dividing curve (blue in Figure 4.4)
    separation,  ///< above it, keeping the sides apart (red in Figure 4.4)
    section,     ///< along a ponytail near its cross sections (purple in Figure 4.5)
    spine,       ///< along the rest of its spine (blue in Figure 4.5)
    gather,      ///< to the middle of its first cross section (green in Figure 4.5)
    scalp,       ///< along the head, by Hairstyle::avoid_scalp
};

/// "stream", "stop", and so on.
std::string_view kind_name(ConstraintKind kind);

}  // namespace lissom
