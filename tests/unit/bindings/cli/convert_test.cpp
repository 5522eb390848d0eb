// lissom convert with many files, and what inspect says of repairs.
#include <csignal>
#include <map>

#include "tests/unit/bindings/cli/program_run.h"
#include "tests/unit/support.h"

namespace lissom::test {

int run_tested_program(int argc, char** argv) {
    return cli::run_program(argc, argv, cli::kernel_parts());
}

namespace {

using ConvertJson = nlohmann::json;

const char* const kConvertTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
// The second face runs the other way; one vertex is not used.
const char* const kConvertTwisted =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 5 5 5\nf 1 2 3\nf 1 2 4\n";

std::map<std::string, ConvertJson> rows_of(const Ended& ended) {
    std::map<std::string, ConvertJson> rows;
    const ConvertJson answer = ConvertJson::parse(ended.out);
    for (const ConvertJson& row : answer["files"]) {
        rows[std::filesystem::path(row["file"].get<std::string>()).filename().string()] = row;
    }
    return rows;
}

TEST_CASE("convert takes many files, goes on after a failure and tells what came of each") {
    const ProgramFolder folder;
    folder.write("a/good.obj", kConvertTriangle);
    folder.write("a/twisted.obj", kConvertTwisted);
    folder.write("a/bad.obj", "v 0 0 0\nf 1 2 3\n");
    const std::vector<std::string> words{
        "convert", "--in", folder.path("a/*.obj"), "--out", folder.path("b/c"), "--to", "ply"};
    const Ended table = run_program(words);
    CHECK(table.status == cli::kFailure);
    CHECK(table.err.empty());
    CHECK(table.out.find("1 converted, 1 repaired, 1 failed") != std::string::npos);
    CHECK(table.out.find("face_index: line 2: vertex 3 does not exist") != std::string::npos);
    CHECK(table.out.find("1 face turned over") != std::string::npos);
    CHECK(folder.has("b/c/good.ply"));
    CHECK(folder.has("b/c/twisted.ply"));
    CHECK_FALSE(folder.has("b/c/bad.ply"));

    std::vector<std::string> json_words = words;
    json_words.push_back("--json");
    const Ended json = run_program(json_words);
    CHECK(json.status == cli::kFailure);
    std::map<std::string, ConvertJson> rows = rows_of(json);
    REQUIRE(rows.size() == 3);
    CHECK(rows["good.obj"]["outcome"] == "converted");
    CHECK(rows["good.obj"]["vertices"] == 3);
    CHECK(rows["twisted.obj"]["outcome"] == "repaired");
    CHECK(rows["twisted.obj"]["faces"] == 2);
    CHECK(rows["bad.obj"]["error"]["code"] == "face_index");
    CHECK(ConvertJson::parse(json.out)["failed"] == 1);
    CHECK(ConvertJson::parse(json.out)["stopped"] == false);

    json_words.push_back("--no-repair");
    rows = rows_of(run_program(json_words));
    CHECK(rows["good.obj"]["outcome"] == "converted");
    CHECK(rows["twisted.obj"]["outcome"] == "failed");
}

TEST_CASE("convert keeps sub-folders and says what the new format does not hold") {
    const ProgramFolder folder;
    folder.write("a/one.obj", std::string("g left\n") + kConvertTriangle);
    folder.write("a/x/two.obj", kConvertTriangle);
    const Ended ended = run_program({"convert", "--in", folder.path("a/**/*.obj"), "--out",
                                     folder.path("b"), "--to", ".OFF", "--json"});
    CHECK(ended.status == cli::kSuccess);
    CHECK(folder.has("b/one.off"));
    CHECK(folder.has("b/x/two.off"));
    const auto rows = rows_of(ended);
    CHECK(rows.at("one.obj")["lost"][0].get<std::string>().find("'group'") != std::string::npos);
    CHECK(rows.at("two.obj")["lost"].empty());
}

const char* const kConvertHair =
    "#usda 1.0\n(\n    metersPerUnit = 0.01\n)\ndef BasisCurves \"curls\"\n{\n"
    "    uniform token type = \"linear\"\n    int[] curveVertexCounts = [2, 3]\n"
    "    point3f[] points = [(0, 0, 0), (0, 100, 0), (1, 0, 0), (1, 50, 0), (1, 100, 0)]\n}\n";

TEST_CASE("convert writes hair as hair, in every format that holds hair") {
    const ProgramFolder folder;
    const std::string in = folder.write("curls.usda", kConvertHair);
    const auto inspected = [&](const std::string& file) {
        return ConvertJson::parse(run_program({"inspect", file, "--json"}).out)["hair"][0];
    };
    std::string last = in;
    for (const char* name : {"a.data", "b.hair", "c.usda"}) {
        const std::string out = folder.path(name);
        const Ended ended = run_program({"convert", last, out, "--json"});
        CAPTURE(ended.err);
        REQUIRE(ended.status == cli::kSuccess);
        CHECK(ConvertJson::parse(ended.out)["strands"] == 2);
        CHECK(inspected(out)["points"] == 5);
        CHECK(inspected(out)["bounds"]["max"][1].get<double>() == doctest::Approx(1.0));
        last = out;
    }
    CHECK(run_program({"convert", in, folder.path("lines.glb")}).status == cli::kSuccess);
    // A .ply file may hold either: it is read as hair where only hair can be written.
    const std::string ply = folder.path("curls.ply");
    CHECK(run_program({"convert", in, ply}).status == cli::kSuccess);
    const Ended back = run_program({"convert", ply, folder.path("back.hair"), "--json"});
    CHECK(ConvertJson::parse(back.out)["strands"] == 2);
    const Ended mesh = run_program({"convert", in, folder.path("no.stl")});
    CHECK(mesh.status == cli::kFailure);
    CHECK(mesh.err.find("hair cannot be written to '.stl' files; known are") != std::string::npos);
    const Ended text = run_program({"convert", in, folder.path("no.data"), "--text"});
    CHECK(text.status == cli::kFailure);
    CHECK(text.err.find("--text is for meshes") != std::string::npos);
    const std::string triangle = folder.write("t.obj", kConvertTriangle);
    const Ended hair = run_program({"convert", triangle, folder.path("no.usda")});
    CHECK(hair.status == cli::kFailure);
    CHECK(hair.err.find("such files hold hair, and") != std::string::npos);
    const Ended many = run_program(
        {"convert", "--in", triangle, "--out", folder.path("many"), "--to", "data", "--json"});
    CHECK(rows_of(many).at("t.obj")["error"]["code"] == "unknown_format");
}

TEST_CASE("convert finds hair by patterns and in folders, and says why a pattern finds nothing") {
    const ProgramFolder folder;
    folder.write("in/curls.usda", kConvertHair);
    folder.write("in/t.obj", kConvertTriangle);
    folder.write("in/notes.txt", "x");
    const auto converted = [&](const std::string& pattern, const std::string& to) {
        std::vector<std::string> words{
            "convert", "--in", folder.path(pattern), "--out", folder.path("out" + to), "--json"};
        if (!to.empty()) words.insert(words.end(), {"--to", to});
        return rows_of(run_program(words));
    };
    CHECK(converted("in/*.usda", "hair").at("curls.usda")["strands"] == 2);
    CHECK(folder.has("outhair/curls.hair"));
    CHECK(converted("in", "data").size() == 1);
    CHECK(converted("in", "").size() == 2);
    // Hair cannot become a .stl file: a folder passes over it, its own extension does not.
    CHECK(converted("in", "stl").size() == 1);
    CHECK(converted("in/*.usda", "stl").at("curls.usda")["error"]["code"] == "unknown_format");
    const auto nothing = converted("in/*.txt", "").at("*.txt");
    CHECK(nothing["error"]["message"].get<std::string>().find("none of its 1 files") !=
          std::string::npos);
    const auto none = converted("in/*.off", "").at("*.off");
    CHECK(none["error"]["message"].get<std::string>().find("no file has such a name") !=
          std::string::npos);
}

TEST_CASE("convert names the objects of a scene that the file does not hold") {
    const ProgramFolder folder;
    const std::string hair = folder.write("curls.usda", kConvertHair);
    const std::string scene = folder.path("both.lissom"), only = folder.path("hair.lissom");
    const std::string script =
        folder.write("make.lua",
                     "local lissom = require 'lissom'\nlocal scene = lissom.scene{}\n"
                     "scene:add('curls', lissom.load_strands('" +
                         hair +
                         "'))\n"
                         "scene:save('" +
                         only +
                         "')\n"
                         "scene:add('ball', lissom.shapes.sphere())\nscene:save('" +
                         scene + "')\n");
    REQUIRE(run_program({"run", script}).err == "");
    const Ended glb = run_program({"convert", scene, folder.path("a.glb")});
    CHECK(glb.status == cli::kSuccess);
    CHECK(glb.err.find("left out: 'curls' (strands); ") != std::string::npos);
    const Ended json = run_program({"convert", scene, folder.path("a.glb"), "--json"});
    CHECK(ConvertJson::parse(json.out)["lost"].size() == 1);
    const Ended data = run_program({"convert", scene, folder.path("a.data")});
    CHECK(data.status == cli::kSuccess);
    CHECK(data.err.find("left out: 'ball' (mesh); ") != std::string::npos);
    const Ended lines = run_program({"convert", only, folder.path("b.glb"), "--json"});
    CHECK(lines.err == "");
    CHECK(ConvertJson::parse(lines.out)["strands"] == 2);
}

TEST_CASE("convert writes no output twice and replaces no input unasked") {
    const ProgramFolder folder;
    folder.write("a/one.obj", kConvertTriangle);
    folder.write("a/one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    const std::string a = folder.path("a"), b = folder.path("b");
    const Ended twice = run_program({"convert", "--in", a, "--out", b, "--to", "ply", "--json"});
    CHECK(twice.status == cli::kFailure);
    CHECK(rows_of(twice).at("one.obj")["outcome"] == "converted");
    CHECK(rows_of(twice).at("one.off")["error"]["code"] == "file_write_failed");

    const Ended over = run_program({"convert", "--in", a, "--out", a, "--to", "off", "--json"});
    CHECK(over.status == cli::kFailure);
    CHECK(rows_of(over).at("one.obj")["outcome"] == "failed");
    CHECK(rows_of(over).at("one.off")["outcome"] == "failed");
    const std::string in = folder.path("a/one.obj");
    CHECK(run_program({"convert", "--in", in, "--out", a}).status == cli::kFailure);
    CHECK(run_program({"convert", "--in", in, "--out", a, "--force"}).status == cli::kSuccess);
    CHECK(run_program({"convert", in, in}).status == cli::kFailure);
    CHECK(run_program({"convert", in, in, "--force"}).status == cli::kSuccess);
    // Outputs of an earlier run may be replaced, and those inside the inputs' folder are no inputs.
    const std::vector<std::string> inside{"convert", "--in", folder.path("a/**/*.obj"), "--out",
                                          folder.path("a/new")};
    CHECK(run_program(inside).status == cli::kSuccess);
    CHECK(run_program(inside).status == cli::kSuccess);
    CHECK_FALSE(folder.has("a/new/new"));
}

TEST_CASE("convert refuses a command line that makes no sense, and names what is not there") {
    const ProgramFolder folder;
    const std::string in = folder.write("one.obj", kConvertTriangle), out = folder.path("b");
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"convert"},
             {"convert", "--in", in},
             {"convert", "--out", out},
             {"convert", in, "--out", out},
             {"convert", "--in", in, "--out", out, "--to", "doc"},
             {"convert", "--in", in, "--out", out, "--weld", "some"}}) {
        CHECK(run_program(words).status == cli::kUsage);
    }
    const Ended none =
        run_program({"convert", "--in", folder.path("*.ply"), in, "--out", out, "--json"});
    CHECK(none.status == cli::kFailure);
    CHECK(rows_of(none).at("*.ply")["error"]["code"] == "file_not_found");
    CHECK(rows_of(none).at("one.obj")["outcome"] == "converted");
    CHECK(run_program({"convert", "--in", in, "--out", in}).status == cli::kFailure);
}

TEST_CASE("weld says which vertices become one") {
    const ProgramFolder folder;
    const std::string soup = folder.write(
        "soup.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 4 5 6\n");
    const auto vertices = [&](const char* weld) {
        const Ended ended = run_program({"inspect", soup, "--weld", weld, "--json"});
        return ConvertJson::parse(ended.out)["meshes"][0]["vertices"].get<int>();
    };
    CHECK(vertices("none") == 6);
    CHECK(vertices("seams") == 4);
    CHECK(vertices("all") == 4);
}

TEST_CASE("inspect shows what was found") {
    const ProgramFolder folder;
    const std::string file = folder.write("twisted.obj", std::string(kConvertTwisted) + "l 1 2\n");
    const Ended text = run_program({"inspect", file});
    CHECK(text.status == cli::kSuccess);
    CHECK(text.err.empty());
    CHECK(text.out.find("1 vertex without faces dropped; in the file: vertex 5") !=
          std::string::npos);
    CHECK(text.out.find("1 item skipped: 1 lines") != std::string::npos);
    const ConvertJson report =
        ConvertJson::parse(run_program({"inspect", file, "--json"}).out)["meshes"][0]["report"];
    std::map<std::string, ConvertJson> findings;
    for (const ConvertJson& finding : report) findings[finding["kind"]] = finding;
    CHECK(findings["vertices_unreferenced"]["ids"] == ConvertJson::parse("[5]"));
    CHECK(findings["vertices_unreferenced"]["of"] == "file");
    CHECK(findings["vertices_unreferenced"]["element"] == "vertex");
    CHECK(findings["content_skipped"]["count"] == 1);
    CHECK(findings["content_skipped"]["element"].is_null());
    CHECK(run_program({"inspect", file, "--no-repair"}).status == cli::kFailure);
}

}  // namespace
}  // namespace lissom::test
