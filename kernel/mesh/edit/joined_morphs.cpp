#include "kernel/mesh/edit/joined_morphs.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "kernel/mesh/measure/short_number.h"

namespace lissom {
namespace {

// "morph.7.position": the target's number, from 1, and ".position"; 0 for other names.
struct MorphPart {
    Index number = 0;
    std::string_view part;
};

MorphPart morph_part(const Attribute& attribute) {
    constexpr std::string_view kPrefix = "morph.";
    const AttributeRole role = role_of(attribute);
    const bool known = role == AttributeRole::morph_position ||
                       role == AttributeRole::morph_normal || role == AttributeRole::morph_tangent;
    if (!known || attribute.domain == Domain::face) return {};
    const std::string_view rest = std::string_view(attribute.name).substr(kPrefix.size());
    MorphPart result;
    const auto read = std::from_chars(rest.data(), rest.data() + rest.size(), result.number);
    result.part = rest.substr(static_cast<std::size_t>(read.ptr - rest.data()));
    const bool whole = read.ec == std::errc() && result.number > 0 && result.part.rfind('.') == 0;
    return whole ? result : MorphPart{};
}

bool has_morphs(const Mesh& mesh) {
    const auto& all = mesh.attributes().all();
    return std::any_of(all.begin(), all.end(),
                       [](const Attribute& a) { return morph_part(a).number > 0; });
}

bool has_value(std::span<const double> value) {
    return std::all_of(value.begin(), value.end(), [](double x) { return std::isfinite(x); });
}

// The objects of a mesh, by their labels: that of each face, and of each vertex that of one of its
// faces. The last is for elements without a label.
class Objects {
  public:
    explicit Objects(const Mesh& mesh) : mesh_(mesh) {
        const auto found = mesh.attributes().labels().find("object");
        if (found != mesh.attributes().labels().end()) labels_ = &found->second;
        of_vertex_.assign(at(mesh.vertex_count()), count() - 1);
        of_corner_.reserve(at(mesh.topology().corner_count()));
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const Index label = labels_ ? labels_->of_face[at(f)] : kNoIndex;
            const Index object = label == kNoIndex ? count() - 1 : label;
            for (const Index v : mesh.topology().face(f)) {
                of_vertex_[at(v)] = object;
                of_corner_.push_back(object);
            }
        }
    }

    Index count() const { return labels_ ? count_of(labels_->names) + 1 : 1; }
    std::string name(Index object) const {
        return object + 1 < count() ? labels_->names[at(object)] : std::string();
    }
    Index of(const Attribute& attribute, Index element) const {
        return attribute.domain == Domain::vertex ? of_vertex_[at(element)]
                                                  : of_corner_[at(element)];
    }

    // The targets of each, as the asset and the values tell.
    std::vector<std::vector<MorphTarget>> targets() const {
        const auto* asset = dynamic_cast<const MorphAsset*>(mesh_.asset().get());
        std::vector<std::vector<MorphTarget>> result(at(count()));
        for (Index o = 0; asset && o < count(); ++o) result[at(o)] = asset->morphs_of(name(o));
        for (const Attribute& attribute : mesh_.attributes().all()) {
            const Index number = morph_part(attribute).number;
            for (Index i = 0; number > 0 && i < attribute.size(); ++i) {
                std::vector<MorphTarget>& own = result[at(of(attribute, i))];
                if (count_of(own) >= number || !has_value(attribute.at(i))) continue;
                while (count_of(own) < number) {
                    own.push_back({morph_call_name(count_of(own) + 1), 0.0, false});
                }
            }
        }
        return result;
    }

  private:
    const Mesh& mesh_;
    const FaceLabels* labels_ = nullptr;
    std::vector<Index> of_vertex_, of_corner_;
};

void unite(std::vector<MorphTarget>& all, const std::vector<MorphTarget>& own) {
    const std::vector<Index> places = morph_places(own, all);
    for (std::size_t k = 0; k < own.size(); ++k) {
        if (places[k] == kNoIndex) {
            all.push_back(own[k]);
        } else {
            all[at(places[k])].is_named = all[at(places[k])].is_named || own[k].is_named;
        }
    }
}

bool are_numbers(const std::vector<Index>& places) {
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (places[k] != index_of(k)) return false;
    }
    return true;
}

// The attributes under their new numbers, while they are gathered.
class Renumbered {
  public:
    Renumbered(const Mesh& mesh, const Objects& objects,
               const std::vector<std::vector<Index>>& places)
        : mesh_(mesh), objects_(objects), places_(places) {}

    void add(const Attribute& old, const MorphPart& part) {
        for (Index o = 0; o < objects_.count(); ++o) {
            if (part.number > count_of(places_[at(o)])) continue;
            const Index place = places_[at(o)][at(part.number - 1)];
            Attribute& made = made_at({place, std::string(part.part)}, old);
            copy(old, o, made);
        }
    }

    void give_to(AttributeSet& attributes) {
        for (auto& [key, attribute] : made_) {
            if (has_any(attribute)) attributes.add(std::move(attribute));
        }
    }

  private:
    using Key = std::pair<Index, std::string>;

    Attribute& made_at(const Key& key, const Attribute& old) {
        const auto [found, is_new] = made_.try_emplace(key);
        Attribute& made = found->second;
        if (is_new) {
            made = {
                "morph." + std::to_string(key.first + 1) + key.second, old.domain, 3, old.type, {}};
            made.values.assign(at(element_count(mesh_.topology(), old.domain)) * 3, kNone);
        } else if (made.domain == Domain::vertex && old.domain == Domain::corner) {
            to_corners(made);
        }
        return made;
    }

    void to_corners(Attribute& attribute) const {
        std::vector<double> values;
        for (const Index v : mesh_.topology().faces().vertices) {
            const auto value = std::as_const(attribute).at(v);
            values.insert(values.end(), value.begin(), value.end());
        }
        attribute.domain = Domain::corner;
        attribute.values = std::move(values);
    }

    void copy(const Attribute& old, Index object, Attribute& made) const {
        for (Index i = 0; i < made.size(); ++i) {
            if (objects_.of(made, i) != object) continue;
            const Index from =
                made.domain == old.domain ? i : mesh_.topology().faces().vertices[at(i)];
            const std::span<const double> value = old.at(from);
            if (has_value(value)) std::copy(value.begin(), value.end(), made.at(i).begin());
        }
    }

    static bool has_any(const Attribute& attribute) {
        return std::any_of(attribute.values.begin(), attribute.values.end(),
                           [](double x) { return std::isfinite(x); });
    }

    const Mesh& mesh_;
    const Objects& objects_;
    const std::vector<std::vector<Index>>& places_;
    std::map<Key, Attribute> made_;
};

std::vector<MorphTarget> united(const Mesh& mesh) {
    std::vector<MorphTarget> all;
    for (const auto& own : Objects(mesh).targets()) unite(all, own);
    return all;
}

}  // namespace

std::string morph_call_name(Index number) {
    return "target " + std::to_string(number);
}

std::vector<Index> morph_places(const std::vector<MorphTarget>& own,
                                const std::vector<MorphTarget>& all) {
    std::map<std::string_view, std::vector<Index>> places;
    for (std::size_t k = 0; k < all.size(); ++k) places[all[k].name].push_back(index_of(k));
    std::map<std::string_view, std::size_t> seen;
    std::vector<Index> result;
    for (const MorphTarget& target : own) {
        const std::vector<Index>& named = places[target.name];
        const std::size_t which = seen[target.name]++;
        result.push_back(which < named.size() ? named[which] : kNoIndex);
    }
    return result;
}

std::vector<MorphTarget> joined_morphs(const Mesh& mesh, const Mesh& other) {
    std::vector<MorphTarget> all;
    if (!has_morphs(mesh) && !has_morphs(other)) return all;
    all = united(mesh);
    for (const auto& own : Objects(other).targets()) unite(all, own);
    return all;
}

std::optional<Mesh> with_morph_numbers(const Mesh& mesh, const std::vector<MorphTarget>& all) {
    if (!has_morphs(mesh)) return std::nullopt;
    const Objects objects(mesh);
    std::vector<std::vector<Index>> places;
    for (const auto& own : objects.targets()) places.push_back(morph_places(own, all));
    if (std::all_of(places.begin(), places.end(), are_numbers)) return std::nullopt;
    Mesh result = mesh;
    Renumbered renumbered(mesh, objects, places);
    for (const Attribute& attribute : mesh.attributes().all()) {
        const MorphPart part = morph_part(attribute);
        if (part.number == 0) continue;
        renumbered.add(attribute, part);
        result.attributes().remove(attribute.name);
    }
    renumbered.give_to(result.attributes());
    return result;
}

std::shared_ptr<const Asset> with_morphs(const std::shared_ptr<const Asset>& asset,
                                         const std::vector<MorphTarget>& all) {
    const auto* known = dynamic_cast<const MorphAsset*>(asset.get());
    if (!known || all.empty()) return asset;
    std::shared_ptr<const Asset> changed = known->with_morphs(all);
    return changed ? changed : asset;
}

std::vector<std::string> morph_conflicts(const Mesh& mesh, const Mesh& other) {
    std::vector<std::string> texts;
    if (!has_morphs(mesh) || !has_morphs(other)) return texts;
    const std::vector<MorphTarget> first = united(mesh), second = united(other);
    const std::vector<Index> places = morph_places(second, first);
    for (std::size_t k = 0; k < second.size(); ++k) {
        if (places[k] == kNoIndex) continue;
        const double kept = first[at(places[k])].weight;
        if (kept == second[k].weight) continue;
        texts.push_back("the morph target \"" + second[k].name + "\" has the weight " +
                        short_number(kept) + " in the target and " +
                        short_number(second[k].weight) + " in the source, which becomes " +
                        short_number(kept));
    }
    return texts;
}

}  // namespace lissom
