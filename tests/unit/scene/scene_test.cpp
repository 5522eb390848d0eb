#include "kernel/scene/scene.h"

#include <doctest/doctest.h>

#include <functional>
#include <random>

#include "kernel/core/error.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/scene/mesh_item.h"
#include "tests/unit/support.h"

using namespace lissom;
using lissom::test::error_of;

namespace {

std::shared_ptr<MeshItem> item_of(const std::shared_ptr<Mesh>& mesh) {
    return std::make_shared<MeshItem>(mesh);
}

std::shared_ptr<Mesh> shared_bar() {
    return std::make_shared<Mesh>(make_bar());
}

void shift(Mesh& mesh, double by) {
    transform(mesh, translation(Vec3(by, 0.0, 0.0)));
}

std::vector<std::string> names(const Scene& scene) {
    std::vector<std::string> list;
    for (const auto& object : scene.objects()) list.push_back(object->name);
    return list;
}

}  // namespace

TEST_CASE("scene: undo puts content back into the live object") {
    Scene scene;
    const auto bar = shared_bar();
    scene.add("bar", item_of(bar));
    const std::uint64_t rest = hash(*bar);
    const auto topology = bar->shared_topology();
    scene.step("shift", [&] { shift(*bar, 1.0); });
    const std::uint64_t shifted = hash(*bar);
    scene.step("subdivide", [&] { bar->replace_by(subdivide(*bar, {})); });

    CHECK(scene.undo() == "subdivide");
    CHECK(hash(*bar) == shifted);
    CHECK(bar->shared_topology() == topology);
    CHECK(scene.undo() == "shift");
    CHECK(hash(*bar) == rest);
    CHECK(scene.redo() == "shift");
    CHECK(hash(*bar) == shifted);
    CHECK(scene.undo() == "shift");
    CHECK(scene.undo() == "add bar");
    CHECK(scene.objects().empty());
    CHECK(scene.undo() == std::nullopt);
}

TEST_CASE("scene: a new step drops what could be done again") {
    Scene scene;
    const auto bar = shared_bar();
    scene.add("bar", item_of(bar));
    scene.step("one", [&] { shift(*bar, 1.0); });
    scene.undo();
    scene.step("two", [&] { shift(*bar, 2.0); });
    CHECK(scene.redo() == std::nullopt);
    CHECK(scene.history().steps.size() == 2);
}

TEST_CASE("scene: a step without changes is none") {
    Scene scene;
    const auto bar = shared_bar();
    const ObjectId id = scene.add("bar", item_of(bar));
    scene.step("one", [&] { shift(*bar, 1.0); });
    scene.undo();
    scene.step("nothing", [&] { bar->edit_positions(); });
    scene.set_look(id, scene.object(id).look);
    scene.rename(id, "bar");
    CHECK(scene.redo() == "one");
}

TEST_CASE("scene: after an error in a step everything is as before") {
    Scene scene;
    const auto bar = shared_bar();
    const ObjectId id = scene.add("bar", item_of(bar));
    const std::uint64_t before = scene.hash();
    const auto fail = [&] {
        scene.step("fail", [&] {
            triangulate(*bar);
            shift(*bar, 1.0);
            scene.add("other", item_of(shared_bar()));
            scene.rename(id, "renamed");
            scene.remove(id);
            throw Error(ErrorCode::unsupported, "no");
        });
    };
    CHECK(error_of(fail).code() == ErrorCode::unsupported);
    CHECK(scene.hash() == before);
    CHECK(scene.depth() == 0);
    CHECK(scene.history().steps.size() == 1);
}

TEST_CASE("scene: what was changed outside a step is a step of its own") {
    Scene scene;
    const auto bar = shared_bar();
    scene.add("bar", item_of(bar));
    const std::uint64_t rest = hash(*bar);

    SUBCASE("found by the next step") {
        shift(*bar, 1.0);
        const std::uint64_t shifted = hash(*bar);
        scene.step("two", [&] { shift(*bar, 2.0); });
        CHECK(scene.undo() == "two");
        CHECK(hash(*bar) == shifted);
    }
    SUBCASE("found by undo") {
        shift(*bar, 1.0);
    }
    SUBCASE("found by the hash") {
        const std::uint64_t before = scene.hash();
        shift(*bar, 1.0);
        CHECK(scene.hash() != before);
    }
    SUBCASE("found by redo, which then has nothing to do") {
        scene.step("two", [&] { shift(*bar, 2.0); });
        scene.undo();
        shift(*bar, 1.0);
        CHECK(scene.redo() == std::nullopt);
    }
    SUBCASE("values of an attribute, which no revision counts") {
        bar->attributes().add({"heat", Domain::vertex, 1, ScalarType::float64,
                               std::vector<double>(at(bar->vertex_count()), 0.0)});
        scene.step("two", [] {});
        bar->attributes().find("heat")->values[0] = 1.0;
        CHECK(scene.undo() == Scene::kEdited);
        CHECK(bar->attributes().find("heat")->values[0] == 0.0);
    }
    CHECK(scene.undo() == Scene::kEdited);
    CHECK(hash(*bar) == rest);
}

TEST_CASE("scene: steps nest into the outermost, and each can be rolled back") {
    Scene scene;
    const auto bar = shared_bar();
    scene.add("bar", item_of(bar));
    const std::uint64_t rest = scene.hash();
    scene.begin("outer");
    shift(*bar, 1.0);
    const std::uint64_t one = hash(*bar);
    scene.begin("inner");
    shift(*bar, 2.0);
    scene.rollback();
    CHECK(hash(*bar) == one);
    scene.begin("inner again");
    shift(*bar, 4.0);
    CHECK(scene.commit());
    CHECK(scene.hash() != rest);
    CHECK(scene.commit());
    const std::uint64_t done = scene.hash();
    CHECK(scene.history().steps.size() == 2);
    CHECK(scene.undo() == "outer");
    CHECK(scene.hash() == rest);
    CHECK(scene.redo() == "outer");
    CHECK(scene.hash() == done);
}

TEST_CASE("scene: what cannot be done in a step, or without one") {
    Scene scene;
    CHECK(error_of([&] { scene.commit(); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { scene.rollback(); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { scene.begin(""); }).code() == ErrorCode::invalid_argument);
    scene.begin("open");
    CHECK(error_of([&] { scene.undo(); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { scene.redo(); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { scene.clear_history(); }).code() == ErrorCode::invalid_argument);
    CHECK(scene.depth() == 1);
}

TEST_CASE("scene: names, order and looks") {
    Scene scene;
    const ObjectId a = scene.add("a", item_of(shared_bar()));
    const ObjectId b = scene.add("b", item_of(shared_bar()));
    const ObjectId c = scene.add("c", item_of(shared_bar()));
    const std::uint64_t first = scene.hash();
    const auto code = [](const std::function<void()>& action) { return error_of(action).code(); };
    CHECK(code([&] { scene.add("a", item_of(shared_bar())); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { scene.add("", item_of(shared_bar())); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { scene.rename(b, "a"); }) == ErrorCode::invalid_argument);
    CHECK(code([&] { scene.reorder(b, 3); }) == ErrorCode::out_of_range);
    CHECK(code([&] { scene.remove({17}); }) == ErrorCode::out_of_range);
    CHECK(code([&] {
              ObjectLook flat;
              flat.transform.linear.setZero();
              scene.set_look(a, flat);
          }) == ErrorCode::singular_transform);
    CHECK(code([&] { scene.set_look(a, {.style = {.level = 0.0}}); }) ==
          ErrorCode::invalid_argument);
    CHECK(code([&] { scene.set_look(a, {.style = {.color = Vec3(0, 0, 2)}}); }) ==
          ErrorCode::invalid_argument);
    CHECK(scene.hash() == first);

    scene.reorder(c, 0);
    CHECK(names(scene) == std::vector<std::string>{"c", "a", "b"});
    scene.reorder(c, 1);
    CHECK(names(scene) == std::vector<std::string>{"a", "c", "b"});
    scene.rename(b, "d");
    CHECK(scene.find("d")->id == b);
    CHECK(scene.find("b") == nullptr);
    scene.remove(a);
    CHECK(names(scene) == std::vector<std::string>{"c", "d"});
    const ObjectId e = scene.add("e", item_of(shared_bar()));
    CHECK(!(e == a));
    for (int i = 0; i < 5; ++i) CHECK(scene.undo());
    CHECK(scene.hash() == first);
    CHECK(scene.object(a).name == "a");
}

TEST_CASE("scene: the hash tells names, order, looks, kinds of sharing and contents") {
    const auto made = [](const std::function<void(Scene&, ObjectId, ObjectId)>& change) {
        Scene scene;
        const auto bar = shared_bar();
        const ObjectId a = scene.add("a", item_of(bar));
        const ObjectId b = scene.add("b", item_of(std::make_shared<Mesh>(*bar)));
        change(scene, a, b);
        return scene.hash();
    };
    const std::uint64_t plain = made([](Scene&, ObjectId, ObjectId) {});
    CHECK(plain == made([](Scene& scene, ObjectId a, ObjectId b) {
              scene.remove(a);
              scene.rename(b, "c");
              scene.undo();
              scene.undo();
          }));
    const std::vector<std::uint64_t> others = {
        made([](Scene& scene, ObjectId a, ObjectId) { scene.rename(a, "c"); }),
        made([](Scene& scene, ObjectId a, ObjectId) { scene.reorder(a, 1); }),
        made([](Scene& scene, ObjectId a, ObjectId) { scene.remove(a); }),
        made([](Scene& scene, ObjectId a, ObjectId) { scene.set_look(a, {.visible = false}); }),
        made([](Scene& scene, ObjectId a, ObjectId) {
            scene.set_look(a, {.transform = translation(Vec3(1, 0, 0))});
        }),
        made([](Scene& scene, ObjectId a, ObjectId) {
            scene.set_look(a, {.style = {.wire = true}});
        }),
        made([](Scene& scene, ObjectId, ObjectId b) {
            const auto shared = scene.find("a")->item;
            scene.remove(b);
            scene.add("b", shared);
        }),
        made([](Scene& scene, ObjectId a, ObjectId) {
            scene.remove(a);
            const auto moved = shared_bar();
            shift(*moved, 1e-12);
            scene.reorder(scene.add("a", item_of(moved)), 0);
        })};
    for (std::size_t i = 0; i < others.size(); ++i) {
        CHECK(others[i] != plain);
        for (std::size_t j = 0; j < i; ++j) CHECK(others[i] != others[j]);
    }
}

TEST_CASE("scene: two objects of one mesh are captured once and undone together") {
    Scene scene;
    const auto bar = shared_bar();
    scene.add("left", item_of(bar));
    scene.add("right", item_of(bar), {.transform = translation(Vec3(3, 0, 0))});
    CHECK(scene.state()->items.size() == 1);
    const std::uint64_t before = scene.hash();
    scene.step("shift", [&] { shift(*bar, 1.0); });
    scene.undo();
    CHECK(scene.hash() == before);
}

TEST_CASE("scene: a removed object comes back as it was, whatever was done to it meanwhile") {
    Scene scene;
    const auto bar = shared_bar();
    const ObjectId id = scene.add("bar", item_of(bar));
    const std::uint64_t before = scene.hash();
    scene.remove(id);
    bar->replace_by(subdivide(*bar, {}));
    CHECK(scene.undo() == "remove bar");
    CHECK(scene.hash() == before);
    CHECK(scene.redo() == "remove bar");
    CHECK(scene.undo() == "remove bar");
    CHECK(scene.hash() == before);
}

TEST_CASE("scene: a drag of an eighth costs an eighth") {
    Scene scene;
    const auto grid = std::make_shared<Mesh>(make_grid({.segments = {255, 255}}));
    scene.add("grid", item_of(grid));
    const std::size_t whole = std::size_t(grid->vertex_count()) * sizeof(Vec3);
    scene.step("drag", [&] {
        const auto positions = grid->edit_positions();
        for (std::size_t v = 0; v < positions.size() / 8; ++v) positions[v].z() += 0.1;
    });
    CHECK(scene.history().steps.back().bytes <= whole / 8 + SharedBlocks::kBlockBytes);
    CHECK(scene.history().steps.back().bytes >= whole / 8);
}

TEST_CASE("scene: the memory of the history is bounded, and what went is told") {
    const auto grid = std::make_shared<Mesh>(make_grid({.segments = {99, 99}}));
    const std::size_t whole = std::size_t(grid->vertex_count()) * sizeof(Vec3);
    Scene scene({.history_bytes = 10 * whole + 1});
    scene.add("grid", item_of(grid));
    const std::uint64_t first = scene.hash();
    for (int i = 1; i <= 25; ++i) {
        scene.step("shift " + std::to_string(i), [&] { shift(*grid, 1.0); });
        CHECK(scene.history().bytes <= scene.history().limit);
    }
    const HistoryReport report = scene.history();
    CHECK(report.steps.size() == 10);
    CHECK(report.dropped == 16);
    CHECK(report.place == 10);
    CHECK(report.steps.front().name == "shift 16");
    CHECK(report.bytes == 10 * whole);
    for (int i = 0; i < 10; ++i) CHECK(scene.undo());
    CHECK(!scene.undo());
    CHECK(scene.hash() != first);
    scene.clear_history();
    CHECK(scene.history().bytes == 0);
    CHECK(scene.history().dropped == 16);
}

TEST_CASE("scene: a history without memory keeps no step, and steps are still rolled back") {
    Scene scene({.history_bytes = 0});
    const auto bar = shared_bar();
    scene.add("bar", item_of(bar));
    scene.step("shift", [&] { shift(*bar, 1.0); });
    CHECK(scene.history().steps.empty());
    CHECK(scene.undo() == std::nullopt);
    const std::uint64_t before = scene.hash();
    scene.begin("drag");
    shift(*bar, 1.0);
    scene.rollback();
    CHECK(scene.hash() == before);
}

TEST_CASE("scene: texts are on its account for as long as it keeps them") {
    const auto account = std::make_shared<MemoryAccount>(0);
    const std::string text(1'000'000, 't');
    {
        Scene scene({.account = account});
        const ObjectId id = scene.add("bar", item_of(shared_bar()));
        const std::size_t before = account->used();
        scene.set_parameters("tool", {{"a", text}});
        CHECK(account->used() >= before + text.size());
        scene.set_parameters("tool", {});
        CHECK(account->used() == before);
        scene.begin(text);
        CHECK(account->used() >= before + text.size());
        CHECK_FALSE(scene.commit());
        CHECK(account->used() < before + text.size());
        ObjectLook look;
        look.style.region = text;
        scene.set_look(id, look);
        scene.set_look(id, {});
        CHECK(account->used() >= before + text.size());
        scene.clear_history();
        CHECK(account->used() < before + text.size());
    }
    CHECK(account->used() == 0);
}

TEST_CASE("scene: what two meshes share counts once") {
    Scene scene;
    const auto bar = shared_bar();
    const auto copy = std::make_shared<Mesh>(*bar);
    scene.add("bar", item_of(bar));
    scene.add("copy", item_of(copy));
    scene.step("shift", [&] { shift(*copy, 1.0); });
    CHECK(scene.history().bytes == copy->positions().size_bytes());
    CHECK(scene.history().place == 3);
}

TEST_CASE("scene: old topologies and removed objects count in the memory of the history") {
    Scene scene;
    const auto bar = std::make_shared<Mesh>(subdivide(make_bar(), {.levels = 2}));
    const ObjectId id = scene.add("bar", item_of(bar));
    CHECK(scene.history().bytes < bar->topology().memory_bytes());
    const std::size_t old = bar->topology().memory_bytes();
    scene.step("replace", [&] { bar->replace_by(make_bar()); });
    CHECK(scene.history().bytes > old);
    scene.clear_history();
    CHECK(scene.history().bytes == 0);
    scene.remove(id);
    CHECK(scene.history().bytes >= bar->memory_bytes());
}

namespace {

// A scene with random edits, some of them outside steps.
struct RandomEdits {
    Scene scene;
    std::vector<std::shared_ptr<Mesh>> meshes;
    std::mt19937 random{20260101};
    int made = 0;

    int pick(std::size_t count) { return int(random() % count); }

    void edit() {
        const int action = pick(12);
        if (scene.objects().size() < 2 || action == 0) return add();
        const auto& object = scene.objects()[at(pick(scene.objects().size()))];
        const auto item = std::dynamic_pointer_cast<MeshItem>(object->item);
        Mesh& mesh = const_cast<Mesh&>(item->mesh());
        if (action == 1 && scene.objects().size() > 3) return scene.remove(object->id);
        if (action == 2) return scene.rename(object->id, "object " + std::to_string(++made));
        if (action == 3) return scene.reorder(object->id, pick(scene.objects().size()));
        if (action == 4) return look(object->id);
        if (action == 5) return shift(mesh, 0.5);
        scene.step("step " + std::to_string(action), [&] { change(mesh, action); });
    }

    void add() {
        meshes.push_back(shared_bar());
        scene.add("object " + std::to_string(++made), item_of(meshes.back()));
    }
    void look(ObjectId id) {
        scene.set_look(id, {.transform = translation(Vec3(made++, 0, 0)),
                            .visible = pick(2) == 0,
                            .style = {.wire = pick(2) == 0}});
    }
    void change(Mesh& mesh, int action) {
        if (action == 6) triangulate(mesh);
        if (action == 7 && mesh.vertex_count() < 2000) mesh.replace_by(subdivide(mesh, {}));
        if (action == 8) mesh.replace_by(make_bar());
        if (action == 9) mesh.set_region("part", Region(mesh.shared_topology(), {pick(8)}));
        if (action >= 10) mesh.edit_positions()[at(pick(8))].y() += 0.25;
    }
};

}  // namespace

TEST_CASE("scene: a thousand random edits, undone to the start and done again to the end") {
    RandomEdits edits;
    Scene& scene = edits.scene;
    std::vector<std::uint64_t> hashes{scene.hash()};
    for (int i = 0; i < 1000; ++i) {
        edits.edit();
        const std::uint64_t now = scene.hash();
        // An edit outside a step before one inside gives two steps.
        while (hashes.size() < scene.history().place) hashes.push_back(0);
        if (hashes.size() == scene.history().place) hashes.push_back(now);
    }
    const std::size_t bytes = scene.history().bytes;
    CHECK(scene.history().steps.size() + 1 == hashes.size());
    for (int round = 0; round < 2; ++round) {
        for (std::size_t i = hashes.size(); --i > 0;) {
            REQUIRE(scene.undo());
            if (hashes[i - 1] != 0) REQUIRE(scene.hash() == hashes[i - 1]);
        }
        CHECK(scene.undo() == std::nullopt);
        for (std::size_t i = 1; i < hashes.size(); ++i) {
            REQUIRE(scene.redo());
            if (hashes[i] != 0) REQUIRE(scene.hash() == hashes[i]);
        }
        CHECK(scene.redo() == std::nullopt);
        CHECK(scene.history().bytes == bytes);
    }
}
