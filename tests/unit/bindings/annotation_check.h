/// Checks annotations as lua-language-server reads them (luals.github.io/wiki/annotations): tags,
/// types, and that parameters are those of the function below them.
#pragma once

#include <cctype>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace lissom::test {

/// Reads one type; what is left is the description.
class TypeReader {
  public:
    TypeReader(std::string_view text, const std::set<std::string>& known)
        : rest_(text), known_(known) {}

    std::string error;

    /// A union of types; false where there is none.
    bool read_type(bool is_last = false) {
        do {
            if (!read_single()) return false;
            // The result of a function would take in what follows.
            if (ends_in_function_ && !is_last && next_is("|")) return fail("'|' after fun(...)");
        } while (take("|"));
        return true;
    }
    std::string_view rest() const { return rest_; }
    bool take(std::string_view mark) {
        if (!next_is(mark)) return false;
        rest_.remove_prefix(mark.size());
        return true;
    }
    std::string take_name() {
        std::size_t size = 0;
        while (size < rest_.size() && (std::isalnum(static_cast<unsigned char>(rest_[size])) ||
                                       rest_[size] == '_' || rest_[size] == '.')) {
            ++size;
        }
        const std::string name(rest_.substr(0, size));
        rest_.remove_prefix(size);
        return name;
    }
    void skip_spaces() {
        while (take(" ")) {
        }
    }

  private:
    bool next_is(std::string_view mark) const { return rest_.substr(0, mark.size()) == mark; }
    bool fail(const std::string& what) {
        if (error.empty()) error = what + " before '" + std::string(rest_.substr(0, 40)) + "'";
        return false;
    }

    bool read_single() {
        ends_in_function_ = false;
        if (take("\"")) {
            const std::size_t end = rest_.find('"');
            if (end == std::string_view::npos) return fail("an open string");
            rest_.remove_prefix(end + 1);
        } else if (take("fun(")) {
            if (!read_function()) return false;
            ends_in_function_ = true;
            return true;
        } else if (take("(")) {
            if (!read_type() || !take(")")) return fail("an open (");
        } else if (!read_named()) {
            return false;
        }
        ends_in_function_ = false;
        while (take("[]") || take("?")) {
        }
        return true;
    }

    bool read_named() {
        const std::string name = take_name();
        if (known_.count(name) == 0) return fail("unknown type '" + name + "'");
        if (!take("<")) return true;
        do {
            skip_spaces();
            if (!read_type()) return false;
        } while (take(","));
        return take(">") || fail("an open <");
    }

    bool read_function() {
        std::set<std::string> names;
        while (!take(")")) {
            const std::string name = take_name();
            if (name.empty() || !names.insert(name).second) return fail("a parameter's name");
            take("?");
            if (!take(": ") || !read_type()) return fail("a parameter's type");
            take(", ");
        }
        return !take(": ") || read_type();
    }

    std::string_view rest_;
    const std::set<std::string>& known_;
    bool ends_in_function_ = false;
};

/// What a file of annotations declares: classes and aliases.
inline std::set<std::string> declared_types(const std::string& text) {
    std::set<std::string> names;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        for (const std::string tag : {"---@class ", "---@alias "}) {
            if (!line.starts_with(tag)) continue;
            const std::string name =
                line.substr(tag.size(), line.find(' ', tag.size()) - tag.size());
            names.insert(name);
        }
    }
    return names;
}

/// Every mistake of the annotations in `text`, which may use the types `declared`.
inline std::vector<std::string> annotation_mistakes(const std::string& text,
                                                    std::set<std::string> declared) {
    for (const char* name :
         {"any", "boolean", "false", "fun", "function", "integer", "lightuserdata", "nil", "number",
          "string", "table", "true", "userdata"}) {
        declared.insert(name);
    }
    std::vector<std::string> mistakes, parameters;
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const auto report = [&](const std::string& what) {
            mistakes.push_back(std::to_string(number) + ": " + what + ": " + line);
        };
        if (line.starts_with("function ")) {
            const std::size_t open = line.find('(');
            std::string list = line.substr(open + 1, line.find(')') - open - 1), wanted;
            for (const std::string& p : parameters) wanted += (wanted.empty() ? "" : ", ") + p;
            if (list != wanted) report("parameters other than those described");
            parameters.clear();
        }
        if (!line.starts_with("---@")) continue;
        const std::size_t space = std::min(line.find(' '), line.size());
        const std::string tag = line.substr(4, space - 4);
        TypeReader reader(std::string_view(line).substr(std::min(space + 1, line.size())),
                          declared);
        bool good = true;
        if (tag == "param" || tag == "field") {
            if (tag == "field" && reader.take("[")) {
                good = reader.read_type() && reader.take("]");
            } else {
                const std::string name = reader.take_name();
                good = name == "..." || (!name.empty() && name.find('.') == std::string::npos);
                if (tag == "param") parameters.push_back(name);
                reader.take("?");
            }
            good = good && reader.take(" ") && reader.read_type(true) &&
                   (reader.rest().empty() || reader.rest()[0] == ' ');
        } else if (tag == "return") {
            good = reader.read_type(true) && (reader.rest().empty() || reader.take(" "));
        } else if (tag == "overload") {
            good = std::string_view(reader.rest()).starts_with("fun(") && reader.read_type(true) &&
                   reader.rest().empty();
        } else if (tag == "operator") {
            good = reader.take_name() == "len" && reader.take(": ") && reader.read_type();
        } else if (tag == "alias") {
            good = !reader.take_name().empty() && reader.take(" ") && reader.read_type();
        } else {
            good = tag == "class" || tag == "meta";
        }
        if (!good)
            report("not understood" + (reader.error.empty() ? "" : " (" + reader.error + ")"));
    }
    return mistakes;
}

}  // namespace lissom::test
