#include "kernel/hair/scalp/scalp.h"

#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

Mat3 mat3(const Vec3& a, const Vec3& b, const Vec3& c) {
    Mat3 result;
    result << a, b, c;
    return result;
}

// The generic shape of a skull: longer than wide.
Mesh egg() {
    return test::moved(make_sphere({.segments = 40}), scaling(Vec3(0.08, 0.1, 0.1), Vec3::Zero()));
}

ScalpOptions upright() {
    ScalpOptions options;
    options.hints = {Vec3::UnitY(), Vec3::UnitZ()};
    return options;
}

double root_area(const Mesh& mesh, const Scalp& scalp) {
    const std::vector<double> areas = face_areas(mesh);
    double sum = 0.0;
    for (const Index f : scalp.root_faces()) sum += areas[f];
    return sum / (scalp.scale() * scalp.scale());
}

// The faces all of whose vertices are where `keeps` says.
template <typename Keeps>
Mesh part_where(const Mesh& mesh, const Keeps& keeps) {
    std::vector<Vec3> positions;
    std::vector<Index> number(static_cast<std::size_t>(mesh.vertex_count()), kNoIndex);
    FaceList faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.topology().face(f);
        if (!std::all_of(face.begin(), face.end(),
                         [&](Index v) { return keeps(mesh.position(v)); })) {
            continue;
        }
        std::vector<Index> corners;
        for (const Index v : face) {
            Index& kept = number[static_cast<std::size_t>(v)];
            if (kept == kNoIndex) {
                kept = static_cast<Index>(positions.size());
                positions.push_back(mesh.position(v));
            }
            corners.push_back(kept);
        }
        faces.add(corners);
    }
    return Mesh(std::move(positions), std::move(faces));
}

// The face of a head in its usual place, from ear to ear.
Mesh mask_of(const Mesh& head) {
    const Scalp scalp(head);
    return part_where(head, [&](const Vec3& p) {
        const Vec3 m = scalp.to_metres(p);
        return m.z() > 0.005 && m.y() > -0.12;
    });
}

Mesh left_half_of(const Mesh& head) {
    const Scalp scalp(head);
    return part_where(head, [&](const Vec3& p) { return scalp.to_metres(p).x() > -1e-6; });
}

// What making a scalp says.
std::string warning_of(const Mesh& head, const ScalpOptions& options = {}) {
    std::string said;
    ContextOptions context;
    context.log = [&](LogLevel level, std::string_view text) {
        if (level == LogLevel::warning) said += std::string(text) + "\n";
    };
    Scalp(head, options, Context(context));
    return said;
}

// A head with balls for eyes beside it.
Mesh with_eyes(const Mesh& head) {
    std::vector<Vec3> positions(head.positions().begin(), head.positions().end());
    FaceList faces;
    for (Index f = 0; f < head.face_count(); ++f) faces.add(head.topology().face(f));
    const Mesh ball = make_sphere({.radius = 0.012, .segments = 12});
    for (const double side : {-1.0, 1.0}) {
        const auto first = static_cast<Index>(positions.size());
        for (const Vec3& p : ball.positions()) {
            positions.push_back(p + Vec3(0.0318 * side, -0.0098, 0.064));
        }
        for (Index f = 0; f < ball.face_count(); ++f) {
            const auto face = ball.topology().face(f);
            std::vector<Index> corners(face.begin(), face.end());
            for (Index& corner : corners) corner += first;
            faces.add(corners);
        }
    }
    return Mesh(std::move(positions), std::move(faces));
}

}  // namespace

TEST_CASE("the frame of an ellipsoid lies on its axes") {
    const Scalp scalp(egg(), upright());
    CHECK(scalp.frame().width == Approx(0.16).epsilon(0.1));
    CHECK(scalp.frame().length / scalp.frame().width == Approx(1.25).epsilon(0.01));
    CHECK(scalp.frame().center.x() == Approx(0.0).epsilon(1e-6));
    CHECK(scalp.frame().center.y() == Approx(0.1 - 0.65 * scalp.frame().width));
    CHECK(scalp.frame().axes == Mat3::Identity());
}

TEST_CASE("directions, metres and points convert back and forth") {
    const Scalp scalp(egg(), upright());
    for (int azimuth = -170; azimuth <= 180; azimuth += 35) {
        for (int elevation = -80; elevation < 90; elevation += 20) {
            const ScalpDirection direction{azimuth * kDegree, elevation * kDegree};
            const ScalpPoint point = scalp.at(direction);
            const ScalpDirection back = scalp.direction_of(point.position);
            CHECK(back.azimuth == Approx(direction.azimuth));
            CHECK(back.elevation == Approx(direction.elevation));
            CHECK(point.normal.norm() == Approx(1.0));
            const Vec3 lifted = scalp.at(direction, 0.02).position;
            CHECK((lifted - point.position).dot(point.normal) == Approx(0.02 * scalp.scale()));
            CHECK((scalp.from_metres(scalp.to_metres(lifted)) - lifted).norm() < 1e-12);
        }
    }
    CHECK(scalp.at({0.0, 0.0}).normal.dot(Vec3::UnitZ()) > 0.99);
    CHECK(scalp.at({0.5 * kPi, 0.0}).normal.dot(Vec3::UnitX()) > 0.98);
}

TEST_CASE("a scalp follows its head through scale, place and turn") {
    const auto mesh = test::load_head("makehuman_head.obj");
    if (!mesh) return;
    const Scalp scalp(*mesh);
    const Mat3 turns[] = {mat3(Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()),
                          mat3(-Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()),
                          mat3(-Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ())};
    const double scales[] = {1.0, 100.0, 0.02};
    for (std::size_t i = 0; i < std::size(turns); ++i) {
        const Mat3& turn = turns[i];
        const double scale = scales[i];
        const Affine map{scale * turn, scale * Vec3(3, -5, 2)};
        const Mesh image = test::moved(*mesh, map);
        const Scalp other(image);
        CHECK(other.scale() == Approx(scale * scalp.scale()));
        CHECK((other.frame().up() - turn * scalp.frame().up()).norm() < 1e-9);
        CHECK((other.frame().front() - turn * scalp.frame().front()).norm() < 1e-9);
        CHECK(other.region().vertices() == scalp.region().vertices());
        const Vec3 p = scalp.at({0.4, 0.7}, 0.01).position;
        CHECK((other.at({0.4, 0.7}, 0.01).position - map(p)).norm() < 1e-6 * scale);
    }
}

TEST_CASE("a generated head's guessed scalp follows it through scale, place and turn") {
    Mesh head = make_head({.vertices = 3000});
    const Mat3 turns[] = {mat3(Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()),
                          mat3(-Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()), Mat3::Identity()};
    const double scales[] = {0.1, 100.0, 1.0};
    // As positions alone, so that the scalp has to be found.
    FaceList faces;
    for (Index f = 0; f < head.face_count(); ++f) faces.add(head.topology().face(f));
    const Mesh plain({head.positions().begin(), head.positions().end()}, faces);
    const Scalp scalp(plain);
    CHECK(scalp.guessed());
    for (std::size_t i = 0; i < std::size(turns); ++i) {
        const double scale = scales[i];
        const Affine map{scale * turns[i], scale * Vec3(3, -5, 2)};
        const Scalp other(test::moved(plain, map));
        CHECK(other.scale() == Approx(scale * scalp.scale()));
        CHECK((other.frame().axes - turns[i] * scalp.frame().axes).norm() < 1e-9);
        CHECK((other.frame().center - map(scalp.frame().center)).norm() < 1e-9 * scale);
        CHECK(other.frame().confidence == Approx(scalp.frame().confidence));
        CHECK(other.region().vertices() == scalp.region().vertices());
        bool alike = true;
        for (std::size_t v = 0; v < scalp.margins().size(); ++v) {
            alike = alike && std::abs(other.margins()[v] - scalp.margins()[v]) < 1e-6;
        }
        CHECK(alike);
    }
}

TEST_CASE("real heads: up, front, unit and the size of the scalp are guessed") {
    struct Head {
        const char* name;
        double front, unit;
    };
    for (const Head& head :
         {Head{"ict_head.obj", 1, 1}, Head{"makehuman_head.obj", 1, 1},
          Head{"digitalsalon_head.obj", 1, 1}, Head{"face_scan_open.obj", 1, 0.01},
          Head{"hairstep_usc_head.obj", 1, 1}, Head{"human_neutral.obj", 1, 1},
          Head{"ict_generic_neutral.obj", 1, 0.01}, Head{"makehuman_base.obj", 1, 0.1},
          Head{"max_planck_decimated.obj", -1, 0}, Head{"max_planck_fprotais.obj", 1, 0},
          Head{"sintel-collider.obj", 1, 1}, Head{"sintel_head.obj", 1, 1},
          Head{"african_head.obj", 1, 0}, Head{"LeePerrySmith.glb", 1, 0},
          Head{"WaltHead.obj", 1, 0}}) {
        const auto mesh = test::load_head(head.name);
        if (!mesh) continue;
        CAPTURE(head.name);
        const Scalp scalp(*mesh);
        CHECK((scalp.frame().up() - Vec3::UnitY()).norm() < 1e-9);
        CHECK((scalp.frame().front() - head.front * Vec3::UnitZ()).norm() < 1e-9);
        CHECK(scalp.frame().asymmetry < 0.05);
        CHECK(scalp.frame().roughness < 0.05);
        CHECK(scalp.frame().forwardness > 0.05);
        if (head.unit > 0.0) CHECK((scalp.knows_unit() && scalp.unit() == head.unit));
        // Walt's hair is modelled.
        const bool bald = head.name != std::string("WaltHead.obj");
        CHECK(bald == (scalp.confidence() > 0.8));
        const double area = root_area(*mesh, scalp);
        CHECK(area > 0.050);
        CHECK(area < 0.076);
        CHECK(scalp.default_box().contains(scalp.at({0.0, 1.2}, 0.05).position));
    }
}

TEST_CASE("scalp: masks and halves of heads are doubted, and a mask looks the right way") {
    std::vector<Mesh> heads = {make_head()};
    for (const char* name : {"ict_head.obj", "makehuman_head.obj", "sintel_head.obj",
                             "digitalsalon_head.obj", "ict_generic_neutral.obj"}) {
        if (auto head = test::load_head(name)) heads.push_back(std::move(*head));
    }
    for (const Mesh& head : heads) {
        CAPTURE(head.vertex_count());
        CHECK(Scalp(head).confidence() > 0.8);
        const Mesh mask = mask_of(head);
        const Scalp on_mask(mask);
        CHECK(on_mask.confidence() < 0.5);
        CHECK((on_mask.frame().up() - Vec3::UnitY()).norm() < 1e-9);
        CHECK((on_mask.frame().front() - Vec3::UnitZ()).norm() < 1e-9);
        CHECK(warning_of(mask).find("confidence") != std::string::npos);
        // Wherever the mask looks.
        const Mat3 turn = mat3(Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY());
        const Scalp turned(test::moved(mask, {turn, Vec3::Zero()}));
        CHECK((turned.frame().up() - turn * Vec3::UnitY()).norm() < 1e-9);
        const Mesh half = left_half_of(head);
        CHECK(Scalp(half).confidence() < 0.5);
        CHECK((Scalp(half).frame().up() - Vec3::UnitY()).norm() < 1e-9);
        CHECK(!warning_of(half).empty());
    }
}

TEST_CASE("scalp: a real open face and a clothed figure are doubted") {
    for (const char* name : {"lscm-head.obj", "threejs_male02.obj"}) {
        const auto mesh = test::load_head(name);
        if (!mesh) continue;
        CAPTURE(name);
        CHECK(Scalp(*mesh).confidence() < 0.5);
        CHECK(warning_of(*mesh).find("confidence") != std::string::npos);
    }
    const auto face = test::load_head("lscm-head.obj");
    if (!face) return;
    CHECK(Scalp(*face).frame().up() == Vec3::UnitY());
    CHECK(Scalp(*face).frame().front() == Vec3::UnitZ());
}

TEST_CASE("scalp: what was given is not doubted") {
    const Mesh head = make_head();
    CHECK(warning_of(head).empty());
    const Mesh half = left_half_of(head);
    ScalpOptions given = upright();
    given.region = select_plane(half, Vec3(0, 0.03, 0), Vec3::UnitY());
    given.unit = 1.0;
    CHECK(warning_of(half, given).empty());
    // An egg has no face, but directions that were given need none.
    CHECK(Scalp(egg()).confidence() < 0.5);
    CHECK(Scalp(egg()).frame().doubt == "front and back are alike");
    CHECK(Scalp(egg(), upright()).confidence() > 0.9);
}

TEST_CASE("scalp: eyes tell which way a head that stands aslant looks") {
    const Mesh upright_head = with_eyes(make_head());
    const Affine aslant = rotation(Vec3::UnitZ(), 0.6, Vec3::Zero());
    const Scalp scalp(test::moved(upright_head, aslant));
    CHECK(scalp.frame().up().dot(aslant.linear * Vec3::UnitY()) > 0.99);
    CHECK(scalp.frame().front().dot(Vec3::UnitZ()) > 0.99);
    CHECK(scalp.confidence() > 0.5);
    // They do not disturb one that stands along the axes.
    CHECK(Scalp(upright_head).frame().axes == Mat3::Identity());
}

TEST_CASE("scalp: directions that are given are kept, whatever eyes say") {
    const Mesh aslant = test::moved(with_eyes(make_head({.vertices = 3000})),
                                    rotation(Vec3::UnitZ(), 0.6, Vec3::Zero()));
    for (const Vec3& up : {Vec3(0, 1, 0), Vec3(0.1, 1, 0.05), Vec3(0.5, 1, 0)}) {
        ScalpOptions options;
        options.hints.up = up;
        CHECK((Scalp(aslant, options).frame().up() - up.normalized()).norm() < 1e-9);
        options.hints = {};
        options.hints.front = Vec3(0.1 * up.x(), 0.0, 1.0);
        CHECK((Scalp(aslant, options).frame().front() - options.hints.front->normalized()).norm() <
              1e-9);
    }
}

TEST_CASE("scalp: a unit that cannot be known says so") {
    const Mesh head = make_head();
    CHECK(Scalp(head).knows_unit());
    for (const double scale : {0.3, 3.0, 25.0, 2000.0}) {
        const Mesh other = test::moved(head, scaling(Vec3::Constant(scale), Vec3::Zero()));
        CAPTURE(scale);
        const Scalp scalp(other);
        CHECK_FALSE(scalp.knows_unit());
        CHECK(scalp.unit() * scalp.scale() == Approx(1.0));
        CHECK(warning_of(other).find("unit of the head is not known") != std::string::npos);
        ScalpOptions given;
        given.unit = 0.5;
        CHECK(Scalp(other, given).knows_unit());
        CHECK(warning_of(other, given).empty());
    }
    for (const double unit : {1.0, 0.01, 0.001, 0.1, 0.0254}) {
        const Scalp scalp(test::moved(head, scaling(Vec3::Constant(1.0 / unit), Vec3::Zero())));
        CHECK(scalp.knows_unit());
        CHECK(scalp.unit() == unit);
    }
}

TEST_CASE("a guessed region has crown, sides and nape, but neither face nor ears") {
    const auto mesh = test::load_head("ict_head.obj");
    if (!mesh) return;
    const Scalp scalp(*mesh);
    CHECK(scalp.guessed());
    const auto holds = [&](double azimuth, double elevation) {
        const auto point = scalp.at({azimuth * kDegree, elevation * kDegree});
        return scalp.region().contains(point.on_head.vertex);
    };
    CHECK(holds(0, 85));
    CHECK(holds(0, 50));
    CHECK(holds(75, 10));
    CHECK(holds(-75, 10));
    CHECK(holds(180, -30));
    CHECK(!holds(0, 20));
    CHECK(!holds(45, -10));
    CHECK(!holds(95, -15));
    CHECK(!holds(180, -70));
}

TEST_CASE("a skull that is wider than its ellipse has hair above and behind the ears") {
    for (const char* file : {"ict_head.obj", "makehuman_head.obj", "sintel_head.obj"}) {
        const auto mesh = test::load_head(file);
        if (!mesh) return;
        const Scalp scalp(*mesh);
        for (const double side : {-1.0, 1.0}) {
            for (double azimuth = 98; azimuth <= 122; azimuth += 4) {
                CAPTURE(file);
                CAPTURE(side * azimuth);
                const ScalpPoint point = scalp.at({side * azimuth * kDegree, 12 * kDegree});
                CHECK(scalp.margin_at(point.on_head.triangle, point.on_head.barycentric,
                                      point.position) > 0.5);
            }
            const ScalpPoint ear = scalp.at({side * 95 * kDegree, -12 * kDegree});
            CHECK(scalp.margin_at(ear.on_head.triangle, ear.on_head.barycentric, ear.position) <=
                  0.0);
        }
    }
}

TEST_CASE("hair goes around what stands out of a skull below its widest place") {
    // An egg whose sides bulge as skulls do, with a knob in the place of an ear.
    Mesh mesh = egg();
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    const double width = 0.16;
    for (Vec3& p : positions) {
        const double azimuth = std::abs(std::atan2(p.x(), p.z()));
        const double out = std::exp(-std::pow((azimuth - 105 * kDegree) / (25 * kDegree), 2));
        const double knob = std::exp(-(std::pow((azimuth - 100 * kDegree) / (9 * kDegree), 2) +
                                       std::pow((p.y() + 0.02) / 0.015, 2)));
        p.x() += std::copysign(0.05 * width * out + 0.12 * width * knob, p.x());
    }
    mesh.set_positions(positions);
    ScalpOptions options = upright();
    const Scalp scalp(mesh, options);
    const auto margin = [&](double azimuth, double elevation) {
        const ScalpPoint point = scalp.at({azimuth * kDegree, elevation * kDegree});
        return scalp.margin_at(point.on_head.triangle, point.on_head.barycentric, point.position);
    };
    for (const double side : {-1.0, 1.0}) {
        CHECK(margin(side * 110, 10) > 0.0);
        CHECK(margin(side * 118, 5) > 0.0);
        CHECK(margin(side * 100, -10) <= 0.0);
    }
}

TEST_CASE("the generated head has the frame it was made with") {
    const Mesh head = make_head();
    const Scalp scalp(head);
    CHECK(!scalp.guessed());
    CHECK(scalp.frame().axes == Mat3::Identity());
    CHECK(scalp.frame().center.norm() < 0.01);
    CHECK(std::abs(scalp.scale() - 1.0) < 0.02);
    CHECK(scalp.unit() == 1.0);
    CHECK(std::abs(scalp.frame().length - 0.19) < 0.005);
}

TEST_CASE("a given region is kept, and hair thins out towards its outline") {
    Mesh mesh = egg();
    const Region top = select_plane(mesh, Vec3(0, 0.05, 0), Vec3::UnitY());
    ScalpOptions options = upright();
    options.softness = 0.02;
    mesh.set_region("scalp", top);
    for (const bool named : {true, false}) {
        if (!named) options.region = top.shrunk(1);
        const Scalp scalp(mesh, options);
        CHECK(!scalp.guessed());
        CHECK(scalp.region() == (named ? top : top.shrunk(1)));
        CHECK(scalp.root_faces() == scalp.region().faces());
        double least = 1.0;
        for (const Index v : scalp.region().vertices()) {
            least = std::min(least, scalp.margins()[v]);
            CHECK(scalp.margins()[v] >= 0.0);
        }
        CHECK(least == 0.0);
    }
}

TEST_CASE("roots may lie on all faces that reach into a guessed region, and on no others") {
    const Mesh mesh = egg();
    for (const double softness : {0.003, 0.02, 0.06}) {
        CAPTURE(softness);
        ScalpOptions options = upright();
        options.softness = softness;
        const Scalp scalp(mesh, options);
        REQUIRE(scalp.guessed());
        std::vector<Index> reaching;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const auto face = mesh.topology().face(f);
            const auto inside = [&](Index v) { return scalp.margins()[v] > 0.0; };
            if (std::any_of(face.begin(), face.end(), inside)) reaching.push_back(f);
        }
        CHECK(scalp.root_faces() == reaching);
    }
}

TEST_CASE("hair that is modelled on a head is doubted, and told") {
    Mesh bald = make_head({.vertices = 6000});
    REQUIRE(bald.remove_region("scalp"));
    CHECK(Scalp(bald).confidence() > 0.8);
    // Locks as furrows over the head.
    Mesh hairy = bald;
    for (Vec3& p : hairy.edit_positions()) {
        const double above = std::clamp((p.y() - 0.02) / 0.02, 0.0, 1.0);
        p *= 1.0 + 0.05 * above * std::sin(std::atan2(p.x(), p.z()) * 40.0);
    }
    const Scalp scalp(hairy);
    CHECK(scalp.confidence() < 0.5);
    CHECK(scalp.frame().doubt == "its hair seems to be modelled");
    CHECK(warning_of(hairy).find("take it off") != std::string::npos);
}

TEST_CASE("a higher hairline leaves a smaller scalp") {
    ScalpOptions high = upright(), low = upright();
    high.hairline = {{0.0, 60 * kDegree}};
    low.hairline = {{0.0, 20 * kDegree}};
    CHECK(Scalp(egg(), high).region().size() < Scalp(egg(), low).region().size());
}

TEST_CASE("a direction that is given is kept, whatever the other, unless they are parallel") {
    const Mesh mesh = egg();
    for (int k = 0; k <= 12; ++k) {
        // Fronts from straight up to straight down; up alone goes along.
        const double angle = kPi * k / 12.0;
        const Vec3 front(0.3 * std::sin(angle), std::cos(angle), 0.9 * std::sin(angle));
        HeadHints both{Vec3(0, 2, 0), front}, one{{}, front}, other{front, {}};
        if (k == 0 || k == 12) {
            CHECK(test::error_of([&] { guess_head_frame(mesh, both); }).code() ==
                  ErrorCode::invalid_argument);
        } else {
            const Mat3 axes = guess_head_frame(mesh, both).axes;
            CHECK((axes.col(1) - Vec3::UnitY()).norm() < 1e-12);
            CHECK(axes.col(2).dot(front) > 0.0);
            CHECK((axes.transpose() * axes - Mat3::Identity()).norm() < 1e-12);
        }
        for (const HeadHints& hints : {one, other}) {
            const Mat3 axes = guess_head_frame(mesh, hints).axes;
            CHECK((axes.col(hints.front ? 2 : 1) - front.normalized()).norm() < 1e-12);
            CHECK((axes.transpose() * axes - Mat3::Identity()).norm() < 1e-12);
        }
    }
}

TEST_CASE("scalps without sense are refused") {
    const Mesh mesh = egg();
    const auto code = [&](const auto& change) {
        ScalpOptions options = upright();
        change(options);
        return test::error_of([&] { Scalp(mesh, options); }).code();
    };
    const ErrorCode invalid = ErrorCode::invalid_argument;
    CHECK(code([](ScalpOptions& o) { o.unit = 0.0; }) == invalid);
    CHECK(code([](ScalpOptions& o) { o.softness = test::kNaN; }) == invalid);
    CHECK(code([](ScalpOptions& o) { o.hairline.clear(); }) == invalid);
    CHECK(code([](ScalpOptions& o) { o.hairline = {{1.0, 0.0}, {0.5, 0.0}}; }) == invalid);
    CHECK(code([](ScalpOptions& o) { o.hints.up = Vec3::Zero(); }) == invalid);
    CHECK(code([](ScalpOptions& o) { o.hints.up = -Vec3::UnitZ(); }) == invalid);
    CHECK(code([](ScalpOptions& o) { o.hints.front = Vec3(0, test::kNaN, 0); }) ==
          ErrorCode::not_finite);
    CHECK(code([](ScalpOptions& o) {
              o.hairline = {{0.0, 0.5 * kPi}};
          }) == ErrorCode::region_empty);
    CHECK(code([&](ScalpOptions& o) { o.region = Region::none(mesh.shared_topology()); }) ==
          ErrorCode::region_empty);
    CHECK(code([](ScalpOptions& o) { o.region = Region::all(egg().shared_topology()); }) ==
          ErrorCode::topology_mismatch);
    CHECK(test::error_of([] { Scalp{Mesh()}; }).code() == ErrorCode::mesh_empty);
    CHECK(test::error_of([] { Scalp{make_grid()}; }).code() == invalid);
    const Scalp scalp(mesh, upright());
    CHECK(test::error_of([&] { (void)scalp.at({test::kNaN, 0}); }).code() == ErrorCode::not_finite);
}

TEST_CASE("a direction without surface is an error that names it") {
    const Mesh whole = egg();
    const Mesh open = [&] {
        const Region low = select_plane(whole, Vec3(0, -0.05, 0), -Vec3::UnitY());
        std::vector<Vec3> positions(whole.positions().begin(), whole.positions().end());
        FaceList faces;
        for (Index f = 0; f < whole.face_count(); ++f) {
            const auto face = whole.topology().face(f);
            if (!low.contains(face[0])) faces.add(face);
        }
        return Mesh(std::move(positions), std::move(faces));
    }();
    const Scalp scalp(open, upright());
    const Error error = test::error_of([&] { (void)scalp.at({0.0, -0.5 * kPi}); });
    CHECK(error.code() == ErrorCode::out_of_range);
    CHECK(error.message().find("-90") != std::string::npos);
}
