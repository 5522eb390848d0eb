/// The options that operators on strands share; private to the binding.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strands_methods.h"
#include "kernel/hair/strands/strand_pass.h"

namespace lissom::lua {

/// factor, shape, mask, seed and, unless `lengths` is false, keep_length; with the defaults of `d`.
std::vector<Parameter> effect_fields(const StrandOperatorOptions& d, bool lengths = true);
/// factor and mask alone, of operators with a shape and a seed of their own.
std::vector<Parameter> part_fields();
/// `own` and `more` in one list.
std::vector<Parameter> with_fields(std::vector<Parameter> own, std::vector<Parameter> more);

/// Asks a mask that is a function; runs before any C++ object is alive.
std::span<const float> ask_mask(Call& call);
/// The same of another option that may be a function of roots.
std::span<const float> ask_roots(Call& call, const char* option);
/// Read the options of part_fields and of effect_fields. Inside Call::attempt only.
void read_part(const Call& call, std::span<const float> asked, StrandOperatorOptions& options);
void read_effect(const Call& call, std::span<const float> asked, StrandOperatorOptions& options,
                 bool lengths = true);

/// Metres of a head, as those of its strands, to the signed distance in the same.
std::function<double(const Vec3&)> distance_to_head(const Hairstyle& style);

/// Errors of operators.
extern const std::vector<ErrorCode> kOperatorErrors;

}  // namespace lissom::lua
