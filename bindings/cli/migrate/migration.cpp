#include "bindings/cli/migrate/migration.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include "bindings/cli/migrate/lua_tokens.h"
#include "bindings/cli/migrate/script_types.h"
#include "bindings/lua/core/old_names.h"

namespace lissom::cli {
namespace {

using lua::OldKind;
using lua::OldName;

struct Edit {
    std::size_t begin, end;
    std::string text;
};

// Source in one line, for messages.
std::string in_one_line(std::string_view source) {
    std::string line;
    for (const char c : source) {
        const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
        if (!space) line += c;
        if (space && !line.empty() && line.back() != ' ') line += ' ';
    }
    return line;
}

bool is_open(const LuaTokens& tokens, std::size_t i) {
    return tokens.is(i, "(") || tokens.is(i, "{");
}

bool has_old_options(std::string_view function) {
    const auto names = lua::old_names();
    return std::any_of(names.begin(), names.end(), [&](const OldName& old) {
        return old.kind == OldKind::option && function == old.owner;
    });
}

// Reads a script and collects its edits.
class Migrator {
  public:
    Migrator(std::string_view text, bool markdown)
        : text_(text), tokens_(text, markdown), types_(tokens_) {}

    Migration run();

  private:
    void visit(std::size_t i);
    void visit_method(std::size_t colon);
    void visit_function(std::size_t i);
    void visit_options(std::string_view function, std::size_t open);
    void visit_option(std::string_view function, std::size_t key);
    void visit_deform(std::size_t name);
    void visit_point(std::size_t colon);
    void visit_refine(std::size_t key);
    void visit_fields(std::size_t dot);
    void visit_values(std::size_t i);
    void rename_types();
    void decide_later();

    void rename(std::size_t token, const std::string& name);
    void note(std::size_t token, std::string_view before, std::string_view after);
    void ask(std::size_t token, std::string advice);
    bool is_point_call(std::size_t colon) const;
    bool is_grouped(std::size_t first, std::size_t last) const;
    std::size_t targets_of(std::size_t first, std::size_t last) const;
    bool is_last_of_list(std::size_t first, std::size_t last) const;
    bool has_key(std::size_t open, std::string_view key) const;
    std::size_t second_argument(std::size_t open) const;
    std::size_t options_of_call(std::size_t open) const;
    std::string_view source(std::size_t first, std::size_t last) const;
    bool knows_new_names() const;

    std::string_view text_;
    LuaTokens tokens_;
    ScriptTypes types_;
    std::vector<Edit> edits_;
    Migration result_;
    // Doubts that count only in a script of version 0.1, and tokens read as parts of known calls.
    std::vector<UndecidedLine> doubts_;
    std::vector<std::size_t> later_, known_;
};

// ---- Results

void Migrator::note(std::size_t token, std::string_view before, std::string_view after) {
    result_.changes.push_back({tokens_[token].line, in_one_line(before), in_one_line(after)});
}

void Migrator::rename(std::size_t token, const std::string& name) {
    note(token, tokens_.text(token), name);
    edits_.push_back({tokens_[token].begin, tokens_[token].end, name});
}

void Migrator::ask(std::size_t token, std::string advice) {
    doubts_.push_back({tokens_[token].line, std::move(advice)});
}

std::string_view Migrator::source(std::size_t first, std::size_t last) const {
    return text_.substr(tokens_[first].begin, tokens_[last].end - tokens_[first].begin);
}

// ---- Methods

void Migrator::visit_method(std::size_t colon) {
    const std::string_view method = tokens_.text(colon + 1);
    if (is_point_call(colon)) return visit_point(colon);
    const std::string type = colon > 0 ? types_.ending_at(colon - 1) : "";
    for (const OldName& old : lua::old_names()) {
        if (old.kind != OldKind::method || method != old.old_name) continue;
        if (type == old.owner) return rename(colon + 1, old.new_name);
        const bool plain = tokens_.is(colon + 2, "(") || std::string_view("handle") != method;
        const bool with_arguments = tokens_.match(colon + 2) > colon + 3;
        if (!type.empty() || types_.defines(method) || !plain) continue;
        if (method == std::string_view("apply") && with_arguments) continue;
        ask(colon, "if '" + std::string(method) + "' is called on an object of type " + old.owner +
                       ", write " + old.usage);
    }
    if (has_old_options(method)) {
        const std::size_t options = options_of_call(colon + 2);
        if (tokens_.is(options, "{")) visit_options(method, options);
    }
}

// The token that can open the options of a call: those of `f{`, `f({` or `f(x, {`.
std::size_t Migrator::options_of_call(std::size_t open) const {
    if (!tokens_.is(open, "(")) return open;
    return tokens_.is(open + 1, "{") ? open + 1 : second_argument(open);
}

// Whether the method is `at` of a hairstyle or a scalp, which returned the normal as well.
bool Migrator::is_point_call(std::size_t colon) const {
    if (colon == 0 || !tokens_.is(colon + 1, "at") || !is_open(tokens_, colon + 2)) return false;
    if (tokens_.match(colon + 2) >= tokens_.size()) return false;
    const std::string type = types_.ending_at(colon - 1);
    if (type == "lissom.Hairstyle" || type == "lissom.Scalp") return true;
    return tokens_.is(colon + 2, "{") && has_key(colon + 2, "azimuth");
}

void Migrator::visit_point(std::size_t colon) {
    const std::size_t first = types_.start_of(colon - 1), last = tokens_.match(colon + 2);
    if (is_grouped(first, last)) {
        note(first, "(" + std::string(source(first, last)) + ")", source(first, last));
        edits_.push_back({tokens_[first - 1].begin, tokens_[first].begin, ""});
        edits_.push_back({tokens_[last].end, tokens_[last + 1].end, ""});
    } else if (targets_of(first, last) > 1) {
        const std::string normal =
            std::string(source(first, colon)) + "normal_at" + std::string(source(colon + 2, last));
        note(first, source(first, last), "..., " + normal);
        edits_.push_back({tokens_[last].end, tokens_[last].end, ", " + normal});
    } else if (is_last_of_list(first, last)) {
        ask(first, "'at' returns the point alone; where the normal was used too, write normal_at");
    }
}

// Whether a call stands in parentheses that keep its first result alone.
bool Migrator::is_grouped(std::size_t first, std::size_t last) const {
    if (first == 0 || !tokens_.is(first - 1, "(") || !tokens_.is(last + 1, ")")) return false;
    if (first == 1) return true;
    const std::size_t before = first - 2;
    return !(tokens_.is_name(before) || tokens_.is_string(before) || tokens_.is(before, ")") ||
             tokens_.is(before, "]") || tokens_.is(before, "}"));
}

// The number of names that a call alone is assigned to; 0 if it is not.
std::size_t Migrator::targets_of(std::size_t first, std::size_t last) const {
    if (first < 2 || !tokens_.is(first - 1, "=") || tokens_.is(last + 1, ",")) return 0;
    std::size_t count = 1, i = types_.start_of(first - 2);
    while (i >= 2 && tokens_.is(i - 1, ",")) {
        i = types_.start_of(i - 2);
        ++count;
    }
    // A field of a table follows a comma too.
    const bool statement = i == 0 || !(tokens_.is(i - 1, "{") || tokens_.is(i - 1, ","));
    return statement ? count : 1;
}

bool Migrator::is_last_of_list(std::size_t first, std::size_t last) const {
    const bool closes = tokens_.is(last + 1, "}") || tokens_.is(last + 1, ")");
    const bool field = first > 0 && tokens_.is(first - 1, "=");
    const bool returned =
        first > 0 && tokens_.is(first - 1, "return") && !tokens_.is(last + 1, ",");
    return (closes && !field) || returned;
}

// ---- Functions and their options

void Migrator::visit_function(std::size_t i) {
    const std::string_view name = tokens_.text(i + 2);
    if (name == "deform") return visit_deform(i + 2);
    const OldName* old = lua::find_old_name(OldKind::function, "lissom", name);
    if (old) rename(i + 2, old->new_name);
    const std::string function(old ? old->new_name : name);
    if (tokens_.is(i + 3, "{")) return visit_options(function, i + 3);
    for (std::size_t k = i + 4; k < tokens_.match(i + 3) && tokens_.is(i + 3, "("); ++k) {
        if (tokens_.is(k, "{") && (function == "merge" || function == "merger")) {
            visit_options(function, k);
            k = tokens_.match(k);
        }
    }
}

// The first token of the second argument, or size() if there is one argument.
std::size_t Migrator::second_argument(std::size_t open) const {
    for (std::size_t i = open + 1; i < tokens_.match(open) && i < tokens_.size(); ++i) {
        if (tokens_.is(i, ",")) return i + 1;
        const bool opens = is_open(tokens_, i) || tokens_.is(i, "[");
        if (opens && tokens_.match(i) < tokens_.size()) i = tokens_.match(i);
    }
    return tokens_.size();
}

// lissom.deform made an object; now it deforms once and takes handles.
void Migrator::visit_deform(std::size_t name) {
    if (!tokens_.is(name + 1, "(")) return later_.push_back(name);
    const std::size_t options = second_argument(name + 1);
    if (options < tokens_.size() && !tokens_.is(options, "{")) return later_.push_back(name);
    if (options < tokens_.size() && has_key(options, "handles")) return;
    rename(name, "deformer");
    if (options < tokens_.size()) visit_options("deformer", options);
}

bool Migrator::has_key(std::size_t open, std::string_view key) const {
    for (std::size_t i = open + 1; i < tokens_.match(open) && i < tokens_.size(); ++i) {
        const bool opens = is_open(tokens_, i) || tokens_.is(i, "[");
        if (opens && tokens_.match(i) < tokens_.size()) i = tokens_.match(i);
        if (tokens_.is(i, key) && tokens_.is(i + 1, "=")) return true;
    }
    return false;
}

void Migrator::visit_options(std::string_view function, std::size_t open) {
    for (std::size_t i = open + 1; i < tokens_.match(open) && i < tokens_.size(); ++i) {
        const bool opens = is_open(tokens_, i) || tokens_.is(i, "[");
        if (opens && tokens_.match(i) < tokens_.size()) i = tokens_.match(i);
        if (tokens_.is_name(i) && tokens_.is(i + 1, "=")) visit_option(function, i);
    }
}

void Migrator::visit_option(std::string_view function, std::size_t key) {
    known_.push_back(key);
    const OldName* old = lua::find_old_name(OldKind::option, function, tokens_.text(key));
    if (old) rename(key, old->new_name);
}

// Options in tables of their own: numbers are those of a deformer, true and false of the others.
void Migrator::visit_refine(std::size_t key) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) return;
    const std::string_view value = tokens_.text(key + 2);
    if (value == "true" || value == "false") return rename(key, "subdivide");
    const bool number = !value.empty() && value[0] >= '0' && value[0] <= '9';
    if (number || value == tokens_.text(key)) return;
    ask(key, "'refine' of lissom.merge and mesh:fill is 'subdivide' now; that of a deformer stays");
}

void Migrator::visit_fields(std::size_t dot) {
    const std::string_view field = tokens_.text(dot + 1);
    const std::string type = dot > 0 ? types_.ending_at(dot - 1) : "";
    const OldName* method = lua::find_old_name(OldKind::method, type, field);
    if (method && !tokens_.is(dot + 2, "=")) rename(dot + 1, method->new_name);
    for (const OldName& old : lua::old_names()) {
        if (old.kind != OldKind::field || field != old.old_name) continue;
        const bool of_join = dot > 0 && (tokens_.is(dot - 1, "]") || tokens_.is(dot - 1, "join"));
        if (field != "refined" || of_join) return rename(dot + 1, old.new_name);
        ask(dot, "if '.refined' is a field of a join's report, write " + std::string(old.usage));
    }
}

// fidelity = "lissom"
void Migrator::visit_values(std::size_t i) {
    const std::string_view value = tokens_.text(i + 2);
    if (value.size() < 2 || !tokens_.is_string(i + 2)) return;
    const std::string owner = "merge." + std::string(tokens_.text(i));
    const OldName* old =
        lua::find_old_name(OldKind::value, owner, value.substr(1, value.size() - 2));
    if (old) rename(i + 2, value[0] + std::string(old->new_name) + value[0]);
}

// ---- The whole

// Names of types, which stand in strings and in annotations.
void Migrator::rename_types() {
    const auto is_part = [](char c) {
        return c == '_' || std::isalnum(static_cast<unsigned char>(c));
    };
    for (const OldName& old : lua::old_names()) {
        if (old.kind != OldKind::type) continue;
        const std::string before = std::string("lissom.") + old.old_name;
        for (std::size_t at = text_.find(before); at != text_.npos;
             at = text_.find(before, at + 1)) {
            const std::size_t end = at + before.size();
            if (end < text_.size() && is_part(text_[end])) continue;
            const std::string after = std::string("lissom.") + old.new_name;
            result_.changes.push_back({tokens_.line_of(at), before, after});
            edits_.push_back({at, end, after});
        }
    }
}

bool Migrator::knows_new_names() const {
    constexpr std::string_view kNew[] = {"deformer",     "add_handle",   "add_stream",
                                         "add_dividing", "add_ponytail", "normal_at",
                                         "rebase",       "merger",       "subdivide"};
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
        const bool found =
            std::find(std::begin(kNew), std::end(kNew), tokens_.text(i)) != std::end(kNew);
        if (found && i > 0 && (tokens_.is(i - 1, ".") || tokens_.is(i - 1, ":"))) return true;
    }
    return false;
}

// What only a script of version 0.1 means: it has other old names, or no new ones.
void Migrator::decide_later() {
    const bool is_old = !result_.changes.empty();
    for (const std::size_t name : later_) {
        if (is_old) {
            rename(name, "deformer");
        } else {
            ask(name, "if 'lissom.deform' makes an object here, write lissom.deformer");
        }
    }
    if (is_old || !knows_new_names()) result_.undecided = std::move(doubts_);
}

void Migrator::visit(std::size_t i) {
    if (tokens_.is(i, ":") && tokens_.is_name(i + 1)) visit_method(i);
    if (types_.is_function(i)) visit_function(i);
    if (tokens_.is(i, ".") && tokens_.is_name(i + 1)) visit_fields(i);
    if (!tokens_.is_name(i) || !tokens_.is(i + 1, "=")) return;
    visit_values(i);
    if (tokens_.is(i, "refine")) visit_refine(i);
    const bool known = std::find(known_.begin(), known_.end(), i) != known_.end();
    if (tokens_.is(i, "refine_borders") && !known) rename(i, "subdivide_borders");
}

Migration Migrator::run() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) visit(i);
    rename_types();
    decide_later();
    std::stable_sort(edits_.begin(), edits_.end(),
                     [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
    std::size_t at = 0;
    for (const Edit& edit : edits_) {
        result_.text.append(text_.substr(at, edit.begin - at)).append(edit.text);
        at = edit.end;
    }
    result_.text.append(text_.substr(at));
    const auto by_line = [](const auto& a, const auto& b) { return a.line < b.line; };
    std::stable_sort(result_.changes.begin(), result_.changes.end(), by_line);
    std::stable_sort(result_.undecided.begin(), result_.undecided.end(), by_line);
    return std::move(result_);
}

}  // namespace

Migration migrate(std::string_view text, bool markdown) {
    return Migrator(text, markdown).run();
}

}  // namespace lissom::cli
