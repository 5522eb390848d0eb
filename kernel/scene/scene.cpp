#include "kernel/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "kernel/core/error.h"
#include "kernel/core/memory_error.h"

namespace lissom {
namespace {

[[noreturn]] void refuse_absent(ObjectId id) {
    throw Error(ErrorCode::out_of_range,
                "the scene has no object " + std::to_string(id.value) + " (any more)");
}

// Parts stand before their wholes; each thing stands once.
void list_items(const std::shared_ptr<SceneItem>& item, std::unordered_set<const void*>& known,
                std::vector<CapturedItem>& items) {
    if (!known.insert(item->identity()).second) return;
    for (const auto& part : item->parts()) list_items(part, known, items);
    items.push_back({item, nullptr});
}

// A value that is charged for as long as it lives.
template <typename T>
std::shared_ptr<const T> charged(MemoryCharge charge, T&& value) {
    struct Charged {
        MemoryCharge charge;
        T value;
    };
    const auto made =
        std::make_shared<const Charged>(Charged{std::move(charge), std::forward<T>(value)});
    return {made, &made->value};
}

// Bytes of the item of an object, and of blocks of the allocator.
constexpr std::size_t kItemBytes = 256;

std::shared_ptr<const NamedObject> charged_object(const ContentStore& store, NamedObject object) {
    const std::size_t texts = object.name.size() + object.look.style.region.size();
    return charged(store.charge_beside(sizeof object + kItemBytes + texts), std::move(object));
}

// Bytes of the state's count, and of blocks of the allocator.
constexpr std::size_t kStateBytes = 128;

std::shared_ptr<const SceneState> charged_state(const ContentStore& store, SceneState state) {
    const std::size_t bytes = state.objects.size() * sizeof(ObjectList::value_type) +
                              state.items.size() * sizeof(CapturedItem);
    return charged(store.charge_beside(sizeof state + kStateBytes + bytes), std::move(state));
}

// Bytes of parameters as they are kept, with the nodes of their maps.
std::size_t bytes_of(const std::string& owner, const SceneParameters& values) {
    constexpr std::size_t kNode = 64;
    std::size_t bytes = 2 * (kNode + sizeof(std::string) + owner.size()) + sizeof(SceneParameters);
    for (const auto& [name, value] : values) {
        const auto* text = std::get_if<std::string>(&value);
        bytes +=
            kNode + sizeof(std::string) + name.size() + sizeof value + (text ? text->size() : 0);
    }
    return bytes;
}

}  // namespace

Scene::Scene(const SceneOptions& options)
    : options_(options),
      store_(options.account),
      seen_(std::make_shared<const SceneState>()),
      history_(seen_, options.history_bytes, store_) {}

// ---- Objects

// Changes the list of objects, as a step if none is open.
template <typename Change>
void Scene::change(const char* verb, const std::string& name, const Change& change) {
    with_memory_errors([&] {
        if (!open_.empty()) return change();
        step(std::string(verb) + " " + name, change);
    });
}

ObjectList::iterator Scene::place_of(ObjectId id) {
    const auto found = std::find_if(objects_.begin(), objects_.end(),
                                    [&](const auto& object) { return object->id == id; });
    if (found == objects_.end()) refuse_absent(id);
    return found;
}

void Scene::require_free_name(std::string_view name) const {
    require(!name.empty(), "an object of a scene needs a name");
    if (!find(name)) return;
    throw Error(ErrorCode::invalid_argument,
                "the scene has an object '" + std::string(name) +
                    "' already; take another name, or remove that one before");
}

ObjectId Scene::add(std::string name, std::shared_ptr<SceneItem> item, ObjectLook look) {
    require(item != nullptr, "an object of a scene needs an item");
    require_free_name(name);
    require_look(look);
    const ObjectId id{next_id_};
    change("add", name, [&] {
        objects_.push_back(charged_object(store_, {id, name, std::move(look), std::move(item)}));
    });
    ++next_id_;
    return id;
}

void Scene::remove(ObjectId id) {
    const auto place = place_of(id);
    const std::string name = (*place)->name;
    change("remove", name, [&] { objects_.erase(place); });
}

void Scene::rename(ObjectId id, std::string name) {
    const auto place = place_of(id);
    if ((*place)->name == name) return;
    require_free_name(name);
    change("rename", (*place)->name, [&] {
        NamedObject renamed = **place;
        renamed.name = std::move(name);
        *place = charged_object(store_, std::move(renamed));
    });
}

void Scene::reorder(ObjectId id, Index place) {
    const auto from = place_of(id);
    if (place < 0 || place >= count_of(objects_)) {
        throw Error(ErrorCode::out_of_range,
                    "place " + std::to_string(place) + " is not one of the " +
                        std::to_string(objects_.size()) + " objects of the scene");
    }
    const auto to = objects_.begin() + place;
    change("move", (*from)->name, [&] {
        if (to <= from) std::rotate(to, from, from + 1);
        if (to > from) std::rotate(from, from + 1, to + 1);
    });
}

void Scene::set_look(ObjectId id, ObjectLook look) {
    const auto place = place_of(id);
    require_look(look);
    if ((*place)->look == look) return;
    change("change", (*place)->name, [&] {
        NamedObject changed = **place;
        changed.look = std::move(look);
        *place = charged_object(store_, std::move(changed));
    });
}

const NamedObject* Scene::find(std::string_view name) const {
    for (const auto& object : objects_) {
        if (object->name == name) return object.get();
    }
    return nullptr;
}

const NamedObject& Scene::object(ObjectId id) const {
    for (const auto& object : objects_) {
        if (object->id == id) return *object;
    }
    refuse_absent(id);
}

// ---- Steps

// Brings `seen_` up to date; it stays the same state if nothing has changed.
void Scene::capture() {
    SceneState next;
    next.objects = objects_;
    std::unordered_set<const void*> known;
    for (const auto& object : objects_) list_items(object->item, known, next.items);
    for (std::size_t i = 0; i < next.items.size(); ++i) {
        CapturedItem& captured = next.items[i];
        const auto last = seen_->find(captured.item->identity(), i);
        captured.content = captured.item->capture(last, store_);
    }
    if (!(next == *seen_)) seen_ = charged_state(store_, std::move(next));
}

void Scene::record(std::string name, std::size_t bytes_before) {
    const std::size_t bytes = store_.bytes();
    history_.push(std::move(name), seen_, bytes > bytes_before ? bytes - bytes_before : 0);
}

// Makes a step of changes outside a step.
void Scene::settle() {
    const std::size_t bytes = store_.bytes();
    capture();
    if (seen_ != history_.present()) record(std::string(kEdited), bytes);
}

void Scene::require_closed(const char* what) const {
    if (open_.empty()) return;
    throw Error(ErrorCode::invalid_argument, std::string(what) + " while the step '" +
                                                 open_.back().name + "' is open; end it before");
}

void Scene::begin(std::string name) {
    require(!name.empty(), "a step needs a name");
    with_memory_errors([&] {
        open_.empty() ? settle() : capture();
        MemoryCharge charge = store_.charge_beside(sizeof(OpenStep) + name.size());
        open_.push_back({std::move(name), seen_, store_.bytes(), std::move(charge)});
    });
}

bool Scene::commit() {
    require(!open_.empty(), "there is no step to commit; begin one before");
    return with_memory_errors([&] {
        capture();
        const OpenStep& step = open_.back();
        if (*seen_ == *step.before) seen_ = step.before;
        const bool changed = seen_ != step.before;
        if (changed && open_.size() == 1) record(step.name, step.bytes);
        open_.pop_back();
        return changed;
    });
}

void Scene::rollback() {
    require(!open_.empty(), "there is no step to roll back; begin one before");
    // The scene returns to its old state after any end of the step, also by a limit.
    const MemoryOverdraft overdraft(options_.account);
    with_memory_errors([&] {
        capture();
        restore(open_.back().before);
        open_.pop_back();
    });
}

// Content that cannot be put back leaves all others as they were too.
void Scene::restore(const std::shared_ptr<const SceneState>& wanted) {
    const SceneState& now = *seen_;
    std::vector<std::size_t> done;
    done.reserve(wanted->items.size());
    try {
        for (std::size_t i = 0; i < wanted->items.size(); ++i) {
            const CapturedItem& captured = wanted->items[i];
            const auto present = now.find(captured.item->identity(), i);
            if (present == captured.content) continue;
            captured.item->restore(*captured.content, present.get());
            done.push_back(i);
        }
        objects_ = wanted->objects;
    } catch (...) {
        const MemoryOverdraft overdraft(options_.account);
        for (; !done.empty(); done.pop_back()) {
            const CapturedItem& captured = wanted->items[done.back()];
            const auto before = now.find(captured.item->identity(), done.back());
            if (before) captured.item->restore(*before, captured.content.get());
        }
        throw;
    }
    seen_ = wanted;
}

std::optional<std::string> Scene::undo() {
    require_closed("undo");
    return with_memory_errors([&]() -> std::optional<std::string> {
        settle();
        const auto before = history_.before();
        if (!before) return std::nullopt;
        std::string name = history_.steps()[history_.place() - 1].name;
        restore(before);
        history_.go_back();
        return name;
    });
}

std::optional<std::string> Scene::redo() {
    require_closed("redo");
    return with_memory_errors([&]() -> std::optional<std::string> {
        settle();
        const auto after = history_.after();
        if (!after) return std::nullopt;
        std::string name = history_.steps()[history_.place()].name;
        restore(after);
        history_.go_on();
        return name;
    });
}

HistoryReport Scene::history() const {
    HistoryReport report;
    for (const History::Step& step : history_.steps()) {
        report.steps.push_back({step.name, step.captured + step.removed});
    }
    report.place = history_.place();
    report.bytes = history_.bytes();
    report.limit = options_.history_bytes;
    report.dropped = history_.dropped();
    return report;
}

void Scene::clear_history() {
    require_closed("clear_history");
    with_memory_errors([&] {
        settle();
        history_.clear();
    });
}

std::shared_ptr<const SceneState> Scene::state() {
    return with_memory_errors([&] {
        open_.empty() ? settle() : capture();
        return seen_;
    });
}

std::vector<std::shared_ptr<const SceneState>> Scene::past() const {
    std::vector<std::shared_ptr<const SceneState>> states;
    if (!open_.empty()) return states;
    for (std::size_t i = 0; i <= history_.steps().size(); ++i) states.push_back(history_.state(i));
    return states;
}

void Scene::append(std::string name, ObjectList objects) {
    require_closed("append");
    with_memory_errors([&] {
        const std::size_t bytes = store_.bytes();
        objects_ = std::move(objects);
        for (const auto& object : objects_) next_id_ = std::max(next_id_, object->id.value + 1);
        capture();
        record(std::move(name), bytes);
    });
}

void Scene::set_parameters(const std::string& owner, SceneParameters values) {
    for (const auto& [name, value] : values) {
        const auto* number = std::get_if<double>(&value);
        require(!number || std::isfinite(*number), "the parameter '" + name + "' must be finite",
                ErrorCode::not_finite);
    }
    with_memory_errors([&] {
        if (values.empty()) {
            parameters_.erase(owner);
            parameter_charges_.erase(owner);
            return;
        }
        MemoryCharge charge = store_.charge_beside(bytes_of(owner, values));
        parameters_[owner] = std::move(values);
        parameter_charges_[owner] = std::move(charge);
    });
}

std::uint64_t Scene::hash() {
    return lissom::hash(*state());
}

}  // namespace lissom
