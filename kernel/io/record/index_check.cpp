#include "kernel/io/record/index_check.h"

#include <string>

namespace lissom {

void IndexCheck::refuse_index(std::int64_t index, FilePlace place) const {
    const std::string what = std::string(element_) + " " + std::to_string(index + base_);
    refuse(ErrorCode::face_index,
           what + (index < 0 ? " does not exist; the first is " + std::to_string(base_)
                             : " is beyond the range of numbers"),
           place);
}

void IndexCheck::require_below(std::size_t count) const {
    if (largest_ < 0 || at(largest_) < count) return;
    refuse(ErrorCode::face_index,
           std::string(element_) + " " + std::to_string(largest_ + base_) +
               " does not exist; the file has " + std::to_string(count) + " of them",
           largest_place_);
}

}  // namespace lissom
