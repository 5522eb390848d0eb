/// Guide files: a few strands and the others as sums of three of them, for programs that rebuild
/// hair without the kernel. bindings/engine/lissom_hair.h describes the layout, and rebuilds in C.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/core/context.h"
#include "kernel/hair/guides/guide_set.h"

namespace lissom {

struct GuideFileOptions {
    /// Writes the details, 6 bytes a point; without them strands are sums of guides.
    bool details = true;
};

/// Returns the bytes of a guide file. Errors: not_finite if a number is not.
std::string encode_guides(const GuideSet& set, const GuideFileOptions& options = {});

/// Writes a guide file, whole or not at all. Errors: as encode_guides; file_write_failed,
/// file_is_directory; cancelled.
void save_guides(const GuideSet& set, const std::filesystem::path& path,
                 const GuideFileOptions& options = {}, const Context& context = {});

}  // namespace lissom
