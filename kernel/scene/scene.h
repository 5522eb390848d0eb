/// Scene: named objects in an order, and the history of their changes.
///
///     Scene scene;
///     auto bar = std::make_shared<Mesh>(make_bar());
///     scene.add("bar", std::make_shared<MeshItem>(bar));
///     scene.step("bend", [&] { transform(*bar, map); });
///     scene.undo();    // `bar` itself is as before
///
/// Objects are live: any holder may change them at any time, and undo restores content in the same
/// object. Changes outside a step are found at the next step, undo or hash, and become a step of
/// their own called "edited".
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/scene/content_store.h"
#include "kernel/scene/history.h"
#include "kernel/scene/scene_item.h"
#include "kernel/scene/scene_parameters.h"
#include "kernel/scene/scene_state.h"

namespace lissom {

struct SceneOptions {
    /// Bytes that the history may hold beside one copy of the present content; the oldest steps go
    /// if it would be more.
    std::size_t history_bytes = std::size_t{512} << 20;
    /// Account charged by the history, as a context's memory(); null: none.
    std::shared_ptr<MemoryAccount> account = {};
};

/// Contents of a scene's history.
struct HistoryReport {
    struct Step {
        std::string name;
        /// Bytes that the step added to the history.
        std::size_t bytes = 0;
    };

    /// Oldest first.
    std::vector<Step> steps;
    /// The first `place` of them can be undone, the others done again.
    std::size_t place = 0;
    /// Bytes of all steps together, beside one copy of the present content.
    std::size_t bytes = 0;
    std::size_t limit = 0;
    /// Number of steps that were forgotten because of the limit.
    std::size_t dropped = 0;
};

/// Used by one thread at a time. After an error the scene and the contents of its objects are as
/// they were. Every function that takes memory may throw memory_limit.
class Scene {
  public:
    /// Name of the step made of changes outside a step.
    static constexpr std::string_view kEdited = "edited";

    explicit Scene(const SceneOptions& options = {});
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    // ---- Objects. Outside a step, each change is a step of its own, for instance "add bar".

    /// Adds an object behind all others. Two objects may show one item. Errors: invalid_argument
    /// for an empty name or one that another object has; as require_look.
    ObjectId add(std::string name, std::shared_ptr<SceneItem> item, ObjectLook look = {});
    /// Errors of the following: out_of_range for an object that the scene does not have.
    void remove(ObjectId id);
    /// Errors: also as add.
    void rename(ObjectId id, std::string name);
    /// Gives an object the place `place` in the order, from 0. Errors: also out_of_range for that.
    void reorder(ObjectId id, Index place);
    /// Errors: also as require_look.
    void set_look(ObjectId id, ObjectLook look);

    const ObjectList& objects() const { return objects_; }
    /// Returns the object called `name`, or null.
    const NamedObject* find(std::string_view name) const;
    const NamedObject& object(ObjectId id) const;

    // ---- Steps

    /// Opens a step: all changes to the scene and its objects until `commit` are undone at once. A
    /// step inside another becomes part of it. Errors: invalid_argument for an empty name.
    void begin(std::string name);
    /// Ends the step opened last. False if nothing has changed: then there is no step to undo.
    /// Errors: invalid_argument if none is open.
    bool commit();
    /// Ends the step opened last and reverts its changes. Errors: as commit.
    void rollback();
    /// Number of open steps.
    std::size_t depth() const { return open_.size(); }

    /// Runs work() as a step. If it throws, the scene is as it was before, and the error is
    /// rethrown.
    template <typename Work>
    void step(std::string name, const Work& work) {
        begin(std::move(name));
        try {
            work();
            commit();
        } catch (...) {
            rollback();
            throw;
        }
    }

    /// Undoes the last step, or does the last undone one again, and returns its name; nothing at
    /// the end. Errors: invalid_argument while a step is open.
    std::optional<std::string> undo();
    std::optional<std::string> redo();
    HistoryReport history() const;
    /// HistoryReport::bytes.
    std::size_t history_bytes() const { return history_.bytes(); }
    /// Forgets all steps; the scene stays as it is. Errors: as undo.
    void clear_history();

    /// Returns the states before the first step of the history and after each; none while a step is
    /// open.
    std::vector<std::shared_ptr<const SceneState>> past() const;
    /// Adds a step that was done before, for readers of histories: `objects` are those after it,
    /// with the items of the new state. It is a step even if nothing has changed. Errors: as undo.
    void append(std::string name, ObjectList objects);

    /// Values that tools and scripts keep with the scene, by whose they are. They are no part of
    /// its history nor of its hash. Errors: not_finite; memory_limit.
    const ParametersByOwner& parameters() const { return parameters_; }
    /// No values: forgets those of `owner`.
    void set_parameters(const std::string& owner, SceneParameters values);

    /// Returns the hash of names, order, looks and contents of all objects, for any history; the
    /// same on every run, platform and number of threads.
    std::uint64_t hash();
    /// Returns the scene as it is now.
    std::shared_ptr<const SceneState> state();

  private:
    struct OpenStep {
        std::string name;
        /// State that rollback returns to.
        std::shared_ptr<const SceneState> before;
        std::size_t bytes;
        MemoryCharge charge;
    };

    template <typename Change>
    void change(const char* verb, const std::string& name, const Change& change);
    ObjectList::iterator place_of(ObjectId id);
    void require_free_name(std::string_view name) const;
    void require_closed(const char* what) const;
    void settle();
    void capture();
    void record(std::string name, std::size_t bytes_before);
    void restore(const std::shared_ptr<const SceneState>& wanted);

    SceneOptions options_;
    ContentStore store_;
    ObjectList objects_;
    std::uint64_t next_id_ = 1;
    /// The state captured last: outside steps the present one of the history.
    std::shared_ptr<const SceneState> seen_;
    History history_;
    std::vector<OpenStep> open_;
    ParametersByOwner parameters_;
    std::map<std::string, MemoryCharge, std::less<>> parameter_charges_;
};

}  // namespace lissom
