/// How closely hair keeps to the thesis.
#pragma once

namespace lissom {

enum class HairFidelity {
    /// What gives the best hair: where the thesis leaves it, the options say so.
    lissom,
    /// Chapter 4 to the letter, for comparison.
    thesis,
};

}  // namespace lissom
