/// Pictures of tests: the viewer's part of `lissom test`.
#pragma once

#include <string>

#include "bindings/cli/test/picture_check.h"

namespace lissom::cli {

/// Compares a picture with its golden one; see ComparePictures. Errors: those of read_file,
/// file_syntax, file_write_failed.
std::string compare_pictures(const PictureCheck& check);

}  // namespace lissom::cli
