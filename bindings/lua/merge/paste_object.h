/// A paste of a script; private to the bindings of merging.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

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
    /// Throws handle_removed if it was closed.
    Paste& paste();
};

/// Reads the fields of a placement under `path`, which may be empty, over those of `placement`. The
/// place has the name `at`.
PastePlacement read_placement(const Call& call, const std::string& path, PastePlacement placement,
                              const char* at = "at");
/// Returns those fields, the place first; with `moved`, of a paste that is moved.
std::vector<Parameter> placement_fields(bool moved);
/// Pushes the result of a paste: the mesh, and the report of the merge with that of the paste.
int push_paste_result(Call& call, PasteResult& result, const MergeInputs& inputs);
/// Options of `merge` that scripts may set, and the same read; `size` names the choice of the size.
std::vector<Parameter> paste_merge_parameters(const char* size);
PasteMergeOptions read_paste_merge(const Call& call, const char* size);
/// The option `clear`, and the same read.
Parameter clear_parameter();
void read_clearing(const Call& call, PasteOptions& options);

/// Pushes the report of a paste as a table.
int push_paste_report(const Call& call, const PasteReport& report);
/// Pushes the report of a draft, but for its mesh, as a table.
int push_paste_draft(const Call& call, const PasteDraft& draft);
/// Pushes the part cleared for a paste as a table.
int push_clearing(const Call& call, const PasteClearing& clearing);
/// Pushes the result of a search for a boundary as a table.
int push_paste_search(const Call& call, const PasteSearch& search);

}  // namespace lissom::lua
