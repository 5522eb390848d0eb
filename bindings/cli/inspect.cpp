// lissom inspect FILE...
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <utility>

#include "bindings/cli/batch/files/files_verb.h"
#include "bindings/cli/json.h"
#include "bindings/cli/load_flags.h"
#include "bindings/cli/scene_input.h"
#include "bindings/cli/verbs.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/io/animation_list.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/strand_file.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/mesh/edit/label_adder.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/path.h"

namespace lissom::cli {
namespace {

const char* domain_name(Domain domain) {
    constexpr const char* kNames[] = {"vertex", "corner", "face"};
    return kNames[static_cast<int>(domain)];
}

Json attributes_json(const Mesh& mesh) {
    Json list = Json::array();
    for (const Attribute& attribute : mesh.attributes().all()) {
        list.push_back({{"name", attribute.name},
                        {"domain", domain_name(attribute.domain)},
                        {"width", attribute.width}});
    }
    return list;
}

// Faces of each label, by kind: {"group": {"hand": 120}}.
Json labels_json(const Mesh& mesh, const Context& context) {
    Json kinds = Json::object();
    for (const auto& [kind, labels] : mesh.attributes().labels()) {
        context.checkpoint();
        FaceLabels distinct;
        LabelAdder adder(distinct);
        std::vector<Index> number;
        for (const std::string& name : labels.names) number.push_back(adder.add(name));
        std::vector<Index> counts(distinct.names.size(), 0);
        for (const Index label : labels.of_face) {
            if (label != kNoIndex) ++counts[number[label]];
        }
        // At once, because adding one to an object that keeps its order looks at all the others.
        std::vector<std::pair<std::string, Json>> faces;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            faces.emplace_back(std::move(distinct.names[i]), counts[i]);
        }
        kinds[kind] = Json::object_t(faces.begin(), faces.end());
    }
    return kinds;
}

Json boundaries_json(const Mesh& mesh) {
    Json list = Json::array();
    for (const Path& boundary : boundaries(mesh)) {
        list.push_back({{"vertices", boundary.size()}, {"length", boundary.length(mesh)}});
    }
    return list;
}

Json regions_json(const Mesh& mesh) {
    Json sizes = Json::object();
    for (const auto& [name, region] : mesh.regions()) sizes[name] = region.size();
    return sizes;
}

Json animations_json(const Mesh& mesh) {
    Json list = Json::array();
    for (const AnimationInfo& info : animations_of(mesh)) {
        list.push_back({{"name", info.name}, {"seconds", info.seconds}, {"frames", info.frames}});
    }
    return list;
}

Index isolated_count(const Topology& topology) {
    Index count = 0;
    for (Index v = 0; v < topology.vertex_count(); ++v) count += topology.is_isolated(v) ? 1 : 0;
    return count;
}

// Each measure may take a while, so that they can be cancelled one by one. Values that exceed the
// range of numbers are NaN or infinite, and then null if JSON is written.
Json mesh_json(const std::string& file, const Mesh& mesh, const Context& context) {
    const Topology& topology = mesh.topology();
    Json json = {{"file", file}};
    const auto add = [&](const char* name, const auto& measure) {
        context.checkpoint();
        json[name] = measure();
    };
    add("vertices", [&] { return topology.vertex_count(); });
    add("edges", [&] { return topology.edge_count(); });
    add("faces", [&] { return topology.face_count(); });
    add("triangles_only", [&] { return topology.is_triangle_mesh(); });
    add("bounds", [&] { return bounds_json(bounds(mesh)); });
    add("size", [&] { return surface_radius(mesh); });
    add("area", [&] { return area(mesh); });
    add("volume", [&] { return volume(mesh); });
    add("genus", [&] { return genus(topology); });
    add("components", [&] { return topology.component_count(); });
    add("closed", [&] { return topology.is_closed(); });
    add("boundaries", [&] { return boundaries_json(mesh); });
    add("isolated_vertices", [&] { return isolated_count(topology); });
    add("zero_area_faces", [&] { return zero_area_faces(mesh).size(); });
    add("attributes", [&] { return attributes_json(mesh); });
    add("labels", [&] { return labels_json(mesh, context); });
    add("regions", [&] { return regions_json(mesh); });
    add("animations", [&] { return animations_json(mesh); });
    add("report", [&] { return report_json(mesh.report()); });
    return json;
}

const char* domain_name(StrandDomain domain) {
    constexpr const char* kNames[] = {"all", "strand", "point"};
    return kNames[static_cast<int>(domain)];
}

// Strands of each group, in the order of the names.
Json groups_json(const Strands& strands) {
    std::vector<Index> counts(strands.group_names().size(), 0);
    for (const Index group : strands.groups()) {
        if (group != kNoIndex) ++counts[at(group)];
    }
    std::vector<std::pair<std::string, Json>> groups;
    for (std::size_t g = 0; g < counts.size(); ++g) {
        groups.emplace_back(strands.group_names()[g], counts[g]);
    }
    return Json::object_t(groups.begin(), groups.end());
}

// Returns the contents of strands beside points and widths.
Json strand_content_json(const Strands& strands) {
    Json list = Json::array();
    if (strands.colors()) list.push_back("colors");
    if (strands.transparency().domain != StrandDomain::all ||
        strands.transparency().common != 0.0f) {
        list.push_back("transparency");
    }
    if (!strands.roots().uvs.empty()) list.push_back("root uvs");
    if (!strands.roots().faces.empty()) list.push_back("root faces");
    if (!strands.ids().empty()) list.push_back("ids");
    return list;
}

Json widths_json(const Strands& strands) {
    float least = std::numeric_limits<float>::infinity(), most = 0.0f;
    std::vector<float> widths;
    for (Index s = 0; s < strands.size(); ++s) {
        widths_of(strands, s, widths);
        for (const float width : widths) {
            least = std::min(least, width);
            most = std::max(most, width);
        }
    }
    if (strands.point_count() == 0) return nullptr;
    return {{"min", least}, {"max", most}, {"domain", domain_name(strands.widths().domain)}};
}

Json strands_json(const std::string& file, const Strands& strands, const Context& context) {
    const StrandStatistics measured = strand_statistics(strands, {}, context);
    const bool empty = strands.empty();
    Json json = {
        {"file", file},
        {"strands", measured.strands},
        {"points", measured.points},
        {"points_per_strand", {{"min", measured.min_points}, {"max", measured.max_points}}}};
    json["bounds"] = bounds_json(bounds(strands));
    json["length"] = empty ? Json(nullptr)
                           : Json{{"min", measured.min_length},
                                  {"mean", measured.mean_length},
                                  {"max", measured.max_length}};
    json["widths"] = widths_json(strands);
    json["zero_length"] = measured.zero_length;
    json["zero_segments"] = measured.zero_segments;
    json["content"] = strand_content_json(strands);
    json["groups"] = groups_json(strands);
    json["comment"] = strands.comment();
    return json;
}

// ---- The same for people

std::string number_text(const Json& value) {
    const auto number = value.get<double>();
    if (!std::isfinite(number)) return "beyond the range of numbers";
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", number);
    return text;
}

std::string vector_text(const Json& v) {
    return "(" + number_text(v[0]) + ", " + number_text(v[1]) + ", " + number_text(v[2]) + ")";
}

void line(const std::string& name, const std::string& text) {
    constexpr std::size_t kWidth = 13;
    const std::size_t gap = name.size() < kWidth ? kWidth - name.size() : 1;
    std::cout << "  " << name << std::string(gap, ' ') << text << "\n";
}

// "hand 120, arm 80": names with their counts, at most a dozen.
std::string counts_text(const Json& counts) {
    constexpr int kShown = 12;
    std::string text;
    int shown = 0;
    for (const auto& [name, count] : counts.items()) {
        if (shown++ == kShown) return text + ", ... (" + std::to_string(counts.size()) + ")";
        text += (shown == 1 ? "" : ", ") + name + " " + count.dump();
    }
    return text;
}

std::string boundaries_text(const Json& list) {
    if (list.empty()) return "none";
    std::string text = std::to_string(list.size());
    const std::size_t shown = std::min<std::size_t>(list.size(), 5);
    for (std::size_t i = 0; i < shown; ++i) {
        text += (i == 0 ? ": " : "; ") + list[i]["vertices"].dump() + " vertices, length " +
                number_text(list[i]["length"]);
    }
    return shown < list.size() ? text + "; ..." : text;
}

std::string attributes_text(const Json& list) {
    std::string text;
    for (const Json& attribute : list) {
        text += (text.empty() ? "" : ", ") + attribute["name"].get<std::string>() + " (" +
                attribute["domain"].get<std::string>() + " x " + attribute["width"].dump() + ")";
    }
    return text;
}

// "wave: 2 s, 60 frames".
std::string animation_text(const Json& animation) {
    const auto name = animation["name"].get<std::string>();
    return (name.empty() ? "unnamed" : name) + ": " + number_text(animation["seconds"]) + " s, " +
           animation["frames"].dump() + " frames";
}

// "2 faces turned over ...; in the file: faces 3 and 9": a finding on one line.
std::string finding_text(const Finding& finding) {
    std::string text = describe(finding);
    if (!finding.message.empty()) text += ": " + finding.message;
    if (finding.ids.empty() || finding.element == ElementKind::line) return text;
    const std::size_t per_element = finding.element == ElementKind::edge ? 2 : 1;
    Elements elements{finding.element, finding.ids.size() / per_element, finding.ids};
    return text + (finding.in_file ? "; in the file: " : ": ") + describe(elements, 1);
}

void print_report(const Report& report) {
    std::string name = "found";
    for (const Finding& finding : report.findings())
        line(std::exchange(name, ""), finding_text(finding));
}

void print_mesh(const Json& mesh) {
    std::cout << mesh["file"].get<std::string>() << "\n";
    line("vertices", mesh["vertices"].dump());
    line("faces", mesh["faces"].dump() + (mesh["triangles_only"] ? " triangles" : " polygons") +
                      ", " + mesh["edges"].dump() + " edges");
    const Json& box = mesh["bounds"];
    if (!box.is_null()) line("bounds", vector_text(box["min"]) + " to " + vector_text(box["max"]));
    line("size", number_text(mesh["size"]) + " (RMS distance of the surface to its centroid)");
    line("area", number_text(mesh["area"]));
    line("volume",
         number_text(mesh["volume"]) + (mesh["closed"] ? "" : " (boundaries closed by cones)"));
    line("genus", mesh["genus"].dump());
    line("components", mesh["components"].dump());
    line("boundaries", boundaries_text(mesh["boundaries"]));
    if (mesh["isolated_vertices"].get<Index>() > 0)
        line("isolated", mesh["isolated_vertices"].dump() + " vertices");
    if (mesh["zero_area_faces"].get<Index>() > 0)
        line("no area", mesh["zero_area_faces"].dump() + " faces");
    if (!mesh["attributes"].empty()) line("attributes", attributes_text(mesh["attributes"]));
    for (const auto& [kind, counts] : mesh["labels"].items()) {
        line(kind + "s", counts_text(counts));
    }
    if (!mesh["regions"].empty()) line("regions", counts_text(mesh["regions"]));
    for (const Json& animation : mesh["animations"]) line("animation", animation_text(animation));
}

std::string range_text(const Json& range) {
    const std::string least = number_text(range["min"]), most = number_text(range["max"]);
    return least == most ? least : least + " to " + most;
}

void print_strands(const Json& hair) {
    std::cout << hair["file"].get<std::string>() << "\n";
    line("strands", hair["strands"].dump());
    line("points",
         hair["points"].dump() + " (" + range_text(hair["points_per_strand"]) + " a strand)");
    const Json& box = hair["bounds"];
    if (!box.is_null()) line("bounds", vector_text(box["min"]) + " to " + vector_text(box["max"]));
    if (!hair["length"].is_null()) {
        line("length",
             range_text(hair["length"]) + " m, mean " + number_text(hair["length"]["mean"]) + " m");
    }
    if (!hair["widths"].is_null()) line("widths", range_text(hair["widths"]) + " m");
    if (hair["zero_length"].get<Index>() > 0)
        line("no length", hair["zero_length"].dump() + " strands");
    std::string content;
    for (const Json& what : hair["content"])
        content += (content.empty() ? "" : ", ") + what.get<std::string>();
    if (!content.empty()) line("holds", content);
    if (!hair["groups"].empty()) line("groups", counts_text(hair["groups"]));
    if (!hair["comment"].get<std::string>().empty())
        line("comment", in_quotes(hair["comment"].get<std::string>()));
}

// Describes one file after the other.
class Inspector {
  public:
    Inspector(Program& program, const LoadOptions& options)
        : program_(program), options_(options), before_(program.log_filter) {
        // Findings are part of the answer.
        program.log_filter = [this](LogLevel level, std::string_view message) {
            if (level == LogLevel::warning) warnings_.emplace_back(message);
            return (!before_ || before_(level, message)) && program_.debug;
        };
    }
    ~Inspector() { program_.log_filter = before_; }
    Inspector(const Inspector&) = delete;
    Inspector& operator=(const Inspector&) = delete;

    void inspect_file(const std::string& file) {
        warnings_.clear();
        if (is_scene_path(file)) return inspect_scene(file);
        if (is_hair_path(file)) return inspect_hair(file);
        add_mesh(meshes, file, load_mesh_file(file));
    }

    Json meshes = Json::array(), hair = Json::array(), scenes = Json::array();

  private:
    // If the extension is not known, the error names those of hair and scenes too.
    Mesh load_mesh_file(const std::string& file) const {
        try {
            return load_mesh(file, options_, program_.context());
        } catch (const Error& error) {
            if (error.code() != ErrorCode::unknown_format) throw;
            std::string text = error.message() + "; of hair ";
            for (const std::string& known : readable_strand_extensions()) text += known + ", ";
            throw Error(error.code(), text.substr(0, text.size() - 2) + "; of scenes lissom");
        }
    }

    void add_mesh(Json& list, const std::string& name, const Mesh& mesh) {
        program_.clear_progress();
        list.push_back(mesh_json(name, mesh, program_.context()));
        if (program_.json()) return;
        print_mesh(list.back());
        print_report(mesh.report());
    }

    void add_strands(Json& list, const std::string& name, const Strands& strands) {
        program_.clear_progress();
        list.push_back(strands_json(name, strands, program_.context()));
        list.back()["warnings"] = warnings_;
        if (program_.json()) return;
        print_strands(list.back());
        std::string label = "found";
        for (const std::string& warning : warnings_) line(std::exchange(label, ""), warning);
    }

    void inspect_hair(const std::string& file) {
        add_strands(hair, file, load_strands(file, {}, program_.context()));
    }

    void inspect_scene(const std::string& file) {
        const std::vector<SceneObject> objects = read_scene(file, program_.context());
        program_.clear_progress();
        if (!program_.json()) {
            std::cout << file << "\n";
            line("objects", std::to_string(objects.size()));
        }
        Json list = Json::array();
        for (const SceneObject& object : objects) add_object(list, file, object);
        scenes.push_back({{"file", file}, {"objects", std::move(list)}});
    }

    void add_object(Json& list, const std::string& file, const SceneObject& object) {
        const std::string name =
            file + ": " + object.name + " (" + object.kind + (object.visible ? ")" : ", hidden)");
        if (object.mesh) {
            add_mesh(list, name, *object.mesh);
        } else if (object.strands) {
            add_strands(list, name, *object.strands);
        } else {
            list.push_back(Json::object());
            if (!program_.json()) std::cout << name << "\n";
        }
        Json& entry = list.back();
        entry["name"] = object.name;
        entry["kind"] = object.kind;
        entry["visible"] = object.visible;
        entry.erase("file");
    }

    Program& program_;
    const LoadOptions& options_;
    std::function<bool(LogLevel, std::string_view)> before_;
    std::vector<std::string> warnings_;
};

// ---- The verb

struct InspectRequest {
    FilesVerb many{"inspect"};
    std::vector<std::string> files;
    LoadFlags flags;
};

void declare_inspect(CLI::App& app, InspectRequest& request) {
    app.add_option("FILE", request.files,
                   "Mesh files, hair files (.hair, .data, .usda, .tfx) and scenes (.lissom)");
    app.add_option("--out", request.many.files.out_folder,
                   "Write the answer as JSON to this file; with --in a folder, which gets a file "
                   "NAME.json for each, and a table");
    request.flags.declare(app);
    request.many.declare(app);
}

std::string inspect_misuse(const CLI::App& app, const InspectRequest& request) {
    const std::string wrong = request.many.misuse(app, request.files);
    if (!wrong.empty()) return wrong;
    if (!request.many.is_for_many()) return request.files.empty() ? "FILE is required" : "";
    if (!request.files.empty()) return "FILE does not go with --in";
    return request.many.files.out_folder.empty() ? "--out is missing: the folder to write to" : "";
}

std::string report_notes(const Json& report) {
    std::string notes;
    for (const Json& finding : report) {
        auto kind = finding.at("kind").get<std::string>();
        std::replace(kind.begin(), kind.end(), '_', ' ');
        notes += (notes.empty() ? "" : "; ") + finding.at("count").dump() + " " + kind;
    }
    return notes;
}

// The fields of one value in the description of a mesh, of hair, or of a scene.
Json brief_json(const Json& description) {
    Json brief = Json::object();
    for (const auto& [name, value] : description.items()) {
        if (value.is_primitive()) brief[name] = value;
        if (name == "boundaries" || name == "objects") brief[name] = value.size();
    }
    if (description.contains("report")) brief["notes"] = report_notes(description.at("report"));
    return brief;
}

Json answer_json(Inspector& inspector) {
    Json answer = {{"meshes", std::move(inspector.meshes)}};
    if (!inspector.hair.empty()) answer["hair"] = std::move(inspector.hair);
    if (!inspector.scenes.empty()) answer["scenes"] = std::move(inspector.scenes);
    return answer;
}

// Adds the error of a file to the list of its kind.
void add_error(Inspector& inspector, const std::string& file, const Error& error) {
    Json& list = is_scene_path(file)  ? inspector.scenes
                 : is_hair_path(file) ? inspector.hair
                                      : inspector.meshes;
    list.push_back({{"file", file}, {"error", error_json(error)}});
}

// The first description in an answer.
const Json& first_of(const Json& answer) {
    for (const auto& [name, list] : answer.items()) {
        if (!list.empty()) return list.front();
    }
    return answer;
}

// The answer goes to the file, and in brief to a listener.
void write_answer(const Program& program, const Json& answer, const std::string& out) {
    const std::string text = json_text(answer);
    if (!out.empty()) write_file_atomically(out, text + "\n", {});
    if (out.empty()) return program.answer(text);
    if (program.json()) program.answer(json_text(brief_json(first_of(answer))));
}

int inspect_files(Program& program, const std::vector<std::string>& files, const std::string& out,
                  const LoadOptions& options) {
    int status = kSuccess;
    Inspector inspector(program, options);
    for (const std::string& file : files) {
        try {
            inspector.inspect_file(file);
        } catch (const Error& error) {
            status = kFailure;
            // Nothing is written of a file alone that cannot be read.
            if (!out.empty() && files.size() == 1) return program.fail(error);
            add_error(inspector, file, error);
            if (!program.json()) program.fail(error);
            if (error.code() == ErrorCode::cancelled) break;
        }
    }
    program.clear_progress();
    if (program.json() || !out.empty()) write_answer(program, answer_json(inspector), out);
    return status;
}

int inspect_many(Program& program, const CLI::App& app, InspectRequest& request) {
    request.many.files.extension = "json";
    request.many.files.adds_extension = true;
    return request.many.run(
        program, app, {"--out"}, "out",
        {{"inspected"},
         {number_column("vertices", 9), number_column("faces", 9), number_column("components", 10),
          number_column("boundaries", 10), number_column("genus", 6), number_column("points", 9)}});
}

}  // namespace

int inspect(Program& program, const std::vector<std::string>& words) {
    CLI::App app(
        "Describes the contents of mesh files, hair files and scenes.\n\n"
        "  lissom inspect FILE...                            on the terminal, or as JSON\n"
        "  lissom inspect --in 'a/**/*.obj' --out FOLDER     many files, and a table of them",
        "lissom inspect");
    InspectRequest request;
    declare_inspect(app, request);
    int status = kSuccess;
    if (!request.many.parse(program, app, words, status)) return status;
    const std::string wrong = inspect_misuse(app, request);
    if (!wrong.empty()) {
        return program.fail("lissom inspect: " + wrong + " (see lissom inspect --help)", kUsage);
    }
    if (request.many.is_for_many()) return inspect_many(program, app, request);
    LoadOptions options;
    request.flags.apply(options);
    return inspect_files(program, request.files, request.many.files.out_folder, options);
}

}  // namespace lissom::cli
