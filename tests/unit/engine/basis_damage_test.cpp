// Damaged bases: the evaluator and the kernel's reader agree on what they are, and stay inside
// them.
#include <cstring>
#include <memory>
#include <random>

#include "kernel/io/stream/file.h"
#include "tests/unit/engine/basis_scene.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A copy that ends where its memory does, so that a sanitizer sees any step beyond.
struct Block {
    explicit Block(const std::string& bytes)
        : size(bytes.size()), memory(new std::uint32_t[bytes.size() / 4 + 1]) {
        start = reinterpret_cast<char*>(memory.get()) + (size % 4 == 0 ? 4 : 0);
        std::memcpy(start, bytes.data(), size);
    }
    std::size_t size;
    std::unique_ptr<std::uint32_t[]> memory;
    char* start;
};

// Opens and uses the bytes; whether they were a basis.
bool is_basis(const std::string& bytes) {
    const Block block(bytes);
    lissom_basis basis;
    if (lissom_basis_open(&basis, block.start, block.size) != LISSOM_BASIS_OK) return false;
    std::vector<float> transforms(12 * std::size_t{basis.handle_count}, 0.5f);
    std::vector<float> out(3 * std::size_t{basis.vertex_count});
    lissom_basis_evaluate(&basis, transforms.data(), 0, basis.vertex_count, out.data(), 12);
    if (basis.mesh_vertex_count < 1000000) {
        out.resize(3 * std::size_t{basis.mesh_vertex_count});
        lissom_basis_scatter(&basis, transforms.data(), 0, basis.vertex_count, out.data(), 12);
    }
    lissom_basis_find_handle(&basis, "no such name");
    return true;
}

// Whether the kernel reads the bytes; any error must be one that tells what is wrong.
bool is_read(const std::string& bytes) {
    try {
        decode_basis(bytes);
        return true;
    } catch (const Error& error) {
        const bool expected =
            error.code() == ErrorCode::file_syntax || error.code() == ErrorCode::file_truncated ||
            error.code() == ErrorCode::not_finite || error.code() == ErrorCode::unsupported;
        CHECK_MESSAGE(expected, code_name(error.code()) << ": " << error.message());
        return false;
    }
}

std::string small_basis() {
    BasisScene scene = make_basis_scene(make_bar({.across = 2, .along = 6}), 2);
    return encode_basis(
        make_engine_basis(scene.deformer, std::vector<std::string>{"one", "another"}));
}

}  // namespace

TEST_CASE("a basis that is cut short anywhere is refused") {
    const std::string good = small_basis();
    REQUIRE(is_basis(good));
    REQUIRE(is_read(good));
    for (std::size_t size = 0; size < good.size(); size += 1 + size / 100) {
        CAPTURE(size);
        CHECK_FALSE(is_basis(good.substr(0, size)));
        CHECK_FALSE(is_read(good.substr(0, size)));
    }
}

TEST_CASE("a basis with damaged bytes is refused by both readers or by none") {
    const std::string good = small_basis();
    std::mt19937 random(11);
    int refused = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string bytes = good;
        for (unsigned change = 0; change <= random() % 3; ++change) {
            // Every other time in the header and the names of the handles.
            const std::size_t range = random() % 2 ? bytes.size() : 100;
            const std::size_t at = random() % range;
            if (random() % 4 == 0) {
                bytes[at] = static_cast<char>(random() % 2 ? 0xff : 0x7f);
            } else {
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
            }
        }
        CAPTURE(i);
        const bool read = is_read(bytes);
        CHECK(is_basis(bytes) == read);
        refused += read ? 0 : 1;
    }
    CHECK(refused > 1000);
}

TEST_CASE("a last name without an end is refused") {
    std::string bytes = small_basis();
    bytes.back() = 'x';
    CHECK_FALSE(is_basis(bytes));
    CHECK_FALSE(is_read(bytes));
}

TEST_CASE("headers with sizes near the limits are refused") {
    const std::string good = small_basis();
    for (const std::uint32_t handles : {0u, 1u, 0x10000u, 0x7fffffffu, 0xffffffffu}) {
        for (const std::uint32_t vertices : {0u, 1u, 0x10000u, 0x80000000u, 0xffffffffu}) {
            for (const std::uint64_t total : {std::uint64_t{64}, std::uint64_t{good.size()},
                                              std::uint64_t{1} << 36, ~std::uint64_t{0}}) {
                std::string bytes = good;
                std::memcpy(bytes.data() + 12, &handles, 4);
                std::memcpy(bytes.data() + 16, &vertices, 4);
                std::memcpy(bytes.data() + 56, &total, 8);
                CAPTURE(handles);
                CAPTURE(vertices);
                CHECK_FALSE(is_basis(bytes));
                CHECK_FALSE(is_read(bytes));
            }
        }
    }
}

TEST_CASE("noise is refused") {
    std::mt19937 random(12);
    for (int i = 0; i < 500; ++i) {
        std::string bytes(random() % 300, '\0');
        for (char& c : bytes) c = static_cast<char>(random());
        if (i % 2 == 0) bytes.insert(0, "LSMBASIS\1\0\0\0", 12);
        CHECK_FALSE(is_basis(bytes));
        CHECK_FALSE(is_read(bytes));
    }
}

TEST_CASE("a basis file holds what was saved") {
    BasisScene scene = make_basis_scene(make_cactus(), 2, true);
    const TemporaryFolder folder;
    const EngineBasis saved = make_engine_basis(scene.deformer, std::vector<std::string>{"a", "b"});
    save_basis(saved, folder / "a.basis");
    const EngineBasis read = load_basis(folder / "a.basis");
    CHECK(read.origin == saved.origin);
    CHECK(read.size == saved.size);
    CHECK(read.mesh_vertex_count == scene.mesh.vertex_count());
    CHECK(read.vertices == saved.vertices);
    CHECK(read.rest == saved.rest);
    CHECK(read.weights == saved.weights);
    CHECK(read.handles[1].name == "b");
    CHECK(read.handles[1].center == saved.handles[1].center);
    const std::vector<Vec3> there = read.positions(scene.transforms);
    double greatest = 0.0;
    const std::vector<Vec3>& wanted = scene.deformer.solve(FrameQuality::preview);
    for (std::size_t i = 0; i < there.size(); ++i) {
        greatest = std::max(greatest, (there[i] - wanted[i]).norm());
    }
    CHECK(greatest < 1e-6 * scene.size);
}

TEST_CASE("bases that cannot be saved or found say why") {
    const TemporaryFolder folder;
    BasisScene scene = make_basis_scene(make_bar({.across = 2, .along = 6}), 2);
    EngineBasis basis = make_engine_basis(scene.deformer);
    CHECK(error_of([&] { basis.positions({}); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { load_basis(folder / "no.basis"); }).code() == ErrorCode::file_not_found);
    write_bytes(folder / "bad.basis", "v 0 0 0");
    const Error bad = error_of([&] { load_basis(folder / "bad.basis"); });
    CHECK(bad.code() == ErrorCode::file_syntax);
    CHECK(bad.message().find("bad.basis") != std::string::npos);
    const std::vector<std::string> three(3, "x"), zero{std::string("a\0b", 3)};
    CHECK(error_of([&] { make_engine_basis(scene.deformer, three); }).code() ==
          ErrorCode::invalid_argument);
    basis.handles[0].name = zero[0];
    CHECK(error_of([&] { encode_basis(basis); }).code() == ErrorCode::invalid_argument);
    basis.handles[0].name = "";
    basis.weights.pop_back();
    CHECK(error_of([&] { encode_basis(basis); }).code() == ErrorCode::invalid_argument);
    Mesh giant = scene.mesh;
    for (Vec3& p : giant.edit_positions()) p *= 1e39;
    CHECK(error_of([&] {
              Deformer edit(giant, Region::all(giant.shared_topology()));
              edit.add_handle(slab(giant, 0, 1));
              make_engine_basis(edit);
          }).code() == ErrorCode::not_finite);
}
