// strands:follow, lissom.StrandFollower and strands:transfer: hair that follows its head as it
// deforms, or goes to another head.
#include "kernel/hair/follow/strand_follow.h"

#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "bindings/lua/core/engine_library.h"
#include "bindings/lua/hair/engine/strand_check.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strands_methods.h"
#include "kernel/hair/transfer/strand_transfer.h"

namespace lissom::lua {
namespace {

struct StrandFollowerObject {
    static constexpr const char* kTypeName = "lissom.StrandFollower";

    explicit StrandFollowerObject(StrandFollower content) : follower(std::move(content)) {}

    StrandFollower follower;
    std::size_t charged_bytes = 0;

    std::size_t memory_bytes() const { return follower.memory_bytes(); }
};

FollowOptions read_follow(const Call& call) {
    FollowOptions options;
    if (call.has("scale")) options.scale = call.number("scale");
    options.ramp = call.number("ramp");
    options.smoothing = call.number("smoothing");
    options.collision = call.choice<FollowCollision>("collision");
    options.clearance = call.number("clearance");
    return options;
}

// The head of a scalp with the shape it had when the scalp was made.
Mesh head_under(const Scalp& scalp, const Context& context) {
    const SpatialTree& tree = scalp.tree();
    return {{tree.positions().begin(), tree.positions().end()}, tree.shared_topology(), context};
}

// The head as it was under the strands: that of the call, or the one that they grew on.
StrandFollower prepare_follower(const Call& call) {
    FollowOptions options = read_follow(call);
    const auto self = call.self<StrandsObject>();
    if (call.has("rest")) {
        return {self->strands, call.object<MeshObject>("rest")->mesh, options, call.context()};
    }
    require(self->grown_on || self->strands.roots().faces.empty(),
            "the head that the strands grew on is not known, as of strands from a file; give "
            "rest = that head with the shape it has under them");
    if (!self->grown_on) return {self->strands, Mesh(), options, call.context()};
    options.unit = self->grown_on->unit();
    return {self->strands, head_under(*self->grown_on, call.context()), options, call.context()};
}

int follow_once(Call& call) {
    return new_strands(call, [&] {
        StrandFollower follower = prepare_follower(call);
        return follower.follow(call.object<MeshObject>("head")->mesh, call.context());
    });
}

// The scalp of the head that strands come from.
std::shared_ptr<const Scalp> scalp_under(const Call& call) {
    if (call.has("from")) return call.object<ScalpObject>("from")->scalp;
    const auto self = call.self<StrandsObject>();
    require(self->grown_on != nullptr,
            "the head that the strands grew on is not known, as of strands from a file; give from "
            "= lissom.scalp(that head)");
    return self->grown_on;
}

int transfer_strands(Call& call) {
    const auto to = call.object<ScalpObject>("scalp");
    return new_strands(
        call,
        [&] {
            const std::shared_ptr<const Scalp> from = scalp_under(call);
            const Mesh old_head = head_under(*from, call.context());
            TransferOptions options;
            if (call.has("scale")) options.scale = call.number("scale");
            options.clearance.reset();
            if (call.boolean("push_out")) options.clearance = call.number("clearance");
            return transferred(strands_of(call), {old_head, *from}, {to->head->mesh, *to->scalp},
                               options, call.context());
        },
        to->scalp);
}

int make_follower(Call& call) {
    const auto result = call.create<StrandFollowerObject>();
    const bool done = call.attempt(
        [&] { result.set(std::make_shared<StrandFollowerObject>(prepare_follower(call))); });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int follow_frame(Call& call) {
    const auto self = call.self<StrandFollowerObject>();
    if (!call.has("into")) {
        return new_strands(call, [&] {
            return self->follower.follow(call.object<MeshObject>("head")->mesh, call.context());
        });
    }
    const auto into = call.object<StrandsObject>("into");
    const bool done = call.attempt([&] {
        into->strands =
            self->follower.follow(call.object<MeshObject>("head")->mesh, call.context());
        into->grown_on = nullptr;
    });
    if (!done) return call.fail();
    call.charge(into);
    lua_pushvalue(call.lua(), call.stack_index("into"));
    return 1;
}

int follower_size(Call& call) {
    return call.push(call.self<StrandFollowerObject>()->follower.strands().size());
}

int follower_text(Call& call) {
    char text[64];
    const Index count = call.self<StrandFollowerObject>()->follower.strands().size();
    const int length = std::snprintf(text, sizeof text, "lissom.StrandFollower: %d strands", count);
    return call.push(std::string_view(text, at(length)));
}

Parameter head_argument() {
    return object("head", "lissom.Mesh",
                  "The deformed head: the vertices and faces of the one at rest.");
}

std::vector<Parameter> follow_fields() {
    const FollowOptions d;
    return {object("rest", "lissom.Mesh", "The head with the shape it has under the strands.")
                .optional("the head that they grew on or were attached to, as it was then"),
            number("scale", "Factor of the strands' lengths.")
                .above(0)
                .optional("that of the head if it was scaled as a whole, else 1"),
            meters("ramp",
                   "Length over which hair goes over from the rotation of the skin at its "
                   "root to that of the head around it.")
                .defaults(d.ramp)
                .at_least(0),
            meters("smoothing", "Length over which rotations of the skin are smoothed.")
                .defaults(d.smoothing)
                .at_least(0),
            choice("collision", {"none", "near", "all"},
                   "Hair that is kept out of the head: none; points near the skin at rest, over "
                   "the place below them, which is fast; all. None is pushed farther out than it "
                   "was at rest.")
                .defaults("all"),
            meters("clearance", "Distance that hair stays off the skin.")
                .defaults(d.clearance)
                .at_least(0)};
}

std::vector<Parameter> transfer_fields() {
    const TransferOptions d;
    return {object("from", "lissom.Scalp", "The scalp of the head that the hair comes from.")
                .optional("that of the head that they grew on or were attached to"),
            number("scale", "Factor of the strands' lengths.")
                .above(0)
                .optional("the ratio of the heads' sizes"),
            boolean("push_out", "Keeps the hair out of the other head.").defaults(true),
            meters("clearance", "Distance that hair stays off the skin.")
                .defaults(*d.clearance)
                .at_least(0)};
}

const std::vector<ErrorCode> kFollowErrors = {ErrorCode::invalid_argument,
                                              ErrorCode::topology_mismatch, ErrorCode::not_finite,
                                              ErrorCode::memory_limit, ErrorCode::cancelled};

const std::string kBentHead = kStyle +
                              "local hair = style:grow{ count = 20 }\n"
                              "local bent = head:copy():transform{ rotate = { axis = \"x\", "
                              "angle = 20 } }\n";

}  // namespace

std::vector<Function> strand_follow_methods() {
    return {{.name = "follow",
             .body = follow_once,
             .summary =
                 "Moves hair with its head that was bent, morphed, scaled or skinned: roots stay "
                 "on their places of the skin, lengths stay, or grow with a head that is scaled as "
                 "a whole. Guides, groups, widths and colours are kept.",
             .arguments = {head_argument()},
             .options = follow_fields(),
             .results = {{"lissom.Strands", "strands", "New strands."}},
             .errors = kFollowErrors,
             .example = kBentHead + "assert(#hair:follow(bent) == 20)"},
            {.name = "transfer",
             .body = transfer_strands,
             .summary =
                 "Puts hair onto another head, of other faces, shape, size, place or unit. Places "
                 "correspond by their directions from the middles of the heads; the hair follows "
                 "its head as that takes the shape of the other, and is rooted there. Guides, "
                 "groups, widths and colours are kept.",
             .arguments = {object("scalp", "lissom.Scalp", "The scalp of the other head.")},
             .options = transfer_fields(),
             .results = {{"lissom.Strands", "strands", "New strands."}},
             .errors = kFollowErrors,
             .example = kStyle +
                        "local hair = style:grow{ count = 20 }\n"
                        "local other = lissom.shapes.head{ vertices = 3000 }:transform{ scale = 3 "
                        "}\n"
                        "assert(#hair:transfer(lissom.scalp(other)) == 20)"},
            {.name = "follower",
             .body = make_follower,
             .summary = "Prepares hair to follow its head for each frame of an animation.",
             .options = follow_fields(),
             .results = {{"lissom.StrandFollower", "follower", "The prepared strands, a copy."}},
             .errors = kFollowErrors,
             .example = kBentHead + "local follower = hair:follower{ collision = \"near\" }\n"
                                    "assert(#follower:follow(bent) == 20)"}};
}

Type strand_follower_type() {
    return {.name = "lissom.StrandFollower",
            .summary = "Strands prepared for the motion of their head.",
            .methods = {{.name = "follow",
                         .body = follow_frame,
                         .summary = "Moves the hair with its head in another shape, as "
                                    "`strands:follow`.",
                         .arguments = {head_argument()},
                         .options = {object("into", "lissom.Strands",
                                            "Strands whose place the moved ones take.")
                                         .optional("new strands")},
                         .results = {{"lissom.Strands", "strands", "The moved strands."}},
                         .errors = kFollowErrors,
                         .example = kBentHead + "local follower = hair:follower{}\n"
                                                "local moved = follower:follow(bent)\n"
                                                "follower:follow(head, { into = moved })"}},
            .operators = {{"__len", follower_size, "#follower", "number of strands"},
                          {"__tostring", follower_text, "tostring(follower)", "counts"}}};
}

}  // namespace lissom::lua
