/// The optional module kernel/cholmod, whose libraries are in part under the GNU GPL.
#pragma once

/// Marks a definition that a library may replace: a program that links the other one takes that.
#ifdef __GNUC__
#define LISSOM_REPLACEABLE __attribute__((weak))
#else
#define LISSOM_REPLACEABLE
#endif

namespace lissom {

/// Returns whether this program has taken in kernel/cholmod, which replaces the definition.
bool has_gpl_module();

}  // namespace lissom
