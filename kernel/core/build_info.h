/// Libraries and licence of this build.
#pragma once

/// Marks a definition that a library may replace: a program that links the other one takes that.
#ifdef __GNUC__
#define LISSOM_REPLACEABLE __attribute__((weak))
#else
#define LISSOM_REPLACEABLE
#endif

namespace lissom {

struct BuildInfo {
    /// Whether the program has taken in lissom::cholmod and so links CHOLMOD, whose supernodal
    /// modules are under the GNU GPL.
    bool gpl = false;
    /// Whether oneTBB runs parallel loops (CMake: LISSOM_TBB); without it they are serial unless
    /// a host runs them.
    bool tbb = false;
    /// The licence that a binary with this build may be distributed under, as an SPDX name: "MIT",
    /// or "GPL-2.0-or-later" with CHOLMOD.
    const char* licence = "MIT";
};

/// Returns whether this program has taken in lissom::cholmod, which replaces the definition.
bool has_gpl_module();

/// Returns the description of this build.
BuildInfo build_info();

}  // namespace lissom
