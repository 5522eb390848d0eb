/// Methods of lissom.Strands, a list a file; private to the binding.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/hair/strands_object.h"

namespace lissom::lua {

/// strand_content.cpp: numbers of strands, points, roots, measures.
std::vector<Function> strand_content_methods();
/// strand_files.cpp.
Function strands_save_method();
Function load_strands_function();
/// strand_edit.cpp: parts and copies, transforms, widths, colours.
std::vector<Function> strand_edit_methods();
/// strand_operators.cpp: clump, noise, taper, trim, smooth.
std::vector<Function> strand_operator_methods();
/// strand_locks.cpp: guides, gather, twist, pinch, curl, wave, frizz.
std::vector<Function> strand_lock_methods();
/// strand_shapes.cpp: straighten, rotate, roll, puff, displace, set_length, cut, cull, push_out,
/// shrinkwrap.
std::vector<Function> strand_shape_methods();

/// The strands of a method.
inline const Strands& strands_of(const Call& call) {
    return call.self<StrandsObject>()->strands;
}

/// strand_fills.cpp: interpolate, duplicate, blend, attach.
std::vector<Function> strand_fill_methods();
/// strand_details.cpp: detail, details.
std::vector<Function> strand_detail_methods();
/// strand_braids.cpp: braid, bun.
std::vector<Function> strand_braid_methods();

/// Runs work(Strands&), which changes the strands of a method in place, and returns them.
template <typename Work>
int change_strands(Call& call, const Work& work) {
    const auto strands = call.self<StrandsObject>();
    if (!call.attempt([&] { work(strands->strands); })) return call.fail();
    call.charge(strands);
    return call.push_argument();
}

/// The strands of a method that are rooted in a region. Inside Call::attempt only. Errors: those of
/// strands_rooted_in; invalid_argument for a region of a mesh that they did not grow on.
std::vector<Index> strands_in_region(const Call& call, const char* option);

/// Start of examples: two strands.
inline const std::string kTwoStrands =
    "local hair = lissom.strands{\n"
    "    points = { { 0, 0, 0 }, { 0, 0.1, 0 }, { 0, 0.2, 0 }, { 0.01, 0, 0 }, { 0.02, 0.1, 0 } "
    "},\n"
    "    counts = { 3, 2 },\n}\n";

/// Start of examples: three strands.
inline const std::string kThreeStrands =
    "local hair = lissom.strands{\n"
    "    points = { { 0, 0, 0 }, { 0, .1, 0 }, { .01, 0, 0 }, { .02, .1, 0 }, { .02, 0, 0 }, "
    "{ .03, .2, 0 } },\n"
    "    counts = { 2, 2, 2 },\n}\n";

inline const std::vector<Result> kSelfStrands = {
    {"lissom.Strands", "strands", "The strands themselves."}};

inline Parameter meters(const std::string& name, const std::string& help) {
    return number(name, help).in("metres");
}

}  // namespace lissom::lua
