-- Runs a script of examples/hosts, and prints its name and the hash of each mesh and hair that it returns.
local folder, name = os.getenv("LISSOM_HOSTS"), os.getenv("LISSOM_SCRIPT")

-- The hash of a mesh or hair; nil for any other value.
local function hash_of(value)
    if type(value) ~= "userdata" then return nil end
    local has_hash, method = pcall(function() return value.hash end)
    return has_hash and method and value:hash() or nil
end

for _, value in ipairs{ assert(loadfile(folder .. "/" .. name .. ".lua"))() } do
    local hash = hash_of(value)
    if hash then print("HASH " .. name .. " " .. hash) end
end
