-- Real models, where there are any: LISSOM_TEST_DATA names their folder.
local models = {}

-- The path of a model. Where there is none the test is skipped, or fails where LISSOM_REQUIRE_DATA is set.
function models.path(name)
    local path = (os.getenv("LISSOM_TEST_DATA") or "") .. "/" .. name
    local file = io.open(path)
    if file then
        file:close()
        return path
    end
    local required = "LISSOM_REQUIRE_DATA"
    if os.getenv(required) then error(required .. " is set, and there is no " .. path, 2) end
    test.skip(name)
end

return models
