#include <cstring>
#include <set>
#include <string>

#include "kernel/core/error.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

extern "C" int lissom_calls_from_c(void);

namespace lissom::test {

TEST_CASE("a program without the GPL module is under the MIT licence") {
    CHECK(std::string(lissom_licence()) == "MIT");
}

TEST_CASE("the header is C99") {
    CHECK(lissom_calls_from_c() == 4);
}

TEST_CASE("status codes are those of the kernel, in name and number") {
    int number = 0;
    for (const ErrorCode code : all_codes()) {
        const auto status = static_cast<lissom_status>(++number);
        CHECK(std::string(lissom_status_name(status)) == code_name(code));
        CHECK(std::string(lissom_status_explanation(status)) == code_explanation(code));
    }
    CHECK(number == LISSOM_INTERNAL);
    std::set<std::string> names;
    for (const auto status :
         {LISSOM_OK, LISSOM_INVALID_HANDLE, LISSOM_BUSY, LISSOM_BAD_STRUCT, LISSOM_SCRIPT_ERROR}) {
        names.insert(lissom_status_name(status));
    }
    CHECK(names.size() == 5);
    CHECK(std::string(lissom_status_name(static_cast<lissom_status>(77))) == "unknown");
}

TEST_CASE("handles that are zero, stale, foreign or of another kind are refused") {
    const Host host, other;
    const lissom_mesh mesh = host.add(make_box({}));
    CHECK(lissom_mesh_is_valid(host, mesh));
    CHECK_FALSE(lissom_mesh_is_valid(other, mesh));
    CHECK_FALSE(lissom_mesh_is_valid(host, {0}));
    CHECK_FALSE(lissom_region_is_valid(host, {mesh.id}));
    CHECK(lissom_mesh_vertex_count(other, mesh) == -1);
    CHECK(lissom_last_error(other)->status == LISSOM_INVALID_HANDLE);
    CHECK(lissom_mesh_release(host, mesh) == LISSOM_OK);
    CHECK(lissom_mesh_release(host, mesh) == LISSOM_INVALID_HANDLE);
    // The place is used again, and the old handle still names nothing.
    const lissom_mesh next = host.add(make_box({}));
    CHECK(next.id != mesh.id);
    CHECK_FALSE(lissom_mesh_is_valid(host, mesh));
    CHECK(lissom_mesh_is_valid(host, next));
    for (std::uint64_t id = 0; id < 5000; id += 7) CHECK_FALSE(lissom_mesh_is_valid(host, {id}));
    CHECK(lissom_mesh_vertex_count(nullptr, next) == -1);
    CHECK(lissom_mesh_release(nullptr, next) == LISSOM_INVALID_HANDLE);
    CHECK(lissom_last_error(nullptr)->status == LISSOM_INVALID_HANDLE);
}

TEST_CASE("a struct of options that was only cleared is refused") {
    const lissom_context_options cleared{};
    lissom_context* context = nullptr;
    CHECK(lissom_context_create(&cleared, &context) == LISSOM_BAD_STRUCT);
    CHECK(context == nullptr);
    auto lonely = lissom_default_context_options();
    lonely.wait = [](void*, void*) {};
    CHECK(lissom_context_create(&lonely, &context) == LISSOM_INVALID_ARGUMENT);
    auto none = lissom_default_context_options();
    none.threads = 0;
    CHECK(lissom_context_create(&none, &context) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_context_create(nullptr, &context) == LISSOM_OK);
    const lissom_mesh_load_options options{};
    lissom_mesh mesh{};
    CHECK(lissom_mesh_load(context, "a.obj", &options, &mesh) == LISSOM_BAD_STRUCT);
    lissom_context_destroy(context);
}

TEST_CASE("the log is told why there is no context") {
    std::string told;
    auto options = lissom_default_context_options();
    options.user = &told;
    options.log = [](void* user, lissom_log_level level, const char* message) {
        CHECK(level == LISSOM_WARNING);
        *static_cast<std::string*>(user) += message;
    };
    options.threads = 0;
    lissom_context* context = nullptr;
    CHECK(lissom_context_create(&options, &context) == LISSOM_INVALID_ARGUMENT);
    CHECK(told == "threads must be 1 or more");
    CHECK(context == nullptr);
}

TEST_CASE("options of a later header are taken where they ask for nothing new") {
    const Host host;
    struct Later {
        lissom_cut_options now;
        double later;
    } options{lissom_default_cut_options(), 0.0};
    options.now.struct_size = sizeof options;
    const lissom_mesh mesh = host.add(make_box({.segments = {4, 4, 4}}));
    const double point[] = {0, 0, 0}, normal[] = {0, 1, 0};
    lissom_mesh kept{};
    CHECK(lissom_cut_by_plane(host, mesh, point, normal, &options.now, &kept, nullptr) ==
          LISSOM_OK);
    options.later = 1.0;
    CHECK(lissom_cut_by_plane(host, mesh, point, normal, &options.now, &kept, nullptr) ==
          LISSOM_BAD_STRUCT);
}

TEST_CASE("errors name status, code, message and elements, until the next call") {
    const Host host;
    const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::uint32_t corners[] = {0, 1, 7};
    const lissom_input points{positions, 3, 0, LISSOM_FLOAT64};
    const lissom_input faces{corners, 3, 0, LISSOM_UINT32};
    lissom_mesh mesh{};
    CHECK(lissom_mesh_create(host, &points, &faces, nullptr, &mesh) == LISSOM_FACE_INDEX);
    const lissom_error* error = lissom_last_error(host);
    CHECK(error->status == LISSOM_FACE_INDEX);
    CHECK(std::string(error->code) == "face_index");
    CHECK(std::strlen(error->message) > 10);
    CHECK(error->element == LISSOM_FACE);
    REQUIRE(error->id_count == 1);
    CHECK(error->ids[0] == 0);
    CHECK(mesh.id == 0);
    CHECK(lissom_mesh_create(host, nullptr, &faces, nullptr, &mesh) == LISSOM_INVALID_ARGUMENT);
    CHECK(host.message() == "positions is NULL");
    CHECK(lissom_mesh_load(host, "/nowhere/a.obj", nullptr, &mesh) == LISSOM_FILE_NOT_FOUND);
    CHECK(lissom_object_count(host) == 0);
}

TEST_CASE("memory of objects is counted, limited, and free after release") {
    auto options = lissom_default_context_options();
    options.memory_limit = 2'000'000;
    const Host host(options);
    const lissom_mesh small = host.add(make_box({}));
    const std::size_t used = lissom_memory_used(host);
    CHECK(used > 0);
    const Mesh large = make_box({.segments = {60, 60, 60}});
    const lissom_input points{large.positions().data(), large.positions().size(), 0,
                              LISSOM_FLOAT64};
    std::vector<Index> corners;
    for (Index f = 0; f < large.face_count(); ++f) {
        for (const Index v : large.topology().face(f)) corners.push_back(v);
    }
    const std::vector<Index> sizes(at(large.face_count()), 4);
    const lissom_input c{corners.data(), corners.size(), 0, LISSOM_INT32};
    const lissom_input s{sizes.data(), sizes.size(), 0, LISSOM_INT32};
    lissom_mesh mesh{};
    CHECK(lissom_mesh_create(host, &points, &c, &s, &mesh) == LISSOM_MEMORY_LIMIT);
    CHECK(mesh.id == 0);
    CHECK(lissom_memory_used(host) == used);
    CHECK(lissom_mesh_release(host, small) == LISSOM_OK);
    CHECK(lissom_memory_used(host) == 0);
}

TEST_CASE("a cancel lasts until it is cleared, and changes nothing") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({.segments = {8, 8, 8}}));
    const std::uint64_t before = host.hash(mesh);
    const double point[] = {0, 0, 0}, normal[] = {0, 1, 0};
    lissom_mesh kept{};
    lissom_cancel(host);
    CHECK(lissom_cut_by_plane(host, mesh, point, normal, nullptr, &kept, nullptr) ==
          LISSOM_CANCELLED);
    CHECK(kept.id == 0);
    lissom_clear_cancel(host);
    CHECK(lissom_cut_by_plane(host, mesh, point, normal, nullptr, &kept, nullptr) == LISSOM_OK);
    CHECK(host.hash(mesh) == before);
}

}  // namespace lissom::test
