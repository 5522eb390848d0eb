/// One small object of every kind in a context, for tests that go through the whole header.
#pragma once

#include <array>
#include <string>

#include "tests/unit/c/host.h"

namespace lissom::test {

class World {
  public:
    explicit World(const lissom_context_options& options = lissom_default_context_options());
    ~World() { lissom_context_destroy(context); }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    operator lissom_context*() const { return context; }

    /// Make objects anew, the former ones released.
    void make_deformer();
    void make_bones();
    void make_halves();
    /// A pose of the deformer at rest, and a space of the bar and a longer one.
    void make_poses();
    void make_paste();
    void make_style();
    void make_strands();
    /// The bar with texture coordinates, labels, and the map of its render vertices.
    void make_map();

    /// Releases what calls have made, below.
    void drop();

    /// Returns text of all content that calls may change.
    std::string content() const;

    lissom_context* context = nullptr;
    /// A bar with regions of its ends.
    lissom_mesh bar{};
    lissom_region all{}, bottom{}, top{};
    lissom_deformer deformer{};
    std::int32_t handle = -1;
    /// A deformer of the bar with a chain of two bones.
    lissom_deformer boned{};
    std::int32_t bones = -1;
    lissom_pose pose{};
    lissom_pose_space space{};
    lissom_render_map map{};
    /// Two open halves of balls.
    lissom_mesh half{}, other_half{};
    lissom_merger merger{};
    lissom_mesh bump{}, ball{};
    lissom_region bump_region{};
    lissom_paste paste{};
    lissom_mesh head{};
    lissom_hairstyle style{};
    std::int32_t curve = -1;
    lissom_strands strands{};
    lissom_script script{};

    /// Results of calls.
    lissom_mesh made_mesh{}, made_rest{};
    lissom_region made_region{};
    lissom_deformer made_deformer{};
    lissom_pose made_pose{};
    lissom_pose_space made_space{};
    lissom_merger made_merger{};
    lissom_paste made_paste{};
    lissom_hairstyle made_style{};
    lissom_strands made_strands{};
    lissom_render_map made_map{};
    lissom_script made_script{};
    lissom_job made_job{};
    lissom_bytes bytes{};
};

/// Returns a list of triples of doubles.
inline lissom_input triples(const double* data, std::size_t count) {
    return {data, count, 0, LISSOM_FLOAT64};
}

}  // namespace lissom::test
