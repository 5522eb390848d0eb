/// LabelReader: the names of objects, groups and materials while faces are read; private to
/// kernel/io.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "kernel/core/index.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// Collects labels of one kind while faces are read: a label holds for the faces after it.
class LabelReader {
  public:
    /// The label of the faces from `face` on; empty for none.
    void set(std::string_view label, Index face);
    /// Adds the labels to `attributes` as `kind` if any face has one.
    void finish(AttributeSet& attributes, std::string_view kind, Index face_count);

  private:
    void label_faces_before(Index face);

    FaceLabels labels_;
    std::map<std::string, Index, std::less<>> index_of_;
    std::string current_;
};

}  // namespace lissom
