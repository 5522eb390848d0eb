/// Interface of `lissom test` to a library that can read pictures.
#pragma once

#include <filesystem>
#include <string>

namespace lissom::cli {

struct PictureCheck {
    std::filesystem::path picture, golden;
    /// File of both pictures and their difference side by side, drawn if they differ.
    std::filesystem::path difference;
    /// Greatest difference of a colour, 0 to 1, that counts as none.
    double tolerance = 0.05;
    /// The part of the pixels that may differ by more.
    double pixels = 0.0005;
    /// The greatest number of differing pixels that may touch one another.
    double connected = 8.0;
};

/// Returns the difference as a message; empty if there is none. Throws Error if a file cannot be
/// read.
using ComparePictures = std::string (*)(const PictureCheck& check);

}  // namespace lissom::cli
