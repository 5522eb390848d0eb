/// What CHOLMOD finds of a pattern, for comparison; in builds with GPL.
#pragma once

#include "kernel/solve/sparse/supernodes.h"

namespace lissom::test {

/// CHOLMOD's ordering by approximate minimum degree, and its supernodes.
Supernodes cholmod_supernodes(const SymmetricMatrix& matrix);

}  // namespace lissom::test
