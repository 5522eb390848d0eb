/// Pictures as files.
#pragma once

#include <filesystem>

#include "kernel/core/context.h"
#include "viewer/render/draw/image/image.h"

namespace lissom {

/// Throws unknown_format if the extension of `path` is not that of a picture, which is .png.
void require_picture_path(const std::filesystem::path& path);

/// Reads a PNG file. Errors: those of read_file; file_syntax; memory_limit; cancelled.
Image load_picture(const std::filesystem::path& path, const Context& context = {});

/// Writes a PNG file, whole or not at all.
/// Errors: unknown_format; file_write_failed, file_is_directory; memory_limit; cancelled.
void save_picture(const Image& image, const std::filesystem::path& path,
                  const Context& context = {});

}  // namespace lissom
