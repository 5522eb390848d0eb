-- Runs the scripts inside LÖVE.
function love.load()
    require "hosts"
    love.event.quit(0)
end
