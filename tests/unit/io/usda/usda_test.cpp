// BasisCurves as other programs write them.
#include "kernel/io/strand_file.h"
#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Strands read(const std::string& text, const StrandLoadOptions& options = {}) {
    return decode_strands("#usda 1.0\n" + text, "usda", options);
}

// A single curve of these points and attributes.
std::string curve(const std::string& points, int count, const std::string& rest) {
    return "def BasisCurves \"c\"\n{\n    int[] curveVertexCounts = [" + std::to_string(count) +
           "]\n    point3f[] points = [" + points + "]\n" + rest + "}\n";
}

const std::string kLinear = "    uniform token type = \"linear\"\n";

}  // namespace

TEST_CASE("a layer as other programs write it is read") {
    const Strands strands = read(R"((
    doc = """Made by hand, with "quotes" and ( brackets"""
    defaultPrim = "World"
    metersPerUnit = 0.01
    upAxis = "Z"
    customLayerData = {
        string name = "a [ b"
        dictionary inner = { int x = 1 }
    }
)

def Xform "World" ( kind = "component" )
{
    # a comment with } in it
    rel material:binding = </World/Looks/Hair>
    custom string note
    token visibility = "inherited"
    def Scope "Looks" { def Material "Hair" { token outputs:surface.connect = </World/Looks/Hair/s.out> } }
    def BasisCurves "left" (
        prepend apiSchemas = ["MaterialBindingAPI"]
    )
    {
        uniform token type = "linear"
        uniform token wrap = "nonperiodic"
        int[] curveVertexCounts = [2, 3]
        point3f[] points = [(0, 0, 100), (0, 0, 200), (1, 0, 0), (2, 0, 0), (3, 0, +0)] (
            interpolation = "vertex"
        )
        float[] widths = [0.01, 0.02] ( interpolation = "uniform" )
        color3f[] primvars:displayColor = [(0.5, 0.25, 0.125)]
        texCoord2f[] primvars:st = [(0, 0), (1, 0.5)] ( elementSize = 1 interpolation = "uniform" )
        float[] primvars:other.timeSamples = { 0: [1, 2], 1: [3, 4], }
    }
    def BasisCurves "right"
    {
        uniform token type = "linear"
        int[] curveVertexCounts = [2]
        point3f[] points = [(0, 0, 0), (0, 0, 1)]
    }
}
)");
    REQUIRE(strands.size() == 3);
    CHECK(strands.root(0).isApprox(Eigen::Vector3f(0, 1, 0)));
    CHECK(strands.point_count(1) == 3);
    CHECK(strands.widths().at(1, 2) == doctest::Approx(0.0002));
    CHECK(strands.colors()->at(0, 0) == Eigen::Vector3f(0.5f, 0.25f, 0.125f));
    CHECK(strands.roots().uvs[1] == Eigen::Vector2f(1, 0.5f));
    CHECK(strands.group_names() == std::vector<std::string>{"left", "right"});
    CHECK(strands.group(2) == 1);
}

TEST_CASE("options win over what the layer says of itself") {
    const std::string text =
        "(\nmetersPerUnit = 0.01\nupAxis = \"Z\"\n)\n" + curve("(1, 2, 3), (1, 2, 4)", 2, kLinear);
    CHECK(read(text).root(0).isApprox(Eigen::Vector3f(0.01f, 0.03f, -0.02f)));
    CHECK(read(text, {UpAxis::y, 1.0}).root(0) == Eigen::Vector3f(1, 2, 3));
}

TEST_CASE("strands without widths have that of a hair in any unit") {
    const std::string text =
        "(\nmetersPerUnit = 0.01\n)\n" + curve("(1, 2, 3), (1, 2, 4)", 2, kLinear);
    CHECK(read(text).widths().common == kHairWidth);
}

TEST_CASE("cubic curves become polylines on them") {
    const std::string line = "(0,0,0), (1,0,0), (2,0,0), (3,0,0)";
    const auto ends = [&](const std::string& basis, const std::string& wrap) {
        const Strands strands = read(curve(line, 4,
                                           "    uniform token basis = \"" + basis +
                                               "\"\n    uniform token wrap = \"" + wrap + "\"\n"));
        const StrandView strand = strands.strand(0);
        for (Index k = 1; k < strand.cols(); ++k) CHECK(strand(0, k) > strand(0, k - 1));
        return std::pair(strand(0, 0), strand(0, strand.cols() - 1));
    };
    CHECK(ends("bezier", "nonperiodic") == std::pair(0.0f, 3.0f));
    CHECK(ends("catmullRom", "nonperiodic") == std::pair(1.0f, 2.0f));
    const auto inner = ends("bspline", "nonperiodic");
    CHECK(inner.first == doctest::Approx(1.0));
    CHECK(inner.second == doctest::Approx(2.0));
    for (const char* basis : {"bspline", "catmullRom"}) {
        const auto whole = ends(basis, "pinned");
        CHECK(whole.first == doctest::Approx(0.0).epsilon(1e-6));
        CHECK(whole.second == doctest::Approx(3.0));
    }
}

TEST_CASE("a Bezier curve goes where its polynomial does, and so do its widths") {
    const Strands strands =
        read(curve("(0,0,0), (0,1,0), (1,1,0), (1,0,0)", 4,
                   "    float[] widths = [1, 3] (interpolation = \"varying\")\n"));
    REQUIRE(strands.point_count() == 5);
    CHECK(strands.strand(0).col(2).isApprox(Eigen::Vector3f(0.5f, 0.75f, 0.0f)));
    CHECK(strands.widths().values == std::vector<float>{1.0f, 1.5f, 2.0f, 2.5f, 3.0f});
    const Strands vertex =
        read(curve("(0,0,0), (0,1,0), (1,1,0), (1,0,0)", 4, "    float[] widths = [1, 1, 1, 3]\n"));
    CHECK(vertex.widths().values[2] == doctest::Approx(1.25));
}

TEST_CASE("what cannot be read right is refused, not read wrong") {
    const std::string line = "(0,0,0), (1,0,0), (2,0,0), (3,0,0)";
    const auto code = [](const std::string& text) { return error_of([&] { read(text); }).code(); };
    CHECK(code(curve(line, 4, "uniform token wrap = \"periodic\"\n")) == ErrorCode::unsupported);
    CHECK(code(curve(line, 4, "uniform token type = \"quintic\"\n")) == ErrorCode::unsupported);
    CHECK(code(curve(line, 4, "uniform token basis = \"hermite\"\n")) == ErrorCode::unsupported);
    CHECK(code(curve(line, 4, kLinear + "point3f[] points.timeSamples = { 0: [] }\n")) ==
          ErrorCode::unsupported);
    CHECK(code(curve(line, 4,
                     kLinear + "float[] widths = [1] (interpolation = \"faceVarying\")\n")) ==
          ErrorCode::unsupported);
    const std::string moved =
        "double3 xformOp:translate = (1, 2, 3)\nuniform token[] xformOpOrder "
        "= [\"xformOp:translate\"]\n";
    CHECK(code(curve(line, 4, kLinear + moved)) == ErrorCode::unsupported);
    CHECK(code("def Xform \"x\"\n{\n" + moved + curve(line, 4, kLinear) + "}\n") ==
          ErrorCode::unsupported);
    CHECK(code(curve("(0,0,0), (1,0,0), (2,0,0)", 3, "")) == ErrorCode::file_syntax);
    const Error binary = error_of([] { decode_strands("PXR-USDC\0\0", "usda"); });
    CHECK(binary.message().find("binary") != std::string::npos);
}

TEST_CASE("a layer without curves has no strands") {
    CHECK(read("def Mesh \"m\" { point3f[] points = [(0,0,0)] }\n").empty());
    CHECK(read("").empty());
}
