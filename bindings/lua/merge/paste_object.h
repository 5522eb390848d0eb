/// A paste of a script; private to the bindings of merging.
#pragma once

#include <memory>
#include <optional>

#include "bindings/lua/merge/merge_object.h"
#include "kernel/merge/paste/paste.h"

namespace lissom::lua {

struct PasteSetup {
    static constexpr const char* kTypeName = "lissom.Paste";

    /// Empty once it was closed.
    std::optional<Paste> content;
    MergeInputs inputs;
    /// The mesh that its loops run on.
    std::shared_ptr<MeshObject> source, target;
    std::size_t charged_bytes = 0;

    std::size_t memory_bytes() const { return content ? content->memory_bytes() : 0; }
    /// Throws handle_removed where it was closed.
    Paste& paste();
};

/// Pushes what a paste found as a table.
int push_paste_report(const Call& call, const PasteReport& report);
/// Pushes what a search for a boundary found as a table.
int push_paste_search(const Call& call, const PasteSearch& search);

}  // namespace lissom::lua
