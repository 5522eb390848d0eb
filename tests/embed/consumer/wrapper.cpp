// A host in C++ that has the C functions alone: bends a bar by lissom.hpp.
#include <cstdio>
#include <vector>

#include <lissom/lissom.hpp>

using namespace lissom::api;

int main() {
    Context context;
    // A bar of 2 x 2 x 20 quads' corners would do; a sheet is shorter to write.
    std::vector<float> positions;
    std::vector<std::uint32_t> corners;
    const std::uint32_t rows = 20;
    for (std::uint32_t i = 0; i <= rows; ++i) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            positions.insert(positions.end(), {float(k), float(i), 0.1f * float(k * k)});
            if (i == rows || k == 2) continue;
            const std::uint32_t v = 3 * i + k;
            corners.insert(corners.end(), {v, v + 1, v + 4, v, v + 4, v + 3});
        }
    }
    Mesh sheet = context.mesh(input(positions.data(), positions.size() / 3),
                              input(corners.data(), corners.size()));
    const std::uint64_t before = sheet.hash();
    Deformer edit(sheet, sheet.all());
    edit.add_handle(sheet.plane({0, 0.5, 0}, {0, -1, 0}));
    const int top = edit.add_handle(sheet.plane({0, 19.5, 0}, {0, 1, 0}));
    lissom_transform lift = lissom_identity();
    lift.m[11] = 5.0;
    edit.set_transform(top, lift);
    edit.solve();
    edit.apply(sheet);
    edit.reset();
    bool refused = false;
    try {
        lissom_transform flat{};
        edit.set_transform(top, flat);
    } catch (const Error& error) {
        refused = error.status() == LISSOM_SINGULAR_TRANSFORM;
        std::printf("refused: %s\n", error.what());
    }
    return refused && sheet.hash() != before ? 0 : 1;
}
