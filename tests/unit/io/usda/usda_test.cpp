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
    CHECK(code(curve("(0,0,0), (1,0,0), (2,0,0)", 3, "")) == ErrorCode::file_syntax);
    CHECK(code("/* " + curve(line, 4, kLinear)) == ErrorCode::file_truncated);
    const Error binary = error_of([] { decode_strands("PXR-USDC\0\0", "usda"); });
    CHECK(binary.message().find("binary") != std::string::npos);
}

TEST_CASE("a layer without curves has no strands") {
    CHECK(read("def Mesh \"m\" { point3f[] points = [(0,0,0)] }\n").empty());
    CHECK(read("").empty());
}

TEST_CASE("comments of a layer hold no curves and no values") {
    const std::string kept = curve("(7,0,0), (8,0,0)", 2, kLinear);
    const std::string other = curve("(0,0,0), (1,0,0)", 2, kLinear);
    const Strands strands = read("/* the first try\n" + other + "*/\n" + kept + "// " +
                                 kept.substr(0, 3) + "\n/* a */ /**/ /* * / */ # /* not open\n");
    REQUIRE(strands.size() == 1);
    CHECK(strands.root(0) == Eigen::Vector3f(7, 0, 0));
    const Strands plain = read(curve("(0,0,0), (1,0,0)", 2,
                                     kLinear + "    // float[] widths = [9] ( interpolation = "
                                               "\"constant\" )\n    /* float[] widths = [8] */"
                                               " rel a = </b//c>\n"));
    CHECK(plain.widths().common == kHairWidth);
    const Error error = error_of([&] { read("/* one\ntwo */\n" + curve("(0,x,0)", 1, kLinear)); });
    CHECK(error.elements().ids == std::vector<Index>{6});
}

TEST_CASE("indexed primvars give each curve the value of its index") {
    const std::string points = "(0,0,0), (1,0,0), (0,1,0), (0,2,0), (0,3,0)";
    const auto text = [&](const std::string& rest) {
        std::string all = curve(points, 2, kLinear + rest);
        all.replace(all.find("[2]"), 3, "[2, 3]");
        return all;
    };
    const Strands strands = read(text(R"(
        color3f[] primvars:displayColor = [(1,0,0), (0,0,1)] ( interpolation = "uniform" )
        int[] primvars:displayColor:indices = [1, 0]
        float[] primvars:displayOpacity = [1, 0.5] ( interpolation = "vertex" )
        int[] primvars:displayOpacity:indices = [0, 1, 0, 1, 1]
        int[] primvars:st:indices = [0, 0]
        texCoord2f[] primvars:st = [(0.25, 0.5)] ( interpolation = "uniform" )
        float[] primvars:widths = [3, 4] ( interpolation = "uniform" )
        int[] primvars:widths:indices = [1, 1]
        string[] primvars:group = ["fringe", "back"] ( interpolation = "uniform" )
)"));
    CHECK(strands.colors()->at(0, 0) == Eigen::Vector3f(0, 0, 1));
    CHECK(strands.colors()->at(1, 2) == Eigen::Vector3f(1, 0, 0));
    CHECK(strands.transparency().values == std::vector<float>{0, 0.5f, 0, 0.5f, 0.5f});
    CHECK(strands.roots().uvs[1] == Eigen::Vector2f(0.25f, 0.5f));
    CHECK(strands.widths().values == std::vector<float>{4, 4});
    CHECK(strands.group_names() == std::vector<std::string>{"fringe", "back"});
    CHECK(strands.group(1) == 1);
    for (const char* bad : {"[0, 2]", "[0, -1]", "[0.5, 0]", "[0]", "[0, 1, 0]", "[1e30, 0]"}) {
        CAPTURE(bad);
        const std::string colors =
            "color3f[] primvars:displayColor = [(1,0,0), (0,0,1)] ( interpolation = \"uniform\" "
            ")\nint[] primvars:displayColor:indices = ";
        const Error error = error_of([&] { read(text(colors + bad + "\n")); });
        CHECK(error.code() == ErrorCode::file_syntax);
    }
    CHECK_FALSE(read(text("color3f[] primvars:displayColor = None\n")).colors());
}

TEST_CASE("curves stand where the transforms of their prims put them") {
    const auto place = [](const std::string& outer, const std::string& inner) {
        const Strands strands =
            read("def Xform \"x\"\n{\n" + outer +
                 curve("(1,2,3), (1,2,4)", 2,
                       kLinear + "float[] widths = [1] (interpolation = \"constant\")\n" + inner) +
                 "}\n");
        REQUIRE(strands.size() == 1);
        return std::pair<Eigen::Vector3f, double>(strands.root(0), strands.widths().common);
    };
    const auto order = [](const std::string& names) {
        return "uniform token[] xformOpOrder = [" + names + "]\n";
    };
    const auto one = [&](const std::string& name, const std::string& value) {
        return "double3 xformOp:" + name + " = " + value + "\n" + order("\"xformOp:" + name + "\"");
    };
    const auto is_at = [&](const std::string& inner, const Eigen::Vector3f& expected) {
        CAPTURE(inner);
        CHECK(place("", inner).first.isApprox(expected, 1e-6f));
        CHECK(place(inner, "").first.isApprox(expected, 1e-6f));
    };
    CHECK(place(order(""), order("")).first == Eigen::Vector3f(1, 2, 3));
    is_at(one("translate", "(1, 1, 1)"), {2, 3, 4});
    is_at(one("translateY", "5"), {1, 7, 3});
    is_at(one("scale", "(2, 3, 4)"), {2, 6, 12});
    is_at(one("scaleZ", "2"), {1, 2, 6});
    is_at(one("rotateX", "90"), {1, -3, 2});
    is_at(one("rotateY", "-90"), {-3, 2, 1});
    is_at(one("rotateZ", "180"), {-1, -2, 3});
    is_at(one("rotateZ", "30"), {std::cos(0.5235988f) - 1.0f, 0.5f + 1.7320508f, 3});
    // First about x: (1, -3, 2), then about y: (2, -3, -1), then about z: (3, 2, -1).
    is_at(one("rotateXYZ", "(90, 90, 90)"), {3, 2, -1});
    // First about z: (-2, 1, 3), then about y: (3, 1, 2), then about x: (3, -2, 1).
    is_at(one("rotateZYX", "(90, 90, 90)"), {3, -2, 1});
    is_at(one("orient", "(0.70710678, 0.70710678, 0, 0)"), {1, -3, 2});
    is_at(one("transform", "( (0,1,0,0), (-1,0,0,0), (0,0,1,0), (10,20,30,1) )"), {8, 21, 33});
    is_at("double3 xformOp:translate = (10, 0, 0)\nfloat3 xformOp:scale = (2, 2, 2)\n" +
              order("\"xformOp:translate\", \"xformOp:scale\""),
          {12, 4, 6});
    is_at("float3 xformOp:translate:pivot = (1, 2, 0)\nfloat xformOp:rotateZ = 90\n" +
              order("\"xformOp:translate:pivot\", \"xformOp:rotateZ\", "
                    "\"!invert!xformOp:translate:pivot\""),
          {1, 2, 3});
    is_at("double3 xformOp:translate\n" + order("\"xformOp:translate\""), {1, 2, 3});
    CHECK(place(one("translate", "(0, 0, 5)"), one("rotateX", "90")).first ==
          Eigen::Vector3f(1, -3, 7));
    CHECK(
        place(one("translate", "(0, 0, 5)"),
              "double3 xformOp:translate:a = (1, 0, 0)\ndouble3 xformOp:translate:b = (9, 9, 9)\n" +
                  order("\"xformOp:translate:b\", \"!resetXformStack!\", \"xformOp:translate:a\""))
            .first == Eigen::Vector3f(2, 2, 3));
    CHECK(place(one("scale", "(2, 4, 8)"), "").second == doctest::Approx(4.0));
    CHECK(place(one("translate", "(2, 4, 8)"), "").second == 1.0);
}

TEST_CASE("transforms that make no sense are refused, unless nothing is drawn under them") {
    const auto text = [](const std::string& attribute, const std::string& rest = "") {
        return "def Xform \"x\"\n{\n" + attribute + rest +
               "uniform token[] xformOpOrder = [\"xformOp:" +
               attribute.substr(8, attribute.find_first_of(" .") - 8) + "\"]\n" +
               curve("(0,0,0), (1,0,0)", 2, kLinear) + "}\n";
    };
    const auto code = [&](const std::string& attribute) {
        return error_of([&] { read(text(attribute)); }).code();
    };
    CHECK(code("xformOp:scale = (0, 1, 1)\n") == ErrorCode::unsupported);
    CHECK(code("xformOp:shear = (0, 1, 1)\n") == ErrorCode::unsupported);
    CHECK(code("xformOp:rotateXXZ = (0, 1, 1)\n") == ErrorCode::unsupported);
    CHECK(code("xformOp:transform = (1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1)\n") ==
          ErrorCode::unsupported);
    CHECK(code("xformOp:translate.timeSamples = { 0: (1, 2, 3) }\n") == ErrorCode::unsupported);
    CHECK(code("xformOp:scale = (2, 1)\n") == ErrorCode::file_syntax);
    CHECK(code("xformOp:orient = (0, 0, 0, 0)\n") == ErrorCode::file_syntax);
    CHECK(code("xformOp:scale = (nan, 1, 1)\n") == ErrorCode::not_finite);
    CHECK(code("xformOp:translate = (1e300, 1, 1)\n") == ErrorCode::not_finite);
    CHECK(read(text("xformOp:scale = (0, 1, 1)\n", "token visibility = \"invisible\"\n")).empty());
    CHECK(read("def Xform \"x\"\n{\nfloat3 xformOp:scale = (0, 1, 1)\n"
               "uniform token[] xformOpOrder = [\"xformOp:scale\"]\n}\n" +
               curve("(0,0,0), (1,0,0)", 2, kLinear))
              .size() == 1);
}

TEST_CASE("curves that are inactive or invisible are left out, and the log names them") {
    const std::string plain = curve("(0,0,0), (1,0,0)", 2, kLinear);
    const std::string seen = "def BasisCurves \"seen\"" + plain.substr(plain.find("\n{"));
    const std::string hidden = plain.substr(plain.find("\n{"));
    for (const std::string& text :
         {"def BasisCurves \"no\" ( active = false )" + hidden,
          "def BasisCurves \"no\" ( kind = \"a\" prepend references = @a@ (offset = 1) active = 0 "
          ")" +
              hidden,
          "def Xform \"x\" ( active = false ) {\ndef BasisCurves \"no\"" + hidden + "}\n",
          "def BasisCurves \"no\"\n{\ntoken visibility = \"invisible\"\n" + hidden.substr(2),
          "def Xform \"x\" {\ndef Scope \"y\" {\ndef BasisCurves \"no\"" + hidden +
              "}\ntoken visibility = \"invisible\"\n}\n"}) {
        CAPTURE(text);
        const LoggedContext logged;
        const Strands strands =
            decode_strands("#usda 1.0\n" + text + seen, "usda", {}, logged.context);
        CHECK(strands.size() == 1);
        CHECK(strands.group_names().empty());
        CHECK(logged.mentions("1 BasisCurves"));
        CHECK(logged.mentions("'no'"));
    }
    CHECK(read("def BasisCurves \"c\" ( active = true customData = { bool active = 0 } )" + hidden)
              .size() == 1);
    CHECK(read("def Xform \"x\" ( active = false ) { }\n" + seen).size() == 1);
}

TEST_CASE("a byte order mark before a layer is passed over") {
    const std::string text = "\xef\xbb\xbf#usda 1.0\n" + curve("(0,0,0), (1,0,0)", 2, kLinear);
    CHECK(decode_strands(text, "usda").size() == 1);
}

TEST_CASE("the log says what a layer without curves holds") {
    const LoggedContext logged;
    const std::string text =
        "#usda 1.0\n(\nsubLayers = [\n@./hair.usda@ (offset = 1)\n]\n)\ndef Xform \"a\" {\ndef "
        "Mesh "
        "\"b\" { }\ndef Mesh \"c\" { }\nover \"d\" { }\n}\n";
    CHECK(decode_strands(text, "usda", {}, logged.context).empty());
    CHECK(logged.mentions("2 Mesh"));
    CHECK(logged.mentions("1 Xform"));
    CHECK(logged.mentions("@./hair.usda@"));
}

TEST_CASE("USDA has what Unreal Engine reads of grooms by its names too") {
    Strands strands =
        strands_of({{{0, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {1, 1, 0}}, {{2, 0, 0}, {2, 1, 0}}});
    strands.set_groups({0, kNoIndex, 1}, {"fringe", "back"});
    strands.set_ids({10, 11, 12});
    strands.set_guides({{11, 11, kNoGuide}, {0.5f, 1.0f, 0.0f}});
    strands.set_roots({{}, {}, {{0.25f, 0.5f}, {0.5f, 0.5f}, {0.75f, 1.0f}}});
    const std::string text = encode_strands(strands, "usda").bytes;
    for (const char* part :
         {"prepend apiSchemas = [\"GroomAPI\"]", "int primvars:groom_version_major = 1",
          "int[] primvars:groom_id = [0, 1, 2]", "int[] primvars:groom_guide = [0, 1, 0]",
          "int[] primvars:groom_group_id = [0, 2, 1]",
          "string[] primvars:groom_group_name = [\"fringe\", \"\", \"back\"]",
          "float2[] primvars:groom_root_uv = [(0.25, 0.5), (0.5, 0.5), (0.75, 1)]"}) {
        CAPTURE(part);
        CHECK(text.find(part) != std::string::npos);
    }
    CHECK(hash(decode_strands(text, "usda")) == hash(strands));
    CHECK(encode_strands(random_hair(2), "usda").bytes.find("groom_guide") == std::string::npos);
}
