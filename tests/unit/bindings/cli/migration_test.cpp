#include "bindings/cli/migrate/migration.h"

#include <set>
#include <string>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/old_names.h"
#include "bindings/lua/core/registry.h"
#include "tests/unit/support.h"

namespace lissom::cli {
namespace {

// A script of version 0.1 with everything that was renamed, and comments and space of its own.
constexpr const char* kOldScript = R"(#!/usr/bin/env lissom
local lissom = require "lissom"   -- lissom.deform stays as it is in a comment
local mesh = lissom.load("a.obj")
local edit = lissom.deform(mesh,  { region = mesh:region("top"), refine_borders = false, refine = 2 })
edit:handle( mesh:region("base") ):translate(0, 1, 0)
local tip = edit:handle(mesh:region("tip"), { weight = 2 })
edit:solve() edit:apply()
print(edit:refined_mesh(), edit:stats().refined_vertices)
local style = lissom.hairstyle(head)
style:stream{ points = { style:at{ azimuth = 1, elevation = 2 }, (style:at{ azimuth = 3, elevation = 4 }) } }
local p, n = style:scalp():at{ azimuth = 1,
    elevation = 2 }
style:dividing{ points = {} }; style:ponytail{ spine = {} }
local merging = lissom.merging{ joins = {}, refine = false, fidelity = "lissom" }
local text = "edit:handle(region), style:stream{}"
mesh:fill(mesh:boundaries()[1], { refine = true, fair = false })
view:handle{ at = p }
---@param edit lissom.Deformation
)";

constexpr const char* kNewScript = R"(#!/usr/bin/env lissom
local lissom = require "lissom"   -- lissom.deform stays as it is in a comment
local mesh = lissom.load("a.obj")
local edit = lissom.deformer(mesh,  { region = mesh:region("top"), subdivide_borders = false, refine = 2 })
edit:add_handle( mesh:region("base") ):translate(0, 1, 0)
local tip = edit:add_handle(mesh:region("tip"), { weight = 2 })
edit:solve() edit:rebase()
print(edit:subdivided_mesh(), edit:stats().subdivided_vertices)
local style = lissom.hairstyle(head)
style:add_stream{ points = { style:at{ azimuth = 1, elevation = 2 }, style:at{ azimuth = 3, elevation = 4 } } }
local p, n = style:scalp():at{ azimuth = 1,
    elevation = 2 }, style:scalp():normal_at{ azimuth = 1,
    elevation = 2 }
style:add_dividing{ points = {} }; style:add_ponytail{ spine = {} }
local merging = lissom.merger{ joins = {}, subdivide = false, fidelity = "default" }
local text = "edit:handle(region), style:stream{}"
mesh:fill(mesh:boundaries()[1], { subdivide = true, fair = false })
view:handle{ at = p }
---@param edit lissom.Deformer
)";

std::string advice_of(const Migration& migration, int line) {
    for (const UndecidedLine& one : migration.undecided) {
        if (one.line == line) return one.advice;
    }
    return "";
}

}  // namespace

TEST_CASE("migrate: every old name is rewritten; comments, strings and space stay") {
    const Migration migration = migrate(kOldScript);
    CHECK(migration.text == kNewScript);
    CHECK(migration.undecided.empty());
    REQUIRE(!migration.changes.empty());
    CHECK(migration.changes[0].line == 4);
    CHECK(migration.changes[0].before == "deform");
    CHECK(migration.changes[0].after == "deformer");
}

TEST_CASE("migrate: rewriting the result again changes nothing and asks nothing") {
    const Migration again = migrate(kNewScript);
    CHECK(again.text == kNewScript);
    CHECK(again.changes.empty());
    CHECK(again.undecided.empty());
    const std::string once = R"(local mesh = lissom.deform(mesh, { pin = base, handles = moved })
return mesh, style:at{ azimuth = 1, elevation = 2 })";
    CHECK(migrate(once).text == once);
}

TEST_CASE("migrate: what the text does not decide is listed with its line") {
    const Migration migration = migrate(R"(local lissom = require "lissom"
local style = lissom.hairstyle(head)
local function points() return style:at{ azimuth = 1, elevation = 2 } end
something:handle(region)
something:apply()
something:apply(5)
local options = { refine = chosen }
lissom.merge(options)
return lissom.deform(mesh, options)
)");
    CHECK(advice_of(migration, 3).find("normal_at") != std::string::npos);
    CHECK(advice_of(migration, 4).find("deformer:add_handle(region)") != std::string::npos);
    CHECK(advice_of(migration, 5).find("rebase") != std::string::npos);
    CHECK(advice_of(migration, 6).empty());
    CHECK(advice_of(migration, 7).find("subdivide") != std::string::npos);
    CHECK(advice_of(migration, 9).find("lissom.deformer") != std::string::npos);
    CHECK(migration.changes.empty());
}

TEST_CASE("migrate: a script's own functions of an old name are its own") {
    const std::string text = R"(local artist = {}
function artist:stream(places) return places end
artist:stream{ 1, 2 }
local walker = { apply = function() end }
walker:apply()
)";
    const Migration migration = migrate(text);
    CHECK(migration.text == text);
    CHECK(migration.undecided.empty());
}

TEST_CASE("migrate: the module under another name, chained calls and objects of a scene") {
    const Migration migration = migrate(R"(local L = require("lissom")
L.deform(L.shapes.bar()):handle(region)
local bend = scene:add("bend", assert(L.deform(bar)))
bend:handle(region)
bend:constrain{ vertex = 1 }:apply()
pcall(bend.apply, bend)
one.style:stream{ points = points }
)");
    CHECK(migration.text == R"(local L = require("lissom")
L.deformer(L.shapes.bar()):add_handle(region)
local bend = scene:add("bend", assert(L.deformer(bar)))
bend:add_handle(region)
bend:constrain{ vertex = 1 }:rebase()
pcall(bend.rebase, bend)
one.style:add_stream{ points = points }
)");
}

TEST_CASE("migrate: of a Markdown text only the Lua blocks are rewritten") {
    const Migration migration = migrate(
        "Call "
        "`lissom.merging{}`:\n\n```lua\nlissom.merging{}\n```\n\n```sh\nlissom.merging{}\n```\n",
        true);
    CHECK(migration.text ==
          "Call "
          "`lissom.merging{}`:\n\n```lua\nlissom.merger{}\n```\n\n```sh\nlissom.merging{}\n```\n");
}

TEST_CASE("migrate: broken scripts are kept to the byte") {
    for (const std::string text :
         {"local x = {{{", "x = \"open", "--[[ open", "]])) : at {", "at{", ":at{ azimuth = 1 }",
          "lissom.deform(", "style:at(", "[==[", "(style:at{", "a,b=style:at{azimuth=1}"}) {
        CAPTURE(text);
        const Migration migration = migrate(text);
        if (migration.changes.empty()) CHECK(migration.text == text);
    }
}

TEST_CASE("migrate: fields of reports and limits of options take min_ and max_") {
    const Migration migration = migrate(
        "local grown = style:grow{ least_speed = 0.1, most_segments = 80 }\n"
        "print(grown:stats().most_length, report.joins[1].quality.greatest_dihedral)\n");
    CHECK(migration.text ==
          "local grown = style:grow{ min_speed = 0.1, max_segments = 80 }\n"
          "print(grown:stats().max_length, report.joins[1].quality.max_dihedral)\n");
    CHECK(migration.undecided.empty());
}

TEST_CASE("each old name has a new one that exists, and is itself none any more") {
    const lua::Registry registry = lua::kernel_registry();
    const auto has = [&](const std::string& owner, const std::string& name) {
        for (const auto& entry : registry.entries()) {
            const std::string own = entry->type ? entry->type->name : "lissom";
            if (own == owner && entry->function->name == name) return true;
        }
        return false;
    };
    const auto has_option = [&](const std::string& function, const std::string& option) {
        for (const auto& entry : registry.entries()) {
            if (entry->function->name != function) continue;
            for (const auto& slot : entry->slots) {
                if (slot.path == option) return true;
            }
        }
        return false;
    };
    for (const lua::OldName& old : lua::old_names()) {
        CAPTURE(old.old_name);
        if (old.kind == lua::OldKind::method) {
            CHECK(has(old.owner, old.new_name));
            CHECK(!has(old.owner, old.old_name));
        } else if (old.kind == lua::OldKind::function) {
            CHECK(has(old.owner, old.new_name));
        } else if (old.kind == lua::OldKind::option) {
            CHECK(has_option(old.owner, old.new_name));
            CHECK(!has_option(old.owner, old.old_name));
        } else if (old.kind == lua::OldKind::type) {
            CHECK(registry.find_type(std::string("lissom.") + old.new_name) != nullptr);
            CHECK(registry.find_type(std::string("lissom.") + old.old_name) == nullptr);
        }
    }
}

}  // namespace lissom::cli
