-- Run by an interpreter that exports its own Lua, with the module lissom_caller.
local call = require "lissom_caller"
for _ = 1, 3 do
    local text = call("shapes.box", "[]")
    assert(text:find("lissom.Mesh", 1, true), text)
    local good, message = pcall(call, "shapes.boxx", "[]")
    assert(not good and message:find("did you mean", 1, true), message)
end
local kept = {}
for i = 1, 1000 do kept[i] = { i } end
assert(#kept == 1000)
print("both work")
