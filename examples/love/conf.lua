function love.conf(settings)
    settings.identity = "lissom"
    settings.window.title = "Lissom in LÖVE"
    settings.window.width, settings.window.height = 960, 540
    settings.window.depth = 24
    settings.window.msaa = 4
    settings.modules.audio, settings.modules.sound, settings.modules.joystick = false, false, false
end
