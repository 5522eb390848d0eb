/// Style files: a hairstyle's curves and options as JSON that people can read and edit. Points and
/// lengths are in metres of an average head from the center of its scalp's frame, angles in
/// degrees, so that a style fits any head.
///
///     {
///       "format": "lissom hairstyle",
///       "version": 1,
///       "head": "head.obj",
///       "resolution": 50000,
///       "curves": [
///         {
///           "kind": "stream",
///           "name": "side",
///           "points": [[0.03, 0.1, 0.08], [0.08, 0.06, 0.03], [0.09, -0.03, 0]],
///           "stop": 0.04
///         }
///       ]
///     }
///
/// Omitted values have the default of their C++ option; an unknown key is an error. "fidelity":
/// "thesis" of the style changes defaults, its own and those of the curves; of a curve, if it
/// differs from that of the style, those of the curve.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/curve/style_curve.h"
#include "kernel/hair/hairstyle.h"
#include "kernel/hair/scalp/mask_stroke.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/style_inputs.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Contents of a style file.
struct StyleContent {
    /// The path of the head's mesh as the file has it; empty if it names none.
    std::string head;
    HairstyleOptions options;
    std::vector<StyleCurve> curves;
    /// Whether the scalp step is to be taken when the curves are there (Hairstyle::avoid_scalp).
    bool avoids_scalp = false;
    /// Strokes painted on the scalp.
    std::vector<MaskStroke> masks = {};
};

/// Returns the content of a hairstyle. Errors: memory_limit.
StyleContent content_of(const Hairstyle& style, std::string head = {});
/// Returns the content of the inputs of a style.
StyleContent content_of(const StyleInputs& inputs, const HairstyleOptions& options);

/// Returns a hairstyle of this content on a head. Errors: as Hairstyle's constructor and add,
/// naming the curve.
Hairstyle make_style(const StyleContent& content, const Mesh& head,
                     std::shared_ptr<const Scalp> scalp, const Context& context = {});

/// Writes a style, whole or not at all. Errors: file_write_failed; file_is_directory; memory_limit;
/// cancelled.
void save_style(const StyleContent& content, const std::filesystem::path& path,
                const Context& context = {});

/// Errors: file_not_found, file_is_directory, file_empty, file_unreadable; file_syntax, with the
/// defect and its place; unsupported for a newer version; memory_limit; cancelled.
StyleContent load_style(const std::filesystem::path& path, const Context& context = {});

/// Work as `save_style` and `load_style` do, to and from memory.
std::string encode_style(const StyleContent& content);
StyleContent decode_style(std::string_view bytes);

}  // namespace lissom
