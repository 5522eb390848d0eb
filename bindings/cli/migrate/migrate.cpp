// lissom migrate FILE.lua...
#include <CLI/CLI.hpp>
#include <iostream>

#include "bindings/cli/json.h"
#include "bindings/cli/migrate/migration.h"
#include "bindings/cli/verbs.h"
#include "bindings/lua/core/file_path.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

Json migration_json(const std::string& file, const Migration& migration) {
    Json changes = Json::array(), undecided = Json::array();
    for (const MigratedName& one : migration.changes) {
        changes.push_back({{"line", one.line}, {"before", one.before}, {"after", one.after}});
    }
    for (const UndecidedLine& one : migration.undecided) {
        undecided.push_back({{"line", one.line}, {"advice", one.advice}});
    }
    return {{"file", file}, {"changes", changes}, {"undecided", undecided}};
}

void print_migration(const std::string& file, const Migration& migration) {
    for (const MigratedName& one : migration.changes) {
        std::cout << file << ":" << one.line << ": " << one.before << " -> " << one.after << "\n";
    }
    for (const UndecidedLine& one : migration.undecided) {
        std::cout << file << ":" << one.line << ": not decided: " << one.advice << "\n";
    }
    std::cout << file << ": " << migration.changes.size() << " changed, "
              << migration.undecided.size() << " not decided" << std::endl;
}

}  // namespace

int migrate_scripts(Program& program, const std::vector<std::string>& words) {
    CLI::App app(
        "Rewrites the names of version 0.1 in Lua scripts, and in the Lua blocks of Markdown "
        "files, to those of this version. Lists each change and the lines to decide by hand.",
        "lissom migrate");
    std::vector<std::string> files;
    bool check = false;
    app.add_option("FILE", files, "Scripts (.lua) or documents (.md)")->required();
    app.add_flag("--check", check, "Write nothing; exit status 1 if a file has old names");
    int status = kSuccess;
    if (!program.parse(app, words, status)) return status;
    Json all = Json::array();
    for (const std::string& file : files) {
        const auto path = lua::file_path(file);
        const std::string text = read_file(path, program.context()).bytes;
        const Migration migration = migrate(text, path.extension() == ".md");
        if (check && !migration.changes.empty()) status = kFailure;
        if (!check && migration.text != text) write_file_atomically(path, migration.text);
        if (program.json()) {
            all.push_back(migration_json(file, migration));
        } else {
            print_migration(file, migration);
        }
    }
    if (program.json()) std::cout << json_text({{"files", all}}) << std::endl;
    return status;
}

}  // namespace lissom::cli
