-- Scripts run under Lua 5.4.
std = "lua54"
max_line_length = 110
exclude_files = { "build", "out", "tests/scenes/golden/*.events.lua", "tests/scenes/golden/*.calls.lua" }
-- A parameter that a callback is given but does not need is no mistake; a variable is.
unused_args = false
-- not (x <= y) is true where one of them is NaN; x > y is not.
ignore = { "581" }

-- What `lissom test` gives to tests.
for _, tests in ipairs{ "**/*_test.lua", "**/scenes/**/*.lua", "tests/scripts" } do
   files[tests] = { read_globals = { "test", "expect" } }
end
-- What LÖVE runs.
for _, folder in ipairs{ "examples/love", "tests/embed/love", "tests/embed/hosts", "tests/hosts/love" } do
   files[folder] = { std = "luajit+love" }
end
-- Annotations for editors, made from the registration table: they declare and define nothing.
for _, folder in ipairs{ "bindings/lua/meta", "viewer/meta" } do
   files[folder] = { ignore = { "111", "112", "113", "211", "212", "241", "631" } }
end
-- One chunk in several files: each goes on where the one before ends.
for _, file in ipairs{ "host", "view", "recording", "journal", "sketch", "windows" } do
   files["bindings/lua/tools/" .. file .. ".lua"] = { ignore = { "111", "112", "113", "211" } }
end
