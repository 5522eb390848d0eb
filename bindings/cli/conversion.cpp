#include "bindings/cli/conversion.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <variant>

#include "bindings/cli/scene_input.h"
#include "kernel/io/record/file_rules.h"
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
    explicit LogFilter(Program& program) : program_(program), before_(program.log_filter) {
        program.log_filter = [this](LogLevel level, std::string_view message) {
            if (is_saving && level == LogLevel::warning) warnings.emplace_back(message);
            return !before_ || before_(level, message);
        };
    }
    ~LogFilter() { program_.log_filter = before_; }
    LogFilter(const LogFilter&) = delete;
    LogFilter& operator=(const LogFilter&) = delete;

    bool is_saving = false;
    std::vector<std::string> warnings;

  private:
    Program& program_;
    std::function<bool(LogLevel, std::string_view)> before_;
};

bool is_repair(const StrandFinding& finding) {
    return finding.kind < StrandFindingKind::content_dropped;
}

bool has_extension_of(const fs::path& path, const std::vector<std::string>& extensions) {
    const std::string extension = normalized_extension(display_name(path.extension()));
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

using Content = std::variant<Mesh, Strands>;

bool shows(const std::vector<SceneObject>& objects, std::string_view kind) {
    return std::any_of(objects.begin(), objects.end(), [&](const SceneObject& object) {
        return object.visible && object.kind == kind;
    });
}

Content read_scene_content(const fs::path& in, const fs::path& out, const Context& context) {
    const std::vector<SceneObject> objects = read_scene(in, context);
    const bool hair = has_extension_of(out, hair_only_extensions()) ||
                      (!shows(objects, "mesh") && shows(objects, "strands"));
    if (hair) return joined_scene_strands(in, objects, context);
    return joined_scene_mesh(in, objects, context);
}

Content read_content(const fs::path& in, const fs::path& out, const ConversionOptions& options,
                     const Context& context) {
    if (is_scene_path(in)) return read_scene_content(in, out, context);
    if (is_hair_path(in)) return load_strands(in, options.hair_load, context);
    if (has_extension_of(out, hair_only_extensions())) {
        if (may_hold_hair(in)) return load_strands(in, options.hair_load, context);
        throw Error(ErrorCode::unknown_format, display_name(out) + ": such files hold hair, and " +
                                                   display_name(in) +
                                                   " holds a mesh; take a format of meshes");
    }
    return load_mesh(in, options.load, context);
}

void write_file(const Mesh& mesh, Conversion& conversion, const ConversionOptions& options,
                const Context& context) {
    conversion.origin = save_mesh(mesh, conversion.out, options.save, context).origin;
    conversion.vertices = mesh.vertex_count();
    conversion.faces = mesh.face_count();
    conversion.report = mesh.report();
}

void write_file(const Strands& strands, Conversion& conversion, const ConversionOptions& options,
                const Context& context) {
    if (!options.mesh_only.empty()) {
        throw Error(ErrorCode::invalid_argument,
                    display_name(conversion.in) + ": " + options.mesh_only.front() +
                        " is for meshes, and this is hair; leave it out");
    }
    conversion.is_hair = true;
    conversion.hair_report = save_strands(strands, conversion.out, options.hair_save, context);
    conversion.strands = strands.size();
    conversion.points = strands.point_count();
}

// Repairs and losses in a few words.
std::string notes_of(const Conversion& conversion) {
    std::string notes;
    const auto add = [&](const std::string& note) { notes += (notes.empty() ? "" : "; ") + note; };
    for (const Finding& finding : conversion.report.findings()) {
        if (is_repair(finding.kind)) add(describe(finding));
        if (is_loss(finding.kind)) add(describe(finding) + ": " + finding.message);
    }
    if (conversion.is_hair) add(std::to_string(conversion.strands) + " strands");
    for (const std::string& lost : conversion.lost) add(lost);
    return notes;
}

}  // namespace

const char* Conversion::outcome() const {
    const auto& of_hair = hair_report.findings;
    const auto is_changed = [](const StrandFinding& finding) { return is_repair(finding); };
    if (std::any_of(of_hair.begin(), of_hair.end(), is_changed)) return "repaired";
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
    LogFilter log(program);
    const Clock::time_point start = Clock::now();
    make_folder(out.parent_path());
    // A scene's warnings name the objects that are left out.
    log.is_saving = is_scene_path(in);
    const Content content = read_content(in, out, options, program.context());
    log.is_saving = true;
    std::visit([&](const auto& held) { write_file(held, conversion, options, program.context()); },
               content);
    conversion.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    conversion.lost = std::move(log.warnings);
    return conversion;
}

Json conversion_json(const Conversion& conversion) {
    Json json = {{"file", display_name(conversion.in)},
                 {"out", display_name(conversion.out)},
                 {"outcome", conversion.outcome()},
                 {"notes", notes_of(conversion)}};
    json["seconds"] = conversion.seconds;
    json["lost"] = conversion.lost;
    if (conversion.is_hair) {
        json["strands"] = conversion.strands;
        json["points"] = conversion.points;
        return json;
    }
    json["vertices"] = conversion.vertices;
    json["faces"] = conversion.faces;
    const Vec3& origin = conversion.origin;
    json["origin"] = {origin.x(), origin.y(), origin.z()};
    json["report"] = report_json(conversion.report);
    return json;
}

}  // namespace lissom::cli
