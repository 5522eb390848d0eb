#include "tests/unit/limits/operations.h"

#include <utility>

#include "kernel/core/hasher.h"
#include "kernel/deform/deformer.h"
#include "kernel/hair/hairstyle.h"
#include "kernel/hair/strands/strand_clump.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_noise.h"
#include "kernel/hair/strands/strand_resample.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/strand_file.h"
#include "kernel/merge/merge.h"
#include "kernel/merge/paste/erase/erase_feature.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/smooth.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/fill/fill.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/parameterize/parameterize.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/scene.h"
#include "kernel/scene/strands_item.h"
#include "tests/unit/shapes.h"

namespace lissom::test {
namespace {

template <typename T>
Made made(T value, std::uint64_t hash) {
    return {std::make_shared<T>(std::move(value)), hash};
}
Made made(Mesh mesh) {
    const std::uint64_t value = hash(mesh);
    return made(std::move(mesh), value);
}
Made made(Strands strands) {
    const std::uint64_t value = hash(strands);
    return made(std::move(strands), value);
}

// With all that meshes carry.
Mesh with_attributes(Mesh mesh) {
    for (const auto& [name, domain, width] :
         {std::tuple{"uv", Domain::corner, 2}, {"color", Domain::vertex, 3}}) {
        Attribute attribute{name, domain, width, ScalarType::float32, {}};
        attribute.values.assign(at(element_count(mesh.topology(), domain)) * at(width), 0.5);
        mesh.attributes().add(std::move(attribute));
    }
    FaceLabels labels{{"skin"}, std::vector<Index>(at(mesh.face_count()), 0)};
    mesh.attributes().labels()["material"] = std::move(labels);
    mesh.attributes().recount();
    mesh.set_region("everything", Region::all(mesh.shared_topology()));
    return mesh;
}

struct Inputs {
    Mesh bar = with_attributes(make_bar({.across = 16, .along = 150}));
    Mesh sphere = make_sphere({.segments = 40, .kind = SphereKind::triangles});
    Mesh lower = open_tube(100, 100),
         upper = moved(open_tube(100, 100), translation(Vec3(0.1, 2.5, 0.0)));
    Mesh head = make_head({.vertices = 4000});
    std::string obj = encode_mesh(bar, "obj"), ply = encode_mesh(bar, "ply"),
                glb = encode_mesh(bar, "glb"), stl = encode_mesh(sphere, "stl"),
                off = encode_mesh(sphere, "off");
    Strands hair = grown(Context());
    std::string hair_file = encode_strands(hair, "hair").bytes,
                data_file = encode_strands(hair, "data").bytes,
                usda_file = encode_strands(hair, "usda").bytes;

    Strands grown(const Context& context) const {
        HairstyleOptions options;
        options.resolution = 10000;
        Hairstyle style(head, std::make_shared<const Scalp>(head, ScalpOptions{}, context), options,
                        context);
        const auto over = [&](double azimuth, double elevation) {
            const double degree = kPi / 180.0;
            return style.scalp().to_metres(
                style.scalp().at({azimuth * degree, elevation * degree}, 0.02).position);
        };
        style.add({StreamCurve{{over(20, 50), over(70, 25), over(85, -15)}}});
        HairOptions hair_options = style.default_hair();
        hair_options.roots.count = 20000;
        hair_options.growth.length = 0.2;
        return style.grow(hair_options, context);
    }
};

const Inputs& inputs() {
    static const Inputs all;
    return all;
}

Path end_of(const Mesh& tube, bool top) {
    const std::vector<Path> ends = boundaries(tube);
    const bool first = tube.position(ends[0].vertices()[0]).y() > bounds(tube).center().y();
    return ends[first == top ? 0 : 1];
}

// A copy of an input, on the account.
Mesh copied(const Mesh& mesh, const Context& context) {
    Mesh copy({mesh.positions().begin(), mesh.positions().end()}, mesh.topology().faces(), context);
    copy.attributes() = mesh.attributes();
    for (const auto& [name, region] : mesh.regions()) {
        copy.set_region(name, Region(copy.shared_topology(), region.vertices()));
    }
    return copy;
}

template <typename Change>
Made changed(const Mesh& mesh, const Context& context, const Change& change) {
    Mesh copy = copied(mesh, context);
    change(copy);
    return made(std::move(copy));
}

Made deformed(const Context& context) {
    Mesh bar = copied(inputs().bar, context);
    Deformer edit(bar, Region::all(bar.shared_topology()), {}, context);
    edit.add_handle(*bar.find_region("bottom"));
    const HandleId top = edit.add_handle(*bar.find_region("top"));
    edit.set_transform(top, rotation(Vec3::UnitZ(), 0.5, edit.handle(top).center));
    edit.solve();
    edit.apply_to(bar);
    const std::uint64_t value = hash(bar);
    return made(std::pair(std::move(edit), std::move(bar)), value);
}

Made merged(const Context& context) {
    const Mesh &lower = inputs().lower, &upper = inputs().upper;
    const Mesh* targets[] = {&lower};
    Merger merge(upper, targets, {Join{end_of(upper, false), end_of(lower, true)}}, {}, context);
    MergeResult result = merge.solve(context);
    const std::uint64_t value = hash(result.mesh);
    return made(std::pair(std::move(merge), std::move(result)), value);
}

Made in_scene(const Context& context) {
    SceneOptions options;
    options.account = context.memory();
    auto scene = std::make_shared<Scene>(options);
    const auto bar = std::make_shared<Mesh>(copied(inputs().bar, context));
    scene->add("bar", std::make_shared<MeshItem>(bar));
    for (const double x : {1.0, 2.0, 3.0}) {
        scene->step("move", [&] { transform(*bar, Affine{Mat3::Identity(), Vec3(x, 0, 0)}); });
    }
    scene->undo();
    const std::uint64_t value = scene->hash();
    return {scene, value};
}

template <typename Change>
Made changed_strands(const Context& context, const Change& change) {
    const Strands& hair = inputs().hair;
    Strands copy({hair.points().begin(), hair.points().end()},
                 {hair.offsets().begin(), hair.offsets().end()}, context.memory());
    change(copy);
    return made(std::move(copy));
}

std::uint64_t hash_of(std::string_view bytes) {
    Hasher hasher;
    hasher.add(bytes);
    return hasher.value();
}

std::vector<Operation> all_operations() {
    const Inputs& in = inputs();
    const auto decode = [](const std::string& bytes, const char* extension) {
        return [&bytes, extension](const Context& context) {
            return made(decode_mesh(bytes, extension, {}, context));
        };
    };
    const auto encode = [](const Mesh& mesh, const char* extension) {
        return [&mesh, extension](const Context& context) {
            const std::string bytes = encode_mesh(mesh, extension, {}, context);
            return Made{nullptr, hash_of(bytes)};
        };
    };
    const auto decode_hair = [](const std::string& bytes, const char* extension) {
        return [&bytes, extension](const Context& context) {
            return made(decode_strands(bytes, extension, {}, context));
        };
    };
    return {
        {"load obj", decode(in.obj, "obj")},
        {"load ply", decode(in.ply, "ply")},
        {"load glb", decode(in.glb, "glb")},
        {"load stl", decode(in.stl, "stl")},
        {"load off", decode(in.off, "off")},
        {"save obj", encode(in.bar, "obj")},
        {"save ply", encode(in.bar, "ply")},
        {"save glb", encode(in.bar, "glb")},
        {"save stl", encode(in.bar, "stl")},
        {"bar", [](const Context& c) { return made(make_bar({.across = 16, .along = 150}, c)); }},
        {"sphere of triangles",
         [](const Context& c) {
             return made(make_sphere({.segments = 40, .kind = SphereKind::triangles}, c));
         }},
        {"grid",
         [](const Context& c) {
             return made(make_grid({.segments = {100, 100}}, c));
         }},
        {"torus",
         [](const Context& c) {
             return made(make_torus({.segments = 100, .tube_segments = 100}, c));
         }},
        {"cylinder",
         [](const Context& c) { return made(make_cylinder({.segments = 100, .rings = 100}, c)); }},
        {"cactus", [](const Context& c) { return made(make_cactus({.vertices = 10000}, c)); }},
        {"head", [](const Context& c) { return made(make_head({.vertices = 10000}, c)); }},
        {"copy", [&](const Context& c) { return made(Mesh(copied(in.bar, c))); }},
        {"subdivide", [&](const Context& c) { return made(subdivide(in.bar, {.levels = 1}, c)); }},
        {"subdivide by Loop",
         [&](const Context& c) {
             return made(subdivide(in.sphere, {.levels = 1, .scheme = SubdivisionScheme::loop}, c));
         }},
        {"transform",
         [&](const Context& c) {
             return changed(in.bar, c, [&](Mesh& mesh) {
                 transform(mesh, Affine{Mat3::Identity(), Vec3::UnitX()}, c);
             });
         }},
        {"smooth",
         [&](const Context& c) {
             return changed(in.bar, c, [&](Mesh& mesh) { smooth(mesh, {}, c); });
         }},
        {"triangulate",
         [&](const Context& c) {
             return changed(in.bar, c, [&](Mesh& mesh) { triangulate(mesh, c); });
         }},
        {"flip",
         [&](const Context& c) { return changed(in.bar, c, [&](Mesh& mesh) { flip(mesh, c); }); }},
        {"append",
         [&](const Context& c) {
             return changed(in.bar, c, [&](Mesh& mesh) { append(mesh, in.sphere, c); });
         }},
        {"extract",
         [&](const Context& c) {
             MeshPart part = extract(in.bar, Region::all(in.bar.shared_topology()), c);
             const std::uint64_t value = hash(part.mesh);
             return made(std::move(part), value);
         }},
        {.name = "cut",
         .run =
             [&](const Context& c) {
                 Cut parts = cut(in.bar, CutPlane{}, {}, c);
                 const std::uint64_t value = hash(parts.kept.mesh);
                 return made(std::move(parts), value);
             },
         // The maps of the parts belong to the caller.
         .min_kept = 0.45},
        {"fill",
         [&](const Context& c) {
             return changed(in.lower, c,
                            [&](Mesh& mesh) { fill(mesh, end_of(mesh, true), {}, c); });
         }},
        {.name = "parameterize",
         .run =
             [&](const Context& c) {
                 const Region half = select_plane(in.sphere, Vec3::Zero(), Vec3::UnitY());
                 return made(parameterize(in.sphere, half, {}, c), 1);
             },
         .min_kept = 0.0},
        {"distances",
         [&](const Context& c) {
             HeatDistances heat(in.sphere, c);
             const Index first[] = {0};
             auto values = heat.from(first, c);
             return made(std::move(heat), values.size());
         }},
        {"self-intersections",
         [&](const Context& c) { return made(self_intersections(in.sphere, {}, c), 1); }},
        {"spatial tree", [&](const Context& c) { return made(SpatialTree(in.bar, c), 1); }},
        {"deform", deformed},
        {.name = "merge", .run = merged, .min_kept = 0.45},
        {.name = "grow hair",
         .run = [&](const Context& c) { return made(in.grown(c)); },
         .min_peak = 0.65},
        {"clump",
         [&](const Context& c) {
             return changed_strands(c, [&](Strands& strands) { clump(strands, {}, c); });
         }},
        {"noise",
         [&](const Context& c) {
             return changed_strands(c, [&](Strands& strands) { noise(strands, {}, c); });
         }},
        {"resample strands",
         [&](const Context& c) {
             ResampleOptions options;
             options.count = 40;
             return made(resample(in.hair, options, c));
         }},
        {"append strands",
         [&](const Context& c) {
             return changed_strands(c, [&](Strands& strands) { append(strands, in.hair); });
         }},
        {"load hair", decode_hair(in.hair_file, "hair")},
        {"load data", decode_hair(in.data_file, "data")},
        {.name = "load usda",
         .run = decode_hair(in.usda_file, "usda"),
         // Texts of short numbers; lists that have grown by doubling.
         .max_peak = 7.0,
         .min_kept = 0.55},
        {"save usda",
         [&](const Context& c) {
             const std::string bytes = encode_strands(in.hair, "usda", {}, c).bytes;
             return Made{nullptr, hash_of(bytes)};
         }},
        {.name = "scene", .run = in_scene, .overdraws = true},
    };
}

}  // namespace

const std::vector<Operation>& operations() {
    static const std::vector<Operation> all = all_operations();
    return all;
}

}  // namespace lissom::test
