/// IndexCheck: validates references to elements while a file is read; private to kernel/io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernel/core/index.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {

/// Checks the indices of one kind of element. Indices may refer to elements that come later in the
/// file, so the largest is kept and compared with the number of elements at the end.
class IndexCheck {
  public:
    /// `element` is singular; indices in the file count from `base`.
    IndexCheck(std::string_view element, int base) : element_(element), base_(base) {}

    /// Returns the 0-based index for `index`, itself 0-based. Errors: face_index if negative or too
    /// large.
    Index checked(std::int64_t index, FilePlace place) {
        if (index < 0 || index > kLargest) refuse_index(index, place);
        if (index > largest_) {
            largest_ = index;
            largest_place_ = place;
        }
        return index_of(index);
    }
    /// Errors: face_index if an index was not below `count`.
    void require_below(std::size_t count) const;

  private:
    static constexpr std::int64_t kLargest = 0x7ffffffe;

    [[noreturn]] void refuse_index(std::int64_t index, FilePlace place) const;

    std::string_view element_;
    int base_;
    std::int64_t largest_ = -1;
    FilePlace largest_place_;
};

}  // namespace lissom
