// lissom inspect MESH...
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <utility>

#include "bindings/cli/json.h"
#include "bindings/cli/load_flags.h"
#include "bindings/cli/verbs.h"
#include "kernel/io/animation_list.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/label_adder.h"
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

// Each measure may take a while, so that they can be cancelled one by one. What exceeds the range
// of numbers is NaN or infinite, and then null where JSON is written.
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

}  // namespace

int inspect(Program& program, const std::vector<std::string>& words) {
    CLI::App app("Says what is in mesh files.", "lissom inspect");
    std::vector<std::string> files;
    LoadFlags flags;
    app.add_option("MESH", files, "Mesh files")->required();
    flags.declare(app);
    int status = kSuccess;
    if (!program.parse(app, words, status)) return status;
    LoadOptions options;
    flags.apply(options);
    // What was found is part of the answer.
    program.log_filter = [&](LogLevel, std::string_view) { return program.debug; };
    Json answers = Json::array();
    for (const std::string& file : files) {
        try {
            const Mesh mesh = load_mesh(file, options, program.context());
            program.clear_progress();
            answers.push_back(mesh_json(file, mesh, program.context()));
            if (program.json()) continue;
            print_mesh(answers.back());
            print_report(mesh.report());
        } catch (const Error& error) {
            status = kFailure;
            answers.push_back({{"file", file}, {"error", error_json(error)}});
            if (!program.json()) program.fail(error);
            if (error.code() == ErrorCode::cancelled) break;
        }
    }
    program.clear_progress();
    if (program.json()) std::cout << json_text({{"meshes", answers}}) << std::endl;
    return status;
}

}  // namespace lissom::cli
