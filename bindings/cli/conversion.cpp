#include "bindings/cli/conversion.h"

#include <algorithm>
#include <chrono>
#include <system_error>

#include "bindings/cli/scene_input.h"
#include "bindings/lua/core/failure.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

// Welding is how most files are meant.
bool is_repair(FindingKind kind) {
    return kind > FindingKind::vertices_welded && kind <= FindingKind::vertices_nonmanifold;
}

bool is_loss(FindingKind kind) {
    return kind >= FindingKind::indices_dangling;
}

// Takes the program's log for as long as it lives.
class LogFilter {
  public:
    LogFilter(Program& program, bool shows_warnings) : program_(program) {
        program.log_filter = [this, shows_warnings](LogLevel level, std::string_view message) {
            if (is_saving && level == LogLevel::warning) warnings.emplace_back(message);
            return shows_warnings || program_.debug;
        };
    }
    ~LogFilter() { program_.log_filter = nullptr; }
    LogFilter(const LogFilter&) = delete;
    LogFilter& operator=(const LogFilter&) = delete;

    bool is_saving = false;
    std::vector<std::string> warnings;

  private:
    Program& program_;
};

// The message without the path of the input, which stands beside it.
std::string short_message(const Conversion& conversion) {
    std::string message = lua::lua_message(*conversion.error);
    const std::string path = display_name(conversion.in) + ":";
    if (!message.starts_with(path)) return message;
    message.erase(0, path.size());
    return message.starts_with(' ') ? message.substr(1) : "line " + message;
}

}  // namespace

const char* Conversion::outcome() const {
    if (error) return "failed";
    const auto& findings = report.findings();
    const bool repaired = std::any_of(findings.begin(), findings.end(),
                                      [](const Finding& f) { return is_repair(f.kind); });
    return repaired ? "repaired" : "converted";
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) && !error;
}

Conversion convert_file(Program& program, const fs::path& in, const fs::path& out,
                        const ConversionOptions& options) {
    if (!options.force && is_same_file(in, out)) {
        throw Error(ErrorCode::file_write_failed,
                    display_name(out) + ": it is the file to read; --force replaces it");
    }
    Conversion conversion;
    conversion.in = in;
    conversion.out = out;
    LogFilter log(program, options.shows_warnings);
    const Clock::time_point start = Clock::now();
    make_folder(out.parent_path());
    const Mesh mesh = is_scene_path(in) ? joined_scene_mesh(in, program.context())
                                        : load_mesh(in, options.load, program.context());
    log.is_saving = true;
    conversion.origin = save_mesh(mesh, out, options.save, program.context()).origin;
    conversion.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    conversion.vertices = mesh.vertex_count();
    conversion.faces = mesh.face_count();
    conversion.report = mesh.report();
    conversion.lost = std::move(log.warnings);
    return conversion;
}

Json conversion_json(const Conversion& conversion) {
    Json json = {{"file", display_name(conversion.in)},
                 {"out", display_name(conversion.out)},
                 {"outcome", conversion.outcome()}};
    if (conversion.error) {
        json["error"] = error_json(*conversion.error);
        return json;
    }
    json["vertices"] = conversion.vertices;
    json["faces"] = conversion.faces;
    json["seconds"] = conversion.seconds;
    const Vec3& origin = conversion.origin;
    json["origin"] = {origin.x(), origin.y(), origin.z()};
    json["report"] = report_json(conversion.report);
    json["lost"] = conversion.lost;
    return json;
}

std::string conversion_notes(const Conversion& conversion) {
    if (conversion.error) {
        return std::string(code_name(conversion.error->code())) + ": " + short_message(conversion);
    }
    std::string notes;
    const auto add = [&](const std::string& note) { notes += (notes.empty() ? "" : "; ") + note; };
    for (const Finding& finding : conversion.report.findings()) {
        if (is_repair(finding.kind)) add(describe(finding));
        if (is_loss(finding.kind)) add(describe(finding) + ": " + finding.message);
    }
    for (const std::string& lost : conversion.lost) add(lost);
    return notes;
}

}  // namespace lissom::cli
