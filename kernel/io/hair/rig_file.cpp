#include "kernel/io/hair/rig_file.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom {
namespace {

using RigJson = nlohmann::ordered_json;

// JSON has no text for numbers that are not finite. Micrometres are enough for places.
double tidy(double x) {
    require(std::isfinite(x), "the rig has a number that is not finite", ErrorCode::not_finite);
    return std::round(x * 1e7) / 1e7;
}

RigJson place(const Vec3& p) {
    return {tidy(p.x()), tidy(p.y()), tidy(p.z())};
}

RigJson guides_of(const HairRig& rig) {
    RigJson curves = RigJson::array(), frames = RigJson::array(), lengths = RigJson::array();
    for (const Eigen::Vector3f& p : rig.curves) {
        for (const float x : p) curves.push_back(tidy(x));
    }
    for (const Eigen::Quaternionf& q : rig.root_frames) {
        for (const float x : q.coeffs()) frames.push_back(tidy(x));
    }
    for (const float length : rig.lengths) lengths.push_back(tidy(length));
    return {{"count", rig.guide_count()}, {"points", rig.points}, {"ids", rig.ids},
            {"curves", curves},           {"lengths", lengths},   {"root_frames", frames}};
}

RigJson ties_of(const HairRig& rig) {
    RigJson list = RigJson::array();
    for (const TiedPoints& tied : rig.ties) {
        list.push_back({{"name", tied.tie.name},
                        {"center", place(tied.tie.center)},
                        {"radius", tidy(tied.tie.radius)},
                        {"points", tied.points}});
    }
    return list;
}

RigJson links_of(const HairRig& rig) {
    RigJson list = RigJson::array();
    for (const HairLink& link : rig.links) {
        list.push_back(
            {{"a", link.a}, {"b", link.b}, {"length", tidy(link.length)}, {"bound", link.bound}});
    }
    return list;
}

RigJson capsules_of(const HairRig& rig) {
    RigJson list = RigJson::array();
    for (const Capsule& capsule : rig.capsules) {
        list.push_back(
            {{"a", place(capsule.a)}, {"b", place(capsule.b)}, {"radius", tidy(capsule.radius)}});
    }
    return list;
}

}  // namespace

std::string encode_rig(const HairRig& rig) {
    RigJson json;
    json["format"] = "lissom hair rig";
    json["version"] = 1;
    json["units"] = "metres";
    json["guides"] = guides_of(rig);
    json["ties"] = ties_of(rig);
    json["links"] = links_of(rig);
    json["capsules"] = capsules_of(rig);
    json["capsule_cover"] = tidy(rig.capsule_cover);
    RigJson lengths = RigJson::array();
    for (const float length : rig.strand_lengths) lengths.push_back(tidy(length));
    json["strand_lengths"] = lengths;
    return json.dump(-1, ' ', false, RigJson::error_handler_t::replace) + "\n";
}

void save_rig(const HairRig& rig, const std::filesystem::path& path, const Context& context) {
    write_file_atomically(path, encode_rig(rig), context);
}

}  // namespace lissom
