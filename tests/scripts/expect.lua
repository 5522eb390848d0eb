-- Assertions for script tests; a failed one is an error at the line of the test.
local expect = {}

local function fail(message)
    error(message, 3)
end

local function show(value)
    return type(value) == "string" and string.format("%q", value) or tostring(value)
end

function expect.equal(got, wanted)
    if got ~= wanted then fail("expected " .. show(wanted) .. ", got " .. show(got)) end
end

function expect.near(got, wanted, tolerance)
    tolerance = tolerance or 1e-9
    if type(got) ~= "number" or not (math.abs(got - wanted) <= tolerance) then
        fail("expected " .. show(wanted) .. " within " .. show(tolerance) .. ", got " .. show(got))
    end
end

-- Lists of numbers.
function expect.near_list(got, wanted, tolerance)
    if #got ~= #wanted then fail("expected " .. #wanted .. " numbers, got " .. #got) end
    for i = 1, #wanted do
        if not (math.abs(got[i] - wanted[i]) <= (tolerance or 1e-9)) then
            fail("expected " .. show(wanted[i]) .. " at [" .. i .. "], got " .. show(got[i]))
        end
    end
end

-- What a test needs is absent: its part is left out, which fails where LISSOM_REQUIRE_DATA is set.
function expect.skip(what)
    local required = "LISSOM_REQUIRE_DATA"
    if os.getenv(required) then fail(required .. " is set, and this is absent: " .. what) end
    print("skipped: " .. what)
end

function expect.truthy(value)
    if not value then fail("expected a true value, got " .. show(value)) end
end

-- `action` raises an error that contains `text` and names this test's file and line.
function expect.error(text, action)
    local done, message = pcall(action)
    if done then fail("expected an error with " .. show(text)) end
    if not tostring(message):find(text, 1, true) then
        fail("expected an error with " .. show(text) .. ", got " .. show(message))
    end
    if not tostring(message):find("_test.lua:%d+: ") then
        fail("the error does not name file and line: " .. show(message))
    end
end

-- The results of a call are nil, a message and the code.
function expect.failure(code, result, message, got)
    if result ~= nil then fail("expected nil and " .. show(code) .. ", got " .. show(result)) end
    if got ~= code then fail("expected " .. show(code) .. ", got " .. show(got) .. ": " .. show(message)) end
    if type(message) ~= "string" or message == "" then fail("the failure has no message") end
end

return expect
