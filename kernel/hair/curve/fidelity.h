/// Fidelity of hair to the thesis.
#pragma once

namespace lissom {

enum class HairFidelity {
    /// Best hair; options that leave the thesis for it say so.
    lissom,
    /// Chapter 4 to the letter, for comparison.
    thesis,
};

}  // namespace lissom
