// Memory on the account: what operations take is charged, limits hold, and nothing is left.
#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "kernel/core/error.h"
#include "kernel/deform/deformer.h"
#include "kernel/io/mesh_file.h"
#include "kernel/merge/merge.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/limits/counted_heap.h"
#include "tests/unit/limits/operations.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Context limited(std::size_t bytes) {
    ContextOptions options;
    options.memory_limit = bytes;
    return Context(std::move(options));
}

struct Memory {
    std::size_t heap_peak, heap_kept, peak, kept;
    std::uint64_t hash;
};

// What an operation takes, by the heap and by the account; nothing is on the account afterwards.
Memory memory_of(const Operation& operation) {
    operation.run(Context());  // what is made once and for all is there
    const Context context;
    const std::size_t before = heap_used();
    begin_heap_peak();
    Memory memory{};
    {
        const Made made = operation.run(context);
        memory = {heap_peak() - before, heap_used() - before, context.memory()->peak(),
                  context.memory()->used(), made.hash};
    }
    CHECK(context.memory()->used() == 0);
    return memory;
}

void show(const Operation& operation, const Memory& memory) {
    if (!std::getenv("LISSOM_SHOW_MEMORY")) return;
    constexpr double kMega = 1e6;
    std::printf("| %s | %.1f | %.1f | %.2f | %.1f | %.1f |\n", operation.name,
                memory.heap_peak / kMega, memory.peak / kMega,
                static_cast<double>(memory.peak) / memory.heap_peak, memory.heap_kept / kMega,
                memory.kept / kMega);
}

}  // namespace

TEST_CASE("memory: what operations take, and what they leave, is on the account") {
    // Of what no input scales.
    constexpr double kSmall = 300e3;
    for (const Operation& operation : operations()) {
        CAPTURE(operation.name);
        const Memory memory = memory_of(operation);
        show(operation, memory);
        CHECK(memory.peak + kSmall >= operation.min_peak * memory.heap_peak);
        CHECK(memory.peak <= operation.max_peak * memory.heap_peak + kSmall);
        CHECK(memory.kept + kSmall >= operation.min_kept * memory.heap_kept);
    }
}

TEST_CASE("memory: under any limit an operation makes the same, or gives the typed error") {
    // The fast suite takes every third share, other ones for the next operation; LISSOM_TRIALS all.
    const std::size_t step = std::getenv("LISSOM_TRIALS") ? 1 : 3;
    std::size_t number = 0;
    for (const Operation& operation : operations()) {
        CAPTURE(operation.name);
        const Context free;
        const std::uint64_t wanted = operation.run(free).hash;
        const std::size_t peak = free.memory()->peak();
        CHECK(operation.run(limited(peak)).hash == wanted);
        constexpr std::array kShares{0.97, 0.8, 0.6, 0.4, 0.2, 0.05};
        for (std::size_t i = number++ % step; i < kShares.size(); i += step) {
            const double share = kShares[i];
            CAPTURE(share);
            const Context context = limited(static_cast<std::size_t>(share * peak));
            // As what is made is gone before the account is looked at.
            const auto outcome = [&]() -> std::optional<ErrorCode> {
                try {
                    const std::uint64_t hash = operation.run(context).hash;
                    CHECK(hash == wanted);
                    return std::nullopt;
                } catch (const Error& error) {
                    return error.code();
                }
            }();
            if (outcome) CHECK(*outcome == ErrorCode::memory_limit);
            CHECK(context.memory()->used() == 0);
            if (operation.overdraws) continue;
            CHECK(context.memory()->peak() <= context.memory()->limit());
        }
    }
}

namespace {

// What a user does to a document, one after the other, each as a whole or not at all.
struct Document {
    explicit Document(const Context& given) : context(given), mesh(make_bar({}, given)) {}

    void run(int step) {
        switch (step) {
            case 0:
                return mesh.replace_by(subdivide(mesh, {.levels = 2}, context));
            case 1: {
                Deformer edit(mesh, Region::all(mesh.shared_topology()), {}, context);
                const HandleId top = edit.add_handle(*mesh.find_region("top"));
                edit.set_transform(top, Affine{Mat3::Identity(), Vec3::UnitY()});
                edit.solve();
                return edit.apply_to(mesh);
            }
            case 2:
                return transform(mesh, Affine{Mat3::Identity(), Vec3::UnitX()}, context);
            case 3:
                append(mesh, make_sphere({}, context), context);
                return;
            default: {
                Attribute more{"more", Domain::vertex, 9, ScalarType::float32, {}};
                more.values.resize(9 * at(mesh.vertex_count()));
                mesh.attributes().add(std::move(more));
            }
        }
    }
    static constexpr int kSteps = 5;

    Context context;
    Mesh mesh;
};

}  // namespace

TEST_CASE("memory: a document is as before wherever a limit stops what is done to it") {
    const Context free;
    {
        Document document(free);
        for (int step = 0; step < Document::kSteps; ++step) document.run(step);
    }
    int refused = 0;
    for (double share = 1.0; share > 0.04; share *= 0.9) {
        const Context context = limited(static_cast<std::size_t>(share * free.memory()->peak()));
        {
            Document document(context);
            for (int step = 0; step < Document::kSteps; ++step) {
                CAPTURE(share);
                CAPTURE(step);
                const std::uint64_t before = hash(document.mesh);
                const std::size_t used = context.memory()->used();
                try {
                    document.run(step);
                } catch (const Error& error) {
                    ++refused;
                    CHECK(error.code() == ErrorCode::memory_limit);
                    CHECK(hash(document.mesh) == before);
                    CHECK(context.memory()->used() == used);
                }
            }
        }
        CHECK(context.memory()->used() == 0);
    }
    CHECK(refused > 20);
}

TEST_CASE("memory: a mesh counts all it holds, and a topology once") {
    const Context context;
    Mesh bar = make_bar({}, context);
    CHECK(context.memory()->used() == bar.memory_bytes());
    {
        Mesh copy = bar;
        const std::size_t own = bar.memory_bytes() - bar.topology().memory_bytes();
        CHECK(context.memory()->used() == bar.memory_bytes() + own);
        const Mesh moved = std::move(copy);
        CHECK(context.memory()->used() == bar.memory_bytes() + own);
        bar = moved;
        CHECK(context.memory()->used() == bar.memory_bytes() + own);
    }
    Attribute uv{"uv", Domain::corner, 2, ScalarType::float32, {}};
    uv.values.resize(2 * at(bar.topology().corner_count()));
    bar.attributes().add(uv);
    CHECK(context.memory()->used() == bar.memory_bytes());
    bar.attributes().add(uv);
    CHECK(context.memory()->used() == bar.memory_bytes());
    bar.attributes().remove("uv");
    bar.remove_region("top");
    CHECK(context.memory()->used() == bar.memory_bytes());
    bar.attributes() = make_sphere().attributes();
    bar.replace_by(make_sphere({}, context));
    CHECK(context.memory()->used() == bar.memory_bytes());
    bar = Mesh();
    CHECK(context.memory()->used() == 0);
}
