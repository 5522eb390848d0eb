-- Runs a file of tests under a stock interpreter, which loads lissom as a module: what `lissom test` does,
-- in this process and without limits.
--     lua5.4 stock.lua FRAMEWORK FILE
local framework, file = arg[1], arg[2]
local counts = { passed = 0, failed = 0, skipped = 0 }
local running, folder

local function explain(problem)
    return { message = tostring(problem), trace = debug.traceback("", 2) }
end

local function remove_folder()
    if folder then os.execute("rm -r '" .. folder .. "'") end
    folder = nil
end

local function ended(event)
    local name = running or "the file"
    counts[event.status] = counts[event.status] + 1
    if event.status == "skipped" then print("skipped: " .. file .. ": " .. name .. ": " .. event.message) end
    if event.status == "failed" then
        print("FAILED  " .. name .. "\n    " .. event.message .. (event.trace or ""))
    end
    remove_folder()
end

local host = {
    settings = { shown = file, path = file, seed = 1, finished = 0, timeout = 0 },
    no_picture = function() return "a stock interpreter draws no pictures" end,
    picture = function() error("a stock interpreter draws no pictures") end,
}

function host.call(action)
    local done, failure = xpcall(action, explain)
    return not done and failure or nil
end

function host.report(event)
    if event.event == "begin" then running = event.name end
    if event.event == "left_out" then print("skipped: " .. file .. ": " .. running .. ": " .. event.text) end
    if event.event == "end" or event.event == "file" then ended(event) end
end

function host.folder()
    if not folder then
        folder = os.tmpname() .. ".folder"
        assert(os.execute("mkdir '" .. folder .. "'"))
    end
    return folder
end

local tests = assert(loadfile(framework))(host)
rawset(_G, "test", tests.test)
rawset(_G, "expect", tests.expect)
tests.run(assert(loadfile(file)))
print(counts.passed .. " passed, " .. counts.failed .. " failed, " .. counts.skipped .. " skipped")
os.exit(counts.failed == 0 and 0 or 1)
