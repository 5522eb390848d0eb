#include "kernel/io/record/label_reader.h"

#include <utility>

namespace lissom {

void LabelReader::set(std::string_view label, Index face) {
    label_faces_before(face);
    current_ = label;
}

void LabelReader::finish(AttributeSet& attributes, std::string_view kind, Index face_count) {
    label_faces_before(face_count);
    if (!labels_.names.empty()) attributes.labels().emplace(kind, std::move(labels_));
}

// A label gets its number with its first face: labels without faces leave no trace.
void LabelReader::label_faces_before(Index face) {
    if (at(face) == labels_.of_face.size()) return;
    Index number = kNoIndex;
    if (!current_.empty()) {
        const auto [entry, is_new] = index_of_.try_emplace(current_, count_of(labels_.names));
        if (is_new) labels_.names.push_back(current_);
        number = entry->second;
    }
    labels_.of_face.resize(face, number);
}

}  // namespace lissom
