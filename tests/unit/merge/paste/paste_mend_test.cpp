// A paste with faults is sewn another way.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// An egg with waves in its surface.
Mesh wavy_egg(double height) {
    Mesh mesh = egg(20);
    for (Vec3& p : mesh.edit_positions()) p *= 1.0 + height * std::sin(5.0 * p.x() + 4.0 * p.z());
    return mesh;
}

PasteResult horn_on_waves(double height, double turn, bool mend) {
    const Vec3 at(1.4 * std::cos(turn), 0.3, 1.6 * std::sin(turn));
    Paste paste = horn_on_egg(horned_ball(16), wavy_egg(height), {.at = at, .scale = 0.8});
    paste.optimize();
    return paste.merge({.mend = mend});
}

bool tells_of_mending(const MergeReport& report) {
    return std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& w) {
        return w.find("the plain seam had faults") != std::string::npos;
    });
}

}  // namespace

TEST_CASE("paste: a part that the verdict finds fault with is sewn another way, which is told") {
    int faulty = 0, mended = 0;
    for (const double height : {0.25, 0.35}) {
        for (const double turn : {0.6, 1.3, 1.9}) {
            const MergeReport plain = horn_on_waves(height, turn, false).merged.report;
            CHECK(!tells_of_mending(plain));
            if (plain.ok) continue;
            const PasteResult other = horn_on_waves(height, turn, true);
            CHECK(other.merged.report.reasons.size() <= plain.reasons.size());
            CHECK(other.merged.mesh.topology().is_closed());
            ++faulty;
            if (other.merged.report.ok) {
                CHECK(tells_of_mending(other.merged.report));
                ++mended;
            }
        }
    }
    CHECK(faulty > 0);
    CHECK(mended > 0);
}
