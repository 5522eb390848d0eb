-- No window is needed.
function love.conf(t)
    t.modules.audio = false
    t.window.width, t.window.height = 64, 64
end
