-- Calls the library in LÖVE's own LuaJIT.
local use = require "library"

function love.load()
    print(use(os.getenv("LISSOM_LIBRARY")))
    love.event.quit(0)
end
