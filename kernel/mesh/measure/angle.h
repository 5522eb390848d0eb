/// Angles by arithmetic alone: the bits are the same with every C library and processor, and loops
/// over many angles have no calls and no branches.
#pragma once

#include <algorithm>
#include <cmath>

namespace lissom {

/// Returns the angle in radians, 0 to pi, of the direction (x, y) from the x axis; 0 for (0, 0).
/// `y` must not be negative. Within 4e-16 for doubles, 3e-7 for floats.
/// The rational approximation of atan in S. L. Moshier, Methods and Programs for Mathematical
/// Functions, 1989.
template <typename Real>
inline Real half_plane_angle(Real y, Real x) {
    constexpr Real kStraight = Real(3.14159265358979323846), kReduced = Real(0.66);
    const Real across = std::abs(x);
    const Real low = std::min(y, across), high = std::max(y, across);
    // atan(t) = pi / 4 + atan((t - 1) / (t + 1)) keeps the argument small.
    const bool reduced = low > kReduced * high;
    const Real above = reduced ? low - high : low, below = reduced ? low + high : high;
    const Real t = above / (below > Real(0) ? below : Real(1)), z = t * t;
    const Real p =
        (((Real(-8.750608600031904122785e-1) * z + Real(-1.615753718733365076637e1)) * z +
          Real(-7.500855792314704667340e1)) *
             z +
         Real(-1.228866684490136173410e2)) *
            z +
        Real(-6.485021904942025371773e1);
    const Real q =
        ((((z + Real(2.485846490142306297962e1)) * z + Real(1.650270098316988542046e2)) * z +
          Real(4.328810604912902668951e2)) *
             z +
         Real(4.853903996359136964868e2)) *
            z +
        Real(1.945506571482613964425e2);
    const Real small = (reduced ? kStraight / 4 : Real(0)) + (t + t * z * (p / q));
    const Real right = y > across ? kStraight / 2 - small : small;
    return x < Real(0) ? kStraight - right : right;
}

}  // namespace lissom
