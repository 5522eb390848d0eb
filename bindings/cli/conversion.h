/// The conversion of one file, and its outcome.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/json.h"
#include "bindings/cli/program.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/strand_file.h"
#include "kernel/mesh/report.h"

namespace lissom::cli {

struct ConversionOptions {
    LoadOptions load;
    SaveOptions save;
    StrandLoadOptions hair_load;
    StrandSaveOptions hair_save;
    /// The given options of the command line that hair does not have.
    std::vector<std::string> mesh_only;
    /// Allow the output to replace an input.
    bool force = false;
};

/// Outcome of one file.
struct Conversion {
    std::filesystem::path in, out;
    Index vertices = 0, faces = 0;
    /// Strands and their points, if the file holds hair.
    Index strands = 0, points = 0;
    bool is_hair = false;
    double seconds = 0.0;
    Report report;
    StrandReport hair_report;
    /// The point of the mesh that is the origin of the output.
    Vec3 origin = Vec3::Zero();
    /// Notes on parts of the mesh that the output does not hold.
    std::vector<std::string> lost;

    /// Returns "converted" or "repaired" (the surface differs from the file's, by more than
    /// welding).
    const char* outcome() const;
};

/// Reads `in` and writes `out`; makes its folder if it is missing. Hair files become hair files; a
/// scene becomes hair if `out` holds nothing else, or if no mesh is visible. Errors: those of
/// loading and saving; file_write_failed if `out` is `in` and may not be, or if a folder cannot be
/// created; unknown_format for a mesh that is to become hair; invalid_argument for hair with
/// options of meshes.
Conversion convert_file(Program& program, const std::filesystem::path& in,
                        const std::filesystem::path& out, const ConversionOptions& options);

/// Returns {"file", "out", "outcome", "notes", "vertices", "faces", "seconds", "origin", "report",
/// "lost"}; of hair with "strands" and "points" for "vertices", "faces", "origin" and "report". The
/// notes are repairs and losses in a few words.
Json conversion_json(const Conversion& conversion);

/// Returns whether both name the same existing file.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace lissom::cli
