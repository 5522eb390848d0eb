#include "kernel/scene/file/history_file.h"

#include <map>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/scene/file/block_lists.h"
#include "kernel/scene/file/scene_archive.h"
#include "kernel/scene/file/scene_records.h"

namespace lissom {
namespace {

constexpr const char* kHistoryPart = "history.json";
constexpr const char* kHistoryFormat = "lissom history";
constexpr Index kHistoryVersion = 1;

struct HistoryHead {
    std::string format = kHistoryFormat;
    Index version = kHistoryVersion;
    std::string mark;
    Index place = 0;
};

template <typename Archive>
void describe(Archive& a, HistoryHead& head) {
    a.text("format", head.format);
    a.integer("version", head.version);
    require(head.format == kHistoryFormat, "this is no history of a scene", ErrorCode::file_syntax);
    require(head.version <= kHistoryVersion,
            "the history is of version " + std::to_string(head.version) +
                ", which is newer than this program",
            ErrorCode::unsupported);
    a.text("mark", head.mark);
    a.integer("place", head.place);
}

// An object that had the number `id` in its scene.
struct NumberedObject {
    Index id = 0;
    ObjectRecord object;
};

// State after a step. Names are those of steps; the first state has none.
struct StateRecord {
    std::string step;
    std::vector<PlacedRecord> changes;
    std::vector<NumberedObject> objects;
};

template <typename Archive>
void describe(Archive& a, StateRecord& state) {
    a.text("step", state.step);
    a.objects("changes", state.changes, [](Archive& b, PlacedRecord& placed) {
        b.integer("item", placed.item);
        describe(b, placed.record);
    });
    a.objects("objects", state.objects, [](Archive& b, NumberedObject& x) {
        b.integer("id", x.id);
        describe(b, x.object);
    });
}

// Writes the states from number `first` on; false if one of them has no place in a file.
class HistoryWriter {
  public:
    HistoryWriter(Scene& scene, const Context& context)
        : states_(scene.past()), report_(scene.history()), context_(context) {}

    std::size_t count() const { return states_.size(); }
    std::size_t place() const { return report_.place; }

    bool write(std::size_t first, SceneJson& json, ListSink& lists) {
        items_.clear();
        written_.clear();
        json = SceneJson::array();
        for (std::size_t i = first; i < states_.size(); ++i) {
            context_.checkpoint();
            StateRecord state;
            if (i > first) state.step = report_.steps[i - 1].name;
            if (!add_changes(*states_[i], state)) return false;
            add_objects(*states_[i], state);
            SceneWriter writer(json.emplace_back(SceneJson::object()), lists);
            describe(writer, state);
        }
        return true;
    }
    // Returns the index of the first state without a place.
    std::size_t stopped_at(const SceneJson& json, std::size_t first) const {
        return first + json.size();
    }

  private:
    bool add_changes(const SceneState& state, StateRecord& record) {
        StateRecorder recorder(state, items_);
        for (const CapturedItem& captured : state.items) {
            auto& written = written_[captured.item->identity()];
            if (written == captured.content) continue;
            if (!recorder.add(captured, record.changes)) return false;
            written = captured.content;
        }
        return true;
    }

    void add_objects(const SceneState& state, StateRecord& record) {
        for (const auto& object : state.objects) {
            const Index item = number_of(items_, object->item->identity());
            record.objects.push_back(
                {static_cast<Index>(object->id.value), {object->name, item, object->look}});
        }
    }

    std::vector<std::shared_ptr<const SceneState>> states_;
    HistoryReport report_;
    const Context& context_;
    ItemTable items_;
    // By identity: the content that the file has last.
    std::map<const void*, std::shared_ptr<const ItemContent>> written_;
};

HistoryHead read_history_head(const SceneJson& json, ListSource& lists) {
    HistoryHead head;
    SceneReader reader(json, lists);
    describe(reader, head);
    return head;
}

class HistoryPlayer {
  public:
    HistoryPlayer(Scene& scene, ItemMaker& maker, const Context& context)
        : scene_(scene), live_(maker, context), context_(context) {}

    void play(const SceneJson& json, ListSource& lists) {
        const HistoryHead head = read_history_head(json, lists);
        const auto states = json.find("states");
        const bool fits = states != json.end() && states->is_array() && head.place >= 0 &&
                          at(head.place) < states->size();
        require(fits, "the history lacks states", ErrorCode::file_syntax);
        Progress progress(context_, "read history");
        for (std::size_t i = 0; i < states->size(); ++i) {
            progress.update(i, states->size());
            StateRecord state;
            SceneReader reader((*states)[i], lists);
            describe(reader, state);
            take(std::move(state), i == 0);
        }
        for (std::size_t i = states->size() - 1; i > at(head.place); --i) scene_.undo();
    }

  private:
    void take(StateRecord state, bool is_first) {
        for (PlacedRecord& change : state.changes) live_.take(std::move(change));
        ObjectList next;
        for (NumberedObject& x : state.objects) next.push_back(named(std::move(x)));
        require(is_first || !state.step.empty(), "a step needs a name");
        scene_.append(is_first ? "load" : std::move(state.step), std::move(next));
        if (is_first) scene_.clear_history();
    }

    std::shared_ptr<const NamedObject> named(NumberedObject x) {
        require(x.id > 0 && !x.object.name.empty(), "an object of the history has no name",
                ErrorCode::file_syntax);
        require_look(x.object.look);
        const ObjectId id{static_cast<std::uint64_t>(x.id)};
        return std::make_shared<const NamedObject>(NamedObject{
            id, std::move(x.object.name), std::move(x.object.look), live_.item(x.object.item)});
    }

    Scene& scene_;
    LiveItems live_;
    const Context& context_;
};

}  // namespace

SceneJson parse_part(std::string_view text) {
    // Deep nesting would exhaust the stack of the parser.
    constexpr int kDeepest = 32;
    const auto callback = [](int depth, SceneJson::parse_event_t, SceneJson&) {
        require(depth <= kDeepest, "the scene is nested too deeply", ErrorCode::file_syntax);
        return true;
    };
    try {
        return SceneJson::parse(text.begin(), text.end(), callback);
    } catch (const SceneJson::exception& error) {
        throw Error(ErrorCode::file_syntax, "the scene's text: " + without_tag(error.what()));
    }
}

// If a state has no place in a file, the history begins behind it.
void add_history(Scene& scene, const std::string& mark, PartWriter& parts,
                 std::vector<std::string>& left_out, const Context& context) {
    require(scene.depth() == 0, "a history is saved between steps; end the open step before");
    HistoryWriter history(scene, context);
    HistoryHead head;
    head.mark = mark;
    std::size_t first = 0;
    SceneJson states;
    PartWriter blocks;
    while (first <= history.place()) {
        blocks = PartWriter();
        BlockSink lists(blocks);
        if (history.write(first, states, lists)) break;
        first = history.stopped_at(states, first) + 1;
    }
    if (first > 0) {
        left_out.push_back(
            "the first " + std::to_string(first) +
            " steps of the history: a deformation's mesh has another topology there");
    }
    if (first > history.place()) return;
    head.place = static_cast<Index>(history.place() - first);
    SceneJson json = SceneJson::object();
    SceneWriter writer(json, blocks);
    describe(writer, head);
    json["states"] = std::move(states);
    parts.append(blocks);
    parts.add(kHistoryPart, json.dump(-1, ' ', false, SceneJson::error_handler_t::replace));
}

bool has_history(const PartReader& parts) {
    return parts.has(kHistoryPart);
}

std::string history_mark(const PartReader& parts) {
    BlockSource lists(parts);
    return read_history_head(parse_part(parts.find(kHistoryPart)), lists).mark;
}

void read_history(const PartReader& parts, Scene& scene, ItemMaker& maker, const Context& context) {
    const SceneJson json = parse_part(parts.find(kHistoryPart));
    BlockSource lists(parts);
    try {
        HistoryPlayer(scene, maker, context).play(json, lists);
    } catch (...) {
        scene.append("failed", {});
        scene.clear_history();
        throw;
    }
}

}  // namespace lissom
