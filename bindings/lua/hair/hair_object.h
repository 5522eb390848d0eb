/// Scalps, hairstyles and style curves of a script.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/hair/hairstyle.h"

namespace lissom::lua {

struct ScalpObject {
    static constexpr const char* kTypeName = "lissom.Scalp";

    ScalpObject(std::shared_ptr<MeshObject> owner, std::shared_ptr<const Scalp> made)
        : head(std::move(owner)), scalp(std::move(made)) {}

    std::shared_ptr<MeshObject> head;
    std::shared_ptr<const Scalp> scalp;
};

struct HairstyleObject {
    static constexpr const char* kTypeName = "lissom.Hairstyle";

    HairstyleObject(std::shared_ptr<MeshObject> owner, Hairstyle made)
        : HairstyleObject(std::move(owner), std::make_shared<Hairstyle>(std::move(made))) {}
    HairstyleObject(std::shared_ptr<MeshObject> owner, std::shared_ptr<Hairstyle> shared)
        : head(std::move(owner)), content(std::move(shared)) {}

    std::shared_ptr<MeshObject> head;
    /// Empty once it was closed.
    std::shared_ptr<Hairstyle> content;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    std::size_t memory_bytes() const { return content ? content->memory_bytes() : 0; }
    /// Bytes of curves and masks, and of what follows from them, about.
    std::size_t held_bytes() const;
    /// Throws handle_removed if it was closed.
    Hairstyle& style();
    /// Runs work(Hairstyle&), which changes curves or masks, and holds what they take. Inside
    /// Call::attempt only. Errors: memory_limit, and then the style is as before.
    template <typename Work>
    void edit(const Call& call, const Work& work) {
        Hairstyle& own = style();
        const StyleInputs before = own.inputs();
        work(own);
        try {
            call.reserve(this, 0);
        } catch (...) {
            own.restore(before);
            throw;
        }
    }
};

struct CurveObject {
    static constexpr const char* kTypeName = "lissom.Curve";

    std::shared_ptr<HairstyleObject> owner;
    CurveId id;
};

/// Reads the options that describe a curve; those that are absent leave it as it is. Points are in
/// the unit of the mesh, those of `curve` in metres of the scalp's frame.
class CurveReader {
  public:
    /// `ponytails`: the function has options of ponytails. Raises a Lua error for bad ones.
    CurveReader(Call& call, bool ponytails);

    /// Inside Call::attempt only. Throws invalid_argument.
    void read(const Scalp& scalp, StyleCurve& curve) const;

  private:
    void read_profiles();
    void read(const Scalp& scalp, StreamCurve& curve) const;
    void read(const Scalp& scalp, DividingCurve& curve) const;
    void read(const Scalp& scalp, Ponytail& curve) const;

    Call& call_;
    // The two lists of points of the option `profiles`.
    std::span<const Vec3> profiles_[2];
};

/// Throws invalid_argument if a call that has the options of all kinds gives one that `curve` has
/// no use for.
void refuse_other_options(const Call& call, const StyleCurve& curve);

/// If a call gives tilts to a dividing curve with hints, the hints' tilts become its tilts, and the
/// hints go. Inside Call::attempt only.
void forget_hints(const Call& call, const Hairstyle& style, CurveId id, StyleCurve& curve);

/// Methods of curves: tilts of partings by hints, and options as they act.
std::vector<Function> tilt_methods();
std::vector<Function> option_methods();

/// Methods of hairstyles: masks, the comb and sketching, and the records that they give.
std::vector<Function> style_stroke_methods();
std::vector<Record> style_stroke_records();

/// Methods of hairstyles: the field with its constraints, growth, and `save`.
std::vector<Function> style_field_methods();
std::vector<Function> style_growth_methods();
Function style_save_method();

/// Pushes a curve.
bool push_curve(Call& call, const std::shared_ptr<HairstyleObject>& style, CurveId id);

/// Options of each kind of curve, and all of them for changing one.
std::vector<Parameter> stream_fields();
std::vector<Parameter> dividing_fields();
std::vector<Parameter> ponytail_fields();
std::vector<Parameter> curve_fields();

/// {azimuth=, elevation=, lift=} over a head, and its effect.
std::vector<Parameter> direction_fields();
/// Pushes the point of these options, or the normal of the head below it.
int push_point_at(Call& call, const Scalp& scalp);
int push_normal_at(Call& call, const Scalp& scalp);
/// The descriptions of `at` and `normal_at`.
Function point_at_method(Body body, const std::string& example);
Function normal_at_method(Body body, const std::string& example);

/// Start of examples: a style with one stream curve on the generated head. Inline, as examples of
/// other files are made of it before main.
inline const std::string kStyle = R"(local head = lissom.shapes.head{ vertices = 3000 }
local style = lissom.hairstyle(head, { resolution = 5000 })
local points = { style:at{ azimuth = 20, elevation = 50, lift = 0.01 },
                 style:at{ azimuth = 70, elevation = 10, lift = 0.02 } }
local curve = style:add_stream{ points = points, name = "side" }
)";

/// Start of examples: kStyle, and a parting.
inline const std::string kParting = kStyle + R"(local line = {}
for i, elevation in ipairs{ 40, 60, 80 } do
    line[i] = style:at{ azimuth = 0, elevation = elevation }
end
local parting = style:add_dividing{ points = line }
)";

}  // namespace lissom::lua
