/// What a better boundary gains: features of real models pasted along the outline that was marked,
/// along the thesis's loop and along ours, and how much the surface is distorted near the seam and
/// in the feature.
///
///     bench_gain [--case=TEXT] [--pictures=FOLDER] [--json]
///
/// Energies are means over area of (s1 / s - 1)^2 + (s2 / s - 1)^2, s1 and s2 being the singular
/// values of a face's map and s the scale of the part; "stretch" is the 95th percentile of s1 / s2.
/// --pictures: saves every result as FOLDER/CASE__WAY.ply; gain_pictures.lua renders them. Without
/// the models of the test data there are no rows.

#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/io/mesh_file.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/thesis/fidelity.h"
#include "tests/bench/report.h"
#include "tests/unit/merge/paste/real_pastes.h"

namespace lissom::bench {
namespace {

namespace fs = std::filesystem;
using test::RealPaste;

enum class Way { outline, thesis, ours };
constexpr std::array<Way, 3> kWays = {Way::outline, Way::thesis, Way::ours};

const char* name_of(Way way) {
    switch (way) {
        case Way::outline:
            return "outline as marked";
        case Way::thesis:
            return "thesis's loop";
        case Way::ours:
            return "ours";
    }
    return "";
}

struct Arguments {
    std::string only;
    fs::path pictures;

    Arguments(int argc, char** argv) {
        for (int i = 1; i < argc; ++i) {
            const std::string_view argument = argv[i];
            if (argument.starts_with("--case=")) only = argument.substr(7);
            if (argument.starts_with("--pictures=")) pictures = argument.substr(11);
        }
        if (!pictures.empty()) fs::create_directories(pictures);
    }
};

std::optional<Mesh> model(const std::string& file) {
    const fs::path path = fs::path(LISSOM_BENCH_DATA) / file;
    return fs::exists(path) ? std::optional<Mesh>(load_mesh(path)) : std::nullopt;
}

PasteResult pasted(const RealPaste& real, const Mesh& source, const Mesh& target, Way way) {
    PasteOptions options;
    if (way == Way::thesis) options.thesis = &thesis_formulas();
    Paste paste(source, target, real.region(source), real.feature(source), std::nullopt,
                real.placement, options);
    if (way != Way::outline) paste.optimize();
    PasteMergeOptions how;
    how.compare = way == Way::ours;
    return paste.merge(how);
}

std::string file_name(const std::string& name) {
    std::string file;
    for (const char c : name) file += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return file;
}

void save(const RealPaste& real, const PasteResult& result, Way way, const fs::path& folder) {
    if (folder.empty()) return;
    const std::string file = file_name(real.name) + "__" + file_name(name_of(way)) + ".ply";
    save_mesh(result.merged.mesh, folder / file);
}

void add_rows(Report& report, const RealPaste& real, const PasteResult& result, Way way) {
    const PasteReport& paste = result.report;
    const std::string name = real.name + ", " + name_of(way);
    const double target = way == Way::ours ? real.best : -1.0;
    std::string end;
    if (target >= 0.0) {
        end = std::string(paste.near.energy <= target ? " reached" : " MISSED");
        end = "  target " + std::to_string(target).substr(0, 6) + end;
    }
    const bool misses = target >= 0.0 && paste.near.energy > target;
    if (paste.kept_outline) end += ", keeps the outline";
    const double turn = result.merged.report.seam.after.max_dihedral * 180.0 / kPi;
    end += ", turns by " + std::to_string(static_cast<int>(std::lround(turn)));
    char line[256];
    std::snprintf(line, sizeof line, "  %-20s %10.4f %9.2f %12.4f %9.2f %8.2f  %s%s", name_of(way),
                  paste.near.energy, paste.near.anisotropy, paste.feature.energy,
                  paste.feature.anisotropy, paste.scale, paste.smooth ? "faces" : "edges",
                  end.c_str());
    report.line(line);
    if (misses && !real.apart.empty()) report.line("      the target is of " + real.apart);
    Row energy{"energy near the seam: " + name, paste.near.energy, "", target};
    energy.bound_by = real.apart;
    report.add_to_json(std::move(energy));
    report.add_to_json({"stretch near the seam: " + name, paste.near.anisotropy, ""});
    report.add_to_json({"energy in the feature: " + name, paste.feature.energy, ""});
    report.add_to_json({"greatest angle at the seam: " + name, turn, "degrees"});
    report.add_to_json({"stretch in the feature: " + name, paste.feature.anisotropy, ""});
}

void run(Report& report, const RealPaste& real, const Arguments& arguments) {
    const std::optional<Mesh> source = model(real.source), target = model(real.target);
    if (!source || !target) return;
    report.line(real.name);
    for (const Way way : kWays) {
        try {
            const PasteResult result = pasted(real, *source, *target, way);
            add_rows(report, real, result, way);
            save(real, result, way, arguments.pictures);
        } catch (const Error& error) {
            report.line(std::string("  ") + name_of(way) + ": " + error.what());
        }
    }
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    using namespace lissom::bench;
    const Arguments arguments(argc, argv);
    Report report(argc, argv);
    report.title(
        "distortion near the seam (energy, stretch), in the feature (the same), scale, way, angle "
        "at the seam");
    for (const lissom::test::RealPaste& real : lissom::test::real_pastes()) {
        if (real.name.find(arguments.only) != std::string::npos) run(report, real, arguments);
    }
    return 0;
}
