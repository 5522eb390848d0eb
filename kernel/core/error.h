/// Errors of the kernel: one exception type with a code, a message with its remedy, and the ids of
/// the elements concerned. An operation that throws leaves its inputs unchanged.
#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/index.h"

namespace lissom {

/// Kinds of errors. `code_name` returns the name used in Lua and on the command line.
enum class ErrorCode {
    cancelled,
    invalid_argument,
    out_of_range,
    file_not_found,
    file_is_directory,
    file_empty,
    file_unreadable,
    file_write_failed,
    file_syntax,
    file_truncated,
    file_too_large,
    unknown_format,
    unsafe_path,
    not_finite,
    mesh_empty,
    face_index,
    face_too_small,
    repeated_vertex,
    duplicate_face,
    nonmanifold_edge,
    nonmanifold_vertex,
    inconsistent_orientation,
    unreferenced_vertex,
    zero_area,
    region_empty,
    topology_mismatch,
    handle_outside_region,
    handle_overlap,
    handle_removed,
    singular_transform,
    unconstrained,
    not_a_boundary,
    not_a_disk,
    boundary_conflict,
    key_conflict,
    skin_mismatch,
    not_positive_definite,
    memory_limit,
    unsupported,
    no_display,
    internal,
};

/// The kind of element that the ids of an error number.
enum class ElementKind { none, vertex, edge, face, corner, row, component, line, strand };

/// Elements named by an error. At most `kMaximumIds` ids are kept; `count` is the true number.
/// Edges are given as pairs of vertex ids, so `ids` then holds two entries an edge.
struct Elements {
    static constexpr std::size_t kMaximumIds = 100;

    ElementKind kind = ElementKind::none;
    std::size_t count = 0;
    std::vector<Index> ids;

    /// Adds one element; beyond `kMaximumIds` entries only the count grows.
    void add(Index id);
    /// Adds one edge between vertices `a` and `b`.
    void add_edge(Index a, Index b);
};

/// The exception that every operation of the kernel throws. The middle of a long message is cut.
class Error : public std::exception {
  public:
    Error(ErrorCode code, std::string message, Elements elements = {});

    const char* what() const noexcept override { return message_.c_str(); }
    ErrorCode code() const { return code_; }
    const std::string& message() const { return message_; }
    /// Returns the elements concerned, 0-based; kind `none` if the error is not about elements.
    const Elements& elements() const { return elements_; }

  private:
    ErrorCode code_;
    std::string message_;
    Elements elements_;
};

/// Name of a code in scripts and reports, for instance "file_not_found".
std::string_view code_name(ErrorCode code);

/// Returns a paragraph on the meaning of a code and its remedy.
std::string_view code_explanation(ErrorCode code);

/// Returns all codes, in the order of their declaration.
const std::vector<ErrorCode>& all_codes();

/// Name of an element kind, singular: "vertex", "edge", ...
std::string_view kind_name(ElementKind kind);

/// "vertex 7", "vertices 3, 9 and 12 (of 250)": the elements as they appear in messages, numbered
/// from `base` (1 in Lua and in files, 0 in C++). At most `limit` are written out.
std::string describe(const Elements& elements, Index base = 0, std::size_t limit = 5);

/// Throws an Error if `condition` is false.
inline void require(bool condition, const char* message,
                    ErrorCode code = ErrorCode::invalid_argument) {
    if (!condition) throw Error(code, message);
}
inline void require(bool condition, const std::string& message,
                    ErrorCode code = ErrorCode::invalid_argument) {
    if (!condition) throw Error(code, message);
}

}  // namespace lissom
