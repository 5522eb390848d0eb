/// A merger of a script, and the provenance of its result.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/mesh/path_object.h"
#include "kernel/merge/merge.h"

namespace lissom::lua {

/// Numbers of vertices and faces of the meshes that went into a merge: the targets, then the
/// source.
struct MergeInputs {
    std::vector<Index> vertices, faces;
};

struct MergerObject {
    static constexpr const char* kTypeName = "lissom.Merger";

    /// Empty once it was closed.
    std::optional<Merger> content;
    MergeInputs inputs;
    std::size_t charged_bytes = 0;

    std::size_t memory_bytes() const { return content ? content->memory_bytes() : 0; }
    /// Throws handle_removed if it was closed.
    Merger& merger();
};

/// Provenance of the elements of one merged mesh.
struct ProvenanceObject {
    static constexpr const char* kTypeName = "lissom.Provenance";

    ElementMap vertices, faces;
    MergeInputs inputs;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    std::size_t memory_bytes() const;
};

/// A key of a join as a script gives it: a vertex, or a point.
struct KeySpec {
    Index vertex;
    double point[3];

    Key key() const;
};

/// One join as a script gives it; keys of source and target in turn.
struct JoinSpec {
    Holder* source;
    Holder* target;
    const KeySpec* keys;
    std::size_t key_count;

    std::vector<KeyPair> key_pairs() const;
};

/// Reads the list of joins in the option `path`. Raises a Lua error for bad ones.
std::span<const JoinSpec> read_joins(const Call& call, const char* path);
/// Reads a list of key pairs.
JoinSpec read_keys(const Call& call, const char* path);

/// Pushes the list of reasons of a verdict.
void push_reasons(const Call& call, const std::vector<MergeReason>& reasons);
/// Sets the fields ok, verdict and reasons of the report on top of the stack, and its text for
/// tostring.
void set_verdict(const Call& call, bool ok, const std::string& verdict,
                 const std::vector<MergeReason>& reasons);

/// Pushes the merged mesh and the report of `result`, which is moved from.
int push_merge_result(Call& call, MergeResult& result, const MergeInputs& inputs);

}  // namespace lissom::lua
