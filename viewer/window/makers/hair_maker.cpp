#include "viewer/window/makers/hair_maker.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "kernel/core/error.h"
#include "viewer/render/strands/view_strands.h"

namespace lissom::window {
namespace {

// Found in a few hundredths of a second.
constexpr LightDetail kRoughLight{.max_points = 6e4, .max_segments = 1e5};

bool same_strands(const DrawnStrands& a, const DrawnStrands& b) {
    return a.strands == b.strands && a.style == b.style;
}

// Whether both have the same hair in the same light.
bool same_hair(const Snapshot& a, const Snapshot& b) {
    const auto strands = [](const DrawnStrands& c, const DrawnStrands& d) {
        return same_strands(c, d) && c.transform == d.transform;
    };
    const auto meshes = [](const DrawnMesh& c, const DrawnMesh& d) {
        return c.mesh == d.mesh && c.transform == d.transform;
    };
    return std::equal(a.strands.begin(), a.strands.end(), b.strands.begin(), b.strands.end(),
                      strands) &&
           std::equal(a.meshes.begin(), a.meshes.end(), b.meshes.begin(), b.meshes.end(), meshes);
}

bool has_strands(const Snapshot& snapshot) {
    return std::any_of(
        snapshot.strands.begin(), snapshot.strands.end(),
        [](const DrawnStrands& drawn) { return drawn.strands && !drawn.strands->empty(); });
}

// Returns a point near the drawn objects, so that floats are exact there.
Vec3 middle_of(const Snapshot& snapshot) {
    for (const DrawnStrands& drawn : snapshot.strands) {
        for (Index s = 0; s < drawn.strands->size(); ++s) {
            const Vec3 root = drawn.strands->root(s).cast<double>();
            if (root.allFinite()) return drawn.transform(root / drawn.style.unit);
        }
    }
    return Vec3::Zero();
}

}  // namespace

HairMaker::HairMaker(int threads, std::function<void()> done)
    : threads_(threads), done_(std::move(done)) {}

HairMaker::~HairMaker() {
    if (making_) making_->cancel();
    stop_directing();
}

Context HairMaker::context() const {
    ContextOptions options;
    options.threads = threads_;
    return Context(options);
}

void HairMaker::make(const Snapshot& snapshot) {
    if (last_ && same_hair(*last_, snapshot)) return;
    last_ = Snapshot{snapshot.meshes, snapshot.strands, {}, {}, 0};
    if (making_) making_->cancel();
    stop_directing();
    making_ = context();
    // The few are always made: else nothing would be seen while a hand moves a curve.
    worker_.post_only([this, snapshot = *last_, all = *making_, few = context()] {
        try {
            if (has_strands(snapshot)) {
                finish({few_of(snapshot, few), {}});
                finish({all_of(snapshot, all), {}});
            } else {
                complete_.clear();
                finish({});
            }
        } catch (const Error& error) {
            if (error.code() != ErrorCode::cancelled) finish({{}, error.message()});
        } catch (const std::bad_alloc&) {
            finish({{}, "there is no memory for the strands of the window"});
        }
    });
}

// Strands that are complete already stay so.
std::vector<HairPart> HairMaker::parts_of(const Snapshot& snapshot, bool few_only,
                                          const Context& context) const {
    std::vector<HairPart> parts;
    for (const DrawnStrands& drawn : snapshot.strands) {
        const auto is_it = [&](const HairPart& part) { return same_strands(part.drawn, drawn); };
        const auto known = std::find_if(complete_.begin(), complete_.end(), is_it);
        const bool is_known = known != complete_.end();
        parts.push_back({drawn, is_known ? known->packed
                                         : std::make_shared<const PackedStrands>(
                                               pack_strands(drawn, few_only, context))});
    }
    return parts;
}

Hair HairMaker::few_of(const Snapshot& snapshot, const Context& context) const {
    return {parts_of(snapshot, true, context),
            std::make_shared<const HairLight>(snapshot, middle_of(snapshot), kRoughLight, context)};
}

Hair HairMaker::all_of(const Snapshot& snapshot, const Context& context) {
    complete_ = parts_of(snapshot, false, context);
    return {complete_, std::make_shared<const HairLight>(snapshot, middle_of(snapshot),
                                                         LightDetail{}, context)};
}

void HairMaker::direct(std::shared_ptr<const HairLight> light, const Mat3& to_view,
                       std::uint64_t number) {
    stop_directing();
    directing_ = context();
    worker_.post([this, light = std::move(light), to_view, number, context = *directing_] {
        Directed result{number, light, {}};
        try {
            result.bytes = light->directed(to_view, context);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) return;
        } catch (const std::bad_alloc&) {
            result.bytes.clear();
        }
        {
            const std::lock_guard lock(mutex_);
            directed_ = std::move(result);
        }
        done_();
    });
}

void HairMaker::stop_directing() {
    if (directing_) directing_->cancel();
}

void HairMaker::finish(Result result) {
    {
        const std::lock_guard lock(mutex_);
        result_ = std::move(result);
    }
    done_();
}

std::optional<HairMaker::Result> HairMaker::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

std::optional<HairMaker::Directed> HairMaker::take_directed() {
    const std::lock_guard lock(mutex_);
    return std::exchange(directed_, std::nullopt);
}

}  // namespace lissom::window
