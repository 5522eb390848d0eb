/// Choosing, joining and moving strands. Data of each strand go with it.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Returns the strands named in `list`, in its order. They keep their ids. Errors: out_of_range.
Strands select(const Strands& strands, std::span<const Index> list);

/// Returns the strands for which `choose(strand)` is true, in their order.
Strands select(const Strands& strands, const std::function<bool(Index)>& choose);

/// Returns the strands of a group. Errors: out_of_range if there is no group of this name.
Strands select_group(const Strands& strands, std::string_view group);

/// Returns the first `count` strands, or all if there are fewer: a level of detail of strands in
/// random order. Errors: out_of_range for a negative count.
Strands prefix(const Strands& strands, Index count);

/// Adds the strands of `other` after those of `strands`. Groups of the same name become one. Values
/// missing in one of them are filled in: widths and transparencies those it had in common, colours
/// black, faces kNoIndex, root uvs 0, guides kNoGuide; ids that exist already, or that no list
/// holds, become new ones above all others, and guides follow them; guides that are not among
/// `other` become kNoGuide. Errors: invalid_argument if there would be more points than can be
/// numbered.
void append(Strands& strands, const Strands& other);

/// Moves all points by `map`. Widths scale by the cube root of its determinant's absolute value.
/// Errors: singular_transform if the determinant is zero or the map is not finite; not_finite,
/// naming strands, if results exceed the range of 32-bit numbers; cancelled.
void transform(Strands& strands, const Affine& map, const Context& context = {});

}  // namespace lissom
