/// LabelAdder: gives labels their numbers when there are many.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

#include "kernel/core/index.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// Adds labels as FaceLabels::add does, each in a time that does not grow with their number. The
/// labels must outlive it, and only have names added meanwhile.
class LabelAdder {
  public:
    explicit LabelAdder(FaceLabels& labels) : labels_(labels) {}

    /// Index of `label` in the names; adds it if it is new.
    Index add(const std::string& label) {
        for (; known_ < labels_.names.size(); ++known_) {
            index_.try_emplace(labels_.names[known_], index_of(known_));
        }
        const auto [entry, is_new] = index_.try_emplace(label, index_of(known_));
        if (!is_new) return entry->second;
        labels_.names.push_back(label);
        ++known_;
        return entry->second;
    }

  private:
    FaceLabels& labels_;
    std::unordered_map<std::string, Index> index_;
    // Names that are in `index_`.
    std::size_t known_ = 0;
};

}  // namespace lissom
